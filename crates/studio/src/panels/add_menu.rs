//! What can be added, in menus: what is used most in front, all shapes in groups.

use catoptric_scene::ShapeKind;
use egui::Ui;
use egui_material_icons::{MaterialIcon, icons};

use crate::base::shapes::ShapeGroup;
use crate::panels::menu_entry::{item, submenu};
use crate::state::command::{AddCommand, Command};
use crate::state::command_context::CommandContext;

/// What is added most often, in the order in which to offer it.
pub(crate) const FRONT: [AddCommand; 5] = [
    AddCommand::Body(ShapeKind::Sphere),
    AddCommand::Body(ShapeKind::Cube),
    AddCommand::Body(ShapeKind::Cylinder),
    AddCommand::Body(ShapeKind::Plane),
    AddCommand::Light,
];

/// The icon of a group.
pub(crate) const fn icon(group: ShapeGroup) -> MaterialIcon {
    match group {
        ShapeGroup::Bodies => icons::ICON_SHAPES,
        ShapeGroup::Optics => icons::ICON_CAMERA,
        ShapeGroup::Surfaces => icons::ICON_FILTER_NONE,
        ShapeGroup::Joined => icons::ICON_JOIN_FULL,
    }
}

/// Draws the shapes of a group; one that is chosen is pushed onto `commands`.
pub(crate) fn group_ui(
    ui: &mut Ui,
    situation: CommandContext<'_>,
    commands: &mut Vec<Command>,
    group: ShapeGroup,
) {
    ui.set_min_width(170.0);
    for shape in group.shapes() {
        offer(ui, situation, commands, AddCommand::Body(shape));
    }
}

/// Draws what can be added: bodies alone, or all.
pub(crate) fn add_ui(ui: &mut Ui, situation: CommandContext<'_>, commands: &mut Vec<Command>, is_all: bool) {
    ui.set_min_width(200.0);
    for act in FRONT.into_iter().filter(|act| is_all || matches!(act, AddCommand::Body(_))) {
        offer(ui, situation, commands, act);
    }
    ui.separator();
    for group in ShapeGroup::ADDED {
        let entry = (icon(group), situation.texts.get(group.key()));
        submenu(ui, entry, |ui| group_ui(ui, situation, commands, group));
    }
    if is_all {
        ui.separator();
        offer(ui, situation, commands, AddCommand::Material);
    }
}

fn offer(ui: &mut Ui, situation: CommandContext<'_>, commands: &mut Vec<Command>, act: AddCommand) {
    let command = Command::from(act);
    if item(ui, situation, &command) {
        commands.push(command);
    }
}
