//! Autosave: a thread writes unsaved work every few seconds beside the recovery files of other studios.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};

use catoptric_editor::SceneWriter;
use catoptric_editor::recovery::{Orphan, Session, Snapshot, orphans};
use catoptric_platform::threads::{self, Thread};
use catoptric_platform::time::Instant;
use egui::Context;

use super::recovery::RecoverableDocument;

/// A state of a document of this window: its number and revision.
pub(crate) type DocumentState = (u64, u64);

/// Writes the unsaved document to the recovery folder every few seconds.
#[derive(Default)]
pub(crate) struct Autosave {
    pub(crate) thread: Option<AutosaveThread>,
    /// The state that the thread was last ordered to write, and when.
    pub(crate) sent: Option<(DocumentState, Instant)>,
    /// What is kept.
    pub(crate) kept: Option<DocumentState>,
    /// Whether the thread is about it.
    pub(crate) is_busy: bool,
    /// Since when there is something to be kept.
    pub(crate) waits_since: Option<Instant>,
    /// Orphans that have become the document of this number; they go when that is kept.
    pub(crate) restored: Vec<(u64, Arc<Orphan>)>,
    pub(crate) is_held: bool,
    /// Whether keeping failed the last time; it is tried again then.
    pub(crate) has_failed: bool,
    /// What was found at the start.
    pub(crate) found: Vec<RecoverableDocument>,
}

/// What writes. If it is dropped without an order, as after a panic, the recovery file stays.
pub(crate) struct AutosaveThread {
    orders: AutosaveOrders,
    pub(crate) reports: Receiver<AutosaveReport>,
}

/// Who takes the orders.
enum AutosaveOrders {
    /// A thread, which ends when there is nobody to give orders any more.
    Thread(Option<Sender<AutosaveRequest>>, Option<Thread>),
    /// The window's thread, where there are no others.
    Window(RefCell<AutosaveWriter>),
}

impl Drop for AutosaveThread {
    fn drop(&mut self) {
        if let AutosaveOrders::Thread(orders, thread) = &mut self.orders {
            drop(orders.take());
            if let Some(thread) = thread.take() {
                thread.join();
            }
        }
    }
}

pub(crate) enum AutosaveRequest {
    Keep {
        state: DocumentState,
        writing: SceneWriter,
        path: Option<PathBuf>,
        title: String,
    },
    Clear,
    Discard(Arc<Orphan>),
    /// Orphans that have become the document go with it, unless they are the only copy.
    Finish {
        leave_behind: bool,
        restored: Vec<Arc<Orphan>>,
    },
}

pub(crate) enum AutosaveReport {
    Found(Vec<RecoverableDocument>),
    Kept(DocumentState),
    Failed(String),
}

impl Autosave {
    /// Starts the thread, which also looks for what was left behind.
    pub(crate) fn start(context: &Context, folder: PathBuf) -> Self {
        let (outbox, reports) = mpsc::channel();
        let context = context.clone();
        let report = move |report| {
            let _ = outbox.send(report);
            context.request_repaint();
        };
        let writer = move || AutosaveWriter::start(folder, report);
        let orders = if threads::are_available() {
            let (orders, inbox) = mpsc::channel();
            let Ok(thread) = Thread::start("recovery", move || writer().attend(&inbox)) else {
                return Self::default();
            };
            AutosaveOrders::Thread(Some(orders), Some(thread))
        } else {
            AutosaveOrders::Window(RefCell::new(writer()))
        };
        Self { thread: Some(AutosaveThread { orders, reports }), ..Self::default() }
    }

    /// What is unsaved is to be offered at the next start.
    pub(crate) fn hold(&mut self) {
        self.is_held = true;
    }

    /// The orphan has become the document of this number.
    pub(crate) fn has_restored(&mut self, document: u64, orphan: Arc<Orphan>) {
        self.restored.push((document, orphan));
    }

    /// Removes an orphan for good.
    pub(crate) fn discard(&self, orphan: Arc<Orphan>) {
        self.order(AutosaveRequest::Discard(orphan));
    }

    pub(crate) fn order(&self, order: AutosaveRequest) {
        match self.thread.as_ref().map(|thread| &thread.orders) {
            Some(AutosaveOrders::Thread(Some(orders), _)) => _ = orders.send(order),
            Some(AutosaveOrders::Window(writer)) => writer.borrow_mut().take(order),
            Some(AutosaveOrders::Thread(None, _)) | None => {}
        }
    }

