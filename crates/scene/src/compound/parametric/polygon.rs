//! Flat pieces between straight edges.

use glam::DVec3;

use super::{Expansion, MARGIN, cuboid, half_space};
use crate::shape::{Shape, VisibleSide};

/// Corners may lie beside their plane by this share of the longest side, as those of files with six digits do; and those of
/// a triangle are on a line if it is not higher.
pub(super) const FLAT: f64 = 1e-6;

/// The longest side of a polygon, meters.
pub(super) fn longest_side(corners: &[DVec3]) -> f64 {
    sides(corners).map(|[from, to]| from.distance(to)).fold(0.0, f64::max)
}

/// The normal of a polygon's plane, by twice its area as long (Newell; Sutherland et al. 1974, A Characterization of Ten
/// Hidden-Surface Algorithms). It is on the side from which the corners go around against the clock.
pub(super) fn normal(corners: &[DVec3]) -> DVec3 {
    let first = corners.first().copied().unwrap_or_default();
    sides(corners).map(|[from, to]| (from - first).cross(to - first)).sum()
}

fn sides(corners: &[DVec3]) -> impl Iterator<Item = [DVec3; 2]> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(from, to)| [*from, *to])
}

/// The piece of a plane within the sides of a polygon that is known to be flat and convex. The box only tells searches where
/// it is.
pub(super) fn expansion(side: VisibleSide, corners: &[DVec3]) -> Expansion {
    let normal = normal(corners);
    let middle = corners.iter().sum::<DVec3>() / corners.len().max(1) as f64;
    let around = DVec3::splat(MARGIN * longest_side(corners));
    let least = corners.iter().copied().fold(DVec3::INFINITY, DVec3::min) - around;
    let greatest = corners.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max) + around;
    let lines = sides(corners).filter(|[from, to]| from != to);
    let cutters = lines.map(|[from, to]| half_space(0.5 * (from + to), (to - from).cross(normal)));
    Expansion::surface(side, half_space(middle, normal), cutters.chain([cuboid([least, greatest])]))
}

impl Expansion {
    /// A flat polygon with its corners in their order, meters. Its outer side is the one from which they go around against
    /// the clock. `None` for one with fewer than three corners, more than a
    /// body can have parts for, no area, a notch, or corners beside its plane.
    pub fn convex_polygon(corners: &[DVec3]) -> Option<Self> {
        let most = Shape::MAX_PARTS - 2;
        let (normal, size) = (normal(corners), longest_side(corners));
        let normal_length = normal.length();
        let is_known = (3..=most).contains(&corners.len()) && normal_length.is_finite();
        if !is_known || normal_length <= FLAT * size * size {
            return None;
        }
        let normal = normal / normal_length;
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let is_flat = corners.iter().all(|corner| (corner - middle).dot(normal).abs() <= FLAT * size);
        // All corners lie on the left of each side.
        let is_convex = sides(corners).all(|[from, to]| {
            let left = normal.cross(to - from).normalize_or_zero();
            corners.iter().all(|corner| (corner - from).dot(left) >= -FLAT * size)
        });
        (is_flat && is_convex).then(|| expansion(VisibleSide::Both, corners))
    }
}
