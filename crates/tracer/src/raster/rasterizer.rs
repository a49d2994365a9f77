//! Faces become pixels.
//!
//! Triangles are drawn in homogeneous coordinates (Olano, Greer 1997, Triangle Scan Conversion using 2D Homogeneous
//! Coordinates): what lies behind the eye drops out of the signs of the edge functions, so that no triangle is clipped and
//! none is too near. Everything is computed in double precision at the sample's place, the very place that the tracer
//! sends its ray through.
//!
//! What is found in a pixel is which triangle is nearest there (Burns, Hunt 2013, The Visibility Buffer); its values are
//! interpolated afterwards, where it is seen.

use std::ops::Range;

use catoptric_picture::SizeError;
use glam::{DVec2, DVec3};

use crate::raster::projection::HomogeneousPoint;
use crate::raster::sample_sums::FrameSize;
use crate::simd::double::{Float64, Mask64};
use crate::simd::vector::Vector;
use crate::simd::{Float as _, MOST_LANES, Mask as _, Width};

/// Pixels of a row that are looked at side by side.
pub(crate) const RUN: usize = 8;

/// Stands for "no triangle".
pub(crate) const NO_TRIANGLE: u32 = u32::MAX;

/// A corner of a face, with what is interpolated across the face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleCorner {
    pub(crate) seen: HomogeneousPoint,
    /// Light on the color and highlight, or place and normal; then the point in the body's frame, for its pattern.
    pub(crate) values: [[f32; 3]; 3],
}

/// Which triangle is nearest in each pixel, so far.
pub(crate) struct VisibilityBuffer {
    /// Pixels from one row to the next: the picture's width, filled up to whole runs.
    pub(crate) stride: usize,
    /// Distances along the view, meters; infinite where nothing is.
    pub(crate) depths: Vec<f64>,
    /// Numbers of triangles; [`NO_TRIANGLE`] where none of those that were drawn last is nearest.
    pub(crate) triangles: Vec<u32>,
}

impl VisibilityBuffer {
    /// A buffer with nothing in it.
    pub(crate) fn new(frame: FrameSize) -> Result<Self, SizeError> {
        let stride = frame.width.next_multiple_of(RUN);
        let padded = FrameSize { width: stride, ..frame };
        Ok(Self { stride, depths: padded.buffer(f64::INFINITY)?, triangles: padded.buffer(NO_TRIANGLE)? })
    }

    /// Forgets how near anything is.
    pub(crate) fn clear(&mut self) {
        self.depths.fill(f64::INFINITY);
    }

    /// Forgets the numbers of triangles, but not how near they are.
    pub(crate) fn forget_triangles(&mut self) {
        self.triangles.fill(NO_TRIANGLE);
    }
}

