//! All commands with their shortcuts, and the use of the mouse in the picture.

use egui::{Align, Layout, RichText, Sense, Ui, vec2};

use crate::base::texts::Texts;
use crate::base::widgets::key_caps;
use crate::base::{shortcut_text, theme};
use crate::state::command::{Command, CommandGroup};

/// What the mouse and the keys do in the picture: the message with what is done by hand, and the one with what
/// happens.
const GESTURES: [(&str, &str); 18] = [
    ("gesture-click", "gesture-click-does"),
    ("gesture-click-again", "gesture-click-again-does"),
    ("gesture-shift-click", "gesture-shift-click-does"),
    ("gesture-drag-body", "gesture-drag-body-does"),
    ("gesture-alt-drag", "gesture-alt-drag-does"),
    ("gesture-ctrl-drag", "gesture-ctrl-drag-does"),
    ("gesture-shift-drag", "gesture-shift-drag-does"),
    ("gesture-drag-beside", "gesture-drag-beside-does"),
    ("gesture-right-drag", "gesture-right-drag-does"),
    ("gesture-middle-drag", "gesture-middle-drag-does"),
    ("gesture-wheel", "gesture-wheel-does"),
    ("gesture-arrows", "gesture-arrows-does"),
    ("gesture-shift-arrows", "gesture-shift-arrows-does"),
    ("gesture-escape", "gesture-escape-does"),
    ("gesture-fly", "gesture-fly-does"),
    ("gesture-audit", "gesture-audit-does"),
    ("gesture-audit-shift", "gesture-audit-shift-does"),
    ("gesture-aim", "gesture-aim-does"),
];

/// Draws the list.
pub(super) fn list_ui(ui: &mut Ui, texts: &Texts) {
    title_ui(ui, texts.get("group-mouse"));
    for (hand, does) in GESTURES {
        line_ui(ui, texts.get(does), &[texts.get(hand).to_owned()]);
    }
    for group in CommandGroup::ALL {
        title_ui(ui, texts.get(group.key()));
        for command in Command::all() {
            let Some(look) = command.look().filter(|look| look.group == group) else { continue };
            let keys: Vec<String> =
                look.usable_shortcuts().map(|shortcut| shortcut_text::text(ui.ctx(), shortcut)).collect();
            let response = line_ui(ui, texts.get(look.key), &keys);
            if let Some(tip) = texts.tip(look.key) {
                response.on_hover_text(tip);
            }
        }
    }
}

fn title_ui(ui: &mut Ui, title: &str) {
    let color = theme::palette(ui.visuals()).accent;
    ui.add_space(10.0);
    ui.label(RichText::new(title).strong().color(color));
}

/// A name at the left, keys at the right.
fn line_ui(ui: &mut Ui, name: &str, keys: &[String]) -> egui::Response {
    let size = vec2(ui.available_width() - 6.0, 20.0);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        for text in keys.iter().rev() {
            key_caps(ui, text);
        }
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            ui.add(egui::Label::new(name).truncate());
        });
    })
    .response
    .interact(Sense::hover())
}
