//! The bonus of elements: highlights, reflection, checkers.

use std::ops::Range;

use catoptric_scene::{Color, Material, Pattern, PatternSpace, Phong, SolidTexture};
use glam::DVec3;

use crate::dialect::Dialect;
use crate::draft::Draft;
use crate::lines::{Word, number};
use crate::message::Message;
use crate::minirt::arguments::{Arguments, Spanned, color, out_of_range};
use crate::phrase::Argument;

/// The coefficient of a highlight of which only the exponent is given.
const HIGHLIGHT: f64 = 0.5;

/// What a bonus is about.
#[derive(Clone, Copy)]
enum Property {
    Specular,
    Shininess,
    Reflection,
    Checker,
}

impl Property {
    /// The property of a name in small or capital letters; hyphens may stand in front.
    fn of_name(name: &str) -> Option<Self> {
        Some(match name.trim_start_matches('-').to_ascii_lowercase().as_str() {
            "specular" | "spec" | "ks" => Self::Specular,
            "shininess" | "shine" | "exponent" => Self::Shininess,
            "reflection" | "reflect" | "refl" | "reflectivity" | "mirror" => Self::Reflection,
            "checker" | "checkers" | "checkerboard" | "chess" | "cb" => Self::Checker,
            _ => return None,
        })
    }
}

/// Whether a word is a property that is known, with or without its value.
pub(super) fn is_property(word: &str) -> bool {
    Property::of_name(name_and_value(word).0).is_some()
}

/// `name=value` or `name:value`; the value is empty where there is none.
fn name_and_value(word: &str) -> (&str, &str) {
    let (name, value) = word.split_once(['=', ':']).unwrap_or((word, ""));
    (name, value.trim_start())
}

/// What the bonus says about a surface.
#[derive(Clone, Debug, Default)]
pub(super) struct Finish {
    specular: Option<f64>,
    shininess: Option<f64>,
    reflection: f64,
    checker: Option<SolidTexture>,
}

impl Finish {
    /// Reads what stands behind the arguments of an element: shininess, reflection and whether it is checkered as
    /// numbers, or properties with names.
    pub(super) fn read(&mut self, arguments: &mut Arguments<'_>, draft: &mut Draft) {
        match arguments.numbers_left() {
            // No reflection is above 1, and hardly an exponent below.
            [specular, shininess] | [specular, shininess, _]
                if specular.value <= 1.0 && shininess.value > 1.0 =>
            {
                self.highlight(arguments, draft);
            }
            [_, _] | [_, _, _] => self.numbers(arguments, draft),
            _ => {}
        }
        let mut is_value_of_last = false;
        for word in std::mem::take(&mut arguments.properties) {
            // The value of a property that is not known already.
            if std::mem::take(&mut is_value_of_last) && word.text.starts_with('"') {
                continue;
            }
            is_value_of_last = !self.property(&word, draft);
        }
    }

    /// Reads shininess, reflection, and whether it is checkered.
    fn numbers(&mut self, arguments: &mut Arguments<'_>, draft: &mut Draft) {
        let shininess = arguments.number(Argument::Shininess, [0.0, 1e6], draft);
        let reflection = arguments.number(Argument::Reflection, [0.0, 1.0], draft);
        self.shininess = shininess.as_ref().map(|found| found.value).filter(|value| *value > 0.0);
        self.reflection = reflection.map_or(0.0, |found| found.value);
        let is_checkered = !arguments.numbers_left().is_empty()
            && arguments
                .number(Argument::CheckerSize, [0.0, 1.0], draft)
                .is_some_and(|found| found.value > 0.0);
        self.checker = is_checkered.then(checker);
        if let Some(Spanned { span, .. }) = shininess {
            draft.note(&span, Message::NumbersAreFinish { element: arguments.name() }, None);
        }
    }

