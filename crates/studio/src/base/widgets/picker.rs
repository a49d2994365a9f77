//! The picker of a color: saturation and brightness in a square, hue in a strip, linear components as numbers.

use catoptric_scene::Color;
use catoptric_scene::format::spec::Limits;
use egui::ecolor::{hsv_from_rgb, rgb_from_hsv};
use egui::{Color32, Mesh, Pos2, Rect, Role, Sense, Shape, Slider, SliderClamping, Stroke, Ui};
use egui::{WidgetInfo, lerp, pos2, vec2};

use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::color::ColorResponse;
use crate::base::widgets::number::{NumberField, Unit, tidy};

/// Hue, saturation and value of the encoded color, and the color they stood for: grays keep their hue while the picker
/// is open.
#[derive(Clone, Copy)]
struct PickerColor {
    hsv: [f32; 3],
    /// By how much the color is brighter than what a screen can show.
    strength: f64,
    color: Color,
}

/// Draws the picker. What is brighter than white keeps its brightness when the hue or the saturation changes.
pub(crate) fn picker_ui(ui: &mut Ui, texts: &Texts, name: &str, color: Color) -> ColorResponse {
    ui.set_width(236.0);
    let mut picked = ColorResponse::default();
    let id = ui.scope_id().with("hsv");
    let known = ui.data(|data| data.get_temp::<PickerColor>(id)).filter(|known| known.color == color);
    let PickerColor { mut hsv, strength, .. } = known.unwrap_or_else(|| {
        let strength = color.to_array().into_iter().fold(1.0, f64::max);
        let rgb = scaled(color, 1.0 / strength).to_srgb8().map(|code| f32::from(code) / 255.0);
        PickerColor { hsv: hsv_from_rgb(rgb).into(), strength, color }
    });
    let square = square_ui(ui, texts, name, &mut hsv);
    let strip = strip_ui(ui, texts, name, &mut hsv);
    if square || strip {
        picked.is_dragged = true;
        let [h, s, v] = hsv;
        let codes = rgb_from_hsv((h, s, v)).map(|part| (part * 255.0).round() as u8);
        let new = scaled(Color::from_srgb8(codes), strength);
        ui.data_mut(|data| data.insert_temp(id, PickerColor { hsv, strength, color: new }));
        picked.color = Some(new);
    }
    components_ui(ui, texts, name, color, &mut picked);
    picked
}

fn scaled(color: Color, factor: f64) -> Color {
    if factor == 1.0 { color } else { Color::from(color.to_array().map(|part| tidy(part * factor))) }
}

/// Saturation to the right, brightness up.
fn square_ui(ui: &mut Ui, texts: &Texts, name: &str, hsv: &mut [f32; 3]) -> bool {
    const CELLS: u32 = 16;
    let (rect, response) = ui.allocate_exact_size(vec2(236.0, 128.0), Sense::click_and_drag());
    let [hue, saturation, value] = hsv;
    let pointer = response.interact_pointer_pos();
    if let Some(pointer) = pointer {
        *saturation = fraction(pointer.x, rect.left(), rect.right());
        *value = 1.0 - fraction(pointer.y, rect.top(), rect.bottom());
    }
    let mut mesh = Mesh::default();
    for y in 0..=CELLS {
        for x in 0..=CELLS {
            let (s, v) = (x as f32 / CELLS as f32, 1.0 - y as f32 / CELLS as f32);
            mesh.colored_vertex(place_in(rect, s, v), opaque(*hue, s, v));
            if x < CELLS && y < CELLS {
                let corner = y * (CELLS + 1) + x;
                let below = corner + CELLS + 1;
                mesh.add_triangle(corner, corner + 1, below);
                mesh.add_triangle(corner + 1, below + 1, below);
            }
        }
    }
    ui.painter().add(Shape::mesh(mesh));
    knob(ui, place_in(rect, *saturation, *value), opaque(*hue, *saturation, *value));
    let label = texts.with("color-square-of", &[("name", name.into())]);
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, &label));
    pointer.is_some()
}

