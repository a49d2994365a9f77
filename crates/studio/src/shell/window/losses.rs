//! The count of lost devices.

use catoptric_platform::time::{Duration, Instant};

/// A driver that fails so often within [`SPAN`] is not asked again.
const MOST: usize = 3;
const SPAN: Duration = Duration::from_secs(60);

/// The recent losses of the device.
#[derive(Debug, Default)]
pub(super) struct DeviceLosses {
    at: Vec<Instant>,
}

impl DeviceLosses {
    /// Whether there has been none.
    pub(super) fn is_empty(&self) -> bool {
        self.at.is_empty()
    }

    /// Adds one. Returns whether another device is worth a try.
    pub(super) fn add(&mut self, now: Instant) -> bool {
        self.at.push(now);
        self.at.iter().filter(|at| now.saturating_duration_since(**at) < SPAN).count() < MOST
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_third_loss_within_a_minute_is_the_last() {
        let start = Instant::now();
        let after = |seconds| start + Duration::from_secs(seconds);
        let mut losses = DeviceLosses::default();
        assert!(losses.is_empty());
        assert!(losses.add(after(0)) && losses.add(after(30)), "two");
        assert!(losses.add(after(60)), "the first one is a minute ago");
        assert!(!losses.is_empty() && !losses.add(after(61)), "three in 31 seconds");
        assert!(losses.add(after(1000)), "long ago");
    }
}
