//! The texts of the studio, in the languages of its catalogues (`texts/en`, `texts/ru`, one file a topic).

use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};

use fluent_bundle::{FluentArgs, FluentBundle, FluentError, FluentResource, FluentValue};
use serde::{Deserialize, Serialize};
use unic_langid::LanguageIdentifier;

/// A language of the studio.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// English, the default.
    #[default]
    English,
    /// Russian.
    Russian,
}

/// The catalogues of a language: the topic (the file's name) and its text.
macro_rules! catalogues {
    ($folder:literal) => {
        &[
            ("general", include_str!(concat!("../../texts/", $folder, "/general.ftl"))),
            ("commands", include_str!(concat!("../../texts/", $folder, "/commands.ftl"))),
            ("inspector", include_str!(concat!("../../texts/", $folder, "/inspector.ftl"))),
            ("materials", include_str!(concat!("../../texts/", $folder, "/materials.ftl"))),
            ("viewport", include_str!(concat!("../../texts/", $folder, "/viewport.ftl"))),
            ("outliner", include_str!(concat!("../../texts/", $folder, "/outliner.ftl"))),
            ("document", include_str!(concat!("../../texts/", $folder, "/document.ftl"))),
            ("edits", include_str!(concat!("../../texts/", $folder, "/edits.ftl"))),
            ("method", include_str!(concat!("../../texts/", $folder, "/method.ftl"))),
            ("compare", include_str!(concat!("../../texts/", $folder, "/compare.ftl"))),
            ("measure", include_str!(concat!("../../texts/", $folder, "/measure.ftl"))),
            ("render", include_str!(concat!("../../texts/", $folder, "/render.ftl"))),
            ("audit", include_str!(concat!("../../texts/", $folder, "/audit.ftl"))),
            ("lab", include_str!(concat!("../../texts/", $folder, "/lab.ftl"))),
            ("help", include_str!(concat!("../../texts/", $folder, "/help.ftl"))),
        ]
    };
}

impl Language {
    /// All languages, in the order in which to offer them.
    pub const ALL: [Self; 2] = [Self::English, Self::Russian];

    /// The language's name in itself.
    pub const fn own_name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::Russian => "Русский",
        }
    }

    /// The two letters of the language's code, in capitals.
    pub const fn letters(self) -> &'static str {
        match self {
            Self::English => "EN",
            Self::Russian => "RU",
        }
    }

    /// The language that the system asks for; English when it is another one.
    pub fn of_system() -> Self {
        Self::of_locale(&sys_locale::get_locale().unwrap_or_default())
    }

    /// The language for a locale such as `ru-RU`; English when it is another one.
    pub fn of_locale(locale: &str) -> Self {
        if locale.to_lowercase().starts_with("ru") { Self::Russian } else { Self::English }
    }

    /// The sign before decimals.
    pub(crate) const fn decimal_sign(self) -> DecimalSign {
        match self {
            Self::English => DecimalSign::Point,
            Self::Russian => DecimalSign::Comma,
        }
    }

    fn identifier(self) -> LanguageIdentifier {
        let code = match self {
            Self::English => "en",
            Self::Russian => "ru",
        };
        code.parse().unwrap_or_default()
    }

    /// The topics and texts of the language's catalogues.
    pub(crate) const fn catalogues(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::English => catalogues!("en"),
            Self::Russian => catalogues!("ru"),
        }
    }
}

/// The language of what the document says of itself.
impl From<Language> for catoptric_scene::Language {
    fn from(language: Language) -> Self {
        match language {
            Language::English => Self::English,
            Language::Russian => Self::Russian,
        }
    }
}

/// The sign that a language writes before decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DecimalSign {
    Point,
    Comma,
}

/// The messages of one language.
pub struct Texts {
    language: Language,
    bundle: FluentBundle<FluentResource>,
    /// Messages without arguments, formatted once; attributes as `message.attribute`.
    plain: HashMap<String, String>,
    missing: RefCell<BTreeSet<String>>,
}

