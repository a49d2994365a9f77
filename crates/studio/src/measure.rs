//! The measurement: how the time of a picture grows, measured while everything else rests.

mod export;
mod form;
mod panel;
mod plot;
mod results;
mod task;

use std::sync::Arc;

use catoptric_lab::measure::Measurement;
use egui::Context;

use crate::app::Studio;
use crate::command::MeasureCommand;
use crate::layout::{self, Pane};

pub(crate) use panel::measure_ui;

use form::MeasureForm;
use task::{MeasureFailure, MeasureTask};

/// The measurement of the window.
#[derive(Default)]
pub(crate) struct MeasureState {
    form: MeasureForm,
    running: Option<MeasureTask>,
    /// What was measured, or is so far.
    measured: Option<Arc<Measurement>>,
    failure: Option<MeasureFailure>,
    shown: results::ResultsView,
}

impl MeasureState {
    /// Whether times are being measured.
    pub(crate) fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// Whether something was measured that can be saved.
    pub(crate) fn is_measured(&self) -> bool {
        self.measured.is_some() && self.running.is_none()
    }
}

/// Does `act`.
pub(crate) fn run(context: &Context, studio: &mut Studio, act: MeasureCommand) {
    match act {
        MeasureCommand::Start => start(context, studio),
        MeasureCommand::Stop => {
            if let Some(running) = &studio.panes.measure.running {
                running.cancel();
            }
        }
        MeasureCommand::Save => export::ask(studio),
    }
}

fn start(context: &Context, studio: &mut Studio) {
    if studio.panes.measure.is_running() {
        return;
    }
    if !layout::is_in_front(&studio.layout, Pane::Measure) {
        layout::set_visible(&mut studio.layout, Pane::Measure, true);
    }
    if studio.is_rendering() {
        studio.panes.measure.failure = Some(MeasureFailure::Busy);
        return;
    }
    let scene = studio.editor.scene();
    let name = studio.editor.title().trim_end_matches(".toml").to_owned();
    let measuring = &mut studio.panes.measure;
    let started = measuring.form.plan(scene, name).map_err(MeasureFailure::Form).and_then(|plan| {
        MeasureTask::start(context, plan).map_err(|error| MeasureFailure::Fault(error.to_string()))
    });
    match started {
        Ok(running) => {
            (measuring.measured, measuring.failure) = (None, None);
            measuring.running = Some(running);
        }
        Err(failure) => measuring.failure = Some(failure),
    }
}

/// Takes up what was measured, and has everything else wait meanwhile; once a frame.
pub(crate) fn keep_up(context: &Context, studio: &mut Studio) {
    let measuring = &mut studio.panes.measure;
    if let Some(running) = &measuring.running {
        if let Some(measured) = running.measured() {
            measuring.measured = Some(measured);
        }
        if let Some(result) = running.result() {
            measuring.running = None;
            match result {
                Ok(measured) => measuring.measured = Some(Arc::new(measured)),
                Err(failure) => {
                    measuring.measured = None;
                    measuring.failure = Some(failure);
                }
            }
            context.request_repaint();
        }
    }
    studio.view.is_measuring = studio.panes.measure.is_running();
}
