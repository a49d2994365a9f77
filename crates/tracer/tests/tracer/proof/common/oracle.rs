//! Whitted's tree once more, written from the description of the model alone: recursive, in double precision, with a
//! tiny offset against self-intersection and a list for the media. What the tracer is held against.

use catoptric_picture::Picture;
use catoptric_scene::{
    Anchor, Body, Camera, Color, Falloff, Form, FresnelTerm, Material, MaterialChoice, Phong, Projection,
    Scene, Shadow, Shape, SolidKind, SolidTexture, VisibleSide,
};
use glam::{DAffine3, DMat3, DVec3};

use super::textbook;

/// A scene to be traced by the oracle.
pub(crate) struct Oracle<'a> {
    scene: &'a Scene,
    bodies: Vec<Placed<'a>>,
    /// Crossings nearer than this are taken for the start itself, meters.
    offset: f64,
}

/// A body: its simple parts, of which it has one if it is not compound.
struct Placed<'a> {
    form: Form<'a>,
    /// Of the whole.
    material: &'a Phong,
    parts: Vec<PlacedPart<'a>>,
}

struct PlacedPart<'a> {
    shape: Shape,
    material: &'a Phong,
    world_from_body: DMat3,
    body_from_world: DMat3,
    position: DVec3,
}

struct Hit<'a> {
    t: f64,
    body: usize,
    /// Outward.
    normal: DVec3,
    material: &'a Phong,
}

/// Whether a point lies in the next of the `parts` that make up a form.
fn contains<'p>(form: &Form<'_>, parts: &mut impl Iterator<Item = &'p PlacedPart<'p>>, p: DVec3) -> bool {
    if !form.shape.is_compound() {
        return parts.next().unwrap().contains(p);
    }
    // Every part is asked, so that the next form has its own.
    let inside: Vec<bool> = form.parts.iter().map(|part| contains(&part.form(), parts, p)).collect();
    match form.shape {
        Shape::Surface { .. } => false,
        Shape::Intersection => inside.iter().all(|is_in| *is_in),
        Shape::Difference => inside[0] && !inside[1..].contains(&true),
        _ => inside.contains(&true),
    }
}

impl<'a> Placed<'a> {
    fn contains(&self, p: DVec3) -> bool {
        contains(&self.form, &mut self.parts.iter(), p)
    }

    /// Where a line crosses the surface: the parameter, the outward normal, and what the surface is made of.
    fn crossings(&self, origin: DVec3, direction: DVec3) -> Vec<(f64, DVec3, &'a Phong)> {
        if let Shape::Surface { side } = self.form.shape {
            return self.surface_crossings(side, origin, direction);
        }
        let mut all: Vec<_> = self.parts.iter().flat_map(|part| part.crossings(origin, direction)).collect();
        if self.parts.len() == 1 {
            return all;
        }
        // Of a compound body those count after which membership is another than before.
        const STEP: f64 = 1e-7;
        let is_in = |t: f64| self.contains(origin + t * direction);
        all.retain_mut(|(t, normal, _)| {
            let enters = is_in(*t + STEP);
            *normal *= if (normal.dot(direction) < 0.0) == enters { 1.0 } else { -1.0 };
            enters != is_in(*t - STEP)
        });
        all
    }

    /// Of a surface those of the first part count, but for its caps, that are seen and lie in all others.
    fn surface_crossings(
        &self,
        side: VisibleSide,
        origin: DVec3,
        direction: DVec3,
    ) -> Vec<(f64, DVec3, &'a Phong)> {
        let (first, others) = self.parts.split_first().unwrap();
        let mut all = first.crossings(origin, direction);
        all.retain(|&(t, normal, _)| {
            let in_body = first.world_from_body.transpose() * normal;
            let is_round =
                matches!(first.shape, Shape::Cylinder { .. } | Shape::Cone { .. } | Shape::Paraboloid { .. });
            let is_cap = is_round && in_body.x.hypot(in_body.z) < 1e-6 * in_body.length();
            let is_seen = match side {
                VisibleSide::Both => true,
                VisibleSide::Outer => normal.dot(direction) < 0.0,
                VisibleSide::Inner => normal.dot(direction) > 0.0,
            };
            is_seen && !is_cap && others.iter().all(|other| other.contains(origin + t * direction))
        });
        all
    }

