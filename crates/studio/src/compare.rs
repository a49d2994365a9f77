//! The comparison: two pictures of the same view side by side, where and by how much they differ, and why.

mod export;
mod facts;
mod header;
mod images;
mod panel;
mod picture;
mod task;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use catoptric_scene::Camera;
use catoptric_tracer::method::Method;
use egui::Context;

use crate::app::Studio;
use crate::command::CompareCommand;
use crate::documents::file_prompt::FilePrompt;
use crate::layout::{self, Pane};
use crate::methods::MethodSettings;

pub(crate) use export::poll as poll_opening;
pub(crate) use panel::compare_ui;

use images::CompareImages;
use task::{CompareFailure, CompareResult, CompareTask};

/// Nothing is compared before view and scene have rested so long.
const REST: Duration = Duration::from_millis(300);

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
struct ComparisonKey {
    sources: [ComparedPicture; 2],
    /// The view, unless only files are compared.
    view: Option<ComparisonViewKey>,
}

#[derive(Clone, Debug, PartialEq)]
struct ComparisonViewKey {
    revision: u64,
    camera: Camera,
    size: [u32; 2],
}

/// The source of a compared picture.
#[derive(Clone, Debug, PartialEq)]
enum ComparedPicture {
    Method(Method),
    File(PathBuf),
}

/// The comparison of the window.
pub(crate) struct CompareState {
    sides: [CompareSide; 2],
    mode: CompareMode,
    /// Where the line between the pictures is, 0…1.
    divider: f32,
    /// The view's size is divided by this.
    coarseness: u32,
    wanted: Option<(ComparisonKey, Instant)>,
    running: Option<CompareTask>,
    found: Option<Arc<CompareResult>>,
    failed: Option<(ComparisonKey, CompareFailure)>,
    images: CompareImages,
    /// The choice of a picture file for one of the sides.
    opening: Option<(FilePrompt, usize)>,
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
            opening: None,
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
    fn chosen(&self) -> [MethodSettings; 2] {
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

    fn sources(&self) -> [ComparedPicture; 2] {
        let source = |side: &CompareSide| match &side.file {
            Some(path) => ComparedPicture::File(path.clone()),
            None => ComparedPicture::Method(side.methods.method()),
        };
        let [a, b] = &self.sides;
        [source(a), source(b)]
    }

    /// Gives up what is being drawn.
    fn cancel(&mut self) {
        // Dropping it ends it.
        self.running = None;
    }
}

impl ComparedPicture {
    fn is_file(&self) -> bool {
        matches!(self, Self::File(_))
    }
}

/// Does `act`.
pub(crate) fn run(studio: &mut Studio, act: CompareCommand) {
    match act {
        CompareCommand::Swap => studio.panes.compare.sides.swap(0, 1),
        CompareCommand::FileA => export::ask_for_picture(studio, 0),
        CompareCommand::FileB => export::ask_for_picture(studio, 1),
        CompareCommand::Save => export::ask_to_save(studio),
    }
}

/// Has the comparison follow scene, view and choices while its panel can be seen; once a frame.
pub(crate) fn keep_up(context: &Context, studio: &mut Studio) {
    take_result(studio);
    if !layout::is_in_front(&studio.layout, Pane::Compare) || studio.view.is_measuring {
        studio.panes.compare.cancel();
        studio.panes.compare.wanted = None;
        return;
    }
    let Some(key) = key(studio) else { return };
    let is_moving = studio.view.is_moving || studio.editor.is_in_gesture();
    let comparing = &mut studio.panes.compare;
    let since = match &comparing.wanted {
        Some((wanted, since)) if *wanted == key => *since,
        _ => {
            studio.settings.compared = comparing.chosen();
            comparing.wanted = Some((key.clone(), Instant::now()));
            Instant::now()
        }
    };
    if comparing.running.as_ref().is_some_and(|running| running.key != key) {
        comparing.cancel();
    }
    let is_known = comparing.found.as_ref().is_some_and(|found| found.key == key)
        || comparing.failed.as_ref().is_some_and(|(failed, _)| *failed == key);
    if is_known || comparing.running.is_some() {
        return;
    }
    // The first comparison need not wait for a rest.
    let rest = if comparing.found.is_none() { Duration::ZERO } else { REST };
    if is_moving || since.elapsed() < rest {
        context.request_repaint_after(rest.saturating_sub(since.elapsed()).max(Duration::from_millis(16)));
        return;
    }
    let scene = Arc::clone(studio.editor.scene());
    match CompareTask::start(context, key.clone(), scene, studio.editor.title().to_owned()) {
        Ok(running) => comparing.running = Some(running),
        Err(error) => comparing.failed = Some((key, CompareFailure::Fault(error.to_string()))),
    }
}

fn key(studio: &Studio) -> Option<ComparisonKey> {
    let comparing = &studio.panes.compare;
    let sources = comparing.sources();
    if sources.iter().all(ComparedPicture::is_file) {
        return Some(ComparisonKey { sources, view: None });
    }
    let size = studio.panes.viewport.size_in_pixels()?;
    let size = size.map(|side| (side / comparing.coarseness.max(1)).max(1));
    let (revision, camera) = (studio.editor.revision(), studio.shown_camera());
    Some(ComparisonKey { sources, view: Some(ComparisonViewKey { revision, camera, size }) })
}

fn take_result(studio: &mut Studio) {
    let comparing = &mut studio.panes.compare;
    let Some(running) = &comparing.running else { return };
    let Some(result) = running.result() else { return };
    let key = running.key.clone();
    comparing.running = None;
    match result {
        Ok(found) => {
            comparing.found = Some(Arc::new(found));
            comparing.failed = None;
        }
        Err(CompareFailure::Cancelled) => {}
        Err(failure) => comparing.failed = Some((key, failure)),
    }
}
