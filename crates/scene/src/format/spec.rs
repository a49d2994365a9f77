//! The shape of the table of the format: what can be said about a key.

use crate::format::message::Requirement;

/// One table of the format: the root, the camera, a material, a body …
#[derive(Debug)]
pub struct TableSpec {
    /// With its article, as messages call it: `a body`, `the camera`.
    pub name: &'static str,
    /// What the table describes, one line.
    pub doc: &'static str,
    /// The table's keys in the order of writing.
    pub keys: &'static [KeySpec],
}

/// A table of the format is equal only to itself.
impl PartialEq for TableSpec {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Eq for TableSpec {}

impl TableSpec {
    /// The key called `name`.
    ///
    /// ```
    /// use catoptric_scene::format::keys;
    /// let radius = keys::BODY.key("radius").unwrap();
    /// assert_eq!(radius.limits().map(|limits| limits.min), Some(1e-9));
    /// assert_eq!(radius.default_number(Some("cylinder")), Some(0.5));
    /// ```
    pub fn key(&self, name: &str) -> Option<&'static KeySpec> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// The key called `name` and its place in [`Self::keys`].
    pub fn find(&self, name: &str) -> Option<(usize, &'static KeySpec)> {
        self.keys.iter().enumerate().find(|(_, key)| key.name == name)
    }
}

/// One key of a table.
#[derive(Debug)]
pub struct KeySpec {
    /// The key itself.
    pub name: &'static str,
    /// What it means and in which unit, one line without a full stop.
    pub doc: &'static str,
    /// What its value can be.
    pub kind: Kind,
    /// The value of an absent key.
    pub default: Default,
    /// When the key has a meaning.
    pub when: When,
    /// Keys of the same table that cannot stand beside this one.
    pub excludes: &'static [&'static str],
    /// The key of the same table that must stand beside this one.
    pub requires: Option<&'static str>,
    /// Whether the key is written even at its default.
    pub always_written: bool,
}

/// A key of the format is equal only to itself.
impl PartialEq for KeySpec {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Eq for KeySpec {}

impl KeySpec {
    /// A key that always applies, excludes nothing, has no default and is written when it is not at its default.
    pub const fn new(name: &'static str, kind: Kind, doc: &'static str) -> Self {
        Self {
            name,
            doc,
            kind,
            default: Default::Absent,
            when: When::Always,
            excludes: &[],
            requires: None,
            always_written: false,
        }
    }

    /// Gives the key a default.
    pub const fn or(mut self, default: Default) -> Self {
        self.default = default;
        self
    }

