//! The area of the view in which a body can be visible, and the lattice over it.

use std::ops::Range;

use catoptric_scene::Body;
use catoptric_tracer::RenderCamera;
use glam::DVec2;

/// Cells of a lattice, pixels: coarse enough for a whole view, fine enough for what people point at.
const LARGEST_CELL: f64 = 8.0;
const SMALLEST_CELL: f64 = 0.25;

/// The cell for a body that is so many pixels across where it is narrowest: at least 8 cells, of 4 pixels if there is
/// room, and larger ones for what is very large. Corners are refined anyway.
fn cell_for(width: f64) -> f64 {
    (width / 8.0).min((width / 32.0).max(4.0)).clamp(SMALLEST_CELL, LARGEST_CELL)
}

/// About the most points that are looked at for one body.
const MOST_POINTS: f64 = 100_000.0;

/// A lattice over a part of the view.
#[derive(Clone, Debug)]
pub(super) struct Area {
    min: DVec2,
    max: DVec2,
    cell: f64,
    /// The corners of a convex region outside of which nothing is, in order; empty if nothing is known.
    hull: Vec<DVec2>,
}

impl Area {
    /// The whole of a view.
    pub(super) fn whole(size: DVec2, cell: f64) -> Self {
        let cell = cell.max((size.x * size.y / MOST_POINTS).sqrt());
        Self { min: DVec2::ZERO, max: size, cell, hull: Vec::new() }
    }

    /// Where these bodies can be in a view; `None` if they are out of sight.
    pub(super) fn of_bodies<'a>(
        bodies: impl Iterator<Item = &'a Body>,
        camera: &RenderCamera,
        size: DVec2,
    ) -> Option<Self> {
        let mut corners = Vec::new();
        for body in bodies {
            let Some(box_corners) = body.box_corners() else { return Some(Self::whole(size, LARGEST_CELL)) };
            for corner in box_corners {
                match camera.project(corner, size) {
                    Some((at, _)) => corners.push(at),
                    // A box that reaches behind the eye can be anywhere.
                    None => return Some(Self::whole(size, LARGEST_CELL)),
                }
            }
        }
        let hull = convex_hull(corners);
        let mut cell = cell_for(width_of(&hull));
        let low = hull.iter().fold(DVec2::INFINITY, |low, &at| low.min(at));
        let high = hull.iter().fold(DVec2::NEG_INFINITY, |high, &at| high.max(at));
        let seen = (high.min(size) - low.max(DVec2::ZERO)).max(DVec2::ZERO);
        cell = cell.max(((seen.x * seen.y).min(area_of(&hull)) / MOST_POINTS).sqrt());
        let [min, max] = [low - 2.0 * cell, high + 2.0 * cell].map(|corner| corner.clamp(DVec2::ZERO, size));
        (min.cmplt(max).all()).then_some(Self { min, max, cell, hull })
    }

    /// Points of the lattice in a row.
    pub(super) fn columns(&self) -> usize {
        ((self.max.x - self.min.x) / self.cell).ceil() as usize + 1
    }

    /// Rows of the lattice.
    pub(super) fn rows(&self) -> usize {
        ((self.max.y - self.min.y) / self.cell).ceil() as usize + 1
    }

    /// A point of the lattice; the last ones lie on the area's border.
    pub(super) fn point(&self, column: usize, row: usize) -> DVec2 {
        (self.min + self.cell * DVec2::new(column as f64, row as f64)).min(self.max)
    }

    /// The columns of a row where something can be, with a cell to spare.
    pub(super) fn span(&self, row: usize) -> Range<usize> {
        if self.hull.is_empty() {
            return 0..self.columns();
        }
        let y = self.point(0, row).y;
        let (low, high) = (y - self.cell, y + self.cell);
        let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
        let following = self.hull.iter().cycle().skip(1);
        for (one, other) in self.hull.iter().zip(following) {
            let (upper, lower) = if one.y <= other.y { (one, other) } else { (other, one) };
            if lower.y < low || upper.y > high {
                continue;
            }
            let slope = (lower.x - upper.x) / (lower.y - upper.y);
            let x_at = |y: f64| upper.x + slope * (y - upper.y);
            let ends = if slope.is_finite() {
                [x_at(low.max(upper.y)), x_at(high.min(lower.y))]
            } else {
                [upper.x, lower.x]
            };
            left = left.min(ends[0]).min(ends[1]);
            right = right.max(ends[0]).max(ends[1]);
        }
        // Of what is not a number or below 0, the cast makes 0.
        let start = ((left - self.min.x) / self.cell - 1.0).floor() as usize;
        let end = ((right - self.min.x) / self.cell + 2.0).ceil() as usize;
        let end = end.min(self.columns());
        if start < end { start..end } else { 0..0 }
    }
}

