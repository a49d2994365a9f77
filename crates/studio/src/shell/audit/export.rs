//! Saving the tree of an audit as a drawing.

use std::path::Path;
use std::sync::Arc;

use catoptric_lab::audit::Audit;

use crate::shell::exports;
use crate::shell::host::{FileKind, FileQuestion};
use crate::shell::studio::Studio;
use crate::shell::studio::exports::{Export, ExportFailure};

/// Asks for a file.
pub(super) fn ask(studio: &mut Studio, audit: Arc<Audit>) {
    let stem = studio.editor.path().and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
    let stem = stem.unwrap_or_else(|| studio.texts.get("audit-file").to_owned());
    let question = FileQuestion {
        kind: FileKind::Drawing,
        is_saving: true,
        title: studio.texts.get("audit-save-title").to_owned(),
        folder: studio.settings.render.folder.clone(),
        name: format!("{stem}-{}-{}.svg", audit.pixel.x, audit.pixel.y),
    };
    exports::ask(studio, question, TreeDrawingExport(audit));
}

struct TreeDrawingExport(Arc<Audit>);

impl Export for TreeDrawingExport {
    fn write(&self, path: &Path) -> Result<(), ExportFailure> {
        catoptric_platform::files::write_bytes(path, self.0.to_svg(None).as_bytes())
            .map_err(ExportFailure::Write)
    }
}