    fn is_transparent(&self) -> bool {
        filter(self.material) != DVec3::ZERO
    }

    fn volume(&self) -> f64 {
        self.parts.iter().map(PlacedPart::volume).sum()
    }
}

fn filter(material: &Phong) -> DVec3 {
    material.transmission * rgb(material.tint)
}

impl<'a> PlacedPart<'a> {
    fn contains(&self, p: DVec3) -> bool {
        textbook::implicit(&self.shape, self.body_from_world * (p - self.position)) <= 0.0
    }

    fn crossings(&self, origin: DVec3, direction: DVec3) -> Vec<(f64, DVec3, &'a Phong)> {
        let o = self.body_from_world * (origin - self.position);
        let d = self.body_from_world * direction;
        let crossing =
            |(t, n): (f64, DVec3)| (t, (self.body_from_world.transpose() * n).normalize(), self.material);
        textbook::crossings(&self.shape, o, d).into_iter().map(crossing).collect()
    }

    fn volume(&self) -> f64 {
        let own = match self.shape {
            Shape::Sphere { radius } => 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3),
            Shape::Cube { size } => size.element_product(),
            Shape::Cylinder { radius, height } => std::f64::consts::PI * radius * radius * height,
            Shape::Cone { radius: r, top_radius: s, height } => {
                std::f64::consts::PI / 3.0 * height * (r * r + r * s + s * s)
            }
            Shape::Paraboloid { radius, depth } => {
                0.5 * std::f64::consts::PI * radius * radius * depth.height(radius)
            }
            Shape::Plane => f64::INFINITY,
            Shape::Union | Shape::Intersection | Shape::Difference | Shape::Surface { .. } | Shape::Group => {
                unreachable!("parts are simple")
            }
        };
        own * self.world_from_body.determinant().abs()
    }
}

impl<'a> Oracle<'a> {
    /// Prepares a scene of about the size `extent`, meters.
    pub(crate) fn new(scene: &'a Scene, extent: f64) -> Self {
        let bodies = scene.bodies.iter().map(|body| place(scene, body)).collect();
        Self { scene, bodies, offset: 1e-9 * extent }
    }

    pub(crate) fn picture(&self, width: u32, height: u32) -> Picture {
        Picture::from_fn(width, height, |x, y| {
            let (origin, direction) = self.primary(f64::from(x) + 0.5, f64::from(y) + 0.5, width, height);
            self.light(origin, direction).as_vec3().to_array()
        })
        .unwrap()
    }

    /// The light that comes along a ray from a free point.
    pub(crate) fn light(&self, origin: DVec3, direction: DVec3) -> DVec3 {
        let mut around: Vec<usize> = (0..self.bodies.len())
            .filter(|&body| {
                let placed = &self.bodies[body];
                placed.is_transparent() && placed.contains(origin)
            })
            .collect();
        around.sort_by(|&a, &b| self.bodies[b].volume().total_cmp(&self.bodies[a].volume()));
        self.trace(origin, direction.normalize(), 1, &around)
    }

    fn primary(&self, x: f64, y: f64, width: u32, height: u32) -> (DVec3, DVec3) {
        let Camera { position, target, up, projection } = self.scene.camera;
        let w = (position - target).normalize();
        let u = up.cross(w).normalize();
        let v = w.cross(u);
        let aspect = f64::from(width) / f64::from(height);
        let (l, r) = (-0.5 * aspect, 0.5 * aspect);
        let across = l + x * (r - l) / f64::from(width);
        let down = 0.5 - y / f64::from(height);
        match projection {
            Projection::Perspective { fov_degrees } => {
                let d = 1.0 / (2.0 * (0.5 * fov_degrees).to_radians().tan());
                (position, across * u + down * v - d * w)
            }
            Projection::Parallel { height } => (position + height * (across * u + down * v), -w),
        }
    }

