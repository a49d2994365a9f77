//! What several tables of the format have in common.

use crate::color::Color;
use crate::format::spec::{Default, KeySpec, Kind, Limits};

pub(super) const LAYER: &str = "the layer of the picture, where its file has several";
pub(super) const ROTATION: KeySpec = KeySpec::new(
    "rotation",
    Kind::Vector(Limits::new(-1e6, 1e6)),
    "the turns about the fixed X, then Y, then Z axis, degrees",
)
.or(Default::Vector([0.0; 3]));
pub(super) const SCALE: KeySpec = KeySpec::new(
    "scale",
    Kind::NumberOrVector(Limits::LENGTH),
    "the factor, or the three factors, of the size",
)
.or(Default::Number(1.0));

/// A color as a default.
pub(super) const fn color(color: Color) -> Default {
    Default::Vector(color.to_array())
}

/// `false` by default.
pub(super) const fn flag(name: &'static str, doc: &'static str) -> KeySpec {
    KeySpec::new(name, Kind::Flag, doc).or(Default::Flag(false))
}

/// A coefficient: 0 or more.
pub(super) const fn amount(name: &'static str, doc: &'static str) -> KeySpec {
    KeySpec::new(name, Kind::Number(Limits::AMOUNT), doc)
}
