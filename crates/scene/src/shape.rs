//! Shapes: what a body is in its own frame, before it is placed.
//!
//! What a shape is otherwise asked for (its sizes by their keys, its extent, its outline) is answered here, so that
//! nothing outside has to know which shapes there are. The geometry of each has a file of its own below `shape/`.

mod cuboid;
mod frustum;
mod outline;
mod paraboloid;
mod sphere;
mod visible_side;

use glam::DVec3;

use crate::keyed::keyed;
use crate::shape::cuboid::Cuboid;
use crate::shape::frustum::Frustum;
use crate::shape::paraboloid::Paraboloid;
pub use crate::shape::paraboloid::ParaboloidDepth;
use crate::shape::sphere::Sphere;
pub use crate::shape::visible_side::VisibleSide;

/// The shapes, each in its own frame (meters).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Ball about the origin.
    Sphere {
        /// Default 1.
        radius: f64,
    },
    /// Box about the origin with faces along the axes.
    Cube {
        /// The three edge lengths. Default 1 each.
        size: DVec3,
    },
    /// Cylinder from the origin along +Y, closed by two caps.
    Cylinder {
        /// Default 0.5.
        radius: f64,
        /// Default 1. Ignored when the placement gives base and top points.
        height: f64,
    },
    /// Cone from the origin along +Y: base at y = 0, apex (or the smaller cap of a frustum) at y = `height`.
    Cone {
        /// Radius of the base. Default 0.5.
        radius: f64,
        /// Radius of the upper cap; 0 (the default) makes a pointed cone.
        top_radius: f64,
        /// Default 1. Ignored when the placement gives base and top points.
        height: f64,
    },
    /// Cap of a paraboloid of revolution from its vertex at the origin along +Y, closed by a disc: a mirror that opens
    /// upwards, or a lens.
    Paraboloid {
        /// Radius of the rim. Default 0.5.
        radius: f64,
        /// Default a height of 1. Ignored when the placement gives base and top points.
        depth: ParaboloidDepth,
    },
    /// The infinite plane y = 0 with the normal +Y; the half-space below counts as its inside.
    Plane,
    /// All that lies in any of the body's parts.
    Union,
    /// What lies in all of the body's parts.
    Intersection,
    /// What lies in the first of the body's parts and in none of the others.
    Difference,
    /// The surface of the first of the body's parts, which is a simple one, without its caps, as far as it lies in all of
    /// the others. It has no inside: light that passes it goes straight on.
    Surface {
        /// The sides that rays meet. Default both.
        side: VisibleSide,
    },
    /// Parts that stand together, each a body of its own. A group that is itself a part of a union, an intersection or a
    /// difference is a union.
    Group,
}

/// What a bounded shape is asked for, in its own frame.
trait Solid {
    /// The least and the greatest coordinates.
    fn extent(&self) -> [DVec3; 2];

    /// The largest d·p of its points p for the direction d (its support function, times the length of d).
    fn support(&self, direction: DVec3) -> f64;

    /// A ball that holds the shape when its frame is scaled: the center before the scaling, and the radius after it.
    fn ball(&self, scale: DVec3) -> (DVec3, f64);

    /// The lines that an eye sees it by: its edges, and where the eye looks past its surface.
    fn outline(&self, eye: DVec3) -> Vec<Vec<DVec3>>;
}

impl Shape {
    /// A sphere of radius 1.
    pub const SPHERE: Self = Self::Sphere { radius: 1.0 };
    /// A cube of edge 1.
    pub const CUBE: Self = Self::Cube { size: DVec3::ONE };
    /// A cylinder of radius 0.5 and height 1.
    pub const CYLINDER: Self = Self::Cylinder { radius: 0.5, height: 1.0 };
    /// A pointed cone of radius 0.5 and height 1.
    pub const CONE: Self = Self::Cone { radius: 0.5, top_radius: 0.0, height: 1.0 };
    /// A surface with both sides.
    pub const SURFACE: Self = Self::Surface { side: VisibleSide::Both };
    /// A paraboloid of radius 0.5 and height 1.
    pub const PARABOLOID: Self = Self::Paraboloid { radius: 0.5, depth: ParaboloidDepth::Height(1.0) };

