//! Mistakes by what they have to do with, for whoever counts them.

use super::codes::CodeCurve;
use super::faults::{ExponentFactor, Fault, FaultTopic};
use super::mistake::Mistake;
use super::observed::Orientation;
use super::places::{Offset, Window};
use super::ray_fault::{LeavingRule, NormalLength, RayFault, ShadowBias};
use super::scene_mistake::{BodyKind, SceneMistake};
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
            Self::Scene(mistake) => mistake.group(),
            Self::Ray(fault) => fault.group(),
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
            .chain([Self::Window(Window::Fitted { scale: [1000; 2], shift: [0; 2] })])
            .chain(SceneMistake::all().into_iter().chain(SceneMistake::first_numbers()).map(Self::Scene))
            .chain(RayFault::all().map(Self::Ray))
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

impl SceneMistake {
    fn group(self) -> MistakeGroup {
        match self {
            Self::StraightRefraction | Self::InvertedRefraction => MistakeGroup::Rays,
            Self::Shadowless(_) => MistakeGroup::Light,
            Self::TargetAsDirection | Self::CameraMoved(..) => MistakeGroup::View,
            _ => MistakeGroup::Bodies,
        }
    }
}

impl RayFault {
    /// All faults, of those with a number one each.
    fn all() -> impl Iterator<Item = Self> {
        let leaving = [LeavingRule::Ratio, LeavingRule::Normal, LeavingRule::Straight].map(Self::Leaving);
        let with_numbers = [
            Self::LongNormals([NormalLength::Gradient; 4]),
            Self::Bias(ShadowBias::Least(10)),
            Self::WithoutCaps(BodyKind::Cylinders),
        ];
        Self::PLAIN.iter().copied().chain(with_numbers).chain(leaving)
    }

    fn group(self) -> MistakeGroup {
        match self {
            Self::HighlightOnDarkSide => MistakeGroup::Highlights,
            Self::ShadowsFromBeyond
            | Self::ShadowsWithinOne
            | Self::ShadowsFromBehind
            | Self::CosineMagnitude
            | Self::CosineNegative
            | Self::LampsAsDirections
            | Self::LampsReversed
            | Self::Bias(_) => MistakeGroup::Light,
            Self::ReflectionBackwards
            | Self::ReflectionHalf
            | Self::ReflectionAdded
            | Self::Leaving(_)
            | Self::LastHit
            | Self::FirstHit
            | Self::LastDistance
            | Self::HitsBehindEye
            | Self::HitsBehind => MistakeGroup::Rays,
            Self::UpNotOrthogonal
            | Self::RightNotUnit
            | Self::RightAloneNotUnit
            | Self::EvenAngles
            | Self::NoTilt => MistakeGroup::View,
            _ => MistakeGroup::Bodies,
        }
    }
}

impl Fault {
    /// All faults, of those with a number one each.
    fn all() -> impl Iterator<Item = Self> {
        let with_numbers = [Self::Exponent(ExponentFactor::Half), Self::Generations(1)];
        Self::PLAIN.iter().copied().chain(with_numbers)
    }

    fn group(self) -> MistakeGroup {
        match self.topic() {
            _ if matches!(self, Self::OpaqueShadows | Self::ClearShadows | Self::OpaqueBodies) => {
                MistakeGroup::ClearBodies
            }
            FaultTopic::Weights | FaultTopic::Tint => MistakeGroup::ClearBodies,
            FaultTopic::Highlight
            | FaultTopic::HighlightLength
            | FaultTopic::HighlightColor
            | FaultTopic::Exponent => MistakeGroup::Highlights,
            FaultTopic::Reflection
            | FaultTopic::ReflectionInside
            | FaultTopic::Refraction
            | FaultTopic::Depth
            | FaultTopic::Surroundings => MistakeGroup::Rays,
            FaultTopic::Clamping => MistakeGroup::Clamping,
            FaultTopic::Normal => MistakeGroup::Bodies,
            FaultTopic::Colors => MistakeGroup::Codes,
            FaultTopic::Shadow
            | FaultTopic::ShadowReach
            | FaultTopic::Ambient
            | FaultTopic::Diffuse
            | FaultTopic::Falloff
            | FaultTopic::Lamps
            | FaultTopic::LampColor => MistakeGroup::Light,
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
