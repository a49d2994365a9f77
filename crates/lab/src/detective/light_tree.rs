//! Trees of rays in a short form, whose light is summed up anew with faults.

use std::ops::Range;

use catoptric_scene::{Falloff, Light, Material, Phong, Scene, Shape};
use catoptric_tracer::{RayKind, RayRecord, SurfaceRecord};
use glam::{DVec3, Vec3};

use super::faults::{Fault, FaultSet};

/// Trees of rays, one for each place in the picture.
#[derive(Debug, Default)]
pub(super) struct LightTrees {
    nodes: Vec<TreeNode>,
    lights: Vec<LightSample>,
    /// The end of each tree among the nodes.
    ends: Vec<u32>,
}

/// A ray with what is needed to sum up its light anew.
#[derive(Debug)]
struct TreeNode {
    /// Of its own tree.
    parent: u32,
    kind: RayKind,
    generation: u32,
    /// The coefficient that its parent gave it, times what media on its way leave.
    coefficient: Vec3,
    /// What that product would be if no coefficient depended on the angle.
    unweighed: Vec3,
    /// The local light where it is not known in terms: of surroundings, and of surfaces that are not Phong's.
    fixed: Vec3,
    surface: Option<PhongPoint>,
    body: Option<usize>,
}

/// A point of a surface by Phong's law.
#[derive(Debug)]
struct PhongPoint {
    color: Vec3,
    ambient_light: Vec3,
    ambient: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    reflection: f32,
    /// Towards where the ray comes from.
    view: Vec3,
    normal: Vec3,
    /// The normal as the matrix of the body turns it, and that of the unscaled body.
    wrong_normals: [Vec3; 2],
    lights: Range<u32>,
}

/// A light as a point of a surface sees it.
#[derive(Debug)]
struct LightSample {
    direction: Vec3,
    distance: f32,
    /// Whether it stands above the surface.
    is_above: bool,
    passed: Vec3,
    /// Whether an opaque body stands in the way.
    is_blocked: bool,
    /// Its place among those of the scene that are not hidden.
    light: usize,
}

impl LightTrees {
    /// Adds the tree of a place.
    pub(super) fn push(&mut self, scene: &Scene, records: &[RayRecord]) {
        for record in records {
            let parent = record.parent.and_then(|parent| records.get(parent));
            let node = self.node(scene, record, parent);
            self.nodes.push(node);
        }
        self.ends.push(self.nodes.len() as u32);
    }

    /// Adds the trees of others behind the own ones.
    pub(super) fn append(&mut self, mut others: Self) {
        let (nodes, lights) = (self.nodes.len() as u32, self.lights.len() as u32);
        for surface in others.nodes.iter_mut().filter_map(|node| node.surface.as_mut()) {
            surface.lights = surface.lights.start + lights..surface.lights.end + lights;
        }
        self.nodes.append(&mut others.nodes);
        self.lights.append(&mut others.lights);
        self.ends.extend(others.ends.iter().map(|end| end + nodes));
    }

    fn node(&mut self, scene: &Scene, record: &RayRecord, parent: Option<&RayRecord>) -> TreeNode {
        let (body, phong) = (record.hit.map(|hit| hit.body), phong_of(scene, record));
        let surface = match (&record.answer, phong) {
            (Some(answer), Some(phong)) => self.surface(scene, record, answer, phong),
            _ => None,
        };
        TreeNode {
            parent: record.parent.map_or(u32::MAX, |parent| parent as u32),
            kind: record.kind,
            generation: record.generation,
            coefficient: record.coefficient * record.through,
            unweighed: unweighed(record, parent.and_then(|parent| phong_of(scene, parent))) * record.through,
            fixed: if surface.is_some() { Vec3::ZERO } else { record.local },
            surface,
            body,
        }
    }

