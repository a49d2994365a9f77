//! Values checked against the type and limits of their key.

use std::ops::Range;

use glam::DVec3;

use crate::color::Color;
use crate::format::decimal;
use crate::format::diagnostic::{Diagnostic, Diagnostics};
use crate::format::message::{Component, Enumeration, FoundValue, KeyMeaning, Message, Subject};
use crate::format::nearest::nearest;
use crate::format::quote::{quoted, quoted_value};
use crate::format::spec::{Default, KeySpec, Kind, Limits, TableSpec, When};
use crate::format::toml::{Span, Value, ValueKind};
use crate::format::tree::Table;
use crate::image::{Image, ImageSource};

/// The keys of one table, ready to be asked for their values. What is absent or wrong is `None`; what is wrong is
/// reported besides.
pub(crate) struct Fields<'a, 'b, 't> {
    pub(crate) text: &'t str,
    pub(crate) spec: &'static TableSpec,
    pub(crate) table: &'b Table<'t>,
    pub(crate) found: &'a mut Diagnostics,
}

impl<'b, 't> Fields<'_, 'b, 't> {
    /// Whether the key is given at all.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.table.get(name).is_some()
    }

    /// The place of the key, or of the whole value when it has none of its own.
    pub(crate) fn key_span(&self, name: &str) -> Option<Range<usize>> {
        self.table.entry(name).map(|entry| entry.key.span.range())
    }

    fn given(&self, name: &str) -> Option<(&'static KeySpec, &'b Value<'t>)> {
        let (_, key) = self.spec.find(name)?;
        let value = self.table.get(name)?;
        if matches!(value.kind, ValueKind::Invalid) { None } else { Some((key, value)) }
    }

    /// A number or whole number.
    pub(crate) fn number(&mut self, name: &str) -> Option<f64> {
        let (key, value) = self.given(name)?;
        let limits = key.kind.limits()?;
        match value.kind {
            ValueKind::Number { is_integer: false, .. } if matches!(key.kind, Kind::Integer(_)) => {
                self.wrong(key, value, FoundValue::Written(self.source(value)))
            }
            ValueKind::Number { value: number, .. } => {
                self.within(key, value, number, limits, Component::Whole)
            }
            _ => self.wrong_type(key, value),
        }
    }

    /// Three numbers.
    pub(crate) fn vector(&mut self, name: &str) -> Option<DVec3> {
        let (key, value) = self.given(name)?;
        self.three(key, value, Component::OF_VECTOR).map(DVec3::from_array)
    }

    /// One number, which stands for three equal ones, or three.
    pub(crate) fn number_or_vector(&mut self, name: &str) -> Option<DVec3> {
        let (key, value) = self.given(name)?;
        if let ValueKind::Number { value: number, .. } = value.kind {
            return self.within(key, value, number, key.kind.limits()?, Component::Whole).map(DVec3::splat);
        }
        self.vector(name)
    }

    /// Three linear components, or an sRGB color.
    pub(crate) fn color(&mut self, name: &str) -> Option<Color> {
        let (key, value) = self.given(name)?;
        if let ValueKind::Text(text) = &value.kind {
            let color = color_from_hex(text);
            if color.is_none() {
                let finding = wrong_value(key, value, FoundValue::Written(quoted(text)));
                self.found.push(finding.with_label(Message::NotAColor).with_help(Message::ColorIs));
            }
            return color;
        }
        self.three(key, value, Component::OF_COLOR).map(Color::from)
    }

    /// A text.
    pub(crate) fn text(&mut self, name: &str) -> Option<String> {
        let (key, value) = self.given(name)?;
        match &value.kind {
            ValueKind::Text(text) => Some(text.as_ref().to_owned()),
            _ => self.wrong_type(key, value),
        }
    }

    /// A picture, which is still to be opened, with the name of its layer under another key.
    pub(crate) fn image(&mut self, name: &str, layer: &str) -> Option<Image> {
        let layer = self.text(layer);
        let (path, span) = self.path(name)?;
        let source = ImageSource::new(path, layer.map(Into::into));
        self.found.names_image(source.clone(), span);
        Some(Image::from_source(source))
    }

    /// The path of a picture, and where it stands.
    fn path(&mut self, name: &str) -> Option<(&'b str, Range<usize>)> {
        let (key, value) = self.given(name)?;
        match &value.kind {
            ValueKind::Text(path) if path.is_empty() => self.wrong(key, value, FoundValue::Empty),
            ValueKind::Text(path) => Some((path.as_ref(), value.span.range())),
            _ => self.wrong_type(key, value),
        }
    }

    /// A truth value.
    pub(crate) fn flag(&mut self, name: &str) -> Option<bool> {
        let (key, value) = self.given(name)?;
        match value.kind {
            ValueKind::Boolean(flag) => Some(flag),
            _ => self.wrong_type(key, value),
        }
    }

    /// What one of the words of a choice stands for; `None` when none is given, or something else.
    pub(crate) fn word<T>(&mut self, name: &str, of_word: impl FnOnce(&str) -> Option<T>) -> Option<T> {
        self.choice(name).ok().flatten().and_then(of_word)
    }

    /// One of the words of a choice; `Err` when something else is given.
    pub(crate) fn choice(&mut self, name: &str) -> Result<Option<&'static str>, ()> {
        let Some((_, key)) = self.spec.find(name) else { return Ok(None) };
        let Some(value) = self.table.get(name) else { return Ok(None) };
        let Kind::Choice(words) = key.kind else { return Ok(None) };
        match &value.kind {
            ValueKind::Invalid => Err(()),
            ValueKind::Text(text) => match words.iter().find(|word| *word == text) {
                Some(word) => Ok(Some(word)),
                None => {
                    let label = match nearest(text, words.iter().copied()) {
                        Some(word) => Message::DidYouMean { word: quoted_value(word) },
                        None => Message::UnknownWord { key: key.name },
                    };
                    let finding = wrong_value(key, value, FoundValue::Written(quoted(text)));
                    self.found.push(finding.with_label(label));
                    Err(())
                }
            },
            _ => {
                let _: Option<()> = self.wrong_type(key, value);
                Err(())
            }
        }
    }

    /// The table under the key.
    pub(crate) fn child(&mut self, name: &str) -> Option<&'b Table<'t>> {
        let (key, value) = self.given(name)?;
        match &value.kind {
            ValueKind::Table(table) => Some(table),
            _ => self.wrong_type(key, value),
        }
    }

    /// Reports a value of the wrong type.
    pub(crate) fn wrong_type<T>(&mut self, key: &'static KeySpec, value: &Value<'_>) -> Option<T> {
        if let Some(list) = self.with_points(key, value) {
            let message = Message::DecimalCommas { key: key.name, expected: key.kind };
            let help = Message::DecimalPoint { example: format!("`{list}`") };
            self.found.push(Diagnostic::error(value.span.range(), message).with_help(help));
            return None;
        }
        let found = match &value.kind {
            ValueKind::Array(values) => FoundValue::ListOf(values.len()),
            kind => kind.found(),
        };
        self.wrong(key, value, found)
    }

    /// A list that would be right with points in the place of its decimal commas.
    fn with_points(&self, key: &KeySpec, value: &Value<'_>) -> Option<String> {
        const COMPONENTS: usize = 3;
        let is_list = matches!(value.kind, ValueKind::Array(_));
        let takes_list = matches!(key.kind, Kind::Vector(_) | Kind::NumberOrVector(_) | Kind::Color(_));
        let list = self.text.get(value.span.range()).filter(|_| is_list && takes_list)?;
        decimal::list_with_points(list, COMPONENTS)
    }

    /// Reports the wrong values among the keys that depend on `choice`, but for those in `except`. For choices whose
    /// own value is wrong: any of these keys may be the right one then.
    pub(crate) fn check_dependent(&mut self, choice: &str, except: &[&str]) {
        for key in self.spec.keys {
            let depends = matches!(key.when, When::Choice { choice: other, .. } if other == choice);
            if depends && !except.contains(&key.name) {
                self.check_value(key);
            }
        }
    }

    /// Reports the wrong values among the keys that depend on `choice` and have no meaning for its value `chosen`.
    pub(crate) fn check_inapplicable(&mut self, choice: &str, chosen: &str) {
        for key in self.spec.keys {
            let When::Choice { choice: other, values } = key.when else { continue };
            if other == choice && !values.contains(&chosen) {
                self.check_value(key);
            }
        }
    }

    /// Reports the value of a key when it is wrong. Tables are checked where they are built.
    pub(crate) fn check_value(&mut self, key: &KeySpec) {
        match key.kind {
            Kind::Text => _ = self.text(key.name),
            Kind::File => _ = self.path(key.name),
            Kind::Flag => _ = self.flag(key.name),
            Kind::Choice(_) => _ = self.choice(key.name),
            Kind::Number(_) | Kind::Integer(_) => _ = self.number(key.name),
            Kind::Vector(_) => _ = self.vector(key.name),
            Kind::NumberOrVector(_) => _ = self.number_or_vector(key.name),
            Kind::Color(_) => _ = self.color(key.name),
            Kind::Version(_) | Kind::Table(_) | Kind::NameOrTable(_) | Kind::Named(_) | Kind::List(_) => {}
        }
    }

    /// Whether a key has a meaning for the value of the choice it depends on, as far as that is known.
    pub(crate) fn has_meaning(&self, key: &KeySpec) -> bool {
        key.applies(|choice| self.chosen(choice).map(|(chosen, _)| chosen))
    }

    /// Reports the keys that have no meaning for the value of the choice they depend on.
    pub(crate) fn check_choices(&mut self) {
        for entry in &self.table.entries {
            let Some((_, key)) = self.spec.find(&entry.key.text) else { continue };
            let When::Choice { choice, .. } = key.when else { continue };
            let Some((chosen, is_default)) = self.chosen(choice) else { continue };
            if let Some(finding) = inapplicable(self.spec, key, chosen, is_default, entry.key.span) {
                self.found.push(finding);
            }
        }
    }

    /// The word that a choice has, and whether by default; `None` when it is wrong.
    fn chosen(&self, choice: &str) -> Option<(&'static str, bool)> {
        let (_, key) = self.spec.find(choice)?;
        let Kind::Choice(words) = key.kind else { return None };
        match (self.table.get(choice).map(|value| &value.kind), key.default) {
            (Some(ValueKind::Text(text)), _) => Some((words.iter().find(|word| *word == text)?, false)),
            (None, Default::Text(word)) => Some((word, true)),
            _ => None,
        }
    }

    fn three(
        &mut self,
        key: &'static KeySpec,
        value: &'b Value<'t>,
        parts: [Component; 3],
    ) -> Option<[f64; 3]> {
        let limits = key.kind.limits()?;
        let ValueKind::Array(values) = &value.kind else { return self.wrong_type(key, value) };
        let [a, b, c] = values.as_slice() else { return self.wrong_type(key, value) };
        let mut component = |value: &'b Value<'t>, part: Component| match value.kind {
            ValueKind::Number { value: number, .. } => self.within(key, value, number, limits, part),
            _ => {
                let message = Message::WrongValue {
                    subject: Subject::component(part, key.name),
                    found: value.kind.found(),
                    expected: Kind::Number(limits),
                };
                self.found.push(Diagnostic::error(value.span.range(), message).with_help(key_help(key)));
                None
            }
        };
        let all = [component(a, parts[0]), component(b, parts[1]), component(c, parts[2])];
        match all {
            [Some(a), Some(b), Some(c)] => Some([a, b, c]),
            _ => None,
        }
    }

    fn within(
        &mut self,
        key: &'static KeySpec,
        value: &Value<'t>,
        number: f64,
        limits: Limits,
        part: Component,
    ) -> Option<f64> {
        if limits.contains(number) {
            return Some(number);
        }
        let message = Message::OutOfRange {
            subject: Subject::component(part, key.name),
            value: FoundValue::Written(self.source(value)),
            requirement: limits.requirement(number),
        };
        self.found.push(Diagnostic::error(value.span.range(), message).with_help(key_help(key)));
        None
    }

    fn wrong<T>(&mut self, key: &'static KeySpec, value: &Value<'_>, found: FoundValue) -> Option<T> {
        let finding = wrong_value(key, value, found);
        self.found.push(if matches!(key.kind, Kind::Choice(_)) {
            finding
        } else {
            finding.with_help(key_help(key))
        });
        None
    }

    /// A value as it is written, shortened.
    fn source(&self, value: &Value<'_>) -> String {
        quoted(self.text.get(value.span.range()).unwrap_or_default())
    }
}

