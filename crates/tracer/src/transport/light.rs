//! Lights of the scene.

use catoptric_scene::{Falloff, Light};

use crate::geometry::space::RenderSpace;
use crate::simd::vector::{MOST_LIGHT, Vector};
use crate::simd::{Float as _, Float32, Width};
use crate::transport::color::linear_rgb;
use crate::transport::sampling::Sample2D;
use crate::transport::surface::mend_unit;
use crate::transport::surface::microfacet::frame;

/// A light: where it is and what it sends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RenderLight {
    /// Position in the space of the rays, meters.
    pub position: [f32; 3],
    /// Color times intensity, I_j.
    pub power: [f32; 3],
    /// Law of falloff.
    pub falloff: LightFalloff,
    /// Radius of the ball that shines, meters; 0 is a point.
    pub radius: f32,
    /// Whether it sends anything.
    pub shines: bool,
}

/// Law of falloff A(d).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LightFalloff {
    /// A(d) = 1.
    None,
    /// A(d) = 1 / (d + K), with K in meters.
    Linear(f32),
    /// A(d) = 1 / d².
    InverseSquare,
}

impl RenderLight {
    pub(crate) fn new(light: &Light, space: &RenderSpace) -> Self {
        let power = linear_rgb(light.color).map(|part| part * light.intensity as f32);
        Self {
            position: space.render_from_world(light.position).as_vec3().to_array(),
            power,
            falloff: match light.falloff {
                Falloff::None => LightFalloff::None,
                Falloff::Linear { constant } => LightFalloff::Linear(constant as f32),
                Falloff::InverseSquare => LightFalloff::InverseSquare,
            },
            radius: light.radius as f32,
            shines: power != [0.0; 3],
        }
    }

    /// A point of the ball as it is seen from a distance `d` in a direction: the direction to it, its distance, and what
    /// its light is multiplied with. All directions to the ball are as likely (P. Shirley, C. Wang, K. Zimmerman 1996, Monte
    /// Carlo techniques for direct lighting calculations).
    ///
    /// The mean of these is the light of the point in the middle, on a ground that faces all of the ball. Who stands in the
    /// ball gets light from the half-space of its middle.
    #[inline(always)]
    pub(crate) fn sample_sphere<W: Width>(
        &self,
        (to_middle, d): (Vector<W::R>, W::R),
        sample: &Sample2D<W>,
    ) -> (Vector<W::R>, W::R, W::R) {
        let (zero, one) = (d.like(0.0), d.like(1.0));
        let radius = d.like(self.radius);
        let sin_of_cone = (radius / d).min(one);
        let square = sin_of_cone * sin_of_cone;
        let least = (one - square).sqrt();
        // 1 - cos, of which a cosine in single precision keeps no digit below an angle of 2⋅10⁻⁴.
        let inverse = one / (one + least);
        let versine = sample.second * square * inverse;
        let cos = one - versine;
        let sin = (versine * (one + cos)).sqrt();
        let (right, up) = frame(to_middle);
        let direction = to_middle * cos + right * (sin * sample.cos) + up * (sin * sample.sin);
        let beside = d * sin;
        let before = d * cos - ((radius - beside) * (radius + beside)).max(zero).sqrt();
        (mend_unit(direction), before.max(zero), inverse * 2.0)
    }

    /// A(d)·I_j at the distance `d` > 0.
    #[inline(always)]
    pub(crate) fn power_at<R: Float32>(&self, d: R) -> Vector<R> {
        let power = Vector::splat(d, self.power);
        let divisor = match self.falloff {
            LightFalloff::None => return power,
            LightFalloff::Linear(constant) => d + constant,
            LightFalloff::InverseSquare => d * d,
        };
        // Infinite light on a surface that returns none of it would not be a number.
        power.map(|part| (part / divisor).min(d.like(MOST_LIGHT)))
    }
}
