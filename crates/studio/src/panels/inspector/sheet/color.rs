//! Rows with a color.

use super::*;
use crate::base::widgets::color::{color_field, hex};

/// A row with a color.
pub(crate) struct ColorRow<T> {
    pub(crate) what: RowQuantity,
    pub(crate) get: fn(&T) -> Option<Color>,
    pub(crate) set: fn(&mut T, Color),
}

impl<T> PropertySheet<'_, '_, T> {
    /// Draws a row with a color.
    pub(crate) fn color(&mut self, ui: &mut Ui, row: &ColorRow<T>) {
        let default = row.what.spec().and_then(KeySpec::default_vector).map(Color::from);
        let Some(value) = (row.get)(self.primary) else { return };
        let tip = self.tip(&row.what, default.map(hex));
        self.row(ui, &row.what, Unit::None, tip, |sheet, ui| {
            let texts = sheet.texts();
            let name = row.what.label(texts);
            let is_mixed = sheet.is_mixed(row.get);
            let width = control_width(ui);
            let picked = color_field(ui, texts, &name, value, is_mixed, width);
            sheet.cx.view.is_moving |= picked.is_dragged;
            if picked.is_refused {
                let text = texts.get("refused-no-color").to_owned();
                sheet.memory.note = Some(RefusalNote { id: sheet.id, key: row.what.key, text });
            }
            let is_default = default.is_none_or(|default| !is_mixed && value == default);
            let default_text = default.map(hex).unwrap_or_default();
            let back = sheet.reset(ui, is_default, &name, &default_text).then_some(default).flatten();
            if let Some(color) = picked.color.or(back) {
                sheet.change(row.what.key, row.what.edit, |_, thing| {
                    if (row.get)(thing).is_some() {
                        (row.set)(thing, color);
                    }
                });
            }
        });
    }
}