impl Kind {
    /// The range of its numbers; `None` for what is no number, vector or color.
    pub fn limits(&self) -> Option<Limits> {
        match *self {
            Self::Number(limits)
            | Self::Integer(limits)
            | Self::Vector(limits)
            | Self::NumberOrVector(limits)
            | Self::Color(limits) => Some(limits),
            _ => None,
        }
    }
}

/// A value that is not of the kind that its key takes.
fn wrong_value(key: &KeySpec, value: &Value<'_>, found: FoundValue) -> Diagnostic {
    let message = Message::WrongValue { subject: Subject::key(key.name), found, expected: key.kind };
    Diagnostic::error(value.span.range(), message)
}

/// Refuses a key at `span` that has no meaning where the choice that it depends on is `chosen`; `is_default` if nobody
/// chose that.
pub(crate) fn inapplicable(
    table: &'static TableSpec,
    key: &'static KeySpec,
    chosen: &'static str,
    is_default: bool,
    span: Span,
) -> Option<Diagnostic> {
    let When::Choice { choice, values } = key.when else { return None };
    if values.contains(&chosen) {
        return None;
    }
    let is_own = |other: &&KeySpec| other.belongs_to(choice, chosen);
    let own = Enumeration::of_keys(table.keys.iter().filter(is_own));
    let key = key.name;
    let label = match is_default {
        true => Message::ChosenByDefault { choice, chosen },
        false => Message::ChosenHere { choice, chosen },
    };
    let help = match own.is_empty() {
        true => Message::RemoveOrChange { key, choice },
        false => Message::RemoveOrChangeChosen { key, choice, chosen, own },
    };
    let message = Message::OnlyFor { key, choice, values: Enumeration::of_values(values) };
    Some(Diagnostic::error(span.range(), message).with_label(label).with_help(help))
}

/// What a key means and which values it can have.
pub(crate) fn key_help(key: &'static KeySpec) -> Message {
    Message::KeyMeans { meaning: KeyMeaning { key, has_range: true } }
}

/// A color from `#rrggbb`.
fn color_from_hex(text: &str) -> Option<Color> {
    let digits = text.strip_prefix('#')?;
    if digits.len() != 6 || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let [_, r, g, b] = u32::from_str_radix(digits, 16).ok()?.to_be_bytes();
    Some(Color::from_srgb8([r, g, b]))
}
