//! Waiting for a card, and what it writes.

use std::future::poll_fn;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Poll, Waker};

use catoptric_platform::threads;
use catoptric_platform::time::{Duration, Instant};

use crate::card::Gpu;
use crate::error::GpuError;

/// The longest time for a dispatch before the card counts as hung; drivers give up long before.
const PATIENCE: Duration = Duration::from_secs(120);

/// Does work on a card and waits for it in this thread, which must be one that may wait: not that of a window.
///
/// # Errors
/// Those of the work; and [`GpuError::CannotWait`] on a page, where no thread can. There the work is awaited.
pub fn wait<T>(work: impl Future<Output = Result<T, GpuError>>) -> Result<T, GpuError> {
    threads::wait(work).unwrap_or(Err(GpuError::CannotWait))
}

impl Gpu {
    /// The bytes of a buffer once the work submitted so far is done, as `take` reads them.
    pub(crate) async fn read<T>(
        &self,
        buffer: &wgpu::Buffer,
        bytes: u64,
        take: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        let slice = buffer.slice(..bytes);
        let unmapping = Unmapping(buffer);
        let mapped = self.map(slice).await;
        std::mem::forget(unmapping);
        mapped?;
        let taken = self.trusted(|_| {
            let taken = slice.get_mapped_range().map(|view| take(&view));
            buffer.unmap();
            taken
        });
        taken.await?.map_err(|error| GpuError::Refused(error.to_string()))
    }

    /// Waits until a part of a buffer is mapped. Nobody waits within the device, since others could not submit work to it
    /// meanwhile: a window, or another thread.
    async fn map(&self, slice: wgpu::BufferSlice<'_>) -> Result<(), GpuError> {
        let answer = Arc::new(MapAnswer::default());
        let given = Arc::clone(&answer);
        self.trusted(|_| slice.map_async(wgpu::MapMode::Read, move |mapped| given.give(mapped))).await?;
        let start = Instant::now();
        poll_fn(|context| {
            answer.call(context.waker());
            if let Err(error) = self.look() {
                return Poll::Ready(Err(error));
            }
            // Asked first, since the driver lets go of an answer after it has given it.
            let is_let_go = Arc::strong_count(&answer) == 1;
            match answer.take() {
                Some(Ok(())) => Poll::Ready(Ok(())),
                None if is_let_go => Poll::Ready(Err(self.unreadable())),
                None if start.elapsed() > PATIENCE => {
                    Poll::Ready(Err(GpuError::NoAnswer(PATIENCE.as_secs())))
                }
                None => Poll::Pending,
                Some(Err(_)) => Poll::Ready(Err(self.unreadable())),
            }
        })
        .await
    }

    /// The error that memory is not mapped, which no card refuses that is not lost.
    fn unreadable(&self) -> GpuError {
        self.check_alive().err().unwrap_or_else(|| self.lose("its memory cannot be read"))
    }

    /// Lets the device look what is done.
    pub(crate) fn look(&self) -> Result<(), GpuError> {
        self.watch.look().map_err(|error| GpuError::Refused(error.to_string()))?;
        self.check_alive()
    }
}

/// What the driver says of a mapping, and who waits for it.
#[derive(Default)]
struct MapAnswer(Mutex<MapState>);

#[derive(Default)]
struct MapState {
    mapped: Option<Result<(), wgpu::BufferAsyncError>>,
    waker: Option<Waker>,
}

impl MapAnswer {
    fn give(&self, mapped: Result<(), wgpu::BufferAsyncError>) {
        let waker = {
            let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            state.mapped = Some(mapped);
            state.waker.take()
        };
        if let Some(waker) = waker {
            waker.wake();
        }
    }

    /// Has the answer wake whoever waits.
    fn call(&self, waker: &Waker) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).waker = Some(waker.clone());
    }

    fn take(&self) -> Option<Result<(), wgpu::BufferAsyncError>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).mapped.take()
    }
}

/// Takes the mapping of a buffer back when nobody waits for it any more, so that the buffer can be used again.
struct Unmapping<'b>(&'b wgpu::Buffer);

impl Drop for Unmapping<'_> {
    fn drop(&mut self) {
        self.0.unmap();
    }
}
