//! Parametric shapes: lenses, tubes and others that a few numbers make of parts.
//!
//! A parametric shape is a body of parts to everything that traces, measures or draws it: the shape and the parts of a
//! [`Body`](crate::Body) are its expansion, and [`Body::parametric`](crate::Body::parametric) remembers what of. What a
//! parametric shape is stands in a file of its own below `parametric/`: its sizes by their keys, the rules between them,
//! its extent and its parts.

mod bowl;
mod disc;
mod lens;
mod mirror_dish;
mod open_cone;
mod open_cylinder;
mod polygon;
mod prism;
mod rectangle;
mod ring;
mod triangle;
mod tube;
mod wedge;

use glam::{DQuat, DVec3};

use super::{BodyPart, Form};
use crate::frame::rotation_degrees;
use crate::placement::{Anchor, Placement};
use crate::shape::{Shape, ShapeKind, VisibleSide};

pub use bowl::Bowl;
pub use disc::Disc;
pub use lens::{Lens, LensCurvature};
pub use mirror_dish::{DishDepth, DishProfile, MirrorDish};
pub use open_cone::OpenCone;
pub use open_cylinder::OpenCylinder;
pub use prism::Prism;
pub use rectangle::Rectangle;
pub use ring::Ring;
pub use triangle::Triangle;
pub use tube::Tube;
pub use wedge::Wedge;

/// A shape that numbers make of parts, each in its own frame (meters).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParametricShape {
    /// A lens about the origin; its axis is Y.
    Lens(Lens),
    /// A solid disc with a concave face that opens along +Y from its vertex at the origin.
    MirrorDish(MirrorDish),
    /// A tube from the origin along +Y, open at both ends.
    Tube(Tube),
    /// A flat ring about the origin; its axis is Y.
    Ring(Ring),
    /// A bowl that stands on the origin and opens along +Y.
    Bowl(Bowl),
    /// A regular prism from the origin along +Y.
    Prism(Prism),
    /// A ramp about the origin: the half of a box below a diagonal plane.
    Wedge(Wedge),
    /// The curved surface of a cylinder from the origin along +Y.
    OpenCylinder(OpenCylinder),
    /// The curved surface of a cone or frustum from the origin along +Y.
    OpenCone(OpenCone),
    /// A flat disc about the origin; its normal is +Y.
    Disc(Disc),
    /// A flat rectangle about the origin; its normal is +Y.
    Rectangle(Rectangle),
    /// A flat triangle.
    Triangle(Triangle),
}

/// What a parametric shape is asked for, in its own frame.
trait Parametric {
    /// The number that scene files call `key`, if that is one of the shape's own.
    fn number_mut(&mut self, _key: &str) -> Option<&mut f64> {
        None
    }

    /// The number of `key` where it is none of the shape's own as it is: it may be absent, or another stands for it.
    fn number(&self, _key: &str) -> Option<f64> {
        None
    }

    /// What the number of `key` would be, where another one says it.
    fn derived_number(&self, _key: &str) -> Option<f64> {
        None
    }

    /// Sets the number of `key`, as [`Self::number`] has it. Does nothing if the shape has none.
    fn set_number(&mut self, _key: &str, _value: f64) {}

    /// The three numbers that scene files call `key`, if the shape has them.
    fn vector_mut(&mut self, _key: &str) -> Option<&mut DVec3> {
        None
    }

    /// The sides that rays meet, of a surface without inside.
    fn side_mut(&mut self) -> Option<&mut VisibleSide> {
        None
    }

    /// The first rule between its sizes that it breaks. Each size is within the limits of its key.
    fn broken_size(&self) -> Option<BrokenSize> {
        None
    }

    /// The least and the greatest coordinates.
    fn extent(&self) -> [DVec3; 2];

    /// The bodies that it is made of and how they are joined; whatever, where a rule is broken.
    fn expansion(&self) -> Expansion;
}

/// The parts of a parametric shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Expansion {
    /// How they are joined.
    pub shape: Shape,
    /// The parts, without names or materials of their own.
    pub parts: Vec<BodyPart>,
}

/// How far parts reach past what they cut or are cut by, as a share of the sizes: far more than the rounding of single
/// precision, in which bodies are traced, so that no faces coincide.
const MARGIN: f64 = 1.0 / 1024.0;

impl Expansion {
    /// What lies in all of the parts.
    fn intersection(parts: Vec<BodyPart>) -> Self {
        Self { shape: Shape::Intersection, parts }
    }

