//! Numbers: as text, and as fields that are dragged or typed.

use std::cell::Cell;

use catoptric_scene::format::spec::Limits;
use egui::text::{CCursor, CCursorRange};
use egui::{Color32, DragValue, Id, Response, RichText, TextEdit, Ui, Vec2, vec2};

use crate::theme;

/// What stands for a number that several things do not share.
pub(crate) const MIXED: &str = "—";

/// Height of a field, points.
pub(crate) const HEIGHT: f32 = 22.0;
/// A field that is no wider, points, does not show its unit.
const NARROW: f32 = 72.0;

/// A field for one number.
pub(crate) struct NumberField<'a> {
    /// Its accessible name.
    pub(crate) name: &'a str,
    /// The number now.
    pub(crate) value: f64,
    /// Whether several things have different numbers; `value` is then the one that dragging starts from.
    pub(crate) is_mixed: bool,
    /// What it can be.
    pub(crate) limits: Limits,
    /// How much it changes for each point dragged.
    pub(crate) speed: f64,
    /// How many decimals are shown at most while it is not typed.
    pub(crate) decimals: usize,
    /// The unit, with a space before it where one belongs.
    pub(crate) unit: &'a str,
    /// The color of the field's edge, for components of vectors.
    pub(crate) edge: Option<Color32>,
    /// How wide it is.
    pub(crate) width: f32,
}

/// What was done to a field in this frame.
pub(crate) struct Entered {
    pub(crate) response: Response,
    /// The new number, if it was changed.
    pub(crate) value: Option<f64>,
    /// Why what was typed has been refused, once it is left.
    pub(crate) refusal: Option<Refusal>,
}

/// Why a typed text is not taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Refusal {
    /// It is no number.
    NoNumber,
    /// It lies outside of the limits.
    OutOfLimits(Limits),
}

/// What became of the text typed last.
#[derive(Clone, Copy, Debug, Default)]
enum Outcome {
    Taken(f64),
    #[default]
    Unchanged,
    Refused(Refusal),
}

impl NumberField<'_> {
    /// Draws the field.
    pub(crate) fn show(&self, ui: &mut Ui) -> Entered {
        let inner = ui.scope(|ui| self.show_scoped(ui));
        inner.inner
    }

    fn show_scoped(&self, ui: &mut Ui) -> Entered {
        let palette = theme::palette(ui.visuals());
        let widgets = &mut ui.visuals_mut().widgets;
        widgets.inactive.weak_bg_fill = palette.field;
        widgets.inactive.bg_stroke.color = palette.line;
        ui.spacing_mut().button_padding = vec2(4.0, 2.0);
        let id = ui.next_auto_id();
        let has_focus = ui.memory(|memory| memory.has_focus(id));
        let room = ((self.width - 12.0) / 7.0) as usize;
        let is_narrow = self.width <= NARROW;
        let unit = if has_focus || self.is_mixed || is_narrow { "" } else { self.unit };
        let unit_room = if is_narrow { 0 } else { self.unit.chars().count() };
        let text = match (self.is_mixed, has_focus) {
            (true, _) => MIXED.to_owned(),
            (false, true) => exact(self.value),
            (false, false) => fitting(self.value, self.decimals, room.saturating_sub(unit_room).max(4)),
        };
        let coarse = ui.input(|input| input.modifiers.command && !input.modifiers.shift);
        let outcome = Cell::new(None);
        let mut value = self.value;
        let response = ui.add(
            DragValue::new(&mut value)
                .speed(if coarse { 10.0 * self.speed } else { self.speed })
                .range(self.limits.min..=self.limits.max)
                .clamp_existing_to_range(false)
                .suffix(RichText::new(unit).color(palette.weak))
                .min_size(Vec2::new(self.width, HEIGHT))
                .clip_text(true)
                .custom_formatter(|value, _| if value == self.value { text.clone() } else { exact(value) })
                .custom_parser(|typed| {
                    let found = self.judge(typed, &text);
                    outcome.set(Some(found));
                    match found {
                        Outcome::Taken(number) => Some(number),
                        Outcome::Unchanged => Some(self.value),
                        Outcome::Refused(_) => None,
                    }
                }),
        );
        if response.clicked() {
            // What is edited is longer than what was shown.
            select_all(ui, id, &exact(self.value));
        }
        self.paint_edge(ui, &response);
        let response = response.accessible_name(self.name);
        // Assistive technology can ask for values of disabled fields.
        let is_changed = ui.is_enabled() && value.to_bits() != self.value.to_bits();
        let taken = ui.is_enabled() && matches!(outcome.get(), Some(Outcome::Taken(_)));
        Entered {
            value: (is_changed || (taken && self.is_mixed)).then_some(value),
            refusal: refusal_when_left(ui, id, &response, outcome.get()),
            response,
        }
    }

    fn judge(&self, typed: &str, shown: &str) -> Outcome {
        let typed = typed.trim();
        let is_same = !self.is_mixed && (typed == shown || typed == exact(self.value));
        if is_same || typed.is_empty() || typed == MIXED {
            return Outcome::Unchanged;
        }
        match parse(typed, self.unit) {
            None => Outcome::Refused(Refusal::NoNumber),
            Some(number) if self.limits.contains(number) => Outcome::Taken(number),
            Some(_) => Outcome::Refused(Refusal::OutOfLimits(self.limits)),
        }
    }

    fn paint_edge(&self, ui: &Ui, response: &Response) {
        let Some(color) = self.edge else { return };
        let mut bar = response.rect.shrink2(vec2(0.0, 3.0));
        bar.min.x += 1.5;
        bar.max.x = bar.min.x + 2.0;
        let color = if ui.is_enabled() { color } else { color.gamma_multiply(0.4) };
        ui.painter().rect_filled(bar, 1.0, color);
    }
}

