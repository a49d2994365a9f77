//! The dialog that asks how to render a picture.

mod estimate;
mod size;

use catoptric_picture::Development;
use catoptric_scene::Tracing;
use egui::{DragValue, Grid, Label, Response, RichText, Ui};
use egui_material_icons::icons::{ICON_INFO, ICON_MEMORY, ICON_SCHEDULE, ICON_WARNING};

use super::{Dialog, Flow, buttons_if};
use crate::app::Studio;
use crate::pictures::{self, PictureKind, RenderChoices, fields, told};
use crate::texts::Texts;
use crate::theme;
use estimate::{Estimate, Time};
use size::Size;

/// Samples to choose from: powers of four, since noise of edges halves with each.
const SAMPLES: [u32; 5] = [1, 4, 16, 64, 256];

/// Asks for size, samples, generations and the kind of file, and starts the render.
pub(crate) struct RenderDialog {
    choices: RenderChoices,
    development: Development,
    size: Size,
    estimate: Estimate,
    /// Bytes of memory that were free when the dialog was opened.
    free_memory: Option<u64>,
}

/// Opens the dialog.
pub(crate) fn open(studio: &mut Studio) {
    let choices = studio.settings.render.clone();
    let dialog = RenderDialog {
        development: studio.view.development,
        size: Size::new(&choices, studio.panes.viewport.size_in_pixels()),
        estimate: Estimate::default(),
        free_memory: studio.host.free_memory(),
        choices,
    };
    studio.dialogs.open(dialog);
}

impl Dialog for RenderDialog {
    fn title(&self, texts: &Texts) -> String {
        texts.get("render-title").to_owned()
    }

    fn width(&self) -> f32 {
        500.0
    }

    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> Flow {
        let texts = &studio.texts;
        let scene = studio.editor.scene();
        Grid::new("render fields").num_columns(2).spacing([18.0, 10.0]).show(ui, |ui| {
            self.size.rows_ui(ui, texts, &mut self.choices);
            samples_row(ui, texts, &mut self.choices.samples);
            generations_row(ui, texts, &mut self.choices.generations, scene.tracing.generations);
            label(ui, texts, "render-kind");
            kinds_ui(ui, texts, &mut self.choices.kind);
            ui.end_row();
            let is_developed = self.choices.kind != PictureKind::Exr;
            label(ui, texts, "render-exposure");
            ui.add_enabled_ui(is_developed, |ui| {
                ui.horizontal(|ui| {
                    fields::exposure_ui(ui, texts, &mut self.development.exposure_stops, false);
                });
            });
            ui.end_row();
            label(ui, texts, "render-tone");
            ui.add_enabled_ui(is_developed, |ui| {
                fields::tone_ui(ui, texts, &mut self.development.tone_curve, false);
            });
            ui.end_row();
        });
        ui.add_space(2.0);
        let time = self.estimate.time(ui.ctx(), studio, &self.choices);
        let is_ready = self.notes_ui(ui, studio, time);
        let start = match studio.pictures.is_rendering() {
            true => studio.texts.get("render-start-anew"),
            false => studio.texts.get("render-start"),
        };
        match buttons_if(ui, &[start, studio.texts.get("cancel")], is_ready) {
            Some(0) => {
                studio.settings.render = self.choices.clone();
                pictures::start(studio, self.choices.clone(), self.development);
                Flow::Close
            }
            Some(_) => Flow::Close,
            None => Flow::Stay,
        }
    }
}

