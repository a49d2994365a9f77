//! The state that the worker and the window's thread share. Every lock is held for a moment only.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use catoptric_platform::time::{Duration, Instant};
use catoptric_tracer::{RenderControl, RenderScene};

use crate::card::CardSource;
use crate::frame::Frame;
use crate::request::Request;
use crate::status::{LiveError, Status};

pub(crate) struct SharedState {
    mail: Mutex<Mailbox>,
    /// Rings when mail comes or a pass ends.
    bell: Condvar,
    shown: Mutex<WorkerOutput>,
    /// The newest scene, and what it is of.
    render_scene: Mutex<Option<(u64, Arc<RenderScene>)>>,
    wake: Box<dyn Fn() + Send + Sync>,
}

/// The messages to the worker.
#[derive(Default)]
struct Mailbox {
    request: Option<Request>,
    /// What is to draw, if that was said.
    card: Option<Option<CardSource>>,
    /// Whether the card is open, or a shader ready, that was waited for.
    is_ready: bool,
    stop: bool,
    pass_ended: bool,
}

/// The results of the worker.
#[derive(Default)]
struct WorkerOutput {
    latest: Option<Arc<Frame>>,
    status: Status,
    /// Whether something new was published since the worker was idle last. A window that asks again whenever it is
    /// woken, for the same, is not woken again.
    is_news: bool,
}

/// The next message to the worker.
pub(crate) enum WorkerMessage {
    Stop,
    /// What is to draw from now on.
    Card(Option<CardSource>),
    /// The card can draw now, or it never will.
    Ready,
    Request(Box<Request>),
    Nothing,
}

impl Mailbox {
    /// The next message. Requests stay unless `takes_requests`.
    fn next(&mut self, takes_requests: bool) -> Option<WorkerMessage> {
        if self.stop {
            return Some(WorkerMessage::Stop);
        }
        if let Some(card) = self.card.take() {
            return Some(WorkerMessage::Card(card));
        }
        if std::mem::take(&mut self.is_ready) {
            return Some(WorkerMessage::Ready);
        }
        let request = if takes_requests { self.request.take() } else { None };
        request.map(|request| WorkerMessage::Request(Box::new(request)))
    }
}

/// The time that the worker waits for messages.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum WaitLimit {
    /// There is work to do.
    No,
    /// There is work at this moment.
    Until(Instant),
    /// There is nothing to do until a card is open.
    ForCard,
    /// There is nothing to do.
    ForEver,
}

