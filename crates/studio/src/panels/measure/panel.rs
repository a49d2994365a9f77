//! The panel of the measurement: the form at the left, the results at the right, what can be done below.

use catoptric_lab::measure::Value;
use egui::{Align, Button, Layout, ProgressBar, RichText, ScrollArea, Ui, vec2};
use egui_material_icons::icons::{ICON_CONTENT_COPY, ICON_PLAY_ARROW, ICON_SAVE, ICON_STOP};

use super::form::{MeasureFormError, expected_key};
use super::number_axis::address_words;
use super::task::MeasureFailure;
use super::{MeasureState, results};
use crate::base::widgets::footer::footer_ui;
use crate::base::{theme, words};
use crate::state::command::{Command, MeasureCommand};
use crate::state::context::Cx;
use crate::state::methods::report_language;

/// The width of the form, points.
const FORM: f32 = 268.0;

/// Where the panel is narrower, the results stand below the form, points.
const NARROW: f32 = 600.0;

/// The width of the bar of progress, points.
const BAR: f32 = 110.0;

/// Draws the measurement: what it is for stays in sight below the form.
pub(crate) fn measure_ui(ui: &mut Ui, cx: &mut Cx<'_>, measuring: &mut MeasureState) {
    footer_ui(ui, "acts of the measurement", |ui| acts_ui(ui, cx, measuring));
    let is_free = !measuring.is_running();
    let form_ui = |ui: &mut Ui, cx: &mut Cx<'_>, measuring: &mut MeasureState| {
        ui.add_enabled_ui(is_free, |ui| measuring.form.ui(ui, cx));
    };
    if ui.available_width() < NARROW {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            form_ui(ui, cx, measuring);
            let room = vec2(ui.available_width(), 360.0);
            ui.allocate_ui(room, |ui| results::results_ui(ui, cx, measuring));
        });
        return;
    }
    let height = ui.available_height();
    ui.with_layout(Layout::left_to_right(Align::Min), |ui| {
        ui.allocate_ui_with_layout(vec2(FORM, height), Layout::top_down(Align::Min), |ui| {
            ScrollArea::vertical().id_salt("what to measure").auto_shrink(false).show(ui, |ui| {
                form_ui(ui, cx, measuring);
            });
        });
        ui.add_space(6.0);
        ui.allocate_ui_with_layout(ui.available_size(), Layout::top_down(Align::Min), |ui| {
            results::results_ui(ui, cx, measuring);
        });
    });
}

/// Begins or ends the measurement, and saves what was measured; beside it how far it is.
fn acts_ui(ui: &mut Ui, cx: &mut Cx<'_>, measuring: &MeasureState) {
    ui.horizontal_wrapped(|ui| {
        if measuring.is_running() {
            let label = format!("{} {}", ICON_STOP.codepoint, cx.t("measure-stop"));
            let stop = ui.button(label).accessible_name(cx.t("command-measure-stop"));
            if stop.on_hover_text(cx.texts.tip("command-measure-stop").unwrap_or_default()).clicked() {
                cx.run(Command::Measure(MeasureCommand::Stop));
            }
        } else {
            let palette = theme::palette(ui.visuals());
            let label = format!("{} {}", ICON_PLAY_ARROW.codepoint, cx.t("measure-start"));
            let start = ui
                .add(Button::new(label).fill(palette.selection))
                .accessible_name(cx.t("command-measure-start"));
            if start.on_hover_text(cx.texts.tip("command-measure-start").unwrap_or_default()).clicked() {
                cx.run(Command::Measure(MeasureCommand::Start));
            }
        }
        for (icon, label, command, act) in [
            (ICON_CONTENT_COPY, "measure-copy", "command-measure-copy", MeasureCommand::Copy),
            (ICON_SAVE, "measure-save", "command-measure-save", MeasureCommand::Save),
        ] {
            let label = format!("{} {}", icon.codepoint, cx.texts.get(label));
            let button = ui.add_enabled(measuring.is_measured(), Button::new(label));
            let button = button.accessible_name(cx.texts.get(command));
            let tip = cx.texts.tip(command).unwrap_or_default();
            if button.on_hover_text(tip).on_disabled_hover_text(tip).clicked() {
                cx.run(Command::Measure(act));
            }
        }
        progress_ui(ui, cx, measuring);
    });
}

