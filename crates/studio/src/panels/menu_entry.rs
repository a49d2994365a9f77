//! Commands as entries of menus.

use egui::containers::menu::SubMenuButton;
use egui::{Button, Response, Style, TextWrapMode, Ui, vec2};
use egui_material_icons::{MaterialIcon, icons};

use crate::base::shortcut_text;
use crate::base::widgets::tip::tip_beside_entry;
use crate::state::command::Command;
use crate::state::command_context::CommandContext;

/// Menus of this studio are airier than egui's.
pub(crate) fn dress_menu(style: &mut Style) {
    egui::containers::menu::menu_style(style);
    style.spacing.button_padding = vec2(8.0, 3.0);
    style.spacing.item_spacing.y = 1.0;
    style.wrap_mode = Some(TextWrapMode::Extend);
}

/// Draws a command as an entry of a menu, which closes with it; returns whether it was chosen.
pub(crate) fn item(ui: &mut Ui, situation: CommandContext<'_>, command: &Command) -> bool {
    item_response(ui, situation, command).is_some_and(|response| response.clicked())
}

/// Draws a command as an entry of a menu; `None` for a command that no menu shows.
pub(crate) fn item_response(
    ui: &mut Ui,
    situation: CommandContext<'_>,
    command: &Command,
) -> Option<Response> {
    let look = command.look()?;
    let name = situation.entry_label(command);
    let is_on = situation.is_on(command);
    let icon = match (is_on, command.is_choice()) {
        (None, _) => look.icon,
        (Some(true), false) => icons::ICON_CHECK_BOX,
        (Some(false), false) => icons::ICON_CHECK_BOX_OUTLINE_BLANK,
        (Some(true), true) => icons::ICON_RADIO_BUTTON_CHECKED,
        (Some(false), true) => icons::ICON_RADIO_BUTTON_UNCHECKED,
    };
    let mut button = Button::new((icon.rich_text(), name.as_str()));
    if let Some(shortcut) = look.usable_shortcuts().next() {
        button = button.shortcut_text(format!("    {}", shortcut_text::text(ui.ctx(), shortcut)));
    }
    let mut response = ui.add_enabled(situation.can(command), button).accessible_name(name);
    if let Some(is_on) = is_on {
        ui.ctx().accesskit_node_builder(response.id, |node| node.set_toggled(is_on.into()));
    }
    if let Some(tip) = situation.tip(command) {
        response = tip_beside_entry(response, tip);
    }
    if response.clicked() {
        // A click closes the menu by itself, a key does not.
        ui.close();
    }
    Some(response)
}

/// Draws an entry that opens a menu of its own.
pub(crate) fn submenu(
    ui: &mut Ui,
    (icon, name): (MaterialIcon, &str),
    content: impl FnOnce(&mut Ui),
) -> Response {
    let button = Button::new((icon.rich_text(), name)).right_text(SubMenuButton::arrow_atom(None));
    let (response, _) = SubMenuButton::from_button(button).ui(ui, content);
    response.accessible_name(name)
}
