//! Rows with one number.

use egui::{Slider, SliderClamping};

use super::*;

/// The range and scale of a slider.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SliderRail {
    /// None: only a field.
    None,
    /// From one number to another.
    Even(f64, f64),
    /// From one number to another, each tenfold as long as the next.
    Logarithmic(f64, f64),
}

/// A row with one number.
pub(crate) struct NumberRow<T> {
    pub(crate) what: RowQuantity,
    pub(crate) rail: SliderRail,
    /// How much a point of dragging changes it; in proportion to the number when it is a length.
    pub(crate) speed: f64,
    pub(crate) decimals: usize,
    /// The number; `None` where the thing has none.
    pub(crate) get: fn(&T) -> Option<f64>,
    pub(crate) set: fn(&mut T, f64),
}

/// The width of the field beside a slider.
const FIELD: f32 = 72.0;

impl<T> NumberRow<T> {
    /// A row with a field and a slider.
    pub(crate) const fn new(
        what: RowQuantity,
        rail: SliderRail,
        get: fn(&T) -> Option<f64>,
        set: fn(&mut T, f64),
    ) -> Self {
        Self { what, rail, speed: 0.005, decimals: 3, get, set }
    }

    /// Sets the speed of dragging and the number of decimals.
    pub(crate) const fn tuned(mut self, speed: f64, decimals: usize) -> Self {
        self.speed = speed;
        self.decimals = decimals;
        self
    }
}

impl<T> PropertySheet<'_, '_, T> {
    /// Draws a row with one number. `chosen` is the word on which its default depends.
    pub(crate) fn number(&mut self, ui: &mut Ui, number: &NumberRow<T>, chosen: Option<&str>) {
        let default = number.what.spec().and_then(|spec| spec.default_number(chosen));
        self.number_or(ui, number, default);
    }

    /// Draws a row with one number that has this default.
    pub(crate) fn number_or(&mut self, ui: &mut Ui, number: &NumberRow<T>, default: Option<f64>) {
        let Some(value) = (number.get)(self.primary) else { return };
        let tip = self.tip(&number.what, default.map(|value| exact(self.texts(), value)));
        let field_tip = tip.clone();
        let unit = if number.rail == SliderRail::None { Unit::None } else { number.what.unit };
        self.row(ui, &number.what, unit, tip, |sheet, ui| {
            sheet.number_contents(ui, number, value, default, &field_tip);
        });
    }

    fn number_contents(
        &mut self,
        ui: &mut Ui,
        number: &NumberRow<T>,
        value: f64,
        default: Option<f64>,
        tip: &str,
    ) {
        let what = &number.what;
        let texts = self.texts();
        let name = what.label(texts);
        let width = control_width(ui);
        let is_mixed = self.is_mixed(number.get);
        let mut new = None;
        let has_rail = number.rail != SliderRail::None;
        if has_rail {
            new = self.rail(ui, number, &name, value, width - FIELD - GAP, tip);
        }
        let field = NumberField {
            texts,
            name: &name,
            value,
            is_mixed,
            limits: what.limits(),
            speed: if what.unit == Unit::Meters { length_speed(value) } else { number.speed },
            decimals: number.decimals,
            unit: what.unit,
            edge: None,
            width: if has_rail { FIELD } else { width },
            explains: false,
        };
        let entered = field.show(ui);
        self.cx.view.is_moving |= entered.response.dragged();
        let typed = self.typed(what.key, &entered);
        self.number_menu(&entered.response, what, None);
        tip_beside(ui, entered.response, tip);
        let default_text = default.map(|value| exact(texts, value)).unwrap_or_default();
        let is_default = default.is_none_or(|default| !is_mixed && value == default);
        if self.reset(ui, is_default, &name, &default_text) {
            new = default;
        }
        if let Some(value) = typed.or(new) {
            self.change(what.key, what.edit, |_, thing| {
                if (number.get)(thing).is_some() {
                    (number.set)(thing, value);
                }
            });
        }
    }

    fn rail(
        &mut self,
        ui: &mut Ui,
        number: &NumberRow<T>,
        name: &str,
        value: f64,
        width: f32,
        tip: &str,
    ) -> Option<f64> {
        let (from, to, is_logarithmic) = match number.rail {
            SliderRail::None => return None,
            SliderRail::Even(from, to) => (from, to, false),
            SliderRail::Logarithmic(from, to) => (from, to, true),
        };
        let mut slid = value;
        let slider = Slider::new(&mut slid, from..=to)
            .show_value(false)
            .clamping(SliderClamping::Never)
            .logarithmic(is_logarithmic)
            .smallest_positive(1e-3)
            .trailing_fill(true)
            .max_decimals(number.decimals);
        let label = self.texts().with("slider-of", &[("name", name.into())]);
        let response = ui.scope(|ui| {
            ui.spacing_mut().slider_width = width.max(30.0);
            let palette = theme::palette(ui.visuals());
            let visuals = ui.visuals_mut();
            visuals.widgets.inactive.bg_fill = palette.button;
            visuals.widgets.inactive.fg_stroke.color = palette.weak;
            ui.add(slider).accessible_name(label)
        });
        let response = response.inner;
        self.cx.view.is_moving |= response.dragged();
        let is_changed = response.changed();
        tip_beside(ui, response, tip);
        is_changed.then_some(slid)
    }
}

/// Lengths change in proportion: a hundred points double or halve them, roughly.
fn length_speed(value: f64) -> f64 {
    (0.01 * value.abs()).clamp(1e-4, 1e3)
}
