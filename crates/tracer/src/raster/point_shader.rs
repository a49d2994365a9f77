//! One thread's means of asking the scene: what a ray meets, and how a point is lit.

use glam::DVec3;

use crate::geometry::body::SurfacePoint;
use crate::geometry::bvh::packet::TraversalStack;
use crate::geometry::membership::{BodyMembership, MembershipSource as _};
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::{HitRecord, RayQuery, found_in};
use crate::geometry::ray::{NO_BODY, Ray, RayOrigin, RayPacket};
use crate::raster::settings::LightModel;
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::transport::camera::RenderCamera;
use crate::transport::counts::RayCounts;
use crate::transport::media::absorption::MediumIntervals;
use crate::transport::media::transmittance::ShadowScratch;
use crate::transport::media::{AIR, MediumStacks};
use crate::transport::scene::RenderScene;
use crate::transport::surface::phong_highlight;

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
    /// The light that leaves a surface of this color.
    pub(crate) fn with_color(&self, color: Vector<f32>) -> Vector<f32> {
        self.on_color.times(color) + self.highlight
    }
}

/// Asks a scene; reusable from point to point by one thread. Counts the rays it sends.
pub(crate) struct PointShader<'a> {
    scene: &'a RenderScene,
    camera: &'a RenderCamera,
    table: MediumStacks,
    /// The transparent bodies around the start of the primary ray; a reflected ray stays in them.
    inside: BodyMembership,
    /// The list of `table` that holds the bodies of `inside` in the order in which they were entered.
    media: u32,
    stack: TraversalStack,
    intervals: MediumIntervals,
    pub(crate) counts: RayCounts,
}

impl<'a> PointShader<'a> {
    pub(crate) fn new(scene: &'a RenderScene, camera: &'a RenderCamera) -> Self {
        let mut probe = Self {
            scene,
            camera,
            table: MediumStacks::default(),
            inside: BodyMembership::default(),
            media: AIR,
            stack: TraversalStack::default(),
            intervals: MediumIntervals::default(),
            counts: RayCounts::default(),
        };
        probe.stand_at(vector(camera.position()));
        probe
    }

    /// From now on, primary rays start here.
    pub(crate) fn stand_at(&mut self, point: Vector<f32>) {
        if self.scene.geometry.has_transparency {
            self.table.trim();
            self.media = self.table.at_point(self.scene, point);
            self.table.fill::<ScalarWidth>(&mut self.inside, self.media, true);
        }
    }

    /// What a primary ray meets.
    pub(crate) fn primary(&mut self, ray: &Ray) -> Option<HitRecord> {
        if self.camera.eye().is_none() {
            self.stand_at(ray.origin.into());
        }
        self.counts.primary += 1;
        let rays = ray.alone();
        found_in(
            &RayQuery::new(ScalarWidth, &self.scene.geometry, &rays, true, &self.inside, Candidates::All)
                .closest_hit(&mut self.stack),
        )
    }

    /// The local terms at a point.
    pub(crate) fn light(&mut self, at: &ShadingPoint, model: LightModel, shadows: bool) -> DirectLight {
        let scene = self.scene;
        let nothing = Vector::new(0.0, 0.0, 0.0);
        let material = scene.material(scene.geometry.body(at.start.body));
        let specular = if model == LightModel::Phong { material.specular } else { 0.0 };
        let on_color = Vector::from(glam::Vec3::from(scene.ambient)) * material.ambient;
        let mut light = DirectLight { on_color, highlight: nothing };
        if material.diffuse == 0.0 && specular == 0.0 {
            return light;
        }
        for source in scene.lights.iter().filter(|light| light.shines) {
            let offset = Vector::splat(0.0, source.position) - at.position;
            let distance = offset.length_squared().sqrt();
            let to_light = offset * (1.0 / distance);
            let cos = at.normal.dot(to_light);
            // A light that stands exactly here has no direction.
            if !(distance > 0.0 && cos > 0.0) {
                continue;
            }
            let mut power = source.power_at(distance);
            if shadows {
                power = power.times(self.transmittance(at, to_light, distance)).bounded();
            }
            light.on_color = light.on_color + power * (material.diffuse * cos);
            if specular != 0.0 {
                let share = phong_highlight(at.to_viewer, to_light, at.normal, material.shininess);
                light.highlight = light.highlight + power * (specular * share);
            }
        }
        light
    }

    /// What reaches a point from a light.
    fn transmittance(&mut self, at: &ShadingPoint, to_light: Vector<f32>, distance: f32) -> Vector<f32> {
        self.counts.shadow += 1;
        let rays: RayPacket<ScalarWidth> =
            RayPacket { origin: at.position, direction: to_light, start: at.start.word() };
        let Self { stack, intervals, .. } = self;
        let memory = ShadowScratch { stack, intervals, occluder: &mut { NO_BODY } };
        RayQuery::new(ScalarWidth, &self.scene.geometry, &rays, true, &self.inside, Candidates::All)
            .transmittance(self.scene, distance, (&self.table, self.media), memory)
            .shares(ScalarWidth)
    }
}

/// The color C of a body at a point of its surface.
pub(crate) fn color_at(scene: &RenderScene, body: u32, point: &SurfacePoint<f32>) -> Vector<f32> {
    color_of(scene, body, point.in_body, point.on_checker(scene.geometry.body(body)))
}

/// The color C of a body at a point of its own frame, which its checkerboard sees as `on_checker`.
pub(crate) fn color_of(
    scene: &RenderScene,
    body: u32,
    in_body: Vector<f32>,
    on_checker: Vector<f32>,
) -> Vector<f32> {
    let body = scene.geometry.body(body);
    let checker = scene.checkers.get(body.checker as usize).filter(|checker| checker.is_odd(on_checker));
    match checker {
        Some(checker) => Vector::splat(0.0, checker.color),
        None => scene.material(body).color_at(ScalarWidth, body, in_body, true),
    }
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