    /// Which shape it is.
    pub const fn kind(&self) -> ShapeKind {
        match self {
            Self::Sphere { .. } => ShapeKind::Sphere,
            Self::Cube { .. } => ShapeKind::Cube,
            Self::Cylinder { .. } => ShapeKind::Cylinder,
            Self::Cone { .. } => ShapeKind::Cone,
            Self::Paraboloid { .. } => ShapeKind::Paraboloid,
            Self::Plane => ShapeKind::Plane,
            Self::Union => ShapeKind::Union,
            Self::Intersection => ShapeKind::Intersection,
            Self::Difference => ShapeKind::Difference,
            Self::Surface { .. } => ShapeKind::Surface,
            Self::Group => ShapeKind::Group,
        }
    }

    /// Whether the body consists of [parts](crate::Body::parts).
    pub const fn is_compound(&self) -> bool {
        self.kind().is_compound()
    }

    /// Whether it is a surface without inside.
    pub const fn is_surface(&self) -> bool {
        matches!(self, Self::Surface { .. })
    }

    /// The shape's name in scene files: `sphere`, `cube` …
    pub const fn key(&self) -> &'static str {
        self.kind().key()
    }

    /// The size that scene files call `key`, if it is a number that the shape has: `radius`, `top_radius`, `height`,
    /// `focal_length`. Of the latter two a paraboloid has the one that it is given by.
    ///
    /// ```
    /// use catoptric_scene::Shape;
    /// assert_eq!(Shape::CONE.number("radius"), Some(0.5));
    /// assert_eq!(Shape::CUBE.number("radius"), None);
    /// ```
    pub fn number(&self, key: &str) -> Option<f64> {
        let mut shape = *self;
        shape.number_mut(key).copied()
    }

    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match (self, key) {
            (
                Self::Sphere { radius }
                | Self::Cylinder { radius, .. }
                | Self::Cone { radius, .. }
                | Self::Paraboloid { radius, .. },
                "radius",
            ) => Some(radius),
            (Self::Cone { top_radius, .. }, "top_radius") => Some(top_radius),
            (
                Self::Cylinder { height, .. }
                | Self::Cone { height, .. }
                | Self::Paraboloid { depth: ParaboloidDepth::Height(height), .. },
                "height",
            ) => Some(height),
            (Self::Paraboloid { depth: ParaboloidDepth::FocalLength(length), .. }, "focal_length") => {
                Some(length)
            }
            _ => None,
        }
    }

    /// Sets the size that scene files call `key`. Does nothing if the shape has none.
    pub fn set_number(&mut self, key: &str, value: f64) {
        match (&mut *self, key) {
            (Self::Paraboloid { depth, .. }, "height") => *depth = ParaboloidDepth::Height(value),
            (Self::Paraboloid { depth, .. }, "focal_length") => *depth = ParaboloidDepth::FocalLength(value),
            _ => {}
        }
        if let Some(number) = self.number_mut(key) {
            *number = value;
        }
    }

    /// The size that scene files call `key`, if it is three numbers that the shape has: `size`.
    pub fn vector(&self, key: &str) -> Option<DVec3> {
        let mut shape = *self;
        shape.vector_mut(key).copied()
    }

    fn vector_mut(&mut self, key: &str) -> Option<&mut DVec3> {
        match (self, key) {
            (Self::Cube { size }, "size") => Some(size),
            _ => None,
        }
    }

    /// Sets the three numbers that scene files call `key`. Does nothing if the shape has none.
    pub fn set_vector(&mut self, key: &str, value: DVec3) {
        if let Some(vector) = self.vector_mut(key) {
            *vector = value;
        }
    }

    /// The word that scene files call `key`: the `visible_side` of a surface.
    pub fn word(&self, key: &str) -> Option<&'static str> {
        match self {
            Self::Surface { side } if key == "visible_side" => Some(side.key()),
            _ => None,
        }
    }

    /// Sets the word that scene files call `key`. Does nothing if the shape has none, or if it has no such value.
    pub fn set_word(&mut self, key: &str, word: &str) {
        if let (Self::Surface { side }, "visible_side") = (self, key) {
            *side = VisibleSide::of_key(word).unwrap_or(*side);
        }
    }

    /// The height above the frame's origin; `None` for a shape that does not stand on an axis, and so cannot be placed
    /// by base and top points.
    pub fn height(&self) -> Option<f64> {
        match *self {
            Self::Paraboloid { radius, depth } => Some(depth.height(radius)),
            _ => self.number("height"),
        }
    }

    /// The distance of the focus from the vertex, meters; `None` for what is no paraboloid.
    pub const fn focal_length(&self) -> Option<f64> {
        match *self {
            Self::Paraboloid { radius, depth } => Some(depth.focal_length(radius)),
            _ => None,
        }
    }

    /// Sets the height. Does nothing if the shape has none.
    pub fn set_height(&mut self, height: f64) {
        self.set_number("height", height);
    }

    /// The shape with all its sizes multiplied.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        for key in ["radius", "top_radius", "height", "focal_length"] {
            if let Some(number) = self.number_mut(key) {
                *number *= factor;
            }
        }
        if let Some(size) = self.vector_mut("size") {
            *size *= factor;
        }
        self
    }

    /// The answer of the shape's geometry; `None` for a plane, which has no end, and for compound shapes, which
    /// [`Form`](crate::Form) knows.
    fn ask<T>(&self, question: impl FnOnce(&dyn Solid) -> T) -> Option<T> {
        Some(match *self {
            Self::Sphere { radius } => question(&Sphere { radius }),
            Self::Cube { size } => question(&Cuboid { half: 0.5 * size }),
            Self::Cylinder { radius, height } => question(&Frustum { bottom: radius, top: radius, height }),
            Self::Cone { radius, top_radius, height } => {
                question(&Frustum { bottom: radius, top: top_radius, height })
            }
            Self::Paraboloid { radius, depth } => {
                question(&Paraboloid { radius, height: depth.height(radius) })
            }
            Self::Plane
            | Self::Union
            | Self::Intersection
            | Self::Difference
            | Self::Surface { .. }
            | Self::Group => return None,
        })
    }

    /// The least and the greatest coordinates in the shape's own frame; `None` for a plane.
    pub fn extent(&self) -> Option<[DVec3; 2]> {
        self.ask(|solid| solid.extent())
    }

    /// The middle of its extent in its own frame; the origin for a plane.
    pub fn middle(&self) -> DVec3 {
        self.extent().map_or(DVec3::ZERO, |[min, max]| 0.5 * (min + max))
    }

    /// How far the shape reaches along a direction d of its own frame: the largest d·p of its points p. `None` for a
    /// plane.
    pub fn support(&self, direction: DVec3) -> Option<f64> {
        self.ask(|solid| solid.support(direction))
    }

    /// A ball that holds the shape when its frame is scaled by factors above 0: the center before the scaling, and the
    /// radius after it. The smallest one where x and z are scaled alike; `None` for a plane.
    pub fn ball(&self, scale: DVec3) -> Option<(DVec3, f64)> {
        self.ask(|solid| solid.ball(scale))
    }

    /// The lines that an eye in the shape's own frame sees it by: its edges, and where the eye looks past its surface.
    /// None for a plane, which has no outline.
    pub fn outline(&self, eye: DVec3) -> Vec<Vec<DVec3>> {
        self.ask(|solid| solid.outline(eye)).unwrap_or_default()
    }
}

