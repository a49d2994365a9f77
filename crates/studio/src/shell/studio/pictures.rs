//! The state of pictures that are made: those being rendered, finished, saved and copied.

use std::path::PathBuf;
use std::rc::Weak;
use std::sync::Arc;

use catoptric_live::RenderJob;
use catoptric_picture::{Development, FormatError, Picture, SizeError, WriteError};
use catoptric_platform::time::{Duration, Instant};
use catoptric_tracer::{RayCounts, RenderOutput};
use egui::ColorImage;

use super::file_prompt::FilePrompt;
use super::picture_proof::PictureProof;
use crate::base::job::{Job, let_go};
use crate::state::render_choices::{PictureKind, RenderChoices};

/// The rendered pictures of the window.
#[derive(Default)]
pub(crate) struct RenderedPictures {
    pub(crate) running: Option<RenderTask>,
    pub(crate) finished: Vec<FinishedPicture>,
    /// How many have been finished so far.
    pub(crate) count: u64,
    pub(crate) copying: ClipboardCopy,
    pub(crate) close_guard: PictureCloseGuard,
}

/// A render that is under way.
pub(crate) struct RenderTask {
    pub(crate) job: RenderJob,
    pub(crate) order: RenderRequest,
}

/// A request to render a picture.
#[derive(Clone, Debug)]
pub(crate) struct RenderRequest {
    pub(crate) choices: RenderChoices,
    pub(crate) development: Development,
    /// The document's name.
    pub(crate) name: String,
}

impl RenderedPictures {
    /// Whether finished pictures stand in their windows.
    pub(crate) fn has_windows(&self) -> bool {
        !self.finished.is_empty()
    }

    /// Whether a picture is being rendered.
    pub(crate) fn is_rendering(&self) -> bool {
        self.running.is_some()
    }

    /// The device of the window is another.
    pub(crate) fn forget_textures(&mut self) {
        self.finished.iter_mut().for_each(FinishedPicture::forget_texture);
    }

    /// Gives up the picture that is being rendered.
    pub(crate) fn cancel(&mut self) {
        if let Some(running) = self.running.take() {
            running.job.cancel();
            let_go(running);
        }
    }
}

/// A finished picture.
pub(crate) struct FinishedPicture {
    pub(crate) number: u64,
    /// The least place that no other open window has: the toolkit never forgets what it kept for one.
    pub(crate) place: usize,
    pub(crate) picture: Arc<Picture>,
    pub(crate) order: RenderRequest,
    /// Where it has been kept, if anywhere.
    pub(crate) kept: Option<SavedPlace>,
    pub(crate) saving: PictureSaveState,
    pub(crate) counts: RayCounts,
    pub(crate) elapsed: Duration,
    pub(crate) shown: PictureProof,
}

/// The place where a picture has been kept.
pub(crate) enum SavedPlace {
    /// In a file of this name.
    File(String),
    /// In the clipboard.
    Clipboard,
}

impl FinishedPicture {
    /// The window of a picture among the `others`.
    pub(crate) fn new(
        number: u64,
        others: &[Self],
        rendering: RenderOutput,
        order: RenderRequest,
        elapsed: Duration,
    ) -> Self {
        let place = (0..).find(|place| others.iter().all(|other| other.place != *place)).unwrap_or_default();
        Self {
            number,
            place,
            picture: Arc::new(rendering.picture),
            order,
            kept: None,
            saving: PictureSaveState::No,
            counts: rendering.counts,
            elapsed,
            shown: PictureProof::default(),
        }
    }

    /// The device of the window is another: the picture is developed again.
    pub(crate) fn forget_texture(&mut self) {
        self.shown = PictureProof::default();
    }
}

/// The state of saving a picture.
#[derive(Default)]
pub(crate) enum PictureSaveState {
    /// Nothing is being saved.
    #[default]
    No,
    /// The person is choosing a file.
    Asking(FilePrompt),
    /// The file is being written.
    Writing(PictureSaveRequest, Job<Result<(), PictureSaveFailure>>),
}

/// A request to save a picture.
#[derive(Clone)]
pub(crate) struct PictureSaveRequest {
    pub(crate) path: PathBuf,
    pub(crate) may_replace: bool,
    pub(crate) kind: PictureKind,
    pub(crate) development: Development,
}

/// The reason why there is no file; an old one is untouched.
pub(crate) enum PictureSaveFailure {
    /// There is one already.
    Exists,
    /// The file cannot be written.
    Write(WriteError),
    /// The picture cannot be developed.
    Size(SizeError),
    /// The format does not take it.
    Format(FormatError),
}

/// The state of a copy to the clipboard.
#[derive(Default)]
pub(crate) struct ClipboardCopy {
    /// The viewport's picture is to be copied.
    pub(crate) viewport: Option<PendingCopy>,
    pub(crate) job: Option<(CopySource, Job<Result<CopyOutcome, CopyFailure>>)>,
}

/// A copy that waits for the viewport's picture.
#[derive(Clone, Copy)]
pub(crate) struct PendingCopy {
    pub(crate) since: Instant,
    /// Whether it is copied before it is refined.
    pub(crate) is_hurried: bool,
    pub(crate) is_told: bool,
}

/// The source of a copied picture.
#[derive(Clone, Copy)]
pub(crate) enum CopySource {
    Viewport([u32; 2]),
    Finished(u64, [u32; 2]),
}

/// The result of a copy.
pub(crate) enum CopyOutcome {
    /// The picture is in the clipboard.
    Done,
    /// The window has to put the picture into the clipboard.
    Image(ColorImage),
}

/// The reason why a picture was not copied.
pub(crate) enum CopyFailure {
    TooLarge,
    Memory,
    Clipboard(String),
}

/// The state of the question about unsaved pictures at the end of the studio.
#[derive(Default)]
pub(crate) struct PictureCloseGuard {
    /// The pictures of this moment may be lost.
    pub(crate) is_agreed: bool,
    /// The studio is left when a file has been written.
    pub(crate) is_waiting: bool,
    /// The open question, if there is one.
    pub(crate) asked: Weak<()>,
}

impl PictureCloseGuard {
    /// There are other pictures now.
    pub(crate) fn forget(&mut self) {
        self.is_agreed = false;
    }
}
