//! A watch over the loss of a device.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Records the loss of a device, which drivers report in any thread.
pub struct LossWatch {
    device: wgpu::Device,
    loss: Arc<Loss>,
}

/// The loss of a device, which may be told from any thread, though the device of a page stays in its own.
struct Loss {
    reason: OnceLock<String>,
    tell: Mutex<Option<LossCallback>>,
}

type LossCallback = Box<dyn FnOnce() + Send>;

impl LossWatch {
    /// Watches `device`: its loss is recorded here from now on, and nowhere else. `tell` is called once, in any thread.
    pub fn over(device: &wgpu::Device, tell: impl FnOnce() + Send + 'static) -> Arc<Self> {
        let tell: LossCallback = Box::new(tell);
        let loss = Arc::new(Loss { reason: OnceLock::new(), tell: Mutex::new(Some(tell)) });
        // The loss is told only while somebody watches.
        let told = Arc::downgrade(&loss);
        device.set_device_lost_callback(move |_, message| {
            if let Some(loss) = told.upgrade() {
                loss.record(&message);
            }
        });
        Arc::new(Self { device: device.clone(), loss })
    }

    /// Takes an error that nobody looks for as a loss, too: what the device made since then may be missing. Otherwise
    /// it would end the program.
    pub fn mind_errors(&self) {
        let told = Arc::downgrade(&self.loss);
        self.device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Some(loss) = told.upgrade() {
                loss.record(&error.to_string());
            }
        }));
    }

    /// Why the device is lost, if it is.
    pub fn lost(&self) -> Option<&str> {
        self.loss.reason.get().map(String::as_str)
    }

    /// Takes note that the device is lost; the first reason counts.
    pub fn lose(&self, message: &str) {
        self.loss.record(message);
    }

    /// Gives the device back, whatever it is doing: as if it were lost.
    pub fn destroy(&self) {
        self.device.destroy();
        self.lose("it was given back");
    }

    /// Has the driver look what it has done; that the device is lost may be found by that.
    ///
    /// # Errors
    /// When the driver refuses.
    pub fn look(&self) -> Result<(), wgpu::PollError> {
        // A device that is found lost here makes the library panic.
        match catch_unwind(AssertUnwindSafe(|| self.device.poll(wgpu::PollType::Poll))) {
            Ok(found) => found.map(|_| ()),
            Err(_) => {
                self.lose("the driver gave up");
                Ok(())
            }
        }
    }
}

impl Loss {
    /// Takes note of it; the first reason counts.
    fn record(&self, message: &str) {
        self.reason.get_or_init(|| {
            let line = message.split_whitespace().collect::<Vec<_>>().join(" ");
            if line.is_empty() { "the driver gives no reason".to_owned() } else { line }
        });
        let tell = self.tell.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(tell) = tell {
            tell();
        }
    }
}

impl std::fmt::Debug for LossWatch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LossWatch").field("lost", &self.lost()).finish_non_exhaustive()
    }
}
