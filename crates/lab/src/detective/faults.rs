//! What a ray tracer may do wrong with the light of a ray, without another ray.

use catoptric_scene::{Falloff, Scene};

use super::facts::SceneFacts;
use super::verdict::Words;

/// A factor of the exponents of highlights: a power of 2 and a power of 10.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ExponentFactor {
    /// 2
    Two,
    /// ½
    Half,
    /// 4
    Four,
    /// ¼
    Quarter,
    /// 3
    Three,
    /// ⅓
    Third,
    /// 10
    Ten,
    /// ⅒
    Tenth,
}

impl ExponentFactor {
    const ALL: [Self; 8] =
        [Self::Two, Self::Half, Self::Four, Self::Quarter, Self::Three, Self::Third, Self::Ten, Self::Tenth];

    /// Its value.
    pub fn value(self) -> f32 {
        match self {
            Self::Two => 2.0,
            Self::Half => 0.5,
            Self::Four => 4.0,
            Self::Quarter => 0.25,
            Self::Three => 3.0,
            Self::Third => 1.0 / 3.0,
            Self::Ten => 10.0,
            Self::Tenth => 0.1,
        }
    }
}

/// The part of the sum of light that a fault is in; of each, there is one at most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FaultTopic {
    Shadow,
    ShadowReach,
    Highlight,
    HighlightLength,
    HighlightColor,
    Exponent,
    Reflection,
    ReflectionInside,
    Refraction,
    Depth,
    Surroundings,
    Ambient,
    Diffuse,
    Clamping,
    Normal,
    Falloff,
    Lamps,
    LampColor,
    Weights,
    Tint,
    Colors,
}

