//! Pictures that the scene takes from files: chosen by a person, opened by a thread.
//!
//! The document has their paths; whatever is not opened yet, by an edit, a paste or an undo, is opened here.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use catoptric_editor::Label;
use catoptric_scene::{Image, ImageError, ImageFault, Surroundings};
use egui::Context;

use crate::app::Studio;
use crate::documents::ask::{Answer, Asking, name_of};
use crate::documents::job::{Job, Progress};
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

/// What is known of the document's pictures.
#[derive(Default)]
pub(crate) struct Images {
    /// Document and revision that were looked through last.
    looked_at: Option<(u64, u64)>,
    /// What was opened for this document, by path; those that could not be opened are `None`.
    opened: HashMap<String, Option<Image>>,
    job: Option<Job<Vec<Opened>>>,
    asking: Option<(Asking, ImageUse)>,
}

type Opened = (String, Result<Image, ImageError>);

impl Images {
    /// Whether the picture at `path` could not be opened.
    pub(crate) fn is_missing(&self, path: &str) -> bool {
        matches!(self.opened.get(path), Some(None))
    }

    /// Whether any picture is being opened.
    pub(crate) fn is_opening(&self) -> bool {
        self.job.is_some()
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
    studio.images.asking = Some((Asking::start(studio, question), usage));
}

/// Takes up answers and pictures, and has those opened that are not: once a frame.
pub(crate) fn keep(context: &Context, studio: &mut Studio) {
    take_answer(context, studio);
    take_opened(studio);
    let document = studio.documents.number();
    let now = (document, studio.editor.revision());
    if studio.images.looked_at == Some(now) || studio.images.is_opening() {
        return;
    }
    if studio.images.looked_at.is_some_and(|(before, _)| before != document) {
        studio.images.opened.clear();
    }
    studio.images.looked_at = Some(now);
    let opened = &studio.images.opened;
    if studio.editor.open_images(|path| opened.get(path).cloned().flatten()) {
        studio.images.looked_at = Some((document, studio.editor.revision()));
    }
    let unknown = |image: &&Image| image.pixels().is_none() && !opened.contains_key(image.path());
    let mut paths: Vec<String> =
        studio.editor.scene().images().filter(unknown).map(|image| image.path().to_owned()).collect();
    paths.sort_unstable();
    paths.dedup();
    if !paths.is_empty() {
        open(context, studio, paths);
    }
}

fn open(context: &Context, studio: &mut Studio, paths: Vec<String>) {
    let folder = studio.editor.path().and_then(Path::parent).map(Path::to_owned);
    let work = move || {
        let open = |path: String| {
            let image = Image::open(&path, folder.as_deref());
            (path, image)
        };
        paths.into_iter().map(open).collect()
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
        Progress::Waiting => {
            studio.images.job = Some(job);
            return;
        }
        Progress::Done(found) => found,
        Progress::Lost => Vec::new(),
    };
    for (path, image) in found {
        if let Err(error) = &image {
            studio.toasts.warning(in_words(&studio.texts, error));
        }
        studio.images.opened.insert(path, image.ok());
    }
    studio.images.looked_at = None;
}

fn take_answer(context: &Context, studio: &mut Studio) {
    let Some((mut asking, usage)) = studio.images.asking.take() else { return };
    match asking.poll(context, studio) {
        Answer::Waiting => studio.images.asking = Some((asking, usage)),
        Answer::Cancelled => {}
        Answer::Chosen(chosen) => {
            let folder =
                studio.editor.path().and_then(Path::parent).map_or_else(PathBuf::new, Path::to_owned);
            give(studio, usage, &Image::path_from(&folder, &chosen.path));
        }
    }
}

/// Has the picture at `path` used.
pub(crate) fn give(studio: &mut Studio, usage: ImageUse, path: &str) {
    // What could not be opened before may have been mended.
    studio.images.opened.retain(|known, image| known != path || image.is_some());
    studio.images.looked_at = None;
    studio.editor.settle();
    let image = Image::new(path);
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
        studio.toasts.warning(refused.to_string());
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
        ImageFault::Missing(file) => {
            texts.with("picture-missing", &[("path", file.display().to_string().into())])
        }
        ImageFault::TooLarge { width, height } => {
            texts.with("picture-too-large", &[("size", format!("{width}×{height}").into())])
        }
        ImageFault::Unreadable(reason) => reason.clone(),
    };
    let name = name(texts, &error.path).into_owned();
    texts.with("picture-not-opened", &[("name", name.into()), ("reason", reason.into())])
}
