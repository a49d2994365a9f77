//! The chooser over the picture: how it is drawn, and what of the drawing is seen.

mod fields;

use catoptric_tracer::raster::MethodKind;
use egui::{Button, Popup, PopupCloseBehavior, Response, RichText, Ui, vec2};
use egui_material_icons::icons::{ICON_LAYERS, ICON_PHOTO_CAMERA_BACK};

use crate::base::texts::Texts;
use crate::base::{shortcut_text, theme};
use crate::state::command::{Command, DisplayCommand, PictureCommand};
use crate::state::context::Cx;
use crate::state::methods::{ALL_SHOWN, MethodSettings, has, icon, method_key, short_key, shown_key};
use fields::settings_ui;

/// Draws the button that names the method and opens the choice.
pub(crate) fn chooser_ui(ui: &mut Ui, cx: &mut Cx<'_>, height: f32) {
    let kind = cx.settings.methods.kind();
    let palette = theme::palette(ui.visuals());
    let is_traced = kind.abilities().is_reference;
    let text = RichText::new(cx.t(short_key(kind))).size(13.0);
    let fill = if is_traced { egui::Color32::TRANSPARENT } else { palette.selection };
    let button = Button::new((icon(kind).rich_text().size(16.0), text)).fill(fill);
    let response = ui.add(button.min_size(vec2(0.0, height)).frame_when_inactive(!is_traced));
    let name = cx.texts.with("viewport-method-name", &[("method", cx.t(method_key(kind)).into())]);
    let tip = format!("{name}\n{}", cx.texts.tip("viewport-method").unwrap_or_default());
    let response = response.accessible_name(name).on_hover_text(tip);
    popup(&response, |ui| method_popup(ui, cx));
    let method = cx.settings.methods.method();
    if has(&method, ALL_SHOWN[1]) {
        shown_button(ui, cx, height);
    }
}

fn popup(response: &Response, content: impl FnOnce(&mut Ui)) {
    Popup::menu(response).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ui.set_min_width(330.0);
        ui.set_max_width(330.0);
        content(ui);
    });
}

fn method_popup(ui: &mut Ui, cx: &mut Cx<'_>) {
    methods_ui(ui, cx.texts, &mut cx.settings.methods, true);
}

/// Draws the list of methods and the settings of the chosen one; `with_keys` shows the shortcuts.
pub(crate) fn methods_ui(ui: &mut Ui, texts: &Texts, methods: &mut MethodSettings, with_keys: bool) -> bool {
    let before = methods.clone();
    for kind in MethodKind::ALL {
        let key = method_key(kind);
        ui.horizontal(|ui| {
            let response = ui.radio(methods.kind() == kind, texts.get(key));
            if response.on_hover_text(texts.tip(key).unwrap_or_default()).clicked() {
                methods.choose(kind);
            }
            let shortcut = Command::from(DisplayCommand::Method(kind))
                .look()
                .and_then(|look| look.usable_shortcuts().next());
            if let Some(shortcut) = shortcut.filter(|_| with_keys) {
                let weak = theme::palette(ui.visuals()).weak;
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    ui.label(RichText::new(shortcut_text::text(ui.ctx(), shortcut)).color(weak));
                });
            }
        });
    }
    if !methods.kind().abilities().is_reference {
        ui.separator();
        let mut method = methods.method();
        if settings_ui(ui, texts, method.name(), &mut method) {
            methods.set(method);
        }
        if method != method.kind().method() && ui.button(texts.get("method-reset")).clicked() {
            methods.set(method.kind().method());
        }
    }
    *methods != before
}

/// The button that names the displayed layer and opens its choice.
fn shown_button(ui: &mut Ui, cx: &mut Cx<'_>, height: f32) {
    let key = shown_key(cx.view.shows);
    let is_picture = cx.view.shows == ALL_SHOWN[0];
    let palette = theme::palette(ui.visuals());
    let fill = if is_picture { egui::Color32::TRANSPARENT } else { palette.selection };
    let mut button = if is_picture {
        Button::new(ICON_LAYERS.rich_text().size(16.0))
    } else {
        Button::new((ICON_LAYERS.rich_text().size(16.0), RichText::new(cx.t(key)).size(13.0)))
    };
    button = button.fill(fill).min_size(vec2(height, height)).frame_when_inactive(!is_picture);
    let name = cx.texts.with("viewport-shows-name", &[("what", cx.t(key).into())]);
    let tip = format!("{name}\n{}", cx.texts.tip("viewport-shows").unwrap_or_default());
    let response = ui.add(button).accessible_name(name).on_hover_text(tip);
    popup(&response, |ui| {
        let method = cx.settings.methods.method();
        for shows in ALL_SHOWN {
            let key = shown_key(shows);
            let is_there = has(&method, shows);
            ui.add_enabled_ui(is_there, |ui| {
                let response = ui.radio(cx.view.shows == shows, cx.texts.get(key));
                let tip = cx.texts.tip(key).unwrap_or_default();
                if response.on_hover_text(tip).on_disabled_hover_text(tip).clicked() {
                    cx.view.shows = shows;
                }
            });
        }
        ui.separator();
        let label = format!("{} {}", ICON_PHOTO_CAMERA_BACK.codepoint, cx.t("command-render-shown"));
        let save = ui.button(label).accessible_name(cx.t("command-render-shown"));
        if save.on_hover_text(cx.texts.tip("command-render-shown").unwrap_or_default()).clicked() {
            cx.run(PictureCommand::RenderShown);
            ui.close();
        }
    });
}
