//! The dialog that asks how to render a picture.

mod estimate;
mod size;

use catoptric_picture::{Development, FormatError};
use catoptric_scene::Tracing;
use catoptric_scene::format::spec::Limits;
use catoptric_tracer::RenderSettings;
use catoptric_tracer::raster::MethodKind;
use egui::{ComboBox, Grid, Label, Response, RichText, Ui};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons::{ICON_INFO, ICON_MEMORY, ICON_SCHEDULE, ICON_WARNING};

use crate::base::texts::Texts;
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::icon_ui;
use crate::base::widgets::number::{NumberField, Refusal, Unit};
use crate::base::{theme, words};
use crate::shell::pictures::{self, fields};
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::{Dialog, DialogFlow, body_ui, buttons_if};
use crate::state::methods::method_key;
use crate::state::render_choices::{PictureKind, RenderChoices};
use estimate::{RenderEstimate, RenderTime};
use size::SizeFields;

/// Samples to choose from: powers of four, since noise of edges halves with each.
const SAMPLES: [u32; 5] = [1, 4, 16, 64, 256];

/// The width of choices side by side.
const WIDTH: f32 = 300.0;

/// The width of a field for a number.
const FIELD: f32 = 84.0;

/// Asks for size, samples, generations and the kind of file, and starts the render.
pub(crate) struct RenderDialog {
    choices: RenderChoices,
    development: Development,
    method: MethodKind,
    size: SizeFields,
    estimate: RenderEstimate,
    /// Why a text that waits in one of the fields is no number for it.
    refused: Option<Refusal>,
    /// Bytes of memory that were free when the dialog was opened.
    free_memory: Option<u64>,
}

