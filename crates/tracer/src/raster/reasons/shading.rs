//! Why shaded faces differ.

use glam::Vec3;

use crate::geometry::ray::{NO_BODY, Ray};
use crate::raster::method::Method;
use crate::raster::reasons::reference_pixel::ReferencePixel;
use crate::raster::reasons::{Reason, ReasonInput, largest};
use crate::raster::settings::{LightModel, ShadingSettings};

impl ReasonInput<'_> {
    /// `body` is what the pixel shows, `drawn` its light.
    pub(crate) fn of_shading(
        &self,
        witness: &mut ReferencePixel<'_>,
        how: &ShadingSettings,
        ray: Ray,
        body: u32,
        drawn: Vec3,
    ) -> Option<Reason> {
        let parts = witness.parts(ray)?;
        if parts.primary.hit.map_or(NO_BODY, |hit| hit.hit.body) != body {
            return Some(Reason::Facet);
        }
        let mut local = |model, shadows| witness.local(self.scene, &parts.primary, None, model, shadows);
        // From the truth to what the method would draw if its faces were the bodies, step by step.
        let truth = local(LightModel::Phong, true);
        let unshaded = local(LightModel::Phong, how.shadows);
        let meant = local(how.model, how.shadows);
        let of_faces =
            if matches!(self.method, Method::Gouraud(_)) { Reason::Shading } else { Reason::Facet };
        largest([
            (Reason::ReflectionMissing, parts.first() + parts.second),
            (Reason::RefractionMissing, parts.refracted),
            (Reason::ShadowMissing, unshaded - truth),
            (Reason::Highlight, meant - unshaded),
            (of_faces, drawn - meant),
        ])
    }
}
