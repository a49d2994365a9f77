//! Brings the text of a file up to date with an edited scene, touching only what the edit touched.

mod edit;
mod matching;

use toml_edit::{ArrayOfTables, DocumentMut, Item, Table};

use crate::Scene;
use crate::format::material;
use crate::format::read::read;
use crate::format::record::{self, Record};
use crate::format::write::write;
use edit::{apply, elements, keep_in_order, new_table};
use matching::{MatchedElement, matches};

/// Longer texts are written anew: an editable tree of them would take gigabytes.
const LONGEST_EDITED: usize = 16 << 20;

/// The tables of the root in the order of writing.
const ORDER: [&str; 6] = ["camera", "environment", "tracing", "materials", "lights", "bodies"];

/// The text of a scene that was read from `original_text` and edited since. What the edit did not touch stays as it is
/// written there: comments, order, notation. A text that says the same as `scene` comes back byte for byte; one that
/// has errors is replaced by what [`write()`] gives, and so is one of more than 16 MiB, but for the comment at its
/// beginning.
pub fn update(original_text: &str, scene: &Scene) -> String {
    let Ok(original) = read(original_text).into_result() else { return write(scene) };
    let original = original.value;
    if say_the_same(&original, scene) {
        return original_text.to_owned();
    }
    edited(original_text, &original, scene)
        .unwrap_or_else(|| format!("{}{}", heading(original_text), write(scene)))
}

/// The comments and blank lines at the beginning of a text.
fn heading(text: &str) -> String {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let is_comment = |line: &&str| line.trim_start().starts_with('#') || line.trim().is_empty();
    text.lines().take_while(is_comment).flat_map(|line| [line, "\n"]).collect()
}

/// The edited text, provided that it says what it should.
fn edited(text: &str, original: &Scene, scene: &Scene) -> Option<String> {
    if text.len() > LONGEST_EDITED {
        return None;
    }
    let mut document: DocumentMut = text.parse().ok()?;
    table(&mut document, "camera", &record::camera(&original.camera), &record::camera(&scene.camera))?;
    let environments = (record::environment(&original.environment), record::environment(&scene.environment));
    table(&mut document, "environment", &environments.0, &environments.1)?;
    table(&mut document, "tracing", &record::tracing(&original.tracing), &record::tracing(&scene.tracing))?;
    materials(&mut document, original, scene)?;
    let lights: Vec<Record<'_>> = original.lights.iter().map(record::light).collect();
    list(&mut document, "lights", &lights, &scene.lights.iter().map(record::light).collect::<Vec<_>>())?;
    let bodies: Vec<Record<'_>> = original.bodies.iter().map(record::body).collect();
    list(&mut document, "bodies", &bodies, &scene.bodies.iter().map(record::body).collect::<Vec<_>>())?;
    let mut out = document.to_string();
    if text.contains("\r\n") {
        out = out.replace("\r\n", "\n").replace('\n', "\r\n");
    }
    let reading = read(&out).into_result().ok()?;
    say_the_same(&reading.value, scene).then_some(out)
}

/// Whether two scenes have the same text. The unused height of a body on an axis is no part of it.
fn say_the_same(a: &Scene, b: &Scene) -> bool {
    let same_bodies = || {
        a.bodies.len() == b.bodies.len()
            && a.bodies.iter().zip(&b.bodies).all(|(a, b)| a == b || record::body(a) == record::body(b))
    };
    a.camera == b.camera
        && a.environment == b.environment
        && a.tracing == b.tracing
        && a.materials == b.materials
        && a.lights == b.lights
        && same_bodies()
}

/// Edits one table of the root.
fn table(document: &mut DocumentMut, key: &str, old: &Record<'_>, new: &Record<'_>) -> Option<()> {
    if old == new {
        return Some(());
    }
    if let Some(item) = document.get_mut(key) {
        return apply(item, old, new);
    }
    let mut table = new_table(new);
    table.set_position(Some(place_before(document, key)));
    document.insert(key, Item::Table(table));
    Some(())
}

