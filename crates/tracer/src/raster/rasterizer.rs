//! Faces become pixels.
//!
//! Triangles are drawn in homogeneous coordinates (Olano, Greer 1997, Triangle Scan Conversion using 2D Homogeneous
//! Coordinates): what lies behind the eye drops out of the signs of the edge functions, so that no triangle is clipped and
//! none is too near. Everything is computed in double precision at the sample's place, the very place that the tracer
//! sends its ray through.

use std::ops::Range;

use glam::{DVec2, DVec3};

use crate::raster::projection::HomogeneousPoint;
use crate::raster::sample_sums::FrameSize;
use crate::simd::vector::Vector;

/// A corner of a face, with what is interpolated across the face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleCorner {
    pub(crate) seen: HomogeneousPoint,
    /// The point in the body's frame, for the checkerboard.
    pub(crate) in_body: Vector<f32>,
    /// Light on the color and highlight, or place and normal.
    pub(crate) values: [Vector<f32>; 2],
}

/// What a pixel shows so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fragment {
    /// Distance along the view, meters.
    pub(crate) depth: f64,
    /// [`RayOrigin::word`](crate::RayOrigin) of the body and side.
    pub(crate) start: u32,
    /// As of the [`TriangleCorner`]s.
    pub(crate) in_body: Vector<f32>,
    /// As of the [`TriangleCorner`]s.
    pub(crate) values: [Vector<f32>; 2],
}

impl Fragment {
    /// Nothing.
    pub(crate) const EMPTY: Self = {
        let nothing = Vector { x: 0.0, y: 0.0, z: 0.0 };
        Self { depth: f64::INFINITY, start: u32::MAX, in_body: nothing, values: [nothing; 2] }
    };

    pub(crate) fn is_empty(&self) -> bool {
        self.depth == f64::INFINITY
    }
}

/// A triangle in the picture.
#[derive(Clone, Debug)]
pub(crate) struct ScreenTriangle {
    /// E_i·(x, y, 1) ≥ 0 on the inner side of the edge opposite corner i; in proportion, the corner's share of the point.
    edges: [DVec3; 3],
    corners: [u32; 3],
    depths: [f64; 3],
    start: u32,
    /// Whether the values are the same at all corners: then they are not interpolated, and not rounded.
    is_even: bool,
    rows: Range<usize>,
    columns: Range<usize>,
}

impl ScreenTriangle {
    /// The triangle of these corners of `all`; `None` if it has no area or cannot be seen.
    pub(crate) fn new(
        all: &[TriangleCorner],
        corners: [u32; 3],
        start: u32,
        frame: FrameSize,
    ) -> Option<Self> {
        let [a, b, c] = corners.map(|corner| all.get(corner as usize).map(|corner| corner.seen));
        let seen = [a?, b?, c?];
        let [a, b, c] = seen.map(|corner| corner.at);
        let edges = [edge(b, c), edge(c, a), edge(a, b)];
        let determinant = edges[0].dot(a);
        if !(determinant.abs() > 0.0 && determinant.is_finite()) {
            return None;
        }
        let (rows, columns) = extent([a, b, c], frame)?;
        let mut values = corners.iter().map(|&corner| all.get(corner as usize).map(|corner| corner.values));
        let first = values.next()?;
        Some(Self {
            edges: edges.map(|edge| edge * determinant.signum()),
            corners,
            depths: seen.map(|corner| corner.depth),
            start,
            is_even: values.all(|other| other == first),
            rows,
            columns,
        })
    }

    /// The rows of `band` that it may reach.
    pub(crate) fn rows_within(&self, band: Range<usize>) -> Range<usize> {
        self.rows.start.max(band.start)..self.rows.end.min(band.end)
    }

