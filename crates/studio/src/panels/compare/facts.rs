//! The numbers: measures and times, the values under the pointer, the shares of the reasons.

use std::fmt::Write as _;

use catoptric_lab::compare::{AGREED, Contender, ContenderPicture, Metrics, reason_color};
use catoptric_lab::report::Language;
use catoptric_picture::Picture;
use catoptric_tracer::raster::ReasonMap;
use egui::{Align, Color32, Label, Layout, RichText, Sense, TextStyle, Ui, vec2};

use super::ComparedPicture;
use super::task::CompareResult;
use crate::base::theme;
use crate::state::context::Cx;
use crate::state::methods::{method_key, report_language};

pub(super) fn facts_ui(ui: &mut Ui, cx: &Cx<'_>, found: &CompareResult) {
    let Some(truth) = found.compared.truth() else { return };
    let Some((other, metrics)) = found.compared.others().next() else { return };
    let language = report_language(cx.texts);
    ui.spacing_mut().interact_size.y = ROW;
    ui.spacing_mut().item_spacing.y = 2.0;
    measures_ui(ui, cx, language, metrics);
    ui.add_space(4.0);
    times_ui(ui, cx, language, found, [truth, other]);
    ui.add_space(4.0);
    let reasons = other.drawn.as_ref().and_then(|drawn| drawn.reasons.as_ref());
    match reasons {
        Some(map) => reasons_ui(ui, cx, language, map, metrics),
        None if metrics.difference.above > 0 => {
            ui.add(Label::new(RichText::new(cx.t("compare-no-reasons")).weak()).wrap());
        }
        None => {}
    }
}

fn head(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).strong());
}

/// Between the columns of measures, points.
const GAP: f32 = 14.0;

/// Height of a row, points.
const ROW: f32 = 18.0;

/// Width of a number, points.
const NUMBER: f32 = 56.0;

/// A name at the left, explained when the pointer rests on it, and numbers at the right of `width`.
fn row(ui: &mut Ui, width: f32, name: &str, tip: &str, values: &[String]) {
    let room = (width - (NUMBER + 4.0) * values.len() as f32).max(20.0);
    let cell = |ui: &mut Ui, width: f32, layout: Layout, content: &mut dyn FnMut(&mut Ui)| {
        ui.allocate_ui_with_layout(vec2(width, ROW), layout, |ui| {
            ui.set_min_width(width);
            content(ui);
        });
    };
    ui.spacing_mut().item_spacing = vec2(4.0, 1.0);
    cell(ui, room, Layout::left_to_right(Align::Center), &mut |ui| {
        let response = ui.add(Label::new(name).truncate());
        if !tip.is_empty() {
            response.on_hover_text(tip);
        }
    });
    for value in values {
        cell(ui, NUMBER, Layout::right_to_left(Align::Center), &mut |ui| {
            ui.label(RichText::new(value).text_style(TextStyle::Monospace));
        });
    }
}

/// Draws a row in a line of its own.
fn line(ui: &mut Ui, name: &str, tip: &str, values: &[String]) {
    let width = ui.available_width() - 8.0;
    ui.horizontal(|ui| row(ui, width, name, tip, values));
}

/// The measures in two columns.
fn measures_ui(ui: &mut Ui, cx: &Cx<'_>, language: Language, metrics: &Metrics) {
    head(ui, cx.t("compare-measures"));
    let difference = &metrics.difference;
    let ssim = metrics.ssim.map_or_else(|| "–".to_owned(), |ssim| language.fixed(ssim, 4));
    let rows = [
        [("compare-max", language.fixed(difference.max, 4)), ("compare-ssim", ssim)],
        [
            ("compare-rmse", language.fixed(difference.rmse, 5)),
            ("compare-flip", language.fixed(metrics.flip, 4)),
        ],
        [
            ("compare-psnr", language.fixed(difference.psnr_db, 2)),
            ("compare-wrong", language.fixed(100.0 * difference.share_above, 2)),
        ],
    ];
    let width = 0.5 * (ui.available_width() - 8.0 - GAP);
    for pair in rows {
        ui.horizontal(|ui| {
            for (index, (key, value)) in pair.into_iter().enumerate() {
                if index > 0 {
                    ui.add_space(GAP);
                }
                row(ui, width, cx.t(key), cx.texts.tip(key).unwrap_or_default(), &[value]);
            }
        });
    }
}

fn times_ui(
    ui: &mut Ui,
    cx: &Cx<'_>,
    language: Language,
    found: &CompareResult,
    contenders: [&Contender; 2],
) {
    head(ui, cx.t("compare-times"));
    ui.scope(|ui| {
        for ((contender, source), letter) in contenders.into_iter().zip(&found.key.sources).zip(["A", "B"]) {
            let what = match source {
                ComparedPicture::Method(method) => cx.t(method_key(method.kind())).to_owned(),
                ComparedPicture::File(_) => contender.name.clone(),
            };
            let name = format!("{letter}  {}", what.chars().take(30).collect::<String>());
            let time = |drawn: &ContenderPicture| {
                cx.texts.with("status-time", &[("time", language.significant(drawn.time, 3).into())])
            };
            let value = contender.drawn.as_ref().map_or_else(|| "–".to_owned(), time);
            let passes = contender.drawn.as_ref().map(|drawn| passes_in_words(cx, language, drawn));
            line(ui, &name, &passes.unwrap_or_else(|| contender.name.clone()), &[value]);
        }
    });
}

