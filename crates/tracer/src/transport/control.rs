//! Watching and stopping a render.

use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// How a running render is watched and stopped, from any thread.
#[derive(Default)]
pub struct RenderControl {
    pub(crate) cancel: AtomicBool,
    pause: Option<Box<dyn Fn() -> bool + Send + Sync>>,
    pixels_done: AtomicU64,
    pixels_expected: AtomicU64,
    rays_done: AtomicU64,
}

impl RenderControl {
    /// A control that pauses work which can be taken up again, such as the passes of a [`Film`](crate::Film), as soon as
    /// `pause` says so. It is asked after every tile.
    pub fn pausing_when(pause: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self { pause: Some(Box::new(pause)), ..Self::default() }
    }

    /// Whether the work should pause now.
    pub(crate) fn should_pause(&self) -> bool {
        self.pause.as_ref().is_some_and(|pause| pause())
    }

    /// Asks the render to stop; it does so within a pixel, some ten thousand rays later.
    pub fn cancel(&self) {
        self.cancel.store(true, Ordering::Relaxed);
    }

    /// Whether [`Self::cancel`] was called.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Counts pixels that were gone through, by other work than rendering too.
    pub fn add_pixels(&self, pixels: u64) {
        self.pixels_done.fetch_add(pixels, Ordering::Relaxed);
    }

    /// Announces pixels, those of cube maps and of every pass among them.
    pub(crate) fn expect(&self, count: u64) {
        self.pixels_expected.fetch_add(count, Ordering::Relaxed);
    }

    /// Pixels to be gone through, as far as is known by now; 0 for [`render`](crate::render()), which goes through those of the picture.
    pub fn pixels_expected(&self) -> u64 {
        self.pixels_expected.load(Ordering::Relaxed)
    }

    /// Counts rays that were traced.
    pub(crate) fn add_rays(&self, rays: u64) {
        self.rays_done.fetch_add(rays, Ordering::Relaxed);
    }

    /// Rays of all kinds that the processor traced so far for pictures by Whitted's tree, those of unfinished pixels among
    /// them; some ten thousand of each thread may not be counted yet.
    pub fn rays_done(&self) -> u64 {
        self.rays_done.load(Ordering::Relaxed)
    }

    /// Pixels finished so far.
    pub fn pixels_done(&self) -> u64 {
        self.pixels_done.load(Ordering::Relaxed)
    }
}

impl fmt::Debug for RenderControl {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("RenderControl")
            .field("is_cancelled", &self.is_cancelled())
            .field("pixels_done", &self.pixels_done())
            .field("pixels_expected", &self.pixels_expected())
            .field("rays_done", &self.rays_done())
            .finish_non_exhaustive()
    }
}
