//! The results of a measurement: the plot with its laws, the table, the machine.

use std::sync::Arc;

use catoptric_lab::measure::{Measurement, series};
use catoptric_lab::report::{Language, MeasurementFigure, figures, law_lines, machine_rows};
use egui::{Align, Grid, Label, Layout, RichText, ScrollArea, TextStyle, Ui, vec2};

use super::{MeasureState, plot};
use crate::base::theme;
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::state::context::Cx;
use crate::state::methods::report_language;

/// The selected tab of the results.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum ResultsTab {
    #[default]
    Plot,
    Table,
    Machine,
}

/// The state of the results panel.
#[derive(Default)]
pub(super) struct ResultsView {
    part: ResultsTab,
    /// The place of the figure that is shown: 0 for the times.
    figure: usize,
    of: Option<ResultsText>,
}

/// The plots, tables and laws of a measurement in one language.
struct ResultsText {
    of: Arc<Measurement>,
    language: Language,
    figures: Vec<MeasurementFigure>,
    laws: Vec<String>,
}

pub(super) fn results_ui(ui: &mut Ui, cx: &Cx<'_>, measuring: &mut MeasureState) {
    let Some(measured) = measuring.measured.clone() else {
        ui.add(Label::new(RichText::new(cx.t("measure-hint")).weak()).wrap());
        return;
    };
    let shown = &mut measuring.shown;
    parts_ui(ui, cx, &mut shown.part);
    let language = report_language(cx.texts);
    let is_current = shown
        .of
        .as_ref()
        .is_some_and(|drawn| Arc::ptr_eq(&drawn.of, &measured) && drawn.language == language);
    if !is_current {
        shown.of = Some(ResultsText::new(measured, language, cx));
    }
    let Some(drawn) = &shown.of else { return };
    if shown.part == ResultsTab::Machine {
        let heads = [cx.t("measure-machine").to_owned(), String::new()];
        return table_ui(ui, "machine", &heads, &machine_rows(&drawn.of.machine, language));
    }
    figures_ui(ui, cx, &drawn.figures, &mut shown.figure);
    let Some(figure) = drawn.figures.get(shown.figure) else {
        shown.figure = 0;
        return;
    };
    let laws = if shown.figure == 0 { drawn.laws.as_slice() } else { &[] };
    match shown.part {
        ResultsTab::Table => table_ui(ui, &figure.name, &figure.heads, &figure.rows),
        _ => plot_ui(ui, figure, laws),
    }
}

/// The choice of what the plot and the table show, where the pictures were asked something.
fn figures_ui(ui: &mut Ui, cx: &Cx<'_>, figures: &[MeasurementFigure], shown: &mut usize) {
    if figures.len() < 2 {
        return;
    }
    let choices = figures.iter().enumerate().map(|(value, figure)| ChoiceItem {
        value,
        text: figure.name.as_str(),
        tip: figure.plot.description.as_str(),
        is_enabled: true,
    });
    let choices: Vec<_> = choices.collect();
    let id = ui.scope_id().with("figure");
    let width = (110.0 * choices.len() as f32).min(ui.available_width());
    if let Some(other) = choice_ui(ui, id, cx.t("measure-figure"), width, &choices, Some(*shown)) {
        *shown = other;
    }
}

fn parts_ui(ui: &mut Ui, cx: &Cx<'_>, part: &mut ResultsTab) {
    let choices = [
        (ResultsTab::Plot, "measure-part-plot"),
        (ResultsTab::Table, "measure-part-table"),
        (ResultsTab::Machine, "measure-part-machine"),
    ]
    .map(|(value, key)| ChoiceItem {
        value,
        text: cx.texts.get(key),
        tip: cx.texts.tip(key).unwrap_or_default(),
        is_enabled: true,
    });
    let id = ui.scope_id().with("part");
    if let Some(other) = choice_ui(ui, id, cx.t("measure-part"), 260.0, &choices, Some(*part)) {
        *part = other;
    }
}

impl ResultsText {
    fn new(measured: Arc<Measurement>, language: Language, cx: &Cx<'_>) -> Self {
        let curves = series(&measured);
        // The font of the window has no raised minus, but a macron that looks like one.
        let laws = law_lines(&measured, language).into_iter().zip(&curves).map(|(line, curve)| {
            let error = curve.law.as_ref().map(|fit| language.fixed(100.0 * fit.error, 1));
            let line = line.replace('⁻', "¯");
            match error {
                Some(error) => {
                    format!("{line}, {}", cx.texts.with("measure-residual", &[("share", error.into())]))
                }
                None => line,
            }
        });
        let laws = laws.filter(|line| line.trim_end_matches(['–', ':', ' ']).chars().count() > 1).collect();
        Self { language, figures: figures(&measured, language), laws, of: measured }
    }
}

/// The plot, and the laws below it.
fn plot_ui(ui: &mut Ui, figure: &MeasurementFigure, laws: &[String]) {
    let line = ui.text_style_height(&TextStyle::Body) + 3.0;
    let below = line * laws.len().min(4) as f32 + 4.0;
    let room = vec2(ui.available_width(), (ui.available_height() - below).max(120.0));
    ui.allocate_ui(room, |ui| plot::plot_ui(ui, &figure.plot));
    for (index, law) in laws.iter().take(4).enumerate() {
        ui.horizontal(|ui| {
            plot::key_ui(ui, index);
            ui.add(Label::new(law).truncate()).on_hover_text(law);
        });
    }
}

fn table_ui(ui: &mut Ui, id: &str, heads: &[String], rows: &[Vec<String>]) {
    ScrollArea::both().id_salt(id).auto_shrink(false).show(ui, |ui| {
        Grid::new(id).striped(true).spacing([18.0, 4.0]).show(ui, |ui| {
            let weak = theme::palette(ui.visuals()).weak;
            for head in heads {
                ui.label(RichText::new(head).color(weak));
            }
            ui.end_row();
            for row in rows {
                for cell in row {
                    ui.with_layout(Layout::left_to_right(Align::Center), |ui| ui.label(cell));
                }
                ui.end_row();
            }
        });
    });
}