    /// What lies in `whole` and in none of `cutters`.
    fn difference(whole: BodyPart, cutters: impl IntoIterator<Item = BodyPart>) -> Self {
        Self { shape: Shape::Difference, parts: [whole].into_iter().chain(cutters).collect() }
    }

    /// The surface of `first` as far as it lies in all of `cutters`.
    fn surface(side: VisibleSide, first: BodyPart, cutters: impl IntoIterator<Item = BodyPart>) -> Self {
        Self { shape: Shape::Surface { side }, parts: [first].into_iter().chain(cutters).collect() }
    }

    /// The expansion as one part of another.
    fn into_part(self) -> BodyPart {
        BodyPart { shape: self.shape, parts: self.parts, ..BodyPart::default() }
    }
}

/// A simple part, moved along Y.
fn part(shape: Shape, y: f64) -> BodyPart {
    BodyPart { shape, placement: Placement::at(DVec3::Y * y), ..BodyPart::default() }
}

/// The half-space below the plane through a point with this normal, which need not be of length 1.
fn half_space(at: DVec3, normal: DVec3) -> BodyPart {
    let turn = DQuat::from_rotation_arc(DVec3::Y, normal.normalize_or(DVec3::Y));
    let anchor = Anchor::Frame { position: at, rotation_degrees: rotation_degrees(turn) };
    let placement = Placement { anchor, ..Placement::default() };
    BodyPart { shape: Shape::Plane, placement, ..BodyPart::default() }
}

/// A cylinder about the axis Y between two heights.
fn cylinder(radius: f64, bottom: f64, top: f64) -> BodyPart {
    part(Shape::Cylinder { radius, height: top - bottom }, bottom)
}

/// A box between two corners.
fn cuboid([min, max]: [DVec3; 2]) -> BodyPart {
    let placement = Placement::at(0.5 * (min + max));
    BodyPart { shape: Shape::Cube { size: max - min }, placement, ..BodyPart::default() }
}

/// The box around what is round about the axis Y.
fn round_extent(radius: f64, bottom: f64, top: f64) -> [DVec3; 2] {
    [DVec3::new(-radius, bottom, -radius), DVec3::new(radius, top, radius)]
}

/// Sizes of a shape that contradict each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BrokenSize {
    /// The key that is marked.
    pub(crate) key: &'static str,
    /// What is wrong.
    pub(crate) fault: SizeFault,
}

/// What is wrong with the sizes of a parametric shape. Lengths are in meters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SizeFault {
    /// A size is no length above 0.
    NoLength { value: f64 },
    /// A size is not smaller than the one that it lies within.
    NotSmaller { other: &'static str },
    /// The rim of a bowl lies where the inner ball is not.
    BowlClosed { least: f64, most: f64 },
    /// The ball of a face is not wider than the rim.
    FaceTooNarrow { radius: f64 },
    /// The corners of a triangle lie on a line.
    FlatTriangle,
    /// The faces of a lens meet before the rim.
    LensTooThin { least: f64 },
    /// The ball of a face ends within the lens.
    LensTooThick { most: f64 },
    /// A focal length for the index 1.
    NoRefraction,
    /// A focal length that no lens of the thickness has.
    NoSuchLens { at_least: f64 },
    /// The rim of a dish is too near or too far.
    DishDepth,
}

impl SizeFault {
    /// The fault at a key.
    const fn at(self, key: &'static str) -> BrokenSize {
        BrokenSize { key, fault: self }
    }
}

/// The size `key` must be smaller than the size `other`.
fn smaller(key: &'static str, value: f64, other: &'static str, limit: f64) -> Option<BrokenSize> {
    (value >= limit).then(|| SizeFault::NotSmaller { other }.at(key))
}

/// Whether a number is within the limits of lengths in scene files.
fn is_length(value: f64) -> bool {
    (1e-9..=1e9).contains(&value)
}

impl ParametricShape {
    fn as_parametric(&self) -> &dyn Parametric {
        match self {
            Self::Lens(lens) => lens,
            Self::MirrorDish(dish) => dish,
            Self::Tube(tube) => tube,
            Self::Ring(ring) => ring,
            Self::Bowl(bowl) => bowl,
            Self::Prism(prism) => prism,
            Self::Wedge(wedge) => wedge,
            Self::OpenCylinder(open_cylinder) => open_cylinder,
            Self::OpenCone(open_cone) => open_cone,
            Self::Disc(disc) => disc,
            Self::Rectangle(rectangle) => rectangle,
            Self::Triangle(triangle) => triangle,
        }
    }

