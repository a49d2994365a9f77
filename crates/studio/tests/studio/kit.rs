//! A studio without a window, and hands to use it.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use catoptric_editor::Item;
use catoptric_scene::ScenePart;
use catoptric_studio::host::{FileAnswer, FileQuestion, Host, HostAbilities, LinkOutcome, PictureClipboard};
use catoptric_studio::{StartDocument, Studio};
use egui_kittest::{Harness, HarnessBuilder};
use tempfile::TempDir;

/// A system of its own for each test: a temporary folder, and answers to the questions for files.
#[derive(Clone)]
pub(crate) struct TestHost {
    folder: PathBuf,
    /// Removes the folder at the end.
    _temporary: Option<Arc<TempDir>>,
    answers: Arc<Mutex<VecDeque<Option<PathBuf>>>>,
    pub(crate) questions: Arc<Mutex<Vec<FileQuestion>>>,
    /// Bytes of memory that are free, as the studio is told.
    pub(crate) free_memory: Arc<Mutex<Option<u64>>>,
    /// Without one, the window copies.
    pub(crate) clipboard: Option<PictureClipboard>,
    /// The views that links were asked for, where there are links.
    pub(crate) links: Option<Arc<Mutex<Vec<String>>>>,
}

impl TestHost {
    pub(crate) fn new() -> Self {
        let temporary = tempfile::tempdir().unwrap();
        let host = Self::at(temporary.path());
        Self { _temporary: Some(Arc::new(temporary)), ..host }
    }

    /// A system whose files lie in a folder of somebody else.
    pub(crate) fn at(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            _temporary: None,
            answers: Arc::default(),
            questions: Arc::default(),
            free_memory: Arc::default(),
            clipboard: None,
            links: None,
        }
    }

    /// A path in the folder of this host.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// The next question for a file gets this answer.
    pub(crate) fn answer(&self, path: Option<PathBuf>) {
        self.answers.lock().unwrap().push_back(path);
    }
}

impl Host for TestHost {
    fn ask_file(&mut self, question: &FileQuestion) -> Option<FileAnswer> {
        self.questions.lock().unwrap().push(question.clone());
        let answer = self.answers.lock().unwrap().pop_front()?;
        let (sender, receiver) = mpsc::channel();
        sender.send(answer).unwrap();
        Some(receiver)
    }

    fn settings_path(&self) -> Option<PathBuf> {
        Some(self.path("settings.json"))
    }

    fn recovery_folder(&self) -> Option<PathBuf> {
        Some(self.path("recovery"))
    }

    fn abilities(&self) -> HostAbilities {
        HostAbilities { has_links: self.links.is_some(), ..HostAbilities::DESKTOP }
    }

    fn copy_link(&mut self, view: String) -> Option<mpsc::Receiver<LinkOutcome>> {
        self.links.as_ref()?.lock().unwrap().push(view);
        let (sender, receiver) = mpsc::channel();
        sender.send(LinkOutcome::Copied).unwrap();
        Some(receiver)
    }

    fn clipboard(&self) -> Option<PictureClipboard> {
        self.clipboard
    }

    fn free_memory(&self) -> Option<u64> {
        *self.free_memory.lock().unwrap()
    }
}

/// A studio of 1280 × 800 points that shows the example four-bodies, in English.
pub(crate) fn studio() -> Harness<'static, Studio> {
    studio_with(TestHost::new(), StartDocument::Example("four-bodies".to_owned()))
}

/// A studio on `host`. Its settings, if there are none yet, are English with the first hint dismissed.
pub(crate) fn studio_with(host: TestHost, start: StartDocument) -> Harness<'static, Studio> {
    build(Harness::builder(), host, start)
}

/// A studio that may be shown texts in any letters, as files can hold them.
pub(crate) fn studio_with_any_letters(host: TestHost, start: StartDocument) -> Harness<'static, Studio> {
    build(Harness::builder().allow_missing_glyphs(), host, start)
}

fn build(builder: HarnessBuilder<Studio>, host: TestHost, start: StartDocument) -> Harness<'static, Studio> {
    let settings = host.settings_path().unwrap();
    if !settings.exists() {
        let text = r#"{"language": "english", "is_hint_dismissed": true, "viewport_samples": 1}"#;
        std::fs::write(settings, text).unwrap();
    }
    builder
        .with_size([1280.0, 800.0])
        .with_max_steps(64)
        .build_eframe(move |creation| Studio::new(&creation.egui_ctx, &start, Box::new(host)).unwrap())
}

/// What stands at a place now.
pub(crate) fn item_at(studio: &Studio, part: ScenePart) -> Item {
    studio.editor().edited().item(part).unwrap()
}

/// When to give up waiting: long after a loaded machine is done, for nothing here is timed.
pub(crate) fn deadline() -> Instant {
    Instant::now() + Duration::from_secs(300)
}

/// Steps until `condition` holds; panics with `what` when it never does.
pub(crate) fn wait_until(
    harness: &mut Harness<'static, Studio>,
    what: &str,
    condition: impl Fn(&Studio) -> bool,
) {
    let deadline = deadline();
    loop {
        harness.step();
        if condition(harness.state()) {
            return;
        }
        assert!(Instant::now() < deadline, "waited in vain: {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}