/// A triangle in the picture.
#[derive(Clone, Debug)]
pub(crate) struct ScreenTriangle {
    /// E_i·(x, y, 1) ≥ 0 on the inner side of the edge opposite corner i; in proportion, the corner's share of the point.
    edges: [DVec3; 3],
    corners: [u32; 3],
    depths: [f64; 3],
    /// [`RayOrigin::word`](crate::RayOrigin) of the body and side.
    pub(crate) start: u32,
    /// Of a part of a joined body: the normal out of the part, of length 1. It is seen only where it bounds the whole.
    pub(crate) outward: Option<DVec3>,
    /// Whether light or place and normal are the same at all corners: then they are not interpolated, and not rounded.
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
        let [a, b, c] = corners.map(|corner| all.get(corner as usize));
        let all = [a?, b?, c?];
        let seen = all.map(|corner| corner.seen);
        let [a, b, c] = seen.map(|corner| corner.at);
        let edges = [edge(b, c), edge(c, a), edge(a, b)];
        let determinant = edges[0].dot(a);
        if !(determinant.abs() > 0.0 && determinant.is_finite()) {
            return None;
        }
        let (rows, columns) = extent([a, b, c], frame)?;
        let [first, others @ ..] = all.map(|corner| &corner.values[..2]);
        Some(Self {
            edges: edges.map(|edge| edge * determinant.signum()),
            corners,
            depths: seen.map(|corner| corner.depth),
            start,
            outward: None,
            is_even: others.iter().all(|other| *other == first),
            rows,
            columns,
        })
    }

    /// The rows that it may reach.
    pub(crate) fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// The numbers of its corners.
    pub(crate) fn corners(&self) -> [u32; 3] {
        self.corners
    }

    /// Draws what lies in row `y` of the picture, whose depths and triangles these are, as triangle `number`; samples lie
    /// at `offset` in their pixels. Of the pixels of a run in which it is nearest, those are drawn that `keep` keeps, if it is
    /// given.
    #[inline(always)]
    pub(crate) fn draw(
        &self,
        number: u32,
        (y, offset): (usize, DVec2),
        depths: &mut [f64],
        triangles: &mut [u32],
        keep: Option<&RunFilter<'_>>,
    ) {
        let at_y = y as f64 + offset.y;
        let rest = self.edges.map(|edge| edge.y * at_y + edge.z);
        let columns = self.columns_of(rest, offset.x);
        let runs = columns.start / RUN..columns.end.div_ceil(RUN);
        let (depths, _) = depths.as_chunks_mut::<RUN>();
        let (triangles, _) = triangles.as_chunks_mut::<RUN>();
        let (Some(depths), Some(triangles)) = (depths.get_mut(runs.clone()), triangles.get_mut(runs.clone()))
        else {
            return;
        };
        /// Where the pixels of a run lie.
        const LANES: [f64; RUN] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        let zero = Float64([0.0; RUN]);
        for (run, (depths, triangles)) in runs.zip(depths.iter_mut().zip(triangles)) {
            let at_x = Float64([(run * RUN) as f64; RUN]) + Float64(LANES) + Float64([offset.x; RUN]);
            let share = |i: usize| Float64([self.edges[i].x; RUN]) * at_x + Float64([rest[i]; RUN]);
            let shares = [share(0), share(1), share(2)];
            let sum = shares[0] + shares[1] + shares[2];
            // The sum is in proportion to 1/w: what is not before the eye is not seen.
            let inside = shares[0].ge(zero) & shares[1].ge(zero) & shares[2].ge(zero) & sum.gt(zero);
            if !inside.any() {
                continue;
            }
            let part = |i: usize| shares[i] * Float64([self.depths[i]; RUN]);
            let depth = (part(0) + part(1) + part(2)) / sum;
            let nearer = inside & depth.gt(zero) & depth.lt(Float64(*depths));
            let nearer = keep.map_or(nearer, |keep| keep(&CoveredRun { shares, sum }, nearer));
            *depths = Float64::select(nearer, depth, Float64(*depths)).0;
            nearer.select_words(number, triangles);
        }
    }

    /// Which columns of a row can be inside of all edges, one more on either side.
    #[inline(always)]
    fn columns_of(&self, rest: [f64; 3], offset: f64) -> Range<usize> {
        /// Narrower ones are not worth three divisions.
        const NARROW: usize = 2 * RUN;
        let Range { mut start, mut end } = self.columns;
        if end - start <= NARROW {
            return start..end;
        }
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

    /// The values at places of the picture that it covers, as its corners of `all` have them.
    #[inline(always)]
    pub(crate) fn values<W: Width>(
        &self,
        w: W,
        all: &[TriangleCorner],
        [x, y]: &[[f64; MOST_LANES]; 2],
    ) -> [Vector<W::R>; 3] {
        let mut shares = [[0.0; MOST_LANES]; 3];
        let [first, second, third] = &mut shares;
        let shares_out = first.as_chunks_mut::<RUN>().0.iter_mut().zip(second.as_chunks_mut::<RUN>().0);
        let places = x.as_chunks::<RUN>().0.iter().zip(y.as_chunks::<RUN>().0);
        for (((a, b), c), (x, y)) in
            shares_out.zip(third.as_chunks_mut::<RUN>().0).zip(places).take(W::LANES.div_ceil(RUN))
        {
            let share = |i: usize| {
                let edge = self.edges[i];
                Float64([edge.x; RUN]) * Float64(*x)
                    + Float64([edge.y; RUN]) * Float64(*y)
                    + Float64([edge.z; RUN])
            };
            let shares = [share(0), share(1), share(2)];
            let sum = Float64([1.0; RUN]) / (shares[0] + shares[1] + shares[2]);
            for (to, share) in [a, b, c].into_iter().zip(shares) {
                for (to, share) in to.iter_mut().zip((share * sum).0) {
                    *to = share as f32;
                }
            }
        }
        let shares = [w.load(&shares[0]), w.load(&shares[1]), w.load(&shares[2])];
        let none = [Vector::splat(w.real(0.0), [0.0; 3]); 3];
        let [a, b, c] = self.corners.map(|corner| all.get(corner as usize));
        let (Some(a), Some(b), Some(c)) = (a, b, c) else { return none };
        let mut values = none;
        for (which, value) in values.iter_mut().enumerate() {
            let [a, b, c] = [a, b, c].map(|corner| corner.values[which]);
            *value = if self.is_even && which < 2 {
                Vector::splat(shares[0], a)
            } else {
                (Vector::splat(shares[0], a) * shares[0])
                    .plus_times(Vector::splat(shares[0], b), shares[1])
                    .plus_times(Vector::splat(shares[0], c), shares[2])
            };
        }
        values
    }
}

/// Which of some pixels of a run are kept.
pub(crate) type RunFilter<'a> = dyn Fn(&CoveredRun, Mask64<RUN>) -> Mask64<RUN> + 'a;

/// Pixels of a row, and where they lie on a triangle.
pub(crate) struct CoveredRun {
    shares: [Float64<RUN>; 3],
    sum: Float64<RUN>,
}

