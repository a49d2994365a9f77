//! The messages that name shapes.

use catoptric_scene::ShapeKind;

/// The message that names a body of a shape.
pub(crate) const fn shape_name(shape: ShapeKind) -> &'static str {
    match shape {
        ShapeKind::Sphere => "name-sphere",
        ShapeKind::Cube => "name-cube",
        ShapeKind::Cylinder => "name-cylinder",
        ShapeKind::Cone => "name-cone",
        ShapeKind::Paraboloid => "name-paraboloid",
        ShapeKind::Plane => "name-plane",
        ShapeKind::Lens => "name-lens",
        ShapeKind::MirrorDish => "name-mirror-dish",
        ShapeKind::Tube => "name-tube",
        ShapeKind::Ring => "name-ring",
        ShapeKind::Bowl => "name-bowl",
        ShapeKind::Prism => "name-prism",
        ShapeKind::Wedge => "name-wedge",
        ShapeKind::OpenCylinder => "name-open-cylinder",
        ShapeKind::OpenCone => "name-open-cone",
        ShapeKind::Disc => "name-disc",
        ShapeKind::Rectangle => "name-rectangle",
        ShapeKind::Triangle => "name-triangle",
        ShapeKind::Union => "name-union",
        ShapeKind::Intersection => "name-intersection",
        ShapeKind::Difference => "name-difference",
        ShapeKind::Surface => "name-surface",
        ShapeKind::Group => "name-group",
    }
}

/// The message that offers a shape, with its explanation.
pub(crate) const fn shape_choice(shape: ShapeKind) -> &'static str {
    match shape {
        ShapeKind::Sphere => "shape-sphere",
        ShapeKind::Cube => "shape-cube",
        ShapeKind::Cylinder => "shape-cylinder",
        ShapeKind::Cone => "shape-cone",
        ShapeKind::Paraboloid => "shape-paraboloid",
        ShapeKind::Plane => "shape-plane",
        ShapeKind::Lens => "shape-lens",
        ShapeKind::MirrorDish => "shape-mirror-dish",
        ShapeKind::Tube => "shape-tube",
        ShapeKind::Ring => "shape-ring",
        ShapeKind::Bowl => "shape-bowl",
        ShapeKind::Prism => "shape-prism",
        ShapeKind::Wedge => "shape-wedge",
        ShapeKind::OpenCylinder => "shape-open-cylinder",
        ShapeKind::OpenCone => "shape-open-cone",
        ShapeKind::Disc => "shape-disc",
        ShapeKind::Rectangle => "shape-rectangle",
        ShapeKind::Triangle => "shape-triangle",
        ShapeKind::Union => "shape-union",
        ShapeKind::Intersection => "shape-intersection",
        ShapeKind::Difference => "shape-difference",
        ShapeKind::Surface => "shape-surface",
        ShapeKind::Group => "shape-group",
    }
}

/// A group of shapes: menus and the inspector offer them by these.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ShapeGroup {
    /// What has an inside.
    Bodies,
    /// What optical benches hold.
    Optics,
    /// What has no inside.
    Surfaces,
    /// What is joined of parts.
    Joined,
}

impl ShapeGroup {
    /// The groups of what can be added, in the order in which to offer them.
    pub(crate) const ADDED: [Self; 3] = [Self::Bodies, Self::Optics, Self::Surfaces];

    /// The group of a shape.
    pub(crate) const fn of(shape: ShapeKind) -> Self {
        match shape {
            ShapeKind::Sphere
            | ShapeKind::Cube
            | ShapeKind::Cylinder
            | ShapeKind::Cone
            | ShapeKind::Paraboloid
            | ShapeKind::Plane
            | ShapeKind::Tube
            | ShapeKind::Ring
            | ShapeKind::Bowl
            | ShapeKind::Wedge => Self::Bodies,
            ShapeKind::Lens | ShapeKind::MirrorDish | ShapeKind::Prism => Self::Optics,
            ShapeKind::OpenCylinder
            | ShapeKind::OpenCone
            | ShapeKind::Disc
            | ShapeKind::Rectangle
            | ShapeKind::Triangle => Self::Surfaces,
            ShapeKind::Union
            | ShapeKind::Intersection
            | ShapeKind::Difference
            | ShapeKind::Surface
            | ShapeKind::Group => Self::Joined,
        }
    }

    /// The shapes of the group, in the order in which to offer them.
    pub(crate) fn shapes(self) -> impl Iterator<Item = ShapeKind> {
        ShapeKind::ALL.into_iter().filter(move |shape| Self::of(*shape) == self)
    }

    /// The message that names the group.
    pub(crate) const fn key(self) -> &'static str {
        match self {
            Self::Bodies => "shapes-bodies",
            Self::Optics => "shapes-optics",
            Self::Surfaces => "shapes-surfaces",
            Self::Joined => "shapes-joined",
        }
    }
}
