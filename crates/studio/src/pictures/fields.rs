//! How light becomes a file: the fields that the dialog and the window of a picture share.

use catoptric_picture::ToneCurve;
use egui::{ComboBox, RichText, Slider, Ui};
use egui_material_icons::icons::ICON_RESTART_ALT;

use super::PictureKind;
use crate::texts::Texts;

/// The exposure that can be chosen, stops to either side.
const STOPS: f64 = 10.0;

/// The message that names a tone curve.
const fn tone_key(curve: ToneCurve) -> &'static str {
    match curve {
        ToneCurve::None => "render-tone-none",
        ToneCurve::Reinhard => "render-tone-reinhard",
        ToneCurve::Filmic => "render-tone-filmic",
    }
}

/// A slider for the exposure, with its name before it if wanted.
pub(crate) fn exposure_ui(ui: &mut Ui, texts: &Texts, stops: &mut f64, is_named: bool) {
    let name = texts.get("render-exposure");
    let tip = texts.tip("render-exposure").unwrap_or_default();
    if is_named {
        ui.label(name).on_hover_text(tip);
    }
    let unit = format!(" {}", texts.get("render-stops"));
    let slider = Slider::new(stops, -STOPS..=STOPS).step_by(0.1).fixed_decimals(1).suffix(unit);
    ui.add(slider).accessible_name(name).on_hover_text(tip);
    let reset = texts.get("render-exposure-reset");
    let button =
        egui::Button::new(RichText::new(ICON_RESTART_ALT.codepoint).size(15.0)).frame_when_inactive(false);
    let response = ui.add_enabled(*stops != 0.0, button).accessible_name(reset).on_hover_text(reset);
    if response.clicked() {
        *stops = 0.0;
    }
}

/// A list of the tone curves.
pub(crate) fn tone_ui(ui: &mut Ui, texts: &Texts, curve: &mut ToneCurve, is_named: bool) {
    let name = texts.get("render-tone");
    let tip = texts.tip("render-tone").unwrap_or_default();
    if is_named {
        ui.label(name).on_hover_text(tip);
    }
    let list = ComboBox::from_id_salt("tone").selected_text(texts.get(tone_key(*curve))).width(130.0);
    let shown = list.show_ui(ui, |ui| {
        for other in ToneCurve::ALL {
            let response = ui.selectable_value(curve, other, texts.get(tone_key(other)));
            response.on_hover_text(texts.tip(tone_key(other)).unwrap_or_default());
        }
    });
    shown.response.accessible_name(name).on_hover_text(tip);
}

/// A list of the kinds of files, its name before it.
pub(crate) fn kind_ui(ui: &mut Ui, texts: &Texts, kind: &mut PictureKind) {
    let name = texts.get("render-kind");
    let tip = texts.tip("render-kind").unwrap_or_default();
    ui.label(name).on_hover_text(tip);
    let list = ComboBox::from_id_salt("kind").selected_text(texts.get(kind.key())).width(120.0);
    let shown = list.show_ui(ui, |ui| {
        for other in PictureKind::ALL {
            let response = ui.selectable_value(kind, other, texts.get(other.key()));
            response.on_hover_text(texts.tip(other.key()).unwrap_or_default());
        }
    });
    shown.response.accessible_name(name).on_hover_text(tip);
}
