//! Sliders with a field beside them.

use std::ops::RangeInclusive;

use catoptric_scene::format::spec::Limits;
use egui::{Response, Slider, SliderClamping, Ui};

use crate::base::texts::Texts;
use crate::base::widgets::number::{NumberField, Unit};

/// A slider, and a field in which the number can be typed.
pub(crate) struct SliderField<'a> {
    pub(crate) texts: &'a Texts,
    /// The accessible name.
    pub(crate) name: &'a str,
    pub(crate) value: f64,
    /// From the left end of the slider to the right one; nothing beyond can be typed.
    pub(crate) range: RangeInclusive<f64>,
    pub(crate) is_logarithmic: bool,
    /// The number between two places of the slider; 0 for none.
    pub(crate) step: f64,
    pub(crate) decimals: usize,
    pub(crate) unit: Unit,
    /// How wide the field is, points.
    pub(crate) width: f32,
}

impl SliderField<'_> {
    /// Draws both; returns the slider, and the new number if it was changed.
    pub(crate) fn show(&self, ui: &mut Ui) -> (Response, Option<f64>) {
        let mut value = self.value;
        let mut slider = Slider::new(&mut value, self.range.clone())
            .show_value(false)
            .clamping(SliderClamping::Edits)
            .logarithmic(self.is_logarithmic)
            .max_decimals(self.decimals);
        if self.step > 0.0 {
            slider = slider.step_by(self.step);
        }
        let response = ui.add(slider).accessible_name(self.name);
        let slid = response.changed().then_some(value);
        let field = NumberField {
            texts: self.texts,
            name: self.name,
            value: self.value,
            is_mixed: false,
            limits: Limits::new(*self.range.start(), *self.range.end()),
            speed: if self.step > 0.0 { 0.2 * self.step } else { 0.01 },
            decimals: self.decimals,
            unit: self.unit,
            edge: None,
            width: self.width,
            explains: true,
        };
        (response, field.show(ui).value.or(slid))
    }
}
