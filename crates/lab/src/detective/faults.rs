//! What a ray tracer may do wrong with the light of a ray, without another ray.

use catoptric_scene::{Falloff, Scene};

use super::facts::SceneFacts;

/// A fault in the sum of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Fault {
    /// Bodies throw no shadows.
    NoShadows,
    /// Clear bodies throw shadows like opaque ones.
    OpaqueShadows,
    /// Clear bodies throw no shadows at all.
    ClearShadows,
    /// There is no highlight.
    NoHighlight,
    /// Highlights are seen in shadows, too.
    HighlightInShadow,
    /// The highlight is that of the halfway vector (Blinn 1977).
    HalfwayHighlight,
    /// The highlight has the color of the body.
    ColoredHighlight,
    /// Nothing is reflected.
    NoReflection,
    /// A body's own light is weakened by what it reflects.
    BlendedReflection,
    /// A body's own light is not weakened by what it reflects, though it should be.
    AddedReflection,
    /// Nothing is seen through clear bodies.
    NoRefraction,
    /// Clear bodies are opaque, in their shadows, too.
    OpaqueBodies,
    /// Reflection and refraction are not weighed by the angle, though they should be.
    UnweighedBodies,
    /// Rays are followed for so many generations only.
    Generations(u8),
    /// Rays are followed for more generations.
    MoreGenerations,
    /// There is no ambient light.
    NoAmbient,
    /// Ambient light has not the color of the body.
    UncoloredAmbient,
    /// There is no diffuse light.
    NoDiffuse,
    /// The local light of a point is clamped to 1 before reflections are added.
    ClampedLocal,
    /// The light of each ray is clamped to 1.
    ClampedRays,
    /// The light of each lamp is clamped to 1.
    ClampedLamps,
    /// Normals of scaled bodies are turned by the matrix of the body instead of its inverse transpose.
    ScaledNormals,
    /// Normals of scaled bodies are those of the unscaled body.
    UnscaledNormals,
    /// Light does not fall off.
    NoFalloff,
    /// Light falls off with 1/d.
    LinearFalloff,
    /// Light falls off with 1/d².
    SquareFalloff,
    /// Only the first light shines.
    FirstLightOnly,
    /// Lights are white.
    WhiteLights,
    /// The intensity of lights is left out.
    FullLights,
}

impl Fault {
    /// The most generations of [`Self::Generations`].
    const MOST_GENERATIONS: u8 = 8;

    pub(super) const PLAIN: [Self; 27] = [
        Self::NoShadows,
        Self::NoHighlight,
        Self::NoReflection,
        Self::NoRefraction,
        Self::NoAmbient,
        Self::NoDiffuse,
        Self::OpaqueShadows,
        Self::ClearShadows,
        Self::OpaqueBodies,
        Self::UnweighedBodies,
        Self::ClampedRays,
        Self::ClampedLocal,
        Self::ClampedLamps,
        Self::ScaledNormals,
        Self::UnscaledNormals,
        Self::HighlightInShadow,
        Self::HalfwayHighlight,
        Self::ColoredHighlight,
        Self::BlendedReflection,
        Self::AddedReflection,
        Self::UncoloredAmbient,
        Self::NoFalloff,
        Self::LinearFalloff,
        Self::SquareFalloff,
        Self::FirstLightOnly,
        Self::WhiteLights,
        Self::FullLights,
    ];

    /// All that a scene can show, the likelier first.
    pub(super) fn possible(scene: &Scene, facts: &SceneFacts) -> Vec<Self> {
        let plain = Self::PLAIN.into_iter().filter(|fault| fault.is_possible(scene, facts));
        let mut all: Vec<Self> = plain.collect();
        if facts.reflects || facts.transmits {
            let other = |generations: &u8| u32::from(*generations) != scene.tracing.generations;
            all.extend((1..=Self::MOST_GENERATIONS).filter(other).map(Self::Generations));
            all.push(Self::MoreGenerations);
        }
        all
    }