fn select_all(ui: &Ui, id: Id, text: &str) {
    let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    let whole = CCursorRange::two(CCursor::default(), CCursor::new(text.chars().count()));
    state.cursor.set_char_range(Some(whole));
    state.store(ui.ctx(), id);
}

/// Remembers what became of the typed text, and tells when the field is left with a text that was not taken.
fn refusal_when_left(ui: &Ui, id: Id, response: &Response, outcome: Option<Outcome>) -> Option<Refusal> {
    let key = id.with("outcome");
    if let Some(outcome) = outcome {
        ui.data_mut(|data| data.insert_temp(key, outcome));
    }
    if response.has_focus() {
        return None;
    }
    let last = ui.data_mut(|data| data.remove_temp::<Outcome>(key));
    let is_given_up = ui.input(|input| input.key_pressed(egui::Key::Escape));
    match last {
        Some(Outcome::Refused(refusal)) if !is_given_up => Some(refusal),
        _ => None,
    }
}

/// Reads a number as people write it: with a comma or a point, any minus sign, spaces, and the unit.
fn parse(typed: &str, unit: &str) -> Option<f64> {
    let typed = typed.strip_suffix(unit.trim()).unwrap_or(typed);
    let plain: String = typed
        .chars()
        .filter(|letter| !letter.is_whitespace())
        .map(|letter| match letter {
            '−' => '-',
            ',' => '.',
            other => other,
        })
        .collect();
    // `inf` and `nan` are words to Rust, not numbers to people.
    let is_numeric = plain.chars().all(|letter| matches!(letter, '0'..='9' | '.' | '-' | '+' | 'e' | 'E'));
    plain.parse().ok().filter(|number: &f64| is_numeric && number.is_finite())
}

/// A number for people, with at most so many decimals and no zeros at the end. Very small and very large ones have an
/// exponent.
pub(crate) fn shown(value: f64, decimals: usize) -> String {
    let magnitude = value.abs();
    let least = 0.5 * 10f64.powi(-i32::try_from(decimals).unwrap_or(0));
    if magnitude == 0.0 {
        return "0".to_owned();
    }
    let text = if magnitude < least || magnitude >= 1e7 {
        let text = format!("{value:.2e}");
        match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{}e{exponent}", trimmed(mantissa)),
            None => text,
        }
    } else {
        trimmed(&format!("{value:.decimals$}")).to_owned()
    };
    text.replace('-', "−")
}

/// As many decimals as fit into so many letters.
fn fitting(value: f64, decimals: usize, letters: usize) -> String {
    let mut text = shown(value, decimals);
    for fewer in (0..decimals).rev() {
        if text.chars().count() <= letters || text.contains('e') {
            break;
        }
        text = shown(value, fewer);
    }
    text
}

/// A number in full, free of the noise of binary arithmetic.
pub(crate) fn exact(value: f64) -> String {
    let value = tidy(value);
    let magnitude = value.abs();
    let text = if magnitude != 0.0 && !(1e-6..1e9).contains(&magnitude) {
        format!("{value:e}")
    } else {
        format!("{value}")
    };
    text.replace('-', "−")
}

/// The nearest number with twelve digits: what was meant by `0.30000000000000004`.
pub(crate) fn tidy(value: f64) -> f64 {
    let near: f64 = format!("{value:.11e}").parse().unwrap_or(value);
    if near == 0.0 { 0.0 } else { near }
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_without_noise() {
        assert_eq!(shown(0.1 + 0.2, 3), "0.3");
        assert_eq!(shown(-1.75, 3), "−1.75");
        assert_eq!(shown(27.0, 2), "27");
        assert_eq!(shown(-0.0, 2), "0");
        assert_eq!(shown(1e-9, 3), "1e−9");
        assert_eq!(shown(2.5e9, 3), "2.5e9");
        assert_eq!(shown(100.0, 0), "100");
        assert_eq!(exact(0.1 + 0.2), "0.3");
        assert_eq!(exact(1.0 / 3.0), "0.333333333333");
        assert_eq!(fitting(-123.456, 3, 6), "−123.5");
        assert_eq!(tidy(0.1 + 0.2), 0.3);
    }

    #[test]
    fn people_write_numbers_in_many_ways() {
        assert_eq!(parse("0,5", ""), Some(0.5));
        assert_eq!(parse("−2.5 m", " m"), Some(-2.5));
        assert_eq!(parse("45°", "°"), Some(45.0));
        assert_eq!(parse("1 000", ""), Some(1000.0));
        assert_eq!(parse("1e9", ""), Some(1e9));
        for text in ["abc", "", "-", "nan", "inf", "1e999", "1..2"] {
            assert_eq!(parse(text, " m"), None, "{text}");
        }
    }
}
