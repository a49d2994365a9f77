//! Colors: a swatch that opens the picker, and a field for the web's hexadecimal code.

use catoptric_scene::Color;
use egui::{
    Color32, Popup, PopupCloseBehavior, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2,
};

use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::number::{HEIGHT, MIXED, shown};
use crate::base::widgets::picker::picker_ui;
use crate::base::widgets::text::text_field;
use crate::base::widgets::tip::tip_beside;

const HEX: f32 = 76.0;

/// The changes of a color in a frame.
#[derive(Default)]
pub(crate) struct ColorResponse {
    /// The new color.
    pub(crate) color: Option<Color>,
    /// Whether it is being dragged.
    pub(crate) is_dragged: bool,
    /// Whether the typed code is none.
    pub(crate) is_refused: bool,
}

/// What a color looks like on the screen; brighter than white looks white.
pub(crate) fn screen_color(color: Color) -> Color32 {
    let [r, g, b] = color.to_srgb8();
    Color32::from_rgb(r, g, b)
}

/// The code of a color, `#rrggbb`.
pub(crate) fn hex(color: Color) -> String {
    let [r, g, b] = color.to_srgb8();
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Reads `#rrggbb`, `rrggbb`, `#rgb` or `rgb`.
pub(crate) fn parse_hex(text: &str) -> Option<Color> {
    let digits = text.trim().trim_start_matches('#');
    if !digits.chars().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let long: String = match digits.len() {
        6 => digits.to_owned(),
        3 => digits.chars().flat_map(|digit| [digit, digit]).collect(),
        _ => return None,
    };
    let code = u32::from_str_radix(&long, 16).ok()?;
    let [_, r, g, b] = code.to_be_bytes();
    Some(Color::from_srgb8([r, g, b]))
}

/// Draws swatch and code over `width`.
pub(crate) fn color_field(
    ui: &mut Ui,
    texts: &Texts,
    name: &str,
    color: Color,
    is_mixed: bool,
    width: f32,
) -> ColorResponse {
    let mut picked = ColorResponse::default();
    let gap = ui.spacing().item_spacing.x;
    let swatch = swatch_ui(ui, texts, name, color, (width - HEX - gap).max(16.0));
    Popup::menu(&swatch).close_behavior(PopupCloseBehavior::CloseOnClickOutside).width(236.0).show(|ui| {
        picked = picker_ui(ui, texts, name, color);
    });
    let code = if is_mixed { MIXED.to_owned() } else { hex(color) };
    let label = texts.with("color-code-of", &[("name", name.into())]);
    let (response, typed, _) = text_field(ui, &label, &code, "", HEX);
    tip_beside(ui, response, texts.get("color-code-tip"));
    if let Some(typed) = typed {
        match parse_hex(&typed) {
            Some(color) => picked.color = Some(color),
            None => picked.is_refused = true,
        }
    }
    picked
}

fn swatch_ui(ui: &mut Ui, texts: &Texts, name: &str, color: Color, width: f32) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::click());
    let palette = theme::palette(ui.visuals());
    let is_lit = response.hovered() || response.has_focus();
    let line = if is_lit { palette.accent } else { palette.line };
    let mut fill = screen_color(color);
    if !ui.is_enabled() {
        fill = fill.gamma_multiply(0.5);
    }
    ui.painter().rect(rect, 4.0, fill, Stroke::new(1.0, line), StrokeKind::Inside);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::ColorWell, enabled, name));
    let [r, g, b] = color.to_array().map(|component| shown(texts, component, 4));
    let linear = texts.with("color-linear-values", &[("r", r.into()), ("g", g.into()), ("b", b.into())]);
    tip_beside(ui, response, &linear)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_read_and_written() {
        assert_eq!(parse_hex("#FF8000").map(hex), Some("#ff8000".to_owned()));
        assert_eq!(parse_hex(" f80 ").map(hex), Some("#ff8800".to_owned()));
        for text in ["", "#", "#12345", "#gggggg", "red", "#яяя"] {
            assert_eq!(parse_hex(text), None, "{text}");
        }
        assert_eq!(hex(Color::new(3.0, 0.0, -1.0)), "#ff0000");
    }
}
