//! Colors that change over a surface: a picture, a pattern.

use catoptric_scene::format::keys;
use catoptric_scene::{Material, PatternSpace, SolidKind, SolidTexture};
use egui::{ComboBox, Ui};

use super::header;
use super::image::{self, ImageMenuChoice, OtherChoice};
use super::sheet::{
    ColorRow, NumberRow, PropertySheet, RowQuantity, SliderRail, Unit, VectorRow, VectorSpread,
};
use super::symbol::Symbol;
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::row::control_width;
use crate::base::widgets::tip::tip_beside_entry;
use crate::state::images::ImageUse;

static PATTERN_COLOR: ColorRow<Material> = ColorRow {
    what: RowQuantity::new("pattern-color", "edit-pattern-color", &keys::PATTERN, "color"),
    get: |material| solid_of(material).map(|solid| solid.color),
    set: |material, color| edit_solid(material, |solid| solid.color = color),
};

static PATTERN_SIZE: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("pattern-size", "edit-pattern-size", &keys::PATTERN, "size")
        .in_unit(Unit::Meters)
        .with_symbol(Symbol::PatternSize),
    SliderRail::None,
    |material| solid_of(material).map(|solid| solid.size),
    |material, value| edit_solid(material, |solid| solid.size = value),
);

static PATTERN_POSITION: VectorRow<Material> = VectorRow::<Material>::new(
    RowQuantity::new("pattern-position", "edit-pattern-position", &keys::PATTERN, "position")
        .in_unit(Unit::Meters),
    VectorSpread::Same,
    |material| solid_of(material).map(|solid| solid.position),
    |material, value| edit_solid(material, |solid| solid.position = value),
);

static PATTERN_ROTATION: VectorRow<Material> = VectorRow::<Material>::new(
    RowQuantity::new("pattern-rotation", "edit-pattern-rotation", &keys::PATTERN, "rotation")
        .in_unit(Unit::Degrees),
    VectorSpread::Same,
    |material| solid_of(material).map(|solid| solid.rotation_degrees),
    |material, value| edit_solid(material, |solid| solid.rotation_degrees = value),
)
.tuned(0.5, 2);

static PATTERN_SCALE: VectorRow<Material> = VectorRow::<Material>::new(
    RowQuantity::new("pattern-scale", "edit-pattern-scale", &keys::PATTERN, "scale"),
    VectorSpread::Same,
    |material| solid_of(material).map(|solid| solid.scale),
    |material, value| edit_solid(material, |solid| solid.scale = value),
);

fn solid_of(material: &Material) -> Option<&SolidTexture> {
    material.pattern().and_then(|pattern| pattern.solid.as_ref())
}

fn edit_solid(material: &mut Material, edit: impl FnOnce(&mut SolidTexture)) {
    material.pattern_mut().and_then(|pattern| pattern.solid.as_mut()).map(edit);
}

const fn key_of(kind: Option<SolidKind>) -> &'static str {
    match kind {
        None => "pattern-none",
        Some(SolidKind::Checker) => "pattern-checker",
        Some(SolidKind::Stripes) => "pattern-stripes",
        Some(SolidKind::Rings) => "pattern-rings",
        Some(SolidKind::Gradient) => "pattern-gradient",
    }
}

/// Draws the pattern, if the model has one.
pub(super) fn solid_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    let Some(pattern) = sheet.primary.pattern() else { return };
    kind_ui(ui, sheet, pattern.solid.as_ref().map(|solid| solid.kind));
    let Some(solid) = &pattern.solid else { return };
    sheet.color(ui, &PATTERN_COLOR);
    sheet.number(ui, &PATTERN_SIZE, None);
    space_ui(ui, sheet, solid.space);
    sheet.vector(ui, &PATTERN_POSITION);
    sheet.vector(ui, &PATTERN_ROTATION);
    sheet.vector(ui, &PATTERN_SCALE);
    let within = solid.all().len() - 1;
    if within > 0 {
        header::hint(ui, &sheet.texts().with("pattern-within", &[("count", within.into())]));
    }
}

fn kind_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>, chosen: Option<SolidKind>) {
    let texts = sheet.texts();
    let kinds = [None].into_iter().chain(SolidKind::ALL.map(Some));
    let mut picked = None;
    sheet.plain_row(ui, "pattern", |_, ui| {
        let combo = ComboBox::from_id_salt("pattern")
            .selected_text(texts.get(key_of(chosen)))
            .width(control_width(ui))
            .truncate();
        let list = combo.show_ui(ui, |ui| {
            for kind in kinds {
                let label = ui.selectable_label(kind == chosen, texts.get(key_of(kind)));
                let label = tip_beside_entry(label, texts.tip(key_of(kind)).unwrap_or_default());
                if label.clicked() {
                    picked = Some(kind);
                }
            }
        });
        list.response.accessible_name(texts.get("pattern"));
    });
    if let Some(kind) = picked.filter(|kind| *kind != chosen) {
        sheet.change("pattern", "edit-pattern", |_, material| {
            if let Some(pattern) = material.pattern_mut() {
                let old = pattern.solid.take();
                pattern.solid = kind.map(|kind| SolidTexture { kind, ..old.unwrap_or_default() });
            }
        });
    }
}

fn space_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>, chosen: PatternSpace) {
    let texts = sheet.texts();
    let choices = PatternSpace::ALL.map(|space| {
        let key = match space {
            PatternSpace::World => "pattern-world",
            PatternSpace::Body => "pattern-body",
        };
        let tip = texts.tip(key).unwrap_or_default();
        ChoiceItem { value: space, text: texts.get(key), tip, is_enabled: true }
    });
    let mut picked = None;
    sheet.plain_row(ui, "pattern-space", |sheet, ui| {
        let (id, width) = (sheet.id.with("pattern-space"), control_width(ui));
        picked = choice_ui(ui, id, texts.get("pattern-space"), width, &choices, Some(chosen));
    });
    if let Some(space) = picked {
        sheet.change("pattern-space", "edit-pattern-space", |_, material| {
            edit_solid(material, |solid| solid.space = space);
        });
    }
}

/// Draws the picture in the place of the color of a pattern, if the model has one.
pub(super) fn texture_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    let Some(pattern) = sheet.primary.pattern() else { return };
    let texture = pattern.texture.as_ref();
    let none = [OtherChoice { key: "texture-none", is_chosen: texture.is_none(), value: () }];
    let picked = image::choice_ui(ui, sheet, "texture", ImageUse::Texture, &none, texture);
    let Some(picked) = picked else { return };
    let chosen = match picked {
        ImageMenuChoice::Other(()) => None,
        ImageMenuChoice::Picture(image) => Some(image),
    };
    sheet.change("texture", "edit-texture", |_, material| {
        if let Some(pattern) = material.pattern_mut() {
            pattern.texture.clone_from(&chosen);
        }
    });
}
