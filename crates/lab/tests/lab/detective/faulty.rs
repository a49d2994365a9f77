//! A small ray tracer of spheres and planes, written apart from the real one, that makes mistakes on demand.

use catoptric_scene::{Material, Phong, Projection, Scene, Shape};
use glam::{DAffine3, DVec3};

/// Its mistakes.
#[derive(Clone, Debug, Default)]
pub(super) struct Faults {
    pub(super) no_shadows: bool,
    pub(super) no_specular: bool,
    pub(super) no_reflection: bool,
    pub(super) no_refraction: bool,
    pub(super) no_ambient: bool,
    /// The most rays in a row, instead of the scene's generations.
    pub(super) depth: Option<u32>,
    /// The light of each ray is clamped to 1.
    pub(super) clamps: bool,
    /// Normals are turned by the matrix of the body.
    pub(super) wrong_normals: bool,
    /// Shadow rays start at the surface itself.
    pub(super) acne: bool,
    /// Rays go through the upper left corners of pixels.
    pub(super) corners: bool,
    /// The axis to the right is that to the left.
    pub(super) left_handed: bool,
    /// The vertical angle of view is taken for the horizontal one.
    pub(super) angle_for_width: bool,
    /// The horizontal angle of view is taken for the vertical one.
    pub(super) angle_for_height: bool,
    pub(super) inverted_ior: bool,
    pub(super) doubled_radius: bool,
    pub(super) halfway: bool,
}

struct Body {
    from_world: DAffine3,
    to_world: DAffine3,
    /// `None` for a plane.
    radius: Option<f64>,
    phong: Phong,
}

struct Hit {
    t: f64,
    position: DVec3,
    /// Outwards.
    normal: DVec3,
    body: usize,
}

pub(super) struct Faulty<'a> {
    scene: &'a Scene,
    bodies: Vec<Body>,
    faults: Faults,
}

impl<'a> Faulty<'a> {
    pub(super) fn new(scene: &'a Scene, faults: Faults) -> Self {
        let body = |body: &catoptric_scene::Body| {
            let to_world = body.placement.world_from_body();
            let radius = match body.shape {
                Shape::Sphere { radius } => Some(if faults.doubled_radius { 2.0 * radius } else { radius }),
                Shape::Plane => None,
                _ => panic!("spheres and planes only"),
            };
            let Some(Material::Phong(phong)) = scene.material(&body.material) else { panic!("Phong only") };
            Body { from_world: to_world.inverse(), to_world, radius, phong: phong.clone() }
        };
        Self { scene, bodies: scene.bodies.iter().map(body).collect(), faults }
    }

    /// Linear light, row by row.
    pub(super) fn picture(&self, [width, height]: [u32; 2]) -> Vec<[f32; 3]> {
        let camera = &self.scene.camera;
        let Projection::Perspective { fov_degrees } = camera.projection else { panic!("perspective only") };
        let back = (camera.position - camera.target).normalize();
        let right = camera.up.cross(back).normalize();
        let up = back.cross(right);
        let right = if self.faults.left_handed { -right } else { right };
        let (columns, rows) = (f64::from(width), f64::from(height));
        let aspect = columns / rows;
        let mut half_height = (0.5 * fov_degrees.to_radians()).tan();
        if self.faults.angle_for_width {
            half_height /= aspect;
        }
        if self.faults.angle_for_height {
            half_height *= aspect;
        }
        let middle = if self.faults.corners { 0.0 } else { 0.5 };
        let mut light = Vec::new();
        for y in 0..height {
            for x in 0..width {
                let across = (2.0 * (f64::from(x) + middle) / columns - 1.0) * half_height * aspect;
                let above = (1.0 - 2.0 * (f64::from(y) + middle) / rows) * half_height;
                let direction = (across * right + above * up - back).normalize();
                light.push(self.ray(camera.position, direction, 1, 1.0).as_vec3().to_array());
            }
        }
        light
    }

    fn hit(&self, origin: DVec3, direction: DVec3, least: f64) -> Option<Hit> {
        let mut nearest: Option<Hit> = None;
        for (index, body) in self.bodies.iter().enumerate() {
            let from = body.from_world.transform_point3(origin);
            let along = body.from_world.transform_vector3(direction);
            let roots = match body.radius {
                Some(radius) => {
                    let (a, b) = (along.length_squared(), from.dot(along));
                    let discriminant = b * b - a * (from.length_squared() - radius * radius);
                    if discriminant < 0.0 {
                        continue;
                    }
                    [(-b - discriminant.sqrt()) / a, (-b + discriminant.sqrt()) / a]
                }
                None => [-from.y / along.y; 2],
            };
            let Some(t) = roots.into_iter().find(|t| *t > least) else { continue };
            if nearest.as_ref().is_some_and(|nearest| nearest.t <= t) {
                continue;
            }
            let own = if body.radius.is_some() { from + t * along } else { DVec3::Y };
            let normal = if self.faults.wrong_normals {
                body.to_world.matrix3 * own
            } else {
                body.from_world.matrix3.transpose() * own
            };
            nearest =
                Some(Hit { t, position: origin + t * direction, normal: normal.normalize(), body: index });
        }
        nearest
    }

