//! Shapes of the book as bodies.

use std::ops::Range;
use std::rc::Rc;

use catoptric_scene::{
    Body, BodyPart, BodyShape, Material, MaterialChoice, OpenCone, OpenCylinder, ParametricShape, Placement,
    Shape,
};
use glam::{DAffine3, DVec3};

use crate::challenge::material::default_material;
use crate::challenge::pattern::Surface;
use crate::challenge::read::ChallengeReader;
use crate::challenge::table::Table;
use crate::challenge::yaml::Node;
use crate::draft::FAR;
use crate::message::Message;
use crate::triangle::level_triangle_at;

/// The book's axes are left-handed: z into the picture. Ours have it out of it.
pub(super) const MIRROR: DVec3 = DVec3::new(1.0, 1.0, -1.0);

/// A shape in the frame that the book gives it.
#[derive(Clone, Copy)]
pub(super) struct Solid {
    shape: Shape,
    /// Whether it is without caps.
    is_open: bool,
    /// Whether it would have no end.
    is_endless: bool,
    /// From the shape's own frame to the book's.
    object_from_shape: DAffine3,
}

impl Solid {
    const fn plain(shape: Shape) -> Self {
        Self { shape, is_open: false, is_endless: false, object_from_shape: DAffine3::IDENTITY }
    }

    /// A solid around the y axis from one height to another, with its radius at both. An apex is above.
    fn around_axis([from, to]: [f64; 2], [at_from, at_to]: [f64; 2]) -> Self {
        let height = to - from;
        let up = DAffine3::from_translation(DVec3::Y * from);
        // A shape that is mirrored stays one of its kind.
        let down =
            DAffine3::from_translation(DVec3::Y * to) * DAffine3::from_scale(DVec3::new(1.0, -1.0, 1.0));
        let (object_from_shape, radius, top_radius) =
            if at_from > 0.0 { (up, at_from, at_to) } else { (down, at_to, at_from) };
        let shape = if radius == top_radius {
            Shape::Cylinder { radius, height }
        } else {
            Shape::Cone { radius, top_radius, height }
        };
        Self { shape, is_open: false, is_endless: false, object_from_shape }
    }
}

impl ChallengeReader {
    /// The solids of a shape by its name; `None` if there is no such shape.
    pub(super) fn solids(
        &mut self,
        name: &str,
        table: &mut Table,
        span: &Range<usize>,
    ) -> Option<Vec<Solid>> {
        match name {
            "sphere" => Some(vec![Solid::plain(Shape::SPHERE)]),
            "plane" => Some(vec![Solid::plain(Shape::Plane)]),
            "cube" => Some(vec![Solid::plain(Shape::Cube { size: DVec3::splat(2.0) })]),
            "cylinder" | "cone" => Some(self.around_axis(name, table, span)),
            _ => None,
        }
    }

    /// A cylinder of radius 1, or a cone whose radius is its distance from y = 0, between `min` and `max`.
    fn around_axis(&mut self, name: &str, table: &mut Table, span: &Range<usize>) -> Vec<Solid> {
        let any = [-1e9, 1e9];
        let mut end = |keys: &[&str], draft: &mut _| {
            let node = table.take(keys)?;
            // YAML's own infinities are the defaults.
            if node.text().is_some_and(|text| matches!(text, ".inf" | "-.inf")) {
                return None;
            }
            super::table::number(&node, keys.first().copied().unwrap_or_default(), any, draft)
        };
        let min = end(&["min", "minimum"], &mut self.draft);
        let max = end(&["max", "maximum"], &mut self.draft);
        let closed = table.take(&["closed"]);
        let is_closed =
            closed.is_some_and(|node| super::table::flag(&node, "closed", &mut self.draft) == Some(true));
        let name = name.to_owned();
        let is_endless = min.is_none() || max.is_none();
        if is_endless {
            self.draft.note(span, Message::Endless { name: name.clone(), far: FAR.into() }, None);
        }
        let (min, max) = (min.unwrap_or(-FAR), max.unwrap_or(FAR));
        if min >= max {
            self.draft.refuse(span, Message::NoHeight { name }, None);
            return Vec::new();
        }
        let is_open = !is_closed && self.operand.is_none();
        if !is_closed && !is_open {
            self.draft.unsupported(span, Message::OpenEnds { name: name.clone() }, Message::IsClosed);
        }
        let radius = |y: f64| if name == "cylinder" { 1.0 } else { y.abs() };
        let between =
            |ends: [f64; 2]| Solid { is_open, is_endless, ..Solid::around_axis(ends, ends.map(radius)) };
        if name == "cone" && min < 0.0 && max > 0.0 {
            vec![between([min, 0.0]), between([0.0, max])]
        } else {
            vec![between([min, max])]
        }
    }

