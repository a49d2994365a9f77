//! A watch over changes of the open file by other programs.

use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Weak};
use std::thread::{self, Thread};
use std::time::Duration;

use egui::{Align, Context, Event, Frame, Label, Layout, Margin, Panel, RichText, Ui};
use egui_material_icons::icons;

use super::disk::{FileStamp, OverwriteRule};
use super::file_prompt::name_of;
use super::{has_unsaved_work, open};
use crate::app::Studio;
use crate::theme;

/// How often the file is looked at; it is looked at when the window gets the focus, too.
const INTERVAL: Duration = Duration::from_secs(2);

/// The file as it was last read or written here.
#[derive(Clone)]
struct WatchedFile {
    document: u64,
    path: PathBuf,
    stamp: FileStamp,
    text: Arc<str>,
}

impl WatchedFile {
    fn is_same(&self, other: &Self) -> bool {
        (self.document, self.stamp, &self.path) == (other.document, other.stamp, &other.path)
            && Arc::ptr_eq(&self.text, &other.text)
    }
}

/// A change of the file by another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum FileChange {
    /// Another program has written the same text.
    Touched(FileStamp),
    /// Another program has written another text.
    Rewritten,
}

/// A thread that looks at the file of the document again and again.
struct FileWatch {
    known: WatchedFile,
    changes: Receiver<FileChange>,
    thread: Thread,
    /// The thread ends without it.
    alive: Option<Arc<()>>,
}

impl FileWatch {
    fn start(context: &Context, known: WatchedFile) -> Option<Self> {
        let (sender, changes) = mpsc::channel();
        let alive = Arc::new(());
        let (watched, life, context) = (known.clone(), Arc::downgrade(&alive), context.clone());
        // Without a thread, a change is found when the document is saved.
        let handle = thread::Builder::new()
            .name("file watch".to_owned())
            .spawn(move || look(&watched, &life, &sender, &context))
            .ok()?;
        Some(Self { known, changes, thread: handle.thread().clone(), alive: Some(alive) })
    }
}

impl Drop for FileWatch {
    fn drop(&mut self) {
        self.alive = None;
        self.thread.unpark();
    }
}

/// Tells each change of the file once.
fn look(known: &WatchedFile, life: &Weak<()>, sender: &Sender<FileChange>, context: &Context) {
    let mut last = known.stamp;
    while life.strong_count() > 0 {
        if let Some(found) = FileStamp::of(&known.path).filter(|found| *found != last) {
            last = found;
            let is_same = has_text(&known.path, &known.text);
            let change = if is_same { FileChange::Touched(found) } else { FileChange::Rewritten };
            if sender.send(change).is_err() {
                return;
            }
            context.request_repaint();
        }
        thread::park_timeout(INTERVAL);
    }
}

/// Whether the file at `path` has just this text.
fn has_text(path: &Path, text: &str) -> bool {
    let Ok(file) = std::fs::File::open(path) else { return false };
    let mut read = Vec::with_capacity(text.len() + 1);
    // A byte more than the text shows that the file is longer.
    let limit = text.len() as u64 + 1;
    file.take(limit).read_to_end(&mut read).is_ok() && read == text.as_bytes()
}

/// The changes of the file by other programs.
#[derive(Default)]
pub(super) struct ExternalChanges {
    watch: Option<FileWatch>,
    /// Whether to offer to reload the file.
    is_rewritten: bool,
}

/// Looks at the file of the document, unless it is being read or written here.
pub(super) fn keep(context: &Context, studio: &mut Studio) {
    let known = known(studio);
    let documents = &mut studio.documents;
    let outside = &mut documents.outside;
    let is_watched = match (&outside.watch, &known) {
        (Some(watch), Some(known)) => watch.known.is_same(known),
        (None, None) => true,
        _ => false,
    };
    if !is_watched {
        *outside = ExternalChanges::default();
        outside.watch = known.and_then(|known| FileWatch::start(context, known));
    }
    let Some(watch) = &outside.watch else { return };
    if context.input(|input| input.raw.events.contains(&Event::WindowFocused(true))) {
        watch.thread.unpark();
    }
    for change in watch.changes.try_iter() {
        match change {
            FileChange::Touched(stamp) => {
                documents.may = Some(OverwriteRule::Update(stamp));
                outside.is_rewritten = false;
            }
            FileChange::Rewritten => outside.is_rewritten = true,
        }
    }
}

fn known(studio: &Studio) -> Option<WatchedFile> {
    let documents = &studio.documents;
    let (Some(OverwriteRule::Update(stamp)), None, None) =
        (documents.may, &documents.saving, &documents.reading)
    else {
        return None;
    };
    let (path, text) = (studio.editor.path()?.to_owned(), Arc::clone(documents.text_on_disk.as_ref()?));
    Some(WatchedFile { document: documents.number, path, stamp, text })
}

/// Draws the banner that offers to reload a file that another program has changed.
pub(super) fn banner_ui(ui: &mut Ui, studio: &mut Studio) {
    if !studio.documents.outside.is_rewritten {
        return;
    }
    let has_changes = has_unsaved_work(studio);
    let texts = &studio.texts;
    let name = studio.editor.path().map(name_of).unwrap_or_default();
    let key = if has_changes { "outside-changed-both" } else { "outside-changed" };
    let text = texts.with(key, &[("name", name.into())]);
    let palette = theme::palette(ui.visuals());
    let frame = Frame::new().fill(palette.field).inner_margin(Margin::symmetric(10, 4));
    let (mut reloads, mut keeps) = (false, false);
    Panel::top("changed outside").frame(frame).show_separator_line(false).show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.label(RichText::new(icons::ICON_SYNC_PROBLEM.codepoint).color(palette.warning).size(16.0));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let tip = |key| texts.tip(key).unwrap_or_default();
                keeps = ui.button(texts.get("outside-keep")).on_hover_text(tip("outside-keep")).clicked();
                reloads =
                    ui.button(texts.get("outside-reload")).on_hover_text(tip("outside-reload")).clicked();
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    ui.add(Label::new(text).truncate());
                });
            });
        });
    });
    if reloads {
        open::reload(ui.ctx(), studio);
    }
    if reloads || keeps {
        // The next change is offered anew, and saving asks before it replaces this one.
        studio.documents.outside.is_rewritten = false;
    }
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
