//! Actions on the selection.

use catoptric_scene::ScenePart;

use super::flags::all;
use super::part;
use crate::edited_scene::EditedScene;
use crate::identity::Item;
use crate::selection::Selection;

/// All bodies and lights that are visible and not locked. The bodies are last, so that one of them is the primary item.
fn reachable(scene: &EditedScene) -> impl Iterator<Item = Item> {
    let is_reachable = |part: &ScenePart| !part.is_hidden(scene.scene()) && !part.is_locked(scene.scene());
    all(scene.scene()).rev().filter(is_reachable).filter_map(|part| scene.item(part))
}

pub(super) fn select_all(scene: &EditedScene) -> Selection {
    reachable(scene).collect()
}

pub(super) fn invert(scene: &EditedScene, selection: &Selection) -> Selection {
    let selected: std::collections::HashSet<Item> = selection.iter().collect();
    reachable(scene).filter(|item| !selected.contains(item)).collect()
}

/// The item after the primary one in the round of all that are not hidden, or before it.
pub(super) fn next(scene: &EditedScene, selection: &Selection, is_forward: bool) -> Selection {
    if let Some(focus) = part::focused(scene, selection) {
        return part::next(&focus, selection, is_forward);
    }
    let shown: Vec<ScenePart> = all(scene.scene()).filter(|part| !part.is_hidden(scene.scene())).collect();
    let primary = selection.primary().and_then(|primary| scene.part(primary));
    let primary = primary.and_then(|primary| shown.iter().position(|part| *part == primary));
    let count = shown.len();
    let place = match (primary, is_forward) {
        (Some(place), true) => (place + 1) % count,
        (Some(place), false) => (place + count - 1) % count,
        (None, true) => 0,
        (None, false) => count.saturating_sub(1),
    };
    shown.get(place).and_then(|part| scene.item(*part)).map_or_else(Selection::none, Selection::one)
}
