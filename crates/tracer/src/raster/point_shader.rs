//! One thread's means of asking the scene: what a ray meets, and how a point is lit.

use glam::DVec3;

use crate::geometry::body::{RenderBody, SurfacePoint};
use crate::geometry::membership::{BodyMembership, MembershipSource as _};
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::{HitRecord, RayQuery, found_in};
use crate::geometry::ray::{Ray, RayOrigin};
use crate::raster::settings::LightModel;
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float32 as _, MOST_LANES, SimdKernel, Width};
use crate::transport::camera::RenderCamera;
use crate::transport::counts::RayCounts;
use crate::transport::interaction::SurfaceInteraction;
use crate::transport::media::AIR;
use crate::transport::media::transmittance::Transmittance;
use crate::transport::path::{PathObserver, PathState};
use crate::transport::sampler::Sampler;
use crate::transport::scene::RenderScene;
use crate::transport::shading::{PacketSource, ShadingContext};
use crate::transport::surface::bsdf::BsdfValue;
use crate::transport::texture::solid::patterned;

/// A point of a surface that is to be lit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadingPoint {
    /// Body and side.
    pub(crate) start: RayOrigin,
    /// World space, meters.
    pub(crate) position: Vector<f32>,
    /// Unit normal on the viewer's side.
    pub(crate) normal: Vector<f32>,
    /// Unit direction to the viewer.
    pub(crate) to_viewer: Vector<f32>,
    /// The pixel that it belongs to, by the count of the sampler; 0 where samples are centered.
    pub(crate) pixel: u32,
}

/// What a surface answers, before its color C is known: the color may change within a face, the light does not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DirectLight {
    /// What the color is multiplied with: k_a·I_a + Σ V·A·I·k_d·(n̂·L̂).
    pub(crate) on_color: Vector<f32>,
    /// Σ V·A·I·k_s·(Ŝ·R̂)ⁿ.
    pub(crate) highlight: Vector<f32>,
}

impl DirectLight {
    const NOTHING: Self = {
        let nothing = Vector { x: 0.0, y: 0.0, z: 0.0 };
        Self { on_color: nothing, highlight: nothing }
    };

    /// The light that leaves a surface of this color.
    pub(crate) fn with_color(&self, color: Vector<f32>) -> Vector<f32> {
        self.on_color.times(color) + self.highlight
    }
}

/// Asks a scene; reusable from point to point by one thread. Counts the rays it sends.
pub(crate) struct PointShader<'a> {
    shading: ShadingContext<'a>,
    /// The list of media around the start of primary rays; points that they meet are lit from within these.
    media: u32,
}

impl<'a> PointShader<'a> {
    pub(crate) fn new(scene: &'a RenderScene, camera: &'a RenderCamera) -> Self {
        let mut shader = Self { shading: ShadingContext::new(scene, camera), media: AIR };
        shader.stand_at(vector(camera.position()));
        shader
    }

    /// The rays so far.
    pub(crate) fn counts(&self) -> RayCounts {
        self.shading.counts
    }

    /// From now on, primary rays start here.
    pub(crate) fn stand_at(&mut self, point: Vector<f32>) {
        let ShadingContext { scene, media, membership, .. } = &mut self.shading;
        if scene.geometry.has_transparency {
            media.trim();
            self.media = media.at_point(scene, point);
            media.fill::<ScalarWidth>(membership, self.media, true);
        }
    }

    /// What a primary ray meets.
    pub(crate) fn primary(&mut self, ray: &Ray) -> Option<HitRecord> {
        if self.shading.camera.eye().is_none() {
            self.stand_at(ray.origin.into());
        }
        let ShadingContext { scene, stack, membership, counts, .. } = &mut self.shading;
        counts.primary += 1;
        let rays = ray.alone();
        let query = RayQuery::new(ScalarWidth, &scene.geometry, &rays, true, membership, Candidates::All);
        found_in(&query.closest_hit(stack))
    }

    /// The samples of lights that are balls belong to these pixels from now on.
    pub(crate) fn begin_sample(&mut self, sampler: Sampler) {
        self.shading.sampler = sampler;
    }

    /// The local terms at a point, for surfaces of color 1.
    pub(crate) fn light(&mut self, at: &ShadingPoint, model: LightModel, shadows: bool) -> DirectLight {
        let mut light = [DirectLight::NOTHING];
        PointKernel { shader: self, points: &[*at], model, shadows, light: &mut light }.run(ScalarWidth);
        light[0]
    }

    /// The local terms at all of these points, for surfaces of color 1: as [`Self::light`] has them, many at a time.
    pub(crate) fn light_all(
        &mut self,
        points: &[ShadingPoint],
        model: LightModel,
        shadows: bool,
    ) -> Vec<DirectLight> {
        let mut light = vec![DirectLight::NOTHING; points.len()];
        let level = self.shading.scene.lanes;
        level.run_in_few(PointKernel { shader: self, points, model, shadows, light: &mut light });
        light
    }
}

/// Lights points.
struct PointKernel<'k, 'a> {
    shader: &'k mut PointShader<'a>,
    points: &'k [ShadingPoint],
    model: LightModel,
    shadows: bool,
    light: &'k mut [DirectLight],
}

impl SimdKernel for PointKernel<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, w: W) {
        let Self { shader, points, model, shadows, light } = self;
        let membership = std::mem::take(&mut shader.shading.membership);
        // Membership of the eye's bodies, a bit for each ray.
        let mut side_by_side = BodyMembership::default();
        shader.shading.media.fill::<W>(&mut side_by_side, w.word(shader.media), w.first(W::LANES));
        for (points, light) in points.chunks(W::LANES).zip(light.chunks_mut(W::LANES)) {
            shader.light_packet(w, points, model, shadows, &side_by_side).store(light);
        }
        shader.shading.membership = membership;
    }
}

