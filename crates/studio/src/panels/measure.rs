//! The measurement: how the time of a picture grows, measured while everything else rests.

mod form;
mod panel;
mod plot;
mod results;
mod task;

use std::sync::Arc;

use catoptric_lab::measure::{MeasurePlan, Measurement};
use catoptric_scene::Scene;

pub(crate) use panel::measure_ui;

use form::MeasureForm;
pub(crate) use task::{MeasureFailure, MeasureTask};

/// The measurement of the window.
#[derive(Default)]
pub(crate) struct MeasureState {
    form: MeasureForm,
    pub(crate) running: Option<MeasureTask>,
    /// What was measured, or is so far.
    pub(crate) measured: Option<Arc<Measurement>>,
    pub(crate) failure: Option<MeasureFailure>,
    shown: results::ResultsView,
}

impl MeasureState {
    /// What to measure of `scene`, which is called `name`.
    ///
    /// # Errors
    /// When what was typed makes no sense.
    pub(crate) fn plan(&self, scene: &Scene, name: String) -> Result<MeasurePlan, MeasureFailure> {
        self.form.plan(scene, name).map_err(MeasureFailure::Form)
    }

    /// Whether times are being measured.
    pub(crate) fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// Whether something was measured that can be saved.
    pub(crate) fn is_measured(&self) -> bool {
        self.measured.is_some() && self.running.is_none()
    }
}