fn strip_ui(ui: &mut Ui, texts: &Texts, name: &str, hsv: &mut [f32; 3]) -> bool {
    const CELLS: u32 = 36;
    let (rect, response) = ui.allocate_exact_size(vec2(236.0, 16.0), Sense::click_and_drag());
    let [hue, _, _] = hsv;
    let pointer = response.interact_pointer_pos();
    if let Some(pointer) = pointer {
        // The two ends are the same red; the right one would jump to the left.
        *hue = fraction(pointer.x, rect.left(), rect.right()).min(0.9999);
    }
    let mut mesh = Mesh::default();
    for x in 0..=CELLS {
        let part = x as f32 / CELLS as f32;
        let color = opaque(part, 1.0, 1.0);
        mesh.colored_vertex(place_in(rect, part, 1.0), color);
        mesh.colored_vertex(place_in(rect, part, 0.0), color);
        if x < CELLS {
            mesh.add_triangle(2 * x, 2 * x + 1, 2 * x + 2);
            mesh.add_triangle(2 * x + 1, 2 * x + 3, 2 * x + 2);
        }
    }
    ui.painter().add(Shape::mesh(mesh));
    knob(ui, pos2(lerp(rect.x_range(), *hue), rect.center().y), opaque(*hue, 1.0, 1.0));
    let label = texts.with("color-hue-of", &[("name", name.into())]);
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, &label));
    response.on_hover_text(texts.get("color-hue"));
    pointer.is_some()
}

/// The three linear components; these can be above 1.
fn components_ui(ui: &mut Ui, texts: &Texts, name: &str, color: Color, picked: &mut ColorResponse) {
    let palette = theme::palette(ui.visuals());
    ui.colored_label(palette.weak, texts.get("color-linear"));
    let mut parts = color.to_array();
    let keys = ["color-red-of", "color-green-of", "color-blue-of"];
    let before = parts;
    for ((part, key), edge) in parts.iter_mut().zip(keys).zip(palette.axes) {
        let label = texts.with(key, &[("name", name.into())]);
        ui.horizontal(|ui| {
            ui.spacing_mut().slider_width = 146.0;
            let mut slid = *part;
            let slider = Slider::new(&mut slid, 0.0..=1.0)
                .show_value(false)
                .clamping(SliderClamping::Never)
                .max_decimals(4);
            let slider_label = texts.with("slider-of", &[("name", label.as_str().into())]);
            let response = ui.add(slider).accessible_name(slider_label);
            picked.is_dragged |= response.dragged();
            if response.changed() {
                *part = slid;
            }
            let field = NumberField {
                texts,
                name: &label,
                value: *part,
                is_mixed: false,
                limits: Limits::AMOUNT,
                speed: 0.005,
                decimals: 4,
                unit: Unit::None,
                edge: Some(edge),
                width: 78.0,
                explains: true,
            };
            let entered = field.show(ui);
            picked.is_dragged |= entered.response.dragged();
            if let Some(value) = entered.value {
                *part = value;
            }
        });
    }
    if parts != before {
        picked.color = Some(Color::from(parts));
    }
    let [r, g, b] = parts;
    if r.max(g).max(b) > 1.0 {
        let note = texts.get("color-above-white");
        ui.colored_label(palette.weak, note);
    }
}

fn fraction(value: f32, from: f32, to: f32) -> f32 {
    ((value - from) / (to - from)).clamp(0.0, 1.0)
}

fn place_in(rect: Rect, x: f32, y: f32) -> Pos2 {
    pos2(lerp(rect.x_range(), x), lerp(rect.y_range(), 1.0 - y))
}

fn opaque(hue: f32, saturation: f32, value: f32) -> Color32 {
    let [r, g, b] = rgb_from_hsv((hue, saturation, value)).map(|part| (part * 255.0).round() as u8);
    Color32::from_rgb(r, g, b)
}

fn knob(ui: &Ui, center: Pos2, color: Color32) {
    let painter = ui.painter();
    painter.circle(center, 6.0, color, Stroke::new(2.0, Color32::WHITE));
    painter.circle_stroke(center, 7.0, Stroke::new(1.0, Color32::from_black_alpha(120)));
}
