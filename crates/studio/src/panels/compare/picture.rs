//! The pictures: on both sides of a line, one alone, or a map of their differences with its scale.

use catoptric_picture::inferno;
use egui::emath::GuiRounding as _;
use egui::{
    Align2, Color32, CursorIcon, EventFilter, FontId, Key, Mesh, Modifiers, Painter, Pos2, Rect, Response,
    Role, Sense, Shape, Stroke, StrokeKind, TextureHandle, Ui, WidgetInfo, lerp, pos2, vec2,
};

use super::task::CompareResult;
use super::{CompareMode, CompareState, facts};
use crate::base::{picture_frame, theme};
use crate::state::context::Cx;
use crate::state::methods::report_language;

/// The room below a map for its scale, points.
const SCALE: f32 = 34.0;

/// How far an arrow moves the line; with Shift five times as far.
const STEP: f32 = 0.02;

pub(super) fn picture_ui(ui: &mut Ui, cx: &mut Cx<'_>, comparing: &mut CompareState, found: &CompareResult) {
    let mode = match comparing.mode {
        CompareMode::Reasons if found.reasons.is_none() => CompareMode::Split,
        mode => mode,
    };
    let has_scale = matches!(mode, CompareMode::Difference | CompareMode::Flip);
    let room = ui.available_size() - vec2(0.0, facts::POINTER);
    let (whole, response) = ui.allocate_exact_size(room.max(egui::Vec2::ZERO), Sense::click_and_drag());
    let room = if has_scale { whole.with_max_y(whole.max.y - SCALE) } else { whole };
    if room.width() < 8.0 || room.height() < 8.0 {
        return;
    }
    let [width, height] = found.size().map(f64::from);
    let rect = picture_frame::frame(room, width / height);
    let rect = rect.translate(vec2(room.left() - rect.left(), room.top() - rect.top()));
    let rect = rect.round_to_pixels(ui.ctx().pixels_per_point());
    if mode == CompareMode::Split {
        move_line(ui, &response, rect, &mut comparing.divider);
    }
    comparing.pixel = pixel_under(ui, &response, rect, found.size());
    let painter = ui.painter_at(whole);
    let images = &comparing.images;
    let whole_picture = (0.0, 1.0);
    match (mode, images.pictures()) {
        (CompareMode::Difference, _) => paint(&painter, images.difference(), rect, whole_picture),
        (CompareMode::Flip, _) => paint(&painter, images.flip(), rect, whole_picture),
        (CompareMode::Reasons, _) => paint(&painter, images.reasons(), rect, whole_picture),
        (CompareMode::A, Some([a, _])) => paint(&painter, Some(a), rect, whole_picture),
        (CompareMode::B, Some([_, b])) => paint(&painter, Some(b), rect, whole_picture),
        (CompareMode::Split, Some([a, b])) => {
            paint(&painter, Some(a), rect, (0.0, comparing.divider));
            paint(&painter, Some(b), rect, (comparing.divider, 1.0));
            line_ui(&painter, rect, comparing.divider, &response);
        }
        (_, None) => {}
    }
    if has_scale {
        let end = if mode == CompareMode::Difference { found.scale } else { 1.0 };
        scale_ui(ui, cx, rect, end);
    }
    tell(ui, cx, (&response, rect), mode, comparing.divider);
    facts::pointer_ui(ui, cx, comparing.pixel, found);
}

/// The line follows the pointer, and the keys while the picture has the focus.
fn move_line(ui: &Ui, response: &Response, rect: Rect, divider: &mut f32) {
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    if let Some(pointer) =
        response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked())
    {
        *divider = (pointer.x - rect.left()) / rect.width();
    }
    if response.has_focus() {
        let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        ui.input_mut(|input| {
            let step = |count: usize| STEP * count as f32;
            // Without Shift, both are meant.
            *divider += 5.0 * step(input.count_and_consume_key(Modifiers::SHIFT, Key::ArrowRight));
            *divider -= 5.0 * step(input.count_and_consume_key(Modifiers::SHIFT, Key::ArrowLeft));
            *divider += step(input.count_and_consume_key(Modifiers::NONE, Key::ArrowRight));
            *divider -= step(input.count_and_consume_key(Modifiers::NONE, Key::ArrowLeft));
        });
    }
    *divider = if divider.is_finite() { divider.clamp(0.0, 1.0) } else { 0.5 };
    if response.hovered() {
        ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
}

/// The pixel of the picture that the pointer is over.
fn pixel_under(ui: &Ui, response: &Response, rect: Rect, size: [u32; 2]) -> Option<[u32; 2]> {
    let pointer = ui.input(|input| input.pointer.latest_pos()).filter(|_| response.contains_pointer())?;
    let within = (pointer - rect.min) / rect.size();
    let at = |part: f32, side: u32| {
        (0.0..1.0).contains(&part).then(|| ((part * side as f32) as u32).min(side.saturating_sub(1)))
    };
    Some([at(within.x, size[0])?, at(within.y, size[1])?])
}

