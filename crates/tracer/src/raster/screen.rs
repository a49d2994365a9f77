//! Reflected rays on the screen: marched pixel by pixel through the depths of the picture (McGuire, Mara 2014, Efficient
//! GPU Screen-Space Ray Tracing), over a pyramid of depths (Uludag 2014), many rays side by side.
//!
//! Numbers are in single precision, and every operation is rounded by itself: a ray has the same outcome alone and beside
//! others.

pub(crate) mod cells;
pub(crate) mod way;

use glam::DVec2;

use crate::geometry::ray::{INWARDS, NO_START};
use crate::raster::gbuffer::GBuffer;
use crate::raster::gbuffer::depth_pyramid::DepthPyramid;
use crate::raster::screen::cells::{CellLookup, CellPlaces, ScreenCells};
use crate::raster::screen::way::{ScreenMarks, ScreenView, ScreenWays};
use crate::raster::settings::SsrSettings;
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32, MOST_LANES, Mask as _, Width, Word as _, each_lane};
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
    pub(crate) view: ScreenView,
    thickness: f32,
    cells: ScreenCells<'a>,
}

/// The rays of a march.
#[derive(Clone, Copy)]
pub(crate) struct MarchRays<W: Width> {
    /// The pixels whose points they leave, in columns and rows.
    pub(crate) pixel: [W::R; 2],
    /// [`ScreenDepth`](crate::transport::camera::ScreenDepth) of these points.
    pub(crate) depth: W::R,
    /// The bodies that they leave.
    pub(crate) body: W::W,
    /// Of length 1.
    pub(crate) direction: Vector<W::R>,
}

/// What became of the rays of a march.
pub(crate) struct MarchedRays<W: Width> {
    pub(crate) met: W::M,
    /// Of those that met nothing, the ones that went as far as the range.
    end_in_range: W::M,
    /// Where surfaces are met.
    pub(crate) at: [W::R; 2],
}

/// Where the rays of a march are.
struct MarchState<W: Width> {
    /// The mark that is looked at, counted from 1.
    step: W::R,
    /// The edges of the squares that are looked at, pixels, and 1 divided by them.
    edge: W::R,
    inverse: W::R,
}

/// Marks that meet nothing.
struct FreeMarks<W: Width> {
    is_free: W::M,
    /// How many follow the first.
    more: W::R,
}

impl<'a> ScreenMarcher<'a> {
    pub(crate) fn new(buffer: &'a GBuffer, camera: &RenderCamera, settings: &'a SsrSettings) -> Self {
        Self {
            buffer,
            settings,
            view: ScreenView::new(camera, buffer.frame.size()),
            thickness: settings.thickness as f32,
            cells: ScreenCells::new(buffer),
        }
    }

    pub(crate) fn settings(&self) -> &SsrSettings {
        self.settings
    }

    /// Follows the ray from the point that a pixel shows, in a direction of length 1.
    pub(crate) fn march(&self, pixel: usize, direction: Vector<f32>) -> MarchOutcome {
        let Some(texel) = self.buffer.hits.surfaces.get(pixel) else { return MarchOutcome::LeftScreen };
        let width = self.buffer.frame.width;
        let rays = MarchRays::<ScalarWidth> {
            pixel: [(pixel % width) as f32, (pixel / width) as f32],
            depth: texel.depth,
            body: texel.start & !INWARDS,
            direction,
        };
        self.march_all(ScalarWidth, &rays, true).outcome(0)
    }

    /// Follows the rays of `lanes`.
    #[inline(always)]
    pub(crate) fn march_all<W: Width>(&self, w: W, rays: &MarchRays<W>, lanes: W::M) -> MarchedRays<W> {
        let [column, row] = rays.pixel;
        let [offset_x, offset_y] = self.cells.offset;
        let start = ScreenMarks { x: column + offset_x, y: row + offset_y, depth: rays.depth };
        let (way, end_in_range, can_be_counted) =
            ScreenWays::new(w, &self.view, start, rays.direction, self.settings);
        let (met, at) = self.first_met(w, &way, rays, lanes & can_be_counted);
        MarchedRays { met, end_in_range, at }
    }

