//! Trees of rays in a short form, whose light is summed up anew with faults.

use std::ops::Range;

use catoptric_scene::{Material, Phong, Scene, Shape};
use catoptric_tracer::{RayKind, RayRecord, SurfaceRecord};
use glam::{DVec3, Vec3};

use super::light_law::LightLaw;

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
pub(super) struct TreeNode {
    /// Of its own tree; `u32::MAX` for the first ray.
    pub(super) parent: u32,
    pub(super) kind: RayKind,
    pub(super) generation: u32,
    /// The coefficient that its parent gave it, times what media on its way leave.
    pub(super) coefficient: Vec3,
    /// What that product would be if no coefficient depended on the angle.
    pub(super) unweighed: Vec3,
    /// Whether it is reflected because no light passes.
    pub(super) is_total: bool,
    /// Whether it starts inside the body that sent it on.
    pub(super) is_inside: bool,
    /// The local light where it is not known in terms: of surroundings, and of surfaces that are not Phong's.
    pub(super) fixed: Vec3,
    pub(super) surface: Option<PhongPoint>,
    pub(super) body: Option<usize>,
}

/// A point of a surface by Phong's law.
#[derive(Debug)]
pub(super) struct PhongPoint {
    pub(super) color: Vec3,
    pub(super) ambient_light: Vec3,
    pub(super) ambient: f32,
    pub(super) diffuse: f32,
    pub(super) specular: f32,
    pub(super) shininess: f32,
    pub(super) reflection: f32,
    pub(super) tint: Vec3,
    /// Towards where the ray comes from.
    pub(super) view: Vec3,
    /// How long the ray is, meters.
    pub(super) way: f32,
    /// From the point to the eye of the scene, meters.
    pub(super) to_eye: Vec3,
    pub(super) normal: Vec3,
    /// The normal as the matrix of the body turns it, and that of the unscaled body.
    pub(super) wrong_normals: [Vec3; 2],
    pub(super) dark_side: DarkSide,
    pub(super) lights: Range<u32>,
}

/// What a lamp below the horizon of a point does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum DarkSide {
    /// Nothing.
    #[default]
    Dark,
    /// It shines as if it stood above.
    Magnitude,
    /// It takes light away.
    Negative,
    /// It makes highlights.
    Highlight,
}

/// A light as a point of a surface sees it.
#[derive(Debug)]
pub(super) struct LightSample {
    pub(super) direction: Vec3,
    pub(super) distance: f32,
    /// Whether it stands above the surface, or its light is known although it does not.
    pub(super) is_above: bool,
    pub(super) passed: Vec3,
    /// Whether an opaque body stands in the way.
    pub(super) is_blocked: bool,
    /// Its place among those of the scene that are not hidden.
    pub(super) light: usize,
}

impl LightTrees {
    /// Adds the tree of a place as the exact tracer recorded it.
    pub(super) fn push(&mut self, scene: &Scene, records: &[RayRecord]) {
        for record in records {
            let parent = record.parent.and_then(|parent| records.get(parent));
            let node = self.node(scene, record, parent);
            self.nodes.push(node);
        }
        self.end_tree();
    }

    /// Adds a ray to the tree that is not ended yet.
    pub(super) fn add_node(&mut self, node: TreeNode) {
        self.nodes.push(node);
    }

    /// Adds lights as a point sees them; where they stand.
    pub(super) fn add_lights(&mut self, lights: impl Iterator<Item = LightSample>) -> Range<u32> {
        let first = self.lights.len() as u32;
        self.lights.extend(lights);
        first..self.lights.len() as u32
    }

    /// Ends the tree of a place.
    pub(super) fn end_tree(&mut self) {
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
        let interface = parent.and_then(|parent| parent.answer.as_ref()).and_then(|answer| answer.interface);
        let is_reflected = record.kind == RayKind::Reflected;
        let sender = parent.and_then(|parent| parent.hit).map(|hit| hit.body);
        TreeNode {
            parent: record.parent.map_or(u32::MAX, |parent| parent as u32),
            kind: record.kind,
            generation: record.generation,
            coefficient: record.coefficient * record.through,
            unweighed: unweighed(record, parent.and_then(|parent| phong_of(scene, parent))) * record.through,
            is_total: is_reflected && interface.is_some_and(|interface| interface.is_total),
            is_inside: sender.is_some_and(|sender| record.media.contains(&sender)),
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
        let lights = answer.lights.iter().map(|term| LightSample {
            direction: term.direction,
            distance: term.distance,
            is_above: term.cosine > 0.0,
            passed: term.shadow.as_ref().map_or(Vec3::ZERO, |shadow| shadow.passed),
            is_blocked: term
                .shadow
                .as_ref()
                .is_none_or(|shadow| shadow.crossings.iter().any(|crossing| is_opaque(scene, crossing.body))),
            light: term.light,
        });
        let lights = self.add_lights(lights);
        Some(PhongPoint {
            color: answer.color,
            ambient_light: answer.ambient_light,
            ambient: answer.ambient_coefficient,
            diffuse: answer.diffuse_coefficient,
            specular: answer.specular_coefficient,
            shininess: answer.shininess,
            reflection: phong.reflection() as f32,
            tint: DVec3::from(phong.tint.to_array()).as_vec3(),
            view: -Vec3::from(record.ray.direction),
            way: record.distance().unwrap_or_default() as f32,
            to_eye: (scene.camera.position - hit.position).as_vec3(),
            normal: hit.normal,
            wrong_normals: wrong_normals(scene, hit.body, hit.position, hit.normal),
            dark_side: DarkSide::Dark,
            lights,
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
        let primary = nodes.first().and_then(|node| node.surface.as_ref()).map(|point| point.view);
        let stretch = law.primary_length(primary);
        for (index, node) in nodes.iter().enumerate().rev() {
            let parent = nodes.get(node.parent as usize);
            let sender = parent.and_then(|parent| parent.surface.as_ref());
            let Some(coefficient) =
                law.coefficient(node, sender.map(|sender| (sender, self.lights_of(sender))))
            else {
                continue;
            };
            let light = match law.instead_of(node) {
                Some(light) => light,
                None => {
                    let own = match &node.surface {
                        Some(point) => law.local(point, self.lights_of(point), stretch),
                        None => node.fixed,
                    };
                    law.of_ray(own + sums.get(index).copied().unwrap_or_default())
                }
            };
            let light = coefficient * light;
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
