//! The progress of work, on the terminal.

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use catoptric_scene::visible;
use catoptric_tracer::RenderControl;
use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use terminal_size::{Width, terminal_size_of};

use crate::console::is_able;

/// What is shown now, so that an interruption can clear it.
static SHOWN: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// The display of progress, on or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Progress {
    shown: bool,
}

impl Progress {
    /// Shown on standard error if that is a terminal that can move its cursor, and the user does not want quiet.
    pub(crate) fn new(quiet: bool) -> Self {
        Self { shown: !quiet && is_able(&std::io::stderr()) }
    }

    /// Whether anything is shown.
    pub(crate) fn is_shown(self) -> bool {
        self.shown
    }

    /// Does `work` while a bar shows how much of `expected` `control` says is done.
    pub(crate) fn of_tracing<T>(
        self,
        control: &RenderControl,
        expected: WorkEstimate,
        work: impl FnOnce() -> T,
    ) -> T {
        if !self.shown {
            return work();
        }
        show(ProgressBar::new(STEPS), |state| {
            let left = (state.pos() > 0).then(|| state.eta());
            fitted(columns(), state, format!("{:>3.0} %", 100.0 * state.fraction()), left)
        });
        let finished = AtomicBool::new(false);
        let result = thread::scope(|scope| {
            let watcher = scope.spawn(|| watch(control, expected, &finished));
            let _end = WatcherGuard { finished: &finished, watcher: watcher.thread().clone() };
            work()
        });
        clear();
        result
    }

    /// Does `work` while a bar shows how many steps of `total` it says are done, and the seconds it says are left.
    pub(crate) fn of_steps<T>(
        self,
        total: usize,
        work: impl FnOnce(&mut (dyn FnMut(usize, Option<Duration>) + Send)) -> T,
    ) -> T {
        if !self.shown {
            return work(&mut |_, _| {});
        }
        let time_left = Arc::new(Mutex::new(None));
        let known = Arc::clone(&time_left);
        show(ProgressBar::new(total as u64), move |state| {
            let left = *known.lock().unwrap_or_else(PoisonError::into_inner);
            fitted(columns(), state, format!("{} of {total}", state.pos()), left)
        });
        let result = work(&mut |done, left| {
            *time_left.lock().unwrap_or_else(PoisonError::into_inner) = left;
            with_shown(|bar| {
                bar.set_position(done as u64);
                bar.tick();
            });
        });
        clear();
        result
    }

    /// Does `work` under a line that says what it is.
    pub(crate) fn of_writing<T>(self, what: &str, work: impl FnOnce() -> T) -> T {
        if !self.shown {
            return work();
        }
        let line = format!("writing {}", visible(what));
        show(ProgressBar::new_spinner(), move |_| cut(&line, columns()));
        with_shown(ProgressBar::tick);
        let result = work();
        clear();
        result
    }
}

/// Ends the watcher when it goes out of scope, even if the work panics: the scope waits for the watcher.
struct WatcherGuard<'a> {
    finished: &'a AtomicBool,
    watcher: thread::Thread,
}

impl Drop for WatcherGuard<'_> {
    fn drop(&mut self) {
        self.finished.store(true, Ordering::Relaxed);
        self.watcher.unpark();
    }
}

/// Takes away what is shown; nothing is drawn any more.
pub(crate) fn clear() {
    let shown = SHOWN.lock().unwrap_or_else(PoisonError::into_inner).take();
    if let Some(bar) = shown {
        bar.finish_and_clear();
    }
}

/// Shows a bar as the line that `line` makes of its state.
fn show(bar: ProgressBar, line: impl Fn(&ProgressState) -> String + Clone + Send + Sync + 'static) {
    let write = move |state: &ProgressState, out: &mut dyn fmt::Write| {
        // A bar that cannot be drawn is no reason to stop.
        let _ = out.write_str(&line(state));
    };
    let style = ProgressStyle::with_template("{line}").unwrap_or_else(|_| ProgressStyle::default_bar());
    bar.set_style(style.with_key("line", write));
    *SHOWN.lock().unwrap_or_else(PoisonError::into_inner) = Some(bar);
}

/// How many columns a line can have, so that the cursor stays in it.
fn columns() -> usize {
    const USUAL: u16 = 80;
    let width = terminal_size_of(std::io::stderr()).map_or(USUAL, |(Width(width), _)| width);
    usize::from(width).saturating_sub(1)
}

/// A bar, a count and the times, as far as they fit into so many columns.
fn fitted(columns: usize, state: &ProgressState, count: String, left: Option<Duration>) -> String {
    let elapsed = format!("{count}  {:#} elapsed", HumanDuration(state.elapsed()));
    let whole = left.map(|left| format!("{elapsed}, {:#} left", HumanDuration(left)));
    line_of(columns, state.fraction(), &[whole, Some(elapsed), Some(count)])
}

/// The first of the texts that fits beside a bar, or by itself, into so many columns; the bar takes what is left.
fn line_of(columns: usize, fraction: f32, texts: &[Option<String>]) -> String {
    const BAR: std::ops::RangeInclusive<usize> = 10..=40;
    let texts = || texts.iter().flatten();
    let room_beside = |text: &str| columns.checked_sub(text.chars().count() + 1);
    if let Some((text, room)) =
        texts().find_map(|text| Some((text, room_beside(text).filter(|room| room >= BAR.start())?)))
    {
        let width = room.min(*BAR.end());
        let full = ((fraction.clamp(0.0, 1.0) * width as f32) as usize).min(width);
        return format!("{}{} {text}", "█".repeat(full), "░".repeat(width - full));
    }
    let last = texts().next_back().map_or("", String::as_str);
    texts().find(|text| text.chars().count() <= columns).map_or_else(|| cut(last, columns), Clone::clone)
}

