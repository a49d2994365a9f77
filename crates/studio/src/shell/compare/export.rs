//! Files of the comparison: its report, and pictures to be compared.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptric_lab::Machine;
use catoptric_lab::report::{Language, PageSettings, page};
use catoptric_picture::Development;
use egui::Context;

use crate::base::words::plain_name;
use crate::panels::compare::{CompareResult, CompareState};
use crate::shell::exports;
use crate::shell::host::{FileKind, FileQuestion};
use crate::shell::studio::Studio;
use crate::shell::studio::exports::{Export, ExportFailure};
use crate::shell::studio::file_prompt::{FilePrompt, FilePromptState};
use crate::state::methods::report_language;

/// The report of a comparison, for export.
struct CompareExport {
    found: Arc<CompareResult>,
    language: Language,
    development: Development,
}

/// Asks for a picture file for one of the sides.
pub(crate) fn ask_for_picture(studio: &mut Studio, side: usize) {
    let question = FileQuestion {
        kind: FileKind::Picture,
        is_saving: false,
        title: studio.texts.get("compare-open-title").to_owned(),
        folder: studio.settings.render.folder.clone(),
        name: String::new(),
    };
    studio.compare_prompt = Some((FilePrompt::start(studio, question), side));
}

/// Asks where to save the report.
pub(crate) fn ask_to_save(studio: &mut Studio) {
    let Some(found) = studio.panes.compare.found.clone() else { return };
    let report = CompareExport {
        found,
        language: report_language(&studio.texts),
        development: studio.view.development,
    };
    let stem = plain_name(&report.found.name);
    let question = FileQuestion {
        kind: FileKind::Page,
        is_saving: true,
        title: studio.texts.get("compare-save-title").to_owned(),
        folder: studio.settings.render.folder.clone(),
        name: format!("{stem}-{}.html", studio.texts.get("compare-file-name")),
    };
    exports::ask(studio, question, report);
}

/// Takes up the choice of a picture file; once a frame.
pub(crate) fn poll(context: &Context, studio: &mut Studio) {
    let Some((mut prompt, side)) = studio.compare_prompt.take() else { return };
    match prompt.poll(context, studio) {
        FilePromptState::Waiting => studio.compare_prompt = Some((prompt, side)),
        FilePromptState::Cancelled => {}
        FilePromptState::Chosen(chosen) => take_picture(&mut studio.panes.compare, side, chosen.path),
    }
}

fn take_picture(comparing: &mut CompareState, side: usize, path: PathBuf) {
    if let Some(side) = comparing.sides.get_mut(side) {
        side.file = Some(path);
    }
    // A file of the same name may be another one by now.
    (comparing.found, comparing.failed) = (None, None);
}

impl Export for CompareExport {
    fn write(&self, path: &Path) -> Result<(), ExportFailure> {
        let html = self.page().map_err(ExportFailure::Content)?;
        catoptric_platform::files::write_bytes(path, html.as_bytes()).map_err(ExportFailure::Write)
    }
}

impl CompareExport {
    /// The page of `catoptric compare`.
    fn page(&self) -> Result<String, String> {
        let found = &*self.found;
        let is_drawn = found.key.view.is_some();
        let scene = is_drawn.then_some(&found.scene);
        let settings = PageSettings {
            scene: is_drawn.then(|| found.name.clone()),
            bodies_and_lights: scene.map(|scene| [scene.bodies.len(), scene.lights.len()]),
            samples: is_drawn.then_some(1),
            generations: scene.map(|scene| scene.tracing.generations),
            threads: found.threads,
            development: self.development,
            language: self.language,
        };
        page(&found.compared, &Machine::here(), &settings).map_err(|error| error.to_string())
    }
}
