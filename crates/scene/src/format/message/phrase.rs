//! The arguments of messages that each language says in its own way.

use std::borrow::Cow;

use crate::format::keys::russian;
use crate::format::number::short_number;
use crate::format::quote::listed;
use crate::format::spec::{KeySpec, Kind, TableSpec};
use crate::language::{Language, russian_genitive};

/// An argument of a message.
pub trait Phrase {
    /// The argument in words.
    fn phrase(&self, language: Language) -> Cow<'_, str>;
}

/// What is the same in every language: keys, names, parts of the file.
impl Phrase for str {
    fn phrase(&self, _language: Language) -> Cow<'_, str> {
        self.into()
    }
}

/// A sentence in every language.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sentence {
    english: String,
    russian: String,
}

impl Sentence {
    /// The sentence that `in_language` gives for each language.
    pub fn new(in_language: impl Fn(Language) -> String) -> Self {
        Self { english: in_language(Language::English), russian: in_language(Language::Russian) }
    }

    /// The sentence in a language.
    pub fn text(&self, language: Language) -> &str {
        match language {
            Language::English => &self.english,
            Language::Russian => &self.russian,
        }
    }
}

impl Phrase for Sentence {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        self.text(language).into()
    }
}

/// A number for people, as short as it can be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number(String);

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        Self(short_number(value))
    }
}

impl Phrase for Number {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        language.number(&self.0)
    }
}

/// The value found in place of the expected one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum FoundValue {
    /// Something that is reported already.
    Invalid,
    /// A text.
    Text,
    /// A number.
    Number,
    /// A truth value.
    Boolean,
    /// A date.
    Date,
    /// A list.
    List,
    /// A list with so many values.
    ListOf(usize),
    /// A table.
    Table,
    /// An empty text.
    Empty,
    /// What the file says, between backquotes.
    Written(String),
    /// A number of a scene in memory.
    Value(Number),
}

impl Phrase for FoundValue {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let (english, russian) = match self {
            Self::Invalid => ("something else", "что-то другое"),
            Self::Text => ("a text", "текст"),
            Self::Number => ("a number", "число"),
            Self::Boolean => ("a truth value", "логическое значение"),
            Self::Date => ("a date", "дата"),
            Self::List => ("a list", "список"),
            Self::ListOf(1) => ("a list of one value", "список из одного значения"),
            Self::ListOf(count) => {
                return match language {
                    Language::English => format!("a list of {count} values"),
                    Language::Russian => {
                        format!("список из {count} {}", russian_genitive(*count, "значения", "значений"))
                    }
                }
                .into();
            }
            Self::Table => ("a table", "таблица"),
            Self::Empty => ("empty", "пустой текст"),
            Self::Written(written) => return written.as_str().into(),
            Self::Value(number) => return number.phrase(language),
        };
        language.pick(english, russian).into()
    }
}

/// What a value should be, with its article in English: `a number`, `three numbers` …
impl Phrase for Kind {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let (english, russian) = match self {
            Self::Version(words) | Self::Choice(words) => {
                return Enumeration::of_values(words).phrase(language).into_owned().into();
            }
            Self::Text => ("a text in quotes", "текст в кавычках"),
            Self::File => ("the path of a picture in quotes", "путь к картинке в кавычках"),
            Self::Flag => ("`true` or `false`", "`true` или `false`"),
            Self::Number(_) => ("a number", "число"),
            Self::Integer(_) => ("a whole number", "целое число"),
            Self::Vector(_) => ("three numbers", "три числа"),
            Self::NumberOrVector(_) => ("a number or three numbers", "число или три числа"),
            Self::Color(_) => ("three numbers or \"#rrggbb\"", "три числа или \"#rrggbb\""),
            Self::Table(_) => ("a table", "таблица"),
            Self::NameOrTable(_) => ("a name in quotes or a table", "имя в кавычках или таблица"),
            Self::Named(_) => ("a table of named tables", "таблица именованных таблиц"),
            Self::List(_) => ("a list of tables", "список таблиц"),
        };
        language.pick(english, russian).into()
    }
}

/// A table: in English with its article, in Russian in the genitive.
impl Phrase for TableSpec {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        match language {
            Language::English => self.name,
            Language::Russian => russian::genitive(self),
        }
        .into()
    }
}

/// The part of a value that is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Component {
    /// All of it.
    Whole,
    /// A coordinate of a vector.
    X,
    /// A coordinate of a vector.
    Y,
    /// A coordinate of a vector.
    Z,
    /// A component of a color.
    Red,
    /// A component of a color.
    Green,
    /// A component of a color.
    Blue,
    /// A number of a vector or a color.
    First,
    /// A number of a vector or a color.
    Second,
    /// A number of a vector or a color.
    Third,
}

impl Component {
    /// The numbers of a vector.
    pub(crate) const OF_VECTOR: [Self; 3] = [Self::X, Self::Y, Self::Z];
    /// The numbers of a color.
    pub(crate) const OF_COLOR: [Self; 3] = [Self::Red, Self::Green, Self::Blue];
    /// The numbers of a vector or a color.
    pub(crate) const IN_ORDER: [Self; 3] = [Self::First, Self::Second, Self::Third];

    /// What stands before the key.
    const fn before_key(self, language: Language) -> &'static str {
        let (english, russian) = match self {
            Self::Whole => ("", ""),
            Self::X => ("the x of ", "значение x в "),
            Self::Y => ("the y of ", "значение y в "),
            Self::Z => ("the z of ", "значение z в "),
            Self::Red => ("the red of ", "значение красного в "),
            Self::Green => ("the green of ", "значение зелёного в "),
            Self::Blue => ("the blue of ", "значение синего в "),
            Self::First => ("the first number of ", "первое значение в "),
            Self::Second => ("the second number of ", "второе значение в "),
            Self::Third => ("the third number of ", "третье значение в "),
        };
        language.pick(english, russian)
    }
}

