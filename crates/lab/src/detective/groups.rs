//! Mistakes by what they have to do with, for whoever counts them.

use super::codes::CodeCurve;
use super::faults::Fault;
use super::mistake::{Mistake, SceneMistake};
use super::observed::Orientation;
use super::places::{Offset, Window};
use super::verdict;
use crate::report::Language;

/// What mistakes have to do with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum MistakeGroup {
    /// The picture has another size.
    Size,
    /// The order of pixels.
    Order,
    /// The part of the view that is seen.
    View,
    /// The place of the ray in its pixel.
    Pixel,
    /// From light to codes.
    Codes,
    /// Ambient and diffuse light, lamps and shadows.
    Light,
    /// Highlights.
    Highlights,
    /// Reflected and refracted rays.
    Rays,
    /// How much clear bodies reflect and let through.
    ClearBodies,
    /// Light that is clamped early.
    Clamping,
    /// Shapes, normals and patterns of bodies.
    Bodies,
    /// Rounding.
    Rounding,
}

impl MistakeGroup {
    /// All groups.
    pub const ALL: [Self; 12] = [
        Self::Size,
        Self::Order,
        Self::View,
        Self::Pixel,
        Self::Codes,
        Self::Light,
        Self::Highlights,
        Self::Rays,
        Self::ClearBodies,
        Self::Clamping,
        Self::Bodies,
        Self::Rounding,
    ];

    /// The name in files.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Size => "size",
            Self::Order => "order",
            Self::View => "view",
            Self::Pixel => "pixel",
            Self::Codes => "codes",
            Self::Light => "light",
            Self::Highlights => "highlights",
            Self::Rays => "rays",
            Self::ClearBodies => "clear-bodies",
            Self::Clamping => "clamping",
            Self::Bodies => "bodies",
            Self::Rounding => "rounding",
        }
    }
}

impl Mistake {
    /// What it has to do with.
    pub fn group(&self) -> MistakeGroup {
        match self {
            Self::Size { .. } => MistakeGroup::Size,
            Self::Orientation(_) => MistakeGroup::Order,
            Self::Window(_) => MistakeGroup::View,
            Self::Offset(_) => MistakeGroup::Pixel,
            Self::Scene(SceneMistake::StraightRefraction | SceneMistake::InvertedRefraction) => {
                MistakeGroup::Rays
            }
            Self::Scene(_) => MistakeGroup::Bodies,
            Self::Fault(fault) => fault.group(),
            Self::Acne => MistakeGroup::Rounding,
            Self::ClampedFirst => MistakeGroup::Clamping,
            Self::Curve { .. } | Self::Exposure { .. } | Self::Overflow | Self::BlueFirst => {
                MistakeGroup::Codes
            }
        }
    }

    /// The mistake in words, as part of a sentence.
    pub fn words(&self, language: Language) -> String {
        verdict::in_words(self, language)
    }

    /// The keys of all mistakes that are looked for, each once, with their groups.
    pub fn kinds() -> Vec<(&'static str, MistakeGroup)> {
        let size = Self::Size { expected: [1; 2], found: [1; 2] };
        let curve = |found: CodeCurve| Self::Curve { expected: CodeCurve::Linear, found };
        let back = Self::Curve { expected: CodeCurve::Srgb, found: CodeCurve::Linear };
        let codes =
            [back, Self::Exposure { factor: 2.0 }, Self::ClampedFirst, Self::Overflow, Self::BlueFirst];
        let all = [size]
            .into_iter()
            .chain(Orientation::OTHERS.map(Self::Orientation))
            .chain(Window::OTHERS.map(Self::Window))
            .chain(Offset::OTHERS.map(Self::Offset))
            .chain(CodeCurve::ALL.into_iter().filter(|found| *found != CodeCurve::Linear).map(curve))
            .chain(codes)
            .chain(SceneMistake::ALL.map(Self::Scene))
            .chain(Fault::all().map(Self::Fault))
            .chain([Self::Acne]);
        let mut kinds: Vec<(&'static str, MistakeGroup)> = Vec::new();
        for mistake in all {
            if kinds.iter().all(|(key, _)| *key != mistake.key()) {
                kinds.push((mistake.key(), mistake.group()));
            }
        }
        kinds
    }
}

impl Fault {
    /// All faults, of those with a number one each.
    fn all() -> impl Iterator<Item = Self> {
        Self::PLAIN.into_iter().chain([Self::Generations(1), Self::MoreGenerations])
    }

    fn group(self) -> MistakeGroup {
        match self {
            Self::NoHighlight | Self::HighlightInShadow | Self::HalfwayHighlight | Self::ColoredHighlight => {
                MistakeGroup::Highlights
            }
            Self::NoReflection
            | Self::BlendedReflection
            | Self::AddedReflection
            | Self::NoRefraction
            | Self::Generations(_)
            | Self::MoreGenerations => MistakeGroup::Rays,
            Self::OpaqueShadows | Self::ClearShadows | Self::OpaqueBodies | Self::UnweighedBodies => {
                MistakeGroup::ClearBodies
            }
            Self::ClampedLocal | Self::ClampedRays | Self::ClampedLamps => MistakeGroup::Clamping,
            Self::ScaledNormals | Self::UnscaledNormals => MistakeGroup::Bodies,
            _ => MistakeGroup::Light,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_a_key_of_its_own_and_a_group() {
        let kinds = Mistake::kinds();
        let mut keys: Vec<&str> = kinds.iter().map(|(key, _)| *key).collect();
        assert!(keys.len() > 40 && !keys.contains(&"none"), "{keys:?}");
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), kinds.len());
        for group in MistakeGroup::ALL {
            assert!(kinds.iter().any(|(_, own)| *own == group), "{group:?} has no mistake");
        }
        let of = |key: &str| kinds.iter().find(|(own, _)| *own == key).map(|(_, group)| *group);
        assert_eq!(of("no-shadows"), Some(MistakeGroup::Light));
        assert_eq!(of("half-pixel"), Some(MistakeGroup::Pixel));
        assert_eq!(of("refraction-indices-exchanged"), Some(MistakeGroup::Rays));
        assert_eq!(of("tone-curve"), Some(MistakeGroup::Codes));
    }
}
