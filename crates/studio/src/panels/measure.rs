//! The measurement: how the time of a picture grows, measured while everything else rests.

mod address_field;
mod form;
mod number_axis;
mod panel;
mod plot;
mod questions;
mod results;
mod task;

use std::sync::Arc;

use catoptric_lab::measure::{MeasurePlan, Measurement};
use catoptric_scene::{Scene, ScenePath};

pub(crate) use panel::measure_ui;

use crate::state::audit::PinnedPixel;
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
    /// What to measure of `scene`, which is called `name`; `pin` is the pixel that is looked into.
    ///
    /// # Errors
    /// When what was typed makes no sense.
    pub(crate) fn plan(
        &self,
        scene: &Scene,
        name: String,
        pin: Option<&PinnedPixel>,
    ) -> Result<MeasurePlan, MeasureFailure> {
        self.form.plan(scene, name, pin).map_err(MeasureFailure::Form)
    }

    /// Fills in a number of the scene to be varied; without an address, that is to be typed.
    pub(crate) fn vary(&mut self, scene: &Scene, path: Option<&ScenePath>) {
        self.form.vary(scene, path);
        self.failure = None;
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
