//! The JSON schema of the format, for editors that complete and check TOML.

use serde_json::{Map, Value, json};

use crate::format::keys;
use crate::format::spec::{Default, KeySpec, Kind, Limits, TableSpec, When};

/// The schema (draft 7) of scene files, made from the table of the format.
pub fn json_schema() -> Value {
    let mut schema = Map::new();
    schema.insert("$schema".to_owned(), json!("http://json-schema.org/draft-07/schema#"));
    schema.insert("title".to_owned(), json!("Catoptric scene, catoptric/1"));
    schema.extend(table(&keys::ROOT));
    schema.insert("required".to_owned(), json!(["format"]));
    let definitions = json!({
        "part": table(&keys::PART),
        "pattern": table(&keys::PATTERN),
        "nested": table(&keys::NESTED_PATTERN),
    });
    schema.insert("definitions".to_owned(), definitions);
    Value::Object(schema)
}

fn table(spec: &'static TableSpec) -> Map<String, Value> {
    let properties: Map<String, Value> =
        spec.keys.iter().map(|key| (key.name.to_owned(), property(key))).collect();
    let mut out = Map::new();
    out.insert("description".to_owned(), json!(spec.doc));
    out.insert("type".to_owned(), json!("object"));
    out.insert("properties".to_owned(), Value::Object(properties));
    out.insert("additionalProperties".to_owned(), json!(false));
    let conditions = conditions(spec);
    if !conditions.is_empty() {
        out.insert("allOf".to_owned(), Value::Array(conditions));
    }
    let dependencies: Map<String, Value> =
        spec.keys.iter().filter_map(|key| Some((key.name.to_owned(), dependency(key)?))).collect();
    if !dependencies.is_empty() {
        out.insert("dependencies".to_owned(), Value::Object(dependencies));
    }
    out
}

fn property(key: &'static KeySpec) -> Value {
    let mut out = kind(key.kind);
    let mut doc = key.doc.to_owned();
    if let Some(first) = doc.get(..1).map(str::to_uppercase) {
        doc.replace_range(..1, &first);
    }
    if let When::Choice { choice, values } = key.when {
        doc.push_str(&format!("; for {choice} {}", values.join(", ")));
    }
    if let Default::ByChoice(defaults) = key.default {
        let defaults: Vec<String> =
            defaults.iter().map(|(name, value)| format!("{value} for {name}")).collect();
        doc.push_str(&format!("; by default {}", defaults.join(", ")));
    }
    out.insert("description".to_owned(), json!(doc));
    let default = match (key.default, key.kind) {
        (Default::Number(value), Kind::Integer(_)) => Some(json!(value as u64)),
        (Default::Number(value), _) => Some(json!(value)),
        (Default::Vector(values), _) => Some(json!(values)),
        (Default::Text(text), _) => Some(json!(text)),
        (Default::Flag(flag), _) => Some(json!(flag)),
        _ => None,
    };
    if let Some(default) = default {
        out.insert("default".to_owned(), default);
    }
    Value::Object(out)
}

fn kind(kind: Kind) -> Map<String, Value> {
    let value = match kind {
        Kind::Version(words) | Kind::Choice(words) => json!({ "type": "string", "enum": words }),
        Kind::Text => json!({ "type": "string" }),
        Kind::File => json!({ "type": "string", "minLength": 1 }),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Number(limits) => number("number", limits),
        Kind::Integer(limits) => number("integer", limits),
        Kind::Vector(limits) => three(limits),
        Kind::NumberOrVector(limits) => json!({ "anyOf": [number("number", limits), three(limits)] }),
        Kind::Color(limits) => json!({
            "anyOf": [three(limits), { "type": "string", "pattern": "^#[0-9A-Fa-f]{6}$" }]
        }),
        // Patterns have patterns.
        Kind::Table(spec) if *spec == keys::PATTERN => json!({ "$ref": "#/definitions/pattern" }),
        Kind::Table(spec) if *spec == keys::NESTED_PATTERN => json!({ "$ref": "#/definitions/nested" }),
        Kind::Table(spec) => Value::Object(table(spec)),
        Kind::NameOrTable(spec) => json!({
            "anyOf": [{ "type": "string", "minLength": 1 }, Value::Object(table(spec))]
        }),
        Kind::Named(spec) => json!({
            "type": "object",
            "propertyNames": { "minLength": 1 },
            "additionalProperties": Value::Object(table(spec)),
        }),
        // Parts have parts.
        Kind::List(spec) if *spec == keys::PART => {
            json!({ "type": "array", "items": { "$ref": "#/definitions/part" }, "minItems": 1 })
        }
        Kind::List(spec) => json!({ "type": "array", "items": Value::Object(table(spec)) }),
    };
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

fn number(kind: &str, limits: Limits) -> Value {
    if kind == "integer" {
        return json!({ "type": kind, "minimum": limits.min as i64, "maximum": limits.max as i64 });
    }
    json!({ "type": kind, "minimum": limits.min, "maximum": limits.max })
}

fn three(limits: Limits) -> Value {
    json!({ "type": "array", "items": number("number", limits), "minItems": 3, "maxItems": 3 })
}

/// For every word of a choice: the keys that have no meaning with it, and the lists that it needs.
fn conditions(spec: &'static TableSpec) -> Vec<Value> {
    let mut out = Vec::new();
    for choice in spec.keys {
        let Kind::Choice(words) = choice.kind else { continue };
        for &word in words {
            let forbidden: Vec<Value> = spec
                .keys
                .iter()
                .filter(|key| !key.applies(|name| (name == choice.name).then_some(word)))
                .map(|key| json!({ "required": [key.name] }))
                .collect();
            let is_required =
                |key: &&KeySpec| matches!(key.kind, Kind::List(_)) && key.belongs_to(choice.name, word);
            let required: Vec<&str> = spec.keys.iter().filter(is_required).map(|key| key.name).collect();
            if forbidden.is_empty() && required.is_empty() {
                continue;
            }
            let is_default = matches!(choice.default, Default::Text(default) if default == word);
            let mut condition = json!({ "properties": { choice.name: { "const": word } } });
            if let (Value::Object(condition), false) = (&mut condition, is_default) {
                condition.insert("required".to_owned(), json!([choice.name]));
            }
            // An empty list of alternatives is no schema.
            let then = match (forbidden.is_empty(), required.is_empty()) {
                (false, true) => json!({ "not": { "anyOf": forbidden } }),
                (true, _) => json!({ "required": required }),
                (false, false) => json!({ "required": required, "not": { "anyOf": forbidden } }),
            };
            out.push(json!({ "if": condition, "then": then }));
        }
    }
    out
}

/// The keys that must and must not stand beside `key`.
fn dependency(key: &KeySpec) -> Option<Value> {
    if key.requires.is_none() && key.excludes.is_empty() {
        return None;
    }
    let required: Vec<&str> = key.requires.into_iter().collect();
    let excluded: Vec<Value> = key.excludes.iter().map(|other| json!({ "required": [other] })).collect();
    // An empty list of alternatives is no schema.
    Some(match excluded.is_empty() {
        true => json!({ "required": required }),
        false => json!({ "required": required, "not": { "anyOf": excluded } }),
    })
}
