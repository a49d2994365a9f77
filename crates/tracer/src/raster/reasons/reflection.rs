//! Why reflections on the screen and in cube maps differ.

use glam::{DVec2, DVec3, Vec3};

use crate::geometry::ray::Ray;
use crate::raster::cube_map::active::ActiveCubeMaps;
use crate::raster::gbuffer::{GBuffer, GBufferTexel, seen};
use crate::raster::mirrored::reflecting;
use crate::raster::point_shader::vector;
use crate::raster::reasons::reference_pixel::{PixelParts, ReferencePixel};
use crate::raster::reasons::{Reason, ReasonInput, largest};
use crate::raster::screen::way::ScreenView;
use crate::raster::screen::{MarchOutcome, ScreenMarcher};
use crate::raster::settings::{LightModel, SsrFallback, SsrSettings};
use crate::simd::vector::Vector;
use crate::transport::pick::RayIntersection;

/// What a method has for a pixel's reflection.
struct MethodReflection {
    texel: GBufferTexel,
    /// The direction of the reflected ray.
    direction: Vector<f32>,
    /// k_r, 0 if nothing is reflected.
    share: f32,
    /// What the reflected ray found.
    found: Vec3,
}

impl MethodReflection {
    fn of(case: &ReasonInput<'_>, buffer: &GBuffer, pixel: usize) -> Option<Self> {
        let texel = buffer.texel(pixel)?;
        let share = reflecting(case.scene, texel.start.word()).unwrap_or(0.0);
        let view = ScreenView::new(case.camera, buffer.frame.size());
        let direction = view.reflected(texel.position, texel.normal);
        Some(Self { texel, direction, share, found: (*buffer.reflected.get(pixel)?).into() })
    }
}

impl ReasonInput<'_> {
    /// Screen space.
    pub(crate) fn of_screen(
        &self,
        witness: &mut ReferencePixel<'_>,
        how: &SsrSettings,
        ray: Ray,
        (buffer, _): (&GBuffer, &ActiveCubeMaps),
        pixel: usize,
    ) -> Option<Reason> {
        let parts = witness.parts(ray)?;
        let had = MethodReflection::of(self, buffer, pixel)?;
        let screen = ScreenMarcher::new(buffer, self.camera, how);
        let fate = screen.march(pixel, had.direction);
        // A cube map shows the reflections of what is reflected, too.
        let is_mapped =
            !matches!(fate, MarchOutcome::Met(_)) && matches!(how.fallback, SsrFallback::CubeMap(_));
        let second = if is_mapped { Vec3::ZERO } else { parts.second };
        let first = had.found * had.share - (parts.first() + parts.second - second);
        match largest([
            (Reason::RefractionMissing, parts.refracted),
            (Reason::SecondReflectionMissing, second),
            (Reason::Hidden, first),
        ])? {
            Reason::Hidden => self.of_march(witness, &screen, &parts, &had, fate),
            other => Some(other),
        }
    }

    /// Why the march did not find what is reflected.
    fn of_march(
        &self,
        witness: &mut ReferencePixel<'_>,
        screen: &ScreenMarcher<'_>,
        parts: &PixelParts,
        had: &MethodReflection,
        fate: MarchOutcome,
    ) -> Option<Reason> {
        let Some((mirrored, hit)) = parts.mirrored.as_ref().and_then(|ray| Some((ray, ray.hit?))) else {
            // Nothing is reflected but the background: a surface was met that the ray only passes behind, or the map
            // shows something in this direction.
            return Some(if matches!(fate, MarchOutcome::Met(_)) {
                Reason::Thickness
            } else {
                Reason::Parallax
            });
        };
        if f64::from(hit.hit.t) > screen.settings().range {
            return Some(Reason::OutOfRange);
        }
        let at = match self.visibility(witness, &hit, screen.settings().thickness) {
            Ok(at) => at,
            Err(reason) => return Some(reason),
        };
        let MarchOutcome::Met(met) = fate else { return Some(Reason::Step) };
        /// Pixels: within so much a hit is the right one, found a little beside.
        const BESIDE: f64 = 2.0;
        if met.distance(at) > BESIDE * screen.settings().step_pixels.max(1.0) {
            return Some(Reason::Thickness);
        }
        // The right point: is it lit otherwise for the eye than for the mirror?
        let to_eye = vector(self.camera.toward_viewer(self.scene.render_from_world(hit.position)));
        let for_eye = witness.local(self.scene, mirrored, Some(to_eye), LightModel::Phong, true);
        let for_mirror = witness.local(self.scene, mirrored, None, LightModel::Phong, true);
        largest([(Reason::Highlight, for_eye - for_mirror), (Reason::Sampling, had.found - for_eye)])
    }

    /// Where in the picture a point is seen, or why it is not.
    fn visibility(
        &self,
        witness: &mut ReferencePixel<'_>,
        hit: &RayIntersection,
        thickness: f64,
    ) -> Result<DVec2, Reason> {
        /// Of the depth: two points of one body that are this close are the same, seen through rounding.
        const SAME: f64 = 1e-3;
        let size = self.frame.size();
        let projected = self.camera.project(hit.position, size);
        let (at, depth) = projected.filter(|(at, _)| self.frame.holds(*at)).ok_or(Reason::LeftScreen)?;
        let shown = seen(self.scene, self.camera, &mut witness.probe, at, size);
        let behind = depth - f64::from(shown.depth);
        if shown.start.body == hit.hit.body && behind <= SAME * depth {
            return Ok(at);
        }
        Err(if behind > thickness { Reason::Hidden } else { Reason::Thickness })
    }

    /// Cube maps: the way from the truth to the map's light, step by step. What surrounds the body, seen from the point
    /// that reflects; the same, seen from the map's center; the pixels of the map.
    pub(crate) fn of_map(
        &self,
        witness: &mut ReferencePixel<'_>,
        ray: Ray,
        (buffer, maps): (&GBuffer, &ActiveCubeMaps),
        pixel: usize,
    ) -> Option<Reason> {
        let parts = witness.parts(ray)?;
        let had = MethodReflection::of(self, buffer, pixel)?;
        let Some((direction, map)) = maps.looked_up(&had.texel, had.direction) else {
            return largest([
                (Reason::RefractionMissing, parts.refracted),
                (Reason::ReflectionMissing, parts.first() + parts.second),
            ]);
        };
        let from_point = witness.light_of_others(Ray::from_point(had.texel.position, had.direction));
        let direction = direction.normalize_or(DVec3::Y).as_vec3a();
        let from_center = witness.light_of_others(Ray::from_point(map.center().as_vec3a(), direction));
        largest([
            (Reason::RefractionMissing, parts.refracted),
            (Reason::SelfMissing, parts.first() + parts.second - from_point * had.share),
            (Reason::Parallax, (from_point - from_center) * had.share),
            (Reason::Sampling, (from_center - had.found) * had.share),
        ])
    }
}
