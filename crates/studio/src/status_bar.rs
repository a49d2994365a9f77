//! The bar at the bottom: how the picture is doing.

use catoptric_live::{LiveError, Status};
use egui::{Align, Label, Layout, ProgressBar, Response, RichText, TextStyle, Ui, vec2};

use crate::context::Cx;
use crate::texts::Texts;
use crate::theme;

/// Draws the backend, the size, the time of the last picture, the rays per second and the progress of refinement; at
/// the right how much is in the scene.
pub(crate) fn status_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let status = cx.live.status();
    let texts = cx.texts;
    let width = ui.available_width();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        backend_ui(ui, texts, &status);
        line(ui);
        size_ui(ui, cx, &status);
        line(ui);
        let time = if status.milliseconds > 0.0 { number(status.milliseconds) } else { dash() };
        let text = texts.with("status-time", &[("time", time.into())]);
        let sample = texts.with("status-time", &[("time", "8888".into())]);
        cell(ui, &text, &sample, texts.tip("status-time-name"));
        line(ui);
        let rays = if status.rays_per_second > 0.0 { number(status.rays_per_second / 1e6) } else { dash() };
        let text = texts.with("status-rays", &[("rays", rays.into())]);
        let sample = texts.with("status-rays", &[("rays", "8888".into())]);
        cell(ui, &text, &sample, texts.tip("status-rays-name"));
        line(ui);
        match &status.error {
            Some(error) => error_ui(ui, texts, error),
            None => progress_ui(ui, texts, &status),
        }
        if width > 700.0 {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| counts_ui(ui, cx));
        }
    });
}

fn backend_ui(ui: &mut Ui, texts: &Texts, status: &Status) {
    let backend = if status.backend.is_empty() { dash() } else { status.backend.to_owned() };
    let threads = texts.with("status-threads", &[("count", status.threads.into())]);
    let response = ui.label(format!("{backend} · {threads}"));
    tip(response, texts.tip("status-threads-name"));
}

/// The size of the picture that was traced last, smaller than the view while it is coarse.
fn size_ui(ui: &mut Ui, cx: &Cx<'_>, status: &Status) {
    let [width, height] = status.picture_size;
    let text = if width == 0 { dash() } else { format!("{width} × {height}") };
    let is_coarse = cx.live.latest().is_some_and(|frame| !frame.is_full());
    let palette = theme::palette(ui.visuals());
    let color = if is_coarse { palette.weak } else { palette.text };
    let response = cell_in(ui, RichText::new(text).color(color), "8888 × 8888");
    tip(response, cx.texts.tip("status-size-name"));
}

fn progress_ui(ui: &mut Ui, texts: &Texts, status: &Status) {
    let wanted = status.samples_wanted;
    let is_done = wanted > 0 && status.samples_done >= wanted;
    let text = if is_done {
        texts.get("status-done").to_owned()
    } else if status.samples_done == 0 {
        texts.get("status-coarse").to_owned()
    } else {
        let arguments = [("done", status.samples_done.into()), ("wanted", wanted.into())];
        texts.with("status-refining", &arguments)
    };
    let sample = texts.with("status-refining", &[("done", 88.into()), ("wanted", 88.into())]);
    cell(ui, &text, &sample, texts.tip("status-refining-name"));
    let palette = theme::palette(ui.visuals());
    let fraction = if is_done { 1.0 } else { status.progress.clamp(0.0, 1.0) };
    let fill = if is_done { palette.button } else { palette.accent };
    let bar = ProgressBar::new(fraction).desired_width(90.0).desired_height(6.0).fill(fill);
    let response = ui.add(bar).accessible_name(texts.get("status-progress"));
    tip(response, texts.tip("status-refining-name"));
}

/// Why there is no picture, in red; the details on hovering.
fn error_ui(ui: &mut Ui, texts: &Texts, error: &LiveError) {
    let key = match error {
        LiveError::Stage(_) => "status-error-scene",
        LiveError::Size(_) | LiveError::TooLarge { .. } => "status-error-size",
        LiveError::Camera => "status-error-camera",
        LiveError::Fault(_) => "status-error-fault",
    };
    let color = theme::palette(ui.visuals()).error;
    let label = Label::new(RichText::new(texts.get(key)).color(color)).truncate();
    ui.add(label).on_hover_text(error.to_string());
}

/// From right to left: bodies and lights, and whether the view is free.
fn counts_ui(ui: &mut Ui, cx: &Cx<'_>) {
    let scene = cx.editor.scene();
    let bodies = cx.texts.with("status-bodies", &[("count", scene.bodies.len().into())]);
    let lights = cx.texts.with("status-lights", &[("count", scene.lights.len().into())]);
    tip(ui.label(format!("{bodies} · {lights}")), cx.texts.tip("status-count-name"));
    let badge = if cx.view.is_flying {
        Some("status-flying")
    } else {
        cx.view.free_camera.is_some().then_some("status-free")
    };
    if let Some(key) = badge {
        line(ui);
        let palette = theme::palette(ui.visuals());
        let text = RichText::new(cx.t(key)).color(palette.accent);
        tip(ui.label(text), cx.texts.tip(key));
    }
}

/// A text in a cell as wide as `sample`, so that nothing beside it moves when its digits change.
fn cell(ui: &mut Ui, text: &str, sample: &str, explanation: Option<&str>) {
    let response = cell_in(ui, RichText::new(text), sample);
    tip(response, explanation);
}

fn cell_in(ui: &mut Ui, text: RichText, sample: &str) -> Response {
    let font = TextStyle::Body.resolve(ui.style());
    let width = ui.painter().layout_no_wrap(sample.to_owned(), font, egui::Color32::WHITE).size().x;
    let size = vec2(width + 2.0, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_size(size);
        ui.add(Label::new(text).extend())
    })
    .inner
}

fn tip(response: Response, text: Option<&str>) {
    if let Some(text) = text {
        response.on_hover_text(text);
    }
}

fn line(ui: &mut Ui) {
    ui.add_space(6.0);
    let color = theme::palette(ui.visuals()).line;
    let (rect, _) = ui.allocate_exact_size(vec2(1.0, 14.0), egui::Sense::hover());
    ui.painter().rect_filled(rect, 0.0, color);
    ui.add_space(6.0);
}

fn dash() -> String {
    "–".to_owned()
}

/// Three digits that count.
fn number(value: f64) -> String {
    match value {
        value if value < 9.995 => format!("{value:.2}"),
        value if value < 99.95 => format!("{value:.1}"),
        value => format!("{value:.0}"),
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn numbers_have_three_digits() {
        let all = [0.123, 9.994, 9.996, 99.94, 99.96, 1234.5].map(super::number);
        assert_eq!(all, ["0.12", "9.99", "10.0", "99.9", "100", "1234"]);
    }
}
