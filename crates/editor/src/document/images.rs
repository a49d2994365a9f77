//! The pictures of a document, which are opened apart from it.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use catoptric_scene::{HasImages as _, Image, ImageSource, Scene};
use catoptric_store::moved_path;

use super::Editor;

impl Editor {
    /// Gives the pictures that are not opened yet those that `open` finds for them: in the scene, in what is saved, and
    /// in all steps of the history. This is no edit. Returns whether the scene has got any.
    pub fn open_images(&mut self, open: impl Fn(&ImageSource) -> Option<Image>) -> bool {
        let fill = &mut |image: &mut Image| {
            if image.pixels().is_none()
                && let Some(opened) = open(image.source())
            {
                *image = opened;
            }
        };
        let is_found = |image: &Image| image.pixels().is_none() && open(image.source()).is_some();
        let is_saved = self.saved.as_ref().is_some_and(|saved| Arc::ptr_eq(saved, self.scene()));
        let has_any = self.edit_all_images(is_found, fill);
        match &mut self.saved {
            Some(saved) if is_saved => *saved = Arc::clone(&self.edited.scene),
            Some(saved) => _ = edit_images(saved, is_found, fill),
            None => {}
        }
        has_any
    }

    /// Has all paths of pictures begin at the folder `to`, in all steps of the history as well: wherever undo leads,
    /// they mean the files that they meant before the document went there.
    pub(super) fn move_images(&mut self, from: Option<&Path>, to: Option<&Path>) {
        self.edit_all_images(|image| !image.is_built_in(), &mut mover(from, to));
    }

    /// Changes the pictures of the scene, of the start of a gesture, and of all steps. Scenes without any `concerned`
    /// picture are left alone. Returns whether the present one is not.
    fn edit_all_images(
        &mut self,
        concerned: impl Fn(&Image) -> bool,
        edit: &mut dyn FnMut(&mut Image),
    ) -> bool {
        let is_edited = edit_images(&mut self.edited.scene, &concerned, edit);
        if is_edited {
            self.revision += 1;
        }
        if let Some(gesture) = &mut self.gesture {
            edit_images(&mut gesture.start.scene, &concerned, edit);
        }
        self.history.edit_images(edit);
        is_edited
    }
}

/// Has the paths of the scene's pictures begin at the folder `to`; see [`moved_path`].
pub(super) fn move_images(scene: &mut Arc<Scene>, from: Option<&Path>, to: Option<&Path>) {
    edit_images(scene, |image| !image.is_built_in(), &mut mover(from, to));
}

/// Gives the scene's pictures that are not opened those that another scene has of the same sources.
pub(super) fn share_pixels(scene: &mut Arc<Scene>, other: &Scene) {
    let is_unopened = |image: &Image| image.pixels().is_none();
    if !scene.images_besides(other).any(is_unopened) {
        return;
    }
    let opened = other.images().filter(|image| !is_unopened(image));
    let opened: HashMap<&ImageSource, &Image> = opened.map(|image| (image.source(), image)).collect();
    let is_found = |image: &Image| is_unopened(image) && opened.contains_key(image.source());
    edit_images(scene, is_found, &mut |image| {
        if is_unopened(image)
            && let Some(&found) = opened.get(image.source())
        {
            image.clone_from(found);
        }
    });
}

/// Changes paths of pictures, each distinct one worked out once: a million bodies may have the same.
pub(crate) fn mover(from: Option<&Path>, to: Option<&Path>) -> impl FnMut(&mut Image) {
    let mut moved: HashMap<String, Option<Arc<str>>> = HashMap::new();
    move |image| {
        if !moved.contains_key(image.path()) {
            let path = moved_path(image.path(), from, to).map(Arc::from);
            moved.insert(image.path().to_owned(), path);
        }
        if let Some(Some(path)) = moved.get(image.path()) {
            *image = image.with_path(Arc::clone(path));
        }
    }
}

fn edit_images(
    scene: &mut Arc<Scene>,
    concerned: impl Fn(&Image) -> bool,
    edit: &mut dyn FnMut(&mut Image),
) -> bool {
    let is_concerned = scene.images().any(concerned);
    if is_concerned {
        Arc::make_mut(scene).edit_images(edit);
    }
    is_concerned
}