/// How far it is, or why nothing was measured.
fn progress_ui(ui: &mut Ui, cx: &Cx<'_>, measuring: &MeasureState) {
    let palette = theme::palette(ui.visuals());
    let Some(running) = &measuring.running else {
        // What is wrong with a number of the scene stands beside its field.
        let is_beside =
            |failure: &&MeasureFailure| matches!(failure, MeasureFailure::Form(MeasureFormError::Number(_)));
        if let Some(failure) = measuring.failure.as_ref().filter(|failure| !is_beside(failure)) {
            ui.label(RichText::new(in_words(cx, failure)).color(palette.error));
        } else if measuring.measured.as_ref().is_some_and(|measured| !measured.complete) {
            ui.label(RichText::new(cx.t("measure-incomplete")).color(palette.warning));
        }
        return;
    };
    let told = running.told();
    let bar = ProgressBar::new(told.done as f32 / told.total.max(1) as f32).desired_height(6.0);
    ui.add(bar.desired_width(BAR).fill(palette.accent)).accessible_name(cx.t("measure-progress"));
    let arguments = [("done", told.done.into()), ("total", told.total.into())];
    let mut text = match told.total {
        0 => cx.t("measure-warming").to_owned(),
        _ => cx.texts.with("measure-done", &arguments),
    };
    if let Some(left) = told.left {
        text = format!("{text} · {}", cx.texts.with("measure-left", &[("time", words::clock(left).into())]));
    }
    ui.label(RichText::new(text).color(palette.weak)).on_hover_text(cx.t("measure-paused"));
}

fn in_words(cx: &Cx<'_>, failure: &MeasureFailure) -> String {
    let language = report_language(cx.texts);
    match failure {
        MeasureFailure::Form(MeasureFormError::Value(parameter, value)) => {
            let arguments =
                [("value", value.as_str().into()), ("parameter", language.parameter(*parameter).into())];
            format!("{} {}", cx.texts.with("measure-wrong-value", &arguments), cx.t(expected_key(*parameter)))
        }
        MeasureFailure::Form(MeasureFormError::Number(fault)) => fault.in_words(cx.texts),
        MeasureFailure::Setting(value, error) => {
            let value = language.value_name(&Value::Setting(value.clone()));
            let reason = address_words(cx.texts, error);
            let arguments =
                [("address", error.path().into()), ("value", value.into()), ("reason", reason.into())];
            cx.texts.with("measure-wrong-setting", &arguments)
        }
        MeasureFailure::Pixel([width, height]) => {
            let size = words::size(*width, *height);
            cx.texts.with("measure-no-pixel", &[("size", size.into())])
        }
        MeasureFailure::Sizes => cx.t("measure-flip-sizes").to_owned(),
        MeasureFailure::Form(MeasureFormError::Twice) => cx.t("measure-twice").to_owned(),
        MeasureFailure::Meaningless(parameter) => {
            cx.texts.with("measure-meaningless", &[("parameter", language.parameter(*parameter).into())])
        }
        MeasureFailure::Busy => cx.t("measure-busy").to_owned(),
        MeasureFailure::Cancelled => cx.t("measure-nothing-measured").to_owned(),
        MeasureFailure::Method(error) => {
            cx.texts.with("render-error-method", &[("reason", error.to_string().into())])
        }
        MeasureFailure::Fault(reason) => {
            cx.texts.with("measure-fault", &[("reason", reason.as_str().into())])
        }
    }
}
