//! The measurement: its commands, and what rests meanwhile.

mod export;

use std::sync::Arc;

use catoptric_lab::report::points_csv;
use egui::Context;

use crate::panels::measure::{MeasureFailure, MeasureTask};
use crate::shell::studio::Studio;
use crate::state::command::MeasureCommand;
use crate::state::layout::{self, Pane};

/// Does `act`.
pub(crate) fn run(context: &Context, studio: &mut Studio, act: MeasureCommand) {
    match act {
        MeasureCommand::Vary(path) => {
            show(studio);
            studio.panes.measure.vary(studio.editor.scene(), path.as_ref());
        }
        MeasureCommand::Start => start(context, studio),
        MeasureCommand::Stop => {
            if let Some(running) = &studio.panes.measure.running {
                running.cancel();
            }
        }
        MeasureCommand::Copy => {
            let measuring = &studio.panes.measure;
            if let Some(measured) = measuring.measured.as_ref().filter(|_| measuring.is_measured()) {
                context.copy_text(points_csv(measured));
                studio.toasts.success(studio.texts.get("measure-copied"));
            }
        }
        MeasureCommand::Save => export::ask(studio),
    }
}

/// Brings the panel to the front.
fn show(studio: &mut Studio) {
    if !layout::is_in_front(&studio.layout, Pane::Measure) {
        layout::set_visible(&mut studio.layout, Pane::Measure, true);
    }
}

fn start(context: &Context, studio: &mut Studio) {
    if studio.panes.measure.is_running() {
        return;
    }
    show(studio);
    if studio.is_rendering() {
        studio.panes.measure.failure = Some(MeasureFailure::Busy);
        return;
    }
    let scene = studio.editor.scene();
    let name = studio.editor.title().trim_end_matches(".toml").to_owned();
    let measuring = &mut studio.panes.measure;
    let started = measuring.plan(scene, name, studio.audit.pin()).and_then(|plan| {
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