/// The faults without numbers, the likelier first: topic, key in JSON, words in English and in Russian.
macro_rules! faults {
    ($($(#[$doc:meta])* $name:ident, $topic:ident, $key:literal, $english:literal, $russian:literal;)+) => {
        /// A fault in the sum of light.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Fault {
            $($(#[$doc])* $name,)+
            /// Exponents of highlights are off by a factor.
            Exponent(ExponentFactor),
            /// Rays are followed for so many generations only.
            Generations(u8),
        }

        impl Fault {
            pub(super) const PLAIN: &[Self] = &[$(Self::$name),+];

            pub(super) fn topic(self) -> FaultTopic {
                match self {
                    $(Self::$name => FaultTopic::$topic,)+
                    Self::Exponent(_) => FaultTopic::Exponent,
                    Self::Generations(_) => FaultTopic::Depth,
                }
            }

            /// The name in JSON.
            pub fn key(self) -> &'static str {
                match self {
                    $(Self::$name => $key,)+
                    Self::Exponent(_) => "specular-exponent",
                    Self::Generations(_) => "depth-too-small",
                }
            }

            /// The fault in English and in Russian, without its number.
            pub(super) fn words(self) -> Words {
                match self {
                    $(Self::$name => [$english, $russian],)+
                    Self::Exponent(_) => [
                        "exponents of highlights are off by a factor",
                        "показатели бликов отличаются множителем",
                    ],
                    Self::Generations(_) => {
                        ["rays are followed too few times (depth)", "глубина слишком мала"]
                    }
                }
            }
        }
    };
}

faults! {
    /// Bodies throw no shadows.
    NoShadows, Shadow, "no-shadows", "no shadows", "нет теней";
    /// There is no highlight.
    NoHighlight, Highlight, "no-specular", "no specular highlights", "нет бликов";
    /// Nothing is reflected.
    NoReflection, Reflection, "no-reflection", "no reflections", "нет отражений";
    /// Nothing is seen through clear bodies.
    NoRefraction, Refraction, "no-refraction",
        "no refraction: nothing is seen through clear bodies",
        "нет преломления: сквозь прозрачные тела ничего не видно";
    /// There is no ambient light.
    NoAmbient, Ambient, "no-ambient", "no ambient light", "нет фонового света";
    /// There is no diffuse light.
    NoDiffuse, Diffuse, "no-diffuse", "no diffuse light", "нет рассеянного света";
    /// Ambient light is added for each lamp anew.
    AmbientPerLamp, Ambient, "ambient-for-each-lamp",
        "ambient light is added once for each lamp", "фоновый свет прибавлен для каждой лампы";
    /// Ambient light is added for each lamp that reaches the point.
    AmbientPerLitLamp, Ambient, "ambient-for-each-lamp",
        "ambient light is added once for each lamp that reaches the point",
        "фоновый свет прибавлен для каждой лампы, светящей на точку";
    /// Ambient light is that of each lamp.
    AmbientOfLamps, Ambient, "ambient-for-each-lamp",
        "ambient light is added for each lamp, with its color and intensity",
        "фоновый свет прибавлен для каждой лампы, с её цветом и яркостью";
    /// A point that is hidden from a lamp has no ambient light.
    NoAmbientInShadow, Ambient, "no-ambient-in-shadow",
        "shadows are black: there is no ambient light in them", "тени чёрные: в них нет фонового света";
    /// A point that no lamp reaches has no ambient light.
    NoAmbientInDark, Ambient, "no-ambient-in-shadow",
        "no ambient light where no lamp shines", "нет фонового света там, куда не светит ни одна лампа";
    /// Ambient light has not the color of the body.
    UncoloredAmbient, Ambient, "ambient-without-color-of-body",
        "ambient light has not the color of the body", "фоновый свет не имеет цвета тела";
    /// Ambient light is not multiplied by its coefficient.
    WholeAmbient, Ambient, "ambient-coefficient-left-out",
        "the coefficient of ambient light is left out", "не учтён коэффициент фонового света";
    /// Diffuse light does not depend on the angle.
    EvenDiffuse, Diffuse, "diffuse-without-cosine",
        "diffuse light without the cosine: it does not depend on the angle",
        "рассеянный свет без косинуса: не зависит от угла";
    /// Diffuse light is not multiplied by its coefficient.
    WholeDiffuse, Diffuse, "diffuse-coefficient-left-out",
        "the coefficient of diffuse light is left out", "не учтён коэффициент рассеянного света";
    /// The vector to a lamp keeps its length in both terms.
    LongLampVector, Diffuse, "light-vector-not-normalized",
        "the vector to the lamp is not brought to length 1",
        "вектор к лампе не приведён к длине 1";
    /// Clear bodies throw shadows like opaque ones.
    OpaqueShadows, Shadow, "opaque-shadows-of-clear-bodies",
        "clear bodies throw full shadows", "прозрачные тела бросают полные тени";
    /// Clear bodies throw no shadows at all.
    ClearShadows, Shadow, "no-shadows-of-clear-bodies",
        "clear bodies throw no shadows", "прозрачные тела не бросают теней";
    /// Where one lamp is hidden, none shines.
    OneShadowForAll, ShadowReach, "one-shadow-for-all-lamps",
        "a point in the shadow of one lamp gets no light of the others",
        "точка в тени одной лампы не получает света и от остальных";
    /// The shadows of the first lamp are those of all.
    FirstShadowForAll, ShadowReach, "one-shadow-for-all-lamps",
        "the shadows of the first lamp are taken for those of all",
        "тени первой лампы взяты для всех";
    /// Clear bodies are opaque, in their shadows, too.
    OpaqueBodies, Refraction, "clear-bodies-opaque",
        "no refraction: clear bodies are opaque, and throw full shadows",
        "нет преломления: прозрачные тела непрозрачны и бросают полные тени";
    /// Reflection and refraction are not weighed by the angle, though they should be.
    UnweighedBodies, Weights, "clear-bodies-not-weighed",
        "reflection and refraction are not weighed by Schlick's formula",
        "отражение и преломление не взвешены по формуле Шлика";
    /// The light of each ray is clamped to 1.
    ClampedRays, Clamping, "clamped-early",
        "light is clamped early: that of each ray before it is weighted",
        "свет обрезан рано: у каждого луча, прежде чем взвешен";
    /// The local light of a point is clamped to 1 before reflections are added.
    ClampedLocal, Clamping, "clamped-early",
        "light is clamped early: that of a surface before reflections are added",
        "свет обрезан рано: у поверхности, прежде чем прибавлены отражения";
    /// The light of each lamp is clamped to 1.
    ClampedLamps, Clamping, "clamped-early",
        "light is clamped early: that of each lamp before they are added",
        "свет обрезан рано: у каждой лампы, прежде чем сложен";
    /// Normals of scaled bodies are turned by the matrix of the body instead of its inverse transpose.
    ScaledNormals, Normal, "normals-of-scaled-bodies",
        "normals of scaled bodies are wrong: they need the inverse transpose",
        "нормали масштабированных тел неверны: нужна обратная транспонированная матрица";
    /// Normals of scaled bodies are those of the unscaled body.
    UnscaledNormals, Normal, "normals-of-scaled-bodies",
        "normals of scaled bodies are wrong: they need the inverse transpose",
        "нормали масштабированных тел неверны: нужна обратная транспонированная матрица";
    /// Highlights are seen in shadows, too.
    HighlightInShadow, Highlight, "specular-in-shadow",
        "specular highlights are seen in shadows, too", "блики видны и в тени";
    /// The highlight is that of the halfway vector (Blinn 1977).
    HalfwayHighlight, Highlight, "specular-by-halfway-vector",
        "specular highlights by the halfway vector (Blinn) instead of the reflected one (Phong)",
        "блики по серединному вектору (Блинн), а не по отражённому (Фонг)";
    /// The highlight has the color of the body.
    ColoredHighlight, HighlightColor, "specular-in-color-of-body",
        "specular highlights have the color of the body", "блики имеют цвет тела";
    /// The highlight has not the color of the lamp.
    WhiteHighlight, HighlightColor, "specular-without-color-of-light",
        "specular highlights have not the color of the lamp", "блики не имеют цвета лампы";
    /// The highlight is squared with its coefficient.
    SquaredHighlight, Highlight, "specular-squared",
        "specular highlights are squared", "блики возведены в квадрат";
    /// The highlight is not multiplied by its coefficient.
    WholeHighlight, Highlight, "specular-coefficient-left-out",
        "the coefficient of specular highlights is left out", "не учтён коэффициент бликов";
    /// The vector to the eye keeps its length in the highlight.
    LongEyeVector, HighlightLength, "specular-of-vectors-not-normalized",
        "the vector to the eye is not brought to length 1 in highlights",
        "вектор к глазу в бликах не приведён к длине 1";
    /// Highlights in reflections are those that the eye would see.
    EyeForAllRays, HighlightLength, "specular-toward-eye-in-reflections",
        "highlights in reflections are computed toward the eye instead of back along the ray",
        "блики в отражениях посчитаны в сторону глаза, а не назад вдоль луча";
    /// The vector back along the ray keeps the length of the way.
    LongWayBack, HighlightLength, "specular-of-vectors-not-normalized",
        "the vector back along the ray is not brought to length 1 in highlights",
        "вектор назад вдоль луча в бликах не приведён к длине 1";
    /// The directions of primary rays keep their lengths in highlights.
    LongPrimaryRays, HighlightLength, "specular-of-vectors-not-normalized",
        "directions of primary rays are not brought to length 1 in highlights",
        "направления первичных лучей в бликах не приведены к длине 1";
    /// The vector to the lamp keeps its length in highlights.
    LongLampInHighlight, HighlightLength, "specular-of-vectors-not-normalized",
        "the vector to the lamp is not brought to length 1 in highlights",
        "вектор к лампе в бликах не приведён к длине 1";
    /// A body's own light is weakened by what it reflects.
    BlendedReflection, Reflection, "reflection-blended",
        "reflections are blended with the body's own light instead of added",
        "отражение смешано с собственным светом тела, а не прибавлено";
    /// A body's own light is not weakened by what it reflects, though it should be.
    AddedReflection, Reflection, "reflection-added",
        "reflections are added to the body's own light instead of blended",
        "отражение прибавлено к собственному свету тела, а не смешано";
    /// Reflections are multiplied by the color of the body.
    TintedReflection, Reflection, "reflection-in-color-of-body",
        "reflections have the color of the body", "отражения имеют цвет тела";
    /// Reflections are not multiplied by their coefficient.
    WholeReflection, Reflection, "reflection-coefficient-left-out",
        "the coefficient of reflections is left out", "не учтён коэффициент отражения";
    /// A point that is hidden from a lamp sends no ray on.
    NoReflectionInShadow, Reflection, "no-reflection-in-shadow",
        "nothing is reflected in shadows", "в тенях ничего не отражается";
    /// Total reflection brings no light.
    TotalBlack, ReflectionInside, "total-reflection-black",
        "total reflection is black", "полное отражение чёрное";
    /// Clear bodies reflect nothing inside.
    NoInnerReflection, ReflectionInside, "no-reflection-inside",
        "nothing is reflected inside clear bodies", "внутри прозрачных тел ничего не отражается";
    /// Clear bodies do not tint what is seen through them.
    UntintedBodies, Tint, "tint-left-out",
        "the tint of clear bodies is left out", "не учтён оттенок прозрачных тел";
    /// Rays are followed for more generations.
    MoreGenerations, Depth, "depth-too-large",
        "rays are followed for more generations than the scene asks for (depth)",
        "лучи прослежены на больше поколений, чем задано (глубина)";
    /// A ray that is not followed any more brings the background.
    BackgroundAtLast, Surroundings, "background-at-last-generation",
        "a ray beyond the last generation brings the background instead of nothing",
        "луч за последним поколением приносит фон, а не ничего";
    /// A reflected or refracted ray that meets nothing brings nothing.
    BlackBackground, Surroundings, "background-not-reflected",
        "a reflected or refracted ray that meets nothing brings no light instead of the background",
        "отражённый или преломлённый луч, ничего не встретив, приносит не фон, а черноту";
    /// Light does not fall off.
    NoFalloff, Falloff, "falloff",
        "light does not fall off with distance", "свет не слабеет с расстоянием";
    /// Light falls off with 1/d.
    LinearFalloff, Falloff, "falloff", "light falls off with 1/d", "свет слабеет как 1/d";
    /// Light falls off with 1/d².
    SquareFalloff, Falloff, "falloff", "light falls off with 1/d²", "свет слабеет как 1/d²";
    /// The square of the distance stands for the distance.
    FalloffOfSquare, Falloff, "falloff-of-squared-distance",
        "light falls off with the squared distance in the place of the distance (a lost root)",
        "вместо расстояния до лампы взят его квадрат (потерян корень)";
    /// The distance is that from the eye.
    FalloffFromEye, Falloff, "falloff-from-eye",
        "light falls off with the distance from the eye instead of the lamp",
        "свет слабеет с расстоянием от глаза, а не от лампы";
    /// Only the first light shines.
    FirstLightOnly, Lamps, "first-light-only", "only the first light shines", "светит лишь первый источник";
    /// Only the last light shines.
    LastLightOnly, Lamps, "last-light-only", "only the last light shines", "светит лишь последний источник";
    /// The light of the lamps is divided by their number.
    AveragedLamps, Lamps, "lamps-averaged",
        "the light of the lamps is averaged instead of added", "свет ламп усреднён, а не сложен";
    /// Lights are white.
    WhiteLights, LampColor, "light-color-left-out",
        "the color of lights is left out", "не учтён цвет источников";
    /// The intensity of lights is left out.
    FullLights, LampColor, "light-intensity-left-out",
        "the brightness of lights is left out", "не учтена яркость источников";
    /// The colors of bodies are 0 or 1.
    IntegerColors, Colors, "colors-divided-as-integers",
        "colors of bodies are divided as integers: channels are 0 or 1",
        "цвета тел поделены как целые числа: в каналах 0 или 1";
    /// The light of each ray becomes whole codes.
    RoundedRays, Clamping, "rounded-early",
        "light is rounded to bytes early: that of each ray before it is weighted",
        "свет округлён до байтов рано: у каждого луча, прежде чем взвешен";
}

impl Fault {
    /// The most generations of [`Self::Generations`].
    const MOST_GENERATIONS: u8 = 8;

    /// All that a scene can show, the likelier first.
    pub(super) fn possible(scene: &Scene, facts: &SceneFacts) -> Vec<Self> {
        let plain = Self::PLAIN.iter().copied().filter(|fault| fault.is_possible(scene, facts));
        let mut all: Vec<Self> = plain.collect();
        if facts.reflects || facts.transmits {
            let other = |generations: &u8| u32::from(*generations) != scene.tracing.generations;
            all.extend((1..=Self::MOST_GENERATIONS).filter(other).map(Self::Generations));
        }
        if facts.has_highlights {
            all.extend(ExponentFactor::ALL.map(Self::Exponent));
        }
        all
    }

    fn is_possible(self, scene: &Scene, facts: &SceneFacts) -> bool {
        let has_falloff = |fault: Self| {
            let is_same = |falloff: Falloff| match fault {
                Self::NoFalloff => falloff == Falloff::None,
                Self::LinearFalloff => falloff == Falloff::Linear { constant: 0.0 },
                Self::SquareFalloff => falloff == Falloff::InverseSquare,
                _ => falloff == Falloff::None,
            };
            !scene.lights.iter().all(|light| is_same(light.falloff))
        };
        let is_colored = || {
            scene.lights.iter().any(|light| {
                let [red, green, blue] = light.color.to_array();
                red != green || green != blue
            })
        };
        let has_many = scene.lights.len() > 1;
        match self.topic() {
            FaultTopic::Shadow if self != Self::NoShadows => facts.transmits,
            FaultTopic::Shadow | FaultTopic::Diffuse => facts.is_lit,
            FaultTopic::ShadowReach | FaultTopic::Lamps => has_many,
            FaultTopic::HighlightColor if self == Self::WhiteHighlight => {
                facts.has_highlights && is_colored()
            }
            FaultTopic::Highlight
            | FaultTopic::HighlightLength
            | FaultTopic::HighlightColor
            | FaultTopic::Exponent => facts.has_highlights,
            FaultTopic::Refraction | FaultTopic::ReflectionInside | FaultTopic::Tint => facts.transmits,
            FaultTopic::Weights => facts.is_weighed,
            FaultTopic::Reflection => facts.reflects,
            FaultTopic::Depth | FaultTopic::Surroundings => facts.reflects || facts.transmits,
            FaultTopic::Normal => facts.is_scaled,
            FaultTopic::Falloff => facts.is_lit && has_falloff(self),
            FaultTopic::LampColor if self == Self::WhiteLights => is_colored(),
            FaultTopic::LampColor => scene.lights.iter().any(|light| light.intensity != 1.0),
            FaultTopic::Ambient => match self {
                Self::AmbientPerLamp => has_many,
                Self::AmbientPerLitLamp | Self::AmbientOfLamps => facts.is_lit,
                Self::NoAmbientInShadow | Self::NoAmbientInDark => facts.is_lit,
                _ => true,
            },
            FaultTopic::Clamping if self == Self::ClampedLamps => has_many,
            FaultTopic::Clamping | FaultTopic::Colors => true,
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

    /// The factor of the exponents of highlights.
    pub(super) fn exponent_factor(&self) -> f32 {
        let factor = |fault: Fault| match fault {
            Fault::Exponent(factor) => Some(factor.value()),
            _ => None,
        };
        self.iter().find_map(factor).unwrap_or(1.0)
    }
}
