//! Reflected rays on the screen: marched pixel by pixel through the depths of the picture (McGuire, Mara 2014, Efficient
//! GPU Screen-Space Ray Tracing), many rays side by side.
//!
//! Numbers are in double precision, and every operation is rounded by itself: a ray has the same outcome alone and beside
//! others.

pub(crate) mod way;

use glam::{DVec2, DVec3};

use crate::raster::gbuffer::depth_pyramid::DepthPyramid;
use crate::raster::gbuffer::{GBuffer, GBufferTexel};
use crate::raster::point_shader::{exact, vector};
use crate::raster::projection::{ScreenProjection, vector64};
use crate::raster::screen::way::{ScreenMarks, ScreenRays};
use crate::raster::settings::SsrSettings;
use crate::simd::double::{Float64, Mask64};
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Mask as _};
use crate::transport::camera::RenderCamera;

/// What became of a ray on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum MarchOutcome {
    /// It met the surface that the picture shows at this place.
    Met(DVec2),
    /// It left the picture, or went behind the eye.
    LeftScreen,
    /// It went as far as the range.
    OutOfRange,
}

/// The picture through which rays are marched.
pub(crate) struct ScreenMarcher<'a> {
    buffer: &'a GBuffer,
    settings: &'a SsrSettings,
    projection: ScreenProjection,
    is_parallel: bool,
}

/// The rays of a march.
#[derive(Clone, Copy)]
pub(crate) struct MarchRays<const N: usize> {
    /// The bodies that they leave.
    bodies: [u32; N],
    direction: Vector<Float64<N>>,
}

/// How far marks of rays lie behind surfaces that they may meet there; where none may be met, or it lies behind the mark,
/// `is_behind` does not hold.
struct DepthsBehind<const N: usize> {
    by: Float64<N>,
    is_behind: Mask64<N>,
}

/// Where the rays of a march are.
struct MarchState<const N: usize> {
    /// The mark that is looked at, counted from 1.
    step: Float64<N>,
    /// The depths at the marks before.
    before: Float64<N>,
    /// The squares that are looked at.
    level: [usize; N],
}

impl<'a> ScreenMarcher<'a> {
    pub(crate) fn new(buffer: &'a GBuffer, camera: &RenderCamera, settings: &'a SsrSettings) -> Self {
        Self {
            buffer,
            settings,
            projection: ScreenProjection::new(camera, buffer.frame.size()),
            is_parallel: camera.parallel_height().is_some(),
        }
    }

    pub(crate) fn settings(&self) -> &SsrSettings {
        self.settings
    }

    /// Follows the ray from the point that a texel shows, in a direction of length 1.
    pub(crate) fn march(&self, texel: &GBufferTexel, direction: Vector<f32>) -> MarchOutcome {
        let [outcome] = self.march_all([texel], vector64([exact(direction)]), 1);
        outcome
    }

    /// Follows the rays of `lanes` from the points that texels show, in directions of length 1.
    #[inline(always)]
    pub(crate) fn march_all<const N: usize>(
        &self,
        texels: [&GBufferTexel; N],
        direction: Vector<Float64<N>>,
        lanes: u32,
    ) -> [MarchOutcome; N] {
        let (mut points, mut bodies) = ([DVec3::ZERO; N], [0; N]);
        for lane in 0..N {
            (points[lane], bodies[lane]) = (exact(texels[lane].position), texels[lane].start.body);
        }
        let from = self.projection.points(vector64(points));
        let along = self.projection.directions(direction);
        let size = self.buffer.frame.size();
        let (way, ends_in_range) = ScreenRays::new(from, along, size, self.settings);
        let rays = MarchRays { bodies, direction };
        let (met, at) = self.first_met(&way, &rays, Mask64::of_bits(lanes) & way.can_be_counted());
        let ends_in_range = ends_in_range.bits();
        let mut outcomes = [MarchOutcome::LeftScreen; N];
        for (lane, outcome) in outcomes.iter_mut().enumerate() {
            if met >> lane & 1 == 1 {
                *outcome = MarchOutcome::Met(DVec2::new(at.x.0[lane], at.y.0[lane]));
            } else if ends_in_range >> lane & 1 == 1 {
                *outcome = MarchOutcome::OutOfRange;
            }
        }
        outcomes
    }

