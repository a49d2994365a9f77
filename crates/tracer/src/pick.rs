//! What one ray meets: for picking bodies with the pointer, and for looking at rays one by one.

use glam::Vec3;

use crate::medium::MediaArena;
use crate::ray::Ray;
use crate::search::{Flight, Hit};
use crate::stage::Stage;

/// The point at which a ray meets a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceHit {
    /// The place of the body in [`Scene::bodies`](catoptric_scene::Scene::bodies).
    pub body: usize,
    /// Parameter, place in the stage and side, as the search found them.
    pub hit: Hit,
    /// The point on the surface, world space, meters.
    pub position: Vec3,
    /// Unit normal there, facing the ray.
    pub normal: Vec3,
}

impl SurfaceHit {
    pub(crate) fn new(stage: &Stage, ray: &Ray, hit: Hit) -> Option<Self> {
        let point = stage.body(hit.body).surface_point(ray.origin, ray.direction, hit.t, hit.leaving);
        Some(Self {
            body: stage.scene_index(hit.body)?,
            hit,
            position: point.in_world.into(),
            normal: point.normal.into(),
        })
    }
}

impl Stage {
    /// The nearest body that a ray meets, as a primary ray or, if [`Ray::start`] names a surface, as one that has left it.
    ///
    /// The direction must be a unit vector. A ray that is not finite meets nothing.
    pub fn nearest(&self, ray: &Ray) -> Option<SurfaceHit> {
        if !(ray.origin.is_finite() && ray.direction.is_finite()) {
            return None;
        }
        let mut arena = MediaArena::default();
        let media = arena.at_point(self, ray.origin);
        let flight = Flight { stage: self, arena: &arena, ray: *ray, media };
        let hit = flight.nearest(&mut Vec::new())?;
        SurfaceHit::new(self, ray, hit)
    }
}
