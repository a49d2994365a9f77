//! Waiting for a card, and what it writes.

use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};

use catoptric_platform::time::{Duration, Instant};

use crate::card::Gpu;
use crate::error::GpuError;

/// The longest time for a dispatch before the card counts as hung; drivers give up long before.
const PATIENCE: Duration = Duration::from_secs(120);
/// How long to sleep between looks at the card: at first, and in the end.
const SHORTEST_PAUSE: Duration = Duration::from_micros(20);
const LONGEST_PAUSE: Duration = Duration::from_micros(500);

impl Gpu {
    /// The bytes of a buffer once the work submitted so far is done, as `take` reads them.
    pub(crate) fn read<T>(
        &self,
        buffer: &wgpu::Buffer,
        bytes: u64,
        take: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        let slice = buffer.slice(..bytes);
        let (sender, receiver) = channel();
        self.guarded(0, |_| {
            slice.map_async(wgpu::MapMode::Read, move |mapped| {
                // Nobody listens any more after an error.
                let _ = sender.send(mapped);
            });
        })?;
        self.wait_for(&receiver)?;
        let taken = self.guarded(0, |_| {
            let taken = slice.get_mapped_range().map(|view| take(&view));
            buffer.unmap();
            taken
        })?;
        taken.map_err(|error| GpuError::Refused(error.to_string()))
    }

    /// Waits until the buffer is reported as mapped. Nobody waits within the device, since others could not submit work
    /// to it meanwhile: a window, or another thread.
    fn wait_for(&self, receiver: &Receiver<Result<(), wgpu::BufferAsyncError>>) -> Result<(), GpuError> {
        let start = Instant::now();
        let mut pause = SHORTEST_PAUSE;
        loop {
            self.look()?;
            match receiver.recv_timeout(pause) {
                Ok(Ok(())) => return Ok(()),
                Ok(Err(_)) | Err(RecvTimeoutError::Disconnected) => {
                    self.check_alive()?;
                    return Err(self.lose("its memory cannot be read"));
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
            self.check_alive()?;
            if start.elapsed() > PATIENCE {
                return Err(GpuError::NoAnswer(PATIENCE.as_secs()));
            }
            pause = (2 * pause).min(LONGEST_PAUSE);
        }
    }

    /// Lets the device look what is done.
    pub(crate) fn look(&self) -> Result<(), GpuError> {
        self.watch.look().map_err(|error| GpuError::Refused(error.to_string()))?;
        self.check_alive()
    }
}
