//! The reasons why an exact answer does not exist: a formula does not apply.

use catoptric_scene::{Body, Material, Scene, Shape};
use glam::DVec3;

use super::{PlacedBody, dishes, radius};

/// The reason why a formula does not apply. Numbers are places of bodies in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inapplicable {
    /// A rough mirror scatters the light of each point: it has no image points.
    RoughMirror {
        /// The mirror.
        mirror: usize,
    },
    /// A mirror that is neither flat nor a ball: the mirror equation does not hold.
    CurvedMirror {
        /// The mirror.
        mirror: usize,
    },
    /// A body of parts, which mirrors or bends light in a way that no formula here knows.
    OfParts {
        /// The body.
        body: usize,
    },
    /// A body in the focus of a spherical mirror, or so near that rays from it are mirrored parallel.
    ObjectInFocus {
        /// The mirror.
        mirror: usize,
        /// The body.
        body: usize,
    },
    /// A rough ball of glass scatters light instead of gathering it.
    RoughLens {
        /// The ball.
        body: usize,
    },
    /// A sphere that is not scaled evenly, and so no ball.
    UnevenLens {
        /// The sphere.
        body: usize,
    },
    /// Something stands in the ball, or the ball stands in something.
    SharedLens {
        /// The ball.
        body: usize,
        /// What overlaps it.
        other: usize,
    },
    /// A ball whose index is so near to 1 that it hardly bends light.
    WeakLens {
        /// The ball.
        body: usize,
    },
    /// A ball with an index of 2 or more: rays meet within it, where they are still to be bent once more.
    FocusInside {
        /// The ball.
        body: usize,
    },
}

/// The least index of a lens. Below it a ray near the axis is bent by less than 10⁻³, which single precision knows to
/// no better than a ten-thousandth.
const LEAST_IOR: f64 = 1.05;

impl Inapplicable {
    /// The mirror or the ball.
    pub fn body(self) -> usize {
        match self {
            Self::RoughMirror { mirror }
            | Self::CurvedMirror { mirror }
            | Self::ObjectInFocus { mirror, .. } => mirror,
            Self::OfParts { body }
            | Self::RoughLens { body }
            | Self::UnevenLens { body }
            | Self::SharedLens { body, .. }
            | Self::WeakLens { body }
            | Self::FocusInside { body } => body,
        }
    }

    /// The other body that it is about, if there is one.
    pub fn other(self) -> Option<usize> {
        match self {
            Self::ObjectInFocus { body, .. } => Some(body),
            Self::SharedLens { other, .. } => Some(other),
            _ => None,
        }
    }

    /// The reason's word in JSON.
    pub const fn key(self) -> &'static str {
        match self {
            Self::RoughMirror { .. } => "rough-mirror",
            Self::CurvedMirror { .. } => "curved-mirror",
            Self::OfParts { .. } => "of-parts",
            Self::ObjectInFocus { .. } => "object-in-focus",
            Self::RoughLens { .. } => "rough-lens",
            Self::UnevenLens { .. } => "uneven-lens",
            Self::SharedLens { .. } => "shared-lens",
            Self::WeakLens { .. } => "weak-lens",
            Self::FocusInside { .. } => "focus-inside",
        }
    }

    /// Why a mirror has no image points that a formula knows.
    pub(super) fn of_mirror(index: usize, body: &Body, material: &Material) -> Option<Self> {
        if material.is_rough() {
            return Some(Self::RoughMirror { mirror: index });
        }
        let is_dish = dishes::is_mirror(body, material);
        if body.shape.is_compound() && !is_dish {
            return Some(Self::OfParts { body: index });
        }
        let is_solvable = match body.shape {
            Shape::Plane | Shape::Cube { .. } => true,
            Shape::Sphere { .. } => radius(body).is_some(),
            _ => false,
        };
        (!is_solvable).then_some(Self::CurvedMirror { mirror: index })
    }

    /// Why a transparent sphere has no focal point that the formula of a ball in air knows.
    pub(super) fn of_lens(scene: &Scene, lens: &PlacedBody<'_>) -> Option<Self> {
        let body = lens.index;
        let material = scene.material(&lens.body.material)?;
        if material.is_rough() {
            return Some(Self::RoughLens { body });
        }
        let Some(radius) = radius(lens.body) else { return Some(Self::UnevenLens { body }) };
        let ior = material.ior()?;
        if ior >= 2.0 {
            return Some(Self::FocusInside { body });
        }
        let mut others =
            scene.bodies.iter().enumerate().filter(|(index, other)| *index != body && !other.hidden);
        let shared = others.find(|(_, other)| distance_from(other, lens.center) < radius * (1.0 - CONTACT));
        match shared {
            Some((other, _)) => Some(Self::SharedLens { body, other }),
            None => (ior < LEAST_IOR).then_some(Self::WeakLens { body }),
        }
    }

    /// Why a lens of two faces has no focal point that the formula of a lens in air knows.
    pub(super) fn of_thick_lens(scene: &Scene, lens: &PlacedBody<'_>) -> Option<Self> {
        let body = lens.index;
        let material = scene.material(&lens.body.material)?;
        if material.is_rough() {
            return Some(Self::RoughLens { body });
        }
        let mut others =
            scene.bodies.iter().enumerate().filter(|(index, other)| *index != body && !other.hidden);
        match others.find(|(_, other)| distance_from(other, lens.center) <= 0.0) {
            Some((other, _)) => Some(Self::SharedLens { body, other }),
            None => material.ior().filter(|ior| *ior < LEAST_IOR).map(|_| Self::WeakLens { body }),
        }
    }
}

/// Balls that touch something, as one on the floor does, are told from those that overlap it up to this part of their
/// radius.
const CONTACT: f64 = 1e-6;

/// The least distance of a point from a body, meters; 0 or less within it. Of a body that stands on an axis it is that
/// from the cylinder around it, and of an uneven sphere or a body of parts that from the box around it.
fn distance_from(body: &Body, point: DVec3) -> f64 {
    let frame = body.placement.world_from_body();
    let scale = body.placement.scale.abs();
    let local = body.placement.rotation().transpose() * (point - frame.translation);
    let beyond = |offset: DVec3, half: DVec3| (offset.abs() - half).max(DVec3::ZERO).length();
    if body.shape.is_compound() {
        let Some([min, max]) = body.form().extent() else { return 0.0 };
        return beyond(local - 0.5 * (min + max) * scale, 0.5 * (max - min) * scale);
    }
    let Some([_, max]) = body.sized_shape().extent() else { return local.y };
    let along = |radius: f64, height: f64| {
        let half = 0.5 * height * scale.y;
        let height = (local.y - half).abs() - half;
        let across = (local / scale * DVec3::new(1.0, 0.0, 1.0)).length() - radius;
        // The lesser scale gives the lesser distance.
        let across = across * scale.x.min(scale.z);
        DVec3::new(across.max(0.0), height.max(0.0), 0.0).length()
    };
    match (radius(body), body.height()) {
        (Some(radius), _) => local.length() - radius,
        (None, Some(height)) => along(max.x, height),
        (None, None) => beyond(local, max * scale),
    }
}