    /// Which rays meet something, and where.
    #[inline(always)]
    fn first_met<W: Width>(
        &self,
        w: W,
        way: &ScreenWays<W::R>,
        rays: &MarchRays<W>,
        lanes: W::M,
    ) -> (W::M, [W::R; 2]) {
        let one = w.real(1.0);
        let mut cells = CellLookup::new(rays.direction);
        let mut state = MarchState::new(w);
        let (mut met, mut places) = (w.mask(0), [one; 2]);
        let mut marching = lanes;
        loop {
            // Rays wait where they may have met something, so that they are refined side by side.
            let found = self.advance(w, (way, rays), &mut state, &mut cells, marching);
            if !found.any() {
                return (met, places);
            }
            let (at, are_met) = self.refine(w, (way, rays), &mut cells, state.step, found);
            met = met | are_met;
            places = [W::R::select(are_met, at.x, places[0]), W::R::select(are_met, at.y, places[1])];
            marching = found & !are_met;
            state.step = state.step + one;
        }
    }

    /// Goes on to the next marks that are behind a surface by no more than its thickness; `false` for rays that come to
    /// their end. In each turn of the loop a ray goes on by a mark or more, or to a smaller square.
    #[inline(always)]
    fn advance<W: Width>(
        &self,
        w: W,
        (way, rays): (&ScreenWays<W::R>, &MarchRays<W>),
        state: &mut MarchState<W>,
        cells: &mut CellLookup,
        lanes: W::M,
    ) -> W::M {
        let (zero, one) = (w.real(0.0), w.real(1.0));
        let mut found = w.mask(0);
        let mut marching = lanes & state.step.le(way.count);
        while marching.any() {
            let here = way.at(state.step);
            let free = self.free_marks(w, (way, rays), state, &here, marching);
            let (passed, stuck) = (marching & free.is_free, marching & !free.is_free);
            let tested = stuck & state.are_smallest(w);
            state.go_up(w, passed);
            state.go_down(w, stuck);
            state.step = state.step + W::R::select(passed, free.more + one, zero);
            if tested.any() {
                let (step, meets) = self.test(w, (way, rays), cells, (state.step, free.more), tested);
                state.step = step;
                found = found | meets;
                marching = marching & !meets;
            }
            marching = marching & state.step.le(way.count);
        }
        found
    }

    /// Looks at the marks of rays one by one: the first and so many `more`. Where rays are then: at the first mark that is
    /// behind a surface by no more than its thickness, which is told, or at the one after the last.
    #[inline(always)]
    fn test<W: Width>(
        &self,
        w: W,
        (way, rays): (&ScreenWays<W::R>, &MarchRays<W>),
        cells: &mut CellLookup,
        (mut step, more): (W::R, W::R),
        lanes: W::M,
    ) -> (W::R, W::M) {
        let (one, last) = (w.real(1.0), step + more);
        let (mut testing, mut met) = (lanes, w.mask(0));
        loop {
            let here = way.at(step);
            let cell = self.cells.look(w, cells, [here.x, here.y], testing.bits());
            let behind = self.behind(rays, &cell, &here, testing);
            let near = behind & self.are_within(&cell, here.depth, here.depth - way.step.depth);
            if near.any() {
                let meets = near & self.cells.facing(w, cells, &cell, near.bits());
                met = met | meets;
                testing = testing & !meets;
            }
            step = W::R::select(testing, step + one, step);
            testing = testing & step.le(last);
            if !testing.any() {
                return (step, met);
            }
        }
    }

