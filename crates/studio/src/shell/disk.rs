//! Reading and writing scene files, on threads of their own.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptric_editor::SceneWriter;
use catoptric_exchange::{ForeignFormat, ImportOptions};
use catoptric_platform::files::{self, FileStamp, WriteError};
use catoptric_platform::time::SystemTime;
use catoptric_scene::{Diagnostic, Diagnostics, LONGEST_TEXT, LoadedScene, Scene, Severity};
use catoptric_store::{LoadError, load_partly, save};
use fluent_bundle::FluentValue;

use crate::base::texts::Texts;

/// A scene file that was read, at least in part.
#[derive(Clone, Debug)]
pub(crate) struct OpenedScene {
    pub(crate) path: PathBuf,
    pub(crate) text: Arc<str>,
    pub(crate) scene: Scene,
    pub(crate) findings: Diagnostics,
    pub(crate) stamp: Option<FileStamp>,
    /// Whether it is a scene of another ray tracer: the document has no file yet.
    pub(crate) is_foreign: bool,
}

/// The reason why a file cannot be opened.
#[derive(Debug)]
pub(crate) enum ReadFailure {
    Missing,
    Denied,
    Folder,
    TooLong,
    /// Nothing in it is a scene; the first findings.
    Nothing(Vec<Diagnostic>),
    /// A scene of another ray tracer has errors.
    Foreign(ForeignRefusal),
    Other(String),
}

/// The errors of a scene of another ray tracer.
#[derive(Debug)]
pub(crate) struct ForeignRefusal {
    format: ForeignFormat,
    /// The first ones.
    errors: Vec<Diagnostic>,
    /// How many there are besides.
    more: usize,
    /// Whether it can be opened approximately.
    pub(crate) is_approximable: bool,
}

/// The most errors that are listed.
const MOST_ERRORS: usize = 3;

/// Reads the file at `path`; `options` are for scenes of other ray tracers.
pub(crate) fn read(path: &Path, options: ImportOptions) -> Result<OpenedScene, ReadFailure> {
    // Looked at before reading: what is written meanwhile counts as a change.
    let stamp = FileStamp::of(path);
    if let Some(format) = ForeignFormat::of_path(path) {
        return read_foreign(path, format, stamp, options);
    }
    let (reading, text) = load_partly(path).map_err(|error| read_failure(path, error))?;
    if reading.diagnostics.has_errors() && reading.scene == Scene::default() {
        return Err(ReadFailure::Nothing(reading.diagnostics.iter().take(MOST_ERRORS).cloned().collect()));
    }
    let (scene, findings) = (reading.scene, reading.diagnostics);
    Ok(OpenedScene { path: path.to_owned(), text: text.into(), scene, findings, stamp, is_foreign: false })
}

/// Reads a scene of another ray tracer, which must have no errors.
fn read_foreign(
    path: &Path,
    format: ForeignFormat,
    stamp: Option<FileStamp>,
    options: ImportOptions,
) -> Result<OpenedScene, ReadFailure> {
    let load = |options| catoptric_exchange::load(path, format, &options);
    match load(options) {
        Ok((LoadedScene { scene, text, warnings }, _)) => Ok(OpenedScene {
            path: path.to_owned(),
            text: text.into(),
            scene,
            findings: warnings,
            stamp,
            is_foreign: true,
        }),
        Err(LoadError::Diagnostics { diagnostics, .. }) => {
            let errors = diagnostics.iter().filter(|finding| finding.severity == Severity::Error);
            let count = errors.clone().count() + diagnostics.omitted();
            let errors: Vec<Diagnostic> = errors.take(MOST_ERRORS).cloned().collect();
            Err(ReadFailure::Foreign(ForeignRefusal {
                format,
                more: count.saturating_sub(errors.len()),
                errors,
                is_approximable: !options.is_approximate
                    && load(ImportOptions { is_approximate: true, ..options }).is_ok(),
            }))
        }
        Err(error) => Err(read_failure(path, error)),
    }
}

fn read_failure(path: &Path, error: LoadError) -> ReadFailure {
    let LoadError::Io { reason, source, .. } = error else { return ReadFailure::Other(error.to_string()) };
    match source.map(|source| source.kind()) {
        Some(io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) => ReadFailure::Missing,
        Some(io::ErrorKind::PermissionDenied) => ReadFailure::Denied,
        Some(io::ErrorKind::IsADirectory) => ReadFailure::Folder,
        None if files::is_folder(path) => ReadFailure::Folder,
        None => ReadFailure::TooLong,
        Some(_) => ReadFailure::Other(reason),
    }
}

