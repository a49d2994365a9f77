//! Lights: place, color, intensity and the law of falloff, with its formula.

use std::sync::Arc;

use catoptric_scene::format::keys;
use catoptric_scene::{Falloff, Light, ScenePart};
use egui::{Id, Ui};

use super::sheet::{
    ColorRow, NumberRow, PropertySheet, RowQuantity, SliderRail, Unit, VectorRow, VectorSpread,
};
use super::symbol::Symbol;
use super::{InspectorState, formula, header};
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::section::section;
use crate::state::context::Cx;

static POSITION: VectorRow<Light> = VectorRow::<Light>::new(
    RowQuantity::new("light-position", "edit-position", &keys::LIGHT, "position").in_unit(Unit::Meters),
    VectorSpread::Offset,
    |light| Some(light.position),
    |light, value| light.position = value,
);

static COLOR: ColorRow<Light> = ColorRow {
    what: RowQuantity::new("light-color", "edit-color", &keys::LIGHT, "color")
        .with_symbol(Symbol::LightColor),
    get: |light| Some(light.color),
    set: |light, color| light.color = color,
};

static INTENSITY: NumberRow<Light> = NumberRow::<Light>::new(
    RowQuantity::new("intensity", "edit-intensity", &keys::LIGHT, "intensity").with_symbol(Symbol::Intensity),
    SliderRail::Even(0.0, 4.0),
    |light| Some(light.intensity),
    |light, value| light.intensity = value,
);

static CONSTANT: NumberRow<Light> = NumberRow::<Light>::new(
    RowQuantity::new("falloff-constant", "edit-falloff-constant", &keys::LIGHT, "falloff_constant")
        .in_unit(Unit::Meters)
        .with_symbol(Symbol::FalloffConstant),
    SliderRail::Even(0.0, 10.0),
    |light| if let Falloff::Linear { constant } = light.falloff { Some(constant) } else { None },
    |light, value| light.falloff = Falloff::Linear { constant: value },
);

static RADIUS: NumberRow<Light> = NumberRow::<Light>::new(
    RowQuantity::new("light-radius", "edit-light-radius", &keys::LIGHT, "radius").in_unit(Unit::Meters),
    SliderRail::Even(0.0, 3.0),
    |light| Some(light.radius),
    |light, value| light.radius = value,
);

/// Draws the values of the selected lights.
pub(super) fn lights_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut InspectorState) {
    let scene = Arc::clone(cx.editor.scene());
    let selected = cx.editor.selected_lights().rev().collect();
    let chosen = header::chosen_ui(ui, cx, ScenePart::Light, selected, "several-lights");
    let Some(header::InspectedItems { indices, first, item, subject, is_free }) = chosen else { return };
    let Some(primary) = scene.lights.get(first) else { return };
    let mut sheet = PropertySheet {
        primary,
        things: indices.iter().filter_map(|&index| scene.lights.get(index)).collect(),
        place: ScenePart::Light(first).into(),
        subject,
        id: Id::unique(("inspector-light", item)),
        is_free,
        apply: &|editor, label, change| {
            // They are changed in the order in which they are given.
            let mut places = 0..;
            editor.change_lights(indices.iter().copied(), label, |_, light| {
                change(places.next().unwrap_or_default(), light);
            })
        },
        cx,
        memory,
    };
    rows_ui(ui, &mut sheet);
}

fn rows_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Light>) {
    let texts = sheet.texts();
    section(ui, "light", texts.get("section-light"), "", sheet.is_free, |ui| {
        sheet.vector(ui, &POSITION);
        sheet.color(ui, &COLOR);
        sheet.number(ui, &INTENSITY, None);
        sheet.number(ui, &RADIUS, None);
    });
    section(ui, "falloff", texts.get("falloff"), "", sheet.is_free, |ui| {
        falloff_ui(ui, sheet);
        sheet.number(ui, &CONSTANT, None);
        formula::falloff_ui(ui, texts, sheet.memory, sheet.primary);
    });
}

fn falloff_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Light>) {
    let texts = sheet.texts();
    let own = sheet.primary.falloff;
    let constant = if let Falloff::Linear { constant } = own { constant } else { 1.0 };
    let laws = [
        (Falloff::None, "falloff-none"),
        (Falloff::Linear { constant }, "falloff-linear"),
        (Falloff::InverseSquare, "falloff-square"),
    ];
    let choices = laws.map(|(value, key)| ChoiceItem {
        value,
        text: texts.get(key),
        tip: texts.tip(key).unwrap_or_default(),
        is_enabled: true,
    });
    let is_mixed = sheet.things.iter().any(|light| light.falloff.key() != own.key());
    let id = sheet.id.with("falloff");
    let width = ui.available_width();
    let chosen = (!is_mixed).then_some(own);
    if let Some(falloff) = choice_ui(ui, id, texts.get("falloff"), width, &choices, chosen) {
        sheet.change("falloff", "edit-falloff", |_, light| light.falloff = falloff);
    }
    sheet.note(ui, "falloff");
}
