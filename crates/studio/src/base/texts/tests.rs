//! The catalogues against each other, and against the code that asks for their messages.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::*;

/// A message or attribute: its text and the variables in it.
#[derive(Debug)]
struct TextItem {
    text: String,
    variables: BTreeSet<String>,
}

/// All messages of a language; attributes as `message.attribute`.
fn entries(language: Language) -> BTreeMap<String, TextItem> {
    let mut entries: BTreeMap<String, TextItem> = BTreeMap::new();
    for (topic, text) in language.catalogues() {
        let (mut message, mut key) = (String::new(), String::new());
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let (name, start) = line.split_once('=').map_or(("", line), |(name, start)| (name.trim(), start));
            let is_message = !line.starts_with(' ') && !name.is_empty();
            let attribute = name.strip_prefix('.').filter(|_| line.starts_with(' '));
            let added = if is_message {
                message = name.to_owned();
                key.clone_from(&message);
                start
            } else if let Some(attribute) = attribute {
                key = format!("{message}.{attribute}");
                start
            } else {
                line
            };
            if is_message || attribute.is_some() {
                let empty = TextItem { text: String::new(), variables: BTreeSet::new() };
                assert!(entries.insert(key.clone(), empty).is_none(), "{topic}: {key} stands twice");
            }
            if let Some(entry) = entries.get_mut(&key) {
                entry.text.push_str(added);
                entry.variables.extend(variables(added));
            }
        }
    }
    entries
}

fn variables(text: &str) -> Vec<String> {
    let name = |part: &str| part.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
    text.split('$').skip(1).map(name).collect()
}

/// What a person reads of a message: without what is filled in.
fn visible(text: &str) -> String {
    let mut depth = 0;
    let mut out = String::new();
    for letter in text.chars() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            letter if depth == 0 => out.push(letter),
            _ => {}
        }
    }
    out
}

fn is_cyrillic(letter: char) -> bool {
    ('а'..='я').contains(&letter.to_lowercase().next().unwrap_or(letter)) || letter == 'ё'
}

/// The sources of a crate, tests left out.
fn sources(folder: &Path, into: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            sources(&path, into);
        } else if name.ends_with(".rs") && name != "tests.rs" {
            let text = std::fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().to_owned();
            into.push((path.display().to_string(), code));
        }
    }
}

fn code() -> Vec<(String, String)> {
    let studio = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all = Vec::new();
    sources(&studio.join("src"), &mut all);
    sources(&studio.join("../editor/src"), &mut all);
    all
}

/// The string literals of a source with what stands before them; comments are left out.
fn literals(code: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for line in code.lines().filter(|line| !line.trim_start().starts_with("//")) {
        // A quotation mark as a character would turn everything around.
        let line = line.replace("'\"'", "' '").replace("\\\"", "  ");
        let mut parts = line.split('"');
        let mut before = parts.next().unwrap_or_default().to_owned();
        while let (Some(literal), after) = (parts.next(), parts.next()) {
            found.push((before.clone(), literal.to_owned()));
            before = after.unwrap_or_default().to_owned();
        }
    }
    found
}

#[test]
fn every_catalogue_can_be_read() {
    for language in Language::ALL {
        for (topic, text) in language.catalogues() {
            if let Err((_, errors)) = FluentResource::try_new((*text).to_owned()) {
                panic!("{language:?} {topic}: {errors:?}");
            }
        }
    }
}

#[test]
fn both_languages_say_the_same() {
    let (english, russian) = (entries(Language::English), entries(Language::Russian));
    let missing = |there: &BTreeMap<String, TextItem>, here: &BTreeMap<String, TextItem>| {
        there.keys().filter(|key| !here.contains_key(*key)).cloned().collect::<Vec<_>>()
    };
    assert_eq!(missing(&english, &russian), Vec::<String>::new(), "missing in Russian");
    assert_eq!(missing(&russian, &english), Vec::<String>::new(), "missing in English");
    for (key, entry) in &english {
        assert_eq!(entry.variables, russian[key].variables, "{key}");
    }
    let topics =
        |language: Language| language.catalogues().iter().map(|(topic, _)| *topic).collect::<Vec<_>>();
    assert_eq!(topics(Language::English), topics(Language::Russian));
}

