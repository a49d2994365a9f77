//! The environment and the limits of tracing.

use std::sync::Arc;

use catoptric_scene::format::keys;
use catoptric_scene::{Environment, Tracing};
use egui::{Id, Ui};

use super::sheet::{ColorRow, Number, Quantity, Rail, Sheet};
use super::symbol::Symbol;
use super::{Memory, depth};
use crate::context::Cx;
use crate::widgets::section::section;

static BACKGROUND: ColorRow<Environment> = ColorRow {
    what: Quantity::new("background", "edit-background", &keys::ENVIRONMENT, "background"),
    get: |environment| Some(environment.background),
    set: |environment, color| environment.background = color,
};

static AMBIENT: ColorRow<Environment> = ColorRow {
    what: Quantity::new("ambient-light", "edit-ambient-light", &keys::ENVIRONMENT, "ambient")
        .with_symbol(Symbol::AmbientLight),
    get: |environment| Some(environment.ambient),
    set: |environment, color| environment.ambient = color,
};

static GENERATIONS: Number<Tracing> = Number::<Tracing>::new(
    Quantity::new("generations", "edit-generations", &keys::TRACING, "generations"),
    Rail::Even(1.0, 64.0),
    |tracing| Some(f64::from(tracing.generations)),
    // A float to an integer saturates; the limits of the row are those of the format.
    |tracing, value| tracing.generations = value.round() as u32,
)
.tuned(0.1, 0);

static THRESHOLD: Number<Tracing> = Number::<Tracing>::new(
    Quantity::new("threshold", "edit-threshold", &keys::TRACING, "threshold"),
    Rail::Logarithmic(0.0, 1.0),
    |tracing| Some(tracing.threshold),
    |tracing, value| tracing.threshold = value,
)
.tuned(0.001, 4);

/// Draws background and ambient light.
pub(super) fn environment_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut Memory) {
    let scene = Arc::clone(cx.editor.scene());
    let mut sheet = Sheet {
        primary: &scene.environment,
        things: vec![&scene.environment],
        subject: String::new(),
        id: Id::unique("inspector-environment"),
        is_free: true,
        apply: &|editor, label, change| editor.change_environment(label, |own| change(0, own)),
        cx,
        memory,
    };
    let texts = sheet.texts();
    section(ui, "environment", texts.get("thing-environment"), "", true, |ui| {
        sheet.color(ui, &BACKGROUND);
        sheet.color(ui, &AMBIENT);
    });
}

/// Draws the limits of tracing.
pub(super) fn tracing_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut Memory) {
    let scene = Arc::clone(cx.editor.scene());
    let mut sheet = Sheet {
        primary: &scene.tracing,
        things: vec![&scene.tracing],
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
