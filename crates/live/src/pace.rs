//! The size of a picture that can be traced in time.

use catoptric_platform::time::Instant;
use catoptric_tracer::RayCounts;

/// Divisors of the view's size for coarse pictures. Few of them, so that the resolution does not flicker.
const DIVISORS: [f64; 14] = [1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 24.0];

/// The coarsest picture is an eighth of the view, or this wide if that is less.
const COARSEST: f64 = 8.0;
const LEAST_WIDTH: f64 = 160.0;

/// A full picture that takes longer is reached in steps, milliseconds.
const LONG: f64 = 300.0;

/// The measured speed of tracing.
#[derive(Clone, Debug)]
pub(crate) struct Pace {
    /// What a picture may take while something moves, milliseconds.
    budget: f64,
    /// What a pixel takes, milliseconds.
    per_pixel: f64,
    /// What outlines and grid take beside the picture, milliseconds.
    overlays: f64,
    divisor: f64,
    /// Whether the last picture could not have been coarser.
    is_coarsest: bool,
    /// Of those, pictures given up since the last that was finished.
    given_up: u32,
}

impl Pace {
    pub(crate) fn new(budget: f64) -> Self {
        // Half a microsecond for a first guess.
        Self { budget, per_pixel: 5e-4, overlays: 0.0, divisor: COARSEST, is_coarsest: false, given_up: 0 }
    }

    /// Takes note of what a pass took.
    pub(crate) fn passed(&mut self, pixels: u64, milliseconds: f64) {
        /// Fewer pixels say little: starting and ending a pass takes time too.
        const ENOUGH: u64 = 200;
        self.given_up = 0;
        if pixels < ENOUGH || !milliseconds.is_finite() {
            return;
        }
        let new = milliseconds / pixels as f64;
        // Slower scenes are noticed sooner than quicker ones: a picture too late is worse than one too coarse.
        let weight = if new > self.per_pixel { 0.5 } else { 0.2 };
        // A scene of quite another kind is noticed at once.
        let weight = if new > 2.0 * self.per_pixel || new < 0.25 * self.per_pixel { 1.0 } else { weight };
        self.per_pixel += weight * (new - self.per_pixel);
    }

    /// Takes note of a coarse picture that was cancelled after so many pixels: the next one must be coarser, or none
    /// would ever be finished.
    pub(crate) fn gave_up(&mut self, pixels: u64, milliseconds: f64) {
        /// Pixels that may be under way when nothing else is known of them.
        const UNDER_WAY: f64 = 512.0;
        self.given_up += u32::from(self.is_coarsest);
        self.per_pixel = (2.0 * self.per_pixel).max(milliseconds / (pixels as f64 + UNDER_WAY));
    }

    /// How many times as long as usual the coarsest picture may take, up to eight: twice as long for each that was given up,
    /// so that even slow scenes are seen while they move.
    pub(crate) fn patience(&self) -> u32 {
        1 << self.given_up.min(3)
    }

    /// Takes note of what outlines and grid took.
    pub(crate) fn overlaid(&mut self, milliseconds: f64) {
        self.overlays += 0.3 * (milliseconds - self.overlays);
    }

    /// The size of the picture to trace while something moves.
    pub(crate) fn coarse(&mut self, view: [u32; 2]) -> [u32; 2] {
        let pixels = f64::from(view[0]) * f64::from(view[1]);
        // However long the outlines take, the picture has a share.
        let available = (self.budget - self.overlays).max(0.3 * self.budget);
        let cost = |divisor: f64| pixels * self.per_pixel / (divisor * divisor);
        let possible = || DIVISORS.into_iter().filter(|&divisor| divisor <= coarsest(view));
        // What is fine stays, unless there is room to spare.
        let fits = |divisor: f64| {
            let share = if divisor < self.divisor { 0.8 } else { 1.1 };
            cost(divisor) <= share * available
        };
        self.divisor = possible().find(|&divisor| fits(divisor)).unwrap_or(coarsest(view));
        self.is_coarsest = self.divisor >= coarsest(view);
        divided(view, self.divisor)
    }

    /// Whether a picture of the view could be coarser than this.
    pub(crate) fn can_be_coarser(&self, view: [u32; 2], picture: [u32; 2]) -> bool {
        picture[0] > divided(view, coarsest(view))[0]
    }

    /// The size of the next, sharper picture after one of this size.
    pub(crate) fn sharper(&self, view: [u32; 2], picture: [u32; 2]) -> [u32; 2] {
        let full = f64::from(view[0]) * f64::from(view[1]) * self.per_pixel;
        let divisor = f64::from(view[0]) / f64::from(picture[0].max(1));
        if full <= LONG || divisor <= 2.5 { view } else { divided(view, 0.5 * divisor) }
    }
}