    /// Which rays meet something, and where.
    #[inline(always)]
    fn first_met<const N: usize>(
        &self,
        way: &ScreenRays<N>,
        rays: &MarchRays<N>,
        lanes: Mask64<N>,
    ) -> (u32, ScreenMarks<N>) {
        let one = Float64([1.0; N]);
        let mut state = MarchState { step: one, before: way.at(Float64([0.0; N])).depth, level: [1; N] };
        let (mut met, mut places) = (0, way.at(one));
        let mut marching = lanes;
        loop {
            // Rays wait where they may have met something, so that they are refined side by side.
            let found = self.advance(way, rays, &mut state, marching);
            if !found.any() {
                return (met, places);
            }
            let ends = [way.share(state.step - one), way.share(state.step)];
            let (at, are_met) = self.refine(way, rays, ends, found);
            met |= are_met.bits();
            places.x = Float64::select(are_met, at.x, places.x);
            places.y = Float64::select(are_met, at.y, places.y);
            marching = found & !are_met;
            state.before = way.at(ends[1]).depth;
            state.step = state.step + one;
        }
    }

    /// Goes on to the next marks that are behind a surface by no more than its thickness; `false` for rays that come to
    /// their end. In each turn of the loop a ray goes on by a mark or more, or to a smaller square.
    #[inline(always)]
    fn advance<const N: usize>(
        &self,
        way: &ScreenRays<N>,
        rays: &MarchRays<N>,
        state: &mut MarchState<N>,
        lanes: Mask64<N>,
    ) -> Mask64<N> {
        let one = Float64([1.0; N]);
        let mut found = Mask64::of_bits(0);
        let mut marching = lanes & state.step.le(way.last);
        while marching.any() {
            let here = way.at(way.share(state.step));
            let free = self.free_marks(way, rays, state, &here);
            let mut passed = marching & free.is_free;
            state.before = Float64::select(passed, free.depth, state.before);
            let mut tested = 0;
            let (bits, passed_bits) = (marching.bits(), passed.bits());
            for lane in 0..N {
                let level = &mut state.level[lane];
                if passed_bits >> lane & 1 == 1 {
                    *level = (*level + 1).min(DepthPyramid::LEVELS - 1);
                } else if *level == 0 {
                    tested |= bits & 1 << lane;
                } else {
                    *level -= 1;
                }
            }
            let mut next = free.more + one;
            if tested != 0 {
                let tests = Mask64::of_bits(tested);
                let behind = self.behind(rays, &here, tests);
                let meets = tests & self.is_within(&behind, &here, state.before);
                found = found | meets;
                marching = marching & !meets;
                let misses = tests & !meets;
                next = Float64::select(misses, one, next);
                state.before = Float64::select(misses, here.depth, state.before);
                passed = passed | misses;
            }
            state.step = Float64::select(passed, state.step + next, state.step);
            marching = marching & state.step.le(way.last);
        }
        found
    }

    /// Which marks and how many more after them surely meet nothing: those in one square of pixels, if the ray does not
    /// come as deep there as anything, or stays behind all of it, or leaves the only body that is there.
    #[inline(always)]
    fn free_marks<const N: usize>(
        &self,
        way: &ScreenRays<N>,
        rays: &MarchRays<N>,
        state: &MarchState<N>,
        here: &ScreenMarks<N>,
    ) -> FreeMarks<N> {
        let zero = Float64([0.0; N]);
        let [x, y] = self.pixel_places(here);
        let (columns, rows) = self.pixels([x, y]);
        let [mut left, mut top, mut edge, mut nearest, mut farthest] = [[0.0; N]; 5];
        let mut own = 0;
        for lane in 0..N {
            let level = state.level[lane];
            let power = DepthPyramid::power(level);
            let (column, row) = (columns[lane] as usize >> power, rows[lane] as usize >> power);
            let square = self.buffer.depths.square(level, column, row);
            (left[lane], top[lane]) = ((column << power) as f64, (row << power) as f64);
            edge[lane] = (1_u32 << power) as f64;
            (nearest[lane], farthest[lane]) = (f64::from(square.nearest), f64::from(square.farthest));
            own |= u32::from(square.shows_only(rays.bodies[lane])) << lane;
        }
        let edge = Float64(edge);
        let mut more = way.count - state.step;
        for (place, low, [pace, steps]) in [(x, Float64(left), way.pace[0]), (y, Float64(top), way.pace[1])] {
            let border = low + Float64::select(pace.lt(zero), zero, edge);
            more = ((border - place) * steps).max(zero).min(more);
        }
        let more = more.floor();
        let depth = way.at(way.share(state.step + more)).depth;
        // Depth rises or falls all along the way.
        let deepest = here.depth.max(depth);
        let made = (depth - state.before).abs();
        let is_before = deepest.lt(Float64(nearest));
        let is_behind =
            (here.depth.min(depth) - Float64(farthest)).gt(Float64([self.settings.thickness; N]) + made);
        FreeMarks { is_free: is_before | is_behind | Mask64::of_bits(own), more, depth }
    }

