//! The menu of the right button.

use catoptric_editor::{Action, Item};
use egui::{Button, Ui};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons::{
    ICON_CENTER_FOCUS_STRONG, ICON_DELETE, ICON_FIT_SCREEN, ICON_LINK, ICON_LOCK, ICON_LOCK_OPEN,
    ICON_SELECT_ALL, ICON_TAB_DUPLICATE, ICON_VERTICAL_ALIGN_BOTTOM, ICON_VISIBILITY, ICON_VISIBILITY_OFF,
};

use crate::command::Command;
use crate::context::Cx;

/// Draws the menu about what is selected.
pub(crate) fn menu_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    ui.set_min_width(200.0);
    let scene = cx.editor.scene();
    let items: Vec<Item> = cx.editor.selection().iter().collect();
    let all = |holds: fn(Item, &catoptric_scene::Scene) -> bool| {
        !items.is_empty() && items.iter().all(|item| holds(*item, scene))
    };
    let (hide, lock) = (all(Item::is_hidden), all(Item::is_locked));
    let has_bodies = cx.editor.selection().bodies().next().is_some();
    let has_things = has_bodies || cx.editor.selection().lights().next().is_some();
    if has_things {
        item(ui, cx, ICON_CENTER_FOCUS_STRONG, "viewport-menu-frame", Command::FrameSelection);
        item(ui, cx, ICON_TAB_DUPLICATE, "viewport-menu-duplicate", Command::Edit(Action::Duplicate));
        item(ui, cx, ICON_DELETE, "viewport-menu-delete", Command::Edit(Action::Delete));
        ui.separator();
        let (icon, key) = if hide {
            (ICON_VISIBILITY, "viewport-menu-show")
        } else {
            (ICON_VISIBILITY_OFF, "viewport-menu-hide")
        };
        item(ui, cx, icon, key, Command::Edit(Action::ToggleHidden));
        let (icon, key) =
            if lock { (ICON_LOCK_OPEN, "viewport-menu-unlock") } else { (ICON_LOCK, "viewport-menu-lock") };
        item(ui, cx, icon, key, Command::Edit(Action::ToggleLocked));
    }
    if has_bodies {
        ui.separator();
        let ground = Command::Edit(Action::DropToGround);
        item(ui, cx, ICON_VERTICAL_ALIGN_BOTTOM, "viewport-menu-ground", ground);
        item(ui, cx, ICON_LINK, "viewport-menu-share", Command::Edit(Action::ShareMaterial));
    }
    if has_things {
        ui.separator();
    }
    item(ui, cx, ICON_FIT_SCREEN, "viewport-menu-frame-all", Command::FrameAll);
    item(ui, cx, ICON_SELECT_ALL, "viewport-menu-select-all", Command::Edit(Action::SelectAll));
    item(ui, cx, ICON_VISIBILITY, "viewport-menu-show-all", Command::Edit(Action::ShowAll));
}

fn item(ui: &mut Ui, cx: &mut Cx<'_>, icon: MaterialIcon, key: &'static str, command: Command) {
    let is_possible = match &command {
        Command::Edit(action) => cx.editor.can(action),
        _ => true,
    };
    let text = format!("{}  {}", icon.codepoint, cx.t(key));
    let button = ui.add_enabled(is_possible, Button::new(text).frame_when_inactive(false));
    button.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::MenuItem, is_possible, cx.t(key)));
    if button.clicked() {
        cx.run(command);
        ui.close();
    }
}
