//! The services of the system, behind a trait, so that tests can replace them.

#[cfg(target_os = "linux")]
use std::path::Path;
use std::path::PathBuf;
use std::pin::Pin;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver};
use std::task::{Context, Poll, Wake, Waker};
use std::thread::Thread;
use std::time::{Duration, Instant};

use catoptric_exchange::ForeignFormat;
use catoptric_picture::PictureFormat;

/// A dialog that is gone within this has not been seen.
const FASTEST: Duration = Duration::from_millis(250);

/// The kind of file that a person chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A scene to be written: `.toml`.
    Scene,
    /// A scene to be read: `.toml`, or one of another ray tracer.
    ReadScene,
    /// A picture of any format that is read.
    Picture,
    /// A picture to be written.
    SavedPicture,
    /// A drawing: `.svg`.
    Drawing,
    /// A page: `.html`.
    Page,
    /// A folder to be made, for several files.
    Folder,
}

impl FileKind {
    /// The usual extensions, the first one for new files.
    pub fn extensions(self) -> Vec<&'static str> {
        match self {
            Self::Scene => vec!["toml"],
            Self::ReadScene => {
                let foreign = ForeignFormat::ALL.into_iter().flat_map(|format| format.extensions());
                std::iter::once("toml").chain(foreign.copied()).collect()
            }
            Self::Picture => PictureFormat::all_extensions(false).collect(),
            Self::SavedPicture => PictureFormat::all_extensions(true).collect(),
            Self::Drawing => vec!["svg"],
            Self::Page => vec!["html"],
            Self::Folder => Vec::new(),
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

/// The answer to come; `None` when the person cancelled. When it is dropped without an answer, no dialog could appear.
pub type FileAnswer = Receiver<Option<PathBuf>>;

/// Puts a picture into the clipboard: width and height in pixels; red, green, blue and 255 of every pixel. It can be
/// called from any thread; on failure it gives the reason.
pub type PictureClipboard = fn([usize; 2], &[u8]) -> Result<(), String>;

/// The system around the studio.
pub trait Host {
    /// Asks for a file without blocking; `None` when the system has no dialog of its own, and the studio's must do.
    fn ask_file(&mut self, question: &FileQuestion) -> Option<FileAnswer>;

    /// The file of the settings, if there is a place for it.
    fn settings_path(&self) -> Option<PathBuf>;

    /// The folder for unsaved work, if there is a place for it.
    fn recovery_folder(&self) -> Option<PathBuf>;

    /// What puts pictures into the clipboard without the window having to wait; `None` leaves it to the window.
    fn clipboard(&self) -> Option<PictureClipboard> {
        None
    }

    /// Bytes of memory that can be used without harm, if that is known.
    fn free_memory(&self) -> Option<u64> {
        None
    }
}

/// The host of a desktop.
#[derive(Debug, Default)]
pub struct DesktopHost;

impl Host for DesktopHost {
    fn ask_file(&mut self, question: &FileQuestion) -> Option<FileAnswer> {
        if !has_native_dialogs() {
            return None;
        }
        let (sender, answer) = mpsc::channel();
        // The dialog is made on the thread of the window, as macOS demands, and awaited on another.
        let dialog = native_dialog(question);
        std::thread::Builder::new()
            .name("file dialog".to_owned())
            .spawn(move || {
                let asked = Instant::now();
                let chosen = wait_for(dialog).map(|file| file.path().to_owned());
                if chosen.is_none() && asked.elapsed() < FASTEST {
                    // Nobody answers so quickly: the dialog could not appear. Without an answer, the studio's own does.
                    return;
                }
                // The studio may be gone by the time of the answer.
                let _ = sender.send(chosen);
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

    fn clipboard(&self) -> Option<PictureClipboard> {
        Some(copy_picture)
    }

    fn free_memory(&self) -> Option<u64> {
        free_memory()
    }
}

/// The window's own way would pack the picture as PNG in the window's thread: for a second, if it is large.
fn copy_picture([width, height]: [usize; 2], codes: &[u8]) -> Result<(), String> {
    let image = arboard::ImageData { width, height, bytes: codes.into() };
    arboard::Clipboard::new()
        .and_then(|mut clipboard| clipboard.set_image(image))
        .map_err(|error| error.to_string())
}

/// What the kernel says could be had, swapping included.
#[cfg(target_os = "linux")]
fn free_memory() -> Option<u64> {
    let told = std::fs::read_to_string("/proc/meminfo").ok()?;
    let kilobytes = |name: &str| -> Option<u64> {
        let line = told.lines().find_map(|line| line.strip_prefix(name))?;
        line.trim_start_matches(':').split_whitespace().next()?.parse().ok()
    };
    let free = kilobytes("MemAvailable")? + kilobytes("SwapFree").unwrap_or(0);
    free.checked_mul(1024)
}

#[cfg(not(target_os = "linux"))]
fn free_memory() -> Option<u64> {
    None
}

fn strategy() -> Option<impl etcetera::AppStrategy> {
    etcetera::choose_app_strategy(etcetera::AppStrategyArgs {
        top_level_domain: "org".to_owned(),
        author: "Catoptric".to_owned(),
        app_name: "catoptric".to_owned(),
    })
    .ok()
}

/// A file dialog of the system, and its future answer.
type FileDialogFuture = Pin<Box<dyn Future<Output = Option<rfd::FileHandle>> + Send>>;

fn native_dialog(question: &FileQuestion) -> FileDialogFuture {
    let mut dialog = rfd::AsyncFileDialog::new().set_title(&question.title);
    let extensions = question.kind.extensions();
    let names: Vec<String> = extensions.iter().map(|extension| format!("*.{extension}")).collect();
    if !extensions.is_empty() {
        dialog = dialog.add_filter(names.join(", "), &extensions);
    }
    if !question.is_saving {
        dialog = dialog.add_filter("*", &["*"]);
    }
    if let Some(folder) = &question.folder {
        dialog = dialog.set_directory(folder);
    }
    if question.is_saving {
        Box::pin(dialog.set_file_name(&question.name).save_file())
    } else {
        Box::pin(dialog.pick_file())
    }
}

/// Wakes a thread that waits for a future.
struct ThreadWaker(Thread);

impl Wake for ThreadWaker {
    fn wake(self: Arc<Self>) {
        self.0.unpark();
    }
}

/// Waits until `future` is there.
fn wait_for<T>(mut future: Pin<Box<dyn Future<Output = T> + Send>>) -> T {
    let waker = Waker::from(Arc::new(ThreadWaker(std::thread::current())));
    let mut context = Context::from_waker(&waker);
    loop {
        match future.as_mut().poll(&mut context) {
            Poll::Ready(value) => return value,
            Poll::Pending => std::thread::park(),
        }
    }
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