    /// Draws what lies in row `y` of the picture, whose fragments these are; samples lie at `offset` in their pixels.
    pub(crate) fn draw(&self, all: &[TriangleCorner], y: usize, offset: DVec2, row: &mut [Fragment]) {
        let at_y = y as f64 + offset.y;
        let rest = self.edges.map(|edge| edge.y * at_y + edge.z);
        let columns = self.columns_of(rest, offset.x);
        let Some(fragments) = row.get_mut(columns.clone()) else { return };
        for (x, fragment) in columns.zip(fragments) {
            let at_x = x as f64 + offset.x;
            let shares = [0, 1, 2].map(|i| self.edges[i].x * at_x + rest[i]);
            let sum = shares[0] + shares[1] + shares[2];
            // The sum is in proportion to 1/w: what is not before the eye is not seen.
            if shares.iter().all(|share| *share >= 0.0) && sum > 0.0 {
                let shares = shares.map(|share| share / sum);
                let depth: f64 = shares.iter().zip(self.depths).map(|(share, depth)| share * depth).sum();
                if depth > 0.0 && depth < fragment.depth {
                    *fragment = self.fragment(all, shares, depth);
                }
            }
        }
    }

    /// Which columns of a row can be inside of all edges, one more on either side.
    fn columns_of(&self, rest: [f64; 3], offset: f64) -> Range<usize> {
        let Range { mut start, mut end } = self.columns;
        for (edge, rest) in self.edges.iter().zip(rest) {
            let crossing = -rest / edge.x - offset;
            if edge.x > 0.0 {
                start = start.max((crossing - 1.0).max(0.0) as usize);
            } else if edge.x < 0.0 {
                end = end.min((crossing + 2.0).max(0.0) as usize);
            }
        }
        start..end.max(start)
    }

    fn fragment(&self, all: &[TriangleCorner], shares: [f64; 3], depth: f64) -> Fragment {
        let mut fragment = Fragment { depth, start: self.start, ..Fragment::EMPTY };
        for (corner, share) in self.corners.iter().zip(shares) {
            let Some(corner) = all.get(*corner as usize) else { continue };
            let share = share as f32;
            fragment.in_body = fragment.in_body + corner.in_body * share;
            for (sum, value) in fragment.values.iter_mut().zip(corner.values) {
                *sum = if self.is_even { value } else { *sum + value * share };
            }
        }
        fragment
    }
}

/// The edge function of the line through two points: their cross product, taken in one order whoever asks. So it is the
/// same but for the sign in the two triangles at the edge, and no pixel between them is missed.
fn edge(a: DVec3, b: DVec3) -> DVec3 {
    if a.to_array() <= b.to_array() { a.cross(b) } else { -b.cross(a) }
}

