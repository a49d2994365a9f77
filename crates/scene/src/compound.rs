//! Compound bodies: unions, intersections, differences, surfaces and groups of parts.

mod instance;
mod parametric;

use glam::{DAffine3, DVec3};

pub use instance::Instance;
pub(crate) use instance::SharedForm;
pub use parametric::{
    BodyShape, Bowl, Disc, DishDepth, DishProfile, Expansion, Lens, LensCurvature, MirrorDish, OpenCone,
    OpenCylinder, ParametricShape, Prism, Rectangle, Ring, Triangle, Tube, Wedge,
};
pub(crate) use parametric::{BrokenSize, SizeFault};

use crate::material::MaterialChoice;
use crate::placement::{Anchor, Placement};
use crate::shape::Shape;

/// A part of a compound body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyPart {
    /// Unique among the parts of a body; empty when the file gives none.
    pub name: String,
    /// Shape and sizes in the part's own frame.
    pub shape: Shape,
    /// The transform from that frame to the frame of what it is a part of.
    pub placement: Placement,
    /// What its surface is made of. `None`, the default, is the material of what it is a part of.
    pub material: Option<MaterialChoice>,
    /// Its own parts; none unless the shape [has parts](Shape::is_compound).
    pub parts: Vec<BodyPart>,
    /// What [shape](Self::shape) and parts are the [expansion](ParametricShape::expansion) of, if they are one.
    pub parametric: Option<Box<ParametricShape>>,
    /// What it is an instance of, if it is one: it has the shape of that, and no parts of its own.
    pub instance: Option<Instance>,
}

/// A simple part where it stands.
#[derive(Clone, Copy, Debug)]
pub struct SimplePart<'a> {
    /// Its shape, with the height that it has there; never a compound one.
    pub shape: Shape,
    /// The transform from its own frame to the one that was asked for. Axes of this need not be perpendicular: a part may
    /// be turned within a whole that is stretched.
    pub frame: DAffine3,
    /// The material that the part or a part around it is given; `None` is the body's.
    pub material: Option<&'a MaterialChoice>,
}

/// The geometry of a body or of a part: its shape, where it stands, and its parts.
#[derive(Clone, Copy, Debug)]
pub struct Form<'a> {
    /// Shape and sizes in its own frame.
    pub shape: Shape,
    /// The transform from that frame to the one around.
    pub placement: Placement,
    /// Its parts, in its own frame.
    pub parts: &'a [BodyPart],
    /// What shape and parts are the expansion of, unless they have been changed since.
    pub(crate) expanded: Option<&'a ParametricShape>,
    /// What it is an instance of, if it is one.
    pub instance: Option<&'a Instance>,
}

impl Shape {
    /// The largest number of simple parts in a compound shape that is no group.
    pub const MAX_PARTS: usize = 64;
    /// How deep parts may be nested: a body with simple parts has the depth 1.
    pub const MAX_DEPTH: usize = 8;
}

impl BodyPart {
    /// Its geometry.
    pub fn form(&self) -> Form<'_> {
        let own = (self.parts.as_slice(), self.parametric.as_deref());
        Form::new(self.shape, self.placement, own, self.instance.as_ref())
    }
}

/// The materials that parts are given, and parts within them.
pub(crate) fn part_materials(parts: &[BodyPart]) -> Vec<&MaterialChoice> {
    let mut materials = Vec::new();
    for part in parts {
        materials.extend(&part.material);
        materials.append(&mut part_materials(&part.parts));
    }
    materials
}

/// Shows all parts, and the parts within them after these.
pub(crate) fn each_part<'a>(parts: &'a [BodyPart], take: &mut impl FnMut(&'a BodyPart)) {
    for part in parts {
        take(part);
        each_part(&part.parts, take);
    }
}

/// Changes all parts, and the parts within them after these.
pub(crate) fn each_part_mut(parts: &mut [BodyPart], change: &mut impl FnMut(&mut BodyPart)) {
    for part in parts {
        change(part);
        each_part_mut(&mut part.parts, change);
    }
}

