//! The parts of rays that lie on the screen.

use glam::DVec2;

use crate::raster::settings::SsrSettings;
use crate::simd::vector::Vector;
use crate::simd::{Float32, Width};
use crate::transport::camera::{RenderCamera, ScreenDepth};
use crate::transport::surface::{mend_unit, reflect};

/// The way from the space of the rays to a picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScreenView {
    pub(crate) depth: ScreenDepth,
    right: [f32; 3],
    up: [f32; 3],
    /// Pixels of a unit of length across the view, for a perspective at a depth of 1.
    scale: f32,
    size: [f32; 2],
}

impl ScreenView {
    pub(crate) fn new(camera: &RenderCamera, size: DVec2) -> Self {
        let [right, up, _] = camera.axes().map(|axis| axis.as_vec3().to_array());
        let scale = (camera.magnification() * size.y) as f32;
        Self { depth: ScreenDepth::new(camera), right, up, scale, size: size.as_vec2().to_array() }
    }

    /// The unit directions of the rays that are reflected to the viewer at points with these unit normals.
    #[inline(always)]
    pub(crate) fn reflected<R: Float32>(&self, position: Vector<R>, normal: Vector<R>) -> Vector<R> {
        let like = position.x;
        let forward = Vector::splat(like, self.depth.forward);
        let direction = if self.depth.is_parallel {
            forward
        } else {
            (position - Vector::splat(like, self.depth.eye)).normalize_or(forward)
        };
        mend_unit(reflect(direction, normal))
    }
}

/// Points of rays on the screen, side by side.
#[derive(Clone, Copy)]
pub(crate) struct ScreenMarks<R> {
    /// Pixels from the upper left corner of the picture.
    pub(crate) x: R,
    pub(crate) y: R,
    /// A number of [`ScreenDepth`].
    pub(crate) depth: R,
}

/// The parts of rays that lie on the screen, in steps of a length: in each, place and depth change by as much.
///
/// Of the point P + t·R̂ let w be the depth for a perspective, 1 for a parallel projection. With τ = t/w, place and
/// [`ScreenDepth`] are linear in τ: x = x₀ + τ·(R_x - x₀·R_w), 1/w = (1 - τ·R_w)/w₀. So no point but the start is projected,
/// and nothing is lost near the plane of the eye.
pub(crate) struct ScreenWays<R> {
    start: ScreenMarks<R>,
    /// What changes in a step.
    pub(crate) step: ScreenMarks<R>,
    /// How many steps there are, a whole number.
    pub(crate) count: R,
    /// Steps in a pixel across and down; a large number where the place does not change.
    pub(crate) steps_in_pixel: [R; 2],
}

impl<R: Float32> ScreenWays<R> {
    /// The ways of the rays in unit directions from the points that are seen at `start`. Which of them end where the range
    /// does (others leave the screen), and which can be divided into steps.
    #[inline(always)]
    pub(crate) fn new<W: Width<R = R, M = R::Mask>>(
        w: W,
        view: &ScreenView,
        start: ScreenMarks<R>,
        direction: Vector<R>,
        settings: &SsrSettings,
    ) -> (Self, R::Mask, R::Mask) {
        let (zero, one, never) = (w.real(0.0), w.real(1.0), w.real(f32::INFINITY));
        let [width, height] = view.size;
        let along = |axis: [f32; 3]| direction.dot(Vector::splat(zero, axis));
        let (right, up, forward) = (along(view.right), along(view.up), along(view.depth.forward));
        let (mut x, mut y, mut depth) = (right * view.scale, -(up * view.scale), forward);
        let (eye, range);
        if view.depth.is_parallel {
            eye = W::R::select(forward.lt(zero), start.depth / -forward, never);
            range = w.real(settings.range as f32);
        } else {
            /// 1/w may grow so much: nearer to the plane of the eye a ray is far beside the picture.
            const NEAR: f32 = 1e6;
            x = (w.real(0.5 * width) - start.x).times_plus(forward, x);
            y = (w.real(0.5 * height) - start.y).times_plus(forward, y);
            depth = -(forward * start.depth);
            eye = W::R::select(forward.lt(zero), w.real(NEAR) / -forward, never);
            let t = settings.range as f32;
            let inverse = depth.times_plus(w.real(t), one);
            range = W::R::select(inverse.gt(zero), -(start.depth * t) / inverse, never);
        }
        let side = |at: R, pace: R, extent: f32| {
            let border = W::R::select(pace.lt(zero), zero, w.real(extent));
            W::R::select(pace.eq(zero), never, ((border - at) / pace).max(zero))
        };
        let reach = side(start.x, x, width).min(side(start.y, y, height)).min(eye.max(zero));
        let leaves = reach.lt(range);
        let reach = W::R::select(leaves, reach, range);
        let pixels = reach * x.abs().max(y.abs());
        let step_pixels = settings.step_pixels as f32;
        let count = (-(-(pixels / w.real(step_pixels))).floor()).max(one);
        // A straight line has left the screen after its longer side, but for rounding.
        let can_be_counted = count.lt(w.real((width.max(height) + 2.0) / step_pixels + 2.0));
        let share = reach / count;
        let step = ScreenMarks { x: x * share, y: y * share, depth: depth * share };
        /// Steps in a pixel where the place does not change: more than any march has.
        const STILL: f32 = 1e30;
        let steps_in_pixel = [step.x, step.y].map(|step| (one / step.abs()).min(w.real(STILL)));
        (Self { start, step, count, steps_in_pixel }, !leaves, can_be_counted)
    }

    /// The places after so many steps.
    #[inline(always)]
    pub(crate) fn at(&self, steps: R) -> ScreenMarks<R> {
        ScreenMarks {
            x: steps.times_plus(self.step.x, self.start.x),
            y: steps.times_plus(self.step.y, self.start.y),
            depth: self.depth(steps),
        }
    }

    /// The depths after so many steps.
    #[inline(always)]
    pub(crate) fn depth(&self, steps: R) -> R {
        steps.times_plus(self.step.depth, self.start.depth)
    }
}