/// Rows and columns that a triangle reaches, if any: those of the part before the eye.
fn extent(corners: [DVec3; 3], frame: FrameSize) -> Option<(Range<usize>, Range<usize>)> {
    /// Of the largest w: what is nearer to the eye lies beside the picture, or at one point of it.
    const NEAR: f64 = 1e-9;
    let near = NEAR * corners.iter().map(|corner| corner.z).fold(0.0, f64::max);
    let (mut least, mut most) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let mut take = |corner: DVec3| {
        let at = corner.truncate() / corner.z;
        (least, most) = (least.min(at), most.max(at));
    };
    for (a, b) in [(0, 1), (1, 2), (2, 0)].map(|(a, b)| (corners[a], corners[b])) {
        if a.z > near {
            take(a);
        }
        if (a.z > near) != (b.z > near) {
            let mut at = a + (b - a) * ((near - a.z) / (b.z - a.z));
            at.z = near;
            take(at);
        }
    }
    // Samples lie anywhere in their pixels.
    let range = |least: f64, most: f64, count: usize| {
        let range = (least - 1.0).max(0.0) as usize..((most + 2.0).max(0.0) as usize).min(count);
        (most >= least && !range.is_empty()).then_some(range)
    };
    Some((range(least.y, most.y, frame.height)?, range(least.x, most.x, frame.width)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(x: f64, y: f64, w: f64) -> TriangleCorner {
        let at = HomogeneousPoint { at: DVec3::new(x * w, y * w, w), depth: w };
        let value = Vector { x: w as f32, y: x as f32, z: y as f32 };
        TriangleCorner { seen: at, in_body: value, values: [value; 2] }
    }

    fn draw(corners: &[TriangleCorner], triangles: &[[u32; 3]]) -> Vec<Vec<Fragment>> {
        let frame = FrameSize { width: 16, height: 12 };
        let mut rows = vec![vec![Fragment::EMPTY; frame.width]; frame.height];
        for (number, triangle) in triangles.iter().enumerate() {
            let Some(triangle) = ScreenTriangle::new(corners, *triangle, number as u32, frame) else {
                continue;
            };
            for (y, row) in rows.iter_mut().enumerate() {
                triangle.draw(corners, y, DVec2::splat(0.5), row);
            }
        }
        rows
    }

    #[test]
    fn a_square_of_two_triangles_covers_its_pixels_once_each() {
        let corners = [(2.0, 1.0), (10.0, 1.0), (10.0, 9.0), (2.0, 9.0)].map(|(x, y)| corner(x, y, 3.0));
        let rows = draw(&corners, &[[0, 1, 2], [0, 2, 3]]);
        for (y, row) in rows.iter().enumerate() {
            for (x, fragment) in row.iter().enumerate() {
                let inside = (2..10).contains(&x) && (1..9).contains(&y);
                assert_eq!(!fragment.is_empty(), inside, "{x}, {y}");
            }
        }
    }

    #[test]
    fn values_are_interpolated_with_the_perspective() {
        // In space the middle of the line is where 1/w has its mean.
        let corners = [corner(0.0, 0.0, 1.0), corner(16.0, 0.0, 4.0), corner(8.0, 12.0, 2.0)];
        let rows = draw(&corners, &[[0, 1, 2]]);
        let mut seen = 0;
        for fragment in rows.iter().flatten().filter(|fragment| !fragment.is_empty()) {
            assert!((f64::from(fragment.in_body.x) - fragment.depth).abs() < 1e-5);
            seen += 1;
        }
        assert!(seen > 60);
        let at_top = rows[0][8];
        assert!((at_top.depth - 1.0 / (1.0 - 8.5 / 16.0 + 8.5 / 64.0)).abs() < 0.1, "{at_top:?}");
    }

    #[test]
    fn what_lies_behind_the_eye_is_not_seen() {
        let corners = [corner(5.0, 5.0, -1.0), corner(9.0, 5.0, -1.0), corner(7.0, 9.0, -2.0)];
        assert!(draw(&corners, &[[0, 1, 2]]).iter().flatten().all(Fragment::is_empty));
        // A floor that goes under the eye: from the horizon of row 4 down, all is covered.
        let floor = |x: f64, w: f64| TriangleCorner {
            seen: HomogeneousPoint { at: DVec3::new(8.0 * w + x, 4.0 * w + 6.0, w), depth: w },
            ..corner(0.0, 0.0, 1.0)
        };
        let corners = [floor(-1e5, -10.0), floor(1e5, -10.0), floor(1e5, 1e4), floor(-1e5, 1e4)];
        let rows = draw(&corners, &[[0, 1, 2], [0, 2, 3]]);
        for (y, row) in rows.iter().enumerate() {
            assert!(row.iter().all(|fragment| fragment.is_empty() == (y < 4)), "row {y}");
        }
    }

    #[test]
    fn the_nearer_face_wins_in_any_order() {
        let corners = [
            (1.0, 1.0, 2.0),
            (14.0, 1.0, 2.0),
            (7.0, 11.0, 2.0),
            (1.0, 1.0, 1.0),
            (14.0, 1.0, 1.0),
            (7.0, 11.0, 1.0),
        ]
        .map(|(x, y, w)| corner(x, y, w));
        for order in [[[0, 1, 2], [3, 4, 5]], [[3, 4, 5], [0, 1, 2]]] {
            let rows = draw(&corners, &order);
            assert_eq!(rows[3][7].depth, 1.0);
        }
    }
}
