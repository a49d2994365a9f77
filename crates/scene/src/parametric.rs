//! Parametric shapes: lenses, tubes and others that a few numbers make of parts.
//!
//! A parametric shape is a body of parts to everything that traces, measures or draws it: [`Body::shape`] and
//! [`Body::parts`] are its expansion, and [`Body::parametric`] remembers what they are an expansion of. What a parametric
//! shape is stands in a file of its own below `parametric/`: its sizes by their keys, the rules between them, its extent
//! and its parts.

mod bowl;
mod lens;
mod mirror_dish;
mod prism;
mod ring;
mod tube;
mod wedge;

use glam::DVec3;

use crate::body::Body;
use crate::compound::{BodyPart, Form};
use crate::format::message::{Number, SizeFault};
use crate::format::rules::BrokenRule;
use crate::format::spec::Limits;
pub use crate::parametric::bowl::Bowl;
pub use crate::parametric::lens::{Lens, LensCurvature};
pub use crate::parametric::mirror_dish::{DishDepth, DishProfile, MirrorDish};
pub use crate::parametric::prism::Prism;
pub use crate::parametric::ring::Ring;
pub use crate::parametric::tube::Tube;
pub use crate::parametric::wedge::Wedge;
use crate::placement::Placement;
use crate::shape::{Shape, ShapeKind};

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
}

/// What a parametric shape is asked for, in its own frame.
trait Parametric {
    /// The number that scene files call `key`, if the shape has it.
    fn number(&self, key: &str) -> Option<f64>;

    /// What the number of `key` would be, where another one says it.
    fn derived_number(&self, key: &str) -> Option<f64>;

    /// Sets the number that scene files call `key`. Does nothing if the shape has none.
    fn set_number(&mut self, key: &str, value: f64);

    /// The first rule between its sizes that it breaks. Each size is within the limits of its key.
    fn broken_rule(&self) -> Option<BrokenRule>;

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

    /// The expansion as one part of another.
    fn into_part(self) -> BodyPart {
        BodyPart { shape: self.shape, parts: self.parts, ..BodyPart::default() }
    }
}

/// A simple part, moved along Y.
fn part(shape: Shape, y: f64) -> BodyPart {
    BodyPart { shape, placement: Placement::at(DVec3::Y * y), ..BodyPart::default() }
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

/// A length in a message, of six digits.
fn shown(length: f64) -> Number {
    Number::from(format!("{length:.5e}").parse().unwrap_or(length))
}

/// The size `key` must be smaller than the size `other`.
fn smaller(key: &'static str, value: f64, other: &'static str, limit: f64) -> Option<BrokenRule> {
    (value >= limit).then(|| BrokenRule::of_size(key, SizeFault::NotSmaller { key, other }))
}

/// The focal length of a mirror is a length: only a lens has one below 0.
fn positive(key: &'static str, value: f64) -> Option<BrokenRule> {
    (!Limits::LENGTH.contains(value)).then(|| BrokenRule::out_of_range(key, value, Limits::LENGTH))
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
            _ => return None,
        })
    }

    /// The number that scene files call `key`, if the shape has it.
    pub fn number(&self, key: &str) -> Option<f64> {
        self.as_parametric().number(key)
    }

    /// Sets the number that scene files call `key`. Does nothing if the shape has none.
    pub fn set_number(&mut self, key: &str, value: f64) {
        self.as_parametric_mut().set_number(key, value);
    }

    /// The three numbers that scene files call `key`: the `size` of a wedge.
    pub fn vector(&self, key: &str) -> Option<DVec3> {
        match self {
            Self::Wedge(wedge) if key == "size" => Some(wedge.size),
            _ => None,
        }
    }

    /// Sets the three numbers that scene files call `key`. Does nothing if the shape has none.
    pub fn set_vector(&mut self, key: &str, value: DVec3) {
        match self {
            Self::Wedge(wedge) if key == "size" => wedge.size = value,
            _ => {}
        }
    }

    /// The word that scene files call `key`: the `profile` of a mirror dish.
    pub fn word(&self, key: &str) -> Option<&'static str> {
        match self {
            Self::MirrorDish(dish) if key == "profile" => Some(dish.profile.key()),
            _ => None,
        }
    }

    /// Sets the word that scene files call `key`. Does nothing if the shape has none, or if it has no such value.
    pub fn set_word(&mut self, key: &str, word: &str) {
        match self {
            Self::MirrorDish(dish) if key == "profile" => {
                dish.profile = DishProfile::of_key(word).unwrap_or(dish.profile);
            }
            _ => {}
        }
    }

    /// The first rule between its sizes that it breaks.
    pub(crate) fn broken_rule(&self) -> Option<BrokenRule> {
        self.as_parametric().broken_rule()
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
        numbers.chain(self.vector("size").into_iter().flat_map(|size| size.to_array())).all(f64::is_finite)
    }
}

/// The sizes that are lengths, by their keys.
const SIZES: [&str; 8] = [
    "radius",
    "inner_radius",
    "thickness",
    "height",
    "focal_length",
    "curvature_radius",
    "front_radius",
    "back_radius",
];

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
            Self::Plain(_) => None,
            Self::Parametric(shape) => shape.word(key),
        }
    }

    /// Sets the word that scene files call `key`. Does nothing if the shape has none, or if it has no such value.
    pub fn set_word(&mut self, key: &str, word: &str) {
        if let Self::Parametric(shape) = self {
            shape.set_word(key, word);
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
                if let Some(size) = shape.vector("size") {
                    shape.set_vector("size", size * factor);
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
            (ParametricShape::Tube(_) | ParametricShape::Prism(_), Some(own)) => {
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

impl Body {
    /// A body of this shape at the origin; one that consists of parts has none yet.
    pub fn of_shape(shape: BodyShape) -> Self {
        let mut body = Self::default();
        body.set_shape(shape);
        body
    }

    /// The shape as files and inspectors say it.
    pub fn body_shape(&self) -> BodyShape {
        self.form().body_shape()
    }

    /// Gives the body another shape. One that is given its parts keeps those that the body has.
    pub fn set_shape(&mut self, shape: BodyShape) {
        (self.shape, self.parts, self.parametric) = shape.into_form(std::mem::take(&mut self.parts));
    }

    /// Changes the sizes of its shape.
    pub fn change_shape(&mut self, change: impl FnOnce(&mut BodyShape)) {
        let mut shape = self.body_shape();
        change(&mut shape);
        self.set_shape(shape);
    }
}

#[cfg(test)]
mod tests;