    /// Which marks and how many more after them surely meet nothing: those in one square of pixels, if the ray does not
    /// come as deep there as anything, or stays behind all of it, or leaves the only body that is there.
    ///
    /// All that is compared changes in one sense along the way, as it is computed, since every operation rounds in one
    /// sense: what holds at the ends of the marks holds between them.
    #[inline(always)]
    fn free_marks<W: Width>(
        &self,
        w: W,
        (way, rays): (&ScreenWays<W::R>, &MarchRays<W>),
        state: &MarchState<W>,
        here: &ScreenMarks<W::R>,
        marching: W::M,
    ) -> FreeMarks<W> {
        let zero = w.real(0.0);
        let pyramid = &self.buffer.depths;
        let [place_x, place_y] = self.cells.pixel_places(here);
        let [inside_x, inside_y] = self.cells.within_picture(w, [place_x, place_y]);
        let (column, row) = ((inside_x * state.inverse).floor(), (inside_y * state.inverse).floor());
        let rows = pyramid.rows as f32;
        let first_row = state.inverse.times_plus(w.real(DepthPyramid::SMALLEST as f32 * -rows), w.real(rows));
        let (mut columns, mut lines) = ([0; MOST_LANES], [0; MOST_LANES]);
        to_words(column).store(&mut columns);
        to_words(first_row + row).store(&mut lines);
        let [mut squares, mut others] = [[[0.0; 4]; MOST_LANES]; 2];
        for lane in 0..W::LANES {
            [squares[lane], others[lane]] = *pyramid.square(lines[lane] as usize, columns[lane] as usize);
        }
        let [nearest, farthest, lowest, highest] = w.load_fours(&squares);
        let [nearest_above, farthest_above, nearest_below, farthest_below] = w.load_fours(&others);
        let is_lowest = lowest.to_word().equals(rays.body);
        let is_highest = highest.to_word().equals(rays.body);
        let without_own =
            |all, above, below| W::R::select(is_lowest, above, W::R::select(is_highest, below, all));
        let nearest = without_own(nearest, nearest_above, nearest_below);
        let farthest = without_own(farthest, farthest_above, farthest_below);
        let mut more = way.count - state.step;
        let sides = [(place_x, column, way.step.x), (place_y, row, way.step.y)];
        for ((place, number, step), steps_in_pixel) in sides.into_iter().zip(way.steps_in_pixel) {
            let low = number * state.edge;
            let left = W::R::select(step.lt(zero), place - low, low + state.edge - place);
            more = (left.max(zero) * steps_in_pixel).min(more);
        }
        let more = more.floor();
        let there = way.depth(state.step + more);
        let mut is_free = here.depth.max(there).lt(nearest);
        if (marching & !is_free).any() {
            let depth = self.view.depth;
            // The step that makes most depth is the deepest.
            let deepest = here.depth.max(there);
            let most = depth.difference([deepest, deepest - way.step.depth], way.step.depth.abs());
            let behind = depth.meters(here.depth.min(there)) - depth.meters(farthest);
            is_free = is_free | behind.gt(most + self.thickness);
        }
        FreeMarks { is_free, more }
    }

    /// Which marks are behind surfaces that rays may meet: those of other bodies (a convex one is never met by rays that
    /// leave it).
    #[inline(always)]
    fn behind<W: Width>(
        &self,
        rays: &MarchRays<W>,
        cell: &CellPlaces<W>,
        marks: &ScreenMarks<W::R>,
        lanes: W::M,
    ) -> W::M {
        let is_own = cell.start.and(!INWARDS).equals(rays.body);
        lanes & !is_own & !cell.start.is(NO_START) & marks.depth.ge(cell.depth)
    }

    /// Whether rays that are behind surfaces are so by no more than the thickness, and the depth that they made since the
    /// last marks.
    #[inline(always)]
    fn are_within<W: Width>(&self, cell: &CellPlaces<W>, at: W::R, before: W::R) -> W::M {
        let depth = self.view.depth;
        let most = depth.difference([at, before], (at - before).abs()) + self.thickness;
        (depth.meters(at) - depth.meters(cell.depth)).le(most)
    }

    /// Halves the steps in which surfaces were met. Where, and whether they are met still.
    #[inline(always)]
    fn refine<W: Width>(
        &self,
        w: W,
        (way, rays): (&ScreenWays<W::R>, &MarchRays<W>),
        cells: &mut CellLookup,
        step: W::R,
        lanes: W::M,
    ) -> (ScreenMarks<W::R>, W::M) {
        let (mut low, mut high) = (step - 1.0, step);
        let mut left = self.settings.refinements;
        loop {
            let asked = if left > 0 { (low + high) * 0.5 } else { high };
            let marks = way.at(asked);
            let cell = self.cells.look(w, cells, [marks.x, marks.y], lanes.bits());
            let behind = self.behind(rays, &cell, &marks, lanes);
            let is_behind = behind & self.cells.facing(w, cells, &cell, behind.bits());
            if left == 0 {
                return (marks, is_behind & self.are_within(&cell, marks.depth, way.depth(low)));
            }
            left -= 1;
            high = W::R::select(is_behind, asked, high);
            low = W::R::select(is_behind, low, asked);
        }
    }

