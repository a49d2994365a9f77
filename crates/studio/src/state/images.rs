//! Pictures that the scene takes from files, opened by a thread.
//!
//! The document has their paths; whatever is not opened yet, by an edit, a paste or an undo, is opened here.

use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptric_scene::{Image, ImageError, ImageFault, ImageSource, Scene};
use catoptric_store::Folder;
use egui::Context;

use crate::base::job::{Job, JobStatus, let_go};
use crate::base::texts::Texts;
use crate::base::words::name_of;

/// What a picture is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ImageUse {
    /// Everything around the bodies.
    Surroundings,
    /// The selected material.
    Texture,
}

/// The state of the document's pictures.
#[derive(Default)]
pub(crate) struct DocumentImages {
    /// The document, and the folder at which its paths begin, for which the rest holds.
    home: Option<(u64, Option<PathBuf>)>,
    /// The scene that was looked through last: all its pictures are opened, being opened, or missing.
    looked_at: Option<Arc<Scene>>,
    /// Pictures that could not be opened. The others are in the document alone: what its paths name may be another
    /// picture by now.
    missing: HashSet<ImageSource>,
    job: Option<Job<Vec<OpenedImage>>>,
}

/// A picture that was opened, or could not be.
pub(crate) type OpenedImage = (ImageSource, Result<Image, ImageError>);

impl DocumentImages {
    /// Whether the picture of a source could not be opened.
    pub(crate) fn is_missing(&self, source: &ImageSource) -> bool {
        self.missing.contains(source)
    }

    /// Whether any picture is being opened.
    pub(crate) fn is_opening(&self) -> bool {
        self.job.is_some()
    }

    /// Forgets what paths have led to, when they mean other files from now on.
    pub(crate) fn mind_home(&mut self, document: u64, folder: Option<&Path>) {
        let is_home =
            |(number, home): &(u64, Option<PathBuf>)| *number == document && home.as_deref() == folder;
        if !self.home.as_ref().is_some_and(is_home) {
            self.home = Some((document, folder.map(Path::to_owned)));
            self.missing.clear();
            self.look_anew();
        }
    }

    /// The sources of pictures of `scene` that are to be opened now.
    pub(crate) fn take_unopened(&mut self, scene: &Arc<Scene>) -> Vec<ImageSource> {
        if self.is_opening() || self.looked_at.as_ref().is_some_and(|before| Arc::ptr_eq(before, scene)) {
            return Vec::new();
        }
        let sources = unopened(self.looked_at.as_deref(), scene, |source| self.missing.contains(source));
        self.looked_at = Some(Arc::clone(scene));
        sources
    }

    /// Opens pictures on a thread; their paths begin at `folder`.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub(crate) fn open(
        &mut self,
        context: &Context,
        sources: Vec<ImageSource>,
        folder: Option<PathBuf>,
    ) -> std::io::Result<()> {
        let work = move || {
            let open = |source: ImageSource| {
                let image = Image::open(&source, &Folder::new(folder.as_deref()));
                (source, image)
            };
            sources.into_iter().map(open).collect()
        };
        self.job = Some(Job::start(context, "pictures", work)?);
        Ok(())
    }

    /// The pictures that were opened, once; `None` while there are none.
    pub(crate) fn poll(&mut self) -> Option<JobStatus<Vec<OpenedImage>>> {
        let status = self.job.as_ref()?.poll();
        if matches!(status, JobStatus::Waiting) {
            return None;
        }
        self.job = None;
        Some(status)
    }

    /// A picture could not be opened.
    pub(crate) fn add_missing(&mut self, source: ImageSource) {
        self.missing.insert(source);
    }

    /// Has a picture opened again that may have been mended, and whatever is being opened, which may have been
    /// replaced.
    pub(crate) fn retry(&mut self, source: &ImageSource) {
        self.missing.remove(source);
        self.look_anew();
    }

    /// Has all pictures of the document looked at again, and what is being opened opened again.
    fn look_anew(&mut self) {
        if let Some(scene) = self.looked_at.take() {
            // Freeing the last of a large document takes longer than a frame.
            let_go(scene);
        }
        self.job = None;
    }
}

