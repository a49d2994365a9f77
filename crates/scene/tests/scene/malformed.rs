//! Every `malformed/*.toml` gives exactly the findings in the `.txt` beside it.
//! `BLESS=1 cargo test -p catoptric-scene` rewrites them.

use std::fs;
use std::path::{Path, PathBuf};

use catoptric_scene::{Diagnostic, Language};

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/malformed");
    let mut cases: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    cases.sort();
    cases
}

#[test]
fn findings_are_as_expected() {
    let bless = std::env::var_os("BLESS").is_some();
    let mut failures = String::new();
    for path in cases() {
        let name = path.file_name().unwrap().to_str().unwrap();
        let (reading, text) = catoptric_scene::read_bytes(fs::read(&path).unwrap());
        let found = reading.diagnostics.render(name, &text, false);
        assert!(!reading.diagnostics.is_empty(), "{name}: nothing was found");
        let expected_path = path.with_extension("txt");
        if bless {
            fs::write(&expected_path, &found).unwrap();
            continue;
        }
        let expected = fs::read_to_string(&expected_path).unwrap_or_default();
        if expected != found {
            failures.push_str(&format!("{name}: expected\n{expected}\nfound\n{found}\n"));
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

/// What a finding says in a language: its message, label, help and note.
fn texts(finding: &Diagnostic, language: Language) -> Vec<String> {
    let note = finding.related.as_ref().map(|related| related.message(language));
    let others = [finding.label(language), finding.help(language), note];
    std::iter::once(finding.message(language)).chain(others.into_iter().flatten()).collect()
}

/// The parts of a text between two of the same quotes, and the rest.
fn split(text: &str, quote: char) -> (Vec<&str>, String) {
    let parts: Vec<&str> = text.split(quote).collect();
    let quoted = parts.iter().skip(1).step_by(2).copied().collect();
    (quoted, parts.iter().step_by(2).copied().collect::<Vec<_>>().join(" "))
}

/// Latin words that are neither repeated from the file nor names of what has no Russian one.
fn latin_words(text: &str) -> Vec<String> {
    let (_, rest) = split(text, '`');
    let (_, rest) = split(&rest, '"');
    let words = rest.split(|character: char| !character.is_alphanumeric());
    let is_prose = |word: &&str| {
        word.len() > 1
            && word.chars().all(|letter| letter.is_ascii_alphabetic())
            && !["UTF", "TOML", "sRGB"].contains(word)
    };
    words.filter(is_prose).map(str::to_owned).collect()
}

#[test]
fn every_finding_is_told_in_russian() {
    let mut seen = 0;
    for path in cases() {
        let (reading, _) = catoptric_scene::read_bytes(fs::read(&path).unwrap());
        for finding in &reading.diagnostics {
            let (english, russian) = (texts(finding, Language::English), texts(finding, Language::Russian));
            assert_eq!(english.len(), russian.len());
            for (english, russian) in english.iter().zip(&russian) {
                seen += 1;
                let place = format!("{}:{}: {russian}", path.display(), finding.line);
                assert_ne!(english, russian, "{place}");
                assert_eq!(latin_words(russian), Vec::<String>::new(), "{place}");
                assert!(!russian.contains("синтаксис TOML"), "{place}");
                // Keys and values are repeated in both; examples may have words of the language in them.
                let (told, repeated) = (split(english, '`').0, split(russian, '`').0);
                if !repeated.iter().any(|part| part.contains(is_russian)) {
                    assert!(told.iter().all(|part| repeated.contains(part)), "{place}");
                }
            }
        }
    }
    assert!(seen > 300, "only {seen} texts were seen");
}

fn is_russian(letter: char) -> bool {
    matches!(letter, 'а'..='я' | 'А'..='Я' | 'ё')
}
