//! Following an edit of a few bodies, at a cost that does not grow with the number of all.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use catoptric_scene::{Body, Material, Scene, Shape, Tracing};

use crate::geometry::Accelerator;
use crate::geometry::body::{PreparedBody, RenderBody};
use crate::geometry::bounds::Bounds;
use crate::geometry::bvh::refit::NodePath;
use crate::geometry::canonical::CanonicalBody;
use crate::geometry::ray::NO_BODY;
use crate::geometry::space::RenderSpace;
use crate::geometry::sphere::BoundingSphere;
use crate::transport::camera::RenderCamera;
use crate::transport::color::linear_rgb;
use crate::transport::environment::EnvironmentLight;
use crate::transport::light::RenderLight;
use crate::transport::scene::build::passage_of;
use crate::transport::scene::log::SceneChanges;
use crate::transport::scene::{RenderScene, extent_of};
use crate::transport::surface::material::RenderMaterial;
use crate::transport::texture::solid::SolidNode;

/// How a scene becomes that of an edited scene; [`RenderScene::edit`] makes it for [`RenderScene::apply`].
#[derive(Clone, Debug, Default)]
pub struct SceneEdit {
    changes: Vec<BodyEdit>,
}

/// A body that changes.
#[derive(Clone, Debug)]
struct BodyEdit {
    /// Its place in the scene.
    place: u32,
    body: RenderBody,
    material: RenderMaterial,
    solids: Vec<SolidNode>,
    /// Where its leaf hangs; `None` for a plane.
    path: Option<NodePath>,
}

impl RenderScene {
    /// So many materials and patterns may be added before the next preparing tidies up.
    const MOST_ADDED: u32 = 256;

    /// What makes this scene, prepared from `before`, that of `after`, where at most the bodies at the places `changed`
    /// are different: moved, resized, reshaped, made of something else. Camera, lights, environment and the limits of
    /// tracing may be too.
    ///
    /// `None` when this would not be right or not wise, and `after` has to be prepared anew: bodies were added,
    /// removed, hidden or shown, named materials changed, very many bodies did, the hierarchy would become a poor one, or a
    /// body needs double precision. Whether the scene [suits](Self::suits) the camera is asked apart.
    pub fn edit(&self, before: &Scene, after: &Scene, changed: &[usize]) -> Option<SceneEdit> {
        let Accelerator::Many(bvh) = &self.geometry.hierarchy else { return None };
        let is_known = before.bodies.len() == after.bodies.len()
            && before.materials == after.materials
            && before.environment.contact == after.environment.contact;
        if !is_known || changed.len() > after.bodies.len() / 64 + 1 || self.added > Self::MOST_ADDED {
            return None;
        }
        let mut edit = SceneEdit::default();
        let mut cost = bvh.cost();
        for &index in changed {
            let (old, new) = (before.bodies.get(index)?, after.bodies.get(index)?);
            if old.looks_like(new) {
                continue;
            }
            let is_plane = |body: &Body| body.shape == Shape::Plane;
            let is_compound = old.shape.is_compound() || new.shape.is_compound();
            if is_compound || old.hidden || new.hidden || is_plane(old) != is_plane(new) {
                return None;
            }
            let (place, path) = self.find(old, index as u32)?;
            let PreparedBody { body, bounds, double } = RenderBody::prepare(new, &self.geometry.space);
            if double.is_some() || self.geometry.doubles.get(index as u32).is_some() {
                return None;
            }
            if let (Some(path), Some(bounds)) = (&path, bounds) {
                cost += bvh.growth(path, bounds);
            }
            let material = after.material(&new.material)?;
            let change = BodyEdit::new(place, path, body, material, (new, after, &self.geometry.space));
            if !self.geometry.has_cemented && self.becomes_cemented(&change.body) {
                return None;
            }
            edit.changes.push(change);
        }
        bvh.allows(cost).then_some(edit)
    }

    /// Carries out an edit that [`Self::edit`] planned for this scene and the scene `after`.
    pub fn apply(&mut self, edit: SceneEdit, after: &Scene) {
        let mut paths = Vec::with_capacity(edit.changes.len());
        let mut changes = SceneChanges::default();
        for change in edit.changes {
            self.replace(&change);
            changes.bodies.push(change.place..change.place + 1);
            paths.extend(change.path);
        }
        if let Accelerator::Many(bvh) = &mut self.geometry.hierarchy {
            for path in &paths {
                let leaf = bvh.leaf(path);
                changes.bodies.push(leaf.clone());
                changes.nodes.extend(path.iter().map(|(node, _)| node));
                sort_leaf(
                    &mut self.geometry.bodies,
                    &mut self.geometry.spheres,
                    &mut self.geometry.numbers,
                    leaf.clone(),
                );
                let boxes = range(&leaf).filter_map(|index| {
                    let kept = self.geometry.bodies.get(index)?;
                    let number = *self.geometry.numbers.get(index)?;
                    match after.bodies.get(number as usize) {
                        Some(body) if !kept.is_joined() => bounds_of(body, &self.geometry.space),
                        _ => kept.bounds(),
                    }
                });
                bvh.refit(path, boxes.fold(Bounds::EMPTY, Bounds::union));
            }
            let surroundings = extent_of(bvh.bounds(), &self.geometry, &self.materials, after);
            self.camera = RenderCamera::new(&after.camera, surroundings, self.geometry.space.origin);
        }
        self.log.add(changes);
        self.lights = after
            .lights
            .iter()
            .filter(|light| !light.hidden)
            .map(|light| RenderLight::new(light, &self.geometry.space))
            .collect();
        self.sky = EnvironmentLight::new(&after.environment);
        self.is_full |= self.lights.iter().any(|light| light.radius > 0.0) || self.sky.is_full();
        self.ambient = linear_rgb(after.environment.ambient);
        self.generations = after.tracing.generations.clamp(1, Tracing::MAX_GENERATIONS);
        self.threshold = after.tracing.threshold as f32;
        self.to_lights = OnceLock::new();
    }

