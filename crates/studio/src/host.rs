//! What the studio needs from the system around it, behind a trait, so that tests can stand in for it.

#[cfg(target_os = "linux")]
use std::path::Path;
use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver};

/// What kind of file a person chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A scene: `.toml`.
    Scene,
    /// A picture: `.png` or `.exr`.
    Picture,
}

impl FileKind {
    /// The usual extensions, the first one for new files.
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Scene => &["toml"],
            Self::Picture => &["png", "exr"],
        }
    }
}

/// A question for a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileQuestion {
    /// What kind of file.
    pub kind: FileKind,
    /// Whether the file is to be written.
    pub is_saving: bool,
    /// The title of the dialog.
    pub title: String,
    /// The folder to start in.
    pub folder: Option<PathBuf>,
    /// The name to start with.
    pub name: String,
}

/// The answer to come; `None` when the person cancelled.
pub type FileAnswer = Receiver<Option<PathBuf>>;

/// The system around the studio.
pub trait Host {
    /// Asks for a file without blocking; `None` when the system has no dialog of its own, and the studio's must do.
    fn ask_file(&mut self, question: &FileQuestion) -> Option<FileAnswer>;

    /// The file of the settings, if there is a place for it.
    fn settings_path(&self) -> Option<PathBuf>;

    /// The folder for unsaved work, if there is a place for it.
    fn recovery_folder(&self) -> Option<PathBuf>;
}

/// The desktop.
#[derive(Debug, Default)]
pub struct Desktop;

impl Host for Desktop {
    fn ask_file(&mut self, question: &FileQuestion) -> Option<FileAnswer> {
        if !has_native_dialogs() {
            return None;
        }
        let (sender, answer) = mpsc::channel();
        let question = question.clone();
        std::thread::Builder::new()
            .name("file dialog".to_owned())
            .spawn(move || {
                // The studio may be gone by the time of the answer.
                let _ = sender.send(native_dialog(&question));
            })
            .ok()?;
        Some(answer)
    }

    fn settings_path(&self) -> Option<PathBuf> {
        use etcetera::AppStrategy as _;
        Some(strategy()?.config_dir().join("settings.json"))
    }

    fn recovery_folder(&self) -> Option<PathBuf> {
        use etcetera::AppStrategy as _;
        let strategy = strategy()?;
        Some(strategy.state_dir().unwrap_or_else(|| strategy.data_dir()).join("recovery"))
    }
}

fn strategy() -> Option<impl etcetera::AppStrategy> {
    etcetera::choose_app_strategy(etcetera::AppStrategyArgs {
        top_level_domain: "org".to_owned(),
        author: "Catoptric".to_owned(),
        app_name: "catoptric".to_owned(),
    })
    .ok()
}

fn native_dialog(question: &FileQuestion) -> Option<PathBuf> {
    let mut dialog = rfd::FileDialog::new().set_title(&question.title);
    for extension in question.kind.extensions() {
        dialog = dialog.add_filter(extension.to_uppercase(), &[*extension]);
    }
    if let Some(folder) = &question.folder {
        dialog = dialog.set_directory(folder);
    }
    if question.is_saving { dialog.set_file_name(&question.name).save_file() } else { dialog.pick_file() }
}

/// Whether a native dialog can appear. On Linux without a desktop portal and without zenity, it would look as if the
/// person had cancelled.
#[cfg(target_os = "linux")]
fn has_native_dialogs() -> bool {
    let has_bus = std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some()
        || std::env::var_os("XDG_RUNTIME_DIR").is_some_and(|folder| Path::new(&folder).join("bus").exists());
    let portals = ["/usr/libexec/xdg-desktop-portal", "/usr/lib/xdg-desktop-portal"];
    let has_portal = portals.iter().any(|path| Path::new(path).exists());
    let has_zenity = std::env::var_os("PATH")
        .is_some_and(|paths| std::env::split_paths(&paths).any(|folder| folder.join("zenity").exists()));
    has_bus && (has_portal || has_zenity)
}

#[cfg(not(target_os = "linux"))]
fn has_native_dialogs() -> bool {
    true
}