/// Sources of the pictures that are to be opened, each once. Of `before` they are already, and of bodies that are
/// shared with it: a drag of one of a million bodies must not wait for a walk through all.
fn unopened(
    before: Option<&Scene>,
    scene: &Scene,
    is_missing: impl Fn(&ImageSource) -> bool,
) -> Vec<ImageSource> {
    let unknown = |image: &&Image| image.pixels().is_none() && !is_missing(image.source());
    let sources: BTreeSet<&ImageSource> = match before {
        Some(before) => scene.images_besides(before).filter(unknown).map(Image::source).collect(),
        None => scene.images().filter(unknown).map(Image::source).collect(),
    };
    sources.into_iter().cloned().collect()
}

/// What a picture is called where there is little room.
pub(crate) fn name<'a>(texts: &'a Texts, path: &'a str) -> std::borrow::Cow<'a, str> {
    match path.strip_prefix(Image::BUILT_IN) {
        Some("evening") => texts.get("picture-evening").into(),
        Some("studio") => texts.get("picture-studio").into(),
        Some("planet") => texts.get("picture-planet").into(),
        Some("grid") => texts.get("picture-grid").into(),
        Some(other) => other.into(),
        None => name_of(Path::new(path)).into(),
    }
}

/// Why a picture could not be opened, in the present language.
pub(crate) fn in_words(texts: &Texts, error: &ImageError) -> String {
    let reason = match &error.fault {
        ImageFault::NotBuiltIn => texts.get("picture-not-built-in").to_owned(),
        ImageFault::BuiltInLayer => texts.get("picture-built-in-layer").to_owned(),
        ImageFault::NotAFile => texts.get("picture-not-a-file").to_owned(),
        ImageFault::Missing(file) => texts.with("picture-missing", &[("path", file.as_str().into())]),
        ImageFault::TooLarge { width, height } => {
            texts.with("picture-too-large", &[("size", format!("{width}×{height}").into())])
        }
        fault @ ImageFault::Unreadable { .. } => fault.text(texts.language().into()),
    };
    let name = name(texts, error.image.path()).into_owned();
    texts.with("picture-not-opened", &[("name", name.into()), ("reason", reason.into())])
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use catoptric_scene::{Body, List, Material, MaterialChoice, Pattern, Phong, Surroundings};

    use super::*;

    fn textured(path: &str) -> Body {
        let material = Material::Phong(Phong {
            pattern: Pattern { texture: Some(Image::new(path)), ..Pattern::default() },
            ..Phong::default()
        });
        Body { material: MaterialChoice::Inline(Box::new(material)), ..Body::default() }
    }

    #[test]
    fn after_an_edit_its_neighbors_alone_are_looked_at() {
        let before =
            Scene { bodies: (0..100_000).map(|_| textured("old.png")).collect(), ..Scene::default() };
        let mut scene = before.clone();
        scene.bodies[70_000] = textured("new.png");
        scene.environment.surroundings = Surroundings::Picture(Image::new("around.png"));
        let looked_at = Cell::new(0);
        let is_missing = |source: &ImageSource| {
            looked_at.set(looked_at.get() + 1);
            source.path() == "old.png"
        };
        let expected = ["around.png", "new.png"].map(|path| ImageSource::new(path, None));
        assert_eq!(unopened(Some(&before), &scene, is_missing), expected);
        assert_eq!(looked_at.replace(0), List::<Body>::SLICE + 1);
        assert_eq!(unopened(None, &scene, is_missing), expected);
        assert_eq!(looked_at.get(), 100_001);
    }

    #[test]
    fn what_paths_have_led_to_holds_for_one_document_in_one_folder() {
        let (here, away) = (Some(Path::new("/here")), Some(Path::new("/away")));
        let mut images = DocumentImages::default();
        images.mind_home(0, here);
        let homes = [(0, here, true), (0, away, false), (0, None, false), (1, None, false), (1, None, true)];
        for (document, folder, is_same) in homes {
            images.looked_at = Some(Arc::default());
            images.missing.insert(ImageSource::new("a.png", None));
            images.job = Job::start(&Context::default(), "pictures", Vec::new).ok();
            images.mind_home(document, folder);
            let kept = (
                images.looked_at.is_some(),
                images.is_missing(&ImageSource::new("a.png", None)),
                images.is_opening(),
            );
            assert_eq!(kept, (is_same, is_same, is_same), "{document} {folder:?}");
        }
    }
}
