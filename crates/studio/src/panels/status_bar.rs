//! The bar at the bottom: how the picture is doing.

use catoptric_live::{LiveError, Status};
use egui::{Align, Label, Layout, ProgressBar, Response, RichText, Sides, TextStyle, Ui, vec2};

use egui_material_icons::icons;

use crate::base::texts::Texts;
use crate::base::widgets::icon_ui;
use crate::base::{theme, words};
use crate::panels::viewport;
use crate::state::card::why;
use crate::state::context::Cx;
use crate::state::methods::{method_key, report_language, short_key};

/// Width of the bar of refinement, points.
const BAR: f32 = 90.0;

/// Draws the backend, the size, the time of the last picture, the rays per second and the progress of refinement; at
/// the right how much is in the scene.
pub(crate) fn status_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let status = cx.live.status();
    ui.spacing_mut().item_spacing.x = 4.0;
    Sides::new().shrink_left().show(ui, |ui| picture_ui(ui, cx, &status), |ui| counts_ui(ui, cx));
}

/// From left to right, as far as there is room.
fn picture_ui(ui: &mut Ui, cx: &Cx<'_>, status: &Status) {
    let texts = cx.texts;
    if let Some(error) = &status.error {
        error_ui(ui, texts, error);
        return;
    }
    backend_ui(ui, texts, status);
    line(ui);
    method_ui(ui, texts, status);
    size_ui(ui, cx, status);
    let time = if status.milliseconds > 0.0 { number(texts, status.milliseconds) } else { dash() };
    let text = texts.with("status-time", &[("time", time.into())]);
    let sample = texts.with("status-time", &[("time", "8888".into())]);
    let passes = passes_in_words(texts, status);
    if ui.available_width() > width_of(ui, &sample) + 30.0 {
        line(ui);
        cell(ui, &text, &sample, passes.as_deref().or(texts.tip("status-time-name")));
    }
    let rays =
        if status.rays_per_second > 0.0 { number(texts, status.rays_per_second / 1e6) } else { dash() };
    let rays = [rays, "8888".to_owned()].map(|rays| texts.with("status-rays", &[("rays", rays.into())]));
    // What took the time matters more than how many rays there were.
    let [text, sample] = passes_in_short(texts, status).unwrap_or(rays);
    let refining = texts.with("status-refining", &[("done", 88.into()), ("wanted", 88.into())]);
    // How far the picture is matters more than how quick it was made.
    if ui.available_width() > width_of(ui, &sample) + width_of(ui, &refining) + 60.0 {
        line(ui);
        cell(ui, &text, &sample, passes.as_deref().or(texts.tip("status-rays-name")));
    }
    if ui.available_width() > width_of(ui, &refining) + 30.0 {
        line(ui);
        progress_ui(ui, texts, status, &refining);
    }
}

fn backend_ui(ui: &mut Ui, texts: &Texts, status: &Status) {
    let backend = if status.backend.is_empty() { dash() } else { status.backend.to_owned() };
    let card = status.card.as_deref().filter(|_| status.backend == "GPU");
    let who = card.map_or_else(
        || texts.with("status-threads", &[("count", status.threads.into())]),
        |name| shortened(name).to_owned(),
    );
    let response = ui.label(format!("{backend} · {who}"));
    let refused = status
        .card_refuses
        .as_ref()
        .map(|error| texts.with("status-card-refuses", &[("reason", why(texts, error).into())]));
    tip(response, refused.as_deref().or(card).or(texts.tip("status-threads-name")));
}

/// The name of a card without what its driver says of itself in brackets.
fn shortened(name: &str) -> &str {
    name.split(" (").next().unwrap_or(name)
}

/// How the picture is drawn, unless it is traced.
fn method_ui(ui: &mut Ui, texts: &Texts, status: &Status) {
    let Some(kind) = status.method.filter(|kind| !kind.abilities().is_reference) else { return };
    let text = RichText::new(texts.get(short_key(kind))).color(theme::palette(ui.visuals()).accent);
    let response = ui.label(text);
    let passes = passes_in_words(texts, status);
    tip(response, passes.as_deref().or(texts.tip(method_key(kind))));
    line(ui);
}