/// The conditions on which a newer request interrupts a pass.
pub(crate) struct PreemptionRule<'a> {
    /// Whether a request asks for something new.
    pub(crate) is_new: &'a dyn Fn(&Request) -> bool,
    /// Until when the pass is finished all the same.
    pub(crate) until: Option<Instant>,
    /// What to do from time to time.
    pub(crate) report: &'a dyn Fn(u64),
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // A panic while a lock was held leaves nothing half done: values are replaced whole.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl SharedState {
    pub(crate) fn new(status: Status, wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self {
            mail: Mutex::default(),
            bell: Condvar::new(),
            shown: Mutex::new(WorkerOutput { status, ..WorkerOutput::default() }),
            render_scene: Mutex::default(),
            wake: Box::new(wake),
        }
    }

    pub(crate) fn wake(&self) {
        // Whatever the window does there, the worker goes on.
        let _ = catch_unwind(AssertUnwindSafe(|| (self.wake)()));
    }

    // ---- the window's side ----

    pub(crate) fn request(&self, request: Request) {
        let mut mail = lock(&self.mail);
        lock(&self.shown).status.is_idle = false;
        // What it replaces may be the last of a large scene: it goes after the locks.
        let _replaced = mail.request.replace(request);
        drop(mail);
        self.bell.notify_all();
    }

    pub(crate) fn draw_with(&self, card: Option<CardSource>) {
        let mut mail = lock(&self.mail);
        lock(&self.shown).status.is_idle = false;
        mail.card = Some(card);
        drop(mail);
        self.bell.notify_all();
    }

    /// Tells the worker that the card can draw what it could not before, or has failed.
    pub(crate) fn tell_ready(&self) {
        let mut mail = lock(&self.mail);
        lock(&self.shown).status.is_idle = false;
        mail.is_ready = true;
        drop(mail);
        self.bell.notify_all();
        // A window gives slices to a worker that has no thread.
        self.wake();
    }

    pub(crate) fn stop(&self) {
        lock(&self.mail).stop = true;
        self.bell.notify_all();
    }

    pub(crate) fn latest(&self) -> Option<Arc<Frame>> {
        lock(&self.shown).latest.clone()
    }

    pub(crate) fn status(&self) -> Status {
        lock(&self.shown).status.clone()
    }

    pub(crate) fn render_scene(&self) -> Option<(u64, Arc<RenderScene>)> {
        lock(&self.render_scene).clone()
    }

    // ---- the worker's side ----

    pub(crate) fn publish(&self, frame: Frame) {
        let mut shown = lock(&self.shown);
        let replaced = shown.latest.replace(Arc::new(frame));
        shown.is_news = true;
        drop(shown);
        drop(replaced);
        self.wake();
    }

    pub(crate) fn publish_scene(&self, revision: u64, render_scene: Arc<RenderScene>) {
        let replaced = lock(&self.render_scene).replace((revision, render_scene));
        drop(replaced);
    }

    /// Edits the worker's scene, which is the newest, and publishes it. It is edited in place as soon as nobody else
    /// looks at it, and the window looks for moments; if it does not stop, a copy is edited.
    pub(crate) fn edit_scene(
        &self,
        revision: u64,
        mut render_scene: Arc<RenderScene>,
        edit: impl FnOnce(&mut RenderScene),
    ) -> Arc<RenderScene> {
        /// How often to look whether nobody else does.
        const TRIES: u32 = 16;
        for _ in 0..TRIES {
            let mut published = lock(&self.render_scene);
            let before = published.take().map(|(revision, _)| revision);
            if let Some(own) = Arc::get_mut(&mut render_scene) {
                edit(own);
                *published = Some((revision, Arc::clone(&render_scene)));
                drop(published);
                return render_scene;
            }
            *published = before.map(|revision| (revision, Arc::clone(&render_scene)));
            drop(published);
            catoptric_platform::threads::sleep(Duration::from_millis(1));
        }
        edit(Arc::make_mut(&mut render_scene));
        self.publish_scene(revision, Arc::clone(&render_scene));
        render_scene
    }

    /// Says that there is no picture, if that is news.
    pub(crate) fn publish_error(&self, error: LiveError) {
        let mut shown = lock(&self.shown);
        let error = Some(error);
        if shown.status.error != error {
            shown.status.error = error;
            shown.is_news = true;
            drop(shown);
            self.wake();
        }
    }

    pub(crate) fn change_status(&self, change: impl FnOnce(&mut Status)) {
        change(&mut lock(&self.shown).status);
    }

    /// The next request, after a wait.
    pub(crate) fn look(&self, wait: WaitLimit) -> WorkerMessage {
        let mut mail = lock(&self.mail);
        loop {
            if let Some(message) = mail.next(true) {
                return message;
            }
            mail = match wait {
                WaitLimit::No => return WorkerMessage::Nothing,
                WaitLimit::Until(moment) => {
                    let left = moment.saturating_duration_since(Instant::now());
                    if left.is_zero() {
                        return WorkerMessage::Nothing;
                    }
                    self.wait(mail, left)
                }
                WaitLimit::ForCard => self.bell.wait(mail).unwrap_or_else(PoisonError::into_inner),
                WaitLimit::ForEver => {
                    // While the mail is locked, so that no request comes in between.
                    if self.rest() {
                        drop(mail);
                        self.wake();
                        lock(&self.mail)
                    } else {
                        self.bell.wait(mail).unwrap_or_else(PoisonError::into_inner)
                    }
                }
            };
        }
    }

    /// Notes that there is nothing to do. Returns whether the window has not heard of all yet.
    fn rest(&self) -> bool {
        let mut shown = lock(&self.shown);
        shown.status.is_idle = true;
        std::mem::take(&mut shown.is_news)
    }

    /// The next message, for a worker that has work within `wait`, without waiting; `None` when it has none now.
    /// Requests stay where they are unless `takes_requests`.
    pub(crate) fn glance(&self, wait: WaitLimit, takes_requests: bool) -> Option<WorkerMessage> {
        if let Some(message) = lock(&self.mail).next(takes_requests) {
            return Some(message);
        }
        let is_due = match wait {
            WaitLimit::No => true,
            WaitLimit::Until(moment) => moment <= Instant::now(),
            WaitLimit::ForCard | WaitLimit::ForEver => false,
        };
        if wait == WaitLimit::ForEver && self.rest() {
            self.wake();
        }
        is_due.then_some(WorkerMessage::Nothing)
    }

    /// Whether something newer is asked for that does not wait for work under way.
    pub(crate) fn is_superseded(&self, is_new: impl Fn(&Request) -> bool) -> bool {
        let mail = lock(&self.mail);
        mail.stop || mail.card.is_some() || mail.request.as_ref().is_some_and(is_new)
    }

    fn wait<'a>(&self, mail: MutexGuard<'a, Mailbox>, time: Duration) -> MutexGuard<'a, Mailbox> {
        self.bell.wait_timeout(mail, time).unwrap_or_else(PoisonError::into_inner).0
    }

    /// Notes that a pass begins; when the answer is dropped, it has ended.
    pub(crate) fn begin_pass(&self) -> PassEndSignal<'_> {
        lock(&self.mail).pass_ended = false;
        PassEndSignal(self)
    }

    /// Waits for the end of a pass, and cancels it when something newer is asked for.
    pub(crate) fn watch_pass(&self, control: &RenderControl, patience: &PreemptionRule<'_>) {
        const REPORT: Duration = Duration::from_millis(100);
        let mut mail = lock(&self.mail);
        while !mail.pass_ended {
            let is_newer = mail.request.as_ref().is_some_and(patience.is_new);
            let left = patience
                .until
                .map_or(Duration::ZERO, |until| until.saturating_duration_since(Instant::now()));
            if mail.stop || mail.card.is_some() || mail.is_ready || (is_newer && left.is_zero()) {
                control.cancel();
            }
            if control.is_cancelled() {
                mail = self.bell.wait(mail).unwrap_or_else(PoisonError::into_inner);
                continue;
            }
            let time = if is_newer { left.min(REPORT) } else { REPORT };
            let looked = Instant::now();
            mail = self.wait(mail, time);
            if looked.elapsed() >= REPORT && !mail.pass_ended {
                drop(mail);
                (patience.report)(control.pixels_done());
                mail = lock(&self.mail);
            }
        }
    }
}

/// Signals the end of a pass when it is dropped, also by a panic.
pub(crate) struct PassEndSignal<'a>(&'a SharedState);

impl Drop for PassEndSignal<'_> {
    fn drop(&mut self) {
        lock(&self.0.mail).pass_ended = true;
        self.0.bell.notify_all();
    }
}