    /// Adds a triangle that `world_from_object` carries to the book's world. Its plane is y = 0 of the body's own frame, as
    /// patterns on it want.
    pub(super) fn triangle(
        &mut self,
        corners: [DVec3; 3],
        world_from_object: DAffine3,
        material: Option<&Rc<Node>>,
        span: &Range<usize>,
    ) {
        let mirror = DAffine3::from_scale(MIRROR);
        let corners = corners.map(|corner| (mirror * world_from_object).transform_point3(corner));
        let (shape, placement) = level_triangle_at(corners);
        if is_flat(&world_from_object) {
            return self.draft.refuse(span, Message::Flat, None);
        }
        let object_from_world = world_from_object.inverse() * mirror;
        let surface = Surface { object_from_world, placement: &placement, is_plane: true };
        let material = self.material_of(material, &surface);
        self.draft.body(Body { placement, material, ..Body::of_shape(shape) }, span);
    }

    /// What a surface is made of: the book's own material where none can be read.
    fn material_of(&mut self, node: Option<&Rc<Node>>, surface: &Surface<'_>) -> MaterialChoice {
        let material = node.and_then(|node| self.material(node, surface));
        let material = material.unwrap_or_else(|| Material::Phong(default_material()));
        MaterialChoice::Inline(Box::new(material))
    }

    /// The corners of a triangle.
    pub(super) fn corners(&mut self, table: &mut Table) -> Option<[DVec3; 3]> {
        let [a, b, c] = ["p1", "p2", "p3"].map(|key| {
            let node = table.require(&[key], &mut self.draft)?;
            super::table::vector(&node, key, &mut self.draft)
        });
        Some([a?, b?, c?])
    }

    /// Adds a solid that `world_from_object` carries to the book's world.
    pub(super) fn solid(
        &mut self,
        (name, solid): (&str, Solid),
        world_from_object: DAffine3,
        material: Option<&Rc<Node>>,
        span: &Range<usize>,
    ) {
        let mirror = DAffine3::from_scale(MIRROR);
        // In our axes, the shape's own frame being mirrored too, which leaves the shape as it is.
        let world_from_shape = mirror * world_from_object * solid.object_from_shape * mirror;
        if is_flat(&world_from_object) {
            return self.draft.refuse(span, Message::Flat, None);
        }
        let is_plane = solid.shape == Shape::Plane;
        if is_plane && self.operand.is_some() {
            self.draft.unsupported(span, Message::PlaneOfCsg, Message::HalfSpace);
        }
        let Some(placement) = solid.shape.placed(world_from_shape) else {
            self.draft.unsupported(span, Message::Sheared { name: name.to_owned() }, Message::LeftOut);
            return;
        };
        let object_from_world = world_from_object.inverse() * mirror;
        let surface = Surface { object_from_world, placement: &placement, is_plane };
        let material = self.material_of(material, &surface);
        let (shape, placement) = folded(solid.shape, placement);
        match &mut self.operand {
            Some(parts) => {
                parts.push(BodyPart { shape, placement, material: Some(material), ..BodyPart::default() });
            }
            None => {
                let shape = if solid.is_open { opened(shape) } else { BodyShape::Plain(shape) };
                let body = Body { placement, material, ..Body::of_shape(shape) };
                if solid.is_endless {
                    self.draft.endless_body(body, span);
                } else {
                    self.draft.body(body, span);
                }
            }
        }
    }
}

/// Whether a transform leaves nothing of a shape, or takes it to infinity.
fn is_flat(transform: &DAffine3) -> bool {
    !(transform.matrix3.determinant().abs() > 0.0 && transform.is_finite())
}

/// A cylinder or cone without its caps.
fn opened(shape: Shape) -> BodyShape {
    match shape {
        Shape::Cylinder { radius, height } => {
            let open = OpenCylinder { radius, height, ..OpenCylinder::default() };
            BodyShape::Parametric(ParametricShape::OpenCylinder(open))
        }
        Shape::Cone { radius, top_radius, height } => {
            let open = OpenCone { radius, top_radius, height, ..OpenCone::default() };
            BodyShape::Parametric(ParametricShape::OpenCone(open))
        }
        closed => BodyShape::Plain(closed),
    }
}

/// Moves the scale of a body's placement into the sizes of its shape, as far as they can express it.
fn folded(shape: Shape, placement: Placement) -> (Shape, Placement) {
    let scale = placement.scale;
    let plain = Placement { scale: DVec3::ONE, ..placement };
    let is_round = (scale.x - scale.z).abs() <= 1e-12 * scale.x;
    match shape {
        Shape::Sphere { radius } if is_round && (scale.x - scale.y).abs() <= 1e-12 * scale.x => {
            (Shape::Sphere { radius: radius * scale.x }, plain)
        }
        Shape::Cube { size } => (Shape::Cube { size: size * scale }, plain),
        Shape::Cylinder { radius, height } if is_round => {
            (Shape::Cylinder { radius: radius * scale.x, height: height * scale.y }, plain)
        }
        Shape::Cone { radius, top_radius, height } if is_round => {
            let (radius, top_radius) = (radius * scale.x, top_radius * scale.x);
            (Shape::Cone { radius, top_radius, height: height * scale.y }, plain)
        }
        _ => (shape, placement),
    }
}