    fn nearest(&self, origin: DVec3, direction: DVec3) -> Option<Hit<'a>> {
        let mut best: Option<Hit<'a>> = None;
        for (body, placed) in self.bodies.iter().enumerate() {
            for (t, normal, material) in placed.crossings(origin, direction) {
                if t > self.offset && best.as_ref().is_none_or(|hit| t < hit.t) {
                    best = Some(Hit { t, body, normal, material });
                }
            }
        }
        best
    }

    fn trace(&self, origin: DVec3, direction: DVec3, generation: u32, media: &[usize]) -> DVec3 {
        let Some(hit) = self.nearest(origin, direction) else {
            return rgb(self.scene.environment.background);
        };
        let at = origin + hit.t * direction;
        let leaving = direction.dot(hit.normal) > 0.0;
        let n = if leaving { -hit.normal } else { hit.normal };
        let material = hit.material;
        let mut light = self.local(material, at, n, -direction);
        let is_last = generation >= self.scene.tracing.generations;
        let reflected = || {
            let mirrored = (direction - 2.0 * n.dot(direction) * n).normalize();
            self.trace(at, mirrored, generation + 1, media)
        };
        let mut reflection = material.reflection();
        let mut passing = filter(material);
        if passing != DVec3::ZERO {
            let mut beyond = media.to_vec();
            match beyond.iter().rposition(|&inside| inside == hit.body) {
                // Beyond a surface there is what was before it.
                _ if self.bodies[hit.body].form.shape.is_surface() => {}
                Some(place) => drop(beyond.remove(place)),
                None => beyond.push(hit.body),
            }
            let index = |media: &[usize]| media.last().map_or(1.0, |&body| self.bodies[body].material.ior);
            let is_weighed = material.fresnel == FresnelTerm::Schlick;
            if is_weighed {
                let share = schlick(-direction.dot(n), index(media), index(&beyond));
                passing *= if reflection > 0.0 { 1.0 - share } else { 1.0 };
                reflection *= share;
            }
            match snell(direction, n, index(media), index(&beyond)) {
                // A ray that goes straight on is the same ray still, in the last generation, too.
                Some(bent) => {
                    let is_bent = index(media) != index(&beyond);
                    if !(is_last && is_bent) {
                        let next = generation + u32::from(is_bent);
                        light += passing * self.trace(at, bent, next, &beyond);
                    }
                }
                None if is_weighed => {}
                None => reflection = 1.0,
            }
        }
        if reflection > 0.0 && !is_last {
            light += reflection * reflected();
        }
        light
    }

    fn local(&self, material: &Phong, at: DVec3, n: DVec3, to_viewer: DVec3) -> DVec3 {
        let color = patterned(rgb(material.pattern.color), material.pattern.solid.as_ref(), at);
        let mut light = material.ambient * color * rgb(self.scene.environment.ambient);
        for source in &self.scene.lights {
            let distance = at.distance(source.position);
            let to_light = (source.position - at) / distance;
            let cos = n.dot(to_light);
            if cos <= 0.0 {
                continue;
            }
            let falloff = match source.falloff {
                Falloff::None => 1.0,
                Falloff::Linear { constant } => 1.0 / (distance + constant),
                Falloff::InverseSquare => 1.0 / (distance * distance),
            };
            let mirrored = 2.0 * n.dot(to_light) * n - to_light;
            let highlight = to_viewer.dot(mirrored).max(0.0).powf(material.shininess);
            light += self.visibility(at, to_light, distance)
                * rgb(source.color)
                * (source.intensity * falloff)
                * (material.diffuse * color * cos + material.specular * highlight);
        }
        light
    }

    fn visibility(&self, at: DVec3, to_light: DVec3, distance: f64) -> DVec3 {
        let mut passed = DVec3::ONE;
        let casting =
            self.bodies.iter().zip(&self.scene.bodies).filter(|(_, body)| body.shadow != Shadow::None);
        for (placed, body) in casting {
            for (t, _, material) in placed.crossings(at, to_light) {
                if t > self.offset && t < distance - self.offset {
                    passed *= if body.shadow == Shadow::Full { DVec3::ZERO } else { filter(material) };
                }
            }
        }
        passed
    }
}