    /// The place of the body `index` of the scene, which is `body` there, and the way to its leaf, if it hangs on one.
    pub(crate) fn find(&self, body: &Body, index: u32) -> Option<(u32, Option<NodePath>)> {
        let place_in = |places: Range<u32>| {
            let indices = self.geometry.numbers.get(range(&places))?;
            let place = indices.iter().position(|&at| at == index)?;
            Some(places.start + place as u32)
        };
        let Some(bounds) = RenderBody::prepare(body, &self.geometry.space).bounds else {
            return Some((place_in(self.geometry.planes())?, None));
        };
        match &self.geometry.hierarchy {
            Accelerator::Few => Some((place_in(0..self.geometry.bounded)?, None)),
            Accelerator::Many(bvh) => {
                let path = bvh.path_to(&bounds, |leaf| place_in(leaf).is_some())?;
                Some((place_in(bvh.leaf(&path))?, Some(path)))
            }
        }
    }

    /// Whether bodies may be cemented to what they touch with this one among them, which were not before.
    fn becomes_cemented(&self, body: &RenderBody) -> bool {
        match self.geometry.has_transparency {
            true => body.cements(),
            false => {
                body.is_transparent() && self.geometry.bodies.iter().chain([body]).any(RenderBody::cements)
            }
        }
    }

    fn replace(&mut self, change: &BodyEdit) {
        let Some(old) = self.geometry.bodies.get(change.place as usize) else { return };
        let (material, solid) = (old.material, old.solid);
        let material = self.material_index(&change.material, material);
        let solid = self.solid_place(&change.solids, solid);
        if let Some(body) = self.geometry.bodies.get_mut(change.place as usize) {
            *body = RenderBody { material, solid, ..change.body };
            if let Some(sphere) = self.geometry.spheres.get_mut(change.place as usize) {
                *sphere = body.bounding_sphere();
            }
            self.geometry.has_transparency |= body.is_transparent();
            self.is_full |= change.material.is_full();
            self.absorbs |= change.material.absorbs();
            self.disperses |= change.material.dispersion.is_some();
            self.geometry.largest_error_bound = self.geometry.largest_error_bound.max(body.error_bound);
            self.geometry.largest_extent = self.geometry.largest_extent.max(body.extent());
        }
    }

    /// The place of a material in the list, to which it is added if it is not there; `old` is likely.
    fn material_index(&mut self, material: &RenderMaterial, old: u32) -> u32 {
        if self.materials.get(old as usize) == Some(material) {
            return old;
        }
        let place = self.materials.iter().position(|other| other == material).unwrap_or_else(|| {
            Arc::make_mut(&mut self.materials).push(material.clone());
            self.added += 1;
            self.materials.len() - 1
        });
        place as u32
    }

    /// The place of a body's patterns in the list, if it has any; `old` is that of those that it had.
    fn solid_place(&mut self, row: &[SolidNode], old: u32) -> u32 {
        if row.is_empty() {
            return NO_BODY;
        }
        let solids = Arc::make_mut(&mut self.solids);
        if SolidNode::row_at(solids, old).len() == row.len() {
            let own = solids.iter_mut().skip(old as usize);
            own.zip(row).for_each(|(own, new)| *own = *new);
            return old;
        }
        let place = solids.len();
        solids.extend_from_slice(row);
        self.added += 1;
        place as u32
    }
}

impl BodyEdit {
    fn new(
        place: u32,
        path: Option<NodePath>,
        mut body: RenderBody,
        of: &Material,
        (source, scene, space): (&Body, &Scene, &RenderSpace),
    ) -> Self {
        let material = RenderMaterial::new(of);
        let contact = scene.environment.contact;
        body.passes = passage_of(material.is_transparent(), &material, source, contact);
        let solid = of.pattern().and_then(|pattern| pattern.solid.as_ref());
        let row = |solid| SolidNode::row(solid, &CanonicalBody::of(source), space, false);
        Self { place, body, material, solids: solid.map(row).unwrap_or_default(), path }
    }
}

fn bounds_of(body: &Body, space: &RenderSpace) -> Option<Bounds> {
    RenderBody::prepare(body, space).bounds
}

/// Puts the bodies of a leaf in order again, one of which may have got another shape.
fn sort_leaf(
    bodies: &mut [RenderBody],
    spheres: &mut [BoundingSphere],
    indices: &mut [u32],
    leaf: Range<u32>,
) {
    let leaf = range(&leaf);
    let bodies = bodies.get_mut(leaf.clone()).unwrap_or_default();
    let spheres = spheres.get_mut(leaf.clone()).unwrap_or_default();
    let indices = indices.get_mut(leaf).unwrap_or_default();
    for sorted in 1..bodies.len() {
        let key = |at: usize| (bodies[at].kind, indices[at]);
        let place = (0..sorted).find(|&at| key(at) > key(sorted)).unwrap_or(sorted);
        bodies[place..=sorted].rotate_right(1);
        spheres[place..=sorted].rotate_right(1);
        indices[place..=sorted].rotate_right(1);
    }
}

fn range(places: &Range<u32>) -> Range<usize> {
    places.start as usize..places.end as usize
}