    fn surface(
        &mut self,
        scene: &Scene,
        record: &RayRecord,
        answer: &SurfaceRecord,
        phong: &Phong,
    ) -> Option<PhongPoint> {
        let hit = record.hit?;
        let first = self.lights.len() as u32;
        self.lights.extend(answer.lights.iter().map(|term| LightSample {
            direction: term.direction,
            distance: term.distance,
            is_above: term.cosine > 0.0,
            passed: term.shadow.as_ref().map_or(Vec3::ZERO, |shadow| shadow.passed),
            is_blocked:
                term.shadow.as_ref().is_none_or(|shadow| {
                    shadow.crossings.iter().any(|crossing| is_opaque(scene, crossing.body))
                }),
            light: term.light,
        }));
        Some(PhongPoint {
            color: answer.color,
            ambient_light: answer.ambient_light,
            ambient: answer.ambient_coefficient,
            diffuse: answer.diffuse_coefficient,
            specular: answer.specular_coefficient,
            shininess: answer.shininess,
            reflection: phong.reflection() as f32,
            view: -Vec3::from(record.ray.direction),
            normal: hit.normal,
            wrong_normals: wrong_normals(scene, hit.body, hit.position, hit.normal),
            lights: first..self.lights.len() as u32,
        })
    }

    /// The number of trees.
    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    fn tree(&self, place: usize) -> &[TreeNode] {
        let end = self.ends.get(place).map_or(0, |end| *end as usize);
        let start = match place {
            0 => 0,
            _ => self.ends.get(place - 1).map_or(end, |end| *end as usize),
        };
        self.nodes.get(start..end).unwrap_or_default()
    }

    /// The body that the eye sees at a place.
    pub(super) fn body(&self, place: usize) -> Option<usize> {
        self.tree(place).first()?.body
    }

    /// The light of a place, summed up with faults.
    pub(super) fn light(&self, place: usize, law: &LightLaw<'_>, sums: &mut Vec<Vec3>) -> [f32; 3] {
        let nodes = self.tree(place);
        sums.clear();
        sums.resize(nodes.len(), Vec3::ZERO);
        for (index, node) in nodes.iter().enumerate().rev() {
            if node.generation > law.generations || law.leaves_out(node.kind) {
                continue;
            }
            let mut light = match &node.surface {
                Some(point) => law.local(point, self.lights_of(point)),
                None => node.fixed,
            };
            light += sums.get(index).copied().unwrap_or_default();
            if law.clamps_rays {
                light = light.min(Vec3::ONE);
            }
            let light = if law.leaves_unweighed { node.unweighed } else { node.coefficient } * light;
            match sums.get_mut(node.parent as usize) {
                Some(sum) => *sum += light,
                None => return light.to_array(),
            }
        }
        [0.0; 3]
    }

    fn lights_of(&self, point: &PhongPoint) -> &[LightSample] {
        self.lights.get(point.lights.start as usize..point.lights.end as usize).unwrap_or_default()
    }
}

/// The material of what a ray met, if it is Phong's.
fn phong_of<'s>(scene: &'s Scene, record: &RayRecord) -> Option<&'s Phong> {
    let body = scene.bodies.get(record.hit?.body)?;
    // Parts may have materials of their own.
    let choice = (!body.shape.is_compound()).then_some(&body.material)?;
    scene.material(choice).and_then(Material::as_phong)
}

/// The coefficient of a ray that grows from this material, whatever the angle.
fn unweighed(record: &RayRecord, from: Option<&Phong>) -> Vec3 {
    match (from.filter(|phong| phong.weighs_by_angle()), record.kind) {
        (Some(phong), RayKind::Reflected) => Vec3::splat(phong.reflection() as f32),
        (Some(phong), RayKind::Refracted) => {
            phong.transmission as f32 * Vec3::from(phong.tint.to_array().map(|part| part as f32))
        }
        _ => record.coefficient,
    }
}

/// Whether no ray passes any part of a body.
fn is_opaque(scene: &Scene, body: usize) -> bool {
    let passes = |choice| scene.material(choice).is_some_and(|material| material.lets_through().most > 0.0);
    !scene.bodies.get(body).is_some_and(|body| body.materials().any(passes))
}

