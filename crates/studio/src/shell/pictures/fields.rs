//! The fields of development and format that the dialog and the window of a picture share.

use catoptric_picture::{Development, ToneCurve};
use egui::{ComboBox, RichText, Ui};
use egui_material_icons::icons::ICON_RESTART_ALT;

use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::icon_button;
use crate::base::widgets::number::Unit;
use crate::base::widgets::slider::SliderField;
use crate::state::render_choices::PictureKind;

/// The exposure that can be chosen, stops to either side.
const STOPS: f64 = 10.0;

/// The message that names a tone curve.
const fn tone_key(curve: ToneCurve) -> &'static str {
    match curve {
        ToneCurve::None => "viewport-tone-none",
        ToneCurve::Reinhard => "viewport-tone-reinhard",
        ToneCurve::Filmic => "viewport-tone-filmic",
        ToneCurve::LinearCodes => "viewport-tone-linear-codes",
    }
}

/// A slider for the exposure.
pub(crate) fn exposure_ui(ui: &mut Ui, texts: &Texts, development: &mut Development) {
    let stops = &mut development.exposure_stops;
    let slider = SliderField {
        texts,
        name: texts.get("viewport-exposure"),
        value: *stops,
        range: -STOPS..=STOPS,
        is_logarithmic: false,
        step: 0.1,
        decimals: 2,
        unit: Unit::Stops,
        width: 82.0,
    };
    let (response, changed) = slider.show(ui);
    response.on_hover_text(texts.tip("viewport-exposure-slider").unwrap_or_default());
    *stops = changed.unwrap_or(*stops);
    if *stops != 0.0
        && icon_button(ui, ICON_RESTART_ALT, texts.get("viewport-exposure-reset"), false).clicked()
    {
        *stops = 0.0;
    }
}

/// A list of the tone curves.
pub(crate) fn tone_ui(ui: &mut Ui, texts: &Texts, development: &mut Development) {
    let curve = &mut development.tone_curve;
    let list = ComboBox::from_id_salt("tone").selected_text(texts.get(tone_key(*curve))).width(130.0);
    let shown = list.show_ui(ui, |ui| {
        for other in ToneCurve::ALL {
            let response = ui.selectable_value(curve, other, texts.get(tone_key(other)));
            response.on_hover_text(texts.tip(tone_key(other)).unwrap_or_default());
        }
    });
    let tip = texts.tip(tone_key(*curve)).unwrap_or_default();
    shown.response.accessible_name(texts.get("viewport-tone")).on_hover_text(tip);
}

/// A list of the kinds of files.
pub(crate) fn kind_ui(ui: &mut Ui, texts: &Texts, kind: &mut PictureKind) {
    let list = ComboBox::from_id_salt("kind").selected_text(texts.get(kind.key())).width(112.0);
    let shown = list.show_ui(ui, |ui| {
        for other in PictureKind::ALL {
            let response = ui.selectable_value(kind, other, texts.get(other.key()));
            response.on_hover_text(texts.tip(other.key()).unwrap_or_default());
        }
    });
    let tip = texts.tip(kind.key()).unwrap_or_default();
    shown.response.accessible_name(texts.get("render-kind")).on_hover_text(tip);
}

/// The name of a field, of little weight beside it.
pub(crate) fn name_ui(ui: &mut Ui, name: &str) {
    ui.label(RichText::new(name).color(theme::palette(ui.visuals()).weak));
}
