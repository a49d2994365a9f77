//! Colors that change over a surface: a picture, a checkerboard.

use catoptric_scene::format::keys;
use catoptric_scene::{Checker, CheckerSpace, Material};
use egui::Ui;

use super::image::{self, ImageMenuChoice, OtherChoice};
use super::sheet::{ColorRow, NumberRow, PropertySheet, RowQuantity, SliderRail, Unit};
use super::symbol::Symbol;
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::row::control_width;
use crate::base::widgets::tip::tip_beside;
use crate::state::images::ImageUse;

static CHECKER_COLOR: ColorRow<Material> = ColorRow {
    what: RowQuantity::new("checker-color", "edit-checker-color", &keys::CHECKER, "color"),
    get: |material| checker_of(material).map(|checker| checker.color),
    set: |material, color| edit_checker(material, |checker| checker.color = color),
};

static CHECKER_SIZE: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("checker-size", "edit-checker-size", &keys::CHECKER, "size")
        .in_unit(Unit::Meters)
        .with_symbol(Symbol::CheckerSize),
    SliderRail::None,
    |material| checker_of(material).map(|checker| checker.size),
    |material, value| edit_checker(material, |checker| checker.size = value),
);

fn checker_of(material: &Material) -> Option<Checker> {
    material.pattern().and_then(|pattern| pattern.checker)
}

fn edit_checker(material: &mut Material, edit: impl FnOnce(&mut Checker)) {
    material.pattern_mut().and_then(|pattern| pattern.checker.as_mut()).map(edit);
}

/// Draws the second color of a pattern, if the model has one.
pub(super) fn checker_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    let Some(pattern) = sheet.primary.pattern() else { return };
    let mut is_on = pattern.checker.is_some();
    let mut is_clicked = false;
    let texts = sheet.texts();
    sheet.plain_row(ui, "checker", |_, ui| {
        let response = ui.checkbox(&mut is_on, texts.get("checker-words"));
        is_clicked = tip_beside(ui, response, texts.tip("checker").unwrap_or_default()).clicked();
    });
    if is_clicked {
        sheet.change("checker", "edit-checker", |_, material| {
            if let Some(pattern) = material.pattern_mut() {
                pattern.checker = is_on.then(|| pattern.checker.unwrap_or_default());
            }
        });
    }
    sheet.color(ui, &CHECKER_COLOR);
    sheet.number(ui, &CHECKER_SIZE, None);
    let Some(checker) = pattern.checker else { return };
    let choices = CheckerSpace::ALL.map(|space| {
        let key = match space {
            CheckerSpace::World => "checker-world",
            CheckerSpace::Body => "checker-body",
        };
        let tip = texts.tip(key).unwrap_or_default();
        ChoiceItem { value: space, text: texts.get(key), tip, is_enabled: true }
    });
    let mut picked = None;
    sheet.plain_row(ui, "checker-space", |sheet, ui| {
        let (id, width) = (sheet.id.with("checker-space"), control_width(ui));
        picked = choice_ui(ui, id, texts.get("checker-space"), width, &choices, Some(checker.space));
    });
    if let Some(space) = picked {
        sheet.change("checker-space", "edit-checker-space", |_, material| {
            edit_checker(material, |checker| checker.space = space);
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
