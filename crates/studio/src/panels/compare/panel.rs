//! The panel: what is compared above, the pictures at the left, the numbers at the right, what can be done below.

use std::sync::Arc;

use egui::{Align, Button, Layout, ProgressBar, RichText, ScrollArea, Ui, vec2};
use egui_material_icons::icons::ICON_SAVE;

use super::task::{CompareFailure, CompareResult};
use super::{CompareState, check, facts, header, picture};
use crate::base::theme;
use crate::base::widgets::footer::footer_ui;
use crate::state::command::{Command, CompareCommand};
use crate::state::context::Cx;

/// The width of the numbers beside the pictures, points.
const FACTS: f32 = 318.0;

/// Where the panel is narrower, the numbers stand below, points.
const NARROW: f32 = 620.0;

/// Draws the comparison: what can be done with it stays in sight below.
pub(crate) fn compare_ui(ui: &mut Ui, cx: &mut Cx<'_>, comparing: &mut CompareState) {
    footer_ui(ui, "acts of the comparison", |ui| acts_ui(ui, cx, comparing));
    if ui.available_width() < NARROW {
        // Everything scrolls: the choices alone may be higher than the panel.
        ScrollArea::vertical().id_salt("comparison").auto_shrink(false).show(ui, |ui| {
            let Some(found) = head_ui(ui, cx, comparing) else { return };
            let room = vec2(ui.available_width(), (0.62 * ui.available_width()).min(420.0));
            ui.allocate_ui(room, |ui| picture::picture_ui(ui, cx, comparing, &found));
            facts::facts_ui(ui, cx, &found);
            check::result_ui(ui, cx, &mut comparing.check, &found);
        });
        return;
    }
    let Some(found) = head_ui(ui, cx, comparing) else { return };
    let height = ui.available_height();
    ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
        ui.allocate_ui_with_layout(vec2(FACTS, height), Layout::top_down(Align::Min), |ui| {
            ScrollArea::vertical().id_salt("numbers").auto_shrink(false).show(ui, |ui| {
                facts::facts_ui(ui, cx, &found);
                check::result_ui(ui, cx, &mut comparing.check, &found);
            });
        });
        ui.allocate_ui_with_layout(ui.available_size(), Layout::top_down(Align::Min), |ui| {
            picture::picture_ui(ui, cx, comparing, &found);
        });
    });
}

/// Looks for what is wrong with a file, and saves the report.
fn acts_ui(ui: &mut Ui, cx: &mut Cx<'_>, comparing: &mut CompareState) {
    let CompareState { check, found, .. } = comparing;
    ui.horizontal_wrapped(|ui| {
        if let Some(found) = found {
            check::act_ui(ui, cx, check, found);
        }
        let label = format!("{} {}", ICON_SAVE.codepoint, cx.t("compare-save"));
        let save =
            ui.add_enabled(found.is_some(), Button::new(label)).accessible_name(cx.t("command-compare-save"));
        if save.on_hover_text(cx.texts.tip("command-compare-save").unwrap_or_default()).clicked() {
            cx.run(Command::Compare(CompareCommand::Save));
        }
    });
}

/// What is compared, and how far it is; returns what was found.
fn head_ui(ui: &mut Ui, cx: &mut Cx<'_>, comparing: &mut CompareState) -> Option<Arc<CompareResult>> {
    header::header_ui(ui, cx, comparing);
    progress_ui(ui, cx, comparing);
    let found = comparing.found.clone();
    match &found {
        Some(found) => comparing.images.keep_up(ui.ctx(), found, cx.view.development),
        None if comparing.running.is_none() && comparing.failed.is_none() => {
            ui.weak(cx.t("compare-waiting"));
        }
        None => {}
    }
    found
}

/// How far it is, or why there is no comparison.
fn progress_ui(ui: &mut Ui, cx: &mut Cx<'_>, comparing: &mut CompareState) {
    let palette = theme::palette(ui.visuals());
    if let Some((_, failure)) = comparing.failed.as_ref().filter(|_| comparing.running.is_none()) {
        ui.label(RichText::new(in_words(cx, failure)).color(palette.error));
    }
    let Some(running) = &comparing.running else { return };
    let [done, total] = running.steps();
    let mut is_cancelled = false;
    ui.horizontal(|ui| {
        let text = match total {
            0 => cx.t("compare-starting").to_owned(),
            _ => cx.texts.with("compare-drawing", &[("done", done.into()), ("total", total.into())]),
        };
        ui.label(RichText::new(&text).color(palette.weak));
        let bar =
            ProgressBar::new(done as f32 / total.max(1) as f32).desired_width(120.0).desired_height(6.0);
        ui.add(bar.fill(palette.accent)).accessible_name(cx.t("compare-progress"));
        is_cancelled = ui.small_button(cx.t("cancel")).accessible_name(cx.t("compare-cancel")).clicked();
    });
    if is_cancelled {
        let key = running.key.clone();
        comparing.cancel();
        comparing.failed = Some((key, CompareFailure::Cancelled));
    }
}

fn in_words(cx: &Cx<'_>, failure: &CompareFailure) -> String {
    let size = |[width, height]: &[u32; 2]| format!("{width} × {height}");
    let said = |key: &str, reason: &str| cx.texts.with(key, &[("reason", reason.into())]);
    match failure {
        CompareFailure::Cancelled => cx.t("compare-cancelled").to_owned(),
        CompareFailure::Read(path, reason) => cx.texts.with(
            "compare-unreadable",
            &[("name", super::task::name_of(path).into()), ("reason", reason.as_str().into())],
        ),
        CompareFailure::Sizes(a, b) => {
            cx.texts.with("compare-sizes", &[("a", size(a).into()), ("b", size(b).into())])
        }
        CompareFailure::Compare(reason) => said("compare-failed", reason),
        CompareFailure::Fault(reason) => said("compare-fault", reason),
    }
}
