//! What the exact picture shows within a pixel and close around it: the bounds of what a right picture may have there.
//!
//! Programs differ in the number of rays of a pixel, in the filter, in whether codes or light are averaged, and in
//! rounding where an edge goes through the middle of a pixel. All of that shows only where rays close to each other find
//! different codes, and only between those codes.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use catoptric_tracer::RenderControl;
use glam::{DVec2, Vec3};
use rayon::prelude::*;

use super::DetectiveError;
use super::codes::CodeStage;
use super::light_law::LightLaw;
use super::mistake::Explanation;
use super::places::PixelChoice;
use super::trials::{RayBeside, Trials};

/// How a pixel stands to the exact picture around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PixelStanding {
    /// A filter of few rays gives that code.
    Filtered {
        /// The squared distance from what the filters give with very many rays.
        excess: f32,
        /// The variance of a single ray.
        variance: f32,
    },
    /// Codes of rays close by enclose it.
    AtEdge,
    /// No ray close by has such a code.
    Beyond,
}

/// The codes of rays through a pixel and close around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Footprint {
    low: Vec3,
    high: Vec3,
    /// The pixel itself, evenly.
    pixel: FilteredCode,
    /// The widest filter.
    wide: FilteredCode,
}

/// The sums of a filter.
#[derive(Clone, Copy, Debug, Default)]
struct FilteredCode {
    weight: f32,
    code: Vec3,
    square: Vec3,
    light: Vec3,
}

impl FilteredCode {
    fn add(&mut self, weight: f32, code: Vec3, light: Vec3) {
        self.weight += weight;
        self.code += weight * code;
        self.square += weight * code * code;
        self.light += weight * light;
    }

    /// The mean of the codes, and the code of the mean light.
    fn means(&self, stage: &CodeStage) -> [Vec3; 2] {
        let weight = self.weight.max(f32::MIN_POSITIVE);
        [self.code / weight, Vec3::from(stage.apply((self.light / weight).to_array()))]
    }

    /// The variance of the code of a single ray.
    fn variance(&self) -> Vec3 {
        let weight = self.weight.max(f32::MIN_POSITIVE);
        let mean = self.code / weight;
        (self.square / weight - mean * mean).max(Vec3::ZERO)
    }
}

impl Footprint {
    /// The distance from the mean of a filter that few rays may have, in standard deviations of a single ray: those of
    /// four rays in a pixel at 2.5 standard deviations of their mean, and of sixteen in a wide filter at two.
    const FEW_RAYS: f32 = 1.25;
    const MORE_RAYS: f32 = 0.5;

    /// The footprints of pixels under an explanation.
    pub(super) fn of_pixels(
        trials: &Trials<'_>,
        explanation: &Explanation,
        (pixels, size): (&[[u32; 2]], [u32; 2]),
        control: &RenderControl,
    ) -> Result<Vec<Self>, DetectiveError> {
        /// Pixels that one thread traces at once.
        const AT_ONCE: usize = 64;
        let law = LightLaw::new(trials.scene(), &explanation.faults);
        let part = |pixels: &[[u32; 2]]| {
            let choice = PixelChoice { size, pixels: pixels.to_vec(), pairs: Vec::new() };
            let mut all = vec![Self::default(); pixels.len()];
            let mut sums = Vec::new();
            for offset in explanation.offset.rays() {
                for (sample, ray) in (0..).zip(FootprintRay::all()) {
                    let beside = RayBeside { at: ray.at, sample: Some(sample) };
                    let trees = trials.traced_beside(&choice, explanation, (offset, beside), control)?;
                    for (place, footprint) in all.iter_mut().enumerate() {
                        footprint.add(ray, trees.light(place, &law, &mut sums), &explanation.stage);
                    }
                }
            }
            Ok::<_, DetectiveError>(all)
        };
        let parts: Vec<Vec<Self>> = pixels.par_chunks(AT_ONCE).map(part).collect::<Result<_, _>>()?;
        Ok(parts.concat())
    }

    fn add(&mut self, ray: &FootprintRay, light: [f32; 3], stage: &CodeStage) {
        let code = Vec3::from(stage.apply(light));
        (self.low, self.high) = (self.low.min(code), self.high.max(code));
        self.wide.add(ray.weight, code, Vec3::from(light));
        if ray.is_in_pixel {
            self.pixel.add(1.0, code, Vec3::from(light));
        }
    }

