//! Reflected rays on the screen: marched pixel by pixel through the depths of the picture (McGuire, Mara 2014, Efficient
//! GPU Screen-Space Ray Tracing).

use glam::{DVec2, DVec3};

use crate::raster::gbuffer::{GBuffer, GBufferTexel};
use crate::raster::point_shader::exact;
use crate::raster::settings::SsrSettings;
use crate::simd::vector::Vector;
use crate::transport::camera::{HomogeneousPoint, RenderCamera};

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
    pub(crate) buffer: &'a GBuffer,
    pub(crate) camera: &'a RenderCamera,
    pub(crate) settings: &'a SsrSettings,
}

/// The part of a ray that lies on the screen. From its start (s = 0) to its end (s = 1) the place on the screen changes
/// evenly; so do 1/w and t/w, whatever the projection.
struct ScreenRay {
    from: HomogeneousPoint,
    along: HomogeneousPoint,
    places: [DVec2; 2],
    inverse_w: [f64; 2],
    /// t/w at the end.
    far: f64,
}

/// A point of a ray on the screen.
#[derive(Clone, Copy)]
struct ScreenRayPoint {
    at: DVec2,
    depth: f64,
}

impl ScreenRay {
    fn new(from: HomogeneousPoint, along: HomogeneousPoint, reach: f64) -> Self {
        let end = from.at + along.at * reach;
        Self {
            from,
            along,
            places: [from.at, end].map(|at| at.truncate() / at.z),
            inverse_w: [from.at.z.recip(), end.z.recip()],
            far: reach / end.z,
        }
    }

    /// Into how many steps of `step_pixels` along its longer side it is divided, and how many of them may lie on a screen of
    /// `size` pixels; `None` if they cannot be counted.
    ///
    /// The end is on the screen but for rounding. Close to the plane of the eye that may carry it anywhere, so that the
    /// march is bounded by the screen itself: a straight line has left it after its longer side.
    fn steps(&self, step_pixels: f64, size: DVec2) -> Option<(f64, f64)> {
        let pixels = (self.places[1] - self.places[0]).abs().max_element();
        let count = (pixels / step_pixels).ceil().max(1.0);
        let most = ((size.max_element() + 2.0) / step_pixels).ceil();
        count.is_finite().then(|| (count, count.min(most)))
    }

    fn at(&self, s: f64) -> ScreenRayPoint {
        let inverse_w = self.inverse_w[0] + (self.inverse_w[1] - self.inverse_w[0]) * s;
        let t = self.far * s / inverse_w;
        ScreenRayPoint {
            at: self.places[0].lerp(self.places[1], s),
            depth: self.from.depth + t * self.along.depth,
        }
    }
}

