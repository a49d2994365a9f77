//! What makes a body or a part an instance of another body.

use std::sync::Arc;

use super::{BodyPart, ParametricShape};
use crate::material::MaterialChoice;

/// What makes a body or a part an instance of a body of the scene.
#[derive(Clone, Debug, Default)]
pub struct Instance {
    /// The name of that body.
    pub of: String,
    /// Whether it has a material of its own. By default it has that of the other body; another one that it is given is its
    /// own as soon as it follows that body again.
    pub has_own_material: bool,
    /// The parts of the other body.
    pub(crate) shared: Arc<SharedForm>,
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
pub(crate) struct SharedForm {
    pub(crate) parts: Vec<BodyPart>,
    pub(crate) parametric: Option<Box<ParametricShape>>,
    /// The material of the other body. An instance that has another one was given it since, as its own.
    pub(crate) material: Option<MaterialChoice>,
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

impl BodyPart {
    /// Makes a part of its own of an instance, which looks the same. Does nothing to others.
    pub fn make_own(&mut self) {
        if let Some(instance) = self.instance.take() {
            self.parts.clone_from(&instance.shared.parts);
            self.parametric.clone_from(&instance.shared.parametric);
        }
    }
}