    /// How far marks of rays lie behind surfaces that they may meet there: those of other bodies (a convex one is never met
    /// by rays that leave it), on the side that the eye sees.
    #[inline(always)]
    fn behind<const N: usize>(
        &self,
        rays: &MarchRays<N>,
        marks: &ScreenMarks<N>,
        lanes: Mask64<N>,
    ) -> DepthsBehind<N> {
        let frame = self.buffer.frame;
        let (columns, rows) = self.pixels(self.pixel_places(marks));
        let [x, y] = self.sample_places(marks);
        let [low_x, low_y] = [x.floor(), y.floor()];
        let (mut may_be_met, mut is_even) = (0, 0);
        let mut own = [0.0; N];
        let mut around = [[1.0; N]; 4];
        let asked = lanes.bits();
        for lane in 0..N {
            if asked >> lane & 1 == 0 {
                continue;
            }
            let index = rows[lane] as usize * frame.width + columns[lane] as usize;
            let Some(texel) = self.buffer.texels.get(index) else { continue };
            let Vector { x, y, z } = &rays.direction;
            let faces_ray = exact(texel.normal).dot(DVec3::new(x.0[lane], y.0[lane], z.0[lane])) < 0.0;
            if texel.is_empty() || texel.start.body == rays.bodies[lane] || !faces_ray {
                continue;
            }
            may_be_met |= 1 << lane;
            own[lane] = f64::from(texel.depth);
            let mut are_one_body = true;
            let neighbors = self.neighbors([low_x.0[lane], low_y.0[lane]]);
            for neighbor in 0..4 {
                match self.buffer.texels.get(neighbors[neighbor]) {
                    Some(other) if other.start == texel.start => {
                        around[neighbor][lane] = f64::from(other.depth);
                    }
                    _ => are_one_body = false,
                }
            }
            is_even |= u32::from(are_one_body) << lane;
        }
        // Depths are interpolated between pixels of one body, 1/w evenly on the screen.
        let one = Float64([1.0; N]);
        let mut sum = Float64([0.0; N]);
        let shares = shares([x - low_x, y - low_y]);
        for neighbor in 0..4 {
            let depth = Float64(around[neighbor]);
            sum = sum + shares[neighbor] * if self.is_parallel { depth } else { one / depth };
        }
        let between = if self.is_parallel { sum } else { one / sum };
        let by = marks.depth - Float64::select(Mask64::of_bits(is_even), between, Float64(own));
        DepthsBehind { by, is_behind: Mask64::of_bits(may_be_met) & by.ge(Float64([0.0; N])) }
    }

    /// Whether rays are behind surfaces by no more than the thickness, and the depth that they made since the last marks.
    #[inline(always)]
    fn is_within<const N: usize>(
        &self,
        behind: &DepthsBehind<N>,
        marks: &ScreenMarks<N>,
        before: Float64<N>,
    ) -> Mask64<N> {
        let most = Float64([self.settings.thickness; N]) + (marks.depth - before).abs();
        behind.is_behind & behind.by.le(most)
    }