impl Texts {
    /// Reads the catalogues of `language`.
    pub fn new(language: Language) -> Self {
        let mut bundle = FluentBundle::new(vec![language.identifier()]);
        bundle.set_use_isolating(false);
        let mut ids = Vec::new();
        for (_, text) in language.catalogues() {
            // A damaged message is left out; a test sees to it that there is none.
            let resource = match FluentResource::try_new((*text).to_owned()) {
                Ok(resource) | Err((resource, _)) => resource,
            };
            ids.extend(message_ids(&resource));
            bundle.add_resource_overriding(resource);
        }
        let plain = plain_messages(&bundle, &ids);
        Self { language, bundle, plain, missing: RefCell::default() }
    }

    /// The language.
    pub fn language(&self) -> Language {
        self.language
    }

    /// A number that was written with a decimal point, as the language writes it.
    pub(crate) fn localized(&self, number: String) -> String {
        match self.language.decimal_sign() {
            DecimalSign::Point => number,
            DecimalSign::Comma => number.replace('.', ","),
        }
    }

    /// The message `key`, which takes no arguments; the key itself if there is none.
    pub fn get<'a>(&'a self, key: &'a str) -> &'a str {
        self.plain.get(key).map_or_else(
            || {
                self.missing.borrow_mut().insert(key.to_owned());
                key
            },
            String::as_str,
        )
    }

    /// The explanation that goes with `key` (its attribute `.tip`), if there is one.
    pub fn tip(&self, key: &str) -> Option<&str> {
        self.plain.get(&format!("{key}.tip")).map(String::as_str)
    }

    /// The message `key` with its arguments filled in.
    pub fn with(&self, key: &str, arguments: &[(&'static str, FluentValue<'_>)]) -> String {
        let pattern = self.bundle.get_message(key).and_then(|message| message.value());
        let Some(pattern) = pattern else {
            self.missing.borrow_mut().insert(key.to_owned());
            return key.to_owned();
        };
        let mut filled = FluentArgs::new();
        for (name, value) in arguments {
            filled.set(*name, value.clone());
        }
        let mut errors: Vec<FluentError> = Vec::new();
        let text = self.bundle.format_pattern(pattern, Some(&filled), &mut errors).into_owned();
        if !errors.is_empty() {
            self.missing.borrow_mut().insert(format!("{key}: {errors:?}"));
        }
        text
    }

    /// The keys that were asked for and are not in the catalogues: for tests.
    pub fn missing(&self) -> Vec<String> {
        self.missing.borrow().iter().cloned().collect()
    }
}

/// The messages of a catalogue, and their attributes.
fn message_ids(resource: &FluentResource) -> Vec<(String, Vec<String>)> {
    use fluent_syntax::ast::Entry;
    resource
        .entries()
        .filter_map(|entry| match entry {
            Entry::Message(message) => {
                let attributes = message.attributes.iter().map(|attribute| attribute.id.name.to_owned());
                Some((message.id.name.to_owned(), attributes.collect()))
            }
            _ => None,
        })
        .collect()
}

fn plain_messages(
    bundle: &FluentBundle<FluentResource>,
    ids: &[(String, Vec<String>)],
) -> HashMap<String, String> {
    let mut plain = HashMap::new();
    for (id, attributes) in ids {
        let Some(message) = bundle.get_message(id) else { continue };
        let mut keep = |key: String, pattern| {
            let mut errors = Vec::new();
            let text = bundle.format_pattern(pattern, None, &mut errors);
            if errors.is_empty() {
                plain.insert(key, text.into_owned());
            }
        };
        if let Some(pattern) = message.value() {
            keep(id.clone(), pattern);
        }
        for attribute in attributes {
            if let Some(found) = message.get_attribute(attribute) {
                keep(format!("{id}.{attribute}"), found.value());
            }
        }
    }
    plain
}

#[cfg(test)]
mod tests;