/// One of the shapes, without sizes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ShapeKind {
    /// [`Shape::Sphere`].
    #[default]
    Sphere,
    /// [`Shape::Cube`].
    Cube,
    /// [`Shape::Cylinder`].
    Cylinder,
    /// [`Shape::Cone`].
    Cone,
    /// [`Shape::Paraboloid`].
    Paraboloid,
    /// [`Shape::Plane`].
    Plane,
    /// [`ParametricShape::Lens`](crate::ParametricShape::Lens).
    Lens,
    /// [`ParametricShape::MirrorDish`](crate::ParametricShape::MirrorDish).
    MirrorDish,
    /// [`ParametricShape::Tube`](crate::ParametricShape::Tube).
    Tube,
    /// [`ParametricShape::Ring`](crate::ParametricShape::Ring).
    Ring,
    /// [`ParametricShape::Bowl`](crate::ParametricShape::Bowl).
    Bowl,
    /// [`ParametricShape::Prism`](crate::ParametricShape::Prism).
    Prism,
    /// [`ParametricShape::Wedge`](crate::ParametricShape::Wedge).
    Wedge,
    /// [`ParametricShape::OpenCylinder`](crate::ParametricShape::OpenCylinder).
    OpenCylinder,
    /// [`ParametricShape::OpenCone`](crate::ParametricShape::OpenCone).
    OpenCone,
    /// [`ParametricShape::Disc`](crate::ParametricShape::Disc).
    Disc,
    /// [`ParametricShape::Rectangle`](crate::ParametricShape::Rectangle).
    Rectangle,
    /// [`ParametricShape::Triangle`](crate::ParametricShape::Triangle).
    Triangle,
    /// [`Shape::Union`].
    Union,
    /// [`Shape::Intersection`].
    Intersection,
    /// [`Shape::Difference`].
    Difference,
    /// [`Shape::Surface`].
    Surface,
    /// [`Shape::Group`].
    Group,
}

