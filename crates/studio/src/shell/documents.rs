//! Scene files: opening, saving, and never losing a change.
//!
//! Files are read and written by threads; what they bring is taken up in [`keep`], once a frame.

mod autosave;
mod banner;
mod close_guard;
mod dialect_dialog;
mod link;
mod new_scene;
mod open;
pub(crate) mod recent;
mod recover;
mod recovery_dialog;
mod save;
mod settings_file;
mod start;
mod watch;

use std::path::PathBuf;
use std::sync::Arc;

use catoptric_editor::Editor;
use catoptric_editor::navigate::CachedCameraRange;
use catoptric_picture::ToneCurve;
use catoptric_platform::time::SystemTime;
use catoptric_scene::{Example, write};
use egui::{Context, ViewportCommand};

use crate::base::example_texts::example_title;
use crate::base::job;
use crate::shell::disk::{OpenedScene, OverwriteRule};
use crate::shell::examples;
use crate::shell::host::{FileKind, FileQuestion};
use crate::shell::studio::Studio;
use crate::shell::studio::documents::{FilePurpose, NextDocument, SceneSaveRequest};
use crate::shell::studio::file_prompt::{self, ChosenFile, FilePrompt, FilePromptState};
use crate::state::command::FileCommand;
use crate::state::settings::LastScene;
pub(crate) use banner::{banner_ui, progress_ui};
use dialect_dialog::DialectDialog;
pub(crate) use start::start;

/// From this number of bodies on, a scene counts as large.
const MANY: usize = 10_000;

/// Takes up what threads have done, keeps unsaved work and settings, minds the window's title: once a frame.
pub(crate) fn keep(context: &Context, studio: &mut Studio) {
    take_answer(context, studio);
    open::poll(context, studio);
    save::poll(context, studio);
    link::poll(context, studio);
    open::take_dropped(context, studio);
    close_guard::mind_close(context, studio);
    recover::poll(context, studio);
    watch::keep(context, studio);
    autosave::keep(context, studio);
    settings_file::keep(context, studio);
    recent::keep(context, studio);
    show_title(context, studio);
}

/// Does a command about the document as a whole.
pub(crate) fn run(context: &Context, studio: &mut Studio, act: FileCommand) {
    studio.editor.settle();
    match act {
        FileCommand::New => close_guard::replace(context, studio, NextDocument::New),
        FileCommand::Open => ask_for(studio, FilePurpose::Opening),
        FileCommand::OpenFile(path) => open::begin(context, studio, &path),
        FileCommand::OpenExample(name) => {
            if let Some(example) = Example::find(name) {
                close_guard::replace(context, studio, NextDocument::Example(example));
            }
        }
        FileCommand::ReadOtherwise => {
            let dialog = DialectDialog::new(studio);
            studio.dialogs.open(dialog);
        }
        FileCommand::Revert => open::revert(context, studio),
        FileCommand::Save => save::save(context, studio, None),
        FileCommand::SaveAs => save_as(studio, None),
        FileCommand::CopyLink => link::copy(studio),
        FileCommand::Quit => close_guard::replace(context, studio, NextDocument::Quit),
        FileCommand::Examples => examples::open(studio),
    }
}

/// The studio is being left.
pub(crate) fn leave(studio: &mut Studio) {
    settings_file::finish(studio);
    autosave::finish(studio);
}

/// Whether the studio is being left on purpose.
pub(crate) fn is_leaving(studio: &Studio) -> bool {
    studio.documents.is_leaving
}

/// The window is lost, and another one will be opened: first of all, unsaved work is made safe.
pub(crate) fn outlive_window(studio: &mut Studio) {
    autosave::keep_now(studio);
    // The new window does not have it yet.
    studio.documents.title.clear();
}

/// Whether the document has work that no file has. Cheap, unlike [`Editor::has_unsaved_work`] in a large scene.
pub(crate) fn has_unsaved_work(studio: &mut Studio) -> bool {
    let documents = &mut studio.documents;
    let state = (documents.number, documents.saves, studio.editor.revision());
    match documents.unsaved {
        Some((known, is_unsaved)) if known == state => is_unsaved,
        _ => {
            let is_unsaved = studio.editor.has_unsaved_work();
            documents.unsaved = Some((state, is_unsaved));
            is_unsaved
        }
    }
}

/// Whether all work is in a file, or kept to be offered at the next start.
pub(crate) fn is_kept(studio: &mut Studio) -> bool {
    let state = (studio.documents.number, studio.editor.revision());
    !has_unsaved_work(studio) || studio.documents.autosave.kept == Some(state)
}

/// What to call the document, in the present language.
pub(crate) fn name(studio: &Studio) -> String {
    let title = studio.editor.title();
    match (studio.editor.path(), studio.documents.example) {
        (None, Some(example)) => example_title(example, studio.texts.language()).to_owned(),
        _ if title.is_empty() => studio.texts.get("document-untitled").to_owned(),
        _ => title.to_owned(),
    }
}

/// Puts another document into the window.
fn show(studio: &mut Studio, editor: Editor) {
    let editor = editor.succeeding(&studio.editor);
    // It shares the bodies, which are freed elsewhere.
    studio.view.range = CachedCameraRange::default();
    let before = std::mem::replace(&mut studio.editor, editor);
    studio.panes.outliner.stop_renaming();
    studio.panes.viewport.begin_document(studio.editor.revision());
    studio.panes.inspector.begin_document();
    if before.scene().bodies.len() > MANY {
        // Freeing it takes longer than a frame.
        job::let_go(before);
    }
    let documents = &mut studio.documents;
    documents.number += 1;
    documents.may = None;
    documents.text_on_disk = None;
    documents.is_partial = false;
    documents.example = None;
    if let Some(before) = documents.tone_before.take()
        && studio.view.development.tone_curve == ToneCurve::LinearCodes
    {
        studio.view.development.tone_curve = before;
    }
    studio.view.free_camera = None;
    studio.audit.release();
    studio.view.is_flying = false;
    studio.view.hovered_body = None;
    banner::clear_findings(studio);
}

