//! The models of materials: how much a surface reflects under which angle, and what it scatters.

pub(crate) mod coated;
pub(crate) mod conductor;
pub(crate) mod thin_dielectric;

use std::sync::Arc;

use crate::simd::Width;
use crate::transport::surface::bsdf::{Bsdf, SurfaceColors};
use crate::transport::surface::material::RenderMaterial;
use crate::transport::surface::model::coated::CoatedMaterial;
use crate::transport::surface::model::conductor::ConductorTable;
use crate::transport::surface::model::thin_dielectric::ThinDielectricMaterial;

/// How much a surface reflects under which angle.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum MaterialModel {
    /// k_r under any.
    Constant,
    /// k_r and k_t of a clear body, weighed by Schlick's formula.
    Schlick,
    /// C·k_r under any.
    Mirror,
    /// By Fresnel's formulas with the indices of refraction on either side; the rest goes on.
    Dielectric,
    /// By Fresnel's formulas for the spectrum of a metal.
    Conductor(Arc<ConductorTable>),
    /// By Fresnel's formulas, out of air; the rest is scattered below.
    Coat(CoatedMaterial),
    /// By Fresnel's formulas at both faces of a thin sheet; the rest goes straight on.
    ThinDielectric(ThinDielectricMaterial),
}

impl MaterialModel {
    /// Which it is.
    pub(crate) fn name(&self) -> ReflectionModel {
        match self {
            Self::Constant => ReflectionModel::Constant,
            Self::Schlick => ReflectionModel::Schlick,
            Self::Mirror => ReflectionModel::Mirror,
            Self::Dielectric => ReflectionModel::Dielectric,
            Self::Conductor(_) => ReflectionModel::Conductor,
            Self::Coat(_) => ReflectionModel::Coat,
            Self::ThinDielectric(_) => ReflectionModel::ThinDielectric,
        }
    }

    /// Takes up the lobes of surfaces of such a material, besides those of its coefficients, that rays `lanes` met under
    /// angles of these cosines.
    #[inline(always)]
    pub(crate) fn add_lobes<W: Width>(
        &self,
        w: W,
        bsdf: &mut Bsdf<W>,
        (material, colors, ambient): (&RenderMaterial, SurfaceColors<W::R>, [f32; 3]),
        cos: W::R,
        lanes: W::M,
    ) {
        match self {
            Self::Constant => {}
            Self::Schlick => bsdf.weighed = bsdf.weighed | lanes,
            Self::Mirror => bsdf.set_tint(colors.color * w.real(material.reflection), lanes),
            Self::Dielectric => {
                bsdf.dielectric = bsdf.dielectric | lanes;
                if material.dispersion.is_some() {
                    bsdf.disperses = bsdf.disperses | lanes;
                }
            }
            Self::Conductor(curve) => bsdf.set_tint(conductor::reflectances(w, curve, cos), lanes),
            Self::Coat(coat) => {
                let even = ambient.map(|light| light * material.ambient);
                coat.add_lobes(w, bsdf, colors, even, cos, lanes);
            }
            Self::ThinDielectric(sheet) => sheet.add_lobes(w, bsdf, cos, lanes),
        }
    }
}

/// By which law a surface reflects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReflectionModel {
    /// Whitted's k_r under every angle.
    Constant,
    /// Whitted's k_r and k_t, weighed by Schlick's formula for the indices on either side.
    Schlick,
    /// A mirror's color under every angle.
    Mirror,
    /// Fresnel's formulas for the indices on either side; the rest goes on.
    Dielectric,
    /// Fresnel's formulas for a metal.
    Conductor,
    /// Fresnel's formulas for a clear coat; the rest is scattered below it.
    Coat,
    /// Fresnel's formulas for both faces of a thin sheet; the rest goes straight on.
    ThinDielectric,
}

impl ReflectionModel {
    /// Its name in machine-readable output.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Schlick => "schlick",
            Self::Mirror => "mirror",
            Self::Dielectric => "dielectric",
            Self::Conductor => "conductor",
            Self::Coat => "coat",
            Self::ThinDielectric => "thin-dielectric",
        }
    }

    /// Whether the surface has a ground that scatters light: ambient and diffuse terms.
    pub const fn has_ground(self) -> bool {
        matches!(self, Self::Constant | Self::Schlick | Self::Coat)
    }
}
