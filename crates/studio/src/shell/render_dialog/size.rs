//! The size of the picture: usual ones, or typed.

use catoptric_picture::Picture;
use egui::{ComboBox, RichText, Ui};
use egui_material_icons::icons::{ICON_LINK, ICON_LINK_OFF};

use super::{IntegerField, label, whole_ui};
use crate::base::texts::Texts;
use crate::base::widgets::explained_icon_button;
use crate::base::widgets::number::Refusal;
use crate::base::{theme, words};
use crate::state::render_choices::RenderChoices;

/// Usual sizes, with the messages that name them.
const USUAL: [(&str, [u32; 2]); 5] = [
    ("render-size-hd", [1280, 720]),
    ("render-size-full-hd", [1920, 1080]),
    ("render-size-qhd", [2560, 1440]),
    ("render-size-4k", [3840, 2160]),
    ("render-size-square", [1080, 1080]),
];

/// The state of the size fields while the dialog is open.
pub(super) struct SizeFields {
    /// Width over height, while it is kept.
    proportions: f64,
    /// The size of the viewport, pixels.
    viewport: Option<[u32; 2]>,
}

impl SizeFields {
    pub(super) fn new(choices: &RenderChoices, viewport: Option<[u32; 2]>) -> Self {
        let viewport = viewport.filter(|size| !size.contains(&0));
        let mut size = Self { proportions: 1.0, viewport };
        size.take_proportions(choices);
        size
    }

    fn take_proportions(&mut self, choices: &RenderChoices) {
        self.proportions = f64::from(choices.width.max(1)) / f64::from(choices.height.max(1));
    }

    /// Draws the rows of the size.
    pub(super) fn rows_ui(
        &mut self,
        ui: &mut Ui,
        texts: &Texts,
        choices: &mut RenderChoices,
        refused: &mut Option<Refusal>,
    ) {
        let response = label(ui, texts, "render-size");
        self.list_ui(ui, texts, choices, response.id);
        ui.end_row();
        // The cell below the name; an empty label would be read out.
        ui.allocate_exact_size(egui::Vec2::ZERO, egui::Sense::hover());
        ui.horizontal(|ui| {
            let (width, height) = (texts.get("render-width"), texts.get("render-height"));
            if side_ui(ui, texts, width, &mut choices.width, refused) && choices.keeps_proportions {
                choices.height = side(f64::from(choices.width) / self.proportions);
            }
            ui.label("×");
            if side_ui(ui, texts, height, &mut choices.height, refused) && choices.keeps_proportions {
                choices.width = side(f64::from(choices.height) * self.proportions);
            }
            ui.label(RichText::new(texts.get("render-pixels")).color(theme::palette(ui.visuals()).weak));
            let icon = if choices.keeps_proportions { ICON_LINK } else { ICON_LINK_OFF };
            let name = texts.get("render-proportions");
            let tip = texts.tip("render-proportions").unwrap_or_default();
            if explained_icon_button(ui, icon, name, tip, choices.keeps_proportions).clicked() {
                choices.keeps_proportions = !choices.keeps_proportions;
                self.take_proportions(choices);
            }
        });
        ui.end_row();
    }

    fn list_ui(&mut self, ui: &mut Ui, texts: &Texts, choices: &mut RenderChoices, name: egui::Id) {
        let viewport = self.viewport.map(|size| ("render-size-viewport", size));
        let sizes: Vec<(&str, [u32; 2])> = USUAL.into_iter().chain(viewport).collect();
        let present = [choices.width, choices.height];
        let key = sizes.iter().find(|(_, size)| *size == present).map_or("render-size-own", |(key, _)| key);
        let named = |key: &'static str, [width, height]: [u32; 2]| {
            texts.with(
                "render-size-entry",
                &[("name", texts.get(key).into()), ("size", words::size(width, height).into())],
            )
        };
        let key: &'static str = key;
        let list =
            ComboBox::from_id_salt("usual sizes").selected_text(named(key, present)).width(super::WIDTH);
        let shown = list.show_ui(ui, |ui| {
            let mut picked = None;
            for (key, size) in sizes {
                if ui.selectable_label(size == present, named(key, size)).clicked() {
                    picked = Some(size);
                }
            }
            picked
        });
        shown.response.labelled_by(name);
        if let Some([width, height]) = shown.inner.flatten() {
            (choices.width, choices.height) = (width, height);
            self.take_proportions(choices);
        }
    }
}

/// A side that comes of the other one.
fn side(pixels: f64) -> u32 {
    (pixels.round() as u32).clamp(1, Picture::MAX_SIDE)
}

fn side_ui(ui: &mut Ui, texts: &Texts, name: &str, pixels: &mut u32, refused: &mut Option<Refusal>) -> bool {
    whole_ui(
        ui,
        texts,
        &IntegerField { name, tip: name, most: Picture::MAX_SIDE, speed: 2.0 },
        pixels,
        refused,
    )
}
