//! Laws of growth, fitted to medians.

use super::least_squares::{Solution, solve};

/// A law of how a time grows with a parameter x.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GrowthLaw {
    /// t = a: it does not grow.
    Constant,
    /// t = a + b·x.
    Linear,
    /// t = a + b·x².
    Square,
    /// t = c·x^α.
    Power,
    /// t = a − b·qˣ with 0 < q < 1: it approaches a.
    Bounded,
    /// t = a + b·qˣ with q > 1: each step multiplies what is added by q.
    Geometric,
    /// t = a + b/x: a part that threads do not shorten and one that they share (G. M. Amdahl, 1967).
    Amdahl,
}

/// A coefficient and its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficient {
    /// The letter in the law's formula.
    pub symbol: &'static str,
    /// The value.
    pub value: f64,
    /// The lower end of its interval; −∞ when there are too few points to tell.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// A law with its coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Which law.
    pub law: GrowthLaw,
    /// The coefficients, in the order of the formula.
    pub coefficients: Vec<Coefficient>,
    /// The share of the variation of the values that the law explains, R², at most 1.
    pub r_squared: f64,
    /// The root of the mean squared relative residual: how far a value is from the law.
    pub error: f64,
    /// How many points it was fitted to.
    pub points: usize,
}

impl Fit {
    /// What the law says at x.
    pub fn at(&self, x: f64) -> f64 {
        let c = |index: usize| self.coefficients.get(index).map_or(0.0, |coefficient| coefficient.value);
        match self.law {
            GrowthLaw::Constant => c(0),
            GrowthLaw::Linear => c(0) + c(1) * x,
            GrowthLaw::Square => c(0) + c(1) * x * x,
            GrowthLaw::Power => c(0) * x.powf(c(1)),
            GrowthLaw::Bounded => c(0) - c(1) * c(2).powf(x),
            GrowthLaw::Geometric => c(0) + c(1) * c(2).powf(x),
            GrowthLaw::Amdahl => c(0) + c(1) / x,
        }
    }

    /// The coefficient of this letter.
    pub fn coefficient(&self, symbol: &str) -> Option<&Coefficient> {
        self.coefficients.iter().find(|coefficient| coefficient.symbol == symbol)
    }
}

/// Fits one law to points (x, t) with t > 0, so that relative residuals are least: times that differ by magnitudes weigh
/// alike. `None` when there are too few different points, or they do not determine the coefficients.
pub fn fit(law: GrowthLaw, points: &[(f64, f64)]) -> Option<Fit> {
    if points.iter().any(|&(x, t)| !(x.is_finite() && t.is_finite() && t > 0.0)) {
        return None;
    }
    match law {
        GrowthLaw::Constant => linear_in(law, points, &["a"], |_| vec![1.0]),
        GrowthLaw::Linear => linear_in(law, points, &["a", "b"], |x| vec![1.0, x]),
        GrowthLaw::Square => linear_in(law, points, &["a", "b"], |x| vec![1.0, x * x]),
        GrowthLaw::Amdahl => linear_in(law, points, &["a", "b"], |x| vec![1.0, 1.0 / x]),
        GrowthLaw::Power => power(points),
        GrowthLaw::Bounded => exponential(law, points, 1e-3, 0.999),
        GrowthLaw::Geometric => exponential(law, points, 1.001, 64.0),
    }
}

/// Of the laws that growth with generations can follow, the one that is best for its number of coefficients: the least
/// AICc (N. Sugiura, 1978; K. P. Burnham and D. R. Anderson, Model Selection and Multimodel Inference, 2002, section 2.4).
pub fn best_growth(points: &[(f64, f64)]) -> Option<Fit> {
    let laws = [GrowthLaw::Constant, GrowthLaw::Linear, GrowthLaw::Bounded, GrowthLaw::Geometric];
    let fits = laws.into_iter().filter_map(|law| fit(law, points));
    fits.min_by(|one, other| criterion(one).total_cmp(&criterion(other)))
}

