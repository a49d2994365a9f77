//! Instances: bodies and parts that have the geometry of another body by its name.
//!
//! To everything that traces, measures or draws it an instance is a body of the shape and the parts of the other one,
//! which all instances share. [`Scene::follow_instances`] brings them up to date with it.

mod follow;

use std::collections::{HashMap, HashSet};

use crate::Scene;
use crate::body::Body;
use crate::compound::{BodyPart, Instance, each_part, each_part_mut};

pub(crate) use follow::{InstanceFault, InstanceProblem};

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
        // Many bodies may have no name, and none is known by that.
        self.free_instances(|of| of.is_empty() || !names.contains(of));
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
