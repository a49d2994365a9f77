//! The settings of a method as fields.

use catoptric_scene::format::spec::Limits;
use catoptric_tracer::raster::{
    CubeMapSettings, LightModel, Method, ShadingSettings, SsrFallback, SsrSettings,
};
use egui::{Grid, Ui};

use crate::base::texts::Texts;
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::number::{NumberField, Unit};

/// The width of a field for a number, points.
const FIELD: f32 = 92.0;

/// The width of choices side by side.
const CHOICE: f32 = 190.0;

/// Draws the settings of `method`, a row each; returns whether one was changed. `id` tells one form from another.
pub(crate) fn settings_ui(ui: &mut Ui, texts: &Texts, id: &str, method: &mut Method) -> bool {
    let before = *method;
    let grid = Grid::new(("settings of a method", id)).num_columns(2).spacing([14.0, 6.0]);
    grid.show(ui, |ui| match method {
        Method::Whitted => {}
        Method::Flat(own) | Method::Gouraud(own) | Method::Phong(own) => shading_ui(ui, texts, own),
        Method::Ssr(own) => ssr_ui(ui, texts, own),
        Method::CubeMap(own) => map_ui(ui, texts, own),
    });
    *method != before
}

fn shading_ui(ui: &mut Ui, texts: &Texts, own: &mut ShadingSettings) {
    whole_row(ui, texts, "method-fineness", &mut own.fineness, ShadingSettings::FINENESS);
    check_row(ui, texts, "method-shadows", &mut own.shadows);
    let models = [(LightModel::Lambert, "method-model-lambert"), (LightModel::Phong, "method-model-phong")];
    choice_row(ui, texts, "method-model", &models, &mut own.model);
}

fn ssr_ui(ui: &mut Ui, texts: &Texts, own: &mut SsrSettings) {
    let step = MethodNumber { speed: 0.02, decimals: 2, unit: Unit::Pixels, range: SsrSettings::STEP_PIXELS };
    number_row(ui, texts, "method-step", &step, &mut own.step_pixels);
    let thickness =
        MethodNumber { speed: 0.005, decimals: 3, unit: Unit::Meters, range: SsrSettings::THICKNESS };
    number_row(ui, texts, "method-thickness", &thickness, &mut own.thickness);
    let range = MethodNumber { speed: 0.5, decimals: 2, unit: Unit::Meters, range: SsrSettings::RANGE };
    number_row(ui, texts, "method-range", &range, &mut own.range);
    whole_row(ui, texts, "method-refinements", &mut own.refinements, SsrSettings::REFINEMENTS);
    let maps = match own.fallback {
        SsrFallback::CubeMap(maps) => maps,
        SsrFallback::Background => CubeMapSettings::default(),
    };
    let mut uses_maps = own.fallback != SsrFallback::Background;
    let ways = [(false, "method-fallback-background"), (true, "method-fallback-map")];
    choice_row(ui, texts, "method-fallback", &ways, &mut uses_maps);
    let mut maps = maps;
    if uses_maps {
        map_ui(ui, texts, &mut maps);
    }
    own.fallback = if uses_maps { SsrFallback::CubeMap(maps) } else { SsrFallback::Background };
}

fn map_ui(ui: &mut Ui, texts: &Texts, own: &mut CubeMapSettings) {
    let (least, most) = (f64::from(*CubeMapSettings::SIZE.start()), f64::from(*CubeMapSettings::SIZE.end()));
    let number = MethodNumber { speed: 0.5, decimals: 0, unit: Unit::Pixels, range: least..=most };
    let mut size = f64::from(own.size);
    number_row(ui, texts, "method-map-size", &number, &mut size);
    own.size = size.round().clamp(least, most) as u32;
    check_row(ui, texts, "method-parallax", &mut own.parallax);
}

/// The name of a row, explained when the pointer rests on it.
fn label(ui: &mut Ui, texts: &Texts, key: &'static str) {
    ui.label(texts.get(key)).on_hover_text(texts.tip(key).unwrap_or_default());
}

fn check_row(ui: &mut Ui, texts: &Texts, key: &'static str, value: &mut bool) {
    label(ui, texts, key);
    let response = ui.checkbox(value, "").accessible_name(texts.get(key));
    response.on_hover_text(texts.tip(key).unwrap_or_default());
    ui.end_row();
}

fn choice_row<V: Copy + PartialEq>(
    ui: &mut Ui,
    texts: &Texts,
    key: &'static str,
    ways: &[(V, &'static str)],
    chosen: &mut V,
) {
    label(ui, texts, key);
    let choice = |&(value, key): &(V, &'static str)| {
        let tip = texts.tip(key).unwrap_or_default();
        ChoiceItem { value, text: texts.get(key), tip, is_enabled: true }
    };
    let choices: Vec<ChoiceItem<'_, V>> = ways.iter().map(choice).collect();
    if let Some(other) =
        choice_ui(ui, ui.scope_id().with(key), texts.get(key), CHOICE, &choices, Some(*chosen))
    {
        *chosen = other;
    }
    ui.end_row();
}

fn whole_row(
    ui: &mut Ui,
    texts: &Texts,
    key: &'static str,
    value: &mut u32,
    range: std::ops::RangeInclusive<u32>,
) {
    let (least, most) = (*range.start(), *range.end());
    let number =
        MethodNumber { speed: 0.1, decimals: 0, unit: Unit::None, range: f64::from(least)..=f64::from(most) };
    let mut entered = f64::from(*value);
    number_row(ui, texts, key, &number, &mut entered);
    // Dragging gives fractions.
    *value = (entered.round() as u32).clamp(least, most);
}

/// A number field of a method's settings.
struct MethodNumber {
    speed: f64,
    decimals: usize,
    unit: Unit,
    range: std::ops::RangeInclusive<f64>,
}

fn number_row(ui: &mut Ui, texts: &Texts, key: &'static str, number: &MethodNumber, value: &mut f64) {
    label(ui, texts, key);
    let (least, most) = (*number.range.start(), *number.range.end());
    let field = NumberField {
        texts,
        name: texts.get(key),
        value: *value,
        is_mixed: false,
        limits: Limits::new(least, most),
        speed: number.speed,
        decimals: number.decimals,
        unit: number.unit,
        edge: None,
        width: FIELD,
        explains: true,
    };
    let entered = field.show(ui);
    entered.response.on_hover_text(texts.tip(key).unwrap_or_default());
    if let Some(entered) = entered.value {
        *value = entered.clamp(least, most);
    }
    ui.end_row();
}
