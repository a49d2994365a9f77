//! Slow light: how far it has come.

/// Meters a second at which slow light begins.
const SPEED: f64 = 4.0;
/// The slowest and the fastest slow light, meters a second.
pub(crate) const SPEEDS: std::ops::RangeInclusive<f64> = 0.1..=100.0;

/// Light that runs along the rays, so slowly that one can follow it. Whoever draws tells it the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SlowLight {
    /// Whether it runs.
    pub(crate) is_running: bool,
    /// Meters a second, in air.
    pub(crate) speed: f64,
    /// The optical path that it has come from the eye, meters; `None` while all rays are shown whole.
    pub(crate) front: Option<f64>,
    /// When it was moved last, seconds.
    last: Option<f64>,
}

impl Default for SlowLight {
    fn default() -> Self {
        Self { is_running: false, speed: SPEED, front: None, last: None }
    }
}

impl SlowLight {
    /// Lets it run or stop; at the end of the longest way, `longest`, it starts anew.
    pub(crate) fn toggle(&mut self, longest: f64) {
        self.is_running = !self.is_running;
        self.last = None;
        if self.is_running && self.front.is_none_or(|front| front >= longest) {
            self.front = Some(0.0);
        }
    }

    /// Moves it on to the time `now`, seconds, and stops it at the end of the longest way.
    pub(crate) fn move_on(&mut self, now: f64, longest: f64) {
        /// A window that was not drawn for a while does not jump ahead.
        const LONGEST_FRAME: f64 = 0.25;
        let last = self.last.replace(now);
        let (Some(front), Some(last), true) = (self.front, last, self.is_running) else { return };
        let front = front + self.speed * (now - last).clamp(0.0, LONGEST_FRAME);
        self.front = Some(front.min(longest));
        if front >= longest {
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
    use super::*;

    #[test]
    fn light_runs_by_the_clock() {
        const LONGEST: f64 = 7.0;
        let mut light = SlowLight::default();
        light.toggle(LONGEST);
        for now in [10.0, 10.25, 10.5] {
            light.move_on(now, LONGEST);
        }
        assert_eq!(light.front, Some(2.0));
        light.toggle(LONGEST);
        light.move_on(11.0, LONGEST);
        assert_eq!(light.front, Some(2.0), "at rest");
        light.toggle(LONGEST);
        light.move_on(20.0, LONGEST);
        light.move_on(30.0, LONGEST);
        assert_eq!(light.front, Some(3.0), "after a long frame");
        light.speed = 40.0;
        light.move_on(30.25, LONGEST);
        assert_eq!((light.front, light.is_running), (Some(LONGEST), false));
        light.toggle(LONGEST);
        assert_eq!(light.front, Some(0.0), "anew");
        light.end();
        assert_eq!((light.front, light.is_running), (None, false));
    }
}
