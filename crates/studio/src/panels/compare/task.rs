//! Drawing and comparing, on threads of their own.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use catoptric_lab::Variant;
use catoptric_lab::compare::{
    CompareError, CompareJob as Drawing, Contender, MethodComparison, compare, draw_all, reason_picture,
};
use catoptric_picture::{Development, HeatMap, Picture, ReadError, SizeError, heat_map, read};
use catoptric_scene::Scene;
use catoptric_tracer::{RenderControl, RenderSettings};
use egui::{ColorImage, Context};

use super::{ComparedPicture, ComparisonKey};
use crate::base::job::{Job, JobStatus};
use crate::base::proof::proof_of;

/// The difference of a channel from which on a pixel counts as wrong: that of `catoptric compare`.
const BOUND: f64 = 1.0 / 255.0;

/// A finished comparison with its images.
pub(crate) struct CompareResult {
    pub(crate) key: ComparisonKey,
    pub(crate) compared: MethodComparison,
    /// The end of the scale of differences.
    pub(crate) scale: f64,
    pub(crate) difference: ColorImage,
    pub(crate) flip: ColorImage,
    /// `None` where the reasons are not known.
    pub(crate) reasons: Option<ColorImage>,
    /// The scene's name, and it as it was drawn; for the report.
    pub(crate) name: String,
    pub(crate) scene: Arc<Scene>,
    /// On how many threads.
    pub(crate) threads: usize,
}

/// The reason why there is no comparison.
#[derive(Debug)]
pub(crate) enum CompareFailure {
    Cancelled,
    /// A file cannot be read.
    Read(PathBuf, String),
    /// The pictures have different sizes.
    Sizes([u32; 2], [u32; 2]),
    /// A picture cannot be drawn or compared.
    Compare(String),
    /// A fault of the program or the system.
    Fault(String),
}

/// A comparison under way.
pub(crate) struct CompareTask {
    pub(crate) key: ComparisonKey,
    control: Arc<RenderControl>,
    steps: Arc<[AtomicUsize; 2]>,
    job: Job<Result<CompareResult, CompareFailure>>,
}

impl CompareTask {
    pub(crate) fn start(
        context: &Context,
        key: ComparisonKey,
        scene: Arc<Scene>,
        name: String,
    ) -> std::io::Result<Self> {
        let (control, steps) = (Arc::new(RenderControl::default()), Arc::<[AtomicUsize; 2]>::default());
        let work = CompareWork {
            key: key.clone(),
            scene,
            name,
            control: Arc::clone(&control),
            steps: Arc::clone(&steps),
            context: context.clone(),
        };
        Ok(Self { key, control, steps, job: Job::start(context, "compare", move || work.run())? })
    }

    fn cancel(&self) {
        self.control.cancel();
    }

    /// Pictures drawn, and how many there will be.
    pub(crate) fn steps(&self) -> [usize; 2] {
        let [done, total] = &*self.steps;
        [done.load(Ordering::Relaxed), total.load(Ordering::Relaxed)]
    }

    /// The result, once, when there is one.
    pub(crate) fn result(&self) -> Option<Result<CompareResult, CompareFailure>> {
        match self.job.poll() {
            JobStatus::Waiting => None,
            JobStatus::Done(result) => Some(result),
            JobStatus::Lost => Some(Err(CompareFailure::Fault(String::new()))),
        }
    }
}

impl Drop for CompareTask {
    fn drop(&mut self) {
        self.cancel();
    }
}

struct CompareWork {
    key: ComparisonKey,
    scene: Arc<Scene>,
    name: String,
    control: Arc<RenderControl>,
    steps: Arc<[AtomicUsize; 2]>,
    context: Context,
}

impl CompareWork {
    fn run(self) -> Result<CompareResult, CompareFailure> {
        let files = self.read_files()?;
        let size = match (&self.key.view, files.iter().flatten().next()) {
            // Where one is a file, the other is drawn as large as that.
            (_, Some(file)) => [file.picture.width(), file.picture.height()],
            (Some(view), None) => view.size,
            (None, None) => return Err(CompareFailure::Cancelled),
        };
        let mut sizes = files.iter().flatten().map(|file| [file.picture.width(), file.picture.height()]);
        if let Some(other) = sizes.find(|other| *other != size) {
            return Err(CompareFailure::Sizes(size, other));
        }
        // The common threads of the program, of which there is one for each processor.
        let threads = catoptric_platform::threads::processors();
        let contenders = self.contenders(files, size)?;
        let compared = compare(contenders, BOUND)?;
        if self.control.is_cancelled() {
            return Err(CompareFailure::Cancelled);
        }
        CompareResult::new(self.key, compared, (self.name, self.scene), threads)
    }