    fn is_possible(self, scene: &Scene, facts: &SceneFacts) -> bool {
        let has_falloff = |fault: Self| {
            let is_same = |falloff: Falloff| match fault {
                Self::NoFalloff => falloff == Falloff::None,
                Self::LinearFalloff => falloff == Falloff::Linear { constant: 0.0 },
                _ => falloff == Falloff::InverseSquare,
            };
            !scene.lights.iter().all(|light| is_same(light.falloff))
        };
        match self {
            Self::NoShadows => facts.is_lit,
            Self::NoHighlight | Self::HighlightInShadow | Self::HalfwayHighlight | Self::ColoredHighlight => {
                facts.has_highlights
            }
            Self::OpaqueShadows | Self::ClearShadows | Self::NoRefraction | Self::OpaqueBodies => {
                facts.transmits
            }
            Self::UnweighedBodies => facts.is_weighed,
            Self::NoReflection | Self::BlendedReflection | Self::AddedReflection => facts.reflects,
            Self::ScaledNormals | Self::UnscaledNormals => facts.is_scaled,
            Self::FirstLightOnly | Self::ClampedLamps => scene.lights.len() > 1,
            Self::NoFalloff | Self::LinearFalloff | Self::SquareFalloff => facts.is_lit && has_falloff(self),
            Self::WhiteLights => scene.lights.iter().any(|light| {
                let [red, green, blue] = light.color.to_array();
                red != green || green != blue
            }),
            Self::FullLights => scene.lights.iter().any(|light| light.intensity != 1.0),
            _ => true,
        }
    }

    /// Faults of one topic exclude each other.
    fn topic(self) -> u8 {
        match self {
            Self::NoShadows | Self::OpaqueShadows | Self::ClearShadows => 0,
            Self::NoHighlight | Self::HighlightInShadow | Self::HalfwayHighlight | Self::ColoredHighlight => {
                1
            }
            Self::NoReflection | Self::BlendedReflection | Self::AddedReflection => 2,
            Self::NoRefraction | Self::OpaqueBodies => 3,
            Self::Generations(_) | Self::MoreGenerations => 4,
            Self::NoAmbient | Self::UncoloredAmbient => 5,
            Self::NoDiffuse => 6,
            Self::ClampedLocal | Self::ClampedRays | Self::ClampedLamps => 7,
            Self::ScaledNormals | Self::UnscaledNormals => 8,
            Self::NoFalloff | Self::LinearFalloff | Self::SquareFalloff => 9,
            Self::UnweighedBodies => 12,
            Self::FirstLightOnly => 10,
            Self::WhiteLights | Self::FullLights => 11,
        }
    }

    /// The name in JSON.
    pub fn key(self) -> &'static str {
        match self {
            Self::NoShadows => "no-shadows",
            Self::OpaqueShadows => "opaque-shadows-of-clear-bodies",
            Self::ClearShadows => "no-shadows-of-clear-bodies",
            Self::NoHighlight => "no-specular",
            Self::HighlightInShadow => "specular-in-shadow",
            Self::HalfwayHighlight => "specular-by-halfway-vector",
            Self::ColoredHighlight => "specular-in-color-of-body",
            Self::NoReflection => "no-reflection",
            Self::BlendedReflection => "reflection-blended",
            Self::AddedReflection => "reflection-added",
            Self::NoRefraction => "no-refraction",
            Self::OpaqueBodies => "clear-bodies-opaque",
            Self::UnweighedBodies => "clear-bodies-not-weighed",
            Self::Generations(_) => "depth-too-small",
            Self::MoreGenerations => "depth-too-large",
            Self::NoAmbient => "no-ambient",
            Self::UncoloredAmbient => "ambient-without-color-of-body",
            Self::NoDiffuse => "no-diffuse",
            Self::ClampedLocal | Self::ClampedRays | Self::ClampedLamps => "clamped-early",
            Self::ScaledNormals | Self::UnscaledNormals => "normals-of-scaled-bodies",
            Self::NoFalloff | Self::LinearFalloff | Self::SquareFalloff => "falloff",
            Self::FirstLightOnly => "first-light-only",
            Self::WhiteLights => "light-color-left-out",
            Self::FullLights => "light-intensity-left-out",
        }
    }
}

/// A set of faults of different topics, in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct FaultSet(Vec<Fault>);

impl FaultSet {
    pub(super) fn iter(&self) -> impl Iterator<Item = Fault> {
        self.0.iter().copied()
    }

    pub(super) fn has(&self, fault: Fault) -> bool {
        self.0.contains(&fault)
    }

    /// The set with one more; `None` if it has one of that topic.
    pub(super) fn with(&self, fault: Fault) -> Option<Self> {
        if self.0.iter().any(|own| own.topic() == fault.topic()) {
            return None;
        }
        let mut all = self.0.clone();
        all.push(fault);
        all.sort_unstable();
        Some(Self(all))
    }

    pub(super) fn without(&self, fault: Fault) -> Self {
        Self(self.0.iter().copied().filter(|own| *own != fault).collect())
    }

    /// The limit of generations, the scene having this one.
    pub(super) fn generations(&self, own: u32) -> u32 {
        let limit = |fault: Fault| match fault {
            Fault::Generations(generations) => Some(u32::from(generations)),
            Fault::MoreGenerations => Some(u32::MAX),
            _ => None,
        };
        self.iter().find_map(limit).unwrap_or(own)
    }
}
