//! What one ray meets: for picking bodies with the pointer, and for looking at rays one by one.

use glam::{DVec3, Vec3};

use crate::geometry::bvh::packet::TraversalStack;
use crate::geometry::membership::{BodyMembership, MembershipSource as _};
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::{HitRecord, RayQuery, found_in};
use crate::geometry::ray::Ray;
use crate::simd::scalar::ScalarWidth;
use crate::transport::media::MediumStacks;
use crate::transport::scene::RenderScene;

/// The point at which a ray meets a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayIntersection {
    /// The place of the body in [`Scene::bodies`](catoptric_scene::Scene::bodies).
    pub body: usize,
    /// Which of the simple parts of that it meets, in the order of
    /// [`Form::each_simple`](catoptric_scene::Form::each_simple); `None` for a body without parts.
    pub part: Option<usize>,
    /// Parameter, place in the scene and side, as the search found them.
    pub hit: HitRecord,
    /// The point on the surface in the world, meters.
    pub position: DVec3,
    /// Unit normal there, facing the ray.
    pub normal: Vec3,
    /// Whether the ray meets it from within: of a joined body, from within the whole.
    pub from_within: bool,
}

impl RayIntersection {
    pub(crate) fn new(scene: &RenderScene, ray: &Ray, hit: HitRecord) -> Option<Self> {
        let rays = ray.alone();
        let point = scene.geometry.surface_point(hit.body, (rays.origin, rays.direction), hit.t, hit.leaving);
        Some(Self {
            body: scene.scene_index(hit.body)?,
            part: scene.geometry.part(hit.body),
            hit,
            position: scene.world_from_render(point.in_world),
            normal: point.normal.into(),
            from_within: scene.geometry.joined.whole_of(hit.body, hit.leaving).inwards,
        })
    }
}

impl RenderScene {
    /// The nearest body that a ray meets, as a primary ray or, if [`Ray::start`] names a surface, as one that has left it.
    ///
    /// The direction must be a unit vector. A ray that is not finite meets nothing.
    pub fn closest_hit(&self, ray: &Ray) -> Option<RayIntersection> {
        self.on_flight(ray, |query| {
            found_in(&query.closest_hit(&mut TraversalStack::default()))
                .and_then(|hit| RayIntersection::new(self, ray, hit))
        })?
    }

    /// The first meeting of a ray with each body in its way, the nearest first, the others in order of distance: a second
    /// click picks the body behind. The first is [`Self::closest_hit`]. Bodies are looked through whatever they are made
    /// of, and no ray is bent; each body is tested once.
    pub fn hits_along(&self, ray: &Ray) -> Vec<RayIntersection> {
        let hits = self.on_flight(ray, |query| {
            let mut hits = Vec::new();
            query.all_hits(&mut TraversalStack::default(), |hit| hits.push(hit));
            // Bodies that touch are ordered by the search, within rounding.
            let first = found_in(&query.closest_hit(&mut TraversalStack::default())).map(|hit| hit.body);
            hits.sort_by(|a, b| {
                let is_later = |hit: &HitRecord| Some(hit.body) != first;
                is_later(a)
                    .cmp(&is_later(b))
                    .then(a.t.total_cmp(&b.t))
                    .then_with(|| self.geometry.scene_order(a.body, b.body))
            });
            hits
        });
        hits.into_iter().flatten().filter_map(|hit| RayIntersection::new(self, ray, hit)).collect()
    }

    /// What `look` finds on the way of a ray in the media of its start, if it is finite.
    fn on_flight<T>(&self, ray: &Ray, look: impl FnOnce(RayQuery<'_, ScalarWidth>) -> T) -> Option<T> {
        if !(ray.origin.is_finite() && ray.direction.is_finite()) {
            return None;
        }
        let rays = ray.alone();
        let mut table = MediumStacks::default();
        let media = table.at_point(self, rays.origin);
        let mut inside = BodyMembership::default();
        table.fill::<ScalarWidth>(&mut inside, media, true);
        Some(look(RayQuery::new(ScalarWidth, &self.geometry, &rays, true, &inside, Candidates::All)))
    }
}
