//! The choice of pictures that the scene takes from files, and the taking up of those that were opened.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use catoptric_editor::Label;
use catoptric_scene::{Image, ImageSource, Surroundings};
use catoptric_store::path_from;
use egui::Context;

use crate::base::job::JobStatus;
use crate::panels::inspector;
use crate::shell::host::{FileKind, FileQuestion};
use crate::shell::studio::Studio;
use crate::shell::studio::file_prompt::{FilePrompt, FilePromptState};
use crate::state::images::{self, ImageUse};
use crate::state::refusal;

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
    studio.image_prompt = Some((prompt, usage, studio.documents.number()));
}

/// Takes up answers and pictures, and has those opened that are not: once a frame.
pub(crate) fn keep(context: &Context, studio: &mut Studio) {
    take_answer(context, studio);
    let folder = studio.editor.path().and_then(Path::parent);
    studio.images.mind_home(studio.documents.number(), folder);
    take_opened(studio);
    let sources = studio.images.take_unopened(studio.editor.scene());
    if sources.is_empty() {
        return;
    }
    let folder = studio.editor.path().and_then(Path::parent).map(Path::to_owned);
    if let Err(error) = studio.images.open(context, sources, folder) {
        studio.toasts.warning(error.to_string());
    }
}

fn take_opened(studio: &mut Studio) {
    let found = match studio.images.poll() {
        None | Some(JobStatus::Waiting) => return,
        Some(JobStatus::Done(found)) => found,
        Some(JobStatus::Lost) => {
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
                studio.toasts.warning(images::in_words(&studio.texts, &error));
                studio.images.add_missing(source);
            }
        }
    }
    if !opened.is_empty() {
        studio.editor.open_images(|source| opened.get(source).cloned());
    }
}

fn take_answer(context: &Context, studio: &mut Studio) {
    let Some((mut prompt, usage, document)) = studio.image_prompt.take() else { return };
    match prompt.poll(context, studio) {
        FilePromptState::Waiting => studio.image_prompt = Some((prompt, usage, document)),
        FilePromptState::Cancelled => {}
        // Another document has come while the system's dialog was open.
        FilePromptState::Chosen(_) if document != studio.documents.number() => {}
        FilePromptState::Chosen(chosen) => {
            let folder =
                studio.editor.path().and_then(Path::parent).map_or_else(PathBuf::new, Path::to_owned);
            give(studio, usage, &path_from(&folder, &chosen.path));
        }
    }
}

/// Has the picture at `path` used.
pub(crate) fn give(studio: &mut Studio, usage: ImageUse, path: &str) {
    let image = Image::new(path);
    studio.images.retry(image.source());
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
        studio.toasts.warning(refusal::of_change(&studio.texts, &refused));
    }
}