impl ScreenMarcher<'_> {
    /// Follows the ray from the point that a texel shows, in a direction of length 1.
    pub(crate) fn march(&self, texel: &GBufferTexel, direction: DVec3) -> MarchOutcome {
        let size = self.buffer.frame.size();
        let from = self.camera.homogeneous(exact(texel.position).extend(1.0), size);
        let along = self.camera.homogeneous(direction.extend(0.0), size);
        let (reach, end) = self.reach(from, along);
        let way = ScreenRay::new(from, along, reach);
        let Some((count, last)) = way.steps(self.settings.step_pixels, size) else { return end };
        let own = texel.start.body;
        let mut step = 1.0;
        while step <= last {
            let here = way.at(step / count);
            let free = self.free_steps(&way, here, step, count);
            if free >= 1.0 {
                step += free;
                continue;
            }
            let (low, high) = ((step - 1.0) / count, step / count);
            if let Some(behind) = self.behind(own, direction, here)
                && self.is_within(behind, here, way.at(low))
                && let Some(at) = self.refine(&way, own, direction, [low, high])
            {
                return MarchOutcome::Met(at);
            }
            step += 1.0;
        }
        end
    }

    /// How many steps from this one on, the mark of which is `here`, surely meet nothing: those that stay in its square of
    /// pixels, if the ray does not come as deep there as anything.
    fn free_steps(&self, way: &ScreenRay, here: ScreenRayPoint, step: f64, count: f64) -> f64 {
        let square = self.buffer.fronts.square(self.nearest(here.at));
        if here.depth >= square.front {
            return 0.0;
        }
        let pace = (way.places[1] - way.places[0]) / count;
        let place = self.pixel_place(here.at);
        let ahead = |place: f64, low: f64, high: f64, pace: f64| {
            let border = if pace > 0.0 { high } else { low };
            if pace == 0.0 { f64::INFINITY } else { ((border - place) / pace).max(0.0) }
        };
        let more = ahead(place.x, square.low.x, square.high.x, pace.x)
            .min(ahead(place.y, square.low.y, square.high.y, pace.y))
            .min(count - step)
            .floor();
        // Depth rises or falls all along the way.
        if way.at((step + more) / count).depth < square.front { more + 1.0 } else { 0.0 }
    }

    /// How far the ray stays on the screen and in range, meters, and what ends it.
    fn reach(&self, from: HomogeneousPoint, along: HomogeneousPoint) -> (f64, MarchOutcome) {
        /// Of the start's w: nearer to the plane of the eye a ray is far beside the picture.
        const NEAR: f64 = 1e-6;
        let size = self.buffer.frame.size();
        // Each of these is positive on the screen and linear along the ray.
        let sides = |p: DVec3, depth: f64, near: f64| {
            [p.x, size.x * p.z - p.x, p.y, size.y * p.z - p.y, p.z - near, depth]
        };
        let starts = sides(from.at, from.depth, NEAR * from.at.z);
        let slopes = sides(along.at, along.depth, 0.0);
        let ends = starts.iter().zip(slopes).filter(|(_, slope)| *slope < 0.0);
        let side = ends.map(|(start, slope)| start.max(0.0) / -slope).fold(f64::INFINITY, f64::min);
        if side < self.settings.range {
            (side, MarchOutcome::LeftScreen)
        } else {
            (self.settings.range, MarchOutcome::OutOfRange)
        }
    }

    /// How far a mark of a ray lies behind a surface that it may meet there: one of another body (a convex one is never met
    /// by rays that leave it), on the side that the eye sees.
    fn behind(&self, own: u32, direction: DVec3, mark: ScreenRayPoint) -> Option<f64> {
        let index = self.nearest(mark.at);
        if mark.depth < self.buffer.fronts.around(index) {
            return None;
        }
        let texels = self.buffer.texels.get(index);
        let texel = texels.filter(|texel| !texel.is_empty() && texel.start.body != own)?;
        let may_be_met = exact(texel.normal).dot(direction) < 0.0;
        let behind = mark.depth - may_be_met.then(|| self.depth(mark.at, texel))?;
        (behind >= 0.0).then_some(behind)
    }

    /// Whether a ray is behind a surface by no more than the thickness, and the depth that it made since the last mark.
    fn is_within(&self, behind: f64, mark: ScreenRayPoint, last: ScreenRayPoint) -> bool {
        behind <= self.settings.thickness + (mark.depth - last.depth).abs()
    }

    /// Halves the step in which a surface was met.
    fn refine(
        &self,
        way: &ScreenRay,
        own: u32,
        direction: DVec3,
        [mut low, mut high]: [f64; 2],
    ) -> Option<DVec2> {
        for _ in 0..self.settings.refinements {
            let middle = 0.5 * (low + high);
            if self.behind(own, direction, way.at(middle)).is_some() {
                high = middle;
            } else {
                low = middle;
            }
        }
        let mark = way.at(high);
        let behind = self.behind(own, direction, mark)?;
        self.is_within(behind, mark, way.at(low)).then_some(mark.at)
    }

    /// How deep the surface of `texel` lies at a place. Depths are interpolated between pixels of one body, 1/w evenly on
    /// the screen.
    fn depth(&self, at: DVec2, texel: &GBufferTexel) -> f64 {
        let is_parallel = self.camera.parallel_height().is_some();
        let mut sum = 0.0;
        for (index, weight) in self.neighbors(at) {
            match self.buffer.texels.get(index) {
                Some(other) if other.start == texel.start => {
                    let depth = f64::from(other.depth);
                    sum += weight * if is_parallel { depth } else { depth.recip() };
                }
                _ => return f64::from(texel.depth),
            }
        }
        if is_parallel { sum } else { sum.recip() }
    }

    /// The light that the picture has at a place, interpolated between pixels of one body.
    pub(crate) fn light(&self, at: DVec2) -> Vector<f32> {
        let body = self.buffer.texels.get(self.nearest(at)).map(|texel| texel.start);
        let (mut light, mut weights) = (DVec3::ZERO, 0.0);
        for (index, weight) in self.neighbors(at) {
            if self.buffer.texels.get(index).map(|texel| texel.start) == body {
                light += weight * self.buffer.lit.get(index).map_or(DVec3::ZERO, |lit| exact(*lit));
                weights += weight;
            }
        }
        crate::raster::point_shader::vector(light / weights)
    }

    /// A place of the picture in pixels of which the samples are the centers.
    fn pixel_place(&self, at: DVec2) -> DVec2 {
        at - self.buffer.offset + 0.5
    }

    /// The pixel whose sample is nearest to a place.
    fn nearest(&self, at: DVec2) -> usize {
        let frame = self.buffer.frame;
        let place = self.pixel_place(at);
        let (x, y) = (place.x.max(0.0) as usize, place.y.max(0.0) as usize);
        y.min(frame.height - 1) * frame.width + x.min(frame.width - 1)
    }

    /// The four pixels around a place with their shares, which add up to 1.
    fn neighbors(&self, at: DVec2) -> [(usize, f64); 4] {
        let frame = self.buffer.frame;
        let last = frame.size() - 1.0;
        let place = (at - self.buffer.offset).clamp(DVec2::ZERO, last);
        let low = place.floor();
        let part = place - low;
        let corner = |right: bool, down: bool| {
            let x = (low.x as usize + usize::from(right)).min(frame.width - 1);
            let y = (low.y as usize + usize::from(down)).min(frame.height - 1);
            let share = |part: f64, is_second: bool| if is_second { part } else { 1.0 - part };
            (y * frame.width + x, share(part.x, right) * share(part.y, down))
        };
        [corner(false, false), corner(true, false), corner(false, true), corner(true, true)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn way(places: [DVec2; 2]) -> ScreenRay {
        let nowhere = HomogeneousPoint { at: DVec3::ZERO, depth: 0.0 };
        ScreenRay { from: nowhere, along: nowhere, places, inverse_w: [1.0; 2], far: 1.0 }
    }

    #[test]
    fn no_march_has_more_steps_than_the_screen_has_pixels() {
        let size = DVec2::new(320.0, 200.0);
        let start = DVec2::new(10.0, 20.0);
        for power in -3..300 {
            let end = start + DVec2::new(0.3, -1.0) * 10.0_f64.powi(power);
            for step_pixels in [0.5, 1.0, 7.0] {
                let (count, last) = way([start, end]).steps(step_pixels, size).unwrap();
                assert!(last >= 1.0 && last <= count && last <= 322.0 / step_pixels + 1.0, "{end}: {last}");
                // Whatever is on the screen is marched through.
                assert!(last == count || count * step_pixels > 320.0, "{end}: {last} of {count}");
            }
        }
        for end in [f64::NAN, f64::INFINITY] {
            let steps = way([start, DVec2::splat(end)]).steps(1.0, size);
            assert!(steps.is_none_or(|(_, last)| last <= 323.0), "{steps:?}");
        }
    }
}
