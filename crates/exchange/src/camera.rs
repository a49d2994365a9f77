//! Angles of view.

use glam::DVec3;

/// The vertical angle of view of a picture whose horizontal one is given, degrees.
pub(crate) fn vertical_from_horizontal(horizontal_degrees: f64, [width, height]: [u32; 2]) -> f64 {
    let half = (0.5 * horizontal_degrees).to_radians().tan() * f64::from(height) / f64::from(width);
    2.0 * half.atan().to_degrees()
}

/// The inverse of [`vertical_from_horizontal`].
pub(crate) fn horizontal_from_vertical(vertical_degrees: f64, [width, height]: [u32; 2]) -> f64 {
    vertical_from_horizontal(vertical_degrees, [height, width])
}

/// +Y, or what replaces it for a camera that looks along it: −Z for one that looks down, +Z for one that looks up.
pub(crate) fn up_for(direction: DVec3) -> DVec3 {
    let is_vertical = direction.x.hypot(direction.z) <= 1e-9 * direction.y.abs();
    if !is_vertical {
        DVec3::Y
    } else if direction.y < 0.0 {
        DVec3::NEG_Z
    } else {
        DVec3::Z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_follow_the_sides() {
        assert!((vertical_from_horizontal(90.0, [200, 100]) - 53.130_102_354_155_98).abs() < 1e-12);
        assert!(
            (horizontal_from_vertical(vertical_from_horizontal(70.0, [16, 9]), [16, 9]) - 70.0).abs() < 1e-12
        );
    }
}
