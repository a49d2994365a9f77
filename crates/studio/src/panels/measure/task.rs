//! Measuring on a thread of its own.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use catoptric_lab::Machine;
use catoptric_lab::measure::{MeasureError, MeasurePlan, Measurement, Parameter, measure};
use catoptric_platform::time::{Duration, Instant};
use catoptric_scene::{AddressError, SceneValue};
use catoptric_tracer::RenderControl;
use catoptric_tracer::raster::MethodError;
use egui::Context;

use super::form::MeasureFormError;
use crate::base::job::{Job, JobStatus};

/// The window is woken no more often than this: drawing it takes time that is being measured.
const BETWEEN: Duration = Duration::from_millis(500);

/// The reason why nothing was measured.
#[derive(Debug)]
pub(crate) enum MeasureFailure {
    /// What was typed makes no sense.
    Form(MeasureFormError),
    /// A value of the scene cannot be set.
    Setting(SceneValue, AddressError),
    /// A pixel that is asked for is not in a picture of this size.
    Pixel([u32; 2]),
    /// Pictures of different sizes have no difference.
    Sizes,
    /// The method has nothing that the parameter could vary.
    Meaningless(Parameter),
    /// The method cannot draw it.
    Method(MethodError),
    /// A picture is being rendered.
    Busy,
    /// Ended before anything was measured.
    Cancelled,
    /// Something else.
    Fault(String),
}

/// A measurement under way.
pub(crate) struct MeasureTask {
    control: Arc<RenderControl>,
    told: Arc<Mutex<MeasureProgress>>,
    job: Job<Result<Measurement, MeasureError>>,
}

/// The progress that the thread reports.
#[derive(Clone, Default)]
pub(crate) struct MeasureProgress {
    /// Pictures measured, those of the warm-up counted.
    pub(crate) done: usize,
    /// All there will be.
    pub(crate) total: usize,
    /// The time that the rest will take, once it is known.
    pub(crate) left: Option<Duration>,
    measured: Option<Arc<Measurement>>,
}

impl MeasureTask {
    pub(crate) fn start(context: &Context, plan: MeasurePlan) -> std::io::Result<Self> {
        let (control, told) =
            (Arc::new(RenderControl::default()), Arc::new(Mutex::new(MeasureProgress::default())));
        let (own_control, own_told, own_context) = (Arc::clone(&control), Arc::clone(&told), context.clone());
        let work = move || {
            let machine = Machine::here();
            let mut woken: Option<Instant> = None;
            measure(&plan, &own_control, &mut |progress| {
                if woken.is_some_and(|woken| woken.elapsed() < BETWEEN) {
                    return;
                }
                woken = Some(Instant::now());
                let measured = Measurement {
                    name: plan.name.clone(),
                    axes: plan.axes.clone(),
                    keys: plan.keys(),
                    questions: plan.questions.clone(),
                    points: progress.points.to_vec(),
                    rounds: plan.rounds,
                    complete: false,
                    machine: machine.clone(),
                };
                let measured = Some(Arc::new(measured));
                *lock(&own_told) = MeasureProgress {
                    done: progress.done,
                    total: progress.total,
                    left: progress.left,
                    measured,
                };
                own_context.request_repaint();
            })
        };
        Ok(Self { control, told, job: Job::start(context, "measure", work)? })
    }

    pub(crate) fn cancel(&self) {
        self.control.cancel();
    }

    /// How far it is.
    pub(crate) fn told(&self) -> MeasureProgress {
        lock(&self.told).clone()
    }

    /// The measurement so far, once for each report.
    pub(crate) fn measured(&self) -> Option<Arc<Measurement>> {
        lock(&self.told).measured.take()
    }

    /// The result, once, when there is one.
    pub(crate) fn result(&self) -> Option<Result<Measurement, MeasureFailure>> {
        match self.job.poll() {
            JobStatus::Waiting => None,
            JobStatus::Done(result) => Some(result.map_err(MeasureFailure::from)),
            JobStatus::Lost => Some(Err(MeasureFailure::Fault(String::new()))),
        }
    }
}

impl Drop for MeasureTask {
    fn drop(&mut self) {
        self.cancel();
    }
}

fn lock(told: &Mutex<MeasureProgress>) -> MutexGuard<'_, MeasureProgress> {
    told.lock().unwrap_or_else(PoisonError::into_inner)
}

impl From<MeasureError> for MeasureFailure {
    fn from(error: MeasureError) -> Self {
        match error {
            MeasureError::Meaningless { parameter, .. } => Self::Meaningless(parameter),
            MeasureError::Method(error) => Self::Method(error),
            MeasureError::Cancelled => Self::Cancelled,
            MeasureError::Setting { value, source } => Self::Setting(value, source),
            MeasureError::Pixel { width, height, .. } => Self::Pixel([width, height]),
            MeasureError::Sizes => Self::Sizes,
            MeasureError::Axis(_) => Self::Form(MeasureFormError::Twice),
            error => Self::Fault(error.to_string()),
        }
    }
}
