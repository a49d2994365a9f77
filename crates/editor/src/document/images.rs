//! The pictures of a document, which are opened apart from it.

use std::path::Path;
use std::sync::Arc;

use catoptric_scene::{HasImages as _, Image, Scene};

use super::{Editor, Label, Refused};

impl Editor {
    /// Gives the pictures that are not opened yet those that `open` finds for them: in the scene, in what is saved, and
    /// in all steps of the history. This is no edit. Returns whether the scene has got any.
    pub fn open_images(&mut self, open: impl Fn(&str) -> Option<Image>) -> bool {
        let fill = &mut |image: &mut Image| {
            if image.pixels().is_none()
                && let Some(opened) = open(image.path())
            {
                *image = opened;
            }
        };
        let is_found = |image: &Image| image.pixels().is_none() && open(image.path()).is_some();
        let has_any = self.scene.images().any(is_found);
        let is_saved = self.saved.as_ref().is_some_and(|saved| Arc::ptr_eq(saved, &self.scene));
        if has_any {
            edit_images(&mut self.scene, fill);
            self.revision += 1;
        }
        match &mut self.saved {
            Some(saved) if is_saved => *saved = Arc::clone(&self.scene),
            Some(saved) if saved.images().any(is_found) => edit_images(saved, fill),
            _ => {}
        }
        if let Some(gesture) = &mut self.gesture {
            edit_images(&mut gesture.start, fill);
        }
        self.history.edit_images(fill);
        has_any
    }

    /// Has the paths of pictures begin at `folder`, when the document is to be saved there: one undo step, if there is
    /// anything to change. Pictures in the folder get relative paths.
    ///
    /// # Errors
    /// As for [`Self::change`].
    pub fn move_images(&mut self, label: Label, folder: &Path) -> Result<bool, Refused> {
        let from = self.path.as_deref().and_then(Path::parent).map(Path::to_owned);
        if from.as_deref() == Some(folder) || !self.scene.images().any(|image| !image.is_built_in()) {
            return Ok(false);
        }
        self.settle();
        let changed = self.change(label, |scene| {
            scene.edit_images(&mut |image| *image = image.moved(from.as_deref(), folder));
        });
        self.settle();
        changed
    }
}

fn edit_images(scene: &mut Arc<Scene>, edit: &mut dyn FnMut(&mut Image)) {
    if scene.images().next().is_some() {
        Arc::make_mut(scene).edit_images(edit);
    }
}
