//! The environment and the limits of tracing.

use std::sync::Arc;

use catoptric_scene::format::keys;
use catoptric_scene::{Color, Contact, Environment, ScenePart, Sky, Surroundings, Tracing};
use egui::{Id, Ui};

use super::image::{ImageMenuChoice, OtherChoice};
use super::sheet::{ColorRow, NumberRow, PropertySheet, RowQuantity, SliderRail, Unit};
use super::symbol::Symbol;
use super::{InspectorState, depth, image};
use crate::base::widgets::section::section;
use crate::state::context::Cx;
use crate::state::images::ImageUse;

static BACKGROUND: ColorRow<Environment> = ColorRow {
    what: RowQuantity::new("background", "edit-background", &keys::ENVIRONMENT, "background"),
    get: |environment| (environment.surroundings == Surroundings::Even).then_some(environment.background),
    set: |environment, color| environment.background = color,
};

static AMBIENT: ColorRow<Environment> = ColorRow {
    what: RowQuantity::new("ambient-light", "edit-ambient-light", &keys::ENVIRONMENT, "ambient")
        .with_symbol(Symbol::AmbientLight),
    get: |environment| Some(environment.ambient),
    set: |environment, color| environment.ambient = color,
};

/// A color of the sky.
const fn of_sky(
    key: &'static str,
    edit: &'static str,
    name: &'static str,
    get: fn(&Environment) -> Option<Color>,
    set: fn(&mut Environment, Color),
) -> ColorRow<Environment> {
    ColorRow { what: RowQuantity::new(key, edit, &keys::SKY, name), get, set }
}

fn sky(environment: &Environment) -> Option<&Sky> {
    environment.surroundings.sky()
}

fn sky_mut(environment: &mut Environment) -> Option<&mut Sky> {
    match &mut environment.surroundings {
        Surroundings::Sky(sky) => Some(sky),
        Surroundings::Even | Surroundings::Picture(_) => None,
    }
}

static SKY: [ColorRow<Environment>; 3] = [
    of_sky(
        "sky-zenith",
        "edit-sky-zenith",
        "zenith",
        |around| sky(around).map(|sky| sky.zenith),
        |around, color| sky_mut(around).into_iter().for_each(|sky| sky.zenith = color),
    ),
    of_sky(
        "sky-horizon",
        "edit-sky-horizon",
        "horizon",
        |around| sky(around).map(|sky| sky.horizon),
        |around, color| sky_mut(around).into_iter().for_each(|sky| sky.horizon = color),
    ),
    of_sky(
        "sky-nadir",
        "edit-sky-nadir",
        "nadir",
        |around| sky(around).map(|sky| sky.nadir),
        |around, color| sky_mut(around).into_iter().for_each(|sky| sky.nadir = color),
    ),
];

static ROTATION: NumberRow<Environment> = NumberRow::<Environment>::new(
    RowQuantity::new("picture-rotation", "edit-picture-rotation", &keys::ENVIRONMENT, "rotation")
        .in_unit(Unit::Degrees),
    SliderRail::Even(-180.0, 180.0),
    |around| around.surroundings.picture().map(|_| around.rotation_degrees),
    |around, value| around.rotation_degrees = value,
)
.tuned(0.5, 1);

static STRENGTH: NumberRow<Environment> = NumberRow::<Environment>::new(
    RowQuantity::new("sky-strength", "edit-sky-strength", &keys::ENVIRONMENT, "strength"),
    SliderRail::Even(0.0, 4.0),
    |around| (around.surroundings != Surroundings::Even).then_some(around.strength),
    |around, value| around.strength = value,
);

static GENERATIONS: NumberRow<Tracing> = NumberRow::<Tracing>::new(
    RowQuantity::new("generations", "edit-generations", &keys::TRACING, "generations"),
    SliderRail::Even(1.0, 64.0),
    |tracing| Some(f64::from(tracing.generations)),
    // A float to an integer saturates; the limits of the row are those of the format.
    |tracing, value| tracing.generations = value.round() as u32,
)
.tuned(0.1, 0);

static THRESHOLD: NumberRow<Tracing> = NumberRow::<Tracing>::new(
    RowQuantity::new("threshold", "edit-threshold", &keys::TRACING, "threshold"),
    SliderRail::Logarithmic(0.0, 1.0),
    |tracing| Some(tracing.threshold),
    |tracing, value| tracing.threshold = value,
)
.tuned(0.001, 4);

/// Draws what surrounds the bodies, and ambient light.
pub(super) fn environment_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut InspectorState) {
    let scene = Arc::clone(cx.editor.scene());
    let mut sheet = PropertySheet {
        primary: &scene.environment,
        things: vec![&scene.environment],
        place: ScenePart::Environment.into(),
        subject: String::new(),
        id: Id::unique("inspector-environment"),
        is_free: true,
        apply: &|editor, label, change| editor.change_environment(label, |own| change(0, own)),
        cx,
        memory,
    };
    let texts = sheet.texts();
    section(ui, "environment", texts.get("thing-environment"), "", true, |ui| {
        around_ui(ui, &mut sheet);
        sheet.color(ui, &BACKGROUND);
        for row in &SKY {
            sheet.color(ui, row);
        }
        sheet.number(ui, &ROTATION, None);
        sheet.number(ui, &STRENGTH, None);
        sheet.color(ui, &AMBIENT);
        contact_ui(ui, &mut sheet);
    });
}

/// Draws the choice of what lies between bodies that touch.
fn contact_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Environment>) {
    let choices = [(Contact::Air, "contact-of-scene-air"), (Contact::Cemented, "contact-of-scene-cemented")];
    if let Some(contact) = sheet.choice(ui, "contact", &choices, Some(sheet.primary.contact)) {
        sheet.change("contact", "edit-contact", |_, environment| environment.contact = contact);
    }
}

/// Draws the choice of what surrounds the bodies.
fn around_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Environment>) {
    let now = &sheet.primary.surroundings;
    let is_even = *now == Surroundings::Even;
    let others = [
        OtherChoice { key: "around-even", is_chosen: is_even, value: false },
        OtherChoice { key: "around-sky", is_chosen: now.sky().is_some(), value: true },
    ];
    let picture = now.picture();
    let picked = image::choice_ui(ui, sheet, "surroundings", ImageUse::Surroundings, &others, picture);
    let Some(picked) = picked else { return };
    let chosen = match picked {
        ImageMenuChoice::Other(false) => Surroundings::Even,
        ImageMenuChoice::Other(true) => Surroundings::Sky(Sky::default()),
        ImageMenuChoice::Picture(image) => Surroundings::Picture(image),
    };
    sheet.change("surroundings", "edit-surroundings", |_, around| around.surroundings = chosen.clone());
}

/// Draws the limits of tracing.
pub(super) fn tracing_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut InspectorState) {
    let scene = Arc::clone(cx.editor.scene());
    let mut sheet = PropertySheet {
        primary: &scene.tracing,
        things: vec![&scene.tracing],
        place: ScenePart::Tracing.into(),
        subject: String::new(),
        id: Id::unique("inspector-tracing"),
        is_free: true,
        apply: &|editor, label, change| editor.change_tracing(label, |own| change(0, own)),
        cx,
        memory,
    };
    let texts = sheet.texts();
    section(ui, "tracing", texts.get("thing-tracing"), "", true, |ui| {
        sheet.number(ui, &GENERATIONS, None);
        sheet.number(ui, &THRESHOLD, None);
        depth::depth_ui(ui, &mut sheet);
    });
}
