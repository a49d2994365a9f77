//! The menus of the outliner.

use catoptric_editor::{Action, Item};
use egui::{Popup, Response, Style};
use egui_material_icons::icons;

use super::rows::OutlinerSection;
use crate::panels::add_menu::add_ui;
use crate::panels::menu_entry::{dress_menu, item, submenu};
use crate::state::command::{AddCommand, CameraCommand, Command, JOINS, SelectionCommand};
use crate::state::context::Cx;

/// The menu of a row, for all that is selected.
pub(super) fn item_menu(response: &Response, cx: &mut Cx<'_>, thing: Item) {
    let mut commands = Vec::new();
    Popup::context_menu(response)
        .accessible_name(cx.t("pane-outliner"))
        .style(dress_menu as fn(&mut Style))
        .show(|ui| {
            ui.set_min_width(220.0);
            for group in groups(thing) {
                for command in group {
                    if item(ui, cx.situation(), &command) {
                        commands.push(command);
                    }
                }
                ui.separator();
            }
            if item(ui, cx.situation(), &Command::Edit(Action::Delete)) {
                commands.push(Command::Edit(Action::Delete));
            }
        });
    cx.commands.append(&mut commands);
}

/// The menu of the row of a part.
pub(super) fn part_menu(response: &Response, cx: &mut Cx<'_>) {
    let edit = Command::Edit;
    let groups: [Vec<Command>; 4] = [
        vec![SelectionCommand::Rename.into(), edit(Action::Duplicate)],
        [SelectionCommand::Cut, SelectionCommand::Copy, SelectionCommand::Paste].map(Command::from).into(),
        [Action::MoveUp, Action::MoveDown, Action::TakeOut(None), Action::ResetPlacement].map(edit).into(),
        [Action::ShareMaterial, Action::MakeMaterialUnique, Action::MaterialOfWhole].map(edit).into(),
    ];
    let mut commands = Vec::new();
    Popup::context_menu(response)
        .accessible_name(cx.t("pane-outliner"))
        .style(dress_menu as fn(&mut Style))
        .show(|ui| {
            ui.set_min_width(220.0);
            for command in groups.iter().flat_map(|group| group.iter().map(Some).chain([None])) {
                let Some(command) = command else {
                    ui.separator();
                    continue;
                };
                if item(ui, cx.situation(), command) {
                    commands.push(command.clone());
                }
            }
            if item(ui, cx.situation(), &Command::Edit(Action::Delete)) {
                commands.push(Command::Edit(Action::Delete));
            }
        });
    cx.commands.append(&mut commands);
}

/// What can be done to a thing, but deleting it.
fn groups(thing: Item) -> Vec<Vec<Command>> {
    let edit = Command::Edit;
    if matches!(thing, Item::Camera | Item::Environment | Item::Tracing) {
        let acts = [CameraCommand::FrameAll, CameraCommand::ToggleFreeView, CameraCommand::FromView];
        return vec![acts.map(Command::from).into()];
    }
    let mut groups = vec![
        vec![SelectionCommand::Rename.into(), edit(Action::Duplicate)],
        [SelectionCommand::Cut, SelectionCommand::Copy, SelectionCommand::Paste].map(Command::from).into(),
        vec![edit(Action::MoveUp), edit(Action::MoveDown)],
    ];
    if matches!(thing, Item::Body(_) | Item::Light(_)) {
        groups.push(vec![
            edit(Action::ToggleHidden),
            edit(Action::ToggleLocked),
            CameraCommand::FrameSelection.into(),
        ]);
    }
    if matches!(thing, Item::Body(_)) {
        groups.push(vec![edit(Action::DropToGround), edit(Action::ResetPlacement)]);
        groups.push(
            JOINS
                .into_iter()
                .chain([Action::TakeApart, Action::Nest(None), Action::TakeOut(None)])
                .map(edit)
                .collect(),
        );
        groups.push(vec![edit(Action::DuplicateAsInstance), edit(Action::MakeOwn)]);
        groups.push(vec![edit(Action::ShareMaterial), edit(Action::MakeMaterialUnique)]);
    }
    groups
}

/// What the button at the head of a section adds: at once, or a shape to be chosen.
pub(super) fn add_menu(button: &Response, cx: &mut Cx<'_>, section: OutlinerSection) {
    match section {
        OutlinerSection::Lights if button.clicked() => cx.run(AddCommand::Light),
        OutlinerSection::Materials if button.clicked() => cx.run(AddCommand::Material),
        OutlinerSection::Lights | OutlinerSection::Materials => {}
        OutlinerSection::Bodies => {
            let mut commands = Vec::new();
            let popup = Popup::menu(button).style(dress_menu as fn(&mut Style));
            popup.show(|ui| add_ui(ui, cx.situation(), &mut commands, false));
            cx.commands.append(&mut commands);
        }
    }
}

/// The menu of the room below the rows.
pub(super) fn rest_menu(response: &Response, cx: &mut Cx<'_>) {
    let mut commands = Vec::new();
    Popup::context_menu(response)
        .accessible_name(cx.t("pane-outliner"))
        .style(dress_menu as fn(&mut Style))
        .show(|ui| {
            ui.set_min_width(200.0);
            let entry = (icons::ICON_ADD, cx.t("menu-add"));
            submenu(ui, entry, |ui| add_ui(ui, cx.situation(), &mut commands, true));
            ui.separator();
            for command in [SelectionCommand::Paste.into(), Command::Edit(Action::SelectAll)] {
                if item(ui, cx.situation(), &command) {
                    commands.push(command);
                }
            }
        });
    cx.commands.append(&mut commands);
}
