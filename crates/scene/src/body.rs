//! Bodies: a shape, where it stands, what it is made of.

use glam::{DAffine3, DVec3};

use crate::compound::{
    BodyPart, BodyShape, Form, Instance, ParametricShape, box_corners, each_part_mut, part_materials,
};
use crate::contact::BodyContact;
use crate::keyed::keyed;
use crate::material::MaterialChoice;
use crate::placement::Placement;
use crate::shape::Shape;

/// One geometric body of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// Unique name; empty when the file gives none.
    pub name: String,
    /// Shape and sizes in the body's own frame.
    pub shape: Shape,
    /// The transform from that frame to the world.
    pub placement: Placement,
    /// What the body is made of.
    pub material: MaterialChoice,
    /// Whether the body takes no part in the picture: it is not seen, not reflected and throws no shadow. Default
    /// false.
    pub hidden: bool,
    /// What of light on its way to others passes the body. Default what its surfaces let through.
    pub shadow: Shadow,
    /// What lies between the body and others that it touches. Default what those or the scene say.
    pub contact: BodyContact,
    /// Whether the studio leaves the body as it is. No picture depends on it. Default false.
    pub locked: bool,
    /// What the body is joined of; none unless the shape [has parts](Shape::is_compound).
    pub parts: Vec<BodyPart>,
    /// What [shape](Self::shape) and parts are the [expansion](ParametricShape::expansion) of, if they are one.
    pub parametric: Option<Box<ParametricShape>>,
    /// What the body is an instance of, if it is one: it has the shape of that, and no parts of its own.
    pub instance: Option<Instance>,
}

/// What of light on its way to other bodies passes one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Shadow {
    /// What its surfaces and what is in it let through.
    #[default]
    Filtered,
    /// All of it: the body casts no shadow.
    None,
    /// Nothing, whatever it is made of.
    Full,
}

keyed!(Shadow { Filtered = "filtered", None = "none", Full = "full" });

/// The most parts whose outlines are drawn.
const MOST_OUTLINES: usize = 1024;

/// The edges of a box by the corners of [`box_corners`].
fn box_edges(corners: [DVec3; 8]) -> Vec<Vec<DVec3>> {
    let edge = |corner: usize, axis: usize| {
        (corner >> axis & 1 == 0).then(|| vec![corners[corner], corners[corner | 1 << axis]])
    };
    (0..3).flat_map(|axis| (0..8).filter_map(move |corner| edge(corner, axis))).collect()
}

impl Body {
    /// A body of this shape at the origin; one that consists of parts has none yet.
    pub fn of_shape(shape: BodyShape) -> Self {
        let mut body = Self::default();
        body.set_shape(shape);
        body
    }

    /// Whether no picture can tell it from the other: they differ in their names at most, or are both hidden.
    pub fn looks_like(&self, other: &Self) -> bool {
        // All fields by name, so that none is forgotten.
        let Self {
            name: _,
            locked: _,
            shape,
            placement,
            material,
            hidden,
            shadow,
            contact,
            parts,
            parametric: _,
            instance,
        } = self;
        let is_same = other.shape == *shape
            && other.placement == *placement
            && other.material == *material
            && other.shadow == *shadow
            && other.contact == *contact
            && other.parts == *parts
            && other.instance == *instance;
        (*hidden && other.hidden) || (is_same && other.hidden == *hidden)
    }

    /// The shape as files and inspectors say it.
    pub fn body_shape(&self) -> BodyShape {
        self.form().body_shape()
    }

    /// Gives the body another shape. One that is given its parts keeps those that the body has. An instance becomes a
    /// body of its own.
    pub fn set_shape(&mut self, shape: BodyShape) {
        self.make_own();
        (self.shape, self.parts, self.parametric) = shape.into_form(std::mem::take(&mut self.parts));
    }

    /// Changes the sizes of its shape.
    pub fn change_shape(&mut self, change: impl FnOnce(&mut BodyShape)) {
        let mut shape = self.body_shape();
        change(&mut shape);
        self.set_shape(shape);
    }

