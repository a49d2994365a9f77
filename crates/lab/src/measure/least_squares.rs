//! Least squares of a few coefficients, and how sure these are.

/// The coefficients of least squares.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Solution {
    pub coefficients: Vec<f64>,
    /// Half the width of the 95 % interval of each coefficient, from the scatter about the fit and Student's t;
    /// infinite when there are no more points than coefficients.
    pub margins: Vec<f64>,
    /// The weighted sum of the squared residuals.
    pub residual: f64,
}

/// Finds c that makes Σ wᵢ (yᵢ − Σⱼ cⱼ xᵢⱼ)² least, by the normal equations; `None` when the columns depend on each
/// other or something is not finite.
pub(super) fn solve(rows: &[Vec<f64>], values: &[f64], weights: &[f64]) -> Option<Solution> {
    let count = rows.first()?.len();
    let mut normal = vec![vec![0.0; count]; count];
    let mut right = vec![0.0; count];
    for ((row, value), weight) in rows.iter().zip(values).zip(weights) {
        for ((line, right), one) in normal.iter_mut().zip(&mut right).zip(row) {
            *right += weight * one * value;
            line.iter_mut().zip(row).for_each(|(sum, other)| *sum += weight * one * other);
        }
    }
    let inverse = inverted(normal)?;
    let product = |line: &[f64], column: &[f64]| line.iter().zip(column).map(|(a, b)| a * b).sum::<f64>();
    let coefficients: Vec<f64> = inverse.iter().map(|line| product(line, &right)).collect();
    let residuals = rows.iter().zip(values).zip(weights).map(|((row, value), weight)| {
        let residual = value - product(row, &coefficients);
        weight * residual * residual
    });
    let residual: f64 = residuals.sum();
    let freedom = values.len().checked_sub(count)?;
    let scatter = residual / freedom as f64;
    let diagonal = inverse.iter().enumerate().filter_map(|(index, line)| line.get(index));
    let margins = match freedom {
        0 => vec![f64::INFINITY; count],
        _ => diagonal.map(|variance| student(freedom) * (scatter * variance).max(0.0).sqrt()).collect(),
    };
    coefficients.iter().all(|value| value.is_finite()).then_some(Solution { coefficients, margins, residual })
}

/// The inverse by Gauss and Jordan with pivots.
fn inverted(mut matrix: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let count = matrix.len();
    for (index, line) in matrix.iter_mut().enumerate() {
        line.extend((0..count).map(|column| f64::from(u8::from(column == index))));
    }
    // What is lost of a column's size when the others are taken away tells whether it depends on them.
    let sizes: Vec<f64> = (0..count).filter_map(|index| matrix.get(index)?.get(index).copied()).collect();
    for column in 0..count {
        let size = |line: &Vec<f64>| line.get(column).map_or(0.0, |value| value.abs());
        let below = matrix.iter().enumerate().skip(column);
        let (pivot, _) = below.max_by(|(_, one), (_, other)| size(one).total_cmp(&size(other)))?;
        matrix.swap(column, pivot);
        let mut line = matrix.get(column)?.clone();
        let head = *line.get(column)?;
        if !head.is_finite() || head.abs() <= 1e-14 * sizes.get(column)?.abs() {
            return None;
        }
        line.iter_mut().for_each(|value| *value /= head);
        for (index, other) in matrix.iter_mut().enumerate() {
            let factor = if index == column { 0.0 } else { *other.get(column)? };
            other.iter_mut().zip(&line).for_each(|(value, of_line)| *value -= factor * of_line);
        }
        *matrix.get_mut(column)? = line;
    }
    Some(matrix.into_iter().map(|line| line.into_iter().skip(count).collect()).collect())
}

/// The value that Student's t of so many degrees of freedom exceeds to either side with the chance 0.05.
///
/// The distribution is M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, 1964, 26.7.3 and 26.7.4, turned
/// around by bisection.
pub(super) fn student(freedom: usize) -> f64 {
    if freedom > 1000 {
        return 1.96; // the normal distribution's, which is 1 ‰ less
    }
    let (mut low, mut high) = (0.0, 16.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if within(middle, freedom) < 0.95 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The chance that Student's t lies within ±t.
fn within(t: f64, freedom: usize) -> f64 {
    let angle = (t / (freedom as f64).sqrt()).atan();
    let (sine, cosine) = angle.sin_cos();
    let odd = !freedom.is_multiple_of(2);
    let (mut term, mut sum) = if odd { (cosine, 0.0) } else { (1.0, 0.0) };
    let mut power = if odd { 1 } else { 0 };
    while power + 2 <= freedom {
        sum += term;
        let next = power as f64 + 2.0;
        term *= cosine * cosine * (next - 1.0) / next;
        power += 2;
    }
    if odd { (angle + sine * sum) * std::f64::consts::FRAC_2_PI } else { sine * sum }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn students_t_is_that_of_the_tables() {
        for (freedom, t) in [
            (1, 12.706),
            (2, 4.303),
            (3, 3.182),
            (4, 2.776),
            (5, 2.571),
            (6, 2.447),
            (9, 2.262),
            (10, 2.228),
            (30, 2.042),
            (120, 1.980),
        ] {
            assert!((student(freedom) - t).abs() < 6e-4, "{freedom}: {}", student(freedom));
        }
    }

    #[test]
    fn a_line_by_hand() {
        // The line through (1, 1), (2, 2), (3, 4): slope 3/2, intercept −2/3, residual 1/6.
        let rows: Vec<Vec<f64>> = [1.0, 2.0, 3.0].map(|x| vec![1.0, x]).to_vec();
        let found = solve(&rows, &[1.0, 2.0, 4.0], &[1.0; 3]).unwrap();
        assert!(
            (found.coefficients[0] + 2.0 / 3.0).abs() < 1e-12 && (found.coefficients[1] - 1.5).abs() < 1e-12
        );
        assert!((found.residual - 1.0 / 6.0).abs() < 1e-12);
        // Variance of the slope: (1/6) / Σ(x − 2)² = 1/12.
        assert!((found.margins[1] - 12.706 * (1.0_f64 / 12.0).sqrt()).abs() < 1e-3);
    }

    #[test]
    fn what_has_no_answer_has_none() {
        let same = [vec![1.0, 2.0], vec![1.0, 2.0], vec![1.0, 2.0]];
        assert_eq!(solve(&same, &[1.0, 2.0, 3.0], &[1.0; 3]), None);
        assert_eq!(solve(&[], &[], &[]), None);
        assert_eq!(solve(&[vec![1.0, 2.0]], &[1.0], &[1.0]), None);
        let rows = [vec![1.0, 1.0], vec![1.0, 2.0]];
        assert_eq!(solve(&rows, &[1.0, f64::NAN], &[1.0; 2]), None);
        assert_eq!(solve(&rows, &[1.0, 2.0], &[1.0; 2]).unwrap().margins, [f64::INFINITY; 2]);
    }
}