impl ReadFailure {
    /// What is wrong and what to do.
    pub(crate) fn in_words(&self, texts: &Texts, path: &Path) -> String {
        let path = FluentValue::from(path.display().to_string());
        match self {
            Self::Missing => texts.with("read-missing", &[("path", path)]),
            Self::Denied => texts.with("read-denied", &[("path", path)]),
            Self::Folder => texts.with("read-folder", &[("path", path)]),
            Self::TooLong => {
                texts.with("read-too-long", &[("path", path), ("limit", (LONGEST_TEXT >> 20).into())])
            }
            Self::Nothing(found) => {
                texts.with("read-nothing", &[("path", path), ("found", lines(texts, found).into())])
            }
            Self::Foreign(refusal) => refusal.in_words(texts, path),
            Self::Other(reason) => {
                texts.with("read-other", &[("path", path), ("reason", reason.as_str().into())])
            }
        }
    }
}

/// Findings with their places, a line each.
fn lines(texts: &Texts, found: &[Diagnostic]) -> String {
    let language = texts.language().into();
    found.iter().map(|finding| finding.line_of_text(language)).collect::<Vec<_>>().join("\n")
}

impl ForeignRefusal {
    fn in_words(&self, texts: &Texts, path: FluentValue<'_>) -> String {
        let mut found = lines(texts, &self.errors);
        if self.more > 0 {
            found = format!("{found}\n{}", texts.with("read-more-errors", &[("number", self.more.into())]));
        }
        let key = if self.is_approximable { "read-foreign-approximable" } else { "read-foreign" };
        let format = self.format.name().into();
        texts.with(key, &[("path", path), ("format", format), ("found", found.into())])
    }
}

/// The condition on which a file may replace another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OverwriteRule {
    /// In any case.
    Replace,
    /// If there is none.
    Create,
    /// If it is still the one that was read or written last.
    Update(FileStamp),
    /// If nobody has written it since then.
    UpdateBefore(SystemTime),
}

impl OverwriteRule {
    fn allows(self, path: &Path) -> bool {
        let Some(found) = FileStamp::of(path) else { return true };
        match self {
            Self::Replace => true,
            Self::Create => false,
            Self::Update(stamp) => found == stamp,
            Self::UpdateBefore(time) => found.modified.is_none_or(|modified| modified <= time),
        }
    }
}

/// A file that was written.
#[derive(Debug)]
pub(crate) struct SavedFile {
    pub(crate) text: Arc<str>,
    pub(crate) stamp: Option<FileStamp>,
}

/// The reason why a file has not been written; the old one is untouched.
#[derive(Debug)]
pub(crate) enum WriteFailure {
    /// There is one already, or another one than before.
    Other,
    /// The file cannot be written.
    Cannot(WriteError),
}

/// Writes a document to the file at `path`, whole or not at all.
pub(crate) fn write(
    writing: &SceneWriter,
    path: &Path,
    may: OverwriteRule,
) -> Result<SavedFile, WriteFailure> {
    if !may.allows(path) {
        return Err(WriteFailure::Other);
    }
    let text = writing.text();
    save(path, &text).map_err(WriteFailure::Cannot)?;
    Ok(SavedFile { text: text.into(), stamp: FileStamp::of(path) })
}

