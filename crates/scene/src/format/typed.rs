//! Values held against the type and limits of their key.

use std::ops::Range;

use glam::DVec3;

use crate::color::Color;
use crate::format::decimal;
use crate::format::diagnostic::{Diagnostic, Diagnostics};
use crate::format::nearest::nearest;
use crate::format::number::short_number;
use crate::format::quote::{listed, quoted, quoted_value};
use crate::format::spec::{Default, KeySpec, Kind, Limits, TableSpec, When};
use crate::format::toml::{Value, ValueKind};
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
                self.wrong(key, value, &format!("`{name}` is {}", self.source(value)))
            }
            ValueKind::Number { value: number, .. } => self.within(key, value, number, limits, ""),
            _ => self.wrong_type(key, value),
        }
    }

    /// Three numbers.
    pub(crate) fn vector(&mut self, name: &str) -> Option<DVec3> {
        let (key, value) = self.given(name)?;
        self.three(key, value, ["the x of ", "the y of ", "the z of "]).map(DVec3::from_array)
    }

    /// One number, which stands for three equal ones, or three.
    pub(crate) fn number_or_vector(&mut self, name: &str) -> Option<DVec3> {
        let (key, value) = self.given(name)?;
        if let ValueKind::Number { value: number, .. } = value.kind {
            return self.within(key, value, number, key.kind.limits()?, "").map(DVec3::splat);
        }
        self.vector(name)
    }

    /// Three linear components, or an sRGB color.
    pub(crate) fn color(&mut self, name: &str) -> Option<Color> {
        let (key, value) = self.given(name)?;
        if let ValueKind::Text(text) = &value.kind {
            let color = color_from_hex(text);
            if color.is_none() {
                let message = format!("`{name}` is {}, but must be {}", quoted(text), key.kind.described());
                self.found.push(
                    Diagnostic::error(value.span.range(), message)
                        .label("not a color")
                        .help("a color is `[r, g, b]` in linear light, or \"#rrggbb\" with six hexadecimal digits in sRGB"),
                );
            }
            return color;
        }
        self.three(key, value, ["the red of ", "the green of ", "the blue of "]).map(Color::from)
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
            ValueKind::Text(path) if path.is_empty() => self.wrong(key, value, &format!("`{name}` is empty")),
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
                    let message =
                        format!("`{name}` is {}, but must be {}", quoted(text), key.kind.described());
                    let label = match nearest(text, words.iter().copied()) {
                        Some(word) => format!("did you mean {}?", quoted_value(word)),
                        None => format!("unknown {name}"),
                    };
                    self.found.push(Diagnostic::error(value.span.range(), message).label(label));
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
    pub(crate) fn wrong_type<T>(&mut self, key: &KeySpec, value: &Value<'_>) -> Option<T> {
        if let Some(list) = self.with_points(key, value) {
            let message = format!("`{}` has decimal commas, but must be {}", key.name, key.kind.described());
            self.found.push(
                Diagnostic::error(value.span.range(), message).help(decimal::help(&format!("`{list}`"))),
            );
            return None;
        }
        let what = match &value.kind {
            ValueKind::Array(values) => match values.len() {
                1 => "a list of one value".to_owned(),
                count => format!("a list of {count} values"),
            },
            kind => kind.described().to_owned(),
        };
        self.wrong(key, value, &format!("`{}` is {what}", key.name))
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

    /// Reports the value of a key when it is wrong. Tables are checked where they are built.
    fn check_value(&mut self, key: &KeySpec) {
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
            let When::Choice { choice, values } = key.when else { continue };
            let Some((chosen, is_default)) = self.chosen(choice) else { continue };
            if values.contains(&chosen) {
                continue;
            }
            let allowed: Vec<String> = values.iter().map(|value| format!("\"{value}\"")).collect();
            let message = format!("`{}` is only for `{choice}` {}", key.name, listed(&allowed, " or "));
            let label =
                format!("here `{choice}` is \"{chosen}\"{}", if is_default { ", the default" } else { "" });
            let mut help = format!("remove `{}`, or change `{choice}`", key.name);
            let own = self.own_keys(choice, chosen);
            if !own.is_empty() {
                help.push_str(&format!("; with \"{chosen}\" stand {}", listed(&own, " and ")));
            }
            self.found.push(Diagnostic::error(entry.key.span.range(), message).label(label).help(help));
        }
    }

    /// The keys that depend on `choice` and apply for `chosen`.
    fn own_keys(&self, choice: &str, chosen: &str) -> Vec<String> {
        let applies = |key: &&KeySpec| match key.when {
            When::Choice { choice: other, values } => other == choice && values.contains(&chosen),
            When::Always => false,
        };
        self.spec.keys.iter().filter(applies).map(|key| format!("`{}`", key.name)).collect()
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

    fn three(&mut self, key: &'static KeySpec, value: &'b Value<'t>, parts: [&str; 3]) -> Option<[f64; 3]> {
        let limits = key.kind.limits()?;
        let ValueKind::Array(values) = &value.kind else { return self.wrong_type(key, value) };
        let [a, b, c] = values.as_slice() else { return self.wrong_type(key, value) };
        let mut component = |value: &'b Value<'t>, part: &str| match value.kind {
            ValueKind::Number { value: number, .. } => self.within(key, value, number, limits, part),
            _ => {
                let found =
                    format!("{part}`{}` is {}, but must be a number", key.name, value.kind.described());
                self.found.push(Diagnostic::error(value.span.range(), found).help(key_help(key)));
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
        key: &KeySpec,
        value: &Value<'t>,
        number: f64,
        limits: Limits,
        part: &str,
    ) -> Option<f64> {
        if limits.contains(number) {
            return Some(number);
        }
        let message = format!(
            "{part}`{}` is {}, but must be {}",
            key.name,
            self.source(value),
            limits.requirement(number)
        );
        self.found.push(Diagnostic::error(value.span.range(), message).help(key_help(key)));
        None
    }

    fn wrong<T>(&mut self, key: &KeySpec, value: &Value<'_>, found: &str) -> Option<T> {
        let message = format!("{found}, but must be {}", key.kind.described());
        let diagnostic = Diagnostic::error(value.span.range(), message);
        self.found.push(if matches!(key.kind, Kind::Choice(_)) {
            diagnostic
        } else {
            diagnostic.help(key_help(key))
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

    /// With its article: `a number`, `three numbers` …
    pub(crate) fn described(&self) -> String {
        match self {
            Self::Version(words) | Self::Choice(words) => {
                let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
                listed(&words, " or ")
            }
            Self::Text => "a text in quotes".to_owned(),
            Self::File => "the path of a picture in quotes".to_owned(),
            Self::Flag => "`true` or `false`".to_owned(),
            Self::Number(_) => "a number".to_owned(),
            Self::Integer(_) => "a whole number".to_owned(),
            Self::Vector(_) => "three numbers".to_owned(),
            Self::NumberOrVector(_) => "a number or three numbers".to_owned(),
            Self::Color(_) => "three numbers or \"#rrggbb\"".to_owned(),
            Self::Table(_) => "a table".to_owned(),
            Self::NameOrTable(_) => "a name in quotes or a table".to_owned(),
            Self::Named(_) => "a table of named tables".to_owned(),
            Self::List(_) => "a list of tables".to_owned(),
        }
    }
}

/// What a key means and which values it can have.
pub(crate) fn key_help(key: &KeySpec) -> String {
    let mut help = format!("`{}` is {}", key.name, key.doc);
    if let Some(limits) = key.kind.limits() {
        help.push_str(&format!(" ({} to {})", short_number(limits.min), short_number(limits.max)));
    }
    help
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