/// Paints the part of a picture between two parts of its width where it belongs.
fn paint(painter: &Painter, texture: Option<&TextureHandle>, rect: Rect, (from, to): (f32, f32)) {
    let Some(texture) = texture else { return };
    let x = |part: f32| lerp(rect.x_range(), part);
    let place = Rect::from_min_max(pos2(x(from), rect.top()), pos2(x(to), rect.bottom()));
    painter.image(texture.id(), place, Rect::from_min_max(pos2(from, 0.0), pos2(to, 1.0)), Color32::WHITE);
}

/// The line, with the letters of the pictures on its sides.
fn line_ui(painter: &Painter, rect: Rect, divider: f32, response: &Response) {
    let x = lerp(rect.x_range(), divider);
    let dark = Stroke::new(3.0, Color32::from_black_alpha(140));
    let light = Stroke::new(1.0, Color32::WHITE);
    for stroke in [dark, light] {
        painter.vline(x, rect.y_range(), stroke);
    }
    let radius = if response.hovered() || response.has_focus() { 8.0 } else { 6.5 };
    painter.circle(
        pos2(x, rect.center().y),
        radius,
        Color32::WHITE,
        Stroke::new(1.0, Color32::from_black_alpha(160)),
    );
    for side in [-1.0, 1.0] {
        let tip = pos2(x + side * 5.0, rect.center().y);
        let arrow = [tip, tip + vec2(-side * 3.0, -3.0), tip + vec2(-side * 3.0, 3.0)];
        painter.add(Shape::convex_polygon(arrow.to_vec(), Color32::from_gray(70), Stroke::NONE));
    }
    let font = FontId::proportional(13.0);
    for (text, at, anchor) in [
        ("A", pos2(x - 9.0, rect.top() + 6.0), Align2::RIGHT_TOP),
        ("B", pos2(x + 9.0, rect.top() + 6.0), Align2::LEFT_TOP),
    ] {
        let shade = painter.layout_no_wrap(text.to_owned(), font.clone(), Color32::WHITE);
        let back = anchor.anchor_size(at, shade.size()).expand2(vec2(4.0, 1.0));
        if rect.contains_rect(back) {
            painter.rect_filled(back, 3.0, Color32::from_black_alpha(150));
            painter.galley(back.min + vec2(4.0, 1.0), shade, Color32::WHITE);
        }
    }
}

/// The scale of a map, from no difference to the largest that has a color of its own.
fn scale_ui(ui: &Ui, cx: &Cx<'_>, picture: Rect, end: f64) {
    const STEPS: u32 = 48;
    let palette = theme::palette(ui.visuals());
    let corner = pos2(picture.left(), picture.bottom() + 5.0);
    let bar = Rect::from_min_size(corner, vec2(picture.width(), 9.0));
    let mut mesh = Mesh::default();
    for step in 0..=STEPS {
        let part = f64::from(step) / f64::from(STEPS);
        let [red, green, blue] = inferno(part).map(|channel| (channel * 255.0).round() as u8);
        let color = Color32::from_rgb(red, green, blue);
        let x = lerp(bar.x_range(), part as f32);
        mesh.colored_vertex(pos2(x, bar.top()), color);
        mesh.colored_vertex(pos2(x, bar.bottom()), color);
        if step > 0 {
            let last = 2 * step;
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last - 1, last + 1, last);
        }
    }
    ui.painter().add(Shape::mesh(mesh));
    ui.painter().rect_stroke(bar, 0.0, Stroke::new(1.0, palette.line), StrokeKind::Outside);
    let language = report_language(cx.texts);
    for quarter in 0..=4_u32 {
        let part = f64::from(quarter) / 4.0;
        let number = language.fixed(end * part, if end < 0.1 { 4 } else { 3 });
        let number = number.trim_end_matches('0').trim_end_matches(['.', ',']);
        let number = match (number.is_empty(), quarter) {
            (true, _) => "0".to_owned(),
            // What is beyond has the same color.
            (false, 4) if end < 1.0 => format!("≥ {number}"),
            (false, _) => number.to_owned(),
        };
        let anchor = match quarter {
            0 => Align2::LEFT_TOP,
            4 => Align2::RIGHT_TOP,
            _ => Align2::CENTER_TOP,
        };
        let at: Pos2 = pos2(lerp(bar.x_range(), part as f32), bar.bottom() + 3.0);
        ui.painter().text(at, anchor, number, FontId::proportional(11.5), palette.weak);
    }
}

/// Tells what is seen to those who do not see it, and shows the focus.
fn tell(ui: &Ui, cx: &Cx<'_>, (response, rect): (&Response, Rect), mode: CompareMode, divider: f32) {
    let label = match mode {
        CompareMode::Split => cx.t("compare-divider"),
        CompareMode::A => cx.t("compare-picture-a"),
        CompareMode::B => cx.t("compare-picture-b"),
        CompareMode::Difference => cx.t("compare-picture-difference"),
        CompareMode::Flip => cx.t("compare-picture-flip"),
        CompareMode::Reasons => cx.t("compare-picture-reasons"),
    };
    response.widget_info(|| match mode {
        CompareMode::Split => WidgetInfo::slider(true, f64::from(100.0 * divider).round(), label),
        _ => WidgetInfo::labeled(Role::Image, true, label),
    });
    if response.has_focus() {
        let stroke = Stroke::new(1.5, theme::palette(ui.visuals()).accent);
        ui.painter().rect_stroke(rect, 0.0, stroke, StrokeKind::Inside);
    }
}