/// What stands in the way of writing and what to do.
pub(crate) fn write_failure_in_words(texts: &Texts, error: &WriteError) -> String {
    let value = |path: &Path| FluentValue::from(path.display().to_string());
    match error {
        WriteError::NoName { path } => texts.with("write-no-name", &[("path", value(path))]),
        WriteError::IsDirectory { path } => texts.with("write-folder", &[("path", value(path))]),
        WriteError::NoDirectory { path, directory } => {
            texts.with("write-no-folder", &[("path", value(path)), ("folder", value(directory))])
        }
        WriteError::Closed { path, directory, .. } => {
            texts.with("write-closed", &[("path", value(path)), ("folder", value(directory))])
        }
        WriteError::Protected { path } => texts.with("write-protected", &[("path", value(path))]),
        WriteError::Circle { path } => texts.with("write-circle", &[("path", value(path))]),
        WriteError::NoDescriptor { path, .. } => texts.with("write-no-descriptor", &[("path", value(path))]),
        WriteError::ReaderGone { path } => texts.with("write-reader-gone", &[("path", value(path))]),
        WriteError::Io { path, source } => {
            let key = match source.kind() {
                io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "write-full",
                io::ErrorKind::PermissionDenied => "write-denied",
                _ => "write-other",
            };
            texts.with(key, &[("path", value(path)), ("reason", source.to_string().into())])
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use catoptric_editor::Editor;

    use super::*;

    #[test]
    fn a_file_changed_by_another_program_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        let writing = Editor::new(Scene::default()).writing();
        let written = write(&writing, &path, OverwriteRule::Create).unwrap();
        assert!(matches!(write(&writing, &path, OverwriteRule::Create), Err(WriteFailure::Other)));
        let stamp = written.stamp.unwrap();
        let again = write(&writing, &path, OverwriteRule::Update(stamp)).unwrap();
        fs::write(&path, "format = 'catoptric/1' # mine\n").unwrap();
        let update = OverwriteRule::Update(again.stamp.unwrap());
        assert!(matches!(write(&writing, &path, update), Err(WriteFailure::Other)));
        assert!(matches!(
            write(&writing, &path, OverwriteRule::UpdateBefore(SystemTime::UNIX_EPOCH)),
            Err(WriteFailure::Other)
        ));
        assert!(fs::read_to_string(&path).unwrap().ends_with("# mine\n"));
        write(&writing, &path, OverwriteRule::Replace).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), writing.text());
    }

    #[test]
    fn a_scene_of_another_ray_tracer_is_refused_with_its_errors() {
        let folder = tempfile::tempdir().unwrap();
        let texts = Texts::new(crate::base::texts::Language::English);
        let path = folder.path().join("a.rt");
        let scene = "A 0.2 255,255,255\nC 0,0,5 0,0,-1 70\nL 0,9,0 0.6 255,255,255\nsp 0,0,0 1 255,0,0\n";
        let refused = |text: &str, is_approximate| {
            fs::write(&path, text).unwrap();
            match read(&path, ImportOptions { is_approximate, ..ImportOptions::default() }) {
                Err(ReadFailure::Foreign(refusal)) => refusal,
                other => panic!("{other:?}"),
            }
        };
        let torus = format!("{scene}to 0,0,0 1,0,0 2 1 255,0,0\n");
        let refusal = refused(&torus, false);
        assert!(refusal.is_approximable);
        let words = refusal.in_words(&texts, "a.rt".into());
        for said in ["a.rt", "miniRT", "5:1: error: there is no element `to`", "pproximately"] {
            assert!(words.contains(said), "{said}: {words}");
        }
        let approximately = ImportOptions { is_approximate: true, ..ImportOptions::default() };
        let opened = read(&path, approximately).unwrap();
        assert!(opened.is_foreign && !opened.findings.has_errors());
        assert_eq!(opened.scene.bodies.len(), 1);
        // What nothing comes near to stays an error.
        for is_approximate in [false, true] {
            let refusal = refused("A 0.2 255,255,255\nC 0,0,5\nsp\nsp\nsp\n", is_approximate);
            assert!(!refusal.is_approximable && refusal.errors.len() == 3 && refusal.more > 0);
            assert!(refusal.in_words(&texts, "a.rt".into()).contains("more"));
        }
    }

    #[test]
    fn every_failure_has_words_in_every_language() {
        use crate::base::texts::Language;
        let path = Path::new("/a/b.toml");
        for language in Language::ALL {
            let texts = Texts::new(language);
            let failures = [
                ReadFailure::Missing,
                ReadFailure::Denied,
                ReadFailure::Folder,
                ReadFailure::TooLong,
                ReadFailure::Nothing(catoptric_scene::read("fov").diagnostics.iter().cloned().collect()),
                ReadFailure::Other("broken".to_owned()),
            ];
            let foreign = [true, false].map(|is_approximable| {
                ReadFailure::Foreign(ForeignRefusal {
                    format: ForeignFormat::MiniRt,
                    errors: catoptric_scene::read("fov").diagnostics.iter().cloned().collect(),
                    more: 2,
                    is_approximable,
                })
            });
            for failure in failures.into_iter().chain(foreign) {
                assert!(failure.in_words(&texts, path).contains("/a/b.toml"), "{failure:?}");
            }
            let path = || path.to_owned();
            let io = |kind: io::ErrorKind| WriteError::Io { path: path(), source: kind.into() };
            let directory = PathBuf::from("/a");
            let failures = [
                WriteError::NoName { path: path() },
                WriteError::IsDirectory { path: path() },
                WriteError::NoDirectory { path: path(), directory: directory.clone() },
                WriteError::Closed { path: path(), directory, source: io::ErrorKind::Other.into() },
                WriteError::Protected { path: path() },
                WriteError::Circle { path: path() },
                io(io::ErrorKind::StorageFull),
                io(io::ErrorKind::PermissionDenied),
                io(io::ErrorKind::Other),
            ];
            for failure in failures {
                assert!(write_failure_in_words(&texts, &failure).contains("/a/b.toml"), "{failure:?}");
            }
            assert_eq!(texts.missing(), Vec::<String>::new());
        }
    }
}