/// The unit normals that wrong rules give a point of a body, on the side of the right one.
fn wrong_normals(scene: &Scene, body: usize, position: DVec3, normal: Vec3) -> [Vec3; 2] {
    let Some(body) = scene.bodies.get(body) else { return [normal; 2] };
    let frame = body.placement.world_from_body();
    let normal = normal.as_dvec3();
    let own = (frame.matrix3.transpose() * normal).normalize_or(DVec3::Y);
    let turned = match body.shape {
        // Whatever product of matrices made the ellipsoid, the normal of its ball is the way from the center.
        Shape::Sphere { .. } => position - frame.translation,
        _ => frame.matrix3 * own,
    };
    let unscaled = body.placement.rotation() * own;
    [turned, unscaled].map(|wrong| {
        let wrong = wrong.normalize_or(normal);
        (if wrong.dot(normal) < 0.0 { -wrong } else { wrong }).as_vec3()
    })
}

/// The law of light with its faults.
pub(super) struct LightLaw<'a> {
    generations: u32,
    lights: Vec<&'a Light>,
    no_ambient: bool,
    uncolored_ambient: bool,
    no_diffuse: bool,
    highlight: Option<Fault>,
    shadows: Option<Fault>,
    mixing: Option<Fault>,
    no_reflection: bool,
    no_refraction: bool,
    leaves_unweighed: bool,
    clamps_rays: bool,
    clamps_local: bool,
    clamps_lamps: bool,
    /// Which of the wrong normals counts.
    wrong_normal: Option<usize>,
    falloff: Option<Falloff>,
    first_light_only: bool,
    white_lights: bool,
    full_lights: bool,
    /// Whether no light shines but ambient light.
    is_dark: bool,
}

impl<'a> LightLaw<'a> {
    /// The law of a scene with these faults.
    pub(super) fn new(scene: &'a Scene, faults: &FaultSet) -> Self {
        let has = |fault| faults.has(fault);
        let one_of = |several: &[Fault]| faults.iter().find(|fault| several.contains(fault));
        Self {
            generations: faults.generations(scene.tracing.generations),
            lights: scene.lights.iter().filter(|light| !light.hidden).collect(),
            no_ambient: has(Fault::NoAmbient),
            uncolored_ambient: has(Fault::UncoloredAmbient),
            no_diffuse: has(Fault::NoDiffuse),
            highlight: one_of(&[
                Fault::NoHighlight,
                Fault::HighlightInShadow,
                Fault::HalfwayHighlight,
                Fault::ColoredHighlight,
            ]),
            shadows: if has(Fault::OpaqueBodies) {
                one_of(&[Fault::NoShadows]).or(Some(Fault::OpaqueShadows))
            } else {
                one_of(&[Fault::NoShadows, Fault::OpaqueShadows, Fault::ClearShadows])
            },
            mixing: one_of(&[Fault::BlendedReflection, Fault::AddedReflection]),
            no_reflection: has(Fault::NoReflection),
            no_refraction: has(Fault::NoRefraction) || has(Fault::OpaqueBodies),
            leaves_unweighed: has(Fault::UnweighedBodies),
            clamps_rays: has(Fault::ClampedRays),
            clamps_local: has(Fault::ClampedLocal),
            clamps_lamps: has(Fault::ClampedLamps),
            wrong_normal: one_of(&[Fault::ScaledNormals, Fault::UnscaledNormals])
                .map(|fault| usize::from(fault == Fault::UnscaledNormals)),
            falloff: one_of(&[Fault::NoFalloff, Fault::LinearFalloff, Fault::SquareFalloff]).map(|fault| {
                match fault {
                    Fault::NoFalloff => Falloff::None,
                    Fault::LinearFalloff => Falloff::Linear { constant: 0.0 },
                    _ => Falloff::InverseSquare,
                }
            }),
            first_light_only: has(Fault::FirstLightOnly),
            white_lights: has(Fault::WhiteLights),
            full_lights: has(Fault::FullLights),
            is_dark: false,
        }
    }

    /// The law with all lights out but the ambient one: what a point has that wrongly lies in its own shadow.
    pub(super) fn darkened(self) -> Self {
        Self { is_dark: true, ..self }
    }

