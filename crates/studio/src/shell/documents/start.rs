//! The document at the start.

use std::path::{Path, PathBuf};

use catoptric_platform::files;
use catoptric_scene::Example;
use catoptric_tracer::raster::MethodKind;
use egui::Context;

use super::{link, open, show_example, show_fresh, show_opened};
use crate::shell::disk::{self, ReadFailure};
use crate::shell::interruption::Interruption;
use crate::shell::studio::autosave::Autosave;
use crate::shell::studio::documents::{Documents, SettingsFile};
use crate::shell::studio::{StartDocument, Studio};
use crate::state::settings::LastScene;

/// The example shown at the very first start.
const FIRST: &str = "four-bodies";

/// Files up to so many bytes are read before the window appears, longer ones behind it.
const SHORT: u64 = 1 << 21;

/// Opens the scene to start with, and looks for unsaved work of an earlier time.
pub(crate) fn start(
    context: &Context,
    studio: &mut Studio,
    start: &StartDocument,
    interruption: Option<Interruption>,
) {
    let memory = SettingsFile::of(&studio.settings);
    studio.documents = Documents { memory, interruption, ..Documents::default() };
    if let Some(folder) = studio.host.recovery_folder() {
        studio.documents.autosave = Autosave::start(context, folder);
    }
    if *start != StartDocument::Last {
        studio.first_steps.hold_back();
    }
    match start {
        StartDocument::Example(name) => {
            // Its author meant it traced.
            studio.settings.methods.choose(MethodKind::Whitted);
            show_named(studio, name);
        }
        StartDocument::Link(view) => {
            if !link::open(studio, view) {
                show_named(studio, FIRST);
            }
        }
        StartDocument::File(path) => show_file(context, studio, path, false),
        StartDocument::Last => match studio.settings.last.clone() {
            Some(LastScene::File(path)) => show_file(context, studio, &path, true),
            Some(LastScene::Example(name)) => show_named(studio, &name),
            None => show_named(studio, FIRST),
        },
    }
}

fn show_named(studio: &mut Studio, name: &str) {
    match Example::find(name).or_else(|| Example::find(FIRST)) {
        Some(example) => show_example(studio, example),
        None => show_fresh(studio),
    }
}

/// Shows the file at `path`. If it cannot be read, the first example is shown with the reason.
fn show_file(context: &Context, studio: &mut Studio, path: &Path, is_last: bool) {
    let path: PathBuf = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    match files::status(&path) {
        Ok(found) if found.is_file && found.length > SHORT => {
            show_fresh(studio);
            studio.settings.last = Some(LastScene::File(path.clone()));
            open::begin(context, studio, &path);
        }
        _ => match disk::read(&path, studio.settings.import_options()) {
            Ok(opened) => show_opened(studio, opened),
            Err(failure) => {
                show_named(studio, FIRST);
                if is_last && matches!(failure, ReadFailure::Missing) {
                    // It was probably removed on purpose.
                    studio.settings.recent.retain(|recent| *recent != path);
                    let text = failure.in_words(&studio.texts, &path);
                    studio.toasts.info(text);
                } else {
                    open::failed(studio, &path, &failure);
                }
            }
        },
    }
}