    fn read_files(&self) -> Result<[Option<Contender>; 2], CompareFailure> {
        let [a, b] = &self.key.sources;
        let file = |source: &ComparedPicture| -> Result<Option<Contender>, CompareFailure> {
            match source {
                ComparedPicture::Method(_) => Ok(None),
                ComparedPicture::File(path) => {
                    let picture = read(path).map_err(|error| CompareFailure::of_file(path, &error))?;
                    Ok(Some(Contender { name: name_of(path), picture, drawn: None }))
                }
            }
        };
        Ok([file(a)?, file(b)?])
    }

    /// Both pictures, in their order.
    fn contenders(
        &self,
        files: [Option<Contender>; 2],
        [width, height]: [u32; 2],
    ) -> Result<Vec<Contender>, CompareFailure> {
        let variants = self.key.sources.iter().filter_map(|source| match source {
            ComparedPicture::Method(method) => Some(Variant::from(*method)),
            ComparedPicture::File(_) => None,
        });
        let variants: Vec<Variant> = variants.collect();
        let Some(view) = self.key.view.as_ref().filter(|_| !variants.is_empty()) else {
            return Ok(files.into_iter().flatten().collect());
        };
        let scene = Scene { camera: view.camera, ..Scene::clone(&self.scene) };
        let settings = RenderSettings { width, height, samples: 1 };
        let job = Drawing { scene: &scene, variants: &variants, settings, runs: 1, bound: BOUND };
        let mut drawn = draw_all(&job, &self.control, &mut |done, total| {
            let [own_done, own_total] = &*self.steps;
            own_done.store(done, Ordering::Relaxed);
            own_total.store(total, Ordering::Relaxed);
            self.context.request_repaint();
        })?
        .into_iter();
        Ok(files.into_iter().filter_map(|file| file.or_else(|| drawn.next())).collect())
    }
}

impl CompareResult {
    fn new(
        key: ComparisonKey,
        compared: MethodComparison,
        (name, scene): (String, Arc<Scene>),
        threads: usize,
    ) -> Result<Self, CompareFailure> {
        let scale = compared.scale();
        let Some((other, metrics)) = compared.others().next() else { return Err(CompareFailure::Cancelled) };
        let Some(truth) = compared.truth() else { return Err(CompareFailure::Cancelled) };
        let options = HeatMap { legend: false, maximum: scale, ..HeatMap::default() };
        let difference = heat_map(&truth.picture, &other.picture, &options)
            .map_err(|error| CompareFailure::Compare(error.to_string()))?;
        let flip = metrics.flip_map.heat_map(&HeatMap { maximum: 1.0, ..options })?;
        let reasons = other.drawn.as_ref().and_then(|drawn| drawn.reasons.as_ref());
        let reasons = reasons.map(reason_picture).transpose()?;
        Ok(Self {
            key,
            scale,
            difference: image(&difference, Development::default()),
            flip: image(&flip, Development::default()),
            reasons: reasons.map(|reasons| image(&reasons, Development::default())),
            compared,
            name,
            scene,
            threads,
        })
    }

    /// Pixels across and down.
    pub(crate) fn size(&self) -> [u32; 2] {
        self.compared.truth().map_or([1, 1], |truth| [truth.picture.width(), truth.picture.height()])
    }
}

/// A picture as the window shows it.
pub(crate) fn image(picture: &Picture, development: Development) -> ColorImage {
    proof_of(picture, development)
}

/// What a file is called.
pub(crate) fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

impl CompareFailure {
    fn of_file(path: &Path, error: &ReadError) -> Self {
        let reason = std::error::Error::source(error).map_or_else(|| error.to_string(), ToString::to_string);
        Self::Read(path.to_owned(), reason)
    }
}

impl From<CompareError> for CompareFailure {
    fn from(error: CompareError) -> Self {
        match error {
            CompareError::Cancelled => Self::Cancelled,
            error => {
                let source = std::error::Error::source(&error).map(ToString::to_string);
                Self::Compare(
                    [Some(error.to_string()), source].into_iter().flatten().collect::<Vec<_>>().join(": "),
                )
            }
        }
    }
}

impl From<SizeError> for CompareFailure {
    fn from(error: SizeError) -> Self {
        Self::Compare(error.to_string())
    }
}