    /// Halves the steps in which surfaces were met. Where, and whether they are met still.
    #[inline(always)]
    fn refine<const N: usize>(
        &self,
        way: &ScreenRays<N>,
        rays: &MarchRays<N>,
        [mut low, mut high]: [Float64<N>; 2],
        lanes: Mask64<N>,
    ) -> (ScreenMarks<N>, Mask64<N>) {
        let mut left = self.settings.refinements;
        loop {
            let asked = if left > 0 { (low + high) * 0.5 } else { high };
            let marks = way.at(asked);
            let behind = self.behind(rays, &marks, lanes);
            if left == 0 {
                return (marks, lanes & self.is_within(&behind, &marks, way.at(low).depth));
            }
            left -= 1;
            high = Float64::select(behind.is_behind, asked, high);
            low = Float64::select(behind.is_behind, low, asked);
        }
    }

    /// The light that the picture has at a place, interpolated between pixels of one body.
    #[inline(always)]
    pub(crate) fn light(&self, at: DVec2) -> Vector<f32> {
        let marks = ScreenMarks { x: Float64([at.x]), y: Float64([at.y]), depth: Float64([0.0]) };
        let ([column], [row]) = self.pixels(self.pixel_places(&marks));
        let nearest = row as usize * self.buffer.frame.width + column as usize;
        let body = self.buffer.texels.get(nearest).map(|texel| texel.start);
        let [x, y] = self.sample_places(&marks);
        let low = [x.floor(), y.floor()];
        let (mut light, mut weights) = (DVec3::ZERO, 0.0);
        let weighted =
            self.neighbors(low.map(|low| low.0[0])).into_iter().zip(shares([x - low[0], y - low[1]]));
        for (index, Float64([share])) in weighted {
            if self.buffer.texels.get(index).map(|texel| texel.start) == body {
                light += share * self.buffer.lit.get(index).map_or(DVec3::ZERO, |lit| exact(*lit));
                weights += share;
            }
        }
        vector(light / weights)
    }

    /// Places of the picture in pixels of which the samples are the centers.
    #[inline(always)]
    fn pixel_places<const N: usize>(&self, marks: &ScreenMarks<N>) -> [Float64<N>; 2] {
        let DVec2 { x, y } = self.buffer.offset;
        [marks.x - Float64([x; N]) + 0.5, marks.y - Float64([y; N]) + 0.5]
    }

    /// Columns and rows of the pixels whose samples are nearest to places.
    #[inline(always)]
    fn pixels<const N: usize>(&self, [x, y]: [Float64<N>; 2]) -> ([u32; N], [u32; N]) {
        let [x, y] = self.within_picture([x, y]);
        (x.floor().to_words(), y.floor().to_words())
    }

    /// Places of the picture, counted in samples from that of the first pixel to that of the last.
    #[inline(always)]
    fn sample_places<const N: usize>(&self, marks: &ScreenMarks<N>) -> [Float64<N>; 2] {
        let DVec2 { x, y } = self.buffer.offset;
        self.within_picture([marks.x - Float64([x; N]), marks.y - Float64([y; N])])
    }

    /// Places in columns and rows of the picture.
    #[inline(always)]
    fn within_picture<const N: usize>(&self, [x, y]: [Float64<N>; 2]) -> [Float64<N>; 2] {
        let (zero, last) = (Float64([0.0; N]), self.buffer.frame.size() - 1.0);
        [x.max(zero).min(Float64([last.x; N])), y.max(zero).min(Float64([last.y; N]))]
    }

    /// The pixel with its upper left sample here, and those right of it, below it, and both.
    #[inline(always)]
    fn neighbors(&self, [x, y]: [f64; 2]) -> [usize; 4] {
        let frame = self.buffer.frame;
        let (left, top) = (x as u32 as usize, y as u32 as usize);
        let (right, bottom) = ((left + 1).min(frame.width - 1), (top + 1).min(frame.height - 1));
        [(left, top), (right, top), (left, bottom), (right, bottom)].map(|(x, y)| y * frame.width + x)
    }
}

/// Marks that meet nothing.
struct FreeMarks<const N: usize> {
    is_free: Mask64<N>,
    /// How many follow the first.
    more: Float64<N>,
    /// At the last of them.
    depth: Float64<N>,
}

/// The shares of four neighbors in a place between them, which add up to 1.
#[inline(always)]
fn shares<const N: usize>([x, y]: [Float64<N>; 2]) -> [Float64<N>; 4] {
    let one = Float64([1.0; N]);
    let [left, top] = [one - x, one - y];
    [left * top, x * top, left * y, x * y]
}

#[cfg(test)]
mod tests;
