//! Slow light: how far it has come, and how far it goes.

use super::segments::RaySegment;

/// How long slow light runs at first, seconds.
const DURATION: f64 = 6.0;
/// The shortest and the longest run that can be chosen, seconds.
pub(crate) const DURATIONS: std::ops::RangeInclusive<f64> = 0.5..=120.0;
/// The way that is seen before the first and after the last event, as a part of the way between them.
const LEAD: f64 = 0.05;
/// The longest way that is seen before the first event, as a part of the shortest way between two events.
const LEAD_IN: f64 = 0.5;
/// The whole over its finest part from which equal shares of the time are equal factors of the way.
const LOGARITHMIC: f64 = 30.0;

/// The optical paths from the eye along which something happens to light, meters: from just before the first surface
/// that is met to just after the last event. The way from the eye to the first surface would take most of the time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct LightSpan {
    /// Where slow light begins.
    pub(crate) start: f64,
    /// Where it ends.
    pub(crate) end: f64,
    /// The shortest way between two events.
    finest: f64,
}

impl LightSpan {
    /// The span of the ways of an audit.
    pub(super) fn of_ways(ways: &[RaySegment]) -> Self {
        let events = || ways.iter().filter(|way| !way.is_open).map(|way| way.path[1]);
        let Some(first) = events().reduce(f64::min) else {
            // The ray from the eye meets nothing.
            let end = ways.iter().map(|way| way.path[1]).fold(0.0, f64::max);
            return Self { start: 0.0, end, finest: end };
        };
        let last = events().fold(first, f64::max);
        let between = if last > first { last - first } else { first };
        let lengths = ways.iter().filter(|way| !way.is_open && way.path[1] > first);
        let lengths = lengths.map(|way| way.path[1] - way.path[0]).filter(|length| *length > 0.0);
        let finest = lengths.fold(between, f64::min);
        let lead_in = (LEAD * between).min(LEAD_IN * finest);
        Self { start: (first - lead_in).max(0.0), end: last + LEAD * between, finest }
    }

    /// The length of the span, meters.
    pub(crate) fn length(&self) -> f64 {
        self.end - self.start
    }

    /// Whether the lengths of the ways are of such different orders that even steps would pass over the short ones.
    pub(crate) fn is_logarithmic(&self) -> bool {
        self.length() > LOGARITHMIC * self.finest
    }

    /// The shortest way between two events, meters; never 0.
    pub(crate) fn finest(&self) -> f64 {
        self.finest.max(1e-9 * self.length()).max(f64::MIN_POSITIVE)
    }

    /// The optical path after a share of the time, from 0 to 1. Where lengths differ greatly it grows in powers, from
    /// half of the shortest way on: u·((l/u + 1)ˢ − 1) after the share s, of the length l and with the unit u.
    pub(crate) fn path(&self, share: f64) -> f64 {
        if share >= 1.0 {
            self.end
        } else if self.is_logarithmic() {
            let unit = 0.5 * self.finest();
            self.start + unit * (share.max(0.0) * (self.length() / unit).ln_1p()).exp_m1()
        } else {
            self.start + share.max(0.0) * self.length()
        }
    }

    /// The share of the time at which the optical path is so long: the inverse of [`Self::path`].
    pub(crate) fn share(&self, path: f64) -> f64 {
        let (way, length) = (path - self.start, self.length());
        if length <= 0.0 || way >= length {
            1.0
        } else if self.is_logarithmic() {
            let unit = 0.5 * self.finest();
            (way.max(0.0) / unit).ln_1p() / (length / unit).ln_1p()
        } else {
            way.max(0.0) / length
        }
    }
}

/// The animation of light along the rays. The drawing code advances its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SlowLight {
    /// Whether it runs.
    pub(crate) is_running: bool,
    /// How long it takes from the start of the span to its end, seconds: scenes of all sizes take the same time.
    pub(crate) duration: f64,
    /// The optical path that it has come from the eye, meters; `None` while all rays are shown whole.
    pub(crate) front: Option<f64>,
    /// When it was moved last, seconds.
    last: Option<f64>,
}

impl Default for SlowLight {
    fn default() -> Self {
        Self { is_running: false, duration: DURATION, front: None, last: None }
    }
}

impl SlowLight {
    /// Lets it run or stop; at the end of the span it starts anew.
    pub(crate) fn toggle(&mut self, span: &LightSpan) {
        self.is_running = !self.is_running;
        self.last = None;
        if self.is_running && self.front.is_none_or(|front| front < span.start || front >= span.end) {
            self.front = Some(span.start);
        }
    }