    fn as_parametric_mut(&mut self) -> &mut dyn Parametric {
        match self {
            Self::Lens(lens) => lens,
            Self::MirrorDish(dish) => dish,
            Self::Tube(tube) => tube,
            Self::Ring(ring) => ring,
            Self::Bowl(bowl) => bowl,
            Self::Prism(prism) => prism,
            Self::Wedge(wedge) => wedge,
            Self::OpenCylinder(open_cylinder) => open_cylinder,
            Self::OpenCone(open_cone) => open_cone,
            Self::Disc(disc) => disc,
            Self::Rectangle(rectangle) => rectangle,
            Self::Triangle(triangle) => triangle,
        }
    }

    /// Which shape it is.
    pub const fn kind(&self) -> ShapeKind {
        match self {
            Self::Lens(_) => ShapeKind::Lens,
            Self::MirrorDish(_) => ShapeKind::MirrorDish,
            Self::Tube(_) => ShapeKind::Tube,
            Self::Ring(_) => ShapeKind::Ring,
            Self::Bowl(_) => ShapeKind::Bowl,
            Self::Prism(_) => ShapeKind::Prism,
            Self::Wedge(_) => ShapeKind::Wedge,
            Self::OpenCylinder(_) => ShapeKind::OpenCylinder,
            Self::OpenCone(_) => ShapeKind::OpenCone,
            Self::Disc(_) => ShapeKind::Disc,
            Self::Rectangle(_) => ShapeKind::Rectangle,
            Self::Triangle(_) => ShapeKind::Triangle,
        }
    }

    /// The shape of this kind in its default size; `None` for what is not parametric.
    pub fn of_kind(kind: ShapeKind) -> Option<Self> {
        Some(match kind {
            ShapeKind::Lens => Self::Lens(Lens::default()),
            ShapeKind::MirrorDish => Self::MirrorDish(MirrorDish::default()),
            ShapeKind::Tube => Self::Tube(Tube::default()),
            ShapeKind::Ring => Self::Ring(Ring::default()),
            ShapeKind::Bowl => Self::Bowl(Bowl::default()),
            ShapeKind::Prism => Self::Prism(Prism::default()),
            ShapeKind::Wedge => Self::Wedge(Wedge::default()),
            ShapeKind::OpenCylinder => Self::OpenCylinder(OpenCylinder::default()),
            ShapeKind::OpenCone => Self::OpenCone(OpenCone::default()),
            ShapeKind::Disc => Self::Disc(Disc::default()),
            ShapeKind::Rectangle => Self::Rectangle(Rectangle::default()),
            ShapeKind::Triangle => Self::Triangle(Triangle::default()),
            _ => return None,
        })
    }

    /// The number that scene files call `key`, if the shape has it.
    pub fn number(&self, key: &str) -> Option<f64> {
        let mut shape = *self;
        shape.as_parametric_mut().number_mut(key).copied().or_else(|| self.as_parametric().number(key))
    }

    /// Sets the number that scene files call `key`. Does nothing if the shape has none.
    pub fn set_number(&mut self, key: &str, value: f64) {
        let shape = self.as_parametric_mut();
        match shape.number_mut(key) {
            Some(number) => *number = value,
            None => shape.set_number(key, value),
        }
    }

    /// The three numbers that scene files call `key`: the `size` of a wedge, the corners of a triangle.
    pub fn vector(&self, key: &str) -> Option<DVec3> {
        let mut shape = *self;
        shape.as_parametric_mut().vector_mut(key).copied()
    }

    /// Sets the three numbers that scene files call `key`. Does nothing if the shape has none.
    pub fn set_vector(&mut self, key: &str, value: DVec3) {
        if let Some(vector) = self.as_parametric_mut().vector_mut(key) {
            *vector = value;
        }
    }

