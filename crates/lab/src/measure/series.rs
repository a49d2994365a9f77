//! Curves: the points along the first axis for each value of the second, with the law behind them.

use super::axis::Variable;
use super::law::{Fit, GrowthLaw, best_growth, fit};
use super::parameter::{Parameter, Value};
use super::run::{MeasuredPoint, Measurement};
use super::statistics::{Summary, summarize};

/// A curve.
#[derive(Clone, Debug)]
pub struct Series<'a> {
    /// The value of the second axis, if there is one.
    pub value: Option<&'a Value>,
    /// The points with the summary of their times, in the order of the first axis.
    pub points: Vec<(&'a MeasuredPoint, Summary)>,
    /// The law of the times, where the first axis is a number and the points determine one.
    pub law: Option<Fit>,
    /// The law of the numbers of rays, for generations: without any error of measurement.
    pub rays: Option<Fit>,
}

/// The curves of what was measured.
pub fn series(measured: &Measurement) -> Vec<Series<'_>> {
    let Some(first) = measured.axes.first() else { return Vec::new() };
    let chunks = measured.points.chunks(first.values.len().max(1));
    chunks.map(|points| Series::of(&first.variable, points)).collect()
}

impl<'a> Series<'a> {
    fn of(variable: &Variable, points: &'a [MeasuredPoint]) -> Self {
        let value = points.first().and_then(|point| point.values.get(1));
        let summary = |point: &'a MeasuredPoint| {
            let times: Vec<f64> = point.runs.iter().map(|run| run.draw).collect();
            Some((point, summarize(&times)?))
        };
        let points: Vec<_> = points.iter().filter_map(summary).collect();
        let pairs = |y: &dyn Fn(&MeasuredPoint, &Summary) -> f64| -> Vec<(f64, f64)> {
            let pairs =
                points.iter().filter_map(|(point, summary)| Some((point.number()?, y(point, summary))));
            pairs.collect()
        };
        let medians = pairs(&|_, summary| summary.median);
        let rays = pairs(&|point, _| point.rays.total() as f64);
        Self {
            value,
            law: law_of(variable, &medians),
            rays: (*variable == Parameter::Generations.into()).then(|| best_growth(&rays)).flatten(),
            points,
        }
    }
}

impl MeasuredPoint {
    /// The number along the first axis.
    pub fn number(&self) -> Option<f64> {
        self.values.first()?.number()
    }

    /// The median time of preparing the scene, milliseconds; NaN before the first measurement.
    pub fn preparing(&self) -> f64 {
        let times: Vec<f64> = self.runs.iter().map(|run| run.prepare).collect();
        summarize(&times).map_or(f64::NAN, |summary| summary.median)
    }
}

/// The law that is expected of a parameter; none of a value of the scene.
fn law_of(variable: &Variable, points: &[(f64, f64)]) -> Option<Fit> {
    // Two points lie on every line.
    if points.len() < 3 {
        return None;
    }
    let Variable::Parameter(parameter) = variable else { return None };
    match parameter {
        Parameter::Size | Parameter::Samples => fit(GrowthLaw::Linear, points),
        Parameter::Bodies => fit(GrowthLaw::Power, points),
        Parameter::Generations => best_growth(points),
        Parameter::Threads => fit(GrowthLaw::Amdahl, points),
        // The faces of a body, and the pixels of a map, are as the square.
        Parameter::Fineness | Parameter::CubeMapSize => fit(GrowthLaw::Square, points),
        Parameter::Method | Parameter::Search => None,
    }
}
