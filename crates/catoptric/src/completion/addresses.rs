//! Addresses of the scene on the line, and what can stand there.

use std::ffi::OsStr;

use catoptric_lab::measure::Parameter;
use catoptric_scene::format::spec::Kind;
use catoptric_scene::{Language, Scene, SceneKey, ScenePath, SceneValue};
use clap_complete::{CompletionCandidate, PathCompleter};

use super::line;

/// So many addresses are offered at most.
const MOST: usize = 200;

/// What `--set` can begin with: an address with `=` behind it, and behind that what can stand there.
pub(super) fn edits(current: &OsStr) -> Vec<CompletionCandidate> {
    let Some(typed) = current.to_str().map(unescaped) else { return Vec::new() };
    let Some(scene) = line::scene() else { return Vec::new() };
    if let Ok((path, rest)) = ScenePath::split(&typed)
        && let Some(value) = rest.strip_prefix('=')
    {
        let before = typed.get(..typed.len() - value.len()).unwrap_or_default();
        return values(&scene, &path, value).into_iter().map(|found| found.add_prefix(before)).collect();
    }
    let addresses = |key: &SceneKey| -> Vec<ScenePath> {
        // The numbers of a vector once it is typed.
        let is_typed = typed.starts_with(&key.path.to_string());
        let numbers = (0..3).filter(|_| is_typed).filter_map(|index| key.component(index));
        [key.path.clone()].into_iter().chain(numbers).collect()
    };
    let found = scene.completions(&typed, MOST, &addresses);
    found
        .into_iter()
        .map(|found| match found.key {
            Some(key) => described(CompletionCandidate::new(found.text + "="), &key),
            None => CompletionCandidate::new(found.text),
        })
        .collect()
}

/// What `--vary` can have behind its last comma: a parameter, or the address of a number or word.
pub(super) fn sweeps(current: &OsStr) -> Vec<CompletionCandidate> {
    let Some(typed) = current.to_str().map(unescaped) else { return Vec::new() };
    let (before, last) =
        typed.split_at_checked(typed.rfind(',').map_or(0, |at| at + 1)).unwrap_or(("", &typed));
    if last.contains('=') || last.starts_with(|first: char| first.is_ascii_digit() || first == '-') {
        return Vec::new();
    }
    let parameters = Parameter::ALL.map(Parameter::key).into_iter().filter(|key| key.starts_with(last));
    let mut found: Vec<CompletionCandidate> = parameters.map(CompletionCandidate::new).collect();
    if let Some(scene) = line::scene() {
        let addresses = scene.completions(last, MOST, &|key| match key.spec.kind {
            Kind::Choice(_) | Kind::Flag | Kind::NameOrTable(_) => vec![key.path.clone()],
            _ => key.numbers(),
        });
        found.extend(addresses.into_iter().map(|found| match found.key {
            Some(key) => described(CompletionCandidate::new(found.text + "="), &key),
            None => CompletionCandidate::new(found.text),
        }));
    }
    found.into_iter().map(|found| found.add_prefix(before)).collect()
}

/// What can stand at an address: the words of a choice, the names of materials, pictures, or what stands there.
fn values(scene: &Scene, path: &ScenePath, typed: &str) -> Vec<CompletionCandidate> {
    let Ok(key) = scene.key(path) else { return Vec::new() };
    let words: Vec<String> = match key.kind {
        Kind::File => {
            let files = PathCompleter::file();
            return clap_complete::engine::ValueCompleter::complete(&files, OsStr::new(typed));
        }
        Kind::Choice(words) => words.iter().map(|word| (*word).to_owned()).collect(),
        Kind::Flag => ["true", "false"].map(str::to_owned).to_vec(),
        Kind::NameOrTable(_) => scene.materials.iter().map(|named| named.name.clone()).collect(),
        _ => scene.get(path).ok().and_then(|value| short(&value)).into_iter().collect(),
    };
    super::begun(OsStr::new(typed), words.into_iter().take(MOST))
}

/// A number, or three, as a shell takes them without quotes.
fn short(value: &SceneValue) -> Option<String> {
    match value {
        SceneValue::Number(_) => Some(value.to_string()),
        SceneValue::Vector(_) => Some(value.to_string().replace(['[', ']', ' '], "")),
        SceneValue::Text(_) | SceneValue::Flag(_) => None,
    }
}

/// Says beside an address what stands there and what it means, in shells that show that.
fn described(candidate: CompletionCandidate, key: &SceneKey) -> CompletionCandidate {
    let value = key.value.as_ref().map(|value| format!("{value}: ")).unwrap_or_default();
    candidate.help(Some(format!("{value}{}", key.spec.meaning(Language::English)).into()))
}

/// A word without what a shell escapes in it; quotes stand around names.
fn unescaped(word: &str) -> String {
    word.replace("\\\"", "\"").replace("\\ ", " ")
}
