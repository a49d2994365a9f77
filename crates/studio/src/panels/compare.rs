//! The comparison: two pictures of the same view side by side, where and by how much they differ, and why.

mod check;
mod facts;
mod header;
mod images;
mod panel;
mod picture;
mod task;

use std::path::PathBuf;
use std::sync::Arc;

use catoptric_platform::time::Instant;
use catoptric_scene::Camera;
use catoptric_tracer::raster::Method;

use crate::state::methods::MethodSettings;

pub(crate) use panel::compare_ui;

use check::CheckState;
use images::CompareImages;
pub(crate) use task::{CompareFailure, CompareResult, CompareTask};

/// The display of the two pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum CompareMode {
    /// A at the left of a line, B at its right.
    #[default]
    Split,
    /// The first picture.
    A,
    /// The second picture.
    B,
    /// By how much they differ.
    Difference,
    /// How different they look.
    Flip,
    /// Why they differ.
    Reasons,
}

/// The choice for one of the two pictures.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CompareSide {
    pub(crate) methods: MethodSettings,
    /// A picture file instead.
    pub(crate) file: Option<PathBuf>,
}

/// The inputs of a comparison; another key needs a new comparison.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ComparisonKey {
    pub(crate) sources: [ComparedPicture; 2],
    /// The view, unless only files are compared.
    pub(crate) view: Option<ComparisonViewKey>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ComparisonViewKey {
    pub(crate) revision: u64,
    pub(crate) camera: Camera,
    pub(crate) size: [u32; 2],
}

/// The source of a compared picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ComparedPicture {
    Method(Method),
    File(PathBuf),
}

/// The comparison of the window.
pub(crate) struct CompareState {
    pub(crate) sides: [CompareSide; 2],
    mode: CompareMode,
    /// Where the line between the pictures is, 0…1.
    divider: f32,
    /// The view's size is divided by this.
    pub(crate) coarseness: u32,
    pub(crate) wanted: Option<(ComparisonKey, Instant)>,
    pub(crate) running: Option<CompareTask>,
    pub(crate) found: Option<Arc<CompareResult>>,
    pub(crate) failed: Option<(ComparisonKey, CompareFailure)>,
    images: CompareImages,
    check: CheckState,
    /// The pixel under the pointer.
    pixel: Option<[u32; 2]>,
}

impl Default for CompareState {
    fn default() -> Self {
        let side = || CompareSide { methods: MethodSettings::default(), file: None };
        Self {
            sides: [side(), side()],
            mode: CompareMode::default(),
            divider: 0.5,
            coarseness: 2,
            wanted: None,
            running: None,
            found: None,
            failed: None,
            images: CompareImages::default(),
            check: CheckState::default(),
            pixel: None,
        }
    }
}

impl CompareState {
    /// The device of the window is another.
    pub(crate) fn forget_textures(&mut self) {
        self.images = CompareImages::default();
    }

    /// Compares these ways of drawing.
    pub(crate) fn choose(&mut self, compared: &[MethodSettings; 2]) {
        for (side, methods) in self.sides.iter_mut().zip(compared) {
            side.methods.clone_from(methods);
        }
    }

    /// The two ways of drawing, to be remembered.
    pub(crate) fn chosen(&self) -> [MethodSettings; 2] {
        let [a, b] = &self.sides;
        [a.methods.clone(), b.methods.clone()]
    }

    /// Whether pictures are being drawn: the viewport then does not refine its own.
    pub(crate) fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// Whether there is a comparison to be saved.
    pub(crate) fn is_found(&self) -> bool {
        self.found.is_some()
    }

    pub(crate) fn sources(&self) -> [ComparedPicture; 2] {
        let source = |side: &CompareSide| match &side.file {
            Some(path) => ComparedPicture::File(path.clone()),
            None => ComparedPicture::Method(side.methods.method()),
        };
        let [a, b] = &self.sides;
        [source(a), source(b)]
    }

    /// Gives up what is being drawn.
    pub(crate) fn cancel(&mut self) {
        // Dropping it ends it.
        self.running = None;
    }
}

impl ComparedPicture {
    pub(crate) fn is_file(&self) -> bool {
        matches!(self, Self::File(_))
    }
}