    /// The word that scene files call `key`: the `profile` of a mirror dish, the `visible_side` of a surface.
    pub fn word(&self, key: &str) -> Option<&'static str> {
        match self {
            Self::MirrorDish(dish) if key == "profile" => Some(dish.profile.key()),
            _ if key == "visible_side" => self.visible_side().map(VisibleSide::key),
            _ => None,
        }
    }

    /// The sides that rays meet; `None` for what has an inside.
    pub fn visible_side(&self) -> Option<VisibleSide> {
        let mut shape = *self;
        shape.as_parametric_mut().side_mut().copied()
    }

    /// Sets the word that scene files call `key`. Does nothing if the shape has none, or if it has no such value.
    pub fn set_word(&mut self, key: &str, word: &str) {
        match self {
            Self::MirrorDish(dish) if key == "profile" => {
                dish.profile = DishProfile::of_key(word).unwrap_or(dish.profile);
            }
            _ if key == "visible_side" => {
                if let Some(side) = self.as_parametric_mut().side_mut() {
                    *side = VisibleSide::of_key(word).unwrap_or(*side);
                }
            }
            _ => {}
        }
    }

    /// The first rule between its sizes that it breaks.
    pub(crate) fn broken_size(&self) -> Option<BrokenSize> {
        self.as_parametric().broken_size()
    }

    /// The least and the greatest coordinates in its own frame.
    pub fn extent(&self) -> [DVec3; 2] {
        self.as_parametric().extent()
    }

    /// The bodies that it is made of, and how they are joined.
    ///
    /// ```
    /// use catoptric_scene::{ParametricShape, Shape, Tube};
    /// let tube = ParametricShape::Tube(Tube { radius: 2.0, inner_radius: 1.5, height: 3.0 }).expansion();
    /// assert_eq!((tube.shape, tube.parts.len()), (Shape::Difference, 2));
    /// ```
    pub fn expansion(&self) -> Expansion {
        self.as_parametric().expansion()
    }

    /// Whether all its sizes are numbers; comparisons say nothing of others.
    fn is_finite(&self) -> bool {
        let numbers = SIZES.iter().chain(&["ior"]).filter_map(|key| self.number(key));
        let vectors = VECTORS.iter().filter_map(|key| self.vector(key));
        numbers.chain(vectors.flat_map(|vector| vector.to_array())).all(f64::is_finite)
    }
}

/// The sizes that are lengths, by their keys.
const SIZES: [&str; 11] = [
    "radius",
    "inner_radius",
    "top_radius",
    "width",
    "length",
    "thickness",
    "height",
    "focal_length",
    "curvature_radius",
    "front_radius",
    "back_radius",
];

/// The sizes and corners that are three lengths, by their keys.
const VECTORS: [&str; 4] = ["size", "a", "b", "c"];

/// The shape of a body or a part as files and inspectors say it: a simple one, a kind of whole, or a parametric one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyShape {
    /// What is not parametric.
    Plain(Shape),
    /// What its numbers make of parts.
    Parametric(ParametricShape),
}

impl Default for BodyShape {
    fn default() -> Self {
        Self::Plain(Shape::default())
    }
}

impl BodyShape {
    /// Which shape it is.
    pub const fn kind(&self) -> ShapeKind {
        match self {
            Self::Plain(shape) => shape.kind(),
            Self::Parametric(shape) => shape.kind(),
        }
    }