impl<'a> Form<'a> {
    /// An instance has the parts of what it is an instance of in the place of its own.
    pub(crate) fn new(
        shape: Shape,
        placement: Placement,
        own: (&'a [BodyPart], Option<&'a ParametricShape>),
        instance: Option<&'a Instance>,
    ) -> Self {
        let of_instance = |instance: &'a Instance| (instance.parts(), instance.parametric());
        let (parts, expanded) = instance.map_or(own, of_instance);
        Self { shape, placement, parts, expanded, instance }
    }

    /// The shape with the height that it has where it stands: its own, or the distance between its base and top points.
    pub fn sized_shape(&self) -> Shape {
        let mut shape = self.shape;
        if let Anchor::Axis { base, top } = self.placement.anchor {
            shape.set_height(base.distance(top));
        }
        shape
    }

    /// The least and the greatest coordinates of a box around it in its own frame: the tightest for a simple shape.
    /// `None` for what has no end.
    pub fn extent(&self) -> Option<[DVec3; 2]> {
        if let Some(shape) = self.parametric() {
            return Some(shape.extent());
        }
        let of_part = |part: &BodyPart| part.form().extent_around();
        let mut boxes = self.parts.iter().map(of_part);
        let extent = match self.shape {
            Shape::Union | Shape::Group => boxes.try_fold(NOWHERE, |[min, max], part| {
                let [least, greatest] = part?;
                Some([min.min(least), max.max(greatest)])
            })?,
            Shape::Difference => boxes.next().unwrap_or(Some(NOWHERE))?,
            Shape::Intersection | Shape::Surface { .. } => {
                boxes.flatten().reduce(|[min, max], [least, greatest]| {
                    let (min, max) = (min.max(least), max.min(greatest));
                    if min.cmple(max).all() { [min, max] } else { NOWHERE }
                })?
            }
            _ => return self.sized_shape().extent(),
        };
        // What has no parts is a point.
        Some(if extent[0].cmple(extent[1]).all() { extent } else { [DVec3::ZERO; 2] })
    }

    /// The least and the greatest coordinates of a box around it in the frame that it is placed in. `None` for what has no
    /// end.
    fn extent_around(&self) -> Option<[DVec3; 2]> {
        let frame = self.placement.world_from_body();
        if !self.shape.is_compound() {
            let shape = self.sized_shape();
            let reach = |direction: DVec3| shape.support(frame.matrix3.transpose() * direction);
            let greatest = DVec3::new(reach(DVec3::X)?, reach(DVec3::Y)?, reach(DVec3::Z)?);
            let least = -DVec3::new(reach(DVec3::NEG_X)?, reach(DVec3::NEG_Y)?, reach(DVec3::NEG_Z)?);
            return Some([frame.translation + least, frame.translation + greatest]);
        }
        let corners = box_corners(self.extent()?).map(|corner| frame.transform_point3(corner));
        let [min, max] = [DVec3::min, DVec3::max].map(|pick| corners.into_iter().reduce(pick));
        Some([min?, max?])
    }

    /// How many simple parts it has, or more than `most` if there are.
    pub fn simple_parts(&self, most: usize) -> usize {
        if !self.shape.is_compound() {
            return 1;
        }
        let mut count = 0;
        for part in self.parts {
            count += part.form().simple_parts(most.saturating_sub(count));
            if count > most {
                break;
            }
        }
        count
    }