impl RenderDialog {
    /// What is to be known before: what it costs, and whether it is possible at all.
    fn notes_ui(&self, ui: &mut Ui, studio: &Studio, time: Time) -> bool {
        let texts = &studio.texts;
        let palette = theme::palette(ui.visuals());
        ui.separator();
        let camera = match studio.view.free_camera {
            Some(_) => texts.get("render-note-camera"),
            None => texts.get("render-note-snapshot"),
        };
        note(ui, ICON_INFO.codepoint, camera, palette.weak);
        if self.choices.kind == PictureKind::Exr {
            note(ui, ICON_INFO.codepoint, texts.get("render-note-exr"), palette.weak);
        }
        if let Some(problem) = self.problem(texts) {
            note(ui, ICON_WARNING.codepoint, &problem, palette.error);
            return false;
        }
        let memory = told::bytes(texts, self.choices.bytes());
        let memory = texts.with("render-memory", &[("bytes", memory.into())]);
        note(ui, ICON_MEMORY.codepoint, &memory, palette.weak);
        let time = match time {
            Time::Unknown => texts.get("render-time-unknown").to_owned(),
            Time::Seconds(seconds) => {
                texts.with("render-time", &[("time", told::rough_time(texts, seconds).into())])
            }
        };
        note(ui, ICON_SCHEDULE.codepoint, &time, palette.weak);
        if studio.pictures.is_rendering() {
            note(ui, ICON_WARNING.codepoint, texts.get("render-note-running"), palette.warning);
        }
        true
    }

    /// Why there can be no such picture.
    fn problem(&self, texts: &Texts) -> Option<String> {
        if let Err(error) = self.choices.check_size() {
            return Some(told::size_error(texts, &error));
        }
        let (needed, free) = (self.choices.bytes(), self.free_memory?);
        (needed > free).then(|| {
            let arguments =
                [("bytes", told::bytes(texts, needed).into()), ("free", told::bytes(texts, free).into())];
            texts.with("render-too-much-memory", &arguments)
        })
    }
}

/// The name of a row, explained when the pointer rests on it.
fn label(ui: &mut Ui, texts: &Texts, key: &str) -> Response {
    ui.label(texts.get(key)).on_hover_text(texts.tip(key).unwrap_or_default())
}

/// A line with an icon.
fn note(ui: &mut Ui, icon: &str, text: &str, color: egui::Color32) {
    ui.horizontal_top(|ui| {
        ui.add(Label::new(RichText::new(icon).size(15.0).color(color)));
        ui.add(Label::new(RichText::new(text).color(color)).wrap());
    });
}

fn samples_row(ui: &mut Ui, texts: &Texts, samples: &mut u32) {
    label(ui, texts, "render-samples");
    ui.horizontal(|ui| {
        let name = texts.get("render-samples");
        for few in SAMPLES {
            choice(ui, samples, few, &few.to_string(), name);
        }
        let field = DragValue::new(samples).range(1..=RenderChoices::MAX_SAMPLES).speed(0.2);
        let tip = texts.tip("render-samples").unwrap_or_default();
        ui.add(field).accessible_name(name).on_hover_text(tip);
    });
    ui.end_row();
}

fn generations_row(ui: &mut Ui, texts: &Texts, generations: &mut Option<u32>, of_scene: u32) {
    label(ui, texts, "render-generations");
    ui.horizontal(|ui| {
        let name = texts.get("render-generations");
        let text = texts.with("render-generations-scene", &[("count", of_scene.into())]);
        choice(ui, generations, None, &text, name);
        let is_own = generations.is_some();
        let own = texts.get("render-generations-own");
        let response = ui.selectable_label(is_own, own).accessible_name(format!("{name}: {own}"));
        if response.clicked() && !is_own {
            *generations = Some(of_scene);
        }
        let mut number = generations.unwrap_or(of_scene);
        let field = DragValue::new(&mut number).range(1..=Tracing::MAX_GENERATIONS).speed(0.1);
        let tip = texts.tip("render-generations").unwrap_or_default();
        let response = ui.add_enabled(is_own, field).accessible_name(name).on_hover_text(tip);
        if response.changed() {
            *generations = Some(number);
        }
    });
    ui.end_row();
}

fn kinds_ui(ui: &mut Ui, texts: &Texts, kind: &mut PictureKind) {
    ui.horizontal(|ui| {
        for other in PictureKind::ALL {
            let response = choice(ui, kind, other, texts.get(other.key()), texts.get("render-kind"));
            response.on_hover_text(texts.tip(other.key()).unwrap_or_default());
        }
    });
}

/// One of a few values side by side; its accessible name begins with that of the row.
fn choice<V: PartialEq>(ui: &mut Ui, value: &mut V, own: V, text: &str, name: &str) -> Response {
    let response = ui.selectable_label(*value == own, text).accessible_name(format!("{name}: {text}"));
    if response.clicked() {
        *value = own;
    }
    response
}
