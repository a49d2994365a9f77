//! Tables of a measurement for programs: decimal points and English heads in every language.

use super::tables::csv_line;
use crate::measure::{MeasuredPoint, Measurement, PictureQuestion, series};

/// The heads of the columns that say where a point is.
fn place_heads(measured: &Measurement) -> Vec<String> {
    let axes = measured.axes.iter().map(|axis| axis.variable.to_string());
    axes.chain(
        ["method", "bodies", "width", "height", "samples", "generations", "threads"]
            .map(|head| format!("drawn_{head}")),
    )
    .collect()
}

/// Where a point is.
fn place(point: &MeasuredPoint) -> Vec<String> {
    let values = point.values.iter().map(ToString::to_string);
    let settings = point.settings;
    values
        .chain([
            point.method.clone(),
            point.bodies.to_string(),
            settings.width.to_string(),
            settings.height.to_string(),
            settings.samples.to_string(),
            point.generations.to_string(),
            point.threads.to_string(),
        ])
        .collect()
}

/// Every measurement, a line each.
pub(super) fn runs_csv(measured: &Measurement) -> String {
    let heads = ["round", "repeats", "prepare_ms", "draw_ms", "passes_ms"].map(str::to_owned);
    let mut text = csv_line(&[place_heads(measured), heads.to_vec()].concat());
    for point in &measured.points {
        for run in &point.runs {
            let passes: Vec<String> =
                run.passes.iter().map(|(pass, time)| format!("{}={time:.4}", pass.name())).collect();
            let fields = [
                run.round.to_string(),
                point.repeats.to_string(),
                format!("{:.4}", run.prepare),
                format!("{:.4}", run.draw),
                passes.join(" "),
            ];
            text.push_str(&csv_line(&[place(point), fields.to_vec()].concat()));
        }
    }
    text
}

/// The points with the summary of their measurements and what their pictures answer, a line each: `points.csv` of a
/// report.
pub fn points_csv(measured: &Measurement) -> String {
    let heads = [
        "runs",
        "median_ms",
        "low_ms",
        "high_ms",
        "coverage",
        "least_ms",
        "greatest_ms",
        "outliers",
        "prepare_ms",
        "law_ms",
        "rays_primary",
        "rays_shadow",
        "rays_reflected",
        "rays_refracted",
    ];
    let answers = measured.questions.iter().filter(|question| **question != PictureQuestion::Rays);
    let answers = answers.flat_map(PictureQuestion::columns).collect();
    let mut text = csv_line(&[place_heads(measured), heads.map(str::to_owned).to_vec(), answers].concat());
    for curve in series(measured) {
        for (point, summary) in &curve.points {
            let law = curve.law.as_ref().zip(point.number()).map(|(law, x)| format!("{:.4}", law.at(x)));
            let ms = |value: f64| format!("{value:.4}");
            let fields = vec![
                summary.count.to_string(),
                ms(summary.median),
                ms(summary.low),
                ms(summary.high),
                ms(summary.coverage),
                ms(summary.least),
                ms(summary.greatest),
                summary.outliers.len().to_string(),
                ms(point.preparing()),
                law.unwrap_or_default(),
                point.rays.primary.to_string(),
                point.rays.shadow.to_string(),
                point.rays.reflected.to_string(),
                point.rays.refracted.to_string(),
            ];
            let answers = measured.questions.iter().zip(&point.answers);
            let answers = answers.filter(|(question, _)| **question != PictureQuestion::Rays);
            let answers = answers.flat_map(|(_, numbers)| numbers).map(f64::to_string).collect();
            text.push_str(&csv_line(&[place(point), fields, answers].concat()));
        }
    }
    text
}
