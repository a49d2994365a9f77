//! Steps of snapping, and digits that suit the precision of the pointer.

use glam::DVec3;

/// The step of snapping when moving, meters.
pub(crate) const MOVE: f64 = 0.1;
/// When turning, degrees.
pub(crate) const TURN: f64 = 15.0;
/// When scaling.
pub(crate) const SCALE: f64 = 0.1;

/// `value` rounded to whole steps.
pub(crate) fn rounded(value: f64, step: f64) -> f64 {
    let inverse = 1.0 / step;
    // Dividing by the inverse gives the shorter decimals: 3 / 10 is 0.3, and 3 · 0.1 is not.
    if step < 1.0 { (value * inverse).round() / inverse.round() } else { (value * inverse).round() * step }
}

/// The power of ten that is at most a third of `meters`: finer digits mean nothing.
pub(crate) fn decimal_below(meters: f64) -> f64 {
    let exponent = (meters / 3.0).log10().floor();
    if exponent.is_finite() { 10_f64.powi(exponent.clamp(-9.0, 9.0) as i32) } else { 1e-3 }
}

/// A move whose parts along the world's axes that `moves` names bring `lead` to whole steps.
pub(crate) fn to_grid(step: DVec3, lead: DVec3, moves: [bool; 3], grid: f64) -> DVec3 {
    let mut result = step;
    for axis in 0..3 {
        if moves.get(axis).copied().unwrap_or_default() {
            result[axis] = rounded(lead[axis] + step[axis], grid) - lead[axis];
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(rounded(0.34, 0.1), 0.3);
        assert_eq!(rounded(-0.36, 0.1), -0.4);
        assert_eq!(rounded(22.0, 15.0), 15.0);
        assert_eq!(rounded(1.234_567, 0.001), 1.235);
        assert_eq!(rounded(123.4, 10.0), 120.0);
        assert_eq!(decimal_below(0.01), 0.001);
        assert_eq!(decimal_below(0.3), 0.1);
        assert_eq!(decimal_below(0.0), 1e-3);
    }

    #[test]
    fn the_grid_is_the_worlds_and_only_along_what_moves() {
        let lead = DVec3::new(0.234, 0.567, 0.0);
        let step = to_grid(DVec3::new(0.31, 0.0, 0.0), lead, [true, false, false], 0.1);
        assert_eq!(lead + step, DVec3::new(0.5, 0.567, 0.0));
    }
}