/// Snell's law by angles in the plane of incidence: the component along the surface keeps n·sin θ.
fn snell(direction: DVec3, n: DVec3, from: f64, to: f64) -> Option<DVec3> {
    let along = direction - direction.dot(n) * n;
    let sin = along.length() * from / to;
    if sin > 1.0 {
        return None;
    }
    let tangent = along.normalize_or_zero();
    Some((sin * tangent - (1.0 - sin * sin).sqrt() * n).normalize())
}

/// The book's function (Buck 2019, chapter 11), with `cos` that of the angle of incidence.
fn schlick(mut cos: f64, n1: f64, n2: f64) -> f64 {
    if n1 > n2 {
        let n = n1 / n2;
        let sin2_t = n * n * (1.0 - cos * cos);
        if sin2_t > 1.0 {
            return 1.0;
        }
        cos = (1.0 - sin2_t).sqrt();
    }
    let r0 = ((n1 - n2) / (n1 + n2)).powi(2);
    r0 + (1.0 - r0) * (1.0 - cos).powi(5)
}

fn place<'a>(scene: &'a Scene, body: &'a Body) -> Placed<'a> {
    let phong = |choice: &'a MaterialChoice| scene.material(choice).and_then(Material::as_phong).unwrap();
    let material = phong(&body.material);
    let mut parts = Vec::new();
    if body.shape.is_compound() {
        body.form().each_simple(DAffine3::IDENTITY, &mut |part| {
            parts.push(PlacedPart {
                shape: part.shape,
                material: part.material.map_or(material, phong),
                world_from_body: part.frame.matrix3,
                body_from_world: part.frame.matrix3.inverse(),
                position: part.frame.translation,
            });
        });
        return Placed { form: body.form(), material, parts };
    }
    let Anchor::Frame { position, rotation_degrees } = body.placement.anchor else {
        unreachable!("the oracle's scenes place bodies by frame");
    };
    let [x, y, z] = rotation_degrees.to_array().map(f64::to_radians);
    let turn = DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
    let world_from_body = turn * DMat3::from_diagonal(body.placement.scale);
    let body_from_world = DMat3::from_diagonal(body.placement.scale.recip()) * turn.transpose();
    parts.push(PlacedPart { shape: body.shape, material, world_from_body, body_from_world, position });
    Placed { form: body.form(), material, parts }
}

/// The color of a point of the world, `first` where no pattern has another.
fn patterned(first: DVec3, solid: Option<&SolidTexture>, at: DVec3) -> DVec3 {
    let Some(solid) = solid else { return first };
    let cells = solid.placement().world_from_body().inverse().transform_point3(at) / solid.size;
    let odd = |cell: f64| (cell + 1e-6).floor().rem_euclid(2.0);
    let share = match solid.kind {
        SolidKind::Checker => (odd(cells.x) + odd(cells.y) + odd(cells.z)).rem_euclid(2.0),
        SolidKind::Stripes => odd(cells.x),
        SolidKind::Rings => odd(cells.x.hypot(cells.z)),
        SolidKind::Gradient => (cells.x + 1e-6).rem_euclid(1.0),
    };
    let first = patterned(first, solid.first.as_deref(), at);
    let second = patterned(rgb(solid.color), solid.second.as_deref(), at);
    (1.0 - share) * first + share * second
}

fn rgb(color: Color) -> DVec3 {
    DVec3::from_array(color.to_array())
}