#[test]
fn each_language_is_written_in_its_letters() {
    // The languages name themselves in themselves.
    let own = ["command-language-english", "command-language-russian"];
    for (key, entry) in entries(Language::English).iter().filter(|(key, _)| !own.contains(&key.as_str())) {
        assert!(!entry.text.chars().any(is_cyrillic), "{key}: {}", entry.text);
    }
    for (key, entry) in entries(Language::Russian).iter().filter(|(key, _)| !own.contains(&key.as_str())) {
        let text = visible(&entry.text);
        let is_word = |word: &str| word.chars().filter(char::is_ascii_lowercase).count() >= 4;
        let has_words =
            text.split(|c: char| !c.is_ascii_alphabetic()).any(|word| is_word(word) && word != "Catoptric");
        assert!(!has_words || text.chars().any(is_cyrillic), "{key}: {text}");
        assert!(!text.contains('"') && !text.contains(" - "), "typographic signs, please: {key}: {text}");
    }
}

#[test]
fn everything_the_code_asks_for_is_there() {
    let english = entries(Language::English);
    let families: BTreeSet<&str> = [
        "about", "command", "edit", "first", "gesture", "group", "history", "menu", "name", "outliner",
        "palette", "pane", "refused", "status", "glossary",
    ]
    .into();
    let asks = ["texts.get(", "cx.t(", "texts.with(", "texts\n.get("];
    for (file, code) in code() {
        for (before, literal) in literals(&code) {
            let is_asked = asks.iter().any(|ask| before.ends_with(ask));
            let is_key = literal.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-');
            let family = literal.split_once('-').map(|(family, _)| family);
            let is_family = is_key && family.is_some_and(|family| families.contains(family));
            if is_asked || is_family {
                let tip = format!("{literal}.tip");
                assert!(english.contains_key(&literal) || english.contains_key(&tip), "{file}: {literal}");
            }
            if before.ends_with("texts.tip(") {
                assert!(english.contains_key(&format!("{literal}.tip")), "{file}: {literal}.tip");
            }
        }
    }
}

#[test]
fn every_command_and_term_is_explained() {
    let english = entries(Language::English);
    for key in english.keys().filter(|key| key.starts_with("command-") || key.starts_with("glossary-")) {
        let message = key.split('.').next().unwrap_or_default();
        assert!(english.contains_key(&format!("{message}.tip")), "{message}");
    }
}

#[test]
fn no_message_is_left_over() {
    let used: BTreeSet<String> =
        code().iter().flat_map(|(_, code)| literals(code)).map(|(_, literal)| literal).collect();
    let unused: Vec<String> = entries(Language::English)
        .into_keys()
        .filter(|key| !key.contains('.') && !used.contains(key))
        // Those that the tables of optics name.
        .filter(|key| !key.starts_with("substance-") && !key.starts_with("metal-"))
        .collect();
    assert_eq!(unused, Vec::<String>::new());
}

#[test]
fn nothing_that_is_seen_stands_in_the_code() {
    let calls = [
        "label(",
        "button(",
        "heading(",
        "strong(",
        "weak(",
        "small(",
        "on_hover_text(",
        "hint_text(",
        "RichText::new(",
        "accessible_name(",
        "toasts.info(",
        "toasts.success(",
        "toasts.warning(",
        "toasts.error(",
        "monospace(",
    ];
    for (file, code) in code() {
        for (before, literal) in literals(&code) {
            let is_shown = calls.iter().any(|call| before.ends_with(call));
            assert!(!is_shown || !literal.chars().any(char::is_alphabetic), "{file}: {literal}");
        }
    }
}

#[test]
fn numbers_are_counted_as_the_language_does() {
    let russian = Texts::new(Language::Russian);
    let bodies = |count: usize| russian.with("status-bodies", &[("count", count.into())]);
    assert_eq!([1, 3, 5, 21].map(bodies), ["1 тело", "3 тела", "5 тел", "21 тело"]);
    assert_eq!(russian.missing(), Vec::<String>::new());
}