/// The corners of the convex hull in order (Andrew 1979, the monotone chain).
fn convex_hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(point - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        // The last point is the first of the other half.
        chain.pop();
        chain
    };
    if points.len() < 2 {
        return points;
    }
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

/// The least distance between parallel lines that hold a convex polygon.
fn width_of(hull: &[DVec2]) -> f64 {
    let following = hull.iter().cycle().skip(1);
    let width = hull.iter().zip(following).filter_map(|(&one, &other)| {
        let across = (other - one).perp().try_normalize()?;
        Some(hull.iter().map(|&point| (point - one).dot(across).abs()).fold(0.0, f64::max))
    });
    width.reduce(f64::min).unwrap_or(0.0)
}

/// The area of a convex polygon.
fn area_of(hull: &[DVec2]) -> f64 {
    let following = hull.iter().cycle().skip(1);
    0.5 * hull.iter().zip(following).map(|(&one, &other)| one.perp_dot(other)).sum::<f64>().abs()
}

#[cfg(test)]
mod tests {
    use super::super::contour::contours;
    use catoptric_scene::Shape;
    use glam::DVec3;

    use super::super::tests::one_body;
    use super::*;

    #[test]
    fn the_hull_of_a_square_with_points_inside_is_the_square() {
        let mut points: Vec<DVec2> =
            [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)].map(DVec2::from).to_vec();
        let corners = points.clone();
        points.extend([(1.0, 1.0), (2.0, 0.0), (4.0, 1.5)].map(DVec2::from));
        let hull = convex_hull(points);
        assert_eq!(hull.len(), 4);
        assert!(corners.iter().all(|corner| hull.contains(corner)));
        assert_eq!((width_of(&hull), area_of(&hull)), (3.0, 12.0));
        assert_eq!(convex_hull(vec![DVec2::ONE; 5]), [DVec2::ONE]);
        assert_eq!(width_of(&[DVec2::ONE]), 0.0);
    }

    #[test]
    fn spans_hold_the_hull_of_every_row() {
        let hull = convex_hull([(10.0, 5.0), (180.0, 60.0), (30.0, 90.0)].map(DVec2::from).to_vec());
        let area = Area { min: DVec2::ZERO, max: DVec2::new(200.0, 100.0), cell: 3.0, hull };
        let inside = |at: DVec2| {
            let hull = &area.hull;
            (0..3).all(|k| (hull[(k + 1) % 3] - hull[k]).perp_dot(at - hull[k]) >= 0.0)
        };
        let mut seen = 0;
        for row in 0..area.rows() {
            for column in 0..area.columns() {
                if inside(area.point(column, row)) {
                    seen += 1;
                    assert!(area.span(row).contains(&column));
                }
            }
        }
        assert!(seen > 500, "{seen}");
    }

    #[test]
    fn rows_beside_the_hull_have_empty_spans() {
        let hull = convex_hull([(10.0, 40.0), (180.0, 40.0), (90.0, 60.0)].map(DVec2::from).to_vec());
        let area = Area { min: DVec2::ZERO, max: DVec2::new(200.0, 100.0), cell: 2.0, hull };
        assert_eq!((area.span(0), area.span(area.rows() - 1)), (0..0, 0..0));
        assert!(area.span(25).len() > 20);
    }

    #[test]
    fn contours_within_the_hull_are_those_of_the_whole_box() {
        let size = DVec2::new(640.0, 360.0);
        for (shape, turns) in [
            (Shape::SPHERE, DVec3::ZERO),
            (Shape::Cube { size: DVec3::new(3.0, 0.02, 0.02) }, DVec3::new(10.0, 20.0, 33.0)),
            (Shape::Cube { size: DVec3::new(30.0, 0.1, 0.1) }, DVec3::new(0.0, 0.0, 8.0)),
            (Shape::Cylinder { radius: 0.4, height: 1.5 }, DVec3::new(70.0, 0.0, 40.0)),
            (Shape::CONE, DVec3::new(0.0, 0.0, 120.0)),
        ] {
            let (render_scene, area) = one_body(shape, DVec3::new(0.2, 1.0, 0.0), turns, size);
            let is_inside =
                |at: DVec2| render_scene.closest_hit(&render_scene.camera().ray(at, size)).is_some();
            let whole = Area { hull: Vec::new(), ..area.clone() };
            let found = contours(&area, &is_inside);
            assert!(!found.is_empty(), "{shape:?}");
            assert_eq!(found, contours(&whole, &is_inside), "{shape:?}");
        }
    }
}