fn coarsest(view: [u32; 2]) -> f64 {
    let least = f64::from(view[0]) / LEAST_WIDTH;
    DIVISORS.into_iter().filter(|&divisor| divisor <= least.max(COARSEST)).fold(1.0, f64::max)
}

/// A view's size over a divisor, at least one pixel.
fn divided(view: [u32; 2], divisor: f64) -> [u32; 2] {
    view.map(|side| ((f64::from(side) / divisor).round() as u32).max(1))
}

/// The rays and the time of a finished pass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PassCost {
    pub(crate) rays: RayCounts,
    pub(crate) milliseconds: f64,
}

/// Milliseconds that have passed since `start`.
pub(crate) fn milliseconds_since(start: Instant) -> f64 {
    1e3 * start.elapsed().as_secs_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: [u32; 2] = [1280, 720];

    fn pixels(size: [u32; 2]) -> u64 {
        u64::from(size[0]) * u64::from(size[1])
    }

    /// Follows the pace through pictures in a scene that takes this many nanoseconds for a pixel.
    fn settled(nanoseconds: f64, view: [u32; 2]) -> (Pace, [u32; 2]) {
        let mut pace = Pace::new(20.0);
        let mut size = pace.coarse(view);
        for _ in 0..50 {
            pace.passed(pixels(size), 1e-6 * nanoseconds * pixels(size) as f64);
            size = pace.coarse(view);
        }
        (pace, size)
    }

    #[test]
    fn patience_grows_until_a_picture_is_finished() {
        let mut pace = Pace::new(20.0);
        pace.coarse([16, 9]);
        pace.gave_up(0, 1e4);
        // The next picture may be coarser, and is sooner there.
        assert_eq!((pace.patience(), pace.coarse(VIEW)), (1, [160, 90]));
        for times in [2, 4, 8, 8] {
            pace.gave_up(0, 1e3);
            assert_eq!(pace.patience(), times);
        }
        pace.passed(1, 1e4);
        assert_eq!(pace.patience(), 1);
    }

    #[test]
    fn coarse_pictures_fit_the_budget_and_use_it() {
        for nanoseconds in [10.0, 50.0, 100.0, 300.0, 700.0] {
            let (_, size) = settled(nanoseconds, VIEW);
            let milliseconds = 1e-6 * nanoseconds * pixels(size) as f64;
            assert!(milliseconds <= 22.0, "{nanoseconds} ns: {milliseconds} ms");
            assert!(size == VIEW || milliseconds >= 6.0, "{nanoseconds} ns: {milliseconds} ms");
        }
    }

    #[test]
    fn pictures_are_neither_finer_than_the_view_nor_coarser_than_can_be_told() {
        assert_eq!(settled(0.001, VIEW).1, VIEW);
        assert_eq!(settled(1e6, VIEW).1, [160, 90]);
        assert_eq!(settled(1e6, [3840, 2160]).1, [160, 90]);
        // Hardly any pixels are never too many.
        assert_eq!(settled(1e6, [4, 1]).1, [4, 1]);
    }

    #[test]
    fn a_heavy_scene_sharpens_in_steps() {
        let (pace, coarse) = settled(1e4, VIEW);
        let mut size = coarse;
        let mut steps = Vec::new();
        while size != VIEW {
            size = pace.sharper(VIEW, size);
            steps.push(size[0]);
        }
        assert_eq!(steps, [320, 640, 1280]);
        let (pace, coarse) = settled(100.0, VIEW);
        assert_eq!(pace.sharper(VIEW, coarse), VIEW);
    }

    #[test]
    fn pictures_given_up_become_as_coarse_as_can_be() {
        let mut pace = Pace::new(20.0);
        let mut given_up = 0;
        let mut size = pace.coarse(VIEW);
        while pace.can_be_coarser(VIEW, size) {
            pace.gave_up(0, 60.0);
            given_up += 1;
            size = pace.coarse(VIEW);
        }
        assert!(size == [160, 90] && given_up <= 7, "{given_up}");
    }

    #[test]
    fn a_small_change_of_speed_does_not_change_the_size() {
        let (mut pace, size) = settled(200.0, VIEW);
        for wobble in [190.0, 205.0, 195.0, 210.0] {
            pace.passed(pixels(size), 1e-6 * wobble * pixels(size) as f64);
            assert_eq!(pace.coarse(VIEW), size);
        }
    }
}