// Those of one piece, those that numbers make of parts, then those that are given their parts.
keyed!(ShapeKind {
    Sphere = "sphere",
    Cube = "cube",
    Cylinder = "cylinder",
    Cone = "cone",
    Paraboloid = "paraboloid",
    Plane = "plane",
    Lens = "lens",
    MirrorDish = "mirror-dish",
    Tube = "tube",
    Ring = "ring",
    Bowl = "bowl",
    Prism = "prism",
    Wedge = "wedge",
    OpenCylinder = "open-cylinder",
    OpenCone = "open-cone",
    Disc = "disc",
    Rectangle = "rectangle",
    Triangle = "triangle",
    Union = "union",
    Intersection = "intersection",
    Difference = "difference",
    Surface = "surface",
    Group = "group",
});

impl ShapeKind {
    /// The shapes of one piece, in the order in which to offer them.
    pub const SIMPLE: [Self; 6] =
        [Self::Sphere, Self::Cube, Self::Cylinder, Self::Cone, Self::Paraboloid, Self::Plane];

    /// The shapes that numbers make of parts, in the order in which to offer them.
    pub const PARAMETRIC: [Self; 12] = [
        Self::Lens,
        Self::MirrorDish,
        Self::Tube,
        Self::Ring,
        Self::Bowl,
        Self::Prism,
        Self::Wedge,
        Self::OpenCylinder,
        Self::OpenCone,
        Self::Disc,
        Self::Rectangle,
        Self::Triangle,
    ];

    /// Whether a body of this shape is given [parts](crate::Body::parts).
    pub const fn is_compound(self) -> bool {
        matches!(self, Self::Union | Self::Intersection | Self::Difference | Self::Surface | Self::Group)
    }

    /// The shape in its default size; of what numbers make of parts, how these are joined.
    pub const fn shape(self) -> Shape {
        match self {
            Self::Sphere => Shape::SPHERE,
            Self::Cube => Shape::CUBE,
            Self::Cylinder => Shape::CYLINDER,
            Self::Cone => Shape::CONE,
            Self::Paraboloid => Shape::PARABOLOID,
            Self::Plane => Shape::Plane,
            Self::Union => Shape::Union,
            Self::Intersection | Self::Lens | Self::Prism | Self::Wedge => Shape::Intersection,
            Self::Difference | Self::MirrorDish | Self::Tube | Self::Ring | Self::Bowl => Shape::Difference,
            Self::Surface
            | Self::OpenCylinder
            | Self::OpenCone
            | Self::Disc
            | Self::Rectangle
            | Self::Triangle => Shape::SURFACE,
            Self::Group => Shape::Group,
        }
    }

    /// The shape of this radius and height, meters, as far as it has them.
    pub fn of_size(self, radius: f64, height: f64) -> Shape {
        let mut shape = self.shape();
        shape.set_number("radius", radius);
        shape.set_height(height);
        shape.set_vector("size", DVec3::new(2.0 * radius, height, 2.0 * radius));
        shape
    }
}

impl Default for Shape {
    fn default() -> Self {
        Self::SPHERE
    }
}

#[cfg(test)]
mod tests;