    /// Limits the key to some values of the table's choice.
    pub const fn only(mut self, choice: &'static str, values: &'static [&'static str]) -> Self {
        self.when = When::Choice { choice, values };
        self
    }

    /// Requires one key beside it and excludes others.
    pub const fn beside(mut self, requires: &'static str, excludes: &'static [&'static str]) -> Self {
        self.requires = Some(requires);
        self.excludes = excludes;
        self
    }

    /// Excludes other keys beside it.
    pub const fn excluding(mut self, excludes: &'static [&'static str]) -> Self {
        self.excludes = excludes;
        self
    }

    /// Makes the writer write the key even at its default.
    pub const fn written(mut self) -> Self {
        self.always_written = true;
        self
    }

    /// The range of its numbers; `None` for what is no number, vector or color.
    pub fn limits(&self) -> Option<Limits> {
        self.kind.limits()
    }

    /// The number that an absent key stands for, also where three equal ones may stand. `chosen` is the word of the
    /// choice that the key depends on (the shape, for sizes), where its default differs with it.
    pub fn default_number(&self, chosen: Option<&str>) -> Option<f64> {
        match self.default {
            Default::Number(number) => Some(number),
            Default::ByChoice(defaults) => {
                defaults.iter().find(|(word, _)| Some(*word) == chosen).map(|(_, number)| *number)
            }
            _ => None,
        }
    }

    /// The vector or color that an absent key stands for.
    pub fn default_vector(&self) -> Option<[f64; 3]> {
        match (self.default, self.kind) {
            (Default::Vector(vector), _) => Some(vector),
            (Default::Number(number), Kind::NumberOrVector(_)) => Some([number; 3]),
            _ => None,
        }
    }

    /// Whether the key depends on `choice` and has a meaning for its value `chosen`.
    pub fn belongs_to(&self, choice: &str, chosen: &str) -> bool {
        match self.when {
            When::Choice { choice: other, values } => other == choice && values.contains(&chosen),
            When::Always => false,
        }
    }

    /// Whether the key has a meaning when the table's choice keys have the values that `choice_of` tells.
    pub fn applies(&self, choice_of: impl Fn(&str) -> Option<&'static str>) -> bool {
        match self.when {
            When::Always => true,
            When::Choice { choice, values } => choice_of(choice).is_none_or(|value| values.contains(&value)),
        }
    }
}

/// The type of a key's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One of the versions of the format.
    Version(&'static [&'static str]),
    /// A name.
    Text,
    /// The path of a picture.
    File,
    /// `true` or `false`.
    Flag,
    /// One of some words.
    Choice(&'static [&'static str]),
    /// A number.
    Number(Limits),
    /// A whole number.
    Integer(Limits),
    /// Three numbers.
    Vector(Limits),
    /// One number, or three.
    NumberOrVector(Limits),
    /// Three linear components, or `"#rrggbb"`.
    Color(Limits),
    /// A table.
    Table(&'static TableSpec),
    /// A name from the scene's table of such tables, or a table.
    NameOrTable(&'static TableSpec),
    /// A table of tables under names of the user's choice.
    Named(&'static TableSpec),
    /// A list of tables.
    List(&'static TableSpec),
}

/// The range of a number. Every number is finite besides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
}

/// No limit is NaN.
impl Eq for Limits {}

impl Limits {
    /// Sizes, scales and other lengths that cannot vanish.
    pub const LENGTH: Self = Self::new(1e-9, 1e9);
    /// Places.
    pub const PLACE: Self = Self::new(-1e9, 1e9);
    /// Coefficients, colors, intensities.
    pub const AMOUNT: Self = Self::new(0.0, 1e6);

    /// From `min` to `max`, both included.
    pub const fn new(min: f64, max: f64) -> Self {
        Self { min, max }
    }

    /// Whether `value` is a number of this range.
    pub fn contains(&self, value: f64) -> bool {
        value >= self.min && value <= self.max
    }

    /// What a value outside of the range should have been: greater than 0, at least 0.01, a finite number …
    pub(crate) fn requirement(&self, value: f64) -> Requirement {
        if !value.is_finite() {
            Requirement::Finite
        } else if value <= 0.0 && self.min > 0.0 && self.min < 1e-6 {
            Requirement::Positive
        } else if value < 0.0 && self.min == 0.0 {
            Requirement::NotNegative
        } else if value < self.min {
            Requirement::AtLeast(self.min.into())
        } else {
            Requirement::AtMost(self.max.into())
        }
    }
}

/// The value of an absent key.
#[derive(Clone, Copy, Debug)]
pub enum Default {
    /// None: the thing is absent too, or the key's text says what happens.
    Absent,
    /// A number, also where a vector may stand.
    Number(f64),
    /// A vector or a color.
    Vector([f64; 3]),
    /// A name or word.
    Text(&'static str),
    /// A truth value.
    Flag(bool),
    /// A number for each value of the choice that decides whether the key applies.
    ByChoice(&'static [(&'static str, f64)]),
    /// A table whose keys are all absent.
    EmptyTable,
}

/// The condition on which a key has a meaning.
#[derive(Clone, Copy, Debug)]
pub enum When {
    /// Always.
    Always,
    /// When the choice of the same table has one of these values.
    Choice {
        /// The key that chooses.
        choice: &'static str,
        /// The values of the choice for which the key applies.
        values: &'static [&'static str],
    },
}
