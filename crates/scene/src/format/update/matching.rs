//! Matches the elements of an edited list with those before the edit.

use std::collections::{HashMap, VecDeque};

use crate::format::record::{Datum, Record};
use crate::format::write::push_datum;

/// An element of a list with its name and keys.
pub(super) struct MatchedElement<'a> {
    /// The element's name; empty if it has none.
    pub(super) name: &'a str,
    pub(super) record: &'a Record<'a>,
}

impl<'a> MatchedElement<'a> {
    /// An element whose name is one of its keys.
    pub(super) fn named(record: &'a Record<'a>) -> Self {
        let name = match record.get("name") {
            Some(Datum::Text(name)) => name.as_ref(),
            _ => "",
        };
        Self { name, record }
    }

    /// Everything but the name.
    fn content(&self) -> String {
        let mut out = String::new();
        for (key, datum) in &self.record.values {
            if *key != "name" {
                out.push_str(key);
                push_datum(&mut out, datum);
            }
        }
        out
    }
}

/// For each new element the old one that it was: by name, then by equal content, then by place among those that are
/// left. Elements of two different names are the same only by content.
pub(super) fn matches(old: &[MatchedElement<'_>], new: &[MatchedElement<'_>]) -> Vec<Option<usize>> {
    let mut matched: Vec<Option<usize>> = vec![None; new.len()];
    let mut is_taken = vec![false; old.len()];
    by_name(old, new, &mut matched, &mut is_taken);
    by_content(old, new, &mut matched, &mut is_taken);
    by_place(old, new, &mut matched, &mut is_taken);
    matched
}

fn by_name(
    old: &[MatchedElement<'_>],
    new: &[MatchedElement<'_>],
    matched: &mut [Option<usize>],
    is_taken: &mut [bool],
) {
    let by_name: HashMap<&str, usize> = old
        .iter()
        .enumerate()
        .filter(|(_, entry)| !entry.name.is_empty())
        .map(|(index, entry)| (entry.name, index))
        .collect();
    for (entry, matched) in new.iter().zip(matched) {
        let Some(&index) = by_name.get(entry.name) else { continue };
        if let Some(is_taken) = is_taken.get_mut(index).filter(|is_taken| !**is_taken) {
            *is_taken = true;
            *matched = Some(index);
        }
    }
}

fn by_content(
    old: &[MatchedElement<'_>],
    new: &[MatchedElement<'_>],
    matched: &mut [Option<usize>],
    is_taken: &mut [bool],
) {
    let mut by_content: HashMap<String, VecDeque<usize>> = HashMap::new();
    for (index, entry) in old.iter().enumerate() {
        if is_taken.get(index) == Some(&false) {
            by_content.entry(entry.content()).or_default().push_back(index);
        }
    }
    for (entry, matched) in new.iter().zip(matched).filter(|(_, matched)| matched.is_none()) {
        let Some(index) = by_content.get_mut(&entry.content()).and_then(VecDeque::pop_front) else {
            continue;
        };
        if let Some(is_taken) = is_taken.get_mut(index) {
            *is_taken = true;
            *matched = Some(index);
        }
    }
}

fn by_place(
    old: &[MatchedElement<'_>],
    new: &[MatchedElement<'_>],
    matched: &mut [Option<usize>],
    is_taken: &mut [bool],
) {
    let mut after_last = 0;
    for index in 0..new.len() {
        if let Some(Some(from)) = matched.get(index) {
            after_last = from + 1;
            continue;
        }
        let is_named = new.get(index).is_some_and(|entry| !entry.name.is_empty());
        // The one that follows the neighbor's, or any that is left.
        let is_free = |candidate: &usize| {
            let both_named = is_named && old.get(*candidate).is_some_and(|entry| !entry.name.is_empty());
            is_taken.get(*candidate) == Some(&false) && !both_named
        };
        if let Some(from) = Some(after_last).filter(is_free) {
            if let (Some(is_taken), Some(matched)) = (is_taken.get_mut(from), matched.get_mut(index)) {
                *is_taken = true;
                *matched = Some(from);
            }
            after_last = from + 1;
        }
    }
}
