//! Colors that change over a surface: a picture, a checkerboard.

use catoptric_scene::format::keys;
use catoptric_scene::{Checker, CheckerSpace, Material};
use egui::Ui;

use super::image::{self, ImageMenuChoice, OtherChoice};
use super::sheet::{ColorRow, NumberRow, PropertySheet, RowQuantity, SliderRail, Unit};
use super::symbol::Symbol;
use crate::images::ImageUse;
use crate::widgets::choice::{ChoiceItem, choice_ui};
use crate::widgets::row::control_width;
use crate::widgets::tip::tip_beside;

static CHECKER_COLOR: ColorRow<Material> = ColorRow {
    what: RowQuantity::new("checker-color", "edit-checker-color", &keys::CHECKER, "color"),
    get: |material| material.checker.map(|checker| checker.color),
    set: |material, color| {
        if let Some(checker) = &mut material.checker {
            checker.color = color;
        }
    },
};

static CHECKER_SIZE: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("checker-size", "edit-checker-size", &keys::CHECKER, "size")
        .in_unit(Unit::Meters)
        .with_symbol(Symbol::CheckerSize),
    SliderRail::None,
    |material| material.checker.map(|checker| checker.size),
    |material, value| {
        if let Some(checker) = &mut material.checker {
            checker.size = value;
        }
    },
);

/// The second color.
pub(super) fn checker_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    let mut is_on = sheet.primary.checker.is_some();
    let mut is_clicked = false;
    let texts = sheet.texts();
    sheet.plain_row(ui, "checker", |_, ui| {
        let response = ui.checkbox(&mut is_on, texts.get("checker-words"));
        is_clicked = tip_beside(ui, response, texts.tip("checker").unwrap_or_default()).clicked();
    });
    if is_clicked {
        sheet.change("checker", "edit-checker", |_, material| {
            material.checker = is_on.then(|| material.checker.unwrap_or(Checker::default()));
        });
    }
    sheet.color(ui, &CHECKER_COLOR);
    sheet.number(ui, &CHECKER_SIZE, None);
    let Some(checker) = sheet.primary.checker else { return };
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
            material.checker.iter_mut().for_each(|checker| checker.space = space);
        });
    }
}

/// A picture in the place of the color.
pub(super) fn texture_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    let texture = sheet.primary.texture.as_ref();
    let none = [OtherChoice { key: "texture-none", is_chosen: texture.is_none(), value: () }];
    let picked = image::choice_ui(ui, sheet, "texture", ImageUse::Texture, &none, texture);
    let Some(picked) = picked else { return };
    let chosen = match picked {
        ImageMenuChoice::Other(()) => None,
        ImageMenuChoice::Picture(image) => Some(image),
    };
    sheet.change("texture", "edit-texture", |_, material| material.texture.clone_from(&chosen));
}
