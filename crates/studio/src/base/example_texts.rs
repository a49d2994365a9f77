//! The titles of the examples.

use catoptric_scene::Example;

use crate::base::texts::Language;

/// The example's title in a language.
pub(crate) fn example_title(example: &Example, language: Language) -> &'static str {
    match language {
        Language::English => example.title(),
        Language::Russian => example.russian_title(),
    }
}
