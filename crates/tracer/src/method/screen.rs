//! Reflected rays on the screen: marched pixel by pixel through the depths of the picture (McGuire, Mara 2014, Efficient
//! GPU Screen-Space Ray Tracing).

use glam::{DVec2, DVec3};

use super::SsrSettings;
use super::gbuffer::{GBuffer, Texel};
use super::probe::exact;
use crate::stage::{Homogeneous, StageCamera};
use crate::vector::Vector;

/// What became of a ray on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fate {
    /// It met the surface that the picture shows at this place.
    Met(DVec2),
    /// It left the picture, or went behind the eye.
    LeftScreen,
    /// It went as far as the range.
    OutOfRange,
}

/// The picture through which rays are marched.
pub(super) struct Screen<'a> {
    pub(super) buffer: &'a GBuffer,
    pub(super) camera: &'a StageCamera,
    pub(super) settings: &'a SsrSettings,
}

/// The part of a ray that lies on the screen. From its start (s = 0) to its end (s = 1) the place on the screen changes
/// evenly; so do 1/w and t/w, whatever the projection.
struct Way {
    from: Homogeneous,
    along: Homogeneous,
    places: [DVec2; 2],
    inverse_w: [f64; 2],
    /// t/w at the end.
    far: f64,
}

/// A point of a ray on the screen.
#[derive(Clone, Copy)]
struct Mark {
    at: DVec2,
    depth: f64,
}

/// What the screen shows at a place.
struct Shown<'a> {
    depth: f64,
    texel: &'a Texel,
}

impl Way {
    fn new(from: Homogeneous, along: Homogeneous, reach: f64) -> Self {
        let end = from.at + along.at * reach;
        Self {
            from,
            along,
            places: [from.at, end].map(|at| at.truncate() / at.z),
            inverse_w: [from.at.z.recip(), end.z.recip()],
            far: reach / end.z,
        }
    }

    /// Pixels along the longer side.
    fn pixels(&self) -> f64 {
        (self.places[1] - self.places[0]).abs().max_element()
    }

    fn at(&self, s: f64) -> Mark {
        let inverse_w = self.inverse_w[0] + (self.inverse_w[1] - self.inverse_w[0]) * s;
        let t = self.far * s / inverse_w;
        Mark { at: self.places[0].lerp(self.places[1], s), depth: self.from.depth + t * self.along.depth }
    }
}

impl Screen<'_> {
    /// Follows the ray from the point that a texel shows, in a direction of length 1.
    pub(super) fn march(&self, texel: &Texel, direction: DVec3) -> Fate {
        let size = self.buffer.frame.size();
        let from = self.camera.homogeneous(exact(texel.position).extend(1.0), size);
        let along = self.camera.homogeneous(direction.extend(0.0), size);
        let (reach, end) = self.reach(from, along);
        let way = Way::new(from, along, reach);
        let count = (way.pixels() / self.settings.step_pixels).ceil().max(1.0);
        if !count.is_finite() {
            return end;
        }
        let own = texel.start.body;
        let mut last = way.at(0.0);
        let mut step = 0.0;
        while step < count {
            let here = way.at((step + 1.0) / count);
            if let Some(shown) = self.in_way(own, direction, here)
                && self.is_within(here, last, &shown)
                && let Some(at) = self.refine(&way, own, direction, [step / count, (step + 1.0) / count])
            {
                return Fate::Met(at);
            }
            last = here;
            step += 1.0;
        }
        end
    }

    /// How far the ray stays on the screen and in range, meters, and what ends it.
    fn reach(&self, from: Homogeneous, along: Homogeneous) -> (f64, Fate) {
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
            (side, Fate::LeftScreen)
        } else {
            (self.settings.range, Fate::OutOfRange)
        }
    }

    /// What stands at a mark of a ray and may be met: another body (a convex one is never met by rays that leave it), on
    /// the side that the eye sees, and not behind the ray's depth.
    fn in_way(&self, own: u32, direction: DVec3, mark: Mark) -> Option<Shown<'_>> {
        let shown = self.shown(mark.at)?;
        let faces = exact(shown.texel.normal).dot(direction) < 0.0;
        (shown.texel.start.body != own && faces && mark.depth >= shown.depth).then_some(shown)
    }

    /// Whether a ray that has come behind what is shown did so by no more than the thickness, and the depth that it made
    /// since the last mark.
    fn is_within(&self, mark: Mark, last: Mark, shown: &Shown<'_>) -> bool {
        mark.depth - shown.depth <= self.settings.thickness + (mark.depth - last.depth).abs()
    }

    /// Halves the step in which a surface was met.
    fn refine(&self, way: &Way, own: u32, direction: DVec3, [mut low, mut high]: [f64; 2]) -> Option<DVec2> {
        for _ in 0..self.settings.refinements {
            let middle = 0.5 * (low + high);
            if self.in_way(own, direction, way.at(middle)).is_some() {
                high = middle;
            } else {
                low = middle;
            }
        }
        let mark = way.at(high);
        let shown = self.in_way(own, direction, mark)?;
        self.is_within(mark, way.at(low), &shown).then_some(mark.at)
    }

    /// What the screen shows at a place. Depths are interpolated between pixels of one body, 1/w evenly on the screen.
    fn shown(&self, at: DVec2) -> Option<Shown<'_>> {
        let around = self.around(at);
        let texel = around.nearest(&self.buffer.texels).filter(|texel| !texel.is_empty())?;
        let mut sum = 0.0;
        let is_parallel = self.camera.parallel_height().is_some();
        for (index, weight) in around.neighbors {
            let other = self.buffer.texels.get(index)?;
            if other.start != texel.start {
                return Some(Shown { depth: f64::from(texel.depth), texel });
            }
            let depth = f64::from(other.depth);
            sum += weight * if is_parallel { depth } else { depth.recip() };
        }
        Some(Shown { depth: if is_parallel { sum } else { sum.recip() }, texel })
    }

    /// The light that the picture has at a place, interpolated between pixels of one body.
    pub(super) fn light(&self, at: DVec2) -> Vector<f32> {
        let around = self.around(at);
        let body = around.nearest(&self.buffer.texels).map(|texel| texel.start);
        let (mut light, mut weights) = (DVec3::ZERO, 0.0);
        for (index, weight) in around.neighbors {
            if self.buffer.texels.get(index).map(|texel| texel.start) == body {
                light += weight * self.buffer.lit.get(index).map_or(DVec3::ZERO, |lit| exact(*lit));
                weights += weight;
            }
        }
        super::probe::vector(light / weights)
    }

    fn around(&self, at: DVec2) -> Around {
        let frame = self.buffer.frame;
        let last = frame.size() - 1.0;
        let place = (at - self.buffer.offset).clamp(DVec2::ZERO, last);
        let low = place.floor();
        let part = place - low;
        let index = |at: DVec2| at.y as usize * frame.width + at.x as usize;
        let corner = |x: f64, y: f64| {
            let at = (low + DVec2::new(x, y)).min(last);
            let share = |part: f64, side: f64| if side == 1.0 { part } else { 1.0 - part };
            (index(at), share(part.x, x) * share(part.y, y))
        };
        Around {
            nearest: index((place + 0.5).floor().min(last)),
            neighbors: [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0), corner(1.0, 1.0)],
        }
    }
}

/// The pixels around a place.
struct Around {
    nearest: usize,
    /// The four with their shares, which add up to 1.
    neighbors: [(usize, f64); 4],
}

impl Around {
    fn nearest<'t>(&self, texels: &'t [Texel]) -> Option<&'t Texel> {
        texels.get(self.nearest)
    }
}
