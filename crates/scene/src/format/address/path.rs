//! Addresses as text.

use std::fmt;
use std::str::FromStr;

use super::error::{AddressError, refused};
use super::value::quoted_text;
use crate::format::message::Message;
use crate::format::quote::quoted;
use crate::format::write::text_value;

/// The address of a value of a scene: the keys of the format from the root on with points between them, as in
/// `bodies.ball.material.ior`.
///
/// - Lights and bodies have their name, or their number from 0 on. A name of digits alone stands in quotes.
/// - `.x`, `.y` and `.z`, or `.r`, `.g` and `.b`, are the numbers of a vector or color; so are `.0`, `.1` and `.2`.
/// - A name that holds other characters than letters, digits, `_` and `-` is written in quotes, as in TOML.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ScenePath {
    /// At least one.
    pub(super) segments: Vec<PathSegment>,
}

/// A key, a name or a number in an address.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct PathSegment {
    pub(super) text: String,
    is_quoted: bool,
}

impl PathSegment {
    /// A key of the format.
    pub(super) fn key(text: &str) -> Self {
        Self { text: text.to_owned(), is_quoted: false }
    }

    /// A name of the user's choice.
    pub(super) fn name(text: &str) -> Self {
        let is_bare = |character: char| character.is_alphanumeric() || character == '_' || character == '-';
        let is_number = text.bytes().all(|byte| byte.is_ascii_digit());
        Self { text: text.to_owned(), is_quoted: is_number || !text.chars().all(is_bare) }
    }

    /// A number from 0 on, if it is one.
    pub(super) fn number(&self) -> Option<usize> {
        let is_number = !self.is_quoted && self.text.bytes().all(|byte| byte.is_ascii_digit());
        if is_number { self.text.parse().ok() } else { None }
    }
}

impl ScenePath {
    /// Splits the address off the beginning of a text; it ends before a `=`, or with the text.
    ///
    /// # Errors
    /// When the text does not begin with an address.
    pub fn split(text: &str) -> Result<(Self, &str), AddressError> {
        let mut segments = Vec::new();
        let mut rest = text.trim_start();
        loop {
            let (segment, after) = segment(rest).ok_or_else(|| not_a_path(text))?;
            segments.push(segment);
            rest = after.trim_start();
            match rest.strip_prefix('.') {
                Some(next) => rest = next.trim_start(),
                None if rest.is_empty() || rest.starts_with('=') => return Ok((Self { segments }, rest)),
                None => return Err(not_a_path(text)),
            }
        }
    }
}

fn not_a_path(text: &str) -> AddressError {
    let finding = refused(Message::NotAPath { text: quoted(text) });
    AddressError::new(&text, finding.with_help(Message::PathIs))
}

/// The segment at the beginning of a text, and what follows.
fn segment(text: &str) -> Option<(PathSegment, &str)> {
    let is_quoted = text.starts_with(['"', '\'']);
    if is_quoted {
        let (text, rest) = quoted_text(text)?;
        return Some((PathSegment { text, is_quoted }, rest));
    }
    let end = text.find(['.', '=']).unwrap_or(text.len());
    let (text, rest) = text.split_at_checked(end)?;
    let text = text.trim_end();
    let is_name = !text.is_empty() && !text.contains(['"', '\'']);
    is_name.then(|| (PathSegment { text: text.to_owned(), is_quoted }, rest))
}

impl FromStr for ScenePath {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, AddressError> {
        match Self::split(text)? {
            (path, "") => Ok(path),
            _ => Err(not_a_path(text)),
        }
    }
}

impl fmt::Display for ScenePath {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, segment) in self.segments.iter().enumerate() {
            let point = if index == 0 { "" } else { "." };
            match segment.is_quoted {
                true => write!(out, "{point}{}", text_value(&segment.text))?,
                false => write!(out, "{point}{}", segment.text)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(path: &str) -> Vec<String> {
        let path: ScenePath = path.parse().unwrap();
        path.segments.iter().map(|segment| segment.text.clone()).collect()
    }

    #[test]
    fn segments_are_told_apart() {
        assert_eq!(texts("bodies.ball.position.y"), ["bodies", "ball", "position", "y"]);
        assert_eq!(texts("bodies . 'a.b=c' . \"\\u0416\\\"\".radius"), ["bodies", "a.b=c", "Ж\"", "radius"]);
        assert_eq!(texts("bodies.шар.radius"), ["bodies", "шар", "radius"]);
        let (path, rest) = ScenePath::split("lights.0.intensity = 2 = 3").unwrap();
        assert_eq!((path.to_string().as_str(), rest), ("lights.0.intensity", "= 2 = 3"));
        for text in ["", ".", "a.", ".a", "a..b", "a.\"b", "a'b'", "\"a\"b", "=3"] {
            assert!(ScenePath::split(text).is_err(), "{text}");
        }
        assert!("a=1".parse::<ScenePath>().is_err());
    }

    #[test]
    fn numbers_are_no_names() {
        let number = |path: &str| path.parse::<ScenePath>().unwrap().segments[1].number();
        assert_eq!(
            (number("bodies.12"), number("bodies.\"12\""), number("bodies.-1")),
            (Some(12), None, None)
        );
        for name in ["12", "", "a b", "шар", "a.b", "a\n", "ball-1"] {
            let path = ScenePath { segments: vec![PathSegment::key("bodies"), PathSegment::name(name)] };
            assert_eq!(path.to_string().parse(), Ok(path));
        }
    }
}