/// AICc = n ln(RSS / n) + 2p + 2p(p + 1)/(n − p − 1), p counting the scatter too; infinite with too few points.
fn criterion(fit: &Fit) -> f64 {
    let (points, count) = (fit.points as f64, fit.coefficients.len() as f64 + 1.0);
    if points - count - 1.0 <= 0.0 {
        return f64::INFINITY;
    }
    // Below a millionth, laws cannot be distinguished by their residuals.
    let scatter = (fit.error * fit.error).max(1e-12);
    points * scatter.ln() + 2.0 * count + 2.0 * count * (count + 1.0) / (points - count - 1.0)
}

/// Fits a law that is linear in its coefficients.
fn linear_in(
    law: GrowthLaw,
    points: &[(f64, f64)],
    symbols: &[&'static str],
    row: impl Fn(f64) -> Vec<f64>,
) -> Option<Fit> {
    let rows: Vec<Vec<f64>> = points.iter().map(|&(x, _)| row(x)).collect();
    let solution = solve(&rows, &times(points), &weights(points))?;
    Some(finished(law, points, coefficients(symbols, &solution)))
}

/// Fits ln t = ln c + α ln x.
fn power(points: &[(f64, f64)]) -> Option<Fit> {
    if points.iter().any(|&(x, _)| x <= 0.0) {
        return None;
    }
    let rows: Vec<Vec<f64>> = points.iter().map(|&(x, _)| vec![1.0, x.ln()]).collect();
    let values: Vec<f64> = points.iter().map(|&(_, t)| t.ln()).collect();
    let solution = solve(&rows, &values, &vec![1.0; points.len()])?;
    let mut coefficients = coefficients(&["c", "α"], &solution);
    if let Some(factor) = coefficients.first_mut() {
        (factor.value, factor.low, factor.high) = (factor.value.exp(), factor.low.exp(), factor.high.exp());
    }
    Some(finished(GrowthLaw::Power, points, coefficients))
}

/// Fits t = a ± b·qˣ: for each ratio q the rest is linear; the best ratio is found on a grid and then by the golden
/// section. Its interval comes from the linearized problem.
fn exponential(law: GrowthLaw, points: &[(f64, f64)], least: f64, greatest: f64) -> Option<Fit> {
    if points.len() < 3 {
        return None;
    }
    let sign = if law == GrowthLaw::Bounded { -1.0 } else { 1.0 };
    let solved = |ratio: f64| {
        let rows: Vec<Vec<f64>> = points.iter().map(|&(x, _)| vec![1.0, sign * ratio.powf(x)]).collect();
        solve(&rows, &times(points), &weights(points))
    };
    let residual = |ratio: f64| solved(ratio).map_or(f64::INFINITY, |solution| solution.residual);
    // Even steps of the logarithm of the ratio.
    const STEPS: usize = 200;
    let ratio = |step: f64| least * (greatest / least).powf(step / STEPS as f64);
    let best = (0..=STEPS)
        .min_by(|&one, &other| residual(ratio(one as f64)).total_cmp(&residual(ratio(other as f64))))?;
    let step = golden_section(best as f64 - 1.0, best as f64 + 1.0, |step| {
        residual(ratio(step.clamp(0.0, STEPS as f64)))
    });
    let ratio = ratio(step.clamp(0.0, STEPS as f64));
    let [a, b] = <[f64; 2]>::try_from(solved(ratio)?.coefficients).ok()?;
    // What is added must grow with x, or it is no such law.
    if b <= 0.0 {
        return None;
    }
    let slopes = |x: f64| vec![1.0, sign * ratio.powf(x), sign * b * x * ratio.powf(x - 1.0)];
    let rows: Vec<Vec<f64>> = points.iter().map(|&(x, _)| slopes(x)).collect();
    let residuals: Vec<f64> = points.iter().map(|&(x, t)| t - a - sign * b * ratio.powf(x)).collect();
    let margins = solve(&rows, &residuals, &weights(points)).map(|solution| solution.margins);
    let margins = margins.unwrap_or_else(|| vec![f64::INFINITY; 3]);
    let solution = Solution { coefficients: vec![a, b, ratio], margins, residual: 0.0 };
    Some(finished(law, points, coefficients(&["a", "b", "q"], &solution)))
}

/// Where a function with one valley is least (J. Kiefer, 1953).
fn golden_section(mut low: f64, mut high: f64, value: impl Fn(f64) -> f64) -> f64 {
    let part = (5.0_f64.sqrt() - 1.0) / 2.0;
    for _ in 0..60 {
        let (left, right) = (high - part * (high - low), low + part * (high - low));
        if value(left) < value(right) { high = right } else { low = left }
    }
    0.5 * (low + high)
}

fn times(points: &[(f64, f64)]) -> Vec<f64> {
    points.iter().map(|&(_, t)| t).collect()
}

/// Weights that make residuals relative.
fn weights(points: &[(f64, f64)]) -> Vec<f64> {
    points.iter().map(|&(_, t)| 1.0 / (t * t)).collect()
}

fn coefficients(symbols: &[&'static str], solution: &Solution) -> Vec<Coefficient> {
    let found = symbols.iter().zip(&solution.coefficients).zip(&solution.margins);
    found
        .map(|((symbol, &value), margin)| Coefficient {
            symbol,
            value,
            low: value - margin,
            high: value + margin,
        })
        .collect()
}

/// The fit with its measures of error.
fn finished(law: GrowthLaw, points: &[(f64, f64)], coefficients: Vec<Coefficient>) -> Fit {
    let mut fit = Fit { law, coefficients, r_squared: 0.0, error: 0.0, points: points.len() };
    let count = points.len() as f64;
    // A power law is a line of logarithms, and its R² is that line's.
    let scale = |t: f64| if law == GrowthLaw::Power { t.ln() } else { t };
    let mean = points.iter().map(|&(_, t)| scale(t)).sum::<f64>() / count;
    let squares =
        |term: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(|point| term(point).powi(2)).sum::<f64>();
    let variation = squares(&|&(_, t)| scale(t) - mean);
    let rest = squares(&|&(x, t)| scale(t) - scale(fit.at(x)));
    fit.r_squared = if variation > 0.0 { 1.0 - rest / variation } else { 0.0 };
    fit.error = (squares(&|&(x, t)| (t - fit.at(x)) / t) / count).sqrt();
    fit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Points of a law, each off by up to this relative error.
    fn points(xs: &[f64], error: f64, law: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let mut random = Random::new(7);
        xs.iter().map(|&x| (x, law(x) * (1.0 + random.number(-error, error)))).collect()
    }

    fn generations() -> Vec<f64> {
        (1..=12).map(f64::from).collect()
    }

    fn assert_near(fit: &Fit, expected: &[(&str, f64)], tolerance: f64) {
        for (symbol, value) in expected {
            let found = fit.coefficient(symbol).unwrap();
            assert!((found.value / value - 1.0).abs() < tolerance, "{symbol}: {found:?}, {value} expected");
            assert!(found.low <= found.value && found.value <= found.high);
        }
    }

    #[test]
    fn exact_laws_are_found_exactly() {
        let xs = [1.0, 2.0, 4.0, 8.0, 16.0];
        let line = fit(GrowthLaw::Linear, &points(&xs, 0.0, |x| 3.0 + 0.5 * x)).unwrap();
        assert_near(&line, &[("a", 3.0), ("b", 0.5)], 1e-9);
        assert!((line.r_squared - 1.0).abs() < 1e-12 && line.error < 1e-9);
        let square = fit(GrowthLaw::Square, &points(&xs, 0.0, |x| 2.0 + 0.25 * x * x)).unwrap();
        assert_near(&square, &[("a", 2.0), ("b", 0.25)], 1e-9);
        let power = fit(GrowthLaw::Power, &points(&xs, 0.0, |x| 5.0 * x.powf(0.4))).unwrap();
        assert_near(&power, &[("c", 5.0), ("α", 0.4)], 1e-9);
        let amdahl = fit(GrowthLaw::Amdahl, &points(&xs, 0.0, |x| 2.0 + 30.0 / x)).unwrap();
        assert_near(&amdahl, &[("a", 2.0), ("b", 30.0)], 1e-9);
        assert!((amdahl.at(4.0) - 9.5).abs() < 1e-9);
    }

    #[test]
    fn intervals_hold_the_truth_under_noise() {
        let xs = [100.0, 300.0, 1e3, 3e3, 1e4, 3e4, 1e5];
        let power = fit(GrowthLaw::Power, &points(&xs, 0.05, |x| 0.02 * x.powf(0.33))).unwrap();
        let exponent = power.coefficient("α").unwrap();
        assert!(exponent.low < 0.33 && 0.33 < exponent.high, "{exponent:?}");
        assert!(exponent.high - exponent.low < 0.1 && power.r_squared > 0.99);
        assert!((0.005..0.05).contains(&power.error), "{}", power.error);
    }

    #[test]
    fn growth_is_named_as_it_is() {
        let bounded = best_growth(&points(&generations(), 0.005, |x| 40.0 - 30.0 * 0.5_f64.powf(x))).unwrap();
        assert_eq!(bounded.law, GrowthLaw::Bounded);
        assert_near(&bounded, &[("a", 40.0), ("q", 0.5)], 0.05);
        let doubling = best_growth(&points(&generations(), 0.01, |x| 3.0 + 0.2 * 2.0_f64.powf(x))).unwrap();
        assert_eq!(doubling.law, GrowthLaw::Geometric);
        let ratio = doubling.coefficient("q").unwrap();
        assert!(ratio.low < 2.0 && 2.0 < ratio.high && ratio.high - ratio.low < 0.1, "{ratio:?}");
        let line = best_growth(&points(&generations(), 0.005, |x| 5.0 + 2.0 * x)).unwrap();
        assert_eq!(line.law, GrowthLaw::Linear);
        assert_near(&line, &[("b", 2.0)], 0.02);
        let level = best_growth(&points(&generations(), 0.01, |_| 7.0)).unwrap();
        assert_eq!(level.law, GrowthLaw::Constant);
        assert_near(&level, &[("a", 7.0)], 0.01);
    }

    #[test]
    fn counts_of_a_full_tree_double() {
        let full = best_growth(&points(&generations(), 0.0, |x| 2.0_f64.powf(x) - 1.0)).unwrap();
        assert_eq!(full.law, GrowthLaw::Geometric);
        assert_near(&full, &[("a", -1.0), ("b", 1.0), ("q", 2.0)], 1e-4);
    }

    #[test]
    fn what_determines_no_law_gives_none() {
        for law in [
            GrowthLaw::Linear,
            GrowthLaw::Square,
            GrowthLaw::Power,
            GrowthLaw::Bounded,
            GrowthLaw::Geometric,
            GrowthLaw::Amdahl,
        ] {
            assert_eq!(fit(law, &[]), None);
            assert_eq!(fit(law, &[(1.0, 2.0)]), None, "{law:?}");
            assert_eq!(fit(law, &[(1.0, 2.0), (1.0, 3.0), (1.0, 2.5)]), None, "{law:?}");
            assert_eq!(fit(law, &[(1.0, 2.0), (2.0, f64::NAN), (3.0, 1.0), (4.0, 1.0)]), None);
            assert_eq!(fit(law, &[(1.0, 2.0), (2.0, 0.0), (3.0, 1.0), (4.0, 1.0)]), None);
        }
        assert_eq!(fit(GrowthLaw::Power, &[(0.0, 1.0), (1.0, 2.0), (2.0, 3.0)]), None);
        assert_eq!(best_growth(&[]), None);
    }
}