/// Opens the dialog.
pub(crate) fn open(studio: &mut Studio) {
    let choices = studio.settings.render.clone();
    let dialog = RenderDialog {
        development: studio.view.development,
        method: studio.settings.methods.kind(),
        size: SizeFields::new(&choices, studio.panes.viewport.size_in_pixels()),
        estimate: RenderEstimate::default(),
        refused: None,
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

    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> DialogFlow {
        let texts = &studio.texts;
        let scene = studio.editor.scene();
        self.refused = None;
        let is_ready = body_ui(ui, |ui| {
            Grid::new("render fields").num_columns(2).spacing([18.0, 10.0]).show(ui, |ui| {
                self.size.rows_ui(ui, texts, &mut self.choices, &mut self.refused);
                samples_row(ui, texts, &mut self.choices.samples, &mut self.refused);
                let generations = &mut self.choices.generations;
                generations_row(ui, texts, generations, scene.tracing.generations, &mut self.refused);
                method_row(ui, texts, &mut self.method);
                kind_row(ui, texts, &mut self.choices.kind);
                self.development_rows(ui, texts);
            });
            ui.add_space(2.0);
            // Only of tracing it is known how the time grows.
            let is_traced = self.method.abilities().has_ray_tree;
            let time = is_traced.then(|| self.estimate.time(ui.ctx(), studio, &self.choices));
            self.notes_ui(ui, studio, time)
        });
        let start = match studio.pictures.is_rendering() {
            true => studio.texts.get("render-start-anew"),
            false => studio.texts.get("render-start"),
        };
        match buttons_if(ui, &[start, studio.texts.get("cancel")], is_ready) {
            Some(0) => {
                studio.settings.render = self.choices.clone();
                let method = studio.settings.methods.of(self.method);
                pictures::start(studio, self.choices.clone(), self.development, method);
                DialogFlow::Close
            }
            Some(_) => DialogFlow::Close,
            None => DialogFlow::Stay,
        }
    }
}

impl RenderDialog {
    /// Exposure and tone curve, which do not concern linear light.
    fn development_rows(&mut self, ui: &mut Ui, texts: &Texts) {
        let is_developed = !self.choices.kind.is_linear();
        label(ui, texts, "viewport-exposure");
        ui.add_enabled_ui(is_developed, |ui| {
            ui.horizontal(|ui| fields::exposure_ui(ui, texts, &mut self.development));
        });
        ui.end_row();
        label(ui, texts, "viewport-tone");
        ui.add_enabled_ui(is_developed, |ui| fields::tone_ui(ui, texts, &mut self.development));
        ui.end_row();
    }

    /// What is to be known before: what it costs, and whether it is possible at all.
    fn notes_ui(&self, ui: &mut Ui, studio: &Studio, time: Option<RenderTime>) -> bool {
        let texts = &studio.texts;
        let palette = theme::palette(ui.visuals());
        ui.separator();
        let camera = match studio.view.free_camera {
            Some(_) => texts.get("render-note-camera"),
            None => texts.get("render-note-snapshot"),
        };
        note(ui, ICON_INFO, camera, palette.weak);
        if self.choices.kind.is_linear() {
            note(ui, ICON_INFO, texts.get("render-note-linear"), palette.weak);
        }
        if let Some(refused) = &self.refused {
            note(ui, ICON_WARNING, &refused.explained(texts), palette.error);
            return false;
        }
        if let Some(problem) = self.problem(texts) {
            note(ui, ICON_WARNING, &problem, palette.error);
            return false;
        }
        let memory = words::bytes(texts, self.choices.bytes());
        let memory = texts.with("render-memory", &[("bytes", memory.into())]);
        note(ui, ICON_MEMORY, &memory, palette.weak);
        if let Some(time) = time {
            let time = match time {
                RenderTime::Unknown => texts.get("render-time-unknown").to_owned(),
                RenderTime::Seconds(seconds) => {
                    texts.with("render-time", &[("time", words::rough_time(texts, seconds).into())])
                }
            };
            note(ui, ICON_SCHEDULE, &time, palette.weak);
        }
        if studio.pictures.is_rendering() {
            note(ui, ICON_WARNING, texts.get("render-note-running"), palette.warning);
        }
        true
    }

    /// Why there can be no such picture.
    fn problem(&self, texts: &Texts) -> Option<String> {
        if let Err(error) = self.choices.check_size() {
            return Some(words::size_error(texts, &error));
        }
        if !self.choices.fits_kind() {
            let format = self.choices.kind.format();
            let (width, height) = (self.choices.width, self.choices.height);
            let error = FormatError::Side { format, width, height, most: format.max_side() };
            return Some(words::format_error(texts, &error));
        }
        let (needed, free) = (self.choices.bytes(), self.free_memory?);
        (needed > free).then(|| {
            let arguments =
                [("bytes", words::bytes(texts, needed).into()), ("free", words::bytes(texts, free).into())];
            texts.with("render-too-much-memory", &arguments)
        })
    }
}

/// The name of a row, explained when the pointer rests on it.
fn label(ui: &mut Ui, texts: &Texts, key: &str) -> Response {
    ui.label(texts.get(key)).on_hover_text(texts.tip(key).unwrap_or_default())
}

/// A line with an icon.
fn note(ui: &mut Ui, icon: MaterialIcon, text: &str, color: egui::Color32) {
    ui.horizontal_top(|ui| {
        icon_ui(ui, icon, 15.0, color);
        ui.add(Label::new(RichText::new(text).color(color)).wrap());
    });
}

/// Draws a field for a whole number from 1 to `most`.
fn whole_ui(
    ui: &mut Ui,
    texts: &Texts,
    whole: &IntegerField<'_>,
    number: &mut u32,
    refused: &mut Option<Refusal>,
) -> bool {
    let field = NumberField {
        texts,
        name: whole.name,
        value: f64::from(*number),
        is_mixed: false,
        limits: Limits::new(1.0, f64::from(whole.most)),
        speed: whole.speed,
        decimals: 0,
        unit: Unit::None,
        edge: None,
        width: FIELD,
        explains: false,
    };
    let entered = field.show(ui);
    entered.response.on_hover_text(whole.tip);
    if entered.waiting.is_some() {
        *refused = entered.waiting;
    }
    let Some(value) = entered.value else { return false };
    // Dragging gives fractions; nothing that is typed lies beyond the limits.
    let value = (value.round() as u32).clamp(1, whole.most);
    std::mem::replace(number, value) != value
}

/// A field for a whole number.
struct IntegerField<'a> {
    name: &'a str,
    tip: &'a str,
    most: u32,
    speed: f64,
}

