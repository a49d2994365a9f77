//! The arguments of messages that each language says in its own way.

use std::borrow::Cow;

use catoptric_scene::{Language, Phrase, quoted_name};

/// What an argument means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Argument {
    Position,
    Direction,
    Normal,
    Axis,
    Corner,
    Diameter,
    Height,
    Side,
    Color,
    Ratio,
    Brightness,
    FieldOfView,
    HalfAngle,
    Width,
    PictureHeight,
    Shininess,
    Reflection,
    Specular,
    CheckerSize,
}

impl Phrase for Argument {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let (english, russian) = match self {
            Self::Position => ("the position", "положение"),
            Self::Direction => ("the direction of view", "направление взгляда"),
            Self::Normal => ("the normal", "нормаль"),
            Self::Axis => ("the axis", "ось"),
            Self::Corner => ("a corner", "вершина"),
            Self::Diameter => ("the diameter", "диаметр"),
            Self::Height => ("the height", "высота"),
            Self::Side => ("the side", "сторона"),
            Self::Color => ("the color", "цвет"),
            Self::Ratio => ("the ratio of ambient light", "доля фонового света"),
            Self::Brightness => ("the brightness", "яркость"),
            Self::FieldOfView => ("the field of view", "угол зрения"),
            Self::HalfAngle => ("half the angle at the apex", "половина угла при вершине"),
            Self::Width => ("the width of the picture", "ширина изображения"),
            Self::PictureHeight => ("the height of the picture", "высота изображения"),
            Self::Shininess => ("the exponent of the highlight", "показатель блика"),
            Self::Reflection => ("the reflection", "отражение"),
            Self::Specular => ("the coefficient of the highlight", "коэффициент блика"),
            Self::CheckerSize => ("the size of a cell", "размер клетки"),
        };
        language.pick(english, russian).into()
    }
}

/// The kind of a value, for messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Nothing,
    Text,
    Name,
    Number,
    Flag,
    List,
    ThreeNumbers,
    Table,
}

impl Phrase for Kind {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let (english, russian) = match self {
            Self::Nothing => ("empty", "пусто"),
            Self::Text => ("a text", "текст"),
            Self::Name => ("a name", "имя"),
            Self::Number => ("a number", "число"),
            Self::Flag => ("`true` or `false`", "`true` или `false`"),
            Self::List => ("a list", "список"),
            Self::ThreeNumbers => ("three numbers: `[0, 1, 0]`", "три числа: `[0, 1, 0]`"),
            Self::Table => ("a table of keys", "таблица ключей"),
        };
        language.pick(english, russian).into()
    }
}

/// What a body or a light is called in messages.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Title {
    /// The body of this number, from 1, and this name.
    Body(usize, String),
    /// The light of this number, from 1, and this name.
    Light(usize, String),
}

impl Phrase for Title {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let (kind, index, name) = match self {
            Self::Body(index, name) => (language.pick("body", "тело"), index, name),
            Self::Light(index, name) => (language.pick("light", "источник света"), index, name),
        };
        if name.is_empty() { format!("{kind} {index}") } else { format!("{kind} {}", quoted_name(name)) }
            .into()
    }
}

/// What two numbers of a cone are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ConeNumbers {
    /// Whether one of them is half the angle at the apex in degrees, not the diameter of the base.
    pub(crate) has_angle: bool,
    /// Whether the height is the first one.
    pub(crate) is_height_first: bool,
}

impl Phrase for ConeNumbers {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let (english, russian) = match (self.has_angle, self.is_height_first) {
            (false, false) => ("diameter and height", "диаметр и высота"),
            (true, false) => (
                "half the angle at the apex in degrees, and height",
                "половина угла при вершине в градусах и высота",
            ),
            (false, true) => ("height and diameter", "высота и диаметр"),
            (true, true) => (
                "height, and half the angle at the apex in degrees",
                "высота и половина угла при вершине в градусах",
            ),
        };
        language.pick(english, russian).into()
    }
}
