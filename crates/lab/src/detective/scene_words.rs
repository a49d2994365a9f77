//! Mistakes of the scene in words.

use super::scene_mistake::{BodyKind, OtherOrigin, SceneMistake, SizeKind, TurnOrder};
use super::verdict::Words;
use crate::report::Language;

/// A mistake of the scene in a language.
pub(super) fn scene_in_words(mistake: SceneMistake, language: Language) -> String {
    let of = |words: Words, kind: BodyKind| {
        let [english, russian] = words;
        let [english_kind, russian_kind] = kind.words();
        match language {
            Language::English => english.replace("{kind}", english_kind),
            Language::Russian => russian.replace("{kind}", russian_kind),
        }
    };
    match mistake {
        SceneMistake::Missing(kind) => of(["{kind} are missing", "нет тел вида «{kind}»"], kind),
        SceneMistake::Shadowless(kind) => {
            of(["{kind} throw no shadows", "тела вида «{kind}» не бросают теней"], kind)
        }
        SceneMistake::OtherOrigin(kind, origin) => of(origin_in_words(origin), kind),
        SceneMistake::Shifted(kind, _) => {
            of(["{kind} stand elsewhere", "тела вида «{kind}» стоят не на своём месте"], kind)
        }
        SceneMistake::Sized(kind, which, size) => {
            let factor = language.fixed(f64::from(size) / 1000.0, 2);
            let words = match which {
                SizeKind::All => [
                    "{kind} have {factor} times their size",
                    "тела вида «{kind}» имеют {factor} своего размера",
                ],
                SizeKind::Radius => [
                    "{kind} have {factor} times their radius",
                    "тела вида «{kind}» имеют {factor} своего радиуса",
                ],
                SizeKind::Height => [
                    "{kind} have {factor} times their height",
                    "тела вида «{kind}» имеют {factor} своей высоты",
                ],
            };
            of(words, kind).replace("{factor}", &factor)
        }
        SceneMistake::TurnOrder(order) => {
            let (english, russian) = order_in_words(order);
            match language {
                Language::English => format!("rotations are applied in another order: {english}"),
                Language::Russian => format!("повороты применены в другом порядке: {russian}"),
            }
        }
        other => {
            let [english, russian] = plain_words(other);
            language.choose(english, russian).to_owned()
        }
    }
}

/// The axes in the order in which they are turned about, the first first.
fn order_in_words(order: TurnOrder) -> (&'static str, &'static str) {
    match order {
        TurnOrder::Xyz => ("about z, then y, then x", "вокруг z, затем y, затем x"),
        TurnOrder::Xzy => ("about y, then z, then x", "вокруг y, затем z, затем x"),
        TurnOrder::Yxz => ("about z, then x, then y", "вокруг z, затем x, затем y"),
        TurnOrder::Yzx => ("about x, then z, then y", "вокруг x, затем z, затем y"),
        TurnOrder::Zxy => ("about y, then x, then z", "вокруг y, затем x, затем z"),
    }
}

fn origin_in_words(origin: OtherOrigin) -> Words {
    match origin {
        OtherOrigin::Up => [
            "the position of {kind} is taken for their lowest point",
            "положение тел вида «{kind}» принято за их нижнюю точку",
        ],
        OtherOrigin::Down => [
            "the position of {kind} is taken for their highest point",
            "положение тел вида «{kind}» принято за их верхнюю точку",
        ],
        OtherOrigin::LeastCorner | OtherOrigin::GreatestCorner => [
            "the position of {kind} is taken for a corner instead of the middle",
            "положение тел вида «{kind}» принято за угол, а не за середину",
        ],
    }
}

fn plain_words(mistake: SceneMistake) -> Words {
    match mistake {
        SceneMistake::StraightRefraction => [
            "no refraction: rays go straight through clear bodies",
            "нет преломления: лучи идут сквозь прозрачные тела прямо",
        ],
        SceneMistake::InvertedRefraction => [
            "the indices of refraction are exchanged (η₁/η₂ for η₂/η₁)",
            "показатели преломления переставлены (η₁/η₂ вместо η₂/η₁)",
        ],
        SceneMistake::DoubledRadius => [
            "diameters are taken as radii: bodies are twice as large",
            "диаметры взяты как радиусы: тела вдвое больше",
        ],
        SceneMistake::HalvedRadius => [
            "radii are taken as diameters: bodies are half as large",
            "радиусы взяты как диаметры: тела вдвое меньше",
        ],
        SceneMistake::NoPattern => ["patterns are missing", "нет узоров"],
        SceneMistake::CylindersUp => [
            "the middle of a cylinder is taken for the center of its base",
            "середина цилиндра принята за центр основания",
        ],
        SceneMistake::CylindersDown => [
            "the center of the base of a cylinder is taken for its middle",
            "центр основания цилиндра принят за середину",
        ],
        SceneMistake::TurnedCones => {
            ["apex and base of cones are exchanged", "у конусов переставлены вершина и основание"]
        }
        SceneMistake::TurnedBack => {
            ["bodies are turned in the other sense", "тела повёрнуты в другую сторону"]
        }
        SceneMistake::InverseTurn => [
            "bodies are turned by the inverse (the transpose) of their rotation",
            "тела повёрнуты обратным (транспонированным) поворотом",
        ],
        SceneMistake::NoTurn => ["bodies are not turned", "тела не повёрнуты"],
        SceneMistake::NoScale => ["bodies are not scaled", "тела не масштабированы"],
        SceneMistake::PatternExchanged => {
            ["the two colors of patterns are exchanged", "переставлены два цвета узоров"]
        }
        SceneMistake::PatternShifted => {
            ["patterns are shifted by half a cell", "узоры сдвинуты на половину клетки"]
        }
        SceneMistake::PatternDoubled => {
            ["cells of patterns are twice as large", "клетки узоров вдвое крупнее"]
        }
        SceneMistake::PatternHalved => ["cells of patterns are half as large", "клетки узоров вдвое мельче"],
        SceneMistake::PatternMultiplied => [
            "points are multiplied by the size of cells instead of divided",
            "координаты умножены на размер клетки, а не поделены на него",
        ],
        SceneMistake::PatternUnscaled => ["the size of cells is left out", "не учтён размер клеток"],
        SceneMistake::PatternSpace => [
            "patterns are laid out in the wrong space: of the body instead of the world, or the reverse",
            "узоры разложены не в том пространстве: тела вместо мира или наоборот",
        ],
        SceneMistake::TargetAsDirection => {
            ["the camera's target is taken as its direction", "цель камеры взята как направление взгляда"]
        }
        SceneMistake::CameraMoved(..) => {
            ["the camera stands elsewhere by a little", "камера стоит немного в другом месте"]
        }
        // These are told with their bodies and numbers.
        SceneMistake::TurnOrder(_)
        | SceneMistake::Missing(_)
        | SceneMistake::Shadowless(_)
        | SceneMistake::OtherOrigin(..)
        | SceneMistake::Sized(..)
        | SceneMistake::Shifted(..) => ["", ""],
    }
}
