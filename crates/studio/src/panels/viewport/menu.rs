//! The menu of the right button.

use catoptric_editor::{Action, Item};
use egui::Ui;

use crate::panels::menu_entry::item;
use crate::state::command::{CameraCommand, Command, JOINS, SelectionCommand};
use crate::state::context::Cx;

/// Draws the menu about what is selected.
pub(crate) fn menu_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let selection = cx.editor.selection();
    let has_bodies = selection.iter().any(|item| matches!(item, Item::Body(_)));
    let has_things = has_bodies || selection.iter().any(|item| matches!(item, Item::Light(_)));
    if has_things {
        let edits = [
            Command::Edit(Action::Duplicate),
            Command::Edit(Action::Delete),
            Command::Edit(Action::ToggleHidden),
            Command::Edit(Action::ToggleLocked),
        ];
        items(ui, cx, [CameraCommand::FrameSelection.into(), Command::Selection(SelectionCommand::Rename)]);
        items(ui, cx, edits);
        ui.separator();
    }
    if has_bodies {
        let edits = [
            Command::Edit(Action::DropToGround),
            Command::Edit(Action::ResetPlacement),
            Command::Edit(Action::ShareMaterial),
            Command::Edit(Action::MakeMaterialUnique),
        ];
        items(ui, cx, edits);
        ui.separator();
        items(ui, cx, JOINS.map(Command::Edit));
        let edits = [Action::TakeApart, Action::TakeOut(None), Action::DuplicateAsInstance, Action::MakeOwn];
        items(ui, cx, edits.map(Command::Edit));
        ui.separator();
    }
    items(
        ui,
        cx,
        [CameraCommand::FrameAll.into(), Command::Edit(Action::SelectAll), Command::Edit(Action::ShowAll)],
    );
}

fn items<const N: usize>(ui: &mut Ui, cx: &mut Cx<'_>, commands: [Command; N]) {
    for command in commands {
        if item(ui, cx.situation(), &command) {
            cx.run(command);
            ui.close();
        }
    }
}
