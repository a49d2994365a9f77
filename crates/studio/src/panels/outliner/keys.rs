//! The keys of the list while it has the focus.

use catoptric_editor::{Action, Item, PartPath, Selection};
use egui::{Key, Modifiers, Ui};

use super::rows::OutlinerSection;
use super::{Outliner, body_of};
use crate::state::command::Command;
use crate::state::context::Cx;

/// Arrows choose rows, with Shift a range of them; left and right fold; Enter renames, Space hides.
pub(super) fn keys(ui: &Ui, cx: &mut Cx<'_>, outliner: &mut Outliner) {
    if outliner.renaming.is_some() || egui::Popup::is_any_open(ui.ctx()) {
        return;
    }
    let pressed = |modifiers, key| ui.input_mut(|input| input.consume_key(modifiers, key));
    for (key, is_down) in [(Key::ArrowDown, true), (Key::ArrowUp, false)] {
        // The pattern with Shift goes first: the one without it also fits.
        if pressed(Modifiers::SHIFT, key) {
            step(cx, outliner, is_down, true);
        } else if pressed(Modifiers::NONE, key) {
            step(cx, outliner, is_down, false);
        }
    }
    let primary = cx.editor.selection().primary();
    if let Some(item) = primary {
        if pressed(Modifiers::NONE, Key::ArrowLeft) {
            go_out(cx, outliner, item);
        }
        if pressed(Modifiers::NONE, Key::ArrowRight) {
            go_in(cx, outliner, item);
        }
    }
    if pressed(Modifiers::NONE, Key::Space) {
        cx.run(Command::Edit(Action::ToggleHidden));
    }
    if pressed(Modifiers::NONE, Key::Enter)
        && let Some(item) = primary
    {
        outliner.rename(cx.editor.edited(), item, meant(cx));
    }
}

/// The way to the part that is meant.
fn meant(cx: &Cx<'_>) -> PartPath {
    cx.editor.selection().part().unwrap_or(PartPath::WHOLE)
}

/// Folds what is unfolded, else goes to what is around it; from a body folds the section.
fn go_out(cx: &mut Cx<'_>, outliner: &mut Outliner, item: Item) {
    let path = meant(cx);
    let is_joined = body_of(cx.editor.edited(), item).is_some_and(|body| path.parts(body).is_some());
    if is_joined && outliner.rows.shows_parts(item, path) {
        outliner.rows.show_parts(cx.editor.edited(), (item, path), false);
    } else if let Some(around) = path.parent() {
        cx.editor.select(Selection::of_part(item, around));
    } else if let Some(section) = OutlinerSection::of(item) {
        outliner.rows.fold(section, true);
    }
}

/// Unfolds the section and the parts; from what is unfolded goes to its first part.
fn go_in(cx: &mut Cx<'_>, outliner: &mut Outliner, item: Item) {
    let path = meant(cx);
    let is_section_folded = OutlinerSection::of(item).is_some_and(|section| outliner.rows.is_folded(section));
    outliner.rows.unfold(item);
    let is_joined = body_of(cx.editor.edited(), item).is_some_and(|body| path.parts(body).is_some());
    if is_section_folded || !is_joined {
        return;
    }
    if outliner.rows.shows_parts(item, path) {
        cx.run(Command::Edit(Action::SelectPart));
    } else {
        outliner.rows.show_parts(cx.editor.edited(), (item, path), true);
    }
}

/// Goes to the next row or the one before, or stretches the range to it.
fn step(cx: &mut Cx<'_>, outliner: &mut Outliner, is_down: bool, stretches: bool) {
    let rows: Vec<(Item, PartPath)> = outliner.rows.places().collect();
    let primary = cx.editor.selection().primary();
    let meant = meant(cx);
    let place = primary.and_then(|item| rows.iter().position(|other| *other == (item, meant)));
    let next = match (place, is_down) {
        (Some(place), true) => place + 1,
        (Some(place), false) => place.saturating_sub(1),
        (None, true) => 0,
        (None, false) => rows.len().saturating_sub(1),
    };
    let Some((item, path)) = rows.get(next).or(rows.last()).copied() else { return };
    if stretches {
        let from = *outliner.anchor.get_or_insert(primary.unwrap_or(item));
        cx.editor.select(outliner.rows.range(from, item));
    } else {
        outliner.anchor = Some(item);
        cx.editor.select(Selection::of_part(item, path));
    }
}