/// The text, or its beginning and end if it has more characters than there are columns.
fn cut(text: &str, columns: usize) -> String {
    let count = text.chars().count();
    if count <= columns {
        return text.to_owned();
    }
    // Letters of two columns may stand in a path; a line of half as many characters surely fits.
    let room = (if text.is_ascii() { columns } else { columns / 2 }).saturating_sub(1);
    let before: String = text.chars().take(room.div_ceil(2)).collect();
    let after: String = text.chars().skip(count - room / 2).collect();
    if columns == 0 { String::new() } else { format!("{before}…{after}") }
}

fn with_shown(draw: impl FnOnce(&ProgressBar)) {
    if let Some(bar) = &*SHOWN.lock().unwrap_or_else(PoisonError::into_inner) {
        draw(bar);
    }
}

/// Moves the bar until the work is finished; short work shows none.
fn watch(control: &RenderControl, expected: WorkEstimate, finished: &AtomicBool) {
    const INTERVAL: Duration = Duration::from_millis(100);
    thread::park_timeout(INTERVAL);
    let mut most = 0;
    while !finished.load(Ordering::Relaxed) {
        // Some work announces more as it goes on; the bar never goes back.
        most = most.max((expected.share_done(control) * STEPS as f64) as u64);
        with_shown(|bar| bar.set_position(most));
        thread::park_timeout(INTERVAL);
    }
}

/// Steps of a bar that counts shares of the work.
const STEPS: u64 = 10_000;

/// The estimated work of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WorkEstimate {
    /// Pixels to go through, unless the work announces others.
    pub(crate) pixels: u64,
    /// About so many rays, if they were estimated: pixels whose rays fork without end take most of the time.
    pub(crate) rays: Option<f64>,
}

impl WorkEstimate {
    /// The most that an estimate says is done before all pixels are.
    const MOST_OF_ESTIMATE: f64 = 0.99;

    /// The share of the work that is done, from 0 to 1: 1 when all pixels are.
    fn share_done(self, control: &RenderControl) -> f64 {
        let announced = control.pixels_expected();
        let pixels = if announced > 0 { announced } else { self.pixels };
        let of_pixels = (control.pixels_done() as f64 / pixels.max(1) as f64).min(1.0);
        self.share(of_pixels, control.rays_done())
    }

    /// The share of the work with this share of the pixels and so many rays done. A card tells of no rays.
    fn share(self, of_pixels: f64, rays_done: u64) -> f64 {
        match self.rays {
            Some(rays) if rays_done > 0 && of_pixels < 1.0 => {
                (rays_done as f64 / rays.max(1.0)).min(Self::MOST_OF_ESTIMATE)
            }
            _ => of_pixels,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_is_that_of_the_rays_where_they_are_estimated() {
        let by_rays = WorkEstimate { pixels: 100, rays: Some(1e6) };
        // One tile holds all: no pixel is done, but half of the rays are.
        assert_eq!(by_rays.share(0.0, 500_000), 0.5);
        assert_eq!(by_rays.share(0.9, 100_000), 0.1);
        // An estimate that is too small does not say that all is done; the last pixel does.
        assert_eq!(by_rays.share(0.9, 5_000_000), 0.99);
        assert_eq!(by_rays.share(1.0, 300_000), 1.0);
        // Cards count pixels only, and so does work without an estimate.
        assert_eq!(by_rays.share(0.25, 0), 0.25);
        assert_eq!(WorkEstimate { pixels: 100, rays: None }.share(0.25, 500_000), 0.25);
        assert_eq!(WorkEstimate { pixels: 100, rays: Some(0.0) }.share(0.0, 1), 0.99);
    }

    #[test]
    fn work_that_is_not_begun_is_not_done() {
        let control = RenderControl::default();
        assert_eq!(WorkEstimate { pixels: 0, rays: None }.share_done(&control), 0.0);
        control.add_pixels(30);
        assert_eq!(WorkEstimate { pixels: 40, rays: None }.share_done(&control), 0.75);
        assert_eq!(WorkEstimate { pixels: 20, rays: Some(1e9) }.share_done(&control), 1.0);
    }

    #[test]
    fn a_line_fits_into_every_terminal() {
        let texts = ["12 of 300  4s elapsed, 2m left", "12 of 300  4s elapsed", "12 of 300"];
        let texts = texts.map(|text| Some(text.to_owned()));
        for columns in 0..200 {
            for fraction in [0.0, 0.5, 1.0, f32::NAN] {
                let line = line_of(columns, fraction, &texts);
                assert!(line.chars().count() <= columns, "{columns}: {line}");
                assert!(columns < 9 || line.ends_with("left") || line.contains("12 of 300"), "{line}");
            }
        }
        assert_eq!(
            line_of(80, 0.5, &texts),
            format!("{}{} 12 of 300  4s elapsed, 2m left", "█".repeat(20), "░".repeat(20))
        );
        assert_eq!(
            line_of(41, 0.5, &texts),
            format!("{}{} 12 of 300  4s elapsed, 2m left", "█".repeat(5), "░".repeat(5))
        );
        assert_eq!(line_of(21, 0.0, &texts), format!("{} 12 of 300", "░".repeat(11)));
        assert_eq!(line_of(9, 0.0, &texts), "12 of 300");
    }

    #[test]
    fn a_long_name_is_cut_in_its_middle() {
        assert_eq!(cut("writing a.png", 40), "writing a.png");
        assert_eq!(cut("writing a/long/path.png", 12), "writin…h.png");
        for columns in 0..30 {
            assert!(cut("writing a/long/path.png", columns).chars().count() <= columns);
            assert!(cut("writing 世界世界世界世界.png", columns).chars().count() <= columns.max(1));
        }
    }
}