/// The passes of the last picture with their milliseconds in a line, and that line with the widest numbers.
fn passes_in_short(texts: &Texts, status: &Status) -> Option<[String; 2]> {
    let language = report_language(texts);
    let line = |number: &dyn Fn(f64) -> String| {
        let passes = status.passes.iter();
        let passes = passes.map(|(pass, time)| format!("{} {}", language.pass_name(*pass), number(*time)));
        passes.collect::<Vec<_>>().join(" · ")
    };
    (!status.passes.is_empty()).then(|| [line(&|time| number(texts, time)), line(&|_| "8888".to_owned())])
}

/// The passes of the last picture with their times, a line each, and the cube maps that served it.
fn passes_in_words(texts: &Texts, status: &Status) -> Option<String> {
    let language = report_language(texts);
    let kind = status.method.filter(|_| !status.passes.is_empty())?;
    let mut lines = vec![texts.get(method_key(kind)).to_owned()];
    for (pass, milliseconds) in &status.passes {
        let arguments =
            [("pass", language.pass_name(*pass).into()), ("time", number(texts, *milliseconds).into())];
        lines.push(texts.with("status-pass", &arguments));
    }
    if let Some(used) = &status.cube_maps {
        let milliseconds = 1e3 * used.build_time.as_secs_f64();
        let arguments = [
            ("built", used.built.into()),
            ("kept", used.kept.into()),
            ("time", number(texts, milliseconds).into()),
            ("bytes", words::bytes(texts, used.bytes).into()),
        ];
        lines.push(texts.with("status-maps", &arguments));
    }
    Some(lines.join("\n"))
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

fn progress_ui(ui: &mut Ui, texts: &Texts, status: &Status, sample: &str) {
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
    let palette = theme::palette(ui.visuals());
    if is_done {
        icon_ui(ui, icons::ICON_CHECK, 14.0, palette.weak);
        cell(ui, &text, sample, texts.tip("status-refining-name"));
        return;
    }
    cell(ui, &text, sample, texts.tip("status-refining-name"));
    if ui.available_width() < BAR {
        return;
    }
    let fraction = status.progress.clamp(0.0, 1.0);
    let bar = ProgressBar::new(fraction).desired_width(BAR).desired_height(6.0).fill(palette.accent);
    let response = ui.add(bar).accessible_name(texts.get("status-progress"));
    tip(response, texts.tip("status-refining-name"));
}

/// Why there is no picture, in red; the details on hovering.
fn error_ui(ui: &mut Ui, texts: &Texts, error: &LiveError) {
    let key = match error {
        LiveError::Stage(_) => "status-error-scene",
        LiveError::Size(_) | LiveError::TooLarge { .. } => "status-error-size",
        LiveError::Setting(_) | LiveError::TooManyCubeMaps { .. } => "status-error-method",
        LiveError::Camera => "status-error-camera",
        LiveError::Fault(_) => "status-error-fault",
    };
    let color = theme::palette(ui.visuals()).error;
    let label = Label::new(RichText::new(texts.get(key)).color(color)).truncate();
    ui.add(label).on_hover_text(viewport::why(texts, error));
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
    let size = vec2(width_of(ui, sample) + 2.0, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_size(size);
        ui.add(Label::new(text).extend())
    })
    .inner
}

fn width_of(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Body.resolve(ui.style());
    ui.painter().layout_no_wrap(text.to_owned(), font, egui::Color32::WHITE).size().x
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
fn number(texts: &Texts, value: f64) -> String {
    texts.localized(match value {
        value if value < 9.995 => format!("{value:.2}"),
        value if value < 99.95 => format!("{value:.1}"),
        value => format!("{value:.0}"),
    })
}

#[cfg(test)]
mod tests {
    use crate::base::texts::{Language, Texts};

    #[test]
    fn numbers_have_three_digits() {
        let all = |language| {
            let texts = Texts::new(language);
            [0.123, 9.994, 9.996, 99.94, 99.96, 1234.5].map(|value| super::number(&texts, value))
        };
        assert_eq!(all(Language::English), ["0.12", "9.99", "10.0", "99.9", "100", "1234"]);
        assert_eq!(all(Language::Russian), ["0,12", "9,99", "10,0", "99,9", "100", "1234"]);
    }
}