impl CoveredRun {
    /// The shares of the corners in a pixel; their sum is 1.
    pub(crate) fn shares(&self, lane: usize) -> [f64; 3] {
        let at = |numbers: &Float64<RUN>| numbers.0.get(lane).copied().unwrap_or_default();
        let sum = at(&self.sum);
        [0, 1, 2].map(|corner| at(&self.shares[corner]) / sum)
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
    use crate::simd::scalar::ScalarWidth;

    fn corner(x: f64, y: f64, w: f64) -> TriangleCorner {
        let at = HomogeneousPoint { at: DVec3::new(x * w, y * w, w), depth: w };
        TriangleCorner { seen: at, values: [[w as f32, x as f32, y as f32]; 3] }
    }

    const FRAME: FrameSize = FrameSize { width: 16, height: 12 };

    fn triangles(corners: &[TriangleCorner], triangles: &[[u32; 3]]) -> Vec<ScreenTriangle> {
        let new = |triangle: &[u32; 3]| ScreenTriangle::new(corners, *triangle, 0, FRAME);
        triangles.iter().filter_map(new).collect()
    }

    fn draw(triangles: &[ScreenTriangle]) -> VisibilityBuffer {
        let mut visible = VisibilityBuffer::new(FRAME).unwrap();
        assert_eq!(visible.stride, FRAME.width);
        for (triangle, number) in triangles.iter().zip(0..) {
            for y in triangle.rows() {
                let row = y * FRAME.width..(y + 1) * FRAME.width;
                let (depths, numbers) = (&mut visible.depths[row.clone()], &mut visible.triangles[row]);
                triangle.draw(number, (y, DVec2::splat(0.5)), depths, numbers, None);
            }
        }
        visible
    }

    /// Whether a triangle is seen in each pixel, row by row.
    fn covered(visible: &VisibilityBuffer) -> Vec<Vec<bool>> {
        let is_seen = |number: &u32| *number != NO_TRIANGLE;
        let rows = visible.triangles.chunks(FRAME.width);
        rows.map(|row| row.iter().map(is_seen).collect()).collect()
    }

    #[test]
    fn a_square_of_two_triangles_covers_its_pixels_once_each() {
        let corners = [(2.0, 1.0), (10.0, 1.0), (10.0, 9.0), (2.0, 9.0)].map(|(x, y)| corner(x, y, 3.0));
        let rows = covered(&draw(&triangles(&corners, &[[0, 1, 2], [0, 2, 3]])));
        for (y, row) in rows.iter().enumerate() {
            for (x, is_covered) in row.iter().enumerate() {
                let inside = (2..10).contains(&x) && (1..9).contains(&y);
                assert_eq!(*is_covered, inside, "{x}, {y}");
            }
        }
    }

    #[test]
    fn values_are_interpolated_with_the_perspective() {
        // In space the middle of the line is where 1/w has its mean.
        let corners = [corner(0.0, 0.0, 1.0), corner(16.0, 0.0, 4.0), corner(8.0, 12.0, 2.0)];
        let triangles = triangles(&corners, &[[0, 1, 2]]);
        let visible = draw(&triangles);
        let mut seen = 0;
        for (pixel, number) in visible.triangles.iter().enumerate().filter(|(_, number)| **number == 0) {
            let at = DVec2::new((pixel % FRAME.width) as f64, (pixel / FRAME.width) as f64) + 0.5;
            let at = at.to_array().map(|at| [at; MOST_LANES]);
            let [value, ..] = triangles[*number as usize].values(ScalarWidth, &corners, &at);
            assert!((f64::from(value.x) - visible.depths[pixel]).abs() < 1e-5);
            seen += 1;
        }
        assert!(seen > 60);
        let at_top = visible.depths[8];
        assert!((at_top - 1.0 / (1.0 - 8.5 / 16.0 + 8.5 / 64.0)).abs() < 0.1, "{at_top:?}");
    }

    #[test]
    fn what_lies_behind_the_eye_is_not_seen() {
        let corners = [corner(5.0, 5.0, -1.0), corner(9.0, 5.0, -1.0), corner(7.0, 9.0, -2.0)];
        let behind = draw(&triangles(&corners, &[[0, 1, 2]]));
        assert!(covered(&behind).iter().flatten().all(|is_covered| !is_covered));
        // A floor that goes under the eye: from the horizon of row 4 down, all is covered.
        let floor = |x: f64, w: f64| TriangleCorner {
            seen: HomogeneousPoint { at: DVec3::new(8.0 * w + x, 4.0 * w + 6.0, w), depth: w },
            ..corner(0.0, 0.0, 1.0)
        };
        let corners = [floor(-1e5, -10.0), floor(1e5, -10.0), floor(1e5, 1e4), floor(-1e5, 1e4)];
        let rows = covered(&draw(&triangles(&corners, &[[0, 1, 2], [0, 2, 3]])));
        for (y, row) in rows.iter().enumerate() {
            assert!(row.iter().all(|is_covered| *is_covered == (y >= 4)), "row {y}");
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
            let visible = draw(&triangles(&corners, &order));
            assert_eq!(visible.depths[3 * FRAME.width + 7], 1.0);
        }
    }
}
