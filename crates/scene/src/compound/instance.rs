//! Instances: bodies and parts that have the geometry of another body by its name.
//!
//! To everything that traces, measures or draws it an instance is a body of the shape and the parts of the other one,
//! which all instances share. [`Scene::follow_instances`] brings them up to date with it.

mod follow;

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::{BodyPart, ParametricShape, each_part, each_part_mut};
use crate::Scene;
use crate::body::Body;
use crate::material::MaterialChoice;

pub(crate) use follow::{InstanceFault, InstanceProblem};

/// What makes a body or a part an instance of a body of the scene.
#[derive(Clone, Debug, Default)]
pub struct Instance {
    /// The name of that body.
    pub of: String,
    /// Whether it has a material of its own. By default it has that of the other body; another one that it is given is its
    /// own as soon as it follows that body again.
    pub has_own_material: bool,
    /// The parts of the other body.
    shared: Arc<SharedForm>,
}

/// Parts are compared only where they are not shared.
impl PartialEq for Instance {
    fn eq(&self, other: &Self) -> bool {
        let is_alike = self.of == other.of && self.has_own_material == other.has_own_material;
        is_alike && (Arc::ptr_eq(&self.shared, &other.shared) || self.shared == other.shared)
    }
}

/// What all instances of a body share.
#[derive(Debug, Default, PartialEq)]
struct SharedForm {
    parts: Vec<BodyPart>,
    parametric: Option<Box<ParametricShape>>,
    /// The material of the other body. An instance that has another one was given it since, as its own.
    material: Option<MaterialChoice>,
}

impl Instance {
    /// An instance of the body of this name, of which it has nothing yet.
    pub fn new(of: String, has_own_material: bool) -> Self {
        Self { of, has_own_material, shared: Arc::default() }
    }

    /// The parts of the other body.
    pub fn parts(&self) -> &[BodyPart] {
        &self.shared.parts
    }

    /// What the parts of the other body are an expansion of.
    pub(crate) fn parametric(&self) -> Option<&ParametricShape> {
        self.shared.parametric.as_deref()
    }
}

impl Body {
    /// Makes a body of its own of an instance, which looks the same. Does nothing to others.
    pub fn make_own(&mut self) {
        if let Some(instance) = self.instance.take() {
            self.parts.clone_from(&instance.shared.parts);
            self.parametric.clone_from(&instance.shared.parametric);
        }
    }

    /// Whether it is an instance or has a part that is one.
    pub fn has_instances(&self) -> bool {
        self.instances().next().is_some()
    }

    /// What it and its parts are instances of.
    pub fn instances(&self) -> impl Iterator<Item = &Instance> {
        let of_parts = if self.parts.is_empty() { Vec::new() } else { part_instances(&self.parts) };
        self.instance.iter().chain(of_parts)
    }
}

impl BodyPart {
    /// Makes a part of its own of an instance, which looks the same. Does nothing to others.
    pub fn make_own(&mut self) {
        if let Some(instance) = self.instance.take() {
            self.parts.clone_from(&instance.shared.parts);
            self.parametric.clone_from(&instance.shared.parametric);
        }
    }
}

impl Scene {
    /// Has instances follow bodies to their new names; `renamed` gives those by the old ones.
    pub fn rename_instances(&mut self, renamed: &HashMap<String, String>) {
        let rename = |instance: &mut Option<Instance>| {
            if let Some(instance) = instance
                && let Some(name) = renamed.get(&instance.of)
            {
                instance.of.clone_from(name);
            }
        };
        self.edit_instances(
            |of| renamed.contains_key(of),
            |body| {
                rename(&mut body.instance);
                each_part_mut(&mut body.parts, &mut |part| rename(&mut part.instance));
            },
        );
    }

    /// Makes the instances of bodies that are not there any more bodies of their own, which look the same.
    pub fn free_lost_instances(&mut self) {
        if !self.has_instances() {
            return;
        }
        let names: HashSet<String> = self.bodies.iter().map(|body| body.name.clone()).collect();
        self.free_instances(|of| !names.contains(of));
    }

    /// Makes the instances of some bodies bodies of their own, which look the same.
    pub fn free_instances(&mut self, is_of: impl Fn(&str) -> bool) {
        let is_freed =
            |instance: &Option<Instance>| instance.as_ref().is_some_and(|instance| is_of(&instance.of));
        self.edit_instances(&is_of, |body| {
            if is_freed(&body.instance) {
                body.make_own();
            }
            each_part_mut(&mut body.parts, &mut |part| {
                if is_freed(&part.instance) {
                    part.make_own();
                }
            });
        });
    }

    /// Edits the bodies that are instances of some others or have parts that are; the rest is not copied.
    fn edit_instances(&mut self, is_of: impl Fn(&str) -> bool, edit: impl Fn(&mut Body)) {
        for index in 0..self.bodies.len() {
            let is_one = |body: &Body| body.instances().any(|instance| is_of(&instance.of));
            if self.bodies.get(index).is_some_and(is_one)
                && let Some(body) = self.bodies.get_mut(index)
            {
                edit(body);
            }
        }
    }
}

fn part_instances(parts: &[BodyPart]) -> Vec<&Instance> {
    let mut instances = Vec::new();
    each_part(parts, &mut |part| instances.extend(&part.instance));
    instances
}
