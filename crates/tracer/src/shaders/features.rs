//! What a scene has of physical materials and lights.

use std::ops::BitOr;

use crate::transport::scene::RenderScene;
use crate::transport::surface::material::RenderMaterial;
use crate::transport::surface::model::MaterialModel;

/// What a scene has of physical materials and lights, a bit for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PhysicalFeatures(u32);

impl PhysicalFeatures {
    /// Neither physical materials nor lights that are balls, nor cemented bodies.
    pub const NOTHING: Self = Self(0);
    /// Surfaces that reflect by a law of their own.
    pub const LAWS: Self = Self(1);
    /// Metals, which have curves.
    pub const METALS: Self = Self(1 << 1);
    /// Rough surfaces.
    pub const FACETS: Self = Self(1 << 2);
    /// Bodies in which light is lost.
    pub const ABSORBS: Self = Self(1 << 3);
    /// Bodies that split light.
    pub const DISPERSES: Self = Self(1 << 4);
    /// Lights that are balls.
    pub const BALLS: Self = Self(1 << 5);
    /// Bodies that are cemented to what they touch.
    pub const CEMENTED: Self = Self(1 << 6);
    /// Everything that there is.
    pub const ALL: Self = Self((1 << 7) - 1);

    /// Whether all of `other` is there.
    pub const fn has(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    pub(crate) fn of(scene: &RenderScene) -> Self {
        let any = |test: fn(&RenderMaterial) -> bool| scene.materials.iter().any(test);
        let found = [
            (Self::LAWS, any(|material| !matches!(material.law, MaterialModel::Constant))),
            (Self::METALS, any(|material| matches!(material.law, MaterialModel::Conductor(_)))),
            (Self::FACETS, any(|material| material.alpha > 0.0)),
            (Self::ABSORBS, any(RenderMaterial::absorbs)),
            (Self::DISPERSES, any(|material| material.dispersion.is_some())),
            (Self::BALLS, scene.lights.iter().any(|light| light.radius > 0.0)),
            (Self::CEMENTED, scene.geometry.has_cemented),
        ];
        found.into_iter().filter(|(_, is_there)| *is_there).fold(Self::NOTHING, |all, (one, _)| all | one)
    }
}

impl BitOr for PhysicalFeatures {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}
