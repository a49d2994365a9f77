//! Instances: bodies and parts that have the geometry of another body by its name.
//!
//! To everything that traces, measures or draws it an instance is a body of the shape and the parts of the other one,
//! which all instances share. [`Scene::follow_instances`] brings them up to date with it.

mod follow;

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
    /// Whether it has a material of its own. By default it has that of the other body.
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

    /// Gives the body a material, an instance one of its own.
    pub fn set_material(&mut self, material: MaterialChoice) {
        self.material = material;
        if let Some(instance) = &mut self.instance {
            instance.has_own_material = true;
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
    /// Has the instances of a body follow its new name.
    pub fn rename_instances(&mut self, from: &str, to: &str) {
        let rename = |instance: &mut Option<Instance>| {
            if let Some(instance) = instance.as_mut().filter(|instance| instance.of == from) {
                to.clone_into(&mut instance.of);
            }
        };
        self.edit_instances_of(from, |body| {
            rename(&mut body.instance);
            each_part_mut(&mut body.parts, &mut |part| rename(&mut part.instance));
        });
    }

    /// Makes the instances of a body, which is to be taken away, bodies of their own that look the same.
    pub fn free_instances(&mut self, of: &str) {
        self.edit_instances_of(of, |body| {
            if body.instance.as_ref().is_some_and(|instance| instance.of == of) {
                body.make_own();
            }
            each_part_mut(&mut body.parts, &mut |part| {
                if part.instance.as_ref().is_some_and(|instance| instance.of == of) {
                    part.make_own();
                }
            });
        });
    }

    /// Edits the bodies that are instances of a body or have parts that are; no others are copied.
    fn edit_instances_of(&mut self, of: &str, edit: impl Fn(&mut Body)) {
        for index in 0..self.bodies.len() {
            let is_one = |body: &Body| body.instances().any(|instance| instance.of == of);
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
