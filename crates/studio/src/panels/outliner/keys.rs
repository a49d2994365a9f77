//! The keys of the list while it has the focus.

use catoptric_editor::{Action, Item};
use egui::{Key, Modifiers, Ui};

use super::Outliner;
use super::rows::OutlinerSection;
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
    if let Some(section) = primary.and_then(OutlinerSection::of) {
        if pressed(Modifiers::NONE, Key::ArrowLeft) {
            outliner.rows.fold(section, true);
        }
        if pressed(Modifiers::NONE, Key::ArrowRight) {
            outliner.rows.fold(section, false);
        }
    }
    if pressed(Modifiers::NONE, Key::Space) {
        cx.run(Command::Edit(Action::ToggleHidden));
    }
    if pressed(Modifiers::NONE, Key::Enter)
        && let Some(item) = primary
    {
        outliner.rename(cx.editor.edited(), item);
    }
}

/// Goes to the next row or the one before, or stretches the range to it.
fn step(cx: &mut Cx<'_>, outliner: &mut Outliner, is_down: bool, stretches: bool) {
    let items: Vec<Item> = outliner.rows.items().collect();
    let primary = cx.editor.selection().primary();
    let place = primary.and_then(|item| items.iter().position(|other| *other == item));
    let next = match (place, is_down) {
        (Some(place), true) => place + 1,
        (Some(place), false) => place.saturating_sub(1),
        (None, true) => 0,
        (None, false) => items.len().saturating_sub(1),
    };
    let Some(item) = items.get(next).or(items.last()).copied() else { return };
    if stretches {
        let from = *outliner.anchor.get_or_insert(primary.unwrap_or(item));
        cx.editor.select(outliner.rows.range(from, item));
    } else {
        outliner.anchor = Some(item);
        cx.editor.select(item);
    }
}