    /// Writes the light that the picture has at places, interpolated between pixels of one body.
    #[inline(always)]
    pub(crate) fn light_all<W: Width>(&self, w: W, at: [W::R; 2], lanes: u32, light: &mut [Vector<f32>]) {
        let mut cells = CellLookup::new(Vector::splat(at[0], [0.0; 3]));
        let cell = self.cells.look(w, &mut cells, at, lanes);
        let shares = cell.shares(w);
        let sum = shares[0] + shares[1] + shares[2] + shares[3];
        let mut weights = [[0.0; MOST_LANES]; 4];
        for (share, weights) in shares.into_iter().zip(&mut weights) {
            (share / sum).store(weights);
        }
        each_lane(lanes, |lane| {
            let around = self.cells.pixels(cells.corner(lane));
            let mut sum = [0.0; 3];
            for (pixel, weights) in around.into_iter().zip(&weights) {
                let lit = self.buffer.lit.get(pixel).copied().unwrap_or_default();
                let weight = weights[lane];
                // Of other bodies nothing is taken, not even what is no number.
                if weight != 0.0 {
                    sum = std::array::from_fn(|part| sum[part] + weight * lit[part]);
                }
            }
            light[lane] = Vector::new(sum[0], sum[1], sum[2]);
        });
    }
}

impl<W: Width> MarchState<W> {
    /// Before the first mark.
    #[inline(always)]
    fn new(w: W) -> Self {
        let edge = (DepthPyramid::LARGEST / DepthPyramid::GROWTH) as f32;
        Self { step: w.real(1.0), edge: w.real(edge), inverse: w.real(edge.recip()) }
    }

    #[inline(always)]
    fn are_smallest(&self, w: W) -> W::M {
        self.edge.le(w.real(DepthPyramid::SMALLEST as f32))
    }

    /// Takes larger squares, if there are any.
    #[inline(always)]
    fn go_up(&mut self, w: W, lanes: W::M) {
        let growth = DepthPyramid::GROWTH as f32;
        let lanes = lanes & self.edge.lt(w.real(DepthPyramid::LARGEST as f32));
        self.edge = W::R::select(lanes, self.edge * growth, self.edge);
        self.inverse = W::R::select(lanes, self.inverse * growth.recip(), self.inverse);
    }

    /// Takes smaller squares, if there are any.
    #[inline(always)]
    fn go_down(&mut self, w: W, lanes: W::M) {
        let growth = DepthPyramid::GROWTH as f32;
        let lanes = lanes & !self.are_smallest(w);
        self.edge = W::R::select(lanes, self.edge * growth.recip(), self.edge);
        self.inverse = W::R::select(lanes, self.inverse * growth, self.inverse);
    }
}

impl<W: Width> MarchedRays<W> {
    /// Of one of the rays.
    pub(crate) fn outcome(&self, lane: usize) -> MarchOutcome {
        let [mut x, mut y] = [[0.0; MOST_LANES]; 2];
        self.at[0].store(&mut x);
        self.at[1].store(&mut y);
        if self.met.bits() >> lane & 1 == 1 {
            MarchOutcome::Met(DVec2::new(x[lane].into(), y[lane].into()))
        } else if self.end_in_range.bits() >> lane & 1 == 1 {
            MarchOutcome::OutOfRange
        } else {
            MarchOutcome::LeftScreen
        }
    }
}

/// Whole numbers from 0 to 2²³ - 1 as words.
#[inline(always)]
pub(crate) fn to_words<R: Float32>(numbers: R) -> R::Word {
    /// 2²³: the last bits of larger numbers are whole ones.
    const WHOLE: f32 = 8_388_608.0;
    (numbers + WHOLE).to_word().and(0x007f_ffff)
}

#[cfg(test)]
mod tests;