    /// How a code stands to it, the ray through the middle having the code `middle`.
    pub(super) fn standing(
        &self,
        found: [f32; 3],
        middle: [f32; 3],
        stage: &CodeStage,
        tolerance: f32,
    ) -> PixelStanding {
        let [found, middle] = [found, middle].map(Vec3::from);
        let (low, high) = (self.low.min(middle), self.high.max(middle));
        let is_within =
            |low: Vec3, high: Vec3| found.cmpge(low - tolerance).all() && found.cmple(high + tolerance).all();
        if !is_within(low, high) {
            return PixelStanding::Beyond;
        }
        let means = [self.pixel.means(stage), self.wide.means(stage)];
        let means = means.as_flattened().iter().copied();
        let least = means.clone().fold(Vec3::INFINITY, Vec3::min);
        let most = means.fold(Vec3::NEG_INFINITY, Vec3::max);
        let deviation = |filter: &FilteredCode| filter.variance().map(f32::sqrt);
        let slack = (Self::FEW_RAYS * deviation(&self.pixel)).max(Self::MORE_RAYS * deviation(&self.wide));
        if !is_within(least.min(middle) - slack, most.max(middle) + slack) {
            return PixelStanding::AtEdge;
        }
        PixelStanding::Filtered {
            excess: (found - found.clamp(least, most)).length_squared(),
            variance: self.wide.variance().element_sum(),
        }
    }
}

impl Default for Footprint {
    fn default() -> Self {
        let (low, high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        Self { low, high, pixel: FilteredCode::default(), wide: FilteredCode::default() }
    }
}

/// A ray beside the middle of a pixel: some spread evenly over the pixel, others over what else the widest filter of a
/// right picture reaches. That is the usual Gaussian, of a standard deviation of half a pixel and cut off at three; box and
/// tent are narrower.
struct FootprintRay {
    /// From the middle, pixels.
    at: DVec2,
    /// Whether it goes through the pixel itself.
    is_in_pixel: bool,
    /// By the Gaussian.
    weight: f32,
}

impl FootprintRay {
    /// Rays in the pixel, around it, and at the border of the filter.
    const COUNTS: [usize; 3] = [40, 48, 8];
    /// Where the filter ends, pixels.
    const REACH: f64 = 1.5;

    fn all() -> &'static [Self] {
        static ALL: OnceLock<Vec<FootprintRay>> = OnceLock::new();
        ALL.get_or_init(|| {
            let [inside, around, border] = Self::COUNTS;
            // Each ray around stands for the larger area.
            let area = (4.0 * Self::REACH * Self::REACH - 1.0) / around as f64 * inside as f64;
            // In pairs about the middle, so that on average they lie there.
            let points = || (1..).map(|number| spread(number) - 0.5).flat_map(|at| [at, -at]);
            let is_outside = |at: &DVec2| at.abs().max_element() > 0.5;
            let own = points().map(|at| Self::new(at, 1.0));
            let others = points().map(|at| 2.0 * Self::REACH * at).filter(is_outside);
            let others = others.map(|at| Self::new(at, area));
            let angle = |number: usize| TAU * number as f64 / border as f64;
            let corners = (0..border).map(|number| Self::new(Self::on_border(angle(number)), area));
            own.take(inside).chain(others.take(around)).chain(corners).collect()
        })
    }

    fn new(at: DVec2, area: f64) -> Self {
        let is_in_pixel = at.abs().max_element() <= 0.5;
        Self { at, is_in_pixel, weight: (area * (-2.0 * at.length_squared()).exp()) as f32 }
    }

    /// The point of the border of the filter, a square, in this direction.
    fn on_border(angle: f64) -> DVec2 {
        let direction = DVec2::from_angle(angle);
        Self::REACH * direction / direction.abs().max_element()
    }
}

/// The points of Roberts' sequence R2 (2018) in a square: multiples of the powers of the inverse of the plastic number, the
/// root of x³ = x + 1.
fn spread(number: usize) -> DVec2 {
    (0.5 + DVec2::new(0.754_877_666_246_692_7, 0.569_840_290_998_053_2) * number as f64).fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_have_the_moments_of_the_pixel_and_of_the_gaussian() {
        let moments = |weight: &dyn Fn(&FootprintRay) -> f64| {
            let sum = |value: &dyn Fn(&FootprintRay) -> DVec2| {
                FootprintRay::all().iter().map(|ray| weight(ray) * value(ray)).sum::<DVec2>()
            };
            let whole = sum(&|_| DVec2::ONE);
            [sum(&|ray| ray.at) / whole, sum(&|ray| ray.at * ray.at) / whole]
        };
        let is_near =
            |value: DVec2, expected: f64, bound: f64| (value - expected).abs().max_element() < bound;
        let [mean, square] = moments(&|ray| f64::from(u8::from(ray.is_in_pixel)));
        assert!(is_near(mean, 0.0, 1e-6) && is_near(square, 1.0 / 12.0, 0.005), "{mean} {square}");
        let [mean, square] = moments(&|ray| f64::from(ray.weight));
        // That of the Gaussian that is cut off: 1/4 · (1 − 6 φ(3) / (2 Φ(3) − 1)), of fewer than a hundred points.
        assert!(is_near(mean, 0.0, 1e-6) && is_near(square, 0.2433, 0.03), "{mean} {square}");
    }
}