/// The value of a key, or a number of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Subject {
    component: Component,
    /// Between backquotes.
    key: String,
}

impl Subject {
    /// The value of `key`.
    pub(crate) fn key(key: &str) -> Self {
        Self::component(Component::Whole, key)
    }

    /// A number of the value of `key`.
    pub(crate) fn component(component: Component, key: &str) -> Self {
        Self { component, key: format!("`{key}`") }
    }

    /// The value of a name that stands between backquotes already.
    pub(crate) fn quoted(name: String) -> Self {
        Self { component: Component::Whole, key: name }
    }
}

impl Phrase for Subject {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        format!("{}{}", self.component.before_key(language), self.key).into()
    }
}

/// The conjunction before the last word of an enumeration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Conjunction {
    /// All of them.
    And,
    /// One of them.
    Or,
    /// Not all are listed.
    Space,
}

/// Words with commas between them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Enumeration {
    words: Vec<String>,
    link: Conjunction,
}

impl Enumeration {
    /// An enumeration of words.
    pub(crate) fn new(words: Vec<String>, link: Conjunction) -> Self {
        Self { words, link }
    }

    /// One of these values in quotes.
    pub(crate) fn of_values(values: &[&str]) -> Self {
        Self::new(values.iter().map(|value| format!("\"{value}\"")).collect(), Conjunction::Or)
    }

    /// All of these keys between backquotes.
    pub(crate) fn of_keys<'a>(keys: impl Iterator<Item = &'a KeySpec>) -> Self {
        Self::new(keys.map(|key| format!("`{}`", key.name)).collect(), Conjunction::And)
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.words.is_empty()
    }
}

impl Phrase for Enumeration {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let link = match self.link {
            Conjunction::And => language.pick(" and ", " и "),
            Conjunction::Or => language.pick(" or ", " или "),
            Conjunction::Space => " ",
        };
        listed(&self.words, link).into()
    }
}

/// The requirement that a number outside of its range breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Requirement {
    /// Neither infinite nor no number.
    Finite,
    /// Greater than 0.
    Positive,
    /// 0 or more.
    NotNegative,
    /// At least this number.
    AtLeast(Number),
    /// At most this number.
    AtMost(Number),
}

impl Phrase for Requirement {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        match self {
            Self::Finite => language.pick("a finite number", "конечным числом").into(),
            Self::Positive => language.pick("greater than 0", "больше 0").into(),
            Self::NotNegative => language.pick("0 or more", "не меньше 0").into(),
            Self::AtLeast(number) => {
                format!("{} {}", language.pick("at least", "не меньше"), number.phrase(language)).into()
            }
            Self::AtMost(number) => {
                format!("{} {}", language.pick("at most", "не больше"), number.phrase(language)).into()
            }
        }
    }
}

/// The meaning of a key, for a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct KeyMeaning {
    /// The key.
    pub(crate) key: &'static KeySpec,
    /// Whether the range of its numbers is written too.
    pub(crate) has_range: bool,
}

impl Phrase for KeyMeaning {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let is = language.pick("is", "—");
        let (doc, range) = (self.key.words(language), self.key.range(language).filter(|_| self.has_range));
        format!("`{}` {is} {doc}{}", self.key.name, range.unwrap_or_default()).into()
    }
}

impl KeySpec {
    /// What the key means, in which unit, and which values it can have.
    ///
    /// ```
    /// use catoptric_scene::{Language, format::keys};
    /// let fov = keys::CAMERA.key("fov").unwrap();
    /// assert_eq!(fov.meaning(Language::English), "the vertical angle of view, degrees (0.001 to 179.9)");
    /// ```
    pub fn meaning(&self, language: Language) -> String {
        let text = format!("{}{}", self.words(language), self.range(language).unwrap_or_default());
        match self.kind {
            Kind::Choice(words) => format!("{text}: {}", Enumeration::of_values(words).phrase(language)),
            _ => text,
        }
    }

    /// What the key means and in which unit.
    fn words(&self, language: Language) -> &'static str {
        match language {
            Language::English => self.doc,
            Language::Russian => russian::doc(self),
        }
    }

    /// The range of its numbers, in parentheses behind a space.
    fn range(&self, language: Language) -> Option<String> {
        let limits = self.limits()?;
        let (min, max) = (Number::from(limits.min), Number::from(limits.max));
        let (min, max) = (min.phrase(language), max.phrase(language));
        Some(match language {
            Language::English => format!(" ({min} to {max})"),
            Language::Russian => format!(" (от {min} до {max})"),
        })
    }

    /// The unit of its numbers; `None` for what has none.
    pub fn unit(&self, language: Language) -> Option<&'static str> {
        let is_in = |unit: &str| self.doc.split([',', ';']).any(|part| part.trim() == unit);
        [("meters", "метры"), ("degrees", "градусы")]
            .into_iter()
            .find(|(unit, _)| is_in(unit))
            .map(|(english, russian)| language.pick(english, russian))
    }
}

/// Things of a scene that have names of their own: the plural in English, in Russian the form after "два".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Collection {
    /// Materials.
    Materials,
    /// Lights.
    Lights,
    /// Bodies.
    Bodies,
}

impl Phrase for Collection {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        match self {
            Self::Materials => language.pick("materials", "материала"),
            Self::Lights => language.pick("lights", "источника света"),
            Self::Bodies => language.pick("bodies", "тела"),
        }
        .into()
    }
}