    /// Its geometry.
    pub fn form(&self) -> Form<'_> {
        let own = (self.parts.as_slice(), self.parametric.as_deref());
        Form::new(self.shape, self.placement, own, self.instance.as_ref())
    }

    /// The shape with the height that it has where it stands: its own, or the distance between its base and top points.
    pub fn sized_shape(&self) -> Shape {
        self.form().sized_shape()
    }

    /// The height where the body stands, meters; `None` for shapes without a height.
    pub fn height(&self) -> Option<f64> {
        self.sized_shape().height()
    }

    /// The middle of the body's extent, meters; of what has no end, its origin.
    pub fn middle(&self) -> DVec3 {
        let middle = self.form().extent().map_or(DVec3::ZERO, |[min, max]| 0.5 * (min + max));
        self.placement.world_from_body().transform_point3(middle)
    }

    /// The lines in the world that an eye sees the body by: its edges, and where the eye looks past its surface; of a
    /// compound body, those of its parts, or those of the box around it where these are too many to be told apart. None
    /// for a plane.
    pub fn outline(&self, eye: DVec3) -> Vec<Vec<DVec3>> {
        if self.form().simple_parts(MOST_OUTLINES) > MOST_OUTLINES {
            return self.box_corners().map(box_edges).unwrap_or_default();
        }
        let mut outline = Vec::new();
        self.form().each_simple(DAffine3::IDENTITY, &mut |part| {
            let lines = part.shape.outline(part.frame.inverse().transform_point3(eye));
            let to_world =
                |line: Vec<DVec3>| line.into_iter().map(|point| part.frame.transform_point3(point)).collect();
            outline.extend(lines.into_iter().map(to_world));
        });
        outline
    }

    /// The corners of the box around the body along the axes of its own frame, meters; `None` for what has no end.
    pub fn box_corners(&self) -> Option<[DVec3; 8]> {
        let ends = self.form().extent()?;
        let frame = self.placement.world_from_body();
        Some(box_corners(ends).map(|corner| frame.transform_point3(corner)))
    }

    /// Its material and those that its parts are given.
    pub fn materials(&self) -> impl Iterator<Item = &MaterialChoice> {
        [&self.material].into_iter().chain(part_materials(&self.parts))
    }

    /// Changes its material and those that its parts are given.
    pub fn each_material_mut(&mut self, change: &mut impl FnMut(&mut MaterialChoice)) {
        change(&mut self.material);
        each_part_mut(&mut self.parts, &mut |part| part.material.iter_mut().for_each(&mut *change));
    }

    /// Whether it or a part of it has the material of this name.
    pub fn uses_material(&self, name: &str) -> bool {
        self.materials().any(|material| material.name() == Some(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::placement::Anchor;

    #[test]
    fn boxes_and_outlines_stand_where_the_body_does() {
        let anchor = Anchor::Axis { base: DVec3::new(1.0, 2.0, 3.0), top: DVec3::new(5.0, 2.0, 3.0) };
        let scale = DVec3::new(1.0, 0.5, 2.0);
        // A height of its own that the points overrule.
        let shape = Shape::Cylinder { radius: 0.5, height: 9.0 };
        let body = Body { shape, placement: Placement { anchor, scale }, ..Body::default() };
        assert!((body.middle() - DVec3::new(2.0, 2.0, 3.0)).length() < 1e-12);
        let corners = body.box_corners().unwrap();
        let [min, max] = [DVec3::min, DVec3::max].map(|pick| corners.into_iter().reduce(pick).unwrap());
        assert!((min - DVec3::new(1.0, 1.5, 2.0)).length() < 1e-12, "{min}");
        assert!((max - DVec3::new(3.0, 2.5, 4.0)).length() < 1e-12, "{max}");
        let eye = DVec3::new(2.0, 40.0, 3.0);
        for point in body.outline(eye).concat() {
            assert!((point - point.clamp(min, max)).length() < 1e-9, "{point}");
        }
        assert_eq!(Body { shape: Shape::Plane, ..body }.box_corners(), None);
    }

    #[test]
    fn what_has_very_many_parts_is_seen_by_its_box() {
        let part =
            |x: usize| BodyPart { placement: Placement::at(DVec3::X * x as f64), ..BodyPart::default() };
        let body =
            |count| Body { shape: Shape::Group, parts: (0..count).map(part).collect(), ..Body::default() };
        assert_eq!(body(2).outline(DVec3::Z * 9.0).len(), 2);
        let edges = body(2000).outline(DVec3::Z * 9.0);
        assert_eq!(edges.len(), 12);
        let lengths: f64 = edges.iter().map(|edge| edge[0].distance(edge[1])).sum();
        assert!((lengths - 4.0 * (2001.0 + 2.0 + 2.0)).abs() < 1e-9, "{lengths}");
    }

    #[test]
    fn axis_points_carry_the_frame() {
        for (base, top) in [
            (DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, -2.0, 3.5)),
            (DVec3::ZERO, DVec3::NEG_Y),
            (DVec3::X, DVec3::new(1.0, 1e-3, 0.0)),
        ] {
            let body = Body {
                shape: Shape::CONE,
                placement: Placement { anchor: Anchor::Axis { base, top }, scale: DVec3::ONE },
                ..Body::default()
            };
            let height = body.height().unwrap();
            let world_from_body = body.placement.world_from_body();
            assert!((world_from_body.transform_point3(DVec3::ZERO) - base).length() < 1e-12);
            assert!((world_from_body.transform_point3(DVec3::Y * height) - top).length() < 1e-12);
            assert!((world_from_body.matrix3.determinant() - 1.0).abs() < 1e-12);
        }
    }
}