    /// Moves it on to the time `now`, seconds, and stops it at the end of the span.
    pub(crate) fn move_on(&mut self, now: f64, span: &LightSpan) {
        /// A window that was not drawn for a while does not jump ahead.
        const LONGEST_FRAME: f64 = 0.25;
        let last = self.last.replace(now);
        let (Some(front), Some(last), true) = (self.front, last, self.is_running) else { return };
        let share = span.share(front) + (now - last).clamp(0.0, LONGEST_FRAME) / self.duration;
        let front = span.path(share);
        self.front = Some(front);
        if front >= span.end {
            self.is_running = false;
        }
    }

    /// Shows all rays whole.
    pub(crate) fn end(&mut self) {
        (self.is_running, self.front, self.last) = (false, None, None);
    }
}

#[cfg(test)]
mod tests {
    use catoptric_lab::audit::NodeKind;
    use glam::DVec3;

    use super::super::segments::SegmentKind;
    use super::*;

    fn way(path: [f64; 2], is_open: bool) -> RaySegment {
        RaySegment {
            node: 0,
            kind: SegmentKind::Ray(NodeKind::Primary),
            from: DVec3::ZERO,
            to: DVec3::X,
            weight: 1.0,
            generation: 1,
            path,
            is_open,
        }
    }

    #[test]
    fn the_span_leaves_out_the_empty_way_before_the_first_surface() {
        let span = LightSpan::of_ways(&[
            way([0.0, 1000.0], false),
            way([1000.0, 1002.0], false),
            way([1002.0, 1010.0], false),
            way([1010.0, 9000.0], true),
        ]);
        assert!((span.start - 999.5).abs() < 1e-9 && (span.end - 1010.5).abs() < 1e-9, "{span:?}");
        assert!(!span.is_logarithmic());
        // Where the last event is far away, it does not begin long before the first.
        let far =
            LightSpan::of_ways(&[way([0.0, 7.0], false), way([7.0, 9.0], false), way([9.0, 180.0], false)]);
        assert!((far.start - 6.0).abs() < 1e-9, "{far:?}");
        let thin =
            LightSpan::of_ways(&[way([0.0, 5.0], false), way([5.0, 5.001], false), way([5.0, 25.0], false)]);
        assert!(thin.is_logarithmic() && (thin.finest() - 1e-3).abs() < 1e-9, "{thin:?}");
    }

    #[test]
    fn paths_and_shares_of_the_time_lead_to_each_other() {
        let even = LightSpan { start: 10.0, end: 22.0, finest: 1.0 };
        let steep = LightSpan { start: 5.0, end: 1005.0, finest: 1e-3 };
        assert!(steep.is_logarithmic() && !even.is_logarithmic());
        for span in [even, steep] {
            assert_eq!((span.path(0.0), span.path(1.0)), (span.start, span.end));
            assert_eq!((span.share(span.start), span.share(span.end)), (0.0, 1.0));
            for share in [0.1, 0.5, 0.9] {
                assert!((span.share(span.path(share)) - share).abs() < 1e-9, "{span:?}");
            }
        }
        assert_eq!(even.path(0.25), 13.0);
        // Half of the time for the geometric mean of the unit and the whole.
        assert!((steep.path(0.5) - 5.0 - 0.5f64.sqrt()).abs() < 1e-3, "{}", steep.path(0.5));
    }

    #[test]
    fn a_single_event_and_none_have_a_span() {
        let lone = LightSpan::of_ways(&[way([0.0, 4.0], false), way([4.0, 30.0], true)]);
        assert!(lone.start < 4.0 && lone.start > 3.0 && lone.end > 4.0 && lone.end < 5.0, "{lone:?}");
        let open = LightSpan::of_ways(&[way([0.0, 8.0], true)]);
        assert_eq!((open.start, open.end), (0.0, 8.0));
        assert_eq!(LightSpan::of_ways(&[]), LightSpan::default());
    }

    #[test]
    fn light_runs_by_the_clock() {
        let span = LightSpan { start: 10.0, end: 22.0, finest: 1.0 };
        let mut light = SlowLight::default();
        light.toggle(&span);
        assert_eq!(light.front, Some(10.0));
        for now in [10.0, 10.25, 10.5] {
            light.move_on(now, &span);
        }
        assert_eq!(light.front, Some(11.0));
        light.toggle(&span);
        light.move_on(11.0, &span);
        assert_eq!(light.front, Some(11.0), "at rest");
        light.toggle(&span);
        light.move_on(20.0, &span);
        light.move_on(30.0, &span);
        assert_eq!(light.front, Some(11.5), "after a long frame");
        light.duration = 0.5;
        light.move_on(30.25, &span);
        light.move_on(30.5, &span);
        assert_eq!((light.front, light.is_running), (Some(22.0), false));
        light.toggle(&span);
        assert_eq!(light.front, Some(10.0), "anew");
        light.end();
        assert_eq!((light.front, light.is_running), (None, false));
    }
}
