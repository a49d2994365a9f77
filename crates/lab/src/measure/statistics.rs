//! Statistics of repeated measurements.

/// The middle of some measurements, how sure it is, and what lies far off.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// How many measurements there are.
    pub count: usize,
    /// The median.
    pub median: f64,
    /// The lower end of the interval of confidence for the median.
    pub low: f64,
    /// The upper end.
    pub high: f64,
    /// The chance that such an interval covers the true median, 0…1: at least 0.95 from six measurements on.
    pub coverage: f64,
    /// The least measurement.
    pub least: f64,
    /// The greatest measurement.
    pub greatest: f64,
    /// The places of the outliers, in the order in which they were measured. They are part of all of the above.
    pub outliers: Vec<usize>,
}

/// Sums up measurements; `None` without any.
///
/// The interval is free of assumptions on the distribution: it runs from the k-th least measurement to the k-th
/// greatest, k the largest for which 1 − 2·P(B ≤ k − 1) is at least 0.95, B being binomial of n trials and chance ½
/// (J.-Y. Le Boudec, Performance Evaluation of Computer and Communication Systems, 2010, theorem 2.1). Fewer than six
/// measurements cannot give 0.95; they give all they span, and the coverage says how little that is.
///
/// Outliers lie more than 1.5 times the distance of the quartiles beyond them (J. W. Tukey, Exploratory Data Analysis,
/// 1977, section 2C); a quartile is the median of a half, to both of which the middle one belongs.
pub fn summarize(values: &[f64]) -> Option<Summary> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len();
    let at = |index: usize| sorted.get(index).copied();
    let (rank, coverage) = interval(count);
    let half = sorted.get(..count.div_ceil(2))?;
    let upper = sorted.get(count / 2..)?;
    let (low_quartile, high_quartile) = (middle(half)?, middle(upper)?);
    let reach = 1.5 * (high_quartile - low_quartile);
    let is_outlier = |value: f64| value < low_quartile - reach || value > high_quartile + reach;
    Some(Summary {
        count,
        median: middle(&sorted)?,
        low: at(rank)?,
        high: at(count - 1 - rank)?,
        coverage,
        least: at(0)?,
        greatest: at(count - 1)?,
        outliers: (0..)
            .zip(values)
            .filter(|(_, value)| is_outlier(**value))
            .map(|(place, _)| place)
            .collect(),
    })
}

/// The median of sorted values.
fn middle(sorted: &[f64]) -> Option<f64> {
    let (lower, upper) = (sorted.get(sorted.len().checked_sub(1)? / 2)?, sorted.get(sorted.len() / 2)?);
    Some(0.5 * (lower + upper))
}

/// How many measurements to leave out at either end, and the coverage of the rest.
fn interval(count: usize) -> (usize, f64) {
    // P(B ≤ k) grows with k; each term from the one before.
    let mut term = 0.5_f64.powi(count.min(1000) as i32);
    let mut below = term;
    let mut found = (0, 1.0 - 2.0 * below);
    for rank in 1..count.min(1000) / 2 {
        term *= (count - rank + 1) as f64 / rank as f64;
        below += term;
        let coverage = 1.0 - 2.0 * below;
        if coverage < 0.95 {
            break;
        }
        found = (rank, coverage);
    }
    (found.0, found.1.max(0.0))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn the_ranks_are_those_of_the_tables() {
        // From the table of Le Boudec 2010, appendix A: n, rank of the lower end (from 1), coverage.
        for (count, rank, coverage) in [
            (6, 1, 0.969),
            (8, 1, 0.992),
            (9, 2, 0.961),
            (11, 2, 0.988),
            (12, 3, 0.961),
            (20, 6, 0.959),
            (31, 10, 0.971),
        ] {
            let found = interval(count);
            assert_eq!(found.0 + 1, rank, "{count}");
            assert!((found.1 - coverage).abs() < 1e-3, "{count}: {found:?}");
        }
    }

    #[test]
    fn a_few_numbers_by_hand() {
        let summary = summarize(&[5.0, 1.0, 4.0, 2.0, 3.0, 100.0]).unwrap();
        assert_eq!((summary.median, summary.low, summary.high), (3.5, 1.0, 100.0));
        assert_eq!((summary.least, summary.greatest, summary.count), (1.0, 100.0, 6));
        // Quartiles 2 and 5, so that 9.5 is the fence.
        assert_eq!(summary.outliers, [5]);
        let one = summarize(&[7.0]).unwrap();
        assert_eq!((one.median, one.low, one.high, one.coverage), (7.0, 7.0, 7.0, 0.0));
        let two = summarize(&[1.0, 2.0]).unwrap();
        assert_eq!((two.median, two.coverage, two.outliers.len()), (1.5, 0.5, 0));
        assert_eq!(summarize(&[]), None);
    }

    proptest! {
        #[test]
        fn the_order_does_not_matter_and_the_median_is_inside(
            mut values in proptest::collection::vec(0.0_f64..1e6, 1..60),
        ) {
            let summary = summarize(&values).unwrap();
            prop_assert!(summary.least <= summary.low && summary.low <= summary.median);
            prop_assert!(summary.median <= summary.high && summary.high <= summary.greatest);
            prop_assert!(values.len() < 6 || summary.coverage >= 0.95);
            values.reverse();
            let other = summarize(&values).unwrap();
            prop_assert_eq!((other.median, other.low, other.high), (summary.median, summary.low, summary.high));
            prop_assert_eq!(other.outliers.len(), summary.outliers.len());
        }
    }
}
