//! Pictures that the scene takes from files: chosen by a person, opened by a thread.
//!
//! The document has their paths; whatever is not opened yet, by an edit, a paste or an undo, is opened here.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptric_editor::Label;
use catoptric_scene::{Image, ImageError, ImageFault, ImageSource, Scene, Surroundings};
use egui::Context;

use crate::app::Studio;
use crate::documents::file_prompt::{FilePrompt, FilePromptState, name_of};
use crate::documents::job::{Job, JobStatus, let_go};
use crate::host::{FileKind, FileQuestion};
use crate::inspector;
use crate::texts::Texts;

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
    /// What is being asked for, with the document that is to have it.
    prompt: Option<(FilePrompt, ImageUse, u64)>,
}

type OpenedImage = (ImageSource, Result<Image, ImageError>);

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
    fn mind_home(&mut self, document: u64, folder: Option<&Path>) {
        let is_home =
            |(number, home): &(u64, Option<PathBuf>)| *number == document && home.as_deref() == folder;
        if !self.home.as_ref().is_some_and(is_home) {
            self.home = Some((document, folder.map(Path::to_owned)));
            self.missing.clear();
            self.look_anew();
        }
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

/// Asks for a picture.
pub(crate) fn ask(studio: &mut Studio, usage: ImageUse) {
    let path = studio.editor.path().map(Path::to_owned);
    let question = FileQuestion {
        kind: FileKind::Picture,
        is_saving: false,
        title: studio.texts.get("choose-picture").to_owned(),
        folder: path.as_deref().and_then(Path::parent).map(Path::to_owned),
        name: String::new(),
    };
    let prompt = FilePrompt::start(studio, question);
    studio.images.prompt = Some((prompt, usage, studio.documents.number()));
}

/// Takes up answers and pictures, and has those opened that are not: once a frame.
pub(crate) fn keep(context: &Context, studio: &mut Studio) {
    take_answer(context, studio);
    let folder = studio.editor.path().and_then(Path::parent);
    studio.images.mind_home(studio.documents.number(), folder);
    take_opened(studio);
    let scene = studio.editor.scene();
    let images = &mut studio.images;
    if images.is_opening() || images.looked_at.as_ref().is_some_and(|before| Arc::ptr_eq(before, scene)) {
        return;
    }
    let sources = unopened(images.looked_at.as_deref(), scene, |source| images.missing.contains(source));
    images.looked_at = Some(Arc::clone(scene));
    if !sources.is_empty() {
        open(context, studio, sources);
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

fn open(context: &Context, studio: &mut Studio, sources: Vec<ImageSource>) {
    let folder = studio.editor.path().and_then(Path::parent).map(Path::to_owned);
    let work = move || {
        let open = |source: ImageSource| {
            let image = Image::open_source(&source, folder.as_deref());
            (source, image)
        };
        sources.into_iter().map(open).collect()
    };
    match Job::start(context, "pictures", work) {
        Ok(job) => studio.images.job = Some(job),
        Err(error) => {
            studio.toasts.warning(error.to_string());
        }
    }
}

fn take_opened(studio: &mut Studio) {
    let Some(job) = studio.images.job.take() else { return };
    let found = match job.poll() {
        JobStatus::Waiting => {
            studio.images.job = Some(job);
            return;
        }
        JobStatus::Done(found) => found,
        JobStatus::Lost => {
            let text = studio.texts.get("fault").to_owned();
            studio.toasts.error(text);
            return;
        }
    };
    let mut opened: HashMap<ImageSource, Image> = HashMap::new();
    for (source, image) in found {
        match image {
            Ok(image) => _ = opened.insert(source, image),
            Err(error) => {
                studio.toasts.warning(in_words(&studio.texts, &error));
                studio.images.missing.insert(source);
            }
        }
    }
    if !opened.is_empty() {
        studio.editor.open_images(|source| opened.get(source).cloned());
    }
}

fn take_answer(context: &Context, studio: &mut Studio) {
    let Some((mut prompt, usage, document)) = studio.images.prompt.take() else { return };
    match prompt.poll(context, studio) {
        FilePromptState::Waiting => studio.images.prompt = Some((prompt, usage, document)),
        FilePromptState::Cancelled => {}
        // Another document has come while the system's dialog was open.
        FilePromptState::Chosen(_) if document != studio.documents.number() => {}
        FilePromptState::Chosen(chosen) => {
            let folder =
                studio.editor.path().and_then(Path::parent).map_or_else(PathBuf::new, Path::to_owned);
            give(studio, usage, &Image::path_from(&folder, &chosen.path));
        }
    }
}

/// Has the picture at `path` used.
pub(crate) fn give(studio: &mut Studio, usage: ImageUse, path: &str) {
    // What could not be opened before may have been mended, and what is being opened may have been replaced.
    let image = Image::new(path);
    studio.images.missing.remove(image.source());
    studio.images.look_anew();
    studio.editor.settle();
    let result = match usage {
        ImageUse::Surroundings => {
            let label = Label::new("edit-surroundings", String::new());
            let change = |environment: &mut catoptric_scene::Environment| {
                environment.surroundings = Surroundings::Picture(image);
            };
            studio.editor.change_environment(label, change)
        }
        ImageUse::Texture => inspector::give_texture(&mut studio.editor, &studio.texts, &image),
    };
    studio.editor.settle();
    if let Err(refused) = result {
        studio.toasts.warning(inspector::explain(&studio.texts, &refused));
    }
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

fn in_words(texts: &Texts, error: &ImageError) -> String {
    let reason = match &error.fault {
        ImageFault::NotBuiltIn => texts.get("picture-not-built-in").to_owned(),
        ImageFault::BuiltInLayer => texts.get("picture-built-in-layer").to_owned(),
        ImageFault::NotAFile => texts.get("picture-not-a-file").to_owned(),
        ImageFault::Missing(file) => {
            texts.with("picture-missing", &[("path", file.display().to_string().into())])
        }
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

    use catoptric_scene::{Body, List, Material, MaterialChoice, Pattern, Phong};

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
