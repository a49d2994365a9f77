//! Intersections of pointer rays with planes and axes.

use glam::{DVec2, DVec3};

use crate::base::projector::{HalfLine, Projector};

/// The sine of the least angle between a ray and a plane, or a ray and an axis, at which their meeting is still
/// steady under a moving pointer: 2°.
const LEAST_SINE: f64 = 0.035;

/// Where a ray meets the plane through `point` with the unit normal `normal`, before its start excluded. `None` when
/// it runs nearly along the plane or away from it.
pub(crate) fn on_plane(ray: &HalfLine, point: DVec3, normal: DVec3) -> Option<DVec3> {
    let slope = ray.direction.dot(normal);
    if slope.abs() < LEAST_SINE {
        return None;
    }
    let distance = (point - ray.origin).dot(normal) / slope;
    (distance > 0.0 && distance.is_finite()).then(|| ray.at(distance))
}

/// How far along the axis through `point` with the unit vector `axis` lies its nearest point to a ray. `None` when
/// the two are nearly parallel, or the point would be behind the ray's start.
///
/// With a = o − p, the ray's direction d and s = d·axis the nearest points have the parameters
/// t = (a·axis − s a·d) / (1 − s²) on the axis and s t − a·d on the ray.
pub(crate) fn along_axis(ray: &HalfLine, point: DVec3, axis: DVec3) -> Option<f64> {
    let between = ray.origin - point;
    let slope = ray.direction.dot(axis);
    let sine_squared = 1.0 - slope * slope;
    if sine_squared < LEAST_SINE * LEAST_SINE {
        return None;
    }
    let along_ray = between.dot(ray.direction);
    let along_axis = (between.dot(axis) - slope * along_ray) / sine_squared;
    let distance = slope * along_axis - along_ray;
    (distance > 0.0 && along_axis.is_finite()).then_some(along_axis)
}

/// Where the ray of the pointer at `at` meets the level plane through `point`, no farther off than `limit` meters
/// from the ray's start in level measure: at the horizon the point stays at that distance, in the ray's direction.
pub(crate) fn on_level(ray: &HalfLine, point: DVec3, limit: f64) -> Option<DVec3> {
    let level = DVec3::new(ray.direction.x, 0.0, ray.direction.z);
    let run = level.length();
    let distance = (point.y - ray.origin.y) / ray.direction.y;
    let farthest = if run > 1e-9 { limit / run } else { f64::INFINITY };
    let is_met = distance > 0.0 && distance.is_finite();
    let distance = if is_met { distance.min(farthest) } else { farthest };
    let met = ray.at(distance);
    met.is_finite().then_some(DVec3::new(met.x, point.y, met.z))
}

/// The angle of a place in the picture about `center`, counterclockwise from the right, radians. `None` at the center
/// itself, where it has no direction.
pub(crate) fn angle_about(center: DVec2, at: DVec2) -> Option<f64> {
    let arm = at - center;
    (arm.length() > 1.0).then(|| (-arm.y).atan2(arm.x))
}

/// The angle of `point` about `center` in the plane of the unit vectors `first` and `second`, from the first towards
/// the second, radians.
pub(crate) fn angle_in(center: DVec3, [first, second]: [DVec3; 2], point: DVec3) -> f64 {
    let arm = point - center;
    arm.dot(second).atan2(arm.dot(first))
}

/// An angle brought to −π…π by whole turns.
pub(crate) fn wrapped(radians: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    (radians + PI).rem_euclid(TAU) - PI
}

/// Two unit vectors that make a right-handed frame with `axis`.
pub(crate) fn across(axis: DVec3) -> [DVec3; 2] {
    let first = axis.any_orthonormal_vector();
    [first, axis.cross(first)]
}