    fn leaves_out(&self, kind: RayKind) -> bool {
        match kind {
            RayKind::Primary => false,
            RayKind::Reflected => self.no_reflection,
            RayKind::Refracted => self.no_refraction,
        }
    }

    /// The local light of a point.
    fn local(&self, point: &PhongPoint, lights: &[LightSample]) -> Vec3 {
        let ambient = match (self.no_ambient, self.uncolored_ambient) {
            (true, _) => Vec3::ZERO,
            (false, true) => point.ambient * point.ambient_light,
            (false, false) => point.ambient * point.color * point.ambient_light,
        };
        let shining = lights.iter().filter(|sample| !self.first_light_only || sample.light == 0);
        let shining = shining.filter(|_| !self.is_dark);
        let mut light = ambient + shining.map(|sample| self.lamp(point, sample)).sum::<Vec3>();
        match self.mixing {
            Some(Fault::BlendedReflection) => light *= 1.0 - point.reflection.min(1.0),
            Some(_) => light /= (1.0 - point.reflection).max(0.05),
            None => {}
        }
        if self.clamps_local { light.min(Vec3::ONE) } else { light }
    }

    /// What a point sends on of a light.
    fn lamp(&self, point: &PhongPoint, sample: &LightSample) -> Vec3 {
        let normal = self
            .wrong_normal
            .and_then(|wrong| point.wrong_normals.get(wrong).copied())
            .unwrap_or(point.normal);
        let cosine = normal.dot(sample.direction);
        let Some(light) = self.lights.get(sample.light).filter(|_| cosine > 0.0) else { return Vec3::ZERO };
        let passed = match self.shadows {
            Some(Fault::NoShadows) => Vec3::ONE,
            // A point on the dark side lies in its body's own shadow.
            _ if !sample.is_above => Vec3::ZERO,
            Some(Fault::OpaqueShadows) if sample.passed.min_element() < 1.0 - 1e-4 => Vec3::ZERO,
            Some(Fault::ClearShadows) if !sample.is_blocked => Vec3::ONE,
            _ => sample.passed,
        };
        let diffuse = if self.no_diffuse { Vec3::ZERO } else { point.diffuse * cosine * point.color };
        let highlight = self.highlight(point, sample, normal);
        let highlight = match self.highlight {
            Some(Fault::HighlightInShadow) => highlight,
            _ => highlight * passed,
        };
        let light = self.power(light, sample.distance) * (diffuse * passed + highlight);
        if self.clamps_lamps { light.min(Vec3::ONE) } else { light }
    }

    fn highlight(&self, point: &PhongPoint, sample: &LightSample, normal: Vec3) -> Vec3 {
        if point.specular <= 0.0 || self.highlight == Some(Fault::NoHighlight) {
            return Vec3::ZERO;
        }
        let cosine = match self.highlight {
            Some(Fault::HalfwayHighlight) => (sample.direction + point.view).normalize_or_zero().dot(normal),
            _ => {
                let mirrored = 2.0 * normal.dot(sample.direction) * normal - sample.direction;
                mirrored.dot(point.view)
            }
        };
        let highlight = point.specular * cosine.max(0.0).powf(point.shininess);
        match self.highlight {
            Some(Fault::ColoredHighlight) => highlight * point.color,
            _ => Vec3::splat(highlight),
        }
    }

    /// What a light sends to a point at this distance.
    fn power(&self, light: &Light, distance: f32) -> Vec3 {
        let color = if self.white_lights { Vec3::ONE } else { DVec3::from(light.color.to_array()).as_vec3() };
        let intensity = if self.full_lights { 1.0 } else { light.intensity as f32 };
        let falloff = match self.falloff.unwrap_or(light.falloff) {
            Falloff::None => 1.0,
            Falloff::Linear { constant } => (distance + constant as f32).max(1e-6).recip(),
            Falloff::InverseSquare => (distance * distance).max(1e-12).recip(),
        };
        intensity * falloff * color
    }
}
