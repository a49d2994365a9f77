//! Changes the keys of one table of an editable document.

use toml_edit::{Array, ArrayOfTables, InlineTable, Item, RawString, Table, TableLike, Value};

use crate::format::record::{Datum, Record};
use crate::format::update::matching::{MatchedElement, matches};
use crate::format::write::push_datum;

/// Changes in a table, written under a header or inline, what differs between `old`, which it says, and `new`, which it
/// shall say. `None` when the item is no table.
pub(super) fn apply(item: &mut Item, old: &Record<'_>, new: &Record<'_>) -> Option<()> {
    match item {
        Item::Table(table) => apply_keys(table, old, new, Place::Header),
        Item::Value(Value::InlineTable(table)) => apply_inline(table, old, new),
        _ => None,
    }
}

/// Changes in an inline table what differs between `old` and `new`.
pub(super) fn apply_inline(table: &mut InlineTable, old: &Record<'_>, new: &Record<'_>) -> Option<()> {
    let before = table.len();
    apply_keys(table, old, new, Place::Inline)?;
    if table.len() != before && is_on_one_line(table) {
        // `{ a = 1, b = 2 }`, wherever the new key stands.
        table.fmt();
    }
    Some(())
}

/// The way a table is written, which decides how lists within it can be.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// Under a header.
    Header,
    /// Inline.
    Inline,
}

/// Changes the keys of a table whose values differ between `old` and `new`.
pub(super) fn apply_keys(
    table: &mut dyn TableLike,
    old: &Record<'_>,
    new: &Record<'_>,
    place: Place,
) -> Option<()> {
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
            (Some(Datum::Tables(was)), Datum::Tables(now), Some(item)) => elements(item, was, now, None)?,
            (_, Datum::Tables(now), None) if place == Place::Header => {
                table.insert(key.name, Item::ArrayOfTables(now.iter().map(new_table).collect()));
            }
            _ => set(table, key.name, now)?,
        }
    }
    Some(())
}

/// Changes the elements of a list: in place where they are still the same ones, else each that stays is taken along.
/// `start` is the place in the file after which new ones stand; `None` is where the list stands.
pub(super) fn elements(
    item: &mut Item,
    old: &[Record<'_>],
    new: &[Record<'_>],
    start: Option<isize>,
) -> Option<()> {
    let old_entries: Vec<MatchedElement<'_>> = old.iter().map(MatchedElement::named).collect();
    let new_entries: Vec<MatchedElement<'_>> = new.iter().map(MatchedElement::named).collect();
    let matched = matches(&old_entries, &new_entries);
    let in_place =
        old.len() == new.len() && matched.iter().enumerate().all(|(index, from)| *from == Some(index));
    if let Some(array) = item.as_array_mut().filter(|_| in_place || start.is_none()) {
        return inline_elements(array, old, new, &matched);
    }
    let mut taken: Vec<Option<Table>> =
        std::mem::take(item).into_array_of_tables().ok()?.into_iter().map(Some).collect();
    let first = || taken.first().and_then(Option::as_ref).and_then(Table::position);
    let mut last = start.or_else(first);
    let mut tables = ArrayOfTables::new();
    for (new, from) in new.iter().zip(matched) {
        let kept = from.and_then(|index| Some((taken.get_mut(index)?.take()?, old.get(index)?)));
        let mut table = match kept {
            Some((mut table, old)) => {
                apply_keys(&mut table, old, new, Place::Header)?;
                table
            }
            None => {
                let mut table = new_table(new);
                table.set_position(last);
                table
            }
        };
        keep_in_order(&mut table, &mut last);
        tables.push(table);
    }
    *item = Item::ArrayOfTables(tables);
    Some(())
}

/// Changes the elements of a list that is written as a value.
fn inline_elements(
    array: &mut Array,
    old: &[Record<'_>],
    new: &[Record<'_>],
    matched: &[Option<usize>],
) -> Option<()> {
    let taken: Vec<Value> = array.iter().cloned().collect();
    let is_longer = new.len() > taken.len();
    for (index, (new, from)) in new.iter().zip(matched).enumerate() {
        let kept = from.and_then(|from| Some((taken.get(from)?.clone(), old.get(from)?)));
        let value = match kept {
            Some((mut value, old)) => {
                apply_inline(value.as_inline_table_mut()?, old, new)?;
                value
            }
            None => inline_value(&Datum::Table(new.clone()))?,
        };
        match array.get_mut(index) {
            Some(place) => {
                let decor = place.decor().clone();
                *place = value;
                *place.decor_mut() = decor;
            }
            None => array.push(value),
        }
    }
    while array.len() > new.len() {
        array.remove(new.len());
    }
    if is_longer && array.iter().all(|value| value.decor().prefix().is_none()) {
        array.fmt();
    }
    Some(())
}

/// Moves the headers of a table behind those before it.
pub(super) fn keep_in_order(table: &mut Table, last: &mut Option<isize>) {
    if table.position().is_none_or(|position| last.is_some_and(|last| position < last)) {
        table.set_position(*last);
    }
    *last = table.position().or(*last);
    for (_, item) in table.iter_mut() {
        match item {
            Item::Table(table) => keep_in_order(table, last),
            Item::ArrayOfTables(tables) => tables.iter_mut().for_each(|table| keep_in_order(table, last)),
            _ => {}
        }
    }
}

/// Gives a key another value; what stands around the old one stays.
fn set(table: &mut dyn TableLike, key: &str, datum: &Datum<'_>) -> Option<()> {
    let mut value = inline_value(datum)?;
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
        if let Datum::Tables(elements) = datum {
            table.insert(key, Item::ArrayOfTables(elements.iter().map(new_table).collect()));
        } else if let Some(value) = inline_value(datum) {
            table.insert(key, Item::Value(value));
        }
    }
    table
}

/// A value as the writer writes it.
fn inline_value(datum: &Datum<'_>) -> Option<Value> {
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
