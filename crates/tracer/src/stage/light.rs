//! Lights of the stage.

use super::numbers;
use crate::lanes::Real;
use crate::vector::Vector;
use catoptric_scene::{Falloff, Light};

/// A point light: where it is and what it sends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StageLight {
    /// World position, meters.
    pub position: [f32; 3],
    /// Color times intensity, I_j.
    pub power: [f32; 3],
    /// Law of falloff.
    pub falloff: StageFalloff,
}

/// Law of falloff A(d).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StageFalloff {
    /// A(d) = 1.
    None,
    /// A(d) = 1 / (d + K), with K in meters.
    Linear(f32),
    /// A(d) = 1 / d².
    InverseSquare,
}

impl StageLight {
    pub(super) fn new(light: &Light) -> Self {
        Self {
            position: light.position.as_vec3().to_array(),
            power: numbers(light.color).map(|part| part * light.intensity as f32),
            falloff: match light.falloff {
                Falloff::None => StageFalloff::None,
                Falloff::Linear { constant } => StageFalloff::Linear(constant as f32),
                Falloff::InverseSquare => StageFalloff::InverseSquare,
            },
        }
    }

    /// Whether it sends anything.
    pub(crate) fn shines(&self) -> bool {
        self.power != [0.0; 3]
    }

    /// A(d)·I_j at the distance `d` > 0.
    #[inline(always)]
    pub(crate) fn power_at<R: Real>(&self, d: R) -> Vector<R> {
        let power = Vector::splat(d, self.power);
        let divisor = match self.falloff {
            StageFalloff::None => return power,
            StageFalloff::Linear(constant) => d + constant,
            StageFalloff::InverseSquare => d * d,
        };
        // Infinite light on a surface that returns none of it would not be a number.
        power.map(|part| (part / divisor).min(d.like(f32::MAX)))
    }
}