    /// Reads specular, shininess and perhaps reflection.
    fn highlight(&mut self, arguments: &mut Arguments<'_>, draft: &mut Draft) {
        let specular = arguments.number(Argument::Specular, [0.0, 1.0], draft);
        let shininess = arguments.number(Argument::Shininess, [0.0, 1e6], draft);
        self.shininess = shininess.map(|found| found.value);
        if !arguments.numbers_left().is_empty() {
            let reflection = arguments.number(Argument::Reflection, [0.0, 1.0], draft);
            self.reflection = reflection.map_or(0.0, |found| found.value);
        }
        if let Some(Spanned { value, span }) = specular {
            self.specular = Some(value);
            draft.note(&span, Message::NumbersAreHighlight { element: arguments.name() }, None);
        }
    }

    /// Reads `name=value`; whether the name is known.
    fn property(&mut self, word: &Word<'_>, draft: &mut Draft) -> bool {
        let (name, value) = name_and_value(word.text);
        let at = word.span.end - value.len();
        let span = if value.is_empty() { word.span.clone() } else { at..word.span.end };
        match Property::of_name(name) {
            Some(Property::Specular) => {
                self.specular = quantity(value, &span, Argument::Specular, [0.0, 1.0], draft);
            }
            Some(Property::Shininess) => {
                self.shininess = quantity(value, &span, Argument::Shininess, [0.0, 1e6], draft);
            }
            Some(Property::Reflection) => {
                let found = quantity(value, &span, Argument::Reflection, [0.0, 1.0], draft);
                self.reflection = found.unwrap_or_default();
            }
            Some(Property::Checker) => self.checker = read_checker(value, &span, draft),
            None => {
                let name = name.to_owned();
                draft.unsupported(&word.span, Message::UnknownProperty { name }, Message::LeftOut);
                return false;
            }
        }
        true
    }

    /// The material of a body of this color: `specular` and `shininess` need each other, and reflection takes the place
    /// of the body's own light unless the dialect adds it.
    pub(super) fn material(&self, color: Color, dialect: Dialect) -> Material {
        let own = if dialect.has_added_reflection { 1.0 } else { 1.0 - self.reflection };
        let default = Phong::default();
        let specular = self.specular.unwrap_or(if self.shininess.is_some() { HIGHLIGHT } else { 0.0 });
        Material::Phong(Phong {
            pattern: Pattern { solid: self.checker.clone(), ..Pattern::from(color) },
            ambient: own,
            diffuse: own,
            specular,
            shininess: self.shininess.unwrap_or(default.shininess),
            reflection: Some(self.reflection),
            ..default
        })
    }

    pub(super) fn reflects(&self) -> bool {
        self.reflection > 0.0
    }

    pub(super) fn is_checkered(&self) -> bool {
        self.checker.is_some()
    }

    pub(super) fn has_highlight(&self) -> bool {
        self.specular.or(self.shininess).is_some()
    }
}

fn checker() -> SolidTexture {
    SolidTexture { space: PatternSpace::Body, ..SolidTexture::default() }
}

/// `R,G,B`, `R,G,B:size`, or nothing.
fn read_checker(value: &str, span: &Range<usize>, draft: &mut Draft) -> Option<SolidTexture> {
    let mut checker = checker();
    if value.is_empty() {
        return Some(checker);
    }
    let (codes, size) = value.split_once(':').map_or((value, None), |(codes, size)| (codes, Some(size)));
    let numbers: Vec<f64> = codes.split(',').take(4).filter_map(number).collect();
    let &[r, g, b] = numbers.as_slice() else {
        draft.refuse(span, Message::CheckerIs, None);
        return None;
    };
    checker.color = color(DVec3::new(r, g, b), span, draft)?;
    if let Some(size) = size {
        checker.size = quantity(size, span, Argument::CheckerSize, [1e-9, 1e9], draft)?;
    }
    Some(checker)
}

fn quantity(
    value: &str,
    span: &Range<usize>,
    argument: Argument,
    [low, high]: [f64; 2],
    draft: &mut Draft,
) -> Option<f64> {
    match number(value) {
        Some(value) if (low..=high).contains(&value) => Some(value),
        Some(value) => {
            draft.refuse(span, out_of_range(argument, value, [low, high]), None);
            None
        }
        None => {
            draft.refuse(span, Message::NotANumber { word: value.to_owned() }, None);
            None
        }
    }
}
