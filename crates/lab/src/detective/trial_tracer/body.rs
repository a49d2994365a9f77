//! Bodies of the trial tracer: their transforms, normals and colors.

use catoptric_scene::{
    Anchor, Body, Material, PatternSpace, Phong, Scene, Shadow, Shape, SolidKind, SolidTexture,
};
use glam::{DAffine3, DVec3, Vec3};

use super::shape::{Hit, Hits, Switches, TrialShape};
use super::vector;
use crate::detective::ray_fault::RayFault;

/// A body that rays meet.
pub(super) struct TrialBody<'a> {
    /// Its place in the scene.
    pub(super) place: usize,
    pub(super) document: &'a Body,
    pub(super) phong: &'a Phong,
    shape: TrialShape,
    world_from_body: DAffine3,
    body_from_world: DAffine3,
    pattern: Option<TrialPattern<'a>>,
    /// What each crossing leaves of light on its way to others.
    pub(super) shadow: Vec3,
}

/// A pattern with the transform to its own space.
struct TrialPattern<'a> {
    solid: &'a SolidTexture,
    pattern_from_world: DAffine3,
}

/// Addend that gives points on a border to the cell above, as [the model](../../../docs/en/model.md) has it.
const BORDER: f64 = 1e-6;

impl<'a> TrialBody<'a> {
    /// `None` if it is of another kind.
    pub(super) fn new(
        scene: &'a Scene,
        (place, body): (usize, &'a Body),
        switches: &Switches,
    ) -> Option<Self> {
        let Material::Phong(phong) = scene.material(&body.material)? else { return None };
        if body.instance.is_some() || body.parametric.is_some() || phong.pattern.texture.is_some() {
            return None;
        }
        let shape = match body.sized_shape() {
            Shape::Sphere { radius } => TrialShape::Sphere { radius },
            Shape::Cube { size } => TrialShape::Cube { half: 0.5 * size },
            Shape::Cylinder { radius, height } => TrialShape::Frustum { base: radius, top: radius, height },
            Shape::Cone { radius, top_radius, height } => {
                TrialShape::Frustum { base: radius, top: top_radius, height }
            }
            Shape::Plane => TrialShape::Plane,
            _ => return None,
        };
        let world_from_body = placed(body, switches);
        let body_from_world = world_from_body.inverse();
        if !body_from_world.is_finite() {
            return None;
        }
        let pattern = match &phong.pattern.solid {
            Some(solid) if solid.first.is_some() || solid.second.is_some() => return None,
            Some(solid) => {
                let space = match solid.space {
                    PatternSpace::World => DAffine3::IDENTITY,
                    PatternSpace::Body => unscaled(body),
                };
                let pattern_from_world = (space * solid.placement().world_from_body()).inverse();
                Some(TrialPattern { solid, pattern_from_world })
            }
            None => None,
        };
        let through = phong.transmission as f32 * vector(phong.tint);
        let shadow = match body.shadow {
            Shadow::Filtered => through,
            Shadow::None => Vec3::ONE,
            Shadow::Full => Vec3::ZERO,
        };
        Some(Self { place, document: body, phong, shape, world_from_body, body_from_world, pattern, shadow })
    }

    /// Whether light passes it.
    pub(super) fn is_clear(&self) -> bool {
        self.phong.transmission > 0.0 && vector(self.phong.tint).max_element() > 0.0
    }

    /// Whether a point of the world lies in it.
    pub(super) fn contains(&self, at: DVec3) -> bool {
        self.shape.contains(self.body_from_world.transform_point3(at))
    }

    /// All hits of a line, and how many times longer its direction is in the body's frame.
    pub(super) fn hits(&self, origin: DVec3, direction: DVec3, switches: &Switches) -> (Hits, f64) {
        let origin = self.body_from_world.transform_point3(origin);
        let direction = self.body_from_world.transform_vector3(direction);
        (self.shape.hits(origin, direction, switches), direction.length())
    }

    /// The normal in the world, outwards.
    pub(super) fn normal(&self, hit: &Hit, position: DVec3, switches: &Switches) -> DVec3 {
        let turned = self.body_from_world.matrix3.transpose() * hit.normal;
        let is_sphere = matches!(self.shape, TrialShape::Sphere { .. });
        if switches.lengths.is_some() {
            return hit.length * turned;
        }
        let own = match switches.normal {
            Some(RayFault::MatrixNormals) => self.world_from_body.matrix3 * hit.normal,
            Some(RayFault::TurnedNormals) => self.document.placement.rotation() * hit.normal,
            Some(RayFault::OwnNormals) => hit.normal,
            Some(RayFault::NormalsFromOrigin) if is_sphere => position,
            _ => turned,
        };
        own.normalize_or(DVec3::Y)
    }

    /// The unit normals by the matrix of the body, and of the unscaled body, on the side of the right one.
    pub(super) fn wrong_normals(&self, position: DVec3, normal: Vec3) -> [Vec3; 2] {
        let own = (self.world_from_body.matrix3.transpose() * normal.as_dvec3()).normalize_or(DVec3::Y);
        let turned = match self.shape {
            TrialShape::Sphere { .. } => position - self.world_from_body.translation,
            _ => self.world_from_body.matrix3 * own,
        };
        [turned, self.document.placement.rotation() * own].map(|wrong| {
            let wrong = wrong.normalize_or(DVec3::Y).as_vec3();
            if wrong.dot(normal) < 0.0 { -wrong } else { wrong }
        })
    }

    /// The color at a point of the world.
    pub(super) fn color(&self, at: DVec3, switches: &Switches) -> Vec3 {
        let first = vector(self.phong.pattern.color);
        let Some(TrialPattern { solid, pattern_from_world }) = &self.pattern else { return first };
        let at = pattern_from_world.transform_point3(at) / solid.size;
        let whole = (at + BORDER).floor();
        let share = match solid.kind {
            SolidKind::Checker => {
                let cell = match switches.checker {
                    Some(RayFault::CheckerTruncated) => at.trunc().element_sum(),
                    Some(_) => whole.x + whole.z,
                    None => whole.element_sum(),
                };
                cell.rem_euclid(2.0)
            }
            SolidKind::Stripes => whole.x.rem_euclid(2.0),
            SolidKind::Rings => (at.x.hypot(at.z) + BORDER).floor().rem_euclid(2.0),
            SolidKind::Gradient => at.x + BORDER - whole.x,
        };
        first.lerp(vector(solid.color), share as f32)
    }
}

/// The frame of a body without its scale.
fn unscaled(body: &Body) -> DAffine3 {
    DAffine3 { matrix3: body.placement.rotation(), translation: body.placement.origin() }
}

/// The transform of a body by the rule of a fault.
fn placed(body: &Body, switches: &Switches) -> DAffine3 {
    let placement = &body.placement;
    let is_frame = matches!(placement.anchor, Anchor::Frame { .. });
    let [moved, turned, scaled] = [
        DAffine3::from_translation(placement.origin()),
        DAffine3::from_mat3(placement.rotation()),
        DAffine3::from_scale(placement.scale),
    ];
    match switches.transform.filter(|_| is_frame) {
        Some(RayFault::ScaledLast) => moved * scaled * turned,
        Some(RayFault::TurnedLast) => turned * moved * scaled,
        Some(RayFault::ScaledAfterMove) => scaled * moved * turned,
        Some(_) => turned * scaled * moved,
        None => moved * turned * scaled,
    }
}