fn show_fresh(studio: &mut Studio) {
    let scene = new_scene::fresh_scene(&studio.texts);
    show(studio, Editor::new(scene));
    studio.settings.last = None;
}

fn show_example(studio: &mut Studio, example: &'static Example) {
    // Every example can be read; a test sees to it.
    let Ok(loaded) = example.load() else { return };
    show(studio, Editor::untitled(example.name, loaded.text, loaded.scene));
    studio.documents.example = Some(example);
    studio.settings.last = Some(LastScene::Example(example.name.to_owned()));
}

fn show_opened(studio: &mut Studio, opened: OpenedScene) {
    let OpenedScene { path, text, scene, findings, stamp, is_foreign } = opened;
    if is_foreign {
        // Saving writes another file, in the format of this program.
        let title = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        show(studio, Editor::untitled(title, write(&scene), scene));
        studio.editor.mark_unsaved();
        // Such programs write light as codes.
        let curve = &mut studio.view.development.tone_curve;
        studio.documents.tone_before = Some(std::mem::replace(curve, ToneCurve::LinearCodes));
        studio.settings.remember_recent(&path);
        studio.settings.last = Some(LastScene::File(path));
        banner::show_findings(studio, text, findings);
        return;
    }
    show(studio, Editor::open(path.clone(), text.clone(), scene));
    studio.documents.may = stamp.map(OverwriteRule::Update);
    studio.documents.text_on_disk = Some(Arc::clone(&text));
    studio.documents.is_partial = findings.has_errors();
    studio.settings.remember_recent(&path);
    studio.settings.last = Some(LastScene::File(path));
    banner::show_findings(studio, text, findings);
}

/// Shows an unsaved document that was left behind.
fn show_recovered(studio: &mut Studio, editor: Editor, written: SystemTime) {
    show(studio, editor);
    studio.editor.mark_unsaved();
    studio.documents.may = Some(OverwriteRule::UpdateBefore(written));
    if let Some(path) = studio.editor.path() {
        studio.settings.last = Some(LastScene::File(path.to_owned()));
    }
}

fn ask_for(studio: &mut Studio, purpose: FilePurpose) {
    if studio.documents.prompt.is_some() {
        return;
    }
    let is_saving = matches!(purpose, FilePurpose::Saving(..));
    let key = if is_saving { "ask-save-as" } else { "ask-open" };
    let question = FileQuestion {
        kind: if is_saving { FileKind::Scene } else { FileKind::ReadScene },
        is_saving,
        title: studio.texts.get(key).to_owned(),
        folder: usual_folder(studio),
        name: if is_saving { usual_name(studio) } else { String::new() },
    };
    let prompt = FilePrompt::start(studio, question);
    studio.documents.prompt = Some((prompt, purpose));
}

/// Asks for a file and saves the document to it; then does what was meant to come after.
pub(crate) fn save_as(studio: &mut Studio, then: Option<NextDocument>) {
    ask_for(studio, FilePurpose::Saving(studio.documents.number, then));
}

/// Where scenes are: beside the document, or where the last one was.
fn usual_folder(studio: &Studio) -> Option<PathBuf> {
    let last = || studio.settings.recent.first().map(PathBuf::as_path);
    let beside = studio.editor.path().or_else(last).and_then(std::path::Path::parent);
    beside.map(PathBuf::from).or_else(|| studio.host.home_folder())
}

fn usual_name(studio: &Studio) -> String {
    let title = studio.editor.title();
    let title = if title.is_empty() { studio.texts.get("document-file-name") } else { title };
    file_prompt::with_extension(PathBuf::from(title), FileKind::Scene).to_string_lossy().into_owned()
}

fn take_answer(context: &Context, studio: &mut Studio) {
    let Some((mut prompt, purpose)) = studio.documents.prompt.take() else { return };
    match (prompt.poll(context, studio), purpose) {
        (FilePromptState::Waiting, purpose) => studio.documents.prompt = Some((prompt, purpose)),
        (FilePromptState::Cancelled, _) => {}
        (FilePromptState::Chosen(ChosenFile { path, .. }), FilePurpose::Opening) => {
            open::begin(context, studio, &path);
        }
        // Another document has come while the system's dialog was open.
        (FilePromptState::Chosen(_), FilePurpose::Saving(number, _)) if number != studio.documents.number => {
        }
        (FilePromptState::Chosen(ChosenFile { path, may_replace }), FilePurpose::Saving(_, then)) => {
            let may = if may_replace { OverwriteRule::Replace } else { OverwriteRule::Create };
            // Its own file is known; only a change by another program matters.
            let is_own = studio.editor.path() == Some(path.as_path());
            let may = if is_own && !may_replace { studio.documents.may.unwrap_or(may) } else { may };
            save::order(context, studio, SceneSaveRequest { path, may, then });
        }
    }
}

fn show_title(context: &Context, studio: &mut Studio) {
    let name = name(studio);
    let key = if has_unsaved_work(studio) { "window-title-changed" } else { "window-title" };
    let title = studio.texts.with(key, &[("name", name.into())]);
    context.accesskit_node_builder(egui::accesskit_root_id(), |window| window.set_label(title.as_str()));
    if title != studio.documents.title {
        context.send_viewport_cmd(ViewportCommand::Title(title.clone()));
        studio.documents.title = title;
    }
}