    /// Discards the orphans whose documents are kept, saved or discarded.
    pub(crate) fn discard_restored(&mut self, is_over: impl Fn(u64) -> bool) {
        let (over, still) =
            std::mem::take(&mut self.restored).into_iter().partition(|(number, _)| is_over(*number));
        self.restored = still;
        let over: Vec<(u64, Arc<Orphan>)> = over;
        for (_, orphan) in over {
            self.discard(orphan);
        }
    }
}

/// Writes the document that it is told to keep.
struct AutosaveWriter {
    folder: PathBuf,
    report: Box<dyn Fn(AutosaveReport) + Send>,
    session: Option<Session>,
    is_kept: bool,
}

impl AutosaveWriter {
    /// Reports first what was left behind.
    fn start(folder: PathBuf, report: impl Fn(AutosaveReport) + Send + 'static) -> Self {
        let found: Vec<RecoverableDocument> =
            orphans(&folder).into_iter().map(RecoverableDocument::new).collect();
        if !found.is_empty() {
            report(AutosaveReport::Found(found));
        }
        Self { folder, report: Box::new(report), session: None, is_kept: false }
    }

    /// Takes orders until nobody gives any.
    fn attend(mut self, inbox: &Receiver<AutosaveRequest>) {
        inbox.iter().for_each(|order| self.take(order));
    }

    fn take(&mut self, order: AutosaveRequest) {
        match order {
            AutosaveRequest::Keep { state, writing, path, title } => {
                // The next studio may be started in another folder.
                let writing = if path.is_some() { writing } else { writing.with_whole_paths() };
                let snapshot = Snapshot { original_path: path, title, text: writing.text() };
                let result = keep_in(&mut self.session, &self.folder, &snapshot);
                self.is_kept = result.is_ok();
                (self.report)(result.map_or_else(AutosaveReport::Failed, |()| AutosaveReport::Kept(state)));
            }
            AutosaveRequest::Clear => _ = self.session.as_mut().map(Session::clear),
            AutosaveRequest::Discard(orphan) => discard(orphan),
            AutosaveRequest::Finish { leave_behind, restored } => {
                if self.is_kept || !leave_behind {
                    restored.into_iter().for_each(discard);
                }
                let session = self.session.take();
                if leave_behind && let Some(session) = session {
                    session.leave_behind();
                }
            }
        }
    }
}

impl Drop for AutosaveWriter {
    fn drop(&mut self) {
        // The window is gone without a word, as after a fault.
        if let Some(session) = self.session.take() {
            session.leave_behind();
        }
    }
}

/// Where it cannot be removed, it is offered again, which is better than lost.
fn discard(orphan: Arc<Orphan>) {
    let _ = Arc::into_inner(orphan).map(Orphan::discard);
}

fn keep_in(session: &mut Option<Session>, folder: &Path, snapshot: &Snapshot) -> Result<(), String> {
    let session = match session {
        Some(session) => session,
        None => session.insert(Session::start(folder).map_err(|error| error.to_string())?),
    };
    session.write(snapshot).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use catoptric_editor::Editor;
    use catoptric_scene::Scene;

    /// What is found after a studio has restored an orphan, kept it in `folder` and left it behind.
    fn left(orphans_folder: &Path, folder: &Path) -> usize {
        let mut session = Session::start(orphans_folder).unwrap();
        session.write(&Snapshot::default()).unwrap();
        session.leave_behind();
        let restored: Vec<Arc<Orphan>> = orphans(orphans_folder).into_iter().map(Arc::new).collect();
        assert_eq!(restored.len(), 1);
        let (orders, inbox) = mpsc::channel();
        let writing = Editor::new(Scene::default()).writing();
        orders
            .send(AutosaveRequest::Keep { state: (0, 0), writing, path: None, title: String::new() })
            .unwrap();
        orders.send(AutosaveRequest::Finish { leave_behind: true, restored }).unwrap();
        drop(orders);
        AutosaveWriter::start(folder.to_owned(), |_| {}).attend(&inbox);
        orphans(orphans_folder).len()
    }

    #[test]
    fn a_restored_orphan_goes_only_when_it_is_not_the_only_copy() {
        let temporary = tempfile::tempdir().unwrap();
        let (folder, closed) = (temporary.path().join("recovery"), temporary.path().join("file"));
        std::fs::write(&closed, "no folder").unwrap();
        assert_eq!(left(&folder, &closed), 1);
        for orphan in orphans(&folder) {
            orphan.discard().unwrap();
        }
        assert_eq!(left(&folder, &temporary.path().join("other")), 0);
    }
}
