//! The path and the saved state of a document.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptric_scene::{Scene, update, write};

use super::images::{move_images, share_pixels};
use super::{Editor, Gesture, RefusedChange};
use crate::label::Label;

/// A snapshot of the scene for writing, so that another thread can make its text.
#[derive(Clone, Debug)]
pub struct SceneWriter {
    scene: Arc<Scene>,
    original_text: Arc<str>,
}

impl SceneWriter {
    /// The scene.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// The text to write: that of the scene's file with the edits since; comments and order are kept.
    pub fn text(&self) -> String {
        if self.original_text.is_empty() {
            write(&self.scene)
        } else {
            update(&self.original_text, &self.scene)
        }
    }

    /// Makes the paths of pictures absolute, for a document without a file: they are found wherever the text is read.
    #[must_use]
    pub fn with_whole_paths(mut self) -> Self {
        move_images(&mut self.scene, None, None);
        self
    }
}

impl Editor {
    /// The scene as it is now, to be written. Its text takes as long to make as the file takes to read.
    pub fn writing(&self) -> SceneWriter {
        SceneWriter { scene: Arc::clone(&self.edited.scene), original_text: Arc::clone(&self.text) }
    }

    /// The scene as it is now, with paths of pictures from the folder of the file at `path`, to be written there. The
    /// document itself does not change before [`Self::mark_written`], since the writing may fail.
    pub fn writing_to(&self, path: &Path) -> SceneWriter {
        let mut writing = self.writing();
        if self.folder() != path.parent() {
            move_images(&mut writing.scene, self.folder(), path.parent());
        }
        writing
    }

    /// Tells that `writing`, made [for it](Self::writing_to), was saved as `text` in the file at `path`. The scene may
    /// have changed since. In another folder than before, the document finds its pictures from there; this is no edit.
    pub fn mark_written(
        &mut self,
        writing: &SceneWriter,
        path: impl Into<PathBuf>,
        text: impl Into<Arc<str>>,
    ) {
        let path = path.into();
        if self.folder() != path.parent() {
            let from = self.folder().map(Path::to_owned);
            self.move_images(from.as_deref(), path.parent());
            if self.edited.scene == writing.scene {
                // Lists that are shared are compared at once.
                self.edited.scene = Arc::clone(&writing.scene);
            }
        }
        self.set_path(path);
        self.text = text.into();
        let mut saved = Arc::clone(&writing.scene);
        share_pixels(&mut saved, &self.edited.scene);
        self.saved = Some(saved);
    }

    /// Where the paths of its pictures begin.
    pub(crate) fn folder(&self) -> Option<&Path> {
        self.path.as_deref().and_then(Path::parent)
    }

    /// Whether the scene is another than the saved one. Undoing back to that makes this false again.
    pub fn is_changed(&self) -> bool {
        self.saved
            .as_ref()
            .is_none_or(|saved| !Arc::ptr_eq(saved, &self.edited.scene) && *saved != self.edited.scene)
    }

    /// Whether something would be lost with the document: a change that no file has, other than looking around in a
    /// document that never had a file, such as an example. A file's own camera is a part of it as everything else.
    pub fn has_unsaved_work(&self) -> bool {
        match &self.saved {
            Some(saved) if self.path.is_none() => {
                let is_moved = saved.camera != self.edited.scene.camera;
                differ_beyond_cameras(saved, &self.edited.scene) || is_moved && !self.has_only_navigated()
            }
            _ => self.is_changed(),
        }
    }

    /// Whether nothing but [`Self::navigate`] has moved the camera to where it is.
    fn has_only_navigated(&self) -> bool {
        let is_moving = |gesture: &&Gesture| gesture.start.scene.camera != self.edited.scene.camera;
        let gesture = self.gesture.as_ref().filter(is_moving);
        gesture.is_none_or(|gesture| gesture.is_navigation) && self.history.has_only_navigated()
    }

    /// Tells that no file has this document as it is, such as one that was recovered: it is changed until it is saved.
    pub fn mark_unsaved(&mut self) {
        self.saved = None;
    }

    /// The file, if there is one.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The name of the file, or of the example; empty when there is neither.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Takes the scene that the document's file says now, as one undo step. Things of one name are the same, those
    /// without a name by their values, then by their places.
    ///
    /// # Errors
    /// When the scene has problems.
    pub fn revert(&mut self, text: impl Into<Arc<str>>, scene: Scene) -> Result<(), RefusedChange> {
        self.settle();
        let saved = Arc::new(scene);
        let label = Label::new("edit-revert", self.title.clone());
        self.step(label, self.edited.revised(Arc::clone(&saved)), self.selection.clone())?;
        self.text = text.into();
        self.saved = Some(saved);
        Ok(())
    }

    pub(super) fn set_path(&mut self, path: PathBuf) {
        self.title = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        self.path = Some(path);
    }
}

/// Whether two scenes differ in anything but their cameras.
fn differ_beyond_cameras(one: &Arc<Scene>, other: &Arc<Scene>) -> bool {
    if Arc::ptr_eq(one, other) {
        return false;
    }
    let Scene { camera: _, environment, tracing, materials, lights, bodies } = &**one;
    *environment != other.environment
        || *tracing != other.tracing
        || *materials != other.materials
        || *lights != other.lights
        || *bodies != other.bodies
}