    fn color(&self, body: &Body, position: DVec3) -> DVec3 {
        let pattern = &body.phong.pattern;
        let color = match &pattern.solid {
            Some(checker) => {
                let cell = (position / checker.size + 1e-6).floor().element_sum();
                if cell.rem_euclid(2.0) == 0.0 { pattern.color } else { checker.color }
            }
            None => pattern.color,
        };
        DVec3::from(color.to_array())
    }

    /// What comes along a ray; `index` is that of the medium around it.
    fn ray(&self, origin: DVec3, direction: DVec3, generation: u32, index: f64) -> DVec3 {
        let least = if generation == 1 { 0.0 } else { 1e-7 };
        let Some(hit) = self.hit(origin, direction, least) else {
            return DVec3::from(self.scene.environment.background.to_array());
        };
        let body = &self.bodies[hit.body];
        let phong = &body.phong;
        let is_inside = hit.normal.dot(direction) > 0.0;
        let normal = if is_inside { -hit.normal } else { hit.normal };
        let color = self.color(body, hit.position);
        let ambient = DVec3::from(self.scene.environment.ambient.to_array());
        let mut light = if self.faults.no_ambient { DVec3::ZERO } else { phong.ambient * color * ambient };
        for lamp in &self.scene.lights {
            let way = lamp.position - hit.position;
            let toward = way.normalize();
            let cosine = normal.dot(toward);
            if cosine <= 0.0 {
                continue;
            }
            let passed = self.passed(hit.position, normal, toward, way.length());
            let mirrored = 2.0 * cosine * normal - toward;
            let highlight = if self.faults.halfway {
                (toward - direction).normalize().dot(normal)
            } else {
                mirrored.dot(-direction)
            };
            let mut answer = phong.diffuse * cosine * color;
            if !self.faults.no_specular {
                answer += phong.specular * highlight.max(0.0).powf(phong.shininess);
            }
            light += lamp.intensity * DVec3::from(lamp.color.to_array()) * passed * answer;
        }
        if generation < self.faults.depth.unwrap_or(self.scene.tracing.generations) {
            light += self.sent_on((&hit, normal, is_inside), direction, generation, index);
        }
        if self.faults.clamps { light.min(DVec3::ONE) } else { light }
    }

    /// What a point reflects and lets through.
    fn sent_on(
        &self,
        (hit, normal, is_inside): (&Hit, DVec3, bool),
        direction: DVec3,
        generation: u32,
        index: f64,
    ) -> DVec3 {
        let phong = &self.bodies[hit.body].phong;
        let cosine = -normal.dot(direction);
        let mirrored = direction + 2.0 * cosine * normal;
        let mut reflection = phong.reflection();
        let mut light = DVec3::ZERO;
        if phong.transmission > 0.0 && !self.faults.no_refraction {
            let beyond = if is_inside { 1.0 } else { phong.ior };
            let ratio = if self.faults.inverted_ior { beyond / index } else { index / beyond };
            let under = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
            if under < 0.0 {
                reflection = 1.0;
            } else {
                let bent = ratio * direction + (ratio * cosine - under.sqrt()) * normal;
                let tint = DVec3::from(phong.tint.to_array());
                let seen = self.ray(hit.position, bent.normalize(), generation + 1, beyond);
                light += phong.transmission * tint * seen;
            }
        }
        if reflection > 0.0 && !self.faults.no_reflection {
            light += reflection * self.ray(hit.position, mirrored, generation + 1, index);
        }
        light
    }

    /// The share of light that passes on the way to a lamp.
    fn passed(&self, position: DVec3, normal: DVec3, toward: DVec3, distance: f64) -> DVec3 {
        let mut passed = DVec3::ONE;
        if self.faults.no_shadows {
            return passed;
        }
        let (mut at, mut least) = (position + 1e-7 * normal, 1e-9);
        if self.faults.acne {
            (at, least) = (position, 0.0);
        }
        let mut left = distance;
        while let Some(hit) = self.hit(at, toward, least).filter(|hit| hit.t < left) {
            let phong = &self.bodies[hit.body].phong;
            passed *= phong.transmission * DVec3::from(phong.tint.to_array());
            if passed == DVec3::ZERO {
                break;
            }
            left -= hit.t;
            (at, least) = (hit.position, 1e-7);
        }
        passed
    }
}
