//! The tracer with a few bodies alone.

use std::sync::atomic::AtomicBool;

use catoptric_scene::{Body, Camera, Light, List, Material, MaterialChoice, Scene, Tracing};
use catoptric_tracer::{RayKind, RayRecord, RenderScene, WhittedIntegrator};
use glam::{DVec3, Vec3};

/// A scene of a few bodies, for a few rays.
pub(super) struct Probe {
    render_scene: RenderScene,
    /// Where the scene's origin stands in the scene: near the bodies, since rays are traced in single precision.
    origin: DVec3,
}

/// A line in space: a point on it, and its unit direction.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub(super) point: DVec3,
    pub(super) direction: DVec3,
}

impl Line {
    /// The point of this line that is nearest to another line.
    pub(super) fn nearest_to(&self, other: &Self) -> Option<DVec3> {
        let between = other.point - self.point;
        let along = self.direction.dot(other.direction);
        let sin_squared = self.direction.cross(other.direction).length_squared();
        // Parallel lines have no nearest point.
        (sin_squared > 1e-18).then(|| {
            let t = (between.dot(self.direction) - along * between.dot(other.direction)) / sin_squared;
            self.point + t * self.direction
        })
    }

    /// How far a point lies from the line, meters.
    pub(super) fn distance(&self, point: DVec3) -> f64 {
        (point - self.point).cross(self.direction).length()
    }
}

impl Probe {
    /// Only these bodies of a scene, and perhaps one of its lights, traced about `origin`. Limits do not matter.
    ///
    /// The formulas are those of one wavelength and of the middle of a light: glass bends all light as it bends yellow,
    /// and the light is a point.
    pub(super) fn of<'a>(
        scene: &Scene,
        bodies: impl IntoIterator<Item = &'a Body>,
        light: Option<&Light>,
        origin: DVec3,
    ) -> Option<Self> {
        let own = |body: &Body| {
            let mut material = scene.material(&body.material)?.clone();
            if let Material::Dielectric(dielectric) = &mut material {
                dielectric.dispersion = false;
            }
            let placement = body.placement.moved_by(-origin);
            Some(Body { material: MaterialChoice::Inline(Box::new(material)), placement, ..body.clone() })
        };
        let bodies: List<Body> = bodies.into_iter().filter_map(own).collect();
        let point = |light: &Light| Light { position: light.position - origin, radius: 0.0, ..light.clone() };
        let tracing = Tracing { generations: Tracing::MAX_GENERATIONS, threshold: 0.0 };
        let seen = scene.camera;
        let camera = Camera { position: seen.position - origin, target: seen.target - origin, ..seen };
        let lights = light.map(point).into_iter().collect();
        let alone = Scene { bodies, lights, tracing, camera, ..Scene::default() };
        Some(Self { render_scene: RenderScene::build(&alone).ok()?, origin })
    }

    /// The first rays of the tree from a point in a direction; their places are those of the scene.
    pub(super) fn tree(&self, from: DVec3, direction: DVec3, most: usize) -> Vec<RayRecord> {
        let direction = direction.normalize_or_zero().as_vec3();
        let ray = self.render_scene.ray_from_point(from - self.origin, direction);
        WhittedIntegrator::new(&self.render_scene, &AtomicBool::new(false)).tree(ray, most)
    }

    /// The ray after so many reflections.
    pub(super) fn reflected(&self, from: DVec3, direction: DVec3, times: u32) -> Option<Line> {
        let mut place = 0;
        let tree = self.tree(from, direction, 4 * times as usize + 4);
        for _ in 0..times {
            place = child(&tree, place, RayKind::Reflected)?;
        }
        tree.get(place).map(|ray| self.line(ray))
    }

    /// The ray after one reflection, if that is by a face with this normal.
    pub(super) fn reflected_by(&self, from: DVec3, direction: DVec3, normal: DVec3) -> Option<Line> {
        /// Far more than the rounding of a normal, far less than the angles of bodies.
        const ALIKE: f64 = 1e-4;
        let tree = self.tree(from, direction, 4);
        let hit = tree.first()?.hit?;
        let is_meant = hit.normal.as_dvec3().distance(normal) < ALIKE;
        let next = tree.get(child(&tree, 0, RayKind::Reflected)?)?;
        is_meant.then(|| self.line(next))
    }

    /// The ray that has gone straight through a body: bent on its way in and on its way out.
    pub(super) fn transmitted(&self, from: DVec3, direction: DVec3) -> Option<Line> {
        // The heaviest rays come first; what is reflected may be among them.
        let tree = self.tree(from, direction, 32);
        let within = child(&tree, 0, RayKind::Refracted)?;
        let beyond = child(&tree, within, RayKind::Refracted)?;
        tree.get(beyond).map(|ray| self.line(ray))
    }

    /// The ray that has come in through one face and was mirrored by the next from within.
    pub(super) fn reflected_within(&self, from: DVec3, direction: DVec3) -> Option<Line> {
        let tree = self.tree(from, direction, 32);
        let within = child(&tree, 0, RayKind::Refracted)?;
        tree.get(child(&tree, within, RayKind::Reflected)?).map(|ray| self.line(ray))
    }

    fn line(&self, ray: &RayRecord) -> Line {
        let (point, direction) = (ray.origin, Vec3::from(ray.ray.direction).as_dvec3());
        // In double precision, single precision's unit vectors are not quite that.
        Line { point: point + self.origin, direction: direction.normalize_or_zero() }
    }
}

fn child(tree: &[RayRecord], parent: usize, kind: RayKind) -> Option<usize> {
    tree.iter().position(|ray| ray.parent == Some(parent) && ray.kind == kind)
}