    /// Shows `take` each simple part, itself if it is simple; `around` is the transform of the frame around.
    pub fn each_simple(&self, around: DAffine3, take: &mut impl FnMut(SimplePart<'a>)) {
        self.each_simple_of(None, around, take);
    }

    fn each_simple_of(
        &self,
        material: Option<&'a MaterialChoice>,
        around: DAffine3,
        take: &mut impl FnMut(SimplePart<'a>),
    ) {
        let frame = around * self.placement.world_from_body();
        if !self.shape.is_compound() {
            return take(SimplePart { shape: self.sized_shape(), frame, material });
        }
        for part in self.parts {
            part.form().each_simple_of(part.material.as_ref().or(material), frame, take);
        }
    }
}

/// A box that holds nothing.
const NOWHERE: [DVec3; 2] = [DVec3::INFINITY, DVec3::NEG_INFINITY];

/// The corners of a box between two of them.
pub(crate) fn box_corners(ends: [DVec3; 2]) -> [DVec3; 8] {
    std::array::from_fn(|corner| {
        let [x, y, z] = [0, 1, 2].map(|axis| ends[corner >> axis & 1][axis]);
        DVec3::new(x, y, z)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;

    fn part(shape: Shape, at: DVec3) -> BodyPart {
        BodyPart { shape, placement: Placement::at(at), ..BodyPart::default() }
    }

    fn extent(shape: Shape, parts: Vec<BodyPart>) -> Option<[DVec3; 2]> {
        Body { shape, parts, ..Body::default() }.form().extent()
    }

    #[test]
    fn boxes_hold_what_is_joined() {
        let ball = |x: f64| part(Shape::SPHERE, DVec3::X * x);
        let two = || vec![ball(-0.5), ball(0.5)];
        let corner = DVec3::new(1.5, 1.0, 1.0);
        assert_eq!(extent(Shape::Union, two()), Some([-corner, corner]));
        assert_eq!(extent(Shape::Group, two()), Some([-corner, corner]));
        let corner = DVec3::new(0.5, 1.0, 1.0);
        assert_eq!(extent(Shape::Intersection, two()), Some([-corner, corner]));
        let left = [DVec3::new(-1.5, -1.0, -1.0), DVec3::new(0.5, 1.0, 1.0)];
        assert_eq!(extent(Shape::Difference, two()), Some(left));
    }

    #[test]
    fn planes_are_endless_unless_something_ends_them() {
        let parts = || vec![part(Shape::Plane, DVec3::ZERO), part(Shape::SPHERE, DVec3::ZERO)];
        assert_eq!(extent(Shape::Union, parts()), None);
        assert_eq!(extent(Shape::Difference, parts()), None);
        assert_eq!(extent(Shape::Intersection, parts()), Some([DVec3::NEG_ONE, DVec3::ONE]));
    }

    #[test]
    fn what_is_empty_is_a_point() {
        let apart = vec![part(Shape::SPHERE, DVec3::ZERO), part(Shape::SPHERE, DVec3::X * 9.0)];
        for (shape, parts) in [(Shape::Intersection, apart), (Shape::Union, Vec::new())] {
            assert_eq!(extent(shape, parts), Some([DVec3::ZERO; 2]), "{shape:?}");
        }
    }

    #[test]
    fn simple_parts_stand_where_all_frames_carry_them() {
        let inner = BodyPart {
            shape: Shape::Union,
            placement: Placement::at(DVec3::Y),
            material: Some(MaterialChoice::Named("red".to_owned())),
            parts: vec![part(Shape::CUBE, DVec3::X)],
            ..BodyPart::default()
        };
        let body = Body {
            shape: Shape::Difference,
            placement: Placement { scale: DVec3::splat(2.0), ..Placement::at(DVec3::Z) },
            parts: vec![part(Shape::SPHERE, DVec3::ZERO), inner],
            ..Body::default()
        };
        let mut found = Vec::new();
        body.form().each_simple(DAffine3::IDENTITY, &mut |part| {
            found.push((
                part.shape.kind().key(),
                part.frame.translation,
                part.material.and_then(|m| m.name()),
            ));
        });
        let addresses = [0, 1, 2].map(|place| body.form().part_address(place));
        assert_eq!(addresses, [Some("parts.0".to_owned()), Some("parts.1.parts.0".to_owned()), None]);
        assert_eq!(Body::default().form().part_address(0), None);
        let cube = DVec3::new(2.0, 2.0, 1.0);
        assert_eq!(found, [("sphere", DVec3::Z, None), ("cube", cube, Some("red"))]);
    }
}