/// The position of the last table that is written before the tables of `key`.
fn place_before(document: &DocumentMut, key: &str) -> isize {
    let before = ORDER.iter().take_while(|other| **other != key);
    before.filter_map(|other| last_position(document.get(other)?)).max().unwrap_or(-1)
}

/// The position of the last header in an item.
fn last_position(item: &Item) -> Option<isize> {
    match item {
        Item::Table(table) => {
            let inner = table.iter().filter_map(|(_, item)| last_position(item)).max();
            inner.max(table.position())
        }
        Item::ArrayOfTables(tables) => tables
            .iter()
            .filter_map(|table| {
                table.iter().filter_map(|(_, item)| last_position(item)).max().max(table.position())
            })
            .max(),
        _ => None,
    }
}

/// Edits the materials: keys of one table.
fn materials(document: &mut DocumentMut, original: &Scene, scene: &Scene) -> Option<()> {
    let old: Vec<Record<'_>> =
        original.materials.iter().map(|named| material::record(&named.material)).collect();
    let new: Vec<Record<'_>> =
        scene.materials.iter().map(|named| material::record(&named.material)).collect();
    let old_names: Vec<&str> = original.materials.iter().map(|named| named.name.as_str()).collect();
    let new_names: Vec<&str> = scene.materials.iter().map(|named| named.name.as_str()).collect();
    if old_names == new_names {
        for ((name, old), new) in old_names.iter().zip(&old).zip(&new) {
            if old != new {
                let table = document.get_mut("materials")?.as_table_like_mut()?;
                apply(table.get_mut(name)?, old, new)?;
            }
        }
        return Some(());
    }
    let place = place_before(document, "materials");
    if document.get("materials").is_none() {
        let mut table = Table::new();
        table.set_implicit(true);
        document.insert("materials", Item::Table(table));
    }
    let table = document.get_mut("materials")?.as_table_mut()?;
    let old_entries: Vec<MatchedElement<'_>> =
        old_names.iter().zip(&old).map(|(name, record)| MatchedElement { name, record }).collect();
    let new_entries: Vec<MatchedElement<'_>> =
        new_names.iter().zip(&new).map(|(name, record)| MatchedElement { name, record }).collect();
    let matched = matches(&old_entries, &new_entries);
    let mut taken: Vec<Option<Item>> = old_names.iter().map(|name| table.remove(name)).collect();
    let mut last = Some(place);
    for ((name, new), from) in new_names.iter().zip(&new).zip(matched) {
        let kept = from.and_then(|index| Some((taken.get_mut(index)?.take()?, old.get(index)?)));
        let mut item = match kept {
            Some((mut item, old)) => {
                apply(&mut item, old, new)?;
                item
            }
            None => {
                let mut table = new_table(new);
                table.set_position(last);
                Item::Table(table)
            }
        };
        if let Item::Table(table) = &mut item {
            keep_in_order(table, &mut last);
        }
        table.insert(name, item);
    }
    if new_names.is_empty() && table.is_empty() {
        document.remove("materials");
    }
    Some(())
}

/// Edits a list of tables.
fn list(document: &mut DocumentMut, key: &str, old: &[Record<'_>], new: &[Record<'_>]) -> Option<()> {
    if old == new {
        return Some(());
    }
    if new.is_empty() {
        document.remove(key);
        return Some(());
    }
    let place = place_before(document, key);
    let list =
        document.as_table_mut().entry(key).or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
    elements(list, old, new, Some(place))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_text_keeps_its_heading() {
        let filler = "# filler\n".repeat(LONGEST_EDITED / 9 + 1);
        let text = format!("# A scene\n\nformat = 'catoptric/1'\n{filler}");
        let mut scene = Scene::default();
        assert_eq!(update(&text, &scene), text);
        scene.tracing.generations = 3;
        assert_eq!(update(&text, &scene), format!("# A scene\n\n{}", write(&scene)));
    }
}
