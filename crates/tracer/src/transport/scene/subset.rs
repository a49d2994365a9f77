//! A small scene with some of the bodies of another.

use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

use catoptric_scene::Scene;

use crate::geometry::body::RenderBody;
use crate::geometry::bvh::entry::BuildEntry;
use crate::geometry::{Accelerator, AcceleratorChoice, Geometry};
use crate::transport::scene::RenderScene;
use crate::transport::scene::log::EditLog;

/// Up to this many bodies are looked for one by one.
const FEW_WANTED: usize = 256;

impl RenderScene {
    /// This scene with just those of its bodies that stand at these places in [`Scene::bodies`], `scene` being what
    /// the scene was prepared from; other places are passed over.
    ///
    /// Camera and numbering stay, so that the same rays meet the same points: what an outline needs. The cost grows
    /// with the number of the bodies wanted; if there are many, with that of all, by a comparison each.
    pub fn only(&self, scene: &Scene, scene_indices: &[usize]) -> Self {
        let wanted: BTreeSet<usize> = scene_indices.iter().copied().collect();
        let is_simple = |&index: &usize| scene.bodies.get(index).is_none_or(|body| !body.shape.is_compound());
        let chosen: Vec<u32> = if wanted.len() <= FEW_WANTED && wanted.iter().all(is_simple) {
            let place = |&index: &usize| Some(self.find(scene.bodies.get(index)?, index as u32)?.0);
            wanted.iter().filter_map(place).collect()
        } else {
            let is_wanted =
                |&index: &u32| self.geometry.scene_index(index).is_some_and(|place| wanted.contains(&place));
            self.geometry.whole().filter(is_wanted).collect()
        };
        self.with_bodies(&chosen)
    }

    /// This scene without its body `index`, or what that is a part of.
    pub(crate) fn without(&self, index: u32) -> Self {
        let whole = self.geometry.joined.whole_of(index, false).body;
        let others: Vec<u32> = self.geometry.whole().filter(|&other| other != whole).collect();
        self.with_bodies(&others)
    }

    fn with_bodies(&self, chosen: &[u32]) -> Self {
        let mut entries = Vec::new();
        let mut planes = Vec::new();
        for &index in chosen {
            let body = self.geometry.body(index);
            match body.bounds() {
                Some(bounds) => entries.push(BuildEntry::new(bounds, index, u32::from(body.kind))),
                None => planes.push(index),
            }
        }
        let hierarchy = Accelerator::over(&mut entries, AcceleratorChoice::Quickest);
        let mut order: Vec<u32> = entries.iter().map(BuildEntry::place).chain(planes).collect();
        let joined = self.geometry.joined.only(&self.geometry.bodies, &mut order);
        let bodies: Vec<RenderBody> = order.iter().map(|&index| *self.geometry.body(index)).collect();
        let geometry = Geometry {
            joined,
            members: Arc::clone(&self.geometry.members),
            numbers: order
                .iter()
                .filter_map(|&index| self.geometry.numbers.get(index as usize))
                .copied()
                .collect(),
            bounded: entries.len() as u32,
            hierarchy,
            spheres: entries.iter().map(|entry| *self.geometry.sphere(entry.place())).collect(),
            has_transparency: bodies.iter().any(RenderBody::is_transparent),
            has_cemented: self.geometry.has_cemented && Geometry::has_cemented(&bodies),
            bodies,
            doubles: Arc::clone(&self.geometry.doubles),
            space: self.geometry.space,
            largest_extent: self.geometry.largest_extent,
            largest_error_bound: order
                .iter()
                .map(|&index| self.geometry.body(index).error_bound)
                .fold(0.0, f32::max),
        };
        Self {
            geometry,
            materials: Arc::clone(&self.materials),
            solids: Arc::clone(&self.solids),
            lights: Arc::clone(&self.lights),
            camera: self.camera.clone(),
            sky: self.sky.clone(),
            ambient: self.ambient,
            generations: self.generations,
            threshold: self.threshold,
            is_full: self.is_full,
            absorbs: self.absorbs,
            disperses: self.disperses,
            lanes: self.lanes,
            to_lights: OnceLock::new(),
            added: 0,
            log: EditLog::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Body, Light, Scene, Shape};

    use super::*;

    #[test]
    fn materials_and_lights_are_shared() {
        let plane = Body { shape: Shape::Plane, ..Body::default() };
        let scene = Scene {
            bodies: [Body::default(), plane].into(),
            lights: vec![Light::default()],
            ..Scene::default()
        };
        let render_scene = RenderScene::build(&scene).unwrap();
        let some = render_scene.only(&scene, &[0]);
        assert!(Arc::ptr_eq(&some.materials, &render_scene.materials));
        assert!(Arc::ptr_eq(&some.solids, &render_scene.solids));
        assert!(Arc::ptr_eq(&some.lights, &render_scene.lights));
    }
}
