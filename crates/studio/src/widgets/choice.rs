//! A choice of few things, side by side.

use egui::{Align2, FontId, Id, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};

use crate::theme;
use crate::widgets::number::HEIGHT;

/// One of the things that can be chosen.
pub(crate) struct Choice<'a, V> {
    /// What it stands for.
    pub(crate) value: V,
    /// What is written on it.
    pub(crate) text: &'a str,
    /// What it means.
    pub(crate) tip: &'a str,
    /// Whether it can be chosen now.
    pub(crate) is_enabled: bool,
}

/// Draws the choices over `width`; `chosen` is lit, if it is one of them. Returns another one when it is clicked.
pub(crate) fn choice_ui<V: Copy + PartialEq>(
    ui: &mut Ui,
    id: Id,
    name: &str,
    width: f32,
    choices: &[Choice<'_, V>],
    chosen: Option<V>,
) -> Option<V> {
    let (whole, _) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
    let palette = theme::palette(ui.visuals());
    ui.painter().rect(whole, 4.0, palette.field, Stroke::new(1.0, palette.line), StrokeKind::Inside);
    let font = FontId::proportional(12.5);
    let widths: Vec<f32> = choices.iter().map(|choice| text_width(ui, choice.text, &font)).collect();
    let padding = (width - widths.iter().sum::<f32>()) / choices.len().max(1) as f32;
    let mut left = whole.left();
    let mut picked = None;
    for (index, (choice, text_width)) in choices.iter().zip(&widths).enumerate() {
        let right = left + text_width + padding;
        let rect = Rect::from_min_max(pos2(left, whole.top()), pos2(right, whole.bottom()));
        left = right;
        let is_chosen = chosen == Some(choice.value);
        let is_enabled = ui.is_enabled() && (choice.is_enabled || is_chosen);
        let sense = if is_enabled { Sense::click() } else { Sense::hover() };
        let response = ui.interact(rect, id.with(index), sense);
        let inside = rect.shrink(1.5);
        if is_chosen {
            ui.painter().rect_filled(inside, 3.0, palette.selection);
        } else if response.hovered() && is_enabled {
            ui.painter().rect_filled(inside, 3.0, palette.hovered);
        }
        if response.has_focus() {
            let ring = Stroke::new(1.0, palette.accent);
            ui.painter().rect_stroke(inside, 3.0, ring, StrokeKind::Inside);
        }
        let color = if is_chosen || is_enabled { palette.text } else { palette.weak.gamma_multiply(0.7) };
        let color = if ui.is_enabled() { color } else { palette.weak };
        ui.painter().with_clip_rect(inside.intersect(ui.clip_rect())).text(
            rect.center(),
            Align2::CENTER_CENTER,
            choice.text,
            font.clone(),
            color,
        );
        let label = format!("{name}: {}", choice.text);
        response.widget_info(|| WidgetInfo::selected(Role::RadioButton, is_enabled, is_chosen, &label));
        let response = if choice.tip.is_empty() { response } else { response.on_hover_text(choice.tip) };
        if response.clicked() && !is_chosen {
            picked = Some(choice.value);
        }
    }
    picked
}

fn text_width(ui: &Ui, text: &str, font: &FontId) -> f32 {
    ui.painter().layout_no_wrap(text.to_owned(), font.clone(), egui::Color32::PLACEHOLDER).size().x
}
