//! Lights of the stage.

use catoptric_scene::{Falloff, Light};
use glam::Vec3A;

use super::vec3;

/// A point light: where it is and what it sends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StageLight {
    /// World position, meters.
    pub position: Vec3A,
    /// Color times intensity, I_j.
    pub power: Vec3A,
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
            position: light.position.as_vec3a(),
            power: vec3(light.color) * light.intensity as f32,
            falloff: match light.falloff {
                Falloff::None => StageFalloff::None,
                Falloff::Linear { constant } => StageFalloff::Linear(constant as f32),
                Falloff::InverseSquare => StageFalloff::InverseSquare,
            },
        }
    }

    /// A(d)·I_j at the distance `d` > 0.
    pub(crate) fn power_at(&self, d: f32) -> Vec3A {
        let power = match self.falloff {
            StageFalloff::None => self.power,
            StageFalloff::Linear(constant) => self.power / (d + constant),
            StageFalloff::InverseSquare => self.power / (d * d),
        };
        // Infinite light on a surface that returns none of it would not be a number.
        power.min(Vec3A::splat(f32::MAX))
    }
}
