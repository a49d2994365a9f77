//! Metals.

use catoptric_optics::{METALS, Metal, fresnel};
use glam::DVec3;

use crate::color::Color;
use crate::material::{Share, largest};

/// The smooth or rough surface of a metal: reflects by Fresnel's formulas, and lets nothing through.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Conductor {
    /// What it is made of. Default silver.
    pub metal: MetalOptics,
    /// How rough the surface is, 0 (the default, smooth) to 1: the square root of the width α of the slopes of its
    /// facets.
    pub roughness: f64,
}

impl Conductor {
    pub(super) fn reflects(&self) -> Share {
        Share::fresnel(match self.metal {
            MetalOptics::Metal(_) => largest(self.metal.color()).min(1.0),
            MetalOptics::Index { .. } => largest(self.metal.color()),
        })
    }
}

/// The optical constants of a metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MetalOptics {
    /// A measured metal.
    Metal(&'static Metal),
    /// Refractive index n and extinction coefficient k for red, green and blue light.
    Index {
        /// n.
        n: DVec3,
        /// k.
        k: DVec3,
    },
}

impl MetalOptics {
    /// The color that it has when white light falls in straight. A measured metal's may be a little above 1.
    pub fn color(self) -> Color {
        match self {
            Self::Metal(metal) => metal.reflectance(1.0, 1.0).into(),
            Self::Index { n, k } => {
                let straight = |n, k| fresnel::conductor(1.0, n, k).mean();
                Color::new(straight(n.x, k.x), straight(n.y, k.y), straight(n.z, k.z))
            }
        }
    }
}

impl Default for MetalOptics {
    fn default() -> Self {
        Self::Metal(DEFAULT_METAL)
    }
}

/// The metal that a conductor is unless it says otherwise.
pub(crate) const DEFAULT_METAL: &Metal = {
    let mut at = 0;
    while !is_same(METALS[at].name, "silver") {
        at += 1;
    }
    &METALS[at]
};

/// Names of metals, for scene files.
pub(crate) const METAL_NAMES: [&str; METALS.len()] = {
    let mut names = [""; METALS.len()];
    let mut at = 0;
    while at < names.len() {
        names[at] = METALS[at].name;
        at += 1;
    }
    names
};

const fn is_same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    let mut at = 0;
    while at < one.len() && at < other.len() && one[at] == other[at] {
        at += 1;
    }
    at == one.len() && at == other.len()
}