impl PointShader<'_> {
    #[inline(always)]
    fn light_packet<W: Width>(
        &mut self,
        w: W,
        points: &[ShadingPoint],
        model: LightModel,
        shadows: bool,
        membership: &BodyMembership,
    ) -> SplitLight<W> {
        let lanes = w.first(points.len());
        let mut rows = [[0.0; MOST_LANES]; 9];
        let (mut starts, mut pixels) = ([0; MOST_LANES], [0; MOST_LANES]);
        for (lane, point) in points.iter().enumerate() {
            let vectors = [point.position, point.normal, -point.to_viewer];
            for (rows, Vector { x, y, z }) in rows.chunks_exact_mut(3).zip(vectors) {
                (rows[0][lane], rows[1][lane], rows[2][lane]) = (x, y, z);
            }
            (starts[lane], pixels[lane]) = (point.start.word(), point.pixel);
        }
        let vector = |first: usize| {
            Vector::new(w.load(&rows[first]), w.load(&rows[first + 1]), w.load(&rows[first + 2]))
        };
        let (position, normal, direction) = (vector(0), vector(3), vector(6));
        let start = w.load_words(&starts);
        let mut paths = PathState { lanes, pixel: w.load_words(&pixels), ..PathState::from_eye(w) };
        paths.media = w.word(self.media);
        paths.rays.direction = direction;
        let white = |_: &RenderBody, _| Vector::splat(w.real(0.0), [1.0; 3]);
        let points = (position, normal);
        let scene = self.shading.scene;
        let mut at = SurfaceInteraction::at_points::<true>(w, scene, start, points, direction, lanes, white);
        if model == LightModel::Lambert {
            (at.bsdf.glossy, at.bsdf.rough) = (w.mask(0), w.mask(0));
        }
        let mut split = SplitLight::new(w, &at);
        let mut from = if shadows { PacketSource::Anywhere } else { PacketSource::Unshadowed };
        self.shading.direct_light::<W, true>(w, &paths, &mut from, membership, &at, &mut split);
        split
    }
}

/// Takes the light of surfaces of color 1 apart: what the color is multiplied with, and what it is not.
struct SplitLight<W: Width> {
    on_color: Vector<W::R>,
    highlight: Vector<W::R>,
}

impl<W: Width> SplitLight<W> {
    #[inline(always)]
    fn new(w: W, at: &SurfaceInteraction<W>) -> Self {
        Self { on_color: at.bsdf.ambient, highlight: Vector::splat(w.real(0.0), [0.0; 3]) }
    }

    #[inline(always)]
    fn store(self, light: &mut [DirectLight]) {
        let mut rows = [[0.0; MOST_LANES]; 6];
        let Self { on_color, highlight } = self;
        let parts = [on_color.x, on_color.y, on_color.z, highlight.x, highlight.y, highlight.z];
        for (row, part) in rows.iter_mut().zip(parts) {
            part.store(row);
        }
        for (lane, light) in light.iter_mut().enumerate() {
            let vector =
                |first: usize| Vector::new(rows[first][lane], rows[first + 1][lane], rows[first + 2][lane]);
            *light = DirectLight { on_color: vector(0), highlight: vector(3) };
        }
    }
}

impl<W: Width> PathObserver<W> for SplitLight<W> {
    #[inline(always)]
    fn on_light_answer(
        &mut self,
        lit: W::M,
        power: Vector<W::R>,
        through: &Transmittance<W>,
        (value, _): (&BsdfValue<W>, Vector<W::R>),
    ) {
        let power = through.share.map_or(power, |share| power.times(share)).bounded();
        let color = self.on_color + power.times(value.diffuse);
        self.on_color = Vector::select(lit, color, self.on_color);
        let highlight = self.highlight + power * value.highlight + power.times(value.microfacets);
        self.highlight = Vector::select(lit, highlight, self.highlight);
    }
}

/// The color C of a body at a point of its surface.
pub(crate) fn color_at(scene: &RenderScene, body: u32, point: &SurfacePoint<f32>) -> Vector<f32> {
    let body = scene.geometry.body(body);
    colors_of(ScalarWidth, scene, body, (point.in_body, point.on_solid(body)), true)
}

/// The colors C of a body at points of its own frame, which its pattern sees as `on_solid`.
#[inline(always)]
pub(crate) fn colors_of<W: Width>(
    w: W,
    scene: &RenderScene,
    body: &RenderBody,
    (in_body, on_solid): (Vector<W::R>, Vector<W::R>),
    lanes: W::M,
) -> Vector<W::R> {
    let color = scene.material(body).color_at(w, body, in_body, lanes);
    patterned(w, &scene.solids, body.solid, color, on_solid)
}

/// Coefficient k_r, if a ray that carries it is traced at all.
pub(crate) fn reflection_of(scene: &RenderScene, body: u32) -> Option<f32> {
    let reflection = scene.material(scene.geometry.body(body)).reflection;
    (scene.generations > 1 && reflection > 0.0 && reflection >= scene.threshold).then_some(reflection)
}

pub(crate) fn vector(v: DVec3) -> Vector<f32> {
    v.as_vec3().into()
}

pub(crate) fn exact(v: Vector<f32>) -> DVec3 {
    glam::Vec3::from(v).as_dvec3()
}
