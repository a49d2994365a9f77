//! The parts of rays that lie on the screen.

use glam::DVec2;

use crate::raster::projection::HomogeneousPoints;
use crate::raster::settings::SsrSettings;
use crate::simd::Float as _;
use crate::simd::double::{Float64, Mask64};

/// The parts of rays that lie on the screen. From the start (s = 0) to the end (s = 1) of each, its place on the screen
/// changes evenly; so do 1/w and t/w, whatever the projection.
pub(crate) struct ScreenRays<const N: usize> {
    /// Of the start, and of a unit of t.
    depths: [Float64<N>; 2],
    starts: [Float64<N>; 2],
    ends: [Float64<N>; 2],
    inverse_w: [Float64<N>; 2],
    /// t/w at the end.
    far: Float64<N>,
    /// Into how many steps they are divided; infinite where they cannot be counted.
    pub(crate) count: Float64<N>,
    /// The last step that may lie on the screen.
    pub(crate) last: Float64<N>,
    /// Across and down: pixels in a step, and steps in a pixel (a large number where the place does not change).
    pub(crate) pace: [[Float64<N>; 2]; 2],
}

/// Points of rays on the screen, side by side.
#[derive(Clone, Copy)]
pub(crate) struct ScreenMarks<const N: usize> {
    pub(crate) x: Float64<N>,
    pub(crate) y: Float64<N>,
    pub(crate) depth: Float64<N>,
}

impl<const N: usize> ScreenRays<N> {
    /// The parts of rays on a screen of `size` pixels; and which of them end where the range does, else they leave the
    /// screen.
    #[inline(always)]
    pub(crate) fn new(
        from: HomogeneousPoints<N>,
        along: HomogeneousPoints<N>,
        size: DVec2,
        settings: &SsrSettings,
    ) -> (Self, Mask64<N>) {
        let (range, side) = (Float64([settings.range; N]), reach(from, along, size));
        let leaves = side.lt(range);
        let t = Float64::select(leaves, side, range);
        let end = from.at + along.at * t;
        let starts = [from.at.x / from.at.z, from.at.y / from.at.z];
        let ends = [end.x / end.z, end.y / end.z];
        let one = Float64([1.0; N]);
        let mut all = Self {
            depths: [from.depth, along.depth],
            starts,
            ends,
            inverse_w: [one / from.at.z, one / end.z],
            far: t / end.z,
            count: one,
            last: one,
            pace: [[one; 2]; 2],
        };
        all.divide(settings.step_pixels, size);
        (all, !leaves)
    }

    /// Divides them into steps of `step_pixels` along their longer sides, on a screen of `size` pixels.
    ///
    /// The end is on the screen but for rounding. Close to the plane of the eye that may carry it anywhere, so that the
    /// march is bounded by the screen itself: a straight line has left it after its longer side.
    #[inline(always)]
    fn divide(&mut self, step_pixels: f64, size: DVec2) {
        /// Steps in a pixel where the place does not change: more than any march has.
        const STILL: f64 = 1e300;
        let (zero, one) = (Float64([0.0; N]), Float64([1.0; N]));
        let sides = [self.ends[0] - self.starts[0], self.ends[1] - self.starts[1]];
        let pixels = sides[0].abs().max(sides[1].abs());
        self.count = (-(-(pixels / Float64([step_pixels; N]))).floor()).max(one);
        let most = ((size.max_element() + 2.0) / step_pixels).ceil();
        self.last = self.count.min(Float64([most; N]));
        for (side, both) in sides.into_iter().zip(&mut self.pace) {
            let pace = side / self.count;
            *both = [pace, Float64::select(pace.eq(zero), Float64([STILL; N]), one / pace)];
        }
    }

    /// Which of them can be divided into steps.
    #[inline(always)]
    pub(crate) fn can_be_counted(&self) -> Mask64<N> {
        self.count.lt(Float64([f64::INFINITY; N]))
    }

    /// The share of the way at the end of so many steps.
    #[inline(always)]
    pub(crate) fn share(&self, step: Float64<N>) -> Float64<N> {
        step / self.count
    }

    #[inline(always)]
    pub(crate) fn at(&self, s: Float64<N>) -> ScreenMarks<N> {
        let inverse_w = self.inverse_w[0] + (self.inverse_w[1] - self.inverse_w[0]) * s;
        let t = self.far * s / inverse_w;
        let rest = Float64([1.0; N]) - s;
        ScreenMarks {
            x: self.starts[0] * rest + self.ends[0] * s,
            y: self.starts[1] * rest + self.ends[1] * s,
            depth: self.depths[0] + t * self.depths[1],
        }
    }
}

/// How far rays stay on a screen of `size` pixels and before the eye, meters.
#[inline(always)]
fn reach<const N: usize>(from: HomogeneousPoints<N>, along: HomogeneousPoints<N>, size: DVec2) -> Float64<N> {
    /// Of the start's w: nearer to the plane of the eye a ray is far beside the picture.
    const NEAR: f64 = 1e-6;
    let zero = Float64([0.0; N]);
    let starts = insides(from, Float64([NEAR; N]) * from.at.z, size);
    let slopes = insides(along, zero, size);
    let mut least = Float64([f64::INFINITY; N]);
    for side in 0..starts.len() {
        let (start, slope) = (starts[side], slopes[side]);
        let t = start.max(zero) / -slope;
        least = Float64::select(slope.lt(zero), t.min(least), least);
    }
    least
}

/// Numbers that are positive on the screen and before the eye, and linear along a ray.
#[inline(always)]
fn insides<const N: usize>(
    HomogeneousPoints { at, depth }: HomogeneousPoints<N>,
    near: Float64<N>,
    size: DVec2,
) -> [Float64<N>; 6] {
    let [width, height] = [Float64([size.x; N]), Float64([size.y; N])];
    [at.x, width * at.z - at.x, at.y, height * at.z - at.y, at.z - near, depth]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_march_has_more_steps_than_the_screen_has_pixels() {
        let size = DVec2::new(320.0, 200.0);
        let divided = |end: DVec2, step_pixels: f64| {
            let one = Float64([1.0]);
            let mut way = ScreenRays {
                depths: [one; 2],
                starts: [Float64([10.0]), Float64([20.0])],
                ends: [Float64([end.x]), Float64([end.y])],
                inverse_w: [one; 2],
                far: one,
                count: one,
                last: one,
                pace: [[one; 2]; 2],
            };
            way.divide(step_pixels, size);
            (way.count.0[0], way.last.0[0])
        };
        for power in -3..300 {
            let end = DVec2::new(10.0, 20.0) + DVec2::new(0.3, -1.0) * 10.0_f64.powi(power);
            for step_pixels in [0.5, 1.0, 7.0] {
                let (count, last) = divided(end, step_pixels);
                assert!(last >= 1.0 && last <= count && last <= 322.0 / step_pixels + 1.0, "{end}: {last}");
                // Whatever is on the screen is marched through.
                assert!(last == count || count * step_pixels > 320.0, "{end}: {last} of {count}");
            }
        }
        for end in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let (_, last) = divided(DVec2::splat(end), 1.0);
            assert!((1.0..=323.0).contains(&last), "{end}: {last}");
        }
    }
}
