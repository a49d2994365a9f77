//! Actions on the selection.

use catoptric_scene::Scene;

use super::flags::all;
use crate::selection::{Item, Selection};

/// All bodies and lights that are visible and not locked. The bodies are last, so that one of them is the primary item.
fn reachable(scene: &Scene) -> impl Iterator<Item = Item> {
    all(scene).rev().filter(|item| !item.is_hidden(scene) && !item.is_locked(scene))
}

pub(super) fn select_all(scene: &Scene) -> Selection {
    reachable(scene).collect()
}

pub(super) fn invert(scene: &Scene, selection: &Selection) -> Selection {
    let selected: std::collections::HashSet<Item> = selection.iter().collect();
    reachable(scene).filter(|item| !selected.contains(item)).collect()
}

/// The item after the primary one in the round of all that are not hidden, or before it.
pub(super) fn next(scene: &Scene, selection: &Selection, is_forward: bool) -> Selection {
    let shown: Vec<Item> = all(scene).filter(|item| !item.is_hidden(scene)).collect();
    let primary = selection.primary().and_then(|primary| shown.iter().position(|item| *item == primary));
    let count = shown.len();
    let place = match (primary, is_forward) {
        (Some(place), true) => (place + 1) % count,
        (Some(place), false) => (place + count - 1) % count,
        (None, true) => 0,
        (None, false) => count.saturating_sub(1),
    };
    shown.get(place).copied().map_or_else(Selection::none, Selection::one)
}
