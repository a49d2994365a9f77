//! Changes the keys of one table of an editable document.

use toml_edit::{InlineTable, Item, RawString, Table, TableLike, Value};

use crate::format::record::{Datum, Record};
use crate::format::write::push_datum;

/// Changes in a table, written under a header or inline, what differs between `old`, which it says, and `new`, which it
/// shall say. `None` when the item is no table.
pub(super) fn apply(item: &mut Item, old: &Record<'_>, new: &Record<'_>) -> Option<()> {
    match item {
        Item::Table(table) => apply_keys(table, old, new),
        Item::Value(Value::InlineTable(table)) => apply_inline(table, old, new),
        _ => None,
    }
}

/// Changes in an inline table what differs between `old` and `new`.
pub(super) fn apply_inline(table: &mut InlineTable, old: &Record<'_>, new: &Record<'_>) -> Option<()> {
    let before = table.len();
    apply_keys(table, old, new)?;
    if table.len() != before && is_on_one_line(table) {
        // `{ a = 1, b = 2 }`, wherever the new key stands.
        table.fmt();
    }
    Some(())
}

/// Changes the keys of a table whose values differ between `old` and `new`.
pub(super) fn apply_keys(table: &mut dyn TableLike, old: &Record<'_>, new: &Record<'_>) -> Option<()> {
    for key in new.table.0.keys {
        let is_written = table.contains_key(key.name);
        let Some(now) = new.get(key.name) else {
            table.remove(key.name);
            continue;
        };
        let was = old.get(key.name);
        if was == Some(now) && is_written {
            continue;
        }
        if new.is_default(key, now) {
            if key.always_written && is_written {
                set(table, key.name, now)?;
            } else {
                table.remove(key.name);
            }
            continue;
        }
        match (was, now, table.get_mut(key.name)) {
            (Some(Datum::Table(was)), Datum::Table(now), Some(item)) => apply(item, was, now)?,
            _ => set(table, key.name, now)?,
        }
    }
    Some(())
}

/// Gives a key another value; what stands around the old one stays.
fn set(table: &mut dyn TableLike, key: &str, datum: &Datum<'_>) -> Option<()> {
    let mut value = value(datum)?;
    match table.get_mut(key) {
        Some(Item::Value(old)) => {
            *value.decor_mut() = old.decor().clone();
            *old = value;
        }
        _ => {
            table.remove(key);
            table.insert(key, Item::Value(value));
        }
    }
    Some(())
}

/// A new table under a header of its own.
pub(super) fn new_table(record: &Record<'_>) -> Table {
    let mut table = Table::new();
    for (key, datum) in record.written() {
        if let Some(value) = value(datum) {
            table.insert(key, Item::Value(value));
        }
    }
    table
}

/// A value as the writer writes it.
fn value(datum: &Datum<'_>) -> Option<Value> {
    let mut text = String::new();
    push_datum(&mut text, datum);
    text.parse().ok()
}

/// Whether nothing but spaces stands between the keys and values of an inline table.
fn is_on_one_line(table: &InlineTable) -> bool {
    let is_blank = |raw: Option<&RawString>| {
        raw.is_none_or(|raw| {
            raw.as_str().is_some_and(|text| text.chars().all(|letter| letter == ' ' || letter == '\t'))
        })
    };
    table.iter().all(|(key, value)| {
        let around_key = table.key(key).map(toml_edit::Key::leaf_decor);
        let around = around_key.into_iter().chain([value.decor()]);
        around.into_iter().all(|decor| is_blank(decor.prefix()) && is_blank(decor.suffix()))
    })
}
