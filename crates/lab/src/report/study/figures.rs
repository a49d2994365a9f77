//! What a window shows of a measurement.

use super::ReportWriter;
use crate::measure::{Measurement, PictureQuestion, series};
use crate::report::language::Language;
use crate::report::plot::Plot;
use crate::report::tables::Table;

/// A quantity of a measurement: its plot over the first axis, and its table.
#[derive(Clone, Debug)]
pub struct MeasurementFigure {
    /// What it shows, in a word or two.
    pub name: String,
    /// The plot.
    pub plot: Plot,
    /// The heads of the table.
    pub heads: Vec<String>,
    /// The rows of the table, a point each.
    pub rows: Vec<Vec<String>>,
}

/// The times with the laws as far as the points tell them, and what the pictures answer: for measurements under way,
/// too.
pub fn figures(measured: &Measurement, language: Language) -> Vec<MeasurementFigure> {
    let chapter = ReportWriter { measured, curves: series(measured), language };
    let figure = |name: String, plot: Plot, table: Table| MeasurementFigure {
        name,
        plot,
        heads: table.heads,
        rows: table.rows,
    };
    let times = figure(language.time_name().to_owned(), chapter.time_plot(), chapter.times_table());
    let answers = measured.questions.iter().enumerate().map(|(place, &question)| {
        let plot = match question {
            PictureQuestion::Rays => chapter.rays_plot(),
            _ => chapter.answers_plot(place, question),
        };
        figure(language.question_name(question), plot, chapter.answers_table(place, question))
    });
    [times].into_iter().chain(answers).collect()
}
