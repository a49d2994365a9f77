//! Sizes of a shape that contradict each other.

use super::phrase::{Number, Phrase, Sentence};
use crate::compound::{BrokenSize, SizeFault};
use crate::language::Language;

/// What is wrong.
pub(crate) fn size_fault(broken: BrokenSize) -> Sentence {
    Sentence::new(|language| {
        let [english, russian] = fault_in_words(broken, |length| shown(length, language));
        match language {
            Language::English => english,
            Language::Russian => russian,
        }
    })
}

/// What to do about it.
pub(crate) fn size_help(broken: BrokenSize) -> Sentence {
    Sentence::new(|language| {
        let [english, russian] = help_in_words(broken, |length| shown(length, language));
        match language {
            Language::English => english,
            Language::Russian => russian,
        }
    })
}

/// A length of six digits.
fn shown(length: f64, language: Language) -> String {
    let number = Number::from(format!("{length:.5e}").parse().unwrap_or(length));
    number.phrase(language).into_owned()
}

fn fault_in_words(BrokenSize { key, fault }: BrokenSize, shown: impl Fn(f64) -> String) -> [String; 2] {
    match fault {
        SizeFault::NoLength { value } => {
            let value = shown(value);
            [format!("`{key}` is {value}, but must be a length"), format!("`{key}` — {value}, а нужна длина")]
        }
        SizeFault::NotSmaller { other } => {
            [format!("`{key}` is not smaller than `{other}`"), format!("`{key}` не меньше, чем `{other}`")]
        }
        SizeFault::BowlClosed { least, most } => {
            let (least, most) = (shown(least), shown(most));
            [
                format!("the rim of this bowl must be higher than {least} and lower than {most} meters"),
                format!("край этой чаши должен быть выше {least} и ниже {most} м"),
            ]
        }
        SizeFault::FaceTooNarrow { radius } => {
            let radius = shown(radius);
            [
                format!(
                    "a face with a radius of curvature of {radius} meters is too small for this `radius`"
                ),
                format!("поверхность с радиусом кривизны {radius} м мала для такого `radius`"),
            ]
        }
        SizeFault::LensTooThin { least } => {
            let least = shown(least);
            [
                format!(
                    "the faces of this lens meet before the rim unless it is thicker than {least} meters"
                ),
                format!("поверхности линзы сходятся до края, если она не толще {least} м"),
            ]
        }
        SizeFault::LensTooThick { most } => {
            let most = shown(most);
            [
                format!("the ball of a face ends within this lens unless it is thinner than {most} meters"),
                format!("шар одной из поверхностей кончается внутри линзы, если она не тоньше {most} м"),
            ]
        }
        SizeFault::FlatTriangle => {
            ["the corners `a`, `b` and `c` lie on a line", "вершины `a`, `b` и `c` лежат на одной прямой"]
                .map(str::to_owned)
        }
        SizeFault::NoRefraction => [
            "a lens whose index of refraction is 1 has no focal length",
            "у линзы с показателем преломления 1 нет фокусного расстояния",
        ]
        .map(str::to_owned),
        SizeFault::NoSuchLens { .. } => [
            "no lens of this `thickness` has this `focal_length`",
            "при такой `thickness` такого `focal_length` у линзы не бывает",
        ]
        .map(str::to_owned),
        SizeFault::DishDepth => [
            "the rim of this dish is less than 1e-9 or more than 1e9 meters above its vertex",
            "край этого зеркала выше его вершины меньше чем на 1e-9 или больше чем на 1e9 метров",
        ]
        .map(str::to_owned),
    }
}

fn help_in_words(BrokenSize { key, fault }: BrokenSize, shown: impl Fn(f64) -> String) -> [String; 2] {
    let sentences = match fault {
        SizeFault::NoLength { .. } => {
            return [
                format!("`{key}` of this shape is a length above 0"),
                format!("`{key}` у этой формы — длина больше нуля"),
            ];
        }
        SizeFault::NotSmaller { other } => {
            return [
                format!("make `{key}` smaller or `{other}` larger"),
                format!("уменьшите `{key}` или увеличьте `{other}`"),
            ];
        }
        SizeFault::NoSuchLens { at_least } => {
            let least = shown(at_least);
            return [
                format!(
                    "with equal faces it is below 0 or at least {least} meters; make `thickness` smaller, or change \
                     `focal_length`"
                ),
                format!(
                    "с одинаковыми поверхностями он меньше 0 или не меньше {least} м; уменьшите `thickness` или измените \
                     `focal_length`"
                ),
            ];
        }
        SizeFault::BowlClosed { .. } => [
            "the rim lies between bottom and top of the inner ball; change `height`, `thickness` or `radius`",
            "край лежит между низом и верхом внутреннего шара; измените `height`, `thickness` или `radius`",
        ],
        SizeFault::FaceTooNarrow { .. } => [
            "the radius of curvature must be larger than `radius`; bend the face less, or make `radius` smaller",
            "радиус кривизны должен быть больше, чем `radius`; увеличьте его или уменьшите `radius`",
        ],
        SizeFault::FlatTriangle => {
            ["move one of them away from the line", "отодвиньте одну из них от прямой"]
        }
        SizeFault::LensTooThin { .. } => [
            "make `thickness` larger or `radius` smaller, or bend the faces less",
            "увеличьте `thickness`, уменьшите `radius` или сделайте поверхности более пологими",
        ],
        SizeFault::LensTooThick { .. } => [
            "make `thickness` smaller, or bend the faces less",
            "уменьшите `thickness` или сделайте поверхности более пологими",
        ],
        SizeFault::NoRefraction => [
            "give `ior` the index of the material, such as 1.5 for glass",
            "задайте в `ior` показатель преломления материала, например 1.5 для стекла",
        ],
        SizeFault::DishDepth => [
            "change `radius`, `focal_length` or `curvature_radius`",
            "измените `radius`, `focal_length` или `curvature_radius`",
        ],
    };
    sentences.map(str::to_owned)
}