fn samples_row(ui: &mut Ui, texts: &Texts, samples: &mut u32, refused: &mut Option<Refusal>) {
    let name = texts.get("render-samples");
    let tip = texts.tip("render-samples").unwrap_or_default();
    label(ui, texts, "render-samples");
    ui.horizontal(|ui| {
        let counts = SAMPLES.map(|count| count.to_string());
        let choices: Vec<ChoiceItem<'_, u32>> = SAMPLES
            .iter()
            .zip(&counts)
            .map(|(&value, text)| ChoiceItem { value, text, tip: "", is_enabled: true })
            .collect();
        if let Some(few) = choice_ui(ui, ui.scope_id().with("samples"), name, WIDTH, &choices, Some(*samples))
        {
            *samples = few;
        }
        let whole = IntegerField { name, tip, most: RenderSettings::MAX_SAMPLES, speed: 0.2 };
        whole_ui(ui, texts, &whole, samples, refused);
    });
    ui.end_row();
}

fn generations_row(
    ui: &mut Ui,
    texts: &Texts,
    generations: &mut Option<u32>,
    of_scene: u32,
    refused: &mut Option<Refusal>,
) {
    let name = texts.get("render-generations");
    let tip = texts.tip("render-generations").unwrap_or_default();
    label(ui, texts, "render-generations");
    ui.horizontal(|ui| {
        let as_in_scene = texts.with("render-generations-scene", &[("count", of_scene.into())]);
        let choices = [
            ChoiceItem { value: false, text: &as_in_scene, tip, is_enabled: true },
            ChoiceItem { value: true, text: texts.get("render-generations-own"), tip, is_enabled: true },
        ];
        let is_own = generations.is_some();
        match choice_ui(ui, ui.scope_id().with("generations"), name, WIDTH, &choices, Some(is_own)) {
            Some(true) => *generations = Some(of_scene),
            Some(false) => *generations = None,
            None => {}
        }
        let mut number = generations.unwrap_or(of_scene);
        let name = format!("{name}: {}", texts.get("render-generations-own"));
        let whole = IntegerField { name: &name, tip, most: Tracing::MAX_GENERATIONS, speed: 0.1 };
        ui.add_enabled_ui(is_own, |ui| {
            if whole_ui(ui, texts, &whole, &mut number, refused) {
                *generations = Some(number);
            }
        });
    });
    ui.end_row();
}

/// How it is drawn; the settings of a method are those of the viewport.
fn method_row(ui: &mut Ui, texts: &Texts, kind: &mut MethodKind) {
    label(ui, texts, "render-method");
    let list =
        ComboBox::from_id_salt("method").selected_text(texts.get(method_key(*kind))).width(WIDTH - 8.0);
    let shown = list.show_ui(ui, |ui| {
        for other in MethodKind::ALL {
            let key = method_key(other);
            let response = ui.selectable_value(kind, other, texts.get(key));
            response.on_hover_text(texts.tip(key).unwrap_or_default());
        }
    });
    let tip = texts.tip("render-method").unwrap_or_default();
    shown.response.accessible_name(texts.get("render-method")).on_hover_text(tip);
    ui.end_row();
}

fn kind_row(ui: &mut Ui, texts: &Texts, kind: &mut PictureKind) {
    label(ui, texts, "render-kind");
    fields::kind_ui(ui, texts, kind);
    ui.end_row();
}
