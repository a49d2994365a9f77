//! Writes scenes in the canonical form: the same bytes for the same scene.

use crate::Scene;
use crate::format::keys;
use crate::format::material;
use crate::format::number::push_number;
use crate::format::record::{self, Datum, Record};
use crate::text::{is_active, push_escape};

/// The canonical text of a scene.
///
/// Keys at their default are left out but for the few that tell what a table is about. Reading the text gives the scene
/// back, provided that [`Scene::check`] has nothing against it.
///
/// ```
/// let scene = catoptric_scene::Scene::default();
/// let text = catoptric_scene::write(&scene);
/// assert_eq!(catoptric_scene::read(&text).scene, scene);
/// ```
pub fn write(scene: &Scene) -> String {
    let mut out = String::with_capacity(512 + 160 * scene.bodies.len());
    push_version(&mut out);
    push_section(&mut out, "[camera]", &record::camera(&scene.camera));
    push_section(&mut out, "[environment]", &record::environment(&scene.environment));
    push_section(&mut out, "[tracing]", &record::tracing(&scene.tracing));
    push_lists(&mut out, scene);
    out
}

/// The bodies, lights and materials of a scene as a scene file of their own, without camera, environment and tracing:
/// what a clipboard carries.
pub fn write_fragment(scene: &Scene) -> String {
    let mut out = String::with_capacity(64 + 160 * scene.bodies.len());
    push_version(&mut out);
    push_lists(&mut out, scene);
    out
}

fn push_version(out: &mut String) {
    let version = keys::VERSIONS.last().copied().unwrap_or_default();
    push_key_text(out, "format", version);
}

fn push_lists(out: &mut String, scene: &Scene) {
    for named in &scene.materials {
        let header = format!("[materials.{}]", key_text(&named.name));
        push_section(out, &header, &material::record(&named.material));
    }
    for light in &scene.lights {
        push_section(out, "[[lights]]", &record::light(light));
    }
    for body in &scene.bodies {
        push_section(out, "[[bodies]]", &record::body(body));
    }
}

fn push_key_text(out: &mut String, key: &str, text: &str) {
    out.push_str(key);
    out.push_str(" = ");
    push_text(out, text);
    out.push('\n');
}

/// A blank line, the header and the keys of a table, then the elements of its lists.
fn push_section(out: &mut String, header: &str, record: &Record<'_>) {
    out.push('\n');
    out.push_str(header);
    out.push('\n');
    let mut lists = Vec::new();
    for (key, datum) in record.written() {
        if let Datum::Tables(elements) = datum {
            lists.push((key, elements));
            continue;
        }
        out.push_str(key);
        out.push_str(" = ");
        push_datum(out, datum);
        out.push('\n');
    }
    let name = header.trim_matches(['[', ']']);
    for (key, elements) in lists {
        let header = format!("[[{name}.{key}]]");
        elements.iter().for_each(|element| push_section(out, &header, element));
    }
}

/// Appends a value as TOML.
pub(super) fn push_datum(out: &mut String, datum: &Datum<'_>) {
    match datum {
        Datum::Number(value) => push_number(out, *value),
        Datum::Integer(value) => out.push_str(&value.to_string()),
        Datum::Text(text) => push_text(out, text),
        Datum::Flag(flag) => out.push_str(if *flag { "true" } else { "false" }),
        Datum::Vector(values) => {
            for (index, value) in values.iter().enumerate() {
                out.push_str(if index == 0 { "[" } else { ", " });
                push_number(out, *value);
            }
            out.push(']');
        }
        Datum::Tables(records) => {
            for (index, record) in records.iter().enumerate() {
                out.push_str(if index == 0 { "[" } else { ", " });
                push_table(out, record);
            }
            out.push_str(if records.is_empty() { "[]" } else { "]" });
        }
        Datum::Table(record) => push_table(out, record),
    }
}

/// Appends an inline table.
fn push_table(out: &mut String, record: &Record<'_>) {
    let mut is_empty = true;
    for (key, datum) in record.written() {
        out.push_str(if is_empty { "{ " } else { ", " });
        is_empty = false;
        out.push_str(key);
        out.push_str(" = ");
        push_datum(out, datum);
    }
    out.push_str(if is_empty { "{}" } else { " }" });
}

/// A name as a key: bare where it can be.
pub(super) fn key_text(name: &str) -> String {
    let is_bare = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    if !name.is_empty() && name.bytes().all(is_bare) {
        return name.to_owned();
    }
    text_value(name)
}

/// A text as a value.
pub(super) fn text_value(text: &str) -> String {
    let mut out = String::new();
    push_text(&mut out, text);
    out
}

/// Appends a basic string (TOML 1.0, "String").
fn push_text(out: &mut String, text: &str) {
    out.push('"');
    for character in text.chars() {
        match character {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            // TOML demands it of some; of the others, so that printing the file does nothing but show it.
            active if is_active(active) => push_escape(out, active),
            _ => out.push(character),
        }
    }
    out.push('"');
}
