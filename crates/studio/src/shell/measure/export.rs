//! Saving what was measured: a folder with report, plots and tables.

use std::path::Path;
use std::sync::Arc;

use catoptric_lab::measure::Measurement;
use catoptric_lab::report::{Language, study};

use crate::base::words::plain_name;
use crate::shell::exports;
use crate::shell::host::{FileKind, FileQuestion};
use crate::shell::studio::Studio;
use crate::shell::studio::exports::{Export, ExportFailure};
use crate::state::methods::report_language;

/// Asks for a folder.
pub(super) fn ask(studio: &mut Studio) {
    let measuring = &studio.panes.measure;
    let Some(measured) = measuring.measured.clone().filter(|_| measuring.is_measured()) else { return };
    let parameters: Vec<String> = measured.axes.iter().map(|axis| axis.variable.to_string()).collect();
    let question = FileQuestion {
        kind: FileKind::Folder,
        is_saving: true,
        title: studio.texts.get("measure-save-title").to_owned(),
        folder: studio.settings.render.folder.clone(),
        name: format!("{}-{}", plain_name(&measured.name), parameters.join("-")),
    };
    let language = report_language(&studio.texts);
    exports::ask(studio, question, MeasurementExport { measured, language });
}

struct MeasurementExport {
    measured: Arc<Measurement>,
    language: Language,
}

impl Export for MeasurementExport {
    fn write(&self, path: &Path) -> Result<(), ExportFailure> {
        let study = study(&self.measured, self.language)
            .map_err(|error| ExportFailure::Content(error.to_string()))?;
        catoptric_platform::files::create_folders(path).map_err(ExportFailure::Folder)?;
        for (name, bytes) in &study.files {
            catoptric_platform::files::write_bytes(&path.join(name), bytes).map_err(ExportFailure::Write)?;
        }
        Ok(())
    }

    fn landmark(&self) -> Option<&'static str> {
        Some("report.md")
    }
}
