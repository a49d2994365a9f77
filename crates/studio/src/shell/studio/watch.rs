//! A watch over changes of the open file by other programs.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};

use catoptric_platform::files::{self, FileStamp, read_start};
use catoptric_platform::threads::Thread;
use catoptric_platform::time::Duration;
use egui::Context;

/// How often the file is looked at; it is looked at when the window gets the focus, too.
const INTERVAL: Duration = Duration::from_secs(2);

/// The file as it was last read or written here.
#[derive(Clone)]
pub(crate) struct WatchedFile {
    pub(crate) document: u64,
    pub(crate) path: PathBuf,
    pub(crate) stamp: FileStamp,
    pub(crate) text: Arc<str>,
}

impl WatchedFile {
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        (self.document, self.stamp, &self.path) == (other.document, other.stamp, &other.path)
            && Arc::ptr_eq(&self.text, &other.text)
    }
}

/// A change of the file by another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FileChange {
    /// Another program has written the same text.
    Touched(FileStamp),
    /// Another program has written another text.
    Rewritten,
}

/// A thread that looks at the file of the document again and again.
pub(crate) struct FileWatch {
    pub(crate) known: WatchedFile,
    pub(crate) changes: Receiver<FileChange>,
    /// Has the thread look at once; the thread ends without it.
    look: Sender<()>,
}

impl FileWatch {
    /// Watches the file of a document; `None` where nobody else can change it.
    pub(crate) fn start(context: &Context, known: WatchedFile) -> Option<Self> {
        if !files::ARE_SHARED {
            return None;
        }
        let (sender, changes) = mpsc::channel();
        let (look, orders) = mpsc::channel();
        let (watched, context) = (known.clone(), context.clone());
        // Without a thread, a change is found when the document is saved.
        Thread::start("file watch", move || watch(&watched, &orders, &sender, &context)).ok()?;
        Some(Self { known, changes, look })
    }

    /// Looks at the file now.
    pub(crate) fn look(&self) {
        let _ = self.look.send(());
    }
}

/// Tells each change of the file once.
fn watch(known: &WatchedFile, orders: &Receiver<()>, sender: &Sender<FileChange>, context: &Context) {
    let mut last = known.stamp;
    loop {
        if let Some(found) = FileStamp::of(&known.path).filter(|found| *found != last) {
            last = found;
            let is_same = has_text(&known.path, &known.text);
            let change = if is_same { FileChange::Touched(found) } else { FileChange::Rewritten };
            if sender.send(change).is_err() {
                return;
            }
            context.request_repaint();
        }
        if orders.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Disconnected) {
            return;
        }
    }
}

/// Whether the file at `path` has just this text.
fn has_text(path: &Path, text: &str) -> bool {
    // A byte more than the text shows that the file is longer.
    read_start(path, text.len() as u64 + 1).is_ok_and(|read| read == text.as_bytes())
}

/// The changes of the file by other programs.
#[derive(Default)]
pub(crate) struct ExternalChanges {
    pub(crate) watch: Option<FileWatch>,
    /// Whether to offer to reload the file.
    pub(crate) is_rewritten: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_compared_as_a_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        std::fs::write(&path, "abc").unwrap();
        assert!(has_text(&path, "abc"));
        for other in ["", "ab", "abd", "abcd"] {
            assert!(!has_text(&path, other), "{other}");
        }
        assert!(!has_text(&folder.path().join("b.toml"), ""));
    }
}
