//! Values of a scene by themselves.

use std::fmt;
use std::str::FromStr;

use super::error::{AddressError, refused};
use crate::format::message::Message;
use crate::format::quote::quoted;
use crate::format::record::Datum;
use crate::format::toml::{LogicalLine, LogicalLines, Statement, Value, ValueKind, parse};
use crate::format::write::text_value;

/// A value of a scene, without a table around it. As text it is a value of TOML.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneValue {
    /// A number, also a whole one.
    Number(f64),
    /// A vector, or a color in linear components.
    Vector([f64; 3]),
    /// A name, a word of a choice, a path, or a color as `#rrggbb`.
    Text(String),
    /// A truth value.
    Flag(bool),
}

impl SceneValue {
    /// A value of the document; `None` for tables.
    pub(super) fn of_datum(datum: &Datum<'_>) -> Option<Self> {
        Some(match datum {
            Datum::Number(number) => Self::Number(*number),
            Datum::Integer(number) => Self::Number(f64::from(*number)),
            Datum::Vector(vector) => Self::Vector(*vector),
            Datum::Text(text) => Self::Text(text.as_ref().to_owned()),
            Datum::Flag(flag) => Self::Flag(*flag),
            Datum::Table(_) | Datum::Tables(_) => return None,
        })
    }

    /// Three numbers, which one number stands for as well.
    pub(super) fn three(&self) -> Option<[f64; 3]> {
        match *self {
            Self::Number(number) => Some([number; 3]),
            Self::Vector(vector) => Some(vector),
            Self::Text(_) | Self::Flag(_) => None,
        }
    }
}

impl From<f64> for SceneValue {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<[f64; 3]> for SceneValue {
    fn from(vector: [f64; 3]) -> Self {
        Self::Vector(vector)
    }
}

impl From<&str> for SceneValue {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<bool> for SceneValue {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

/// Reads a value of TOML. So that it can be typed into a shell, a text may stand without quotes, unless it begins with
/// a quote or bracket, and three numbers without brackets.
impl FromStr for SceneValue {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, AddressError> {
        let text = text.trim();
        let value = toml_value(text, |value| match &value.kind {
            ValueKind::Number { value, .. } => Some(Self::Number(*value)),
            ValueKind::Boolean(flag) => Some(Self::Flag(*flag)),
            ValueKind::Text(text) => Some(Self::Text(text.as_ref().to_owned())),
            ValueKind::Array(values) => three_numbers(values).map(Self::Vector),
            _ => None,
        });
        if let Some(value) = value {
            return Ok(value);
        }
        if text.is_empty() || text.starts_with(['"', '\'', '[', '{']) {
            let finding = refused(Message::NotAValue { raw: quoted(text) });
            return Err(AddressError::new(&text, finding.with_help(Message::SceneValueIs)));
        }
        let list = toml_value(&format!("[{text}]"), |value| match &value.kind {
            ValueKind::Array(values) => three_numbers(values),
            _ => None,
        });
        Ok(list.map_or_else(|| text.into(), Self::Vector))
    }
}

fn three_numbers(values: &[Value<'_>]) -> Option<[f64; 3]> {
    let number = |value: &Value<'_>| match value.kind {
        ValueKind::Number { value, .. } => Some(value),
        _ => None,
    };
    match values {
        [a, b, c] => Some([number(a)?, number(b)?, number(c)?]),
        _ => None,
    }
}

/// What `read` makes of a text that is a value of TOML and nothing else.
fn toml_value<T>(text: &str, read: impl FnOnce(&Value<'_>) -> Option<T>) -> Option<T> {
    let text = format!("x={text}");
    let mut lines = LogicalLines::new(&text);
    let Some(LogicalLine::Tokens(tokens)) = lines.next() else { return None };
    let parsed = parse(&text, tokens);
    match parsed.statement {
        Some(Statement::Assignment(assignment))
            if parsed.problems.is_empty()
                && assignment.path.len() == 1
                && assignment.value.span.range().end == text.len() =>
        {
            read(&assignment.value)
        }
        _ => None,
    }
}

/// The text of the string of TOML at the beginning of `text`, and what follows it.
pub(super) fn quoted_text(text: &str) -> Option<(String, &str)> {
    let quote = text.chars().next()?;
    let mut is_escaped = false;
    let end = text.char_indices().skip(1).find(|(_, character)| {
        let is_end = *character == quote && !is_escaped;
        is_escaped = quote == '"' && *character == '\\' && !is_escaped;
        is_end
    });
    let (string, rest) = text.split_at_checked(end?.0 + 1)?;
    let string = toml_value(string, |value| match &value.kind {
        ValueKind::Text(text) => Some(text.as_ref().to_owned()),
        _ => None,
    });
    Some((string?, rest))
}

impl fmt::Display for SceneValue {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => out.write_str(&number_text(*number)),
            Self::Vector(vector) => write!(out, "[{}]", vector.map(number_text).join(", ")),
            Self::Text(text) => out.write_str(&text_value(text)),
            Self::Flag(flag) => write!(out, "{flag}"),
        }
    }
}

/// The shortest number of TOML that reads back the same: whole numbers without a point, which keys for them need.
fn number_text(number: f64) -> String {
    let number = if number == 0.0 { 0.0 } else { number };
    let text = format!("{number:?}").to_ascii_lowercase();
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Option<SceneValue> {
        text.parse().ok()
    }

    #[test]
    fn a_shell_needs_no_quotes() {
        assert_eq!(read("cube"), Some("cube".into()));
        assert_eq!(read(" #ff0000 "), Some("#ff0000".into()));
        assert_eq!(read("\"1\""), Some("1".into()));
        assert_eq!(read("'a \"b'"), Some("a \"b".into()));
        assert_eq!(read("pictures/wood.png"), Some("pictures/wood.png".into()));
        assert_eq!(read("2020-01-01"), Some("2020-01-01".into()));
        assert_eq!(read("true"), Some(true.into()));
        assert_eq!(read("-1.5e3"), Some((-1500.0).into()));
        assert_eq!(read("0x10"), Some(16.0.into()));
        assert_eq!(read("[1, -2.5, 1e3]"), Some([1.0, -2.5, 1000.0].into()));
        assert_eq!(read("1,-2.5, 1e3"), Some([1.0, -2.5, 1000.0].into()));
        assert_eq!(read("0,5"), Some("0,5".into()));
        assert_eq!(read("a\nb"), Some("a\nb".into()));
        assert_eq!(read("5 # five"), Some("5 # five".into()));
        for text in ["", "\"a", "[1, 2]", "[1, 2, 3", "{ x = 1 }", "['a', 1, 2]", "'a' b"] {
            assert_eq!(read(text), None, "{text}");
        }
    }

    #[test]
    fn a_value_reads_back() {
        for value in [
            SceneValue::Number(6.0),
            0.1.into(),
            1e300.into(),
            (-1e-9).into(),
            f64::INFINITY.into(),
            [0.0, 1.5, -2.0].into(),
            true.into(),
            "true".into(),
            "a\n\"b\"".into(),
            "".into(),
        ] {
            assert_eq!(read(&value.to_string()), Some(value.clone()), "{value}");
        }
        assert_eq!(SceneValue::Number(6.0).to_string(), "6");
        assert_eq!(SceneValue::Number(-0.0).to_string(), "0");
        assert_eq!(SceneValue::Number(f64::NAN).to_string(), "nan");
    }
}
