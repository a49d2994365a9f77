//! Sizes of a shape that contradict each other.

use std::borrow::Cow;

use super::phrase::{Number, Phrase};
use crate::language::Language;

/// What is wrong with the sizes of a parametric shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum SizeFault {
    /// A size is not smaller than the one that it lies within.
    NotSmaller { key: &'static str, other: &'static str },
    /// The rim of a bowl lies where the inner ball is not.
    BowlClosed { least: Number, most: Number },
    /// The ball of a face is not wider than the rim.
    FaceTooNarrow { radius: Number },
    /// The faces of a lens meet before the rim.
    LensTooThin { least: Number },
    /// The ball of a face ends within the lens.
    LensTooThick { most: Number },
    /// A focal length for the index 1.
    NoRefraction,
    /// A focal length that no lens of the thickness has.
    NoSuchLens { at_least: Number },
    /// The rim of a dish is too near or too far.
    DishDepth,
}

/// What to do about a [`SizeFault`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SizeHelp(pub(crate) SizeFault);

impl Phrase for SizeFault {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let number = |number: &Number| number.phrase(language).into_owned();
        let [english, russian] = match self {
            Self::NotSmaller { key, other } => [
                format!("`{key}` is not smaller than `{other}`"),
                format!("`{key}` не меньше, чем `{other}`"),
            ],
            Self::BowlClosed { least, most } => {
                let (least, most) = (number(least), number(most));
                [
                    format!("the rim of this bowl must be higher than {least} and lower than {most} meters"),
                    format!("край этой чаши должен быть выше {least} и ниже {most} м"),
                ]
            }
            Self::FaceTooNarrow { radius } => {
                let radius = number(radius);
                [
                    format!(
                        "a face with a radius of curvature of {radius} meters is too small for this `radius`"
                    ),
                    format!("поверхность с радиусом кривизны {radius} м мала для такого `radius`"),
                ]
            }
            Self::LensTooThin { least } => {
                let least = number(least);
                [
                    format!(
                        "the faces of this lens meet before the rim unless it is thicker than {least} meters"
                    ),
                    format!("поверхности линзы сходятся до края, если она не толще {least} м"),
                ]
            }
            Self::LensTooThick { most } => {
                let most = number(most);
                [
                    format!(
                        "the ball of a face ends within this lens unless it is thinner than {most} meters"
                    ),
                    format!("шар одной из поверхностей кончается внутри линзы, если она не тоньше {most} м"),
                ]
            }
            Self::NoRefraction => [
                "a lens whose index of refraction is 1 has no focal length".to_owned(),
                "у линзы с показателем преломления 1 нет фокусного расстояния".to_owned(),
            ],
            Self::NoSuchLens { .. } => [
                "no lens of this `thickness` has this `focal_length`".to_owned(),
                "при такой `thickness` такого `focal_length` у линзы не бывает".to_owned(),
            ],
            Self::DishDepth => [
                "the rim of this dish is less than 1e-9 or more than 1e9 meters above its vertex".to_owned(),
                "край этого зеркала выше его вершины меньше чем на 1e-9 или больше чем на 1e9 метров"
                    .to_owned(),
            ],
        };
        of_both(language, english, russian)
    }
}

fn of_both(language: Language, english: String, russian: String) -> Cow<'static, str> {
    match language {
        Language::English => english.into(),
        Language::Russian => russian.into(),
    }
}

impl Phrase for SizeHelp {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let [english, russian] = match &self.0 {
            SizeFault::NotSmaller { key, other } => [
                format!("make `{key}` smaller or `{other}` larger"),
                format!("уменьшите `{key}` или увеличьте `{other}`"),
            ],
            SizeFault::BowlClosed { .. } => [
                "the rim lies between the bottom and the top of the inner ball; change `height`, `thickness` or `radius`"
                    .to_owned(),
                "край лежит между низом и верхом внутреннего шара; измените `height`, `thickness` или `radius`"
                    .to_owned(),
            ],
            SizeFault::FaceTooNarrow { .. } => [
                "the radius of curvature must be larger than `radius`; bend the face less, or make `radius` smaller"
                    .to_owned(),
                "радиус кривизны должен быть больше, чем `radius`; сделайте поверхность более пологой или уменьшите `radius`"
                    .to_owned(),
            ],
            SizeFault::LensTooThin { .. } => [
                "make `thickness` larger or `radius` smaller, or bend the faces less".to_owned(),
                "увеличьте `thickness`, уменьшите `radius` или сделайте поверхности более пологими".to_owned(),
            ],
            SizeFault::LensTooThick { .. } => [
                "make `thickness` smaller, or bend the faces less".to_owned(),
                "уменьшите `thickness` или сделайте поверхности более пологими".to_owned(),
            ],
            SizeFault::NoRefraction => [
                "give `ior` the index of the material, such as 1.5 for glass".to_owned(),
                "задайте в `ior` показатель преломления материала, например 1.5 для стекла".to_owned(),
            ],
            SizeFault::NoSuchLens { at_least } => {
                let least = at_least.phrase(language);
                [
                    format!("a lens with two equal faces has one below 0 or of at least {least} meters; make `thickness` smaller"),
                    format!("у линзы с одинаковыми поверхностями он меньше 0 или не меньше {least} м; уменьшите `thickness`"),
                ]
            }
            SizeFault::DishDepth => [
                "change `radius`, `focal_length` or `curvature_radius`".to_owned(),
                "измените `radius`, `focal_length` или `curvature_radius`".to_owned(),
            ],
        };
        of_both(language, english, russian)
    }
}
