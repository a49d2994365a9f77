//! Times of the same work.

use std::fmt;

/// Times in milliseconds, as they came.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct TimeSeries(Vec<f64>);

impl TimeSeries {
    pub(super) fn push(&mut self, milliseconds: f64) {
        self.0.push(milliseconds);
    }

    fn sorted(&self) -> Vec<f64> {
        let mut times = self.0.clone();
        times.sort_by(f64::total_cmp);
        times
    }

    /// The time at a place in their order, 0 the shortest and 1 the longest; NaN without any.
    fn at(&self, place: f64) -> f64 {
        let sorted = self.sorted();
        let index = place * sorted.len().saturating_sub(1) as f64;
        let time = |index: f64| sorted.get(index as usize).copied().unwrap_or(f64::NAN);
        (time(index.floor()) + time(index.ceil())) / 2.0
    }

    pub(super) fn best(&self) -> f64 {
        self.at(0.0)
    }

    /// The time in the middle, of an even number the mean of the two.
    pub(super) fn median(&self) -> f64 {
        self.at(0.5)
    }

    pub(super) fn worst(&self) -> f64 {
        self.at(1.0)
    }
}

/// Best, and in brackets the median and the worst.
impl fmt::Display for TimeSeries {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = if self.best() < 1000.0 { 1 } else { 0 };
        let [best, median, worst] = [self.best(), self.median(), self.worst()];
        write!(to, "{best:.digits$} ({median:.digits$}, {worst:.digits$})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn best_median_and_worst() {
        let series = TimeSeries(vec![30.0, 10.0, 20.26]);
        assert_eq!(series.to_string(), "10.0 (20.3, 30.0)");
        assert_eq!(TimeSeries(vec![4000.0, 1000.0]).to_string(), "1000 (2500, 4000)");
        assert!(TimeSeries::default().median().is_nan() && TimeSeries::default().best().is_nan());
    }
}