/// The direction, in the picture, in which a step along `axis` from `point` leads, and the points a meter spans there.
pub(crate) fn in_picture(projector: &Projector, point: DVec3, axis: DVec3) -> Option<DVec2> {
    let step = projector.meters_per_point(point);
    Some((projector.project(point + step * axis)? - projector.project(point - step * axis)?) / (2.0 * step))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ray(origin: [f64; 3], direction: [f64; 3]) -> HalfLine {
        HalfLine { origin: origin.into(), direction: DVec3::from(direction).normalize() }
    }

    #[test]
    fn planes_are_met_where_they_are() {
        let down = ray([0.0, 3.0, 0.0], [1.0, -1.0, 0.0]);
        let met = on_plane(&down, DVec3::ZERO, DVec3::Y).unwrap();
        assert!(met.distance(DVec3::new(3.0, 0.0, 0.0)) < 1e-12);
        // From below, too; but not backwards, and not along.
        assert!(on_plane(&ray([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]), DVec3::ZERO, DVec3::Y).is_some());
        assert_eq!(on_plane(&ray([0.0, 3.0, 0.0], [0.0, 1.0, 0.0]), DVec3::ZERO, DVec3::Y), None);
        assert_eq!(on_plane(&ray([0.0, 3.0, 0.0], [1.0, 0.0, 0.0]), DVec3::ZERO, DVec3::Y), None);
    }

    #[test]
    fn the_nearest_point_of_an_axis() {
        // The ray passes over the X axis at x = 2, one meter above it.
        let over = ray([2.0, 1.0, 5.0], [0.0, 0.0, -1.0]);
        assert!((along_axis(&over, DVec3::ZERO, DVec3::X).unwrap() - 2.0).abs() < 1e-12);
        // Slanted: it meets the Y axis through (1, 0, 0) at y = 3.
        let slanted = ray([5.0, 7.0, 4.0], [-4.0, -4.0, -4.0]);
        assert!((along_axis(&slanted, DVec3::X, DVec3::Y).unwrap() - 3.0).abs() < 1e-12);
        // Parallel, or behind.
        assert_eq!(along_axis(&ray([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]), DVec3::ZERO, DVec3::X), None);
        assert_eq!(along_axis(&ray([2.0, 1.0, 5.0], [0.0, 0.0, 1.0]), DVec3::ZERO, DVec3::X), None);
    }

    #[test]
    fn the_horizon_is_no_farther_than_the_limit() {
        let limit = 100.0;
        let mut last = 0.0;
        for slope in [-1.0, -0.1, -0.01, -0.001, 0.0, 0.001, 0.5] {
            let met = on_level(&ray([0.0, 2.0, 0.0], [0.0, slope, -1.0]), DVec3::new(7.0, 0.5, 9.0), limit);
            let met = met.unwrap();
            assert_eq!((met.x, met.y), (0.0, 0.5));
            assert!(-met.z >= last && -met.z <= limit + 1e-9, "{slope}: {met}");
            last = -met.z;
        }
        assert!((last - limit).abs() < 1e-9);
    }

    #[test]
    fn straight_down_is_met_and_straight_up_is_not() {
        let met = on_level(&ray([1.0, 2.0, 3.0], [0.0, -1.0, 0.0]), DVec3::ZERO, 10.0);
        assert_eq!(met, Some(DVec3::new(1.0, 0.0, 3.0)));
        assert_eq!(on_level(&ray([1.0, 2.0, 3.0], [0.0, 1.0, 0.0]), DVec3::ZERO, 10.0), None);
    }

    #[test]
    fn angles_are_counterclockwise() {
        use std::f64::consts::{FRAC_PI_2, PI};
        let center = DVec2::new(10.0, 10.0);
        assert_eq!(angle_about(center, DVec2::new(20.0, 10.0)), Some(0.0));
        // Up in the picture is towards smaller y.
        assert_eq!(angle_about(center, DVec2::new(10.0, 0.0)), Some(FRAC_PI_2));
        assert_eq!(angle_about(center, center), None);
        let about_y = [DVec3::Z, DVec3::X];
        assert_eq!(angle_in(DVec3::ZERO, about_y, DVec3::X), FRAC_PI_2);
        assert!((wrapped(1.5 * PI) + FRAC_PI_2).abs() < 1e-12);
        let [first, second] = across(DVec3::Y);
        assert!(first.cross(second).distance(DVec3::Y) < 1e-12);
    }
}
