//! The choice of the two pictures and of their display.

use egui::{Button, ComboBox, Popup, PopupCloseBehavior, RichText, Ui};
use egui_material_icons::icons::{ICON_IMAGE, ICON_SWAP_HORIZ};

use super::{CompareMode, CompareSide, CompareState};
use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::icon_button;
use crate::panels::method_chooser::methods_ui;
use crate::state::command::{Command, CompareCommand};
use crate::state::context::Cx;
use crate::state::methods::{icon, method_key, short_key};

/// What can be shown, with its message.
const MODES: [(CompareMode, &str); 6] = [
    (CompareMode::Split, "compare-mode-split"),
    (CompareMode::A, "compare-mode-a"),
    (CompareMode::B, "compare-mode-b"),
    (CompareMode::Difference, "compare-mode-difference"),
    (CompareMode::Flip, "compare-mode-flip"),
    (CompareMode::Reasons, "compare-mode-reasons"),
];

/// The view's size divided by these.
const COARSENESS: [(u32, &str); 3] =
    [(1, "compare-size-whole"), (2, "compare-size-half"), (4, "compare-size-quarter")];

pub(super) fn header_ui(ui: &mut Ui, cx: &mut Cx<'_>, comparing: &mut CompareState) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        let [a, b] = &mut comparing.sides;
        side_ui(ui, cx, a, 0);
        if icon_button(ui, ICON_SWAP_HORIZ, cx.t("command-compare-swap"), false).clicked() {
            cx.run(Command::Compare(CompareCommand::Swap));
        }
        side_ui(ui, cx, b, 1);
        ui.add_space(2.0);
        modes_ui(ui, cx.texts, comparing);
        ui.add_space(2.0);
        size_ui(ui, cx.texts, &mut comparing.coarseness);
    });
}

/// A button with what one of the pictures is; it opens the choice.
fn side_ui(ui: &mut Ui, cx: &mut Cx<'_>, side: &mut CompareSide, index: usize) {
    let letter = ["A", "B"].get(index).copied().unwrap_or_default();
    let (picture, what) = match &side.file {
        Some(path) => (ICON_IMAGE, super::task::name_of(path)),
        None => (icon(side.methods.kind()), cx.t(short_key(side.methods.kind())).to_owned()),
    };
    let full = match &side.file {
        Some(path) => path.display().to_string(),
        None => cx.t(method_key(side.methods.kind())).to_owned(),
    };
    let name = cx.texts.with("compare-side", &[("letter", letter.into()), ("what", full.into())]);
    let shown: String = what.chars().take(24).collect();
    let letter = RichText::new(letter).color(theme::palette(ui.visuals()).accent).strong();
    let button = Button::new((letter, picture.rich_text().size(15.0), RichText::new(shown)));
    let response = ui.add(button).accessible_name(&name);
    let tip = format!("{name}\n{}", cx.texts.tip("compare-side-name").unwrap_or_default());
    let response = response.on_hover_text(tip);
    Popup::menu(&response).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ui.set_min_width(330.0);
        ui.set_max_width(330.0);
        if methods_ui(ui, cx.texts, &mut side.methods, false) {
            side.file = None;
        }
        ui.separator();
        ui.horizontal(|ui| {
            let label = format!("{} {}", ICON_IMAGE.codepoint, cx.t("compare-file"));
            let choose = ui.button(label).accessible_name(cx.t("compare-file"));
            if choose.on_hover_text(cx.texts.tip("compare-file").unwrap_or_default()).clicked() {
                cx.run(Command::Compare(if index == 0 {
                    CompareCommand::FileA
                } else {
                    CompareCommand::FileB
                }));
                ui.close();
            }
            if side.file.is_some() && ui.button(cx.t("compare-no-file")).clicked() {
                side.file = None;
            }
        });
    });
}

fn modes_ui(ui: &mut Ui, texts: &Texts, comparing: &mut CompareState) {
    let can_tell = comparing.found.as_ref().is_none_or(|found| found.reasons.is_some());
    let choices = MODES.map(|(value, key)| ChoiceItem {
        value,
        text: texts.get(key),
        tip: texts.tip(key).unwrap_or_default(),
        is_enabled: value != CompareMode::Reasons || can_tell,
    });
    let width = match texts.language() {
        crate::base::texts::Language::English => 318.0,
        crate::base::texts::Language::Russian => 330.0,
    };
    let width = f32::min(width, ui.max_rect().width());
    let id = ui.scope_id().with("mode");
    if let Some(mode) = choice_ui(ui, id, texts.get("compare-mode"), width, &choices, Some(comparing.mode)) {
        comparing.mode = mode;
    }
}

fn size_ui(ui: &mut Ui, texts: &Texts, coarseness: &mut u32) {
    let key = COARSENESS.iter().find(|(value, _)| value == coarseness).map_or("", |(_, key)| key);
    let list = ComboBox::from_id_salt("size of the comparison").selected_text(texts.get(key)).width(72.0);
    let shown = list.show_ui(ui, |ui| {
        for (value, key) in COARSENESS {
            ui.selectable_value(coarseness, value, texts.get(key));
        }
    });
    let tip = texts.tip("compare-size").unwrap_or_default();
    shown.response.accessible_name(texts.get("compare-size")).on_hover_text(tip);
}