fn passes_in_words(cx: &Cx<'_>, language: Language, drawn: &ContenderPicture) -> String {
    let mut text = cx.t("compare-passes").to_owned();
    for (pass, time) in &drawn.passes {
        let arguments =
            [("pass", language.pass_name(*pass).into()), ("time", language.significant(*time, 3).into())];
        let _ = write!(text, "\n{}", cx.texts.with("status-pass", &arguments));
    }
    text
}

/// The height of the facts about the pixel under the pointer, points.
pub(super) const POINTER: f32 = 2.0 * ROW + 10.0;

/// Red, green and blue of both pictures under the pointer, and why they differ: two lines below the pictures.
pub(super) fn pointer_ui(ui: &mut Ui, cx: &Cx<'_>, pixel: Option<[u32; 2]>, found: &CompareResult) {
    let Some(truth) = found.compared.truth() else { return };
    let Some((other, _)) = found.compared.others().next() else { return };
    let language = report_language(cx.texts);
    ui.spacing_mut().interact_size.y = ROW;
    ui.spacing_mut().item_spacing.y = 2.0;
    let Some([x, y]) = pixel else {
        ui.add(Label::new(RichText::new(cx.t("compare-no-pixel")).weak()).truncate());
        return;
    };
    let tip = cx.texts.tip("compare-pixel").unwrap_or_default();
    let light = |picture: &Picture| picture.pixel(x, y).unwrap_or_default();
    let [a, b] = [truth, other].map(|contender| light(&contender.picture));
    let numbers = |ui: &mut Ui, name: &str, light: [f32; 3], width: usize| {
        ui.label(RichText::new(name).strong()).on_hover_text(tip);
        let parts = light.map(|part| format!("{:>width$}", language.fixed(f64::from(part), 4)));
        ui.label(RichText::new(parts.join(" ")).text_style(TextStyle::Monospace)).on_hover_text(tip);
    };
    ui.horizontal(|ui| {
        ui.label(cx.texts.with("compare-pixel", &[("x", x.into()), ("y", y.into())]));
        numbers(ui, "A", a, 6);
        numbers(ui, "B", b, 6);
    });
    ui.horizontal(|ui| {
        numbers(ui, "B − A", [b[0] - a[0], b[1] - a[1], b[2] - a[2]], 7);
        let Some(map) = other.drawn.as_ref().and_then(|drawn| drawn.reasons.as_ref()) else { return };
        let place = y as usize * map.width() as usize + x as usize;
        let reason = map.reasons().get(place).copied().flatten();
        key_ui(ui, reason.map_or(AGREED, reason_color));
        ui.add(Label::new(reason.map_or(cx.t("compare-agree"), |reason| language.why(reason))).truncate());
    });
}

/// A patch of a color.
fn key_ui(ui: &mut Ui, [red, green, blue]: [u8; 3]) {
    let (rect, _) = ui.allocate_exact_size(vec2(11.0, 11.0), Sense::hover());
    let line = theme::palette(ui.visuals()).line;
    ui.painter().rect(
        rect,
        2.0,
        Color32::from_rgb(red, green, blue),
        egui::Stroke::new(1.0, line),
        egui::StrokeKind::Inside,
    );
}

/// The table of the reasons, which is the legend of their map too.
fn reasons_ui(ui: &mut Ui, cx: &Cx<'_>, language: Language, map: &ReasonMap, metrics: &Metrics) {
    head(ui, cx.t("compare-reasons"));
    let counts = map.counts();
    let explained: u64 = counts.iter().map(|(_, count)| count).sum();
    let wrong = metrics.difference.above.max(explained);
    if wrong == 0 {
        ui.label(cx.t("compare-equal"));
        return;
    }
    let mut counts: Vec<_> = counts
        .into_iter()
        .map(|(reason, count)| (reason_color(reason), language.why(reason), count))
        .collect();
    counts.sort_by_key(|(_, _, count)| std::cmp::Reverse(*count));
    if wrong > explained {
        counts.push((AGREED, cx.t("compare-unexplained"), wrong - explained));
    }
    for (color, name, count) in counts {
        let share = language.fixed(100.0 * count as f64 / wrong as f64, 1);
        let tip = cx.texts.with(
            "compare-reason-pixels",
            &[("count", language.count(count).into()), ("share", share.as_str().into())],
        );
        ui.horizontal(|ui| {
            key_ui(ui, color);
            let room = (ui.available_width() - 62.0).max(40.0);
            ui.allocate_ui_with_layout(vec2(room, 18.0), Layout::left_to_right(Align::Center), |ui| {
                ui.set_min_width(room);
                ui.add(Label::new(name).truncate()).on_hover_text(format!("{name}\n{tip}"));
            });
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.label(RichText::new(format!("{share} %")).text_style(TextStyle::Monospace));
            });
        });
    }
}
