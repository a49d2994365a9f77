//! Work of which only the newest matters: one piece at a time, the next one when it is done.

use std::sync::Arc;
use std::time::Duration;

use catoptric_tracer::RenderControl;
use egui::Context;

use crate::base::job::{Job, JobStatus};

/// Work that nobody waits for any more may go on for so long: it is nearly done, and begun anew in every frame of a
/// drag, none would ever be.
const PATIENCE: Duration = Duration::from_millis(400);

/// Work for a key, and its result.
pub(crate) struct Latest<K, T> {
    running: Option<LatestTask<K, T>>,
}

struct LatestTask<K, T> {
    key: K,
    control: Arc<RenderControl>,
    job: Job<T>,
}

impl<K, T> Default for Latest<K, T> {
    fn default() -> Self {
        Self { running: None }
    }
}

impl<K, T> Latest<K, T> {
    /// Lets go of what is under way.
    pub(crate) fn cancel(&mut self) {
        if let Some(running) = self.running.take() {
            running.control.cancel();
        }
    }
}

/// Nobody is left to wait for it.
impl<K, T> Drop for Latest<K, T> {
    fn drop(&mut self) {
        self.cancel();
    }
}

impl<K: PartialEq + Clone, T: Send + 'static> Latest<K, T> {
    /// Has `work` done for `key`, unless this or something else is under way; to be asked again in every frame.
    pub(crate) fn want(
        &mut self,
        context: &Context,
        key: &K,
        work: impl FnOnce(&RenderControl) -> T + Send + 'static,
    ) {
        match &self.running {
            Some(running) if running.key != *key && running.job.since().elapsed() > PATIENCE => {
                running.control.cancel();
            }
            Some(_) => {}
            None => {
                let control = Arc::new(RenderControl::default());
                let own = Arc::clone(&control);
                // Without a thread there is no result; the next frame tries again.
                self.running = Job::start(context, "lab", move || work(&own)).ok().map(|job| LatestTask {
                    key: key.clone(),
                    control,
                    job,
                });
            }
        }
    }

    /// What was found, once, with its key; `None` for work that broke down.
    pub(crate) fn poll(&mut self) -> Option<(K, Option<T>)> {
        let found = match self.running.as_ref()?.job.poll() {
            JobStatus::Waiting => return None,
            JobStatus::Done(found) => Some(found),
            JobStatus::Lost => None,
        };
        self.running.take().map(|running| (running.key, found))
    }

    /// What is under way.
    pub(crate) fn key(&self) -> Option<&K> {
        self.running.as_ref().map(|running| &running.key)
    }

    /// How many pixels are done of what is under way.
    pub(crate) fn pixels_done(&self) -> Option<u64> {
        self.running.as_ref().map(|running| running.control.pixels_done())
    }
}