    /// The shape's name in scene files.
    pub const fn key(&self) -> &'static str {
        self.kind().key()
    }

    /// The number that scene files call `key`, if the shape has it.
    pub fn number(&self, key: &str) -> Option<f64> {
        match self {
            Self::Plain(shape) => shape.number(key),
            Self::Parametric(shape) => shape.number(key),
        }
    }

    /// Sets the number that scene files call `key`. Does nothing if the shape has none.
    pub fn set_number(&mut self, key: &str, value: f64) {
        match self {
            Self::Plain(shape) => shape.set_number(key, value),
            Self::Parametric(shape) => shape.set_number(key, value),
        }
    }

    /// The three numbers that scene files call `key`, if the shape has them.
    pub fn vector(&self, key: &str) -> Option<DVec3> {
        match self {
            Self::Plain(shape) => shape.vector(key),
            Self::Parametric(shape) => shape.vector(key),
        }
    }

    /// The number of `key`, also where another one says it: the focal length of a lens with given faces is that of the
    /// index 1.5.
    pub fn shown_number(&self, key: &str) -> Option<f64> {
        let derived = || match self {
            Self::Plain(_) => None,
            Self::Parametric(shape) => shape.as_parametric().derived_number(key),
        };
        self.number(key).or_else(derived)
    }

    /// Sets the three numbers that scene files call `key`. Does nothing if the shape has none.
    pub fn set_vector(&mut self, key: &str, value: DVec3) {
        match self {
            Self::Plain(shape) => shape.set_vector(key, value),
            Self::Parametric(shape) => shape.set_vector(key, value),
        }
    }

    /// The word that scene files call `key`, if the shape has it.
    pub fn word(&self, key: &str) -> Option<&'static str> {
        match self {
            Self::Plain(shape) => shape.word(key),
            Self::Parametric(shape) => shape.word(key),
        }
    }

    /// Sets the word that scene files call `key`. Does nothing if the shape has none, or if it has no such value.
    pub fn set_word(&mut self, key: &str, word: &str) {
        match self {
            Self::Plain(shape) => shape.set_word(key, word),
            Self::Parametric(shape) => shape.set_word(key, word),
        }
    }

    /// The shape with all its sizes multiplied.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Plain(shape) => Self::Plain(shape.scaled(factor)),
            Self::Parametric(mut shape) => {
                // Read first: one size may take the place of another.
                let sizes = SIZES.map(|key| (key, shape.number(key)));
                for (key, size) in sizes {
                    if let Some(size) = size {
                        shape.set_number(key, size * factor);
                    }
                }
                for key in VECTORS {
                    if let Some(vector) = shape.vector(key) {
                        shape.set_vector(key, vector * factor);
                    }
                }
                Self::Parametric(shape)
            }
        }
    }

    /// The shape of this radius and height, meters, as far as it has them. Parametric shapes with other sizes are scaled.
    pub fn of_size(kind: ShapeKind, radius: f64, height: f64) -> Self {
        let shape = kind.body_shape();
        let Self::Parametric(mut sized) = shape else { return Self::Plain(kind.of_size(radius, height)) };
        match (&mut sized, shape.number("radius")) {
            (ParametricShape::Wedge(wedge), _) => {
                wedge.size = DVec3::new(2.0 * radius, height, 2.0 * radius);
                Self::Parametric(sized)
            }
            (ParametricShape::Rectangle(rectangle), _) => {
                (rectangle.width, rectangle.length) = (2.0 * radius, 2.0 * radius);
                Self::Parametric(sized)
            }
            (ParametricShape::Triangle(_), _) => shape.scaled(2.0 * radius),
            (
                ParametricShape::Tube(_)
                | ParametricShape::Prism(_)
                | ParametricShape::OpenCylinder(_)
                | ParametricShape::OpenCone(_),
                Some(own),
            ) => {
                let mut shape = shape.scaled(radius / own);
                shape.set_number("height", height);
                shape
            }
            (_, own) => shape.scaled(own.map_or(1.0, |own| radius / own)),
        }
    }

    /// The height above the frame's origin of a shape that base and top points can place.
    pub(crate) fn axis_height(&self) -> Option<f64> {
        match self {
            Self::Plain(shape) => shape.height(),
            Self::Parametric(_) => None,
        }
    }

    /// What a body of this shape has as its shape, its parts and what these are an expansion of; `parts` are those of a
    /// shape that is given its parts.
    pub(crate) fn into_form(
        self,
        parts: Vec<BodyPart>,
    ) -> (Shape, Vec<BodyPart>, Option<Box<ParametricShape>>) {
        match self {
            Self::Plain(shape) => (shape, if shape.is_compound() { parts } else { Vec::new() }, None),
            Self::Parametric(parametric) => {
                let Expansion { shape, parts } = parametric.expansion();
                (shape, parts, Some(Box::new(parametric)))
            }
        }
    }
}

impl ShapeKind {
    /// The shape in its default size, as files and inspectors say it.
    pub fn body_shape(self) -> BodyShape {
        match ParametricShape::of_kind(self) {
            Some(shape) => BodyShape::Parametric(shape),
            None => BodyShape::Plain(self.shape()),
        }
    }
}

impl Form<'_> {
    /// The shape as files and inspectors say it. What was an expansion and has been changed since is plain.
    pub fn body_shape(&self) -> BodyShape {
        match self.parametric() {
            Some(shape) => BodyShape::Parametric(*shape),
            None => BodyShape::Plain(self.shape),
        }
    }

    /// What its parts are an expansion of.
    pub fn parametric(&self) -> Option<&ParametricShape> {
        let shape = self.expanded?;
        let is_same = || {
            let Expansion { shape, parts } = shape.expansion();
            shape == self.shape && parts == self.parts
        };
        (!shape.is_finite() || is_same()).then_some(shape)
    }
}

#[cfg(test)]
mod tests;
