//! The studio's own dialog for files, where the system has none.
//!
//! One field takes a name, or a path: whatever ends in a separator becomes the folder that is listed. While opening,
//! what is typed narrows the list; the arrow keys choose from it.

mod listing;
mod new_folder;
mod table;

use std::cell::Cell;
use std::io;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::mpsc::Sender;

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Key, RichText, TextEdit, Ui, WidgetInfo, vec2};
use egui_material_icons::icons;

use crate::base::job::{Job, JobStatus};
use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::icon_ui;
use crate::base::words::name_of;
use crate::shell::host::FileQuestion;
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::question::QuestionDialog;
use crate::shell::studio::dialogs::{Dialog, DialogFlow, buttons_if};
use crate::shell::studio::file_prompt::{ChosenFile, completed};
use listing::{FolderItem, FolderListing, list, split};
use new_folder::{NewFolderField, NewFolderOutcome};
pub(crate) use table::age;

/// Asks for a file.
pub(crate) struct FileDialog {
    question: FileQuestion,
    /// What answers the question; nothing sent means that it was cancelled.
    sender: Sender<Option<ChosenFile>>,
    home: Option<PathBuf>,
    /// Folders of recent files.
    recent: Vec<PathBuf>,
    folder: PathBuf,
    name: String,
    /// Whether the name was typed, and not taken from the list.
    is_typed: bool,
    shows_all: bool,
    /// What was read last, and what is being read.
    listing: Option<FolderListing>,
    reading: Option<Job<FolderListing>>,
    /// The entry of the list with the arrow keys, by name.
    selected: Option<String>,
    scrolls: bool,
    is_new: bool,
    new_folder: Option<NewFolderField>,
    /// Whether the question whether to replace a file has been answered so.
    is_done: Rc<Cell<bool>>,
}

impl FileDialog {
    /// Asks `question`; the answer goes to `sender`.
    pub(crate) fn new(
        question: FileQuestion,
        home: Option<PathBuf>,
        recent: impl Iterator<Item = PathBuf>,
        sender: Sender<Option<ChosenFile>>,
    ) -> Self {
        let folder = question.folder.clone().or_else(|| home.clone()).unwrap_or_else(|| PathBuf::from("."));
        let folder = std::path::absolute(&folder).unwrap_or(folder);
        let mut folders: Vec<PathBuf> = Vec::new();
        for folder in recent {
            if !folders.contains(&folder) {
                folders.push(folder);
            }
        }
        Self {
            name: question.name.clone(),
            question,
            sender,
            home,
            recent: folders,
            folder,
            is_typed: false,
            shows_all: false,
            listing: None,
            reading: None,
            selected: None,
            scrolls: false,
            is_new: true,
            new_folder: None,
            is_done: Rc::default(),
        }
    }

    fn go_to(&mut self, folder: PathBuf) {
        if folder != self.folder {
            self.folder = folder;
            self.listing = None;
            self.reading = None;
            self.selected = None;
            self.new_folder = None;
        }
    }

    /// Reads the folder, if that has not been done.
    fn read(&mut self, ui: &Ui) {
        if let Some(reading) = self.reading.take() {
            match reading.poll() {
                JobStatus::Waiting => self.reading = Some(reading),
                JobStatus::Done(listing) if listing.folder == self.folder => self.listing = Some(listing),
                JobStatus::Done(_) => {}
                JobStatus::Lost => self.fail(io::ErrorKind::Other),
            }
        }
        if self.listing.is_none() && self.reading.is_none() {
            let (folder, kind) = (self.folder.clone(), self.question.kind);
            match Job::start(ui.ctx(), "folder", move || list(folder, kind)) {
                Ok(job) => self.reading = Some(job),
                Err(error) => self.fail(error.kind()),
            }
        }
    }

    fn fail(&mut self, kind: io::ErrorKind) {
        self.listing = Some(FolderListing { folder: self.folder.clone(), entries: Err(kind) });
    }

    /// The entries to be shown.
    fn entries(&self) -> Vec<&FolderItem> {
        let Some(FolderListing { entries: Ok(entries), .. }) = &self.listing else { return Vec::new() };
        let typed =
            if self.is_typed && !self.question.is_saving { self.name.to_lowercase() } else { String::new() };
        entries
            .iter()
            .filter(|entry| entry.fits || self.shows_all)
            .filter(|entry| entry.lowercase.contains(&typed))
            .collect()
    }

    fn select(&mut self, name: &str, is_folder: bool) {
        self.selected = Some(name.to_owned());
        if !is_folder {
            name.clone_into(&mut self.name);
            self.is_typed = false;
        }
    }

    /// Up and down walk through the list.
    fn walk(&mut self, ui: &Ui) {
        let pressed = |key| ui.input(|input| input.key_pressed(key));
        let (up, down) = (pressed(Key::ArrowUp), pressed(Key::ArrowDown));
        if !up && !down {
            return;
        }
        let entries = self.entries();
        let at = entries.iter().position(|entry| Some(&entry.name) == self.selected.as_ref());
        let next = match at {
            Some(at) if up => at.saturating_sub(1),
            Some(at) => (at + 1).min(entries.len().saturating_sub(1)),
            None => 0,
        };
        let Some((name, is_folder)) = entries.get(next).map(|entry| (entry.name.clone(), entry.is_folder))
        else {
            return;
        };
        self.select(&name, is_folder);
        self.scrolls = true;
    }

    fn top_ui(&mut self, ui: &mut Ui, texts: &Texts) {
        ui.horizontal(|ui| {
            let parent = self.folder.parent().map(Path::to_owned);
            let up = icon_button(ui, icons::ICON_ARROW_UPWARD.codepoint, texts, "files-up", parent.is_some());
            if up && let Some(parent) = parent {
                self.go_to(parent);
            }
            let home = icon_button(ui, icons::ICON_HOME.codepoint, texts, "files-home", self.home.is_some());
            if home && let Some(home) = self.home.clone() {
                self.go_to(home);
            }
            if !self.recent.is_empty() {
                self.recent_ui(ui, texts);
            }
            let icon = icons::ICON_CREATE_NEW_FOLDER.codepoint;
            if icon_button(ui, icon, texts, "files-new-folder", self.new_folder.is_none()) {
                self.new_folder = Some(NewFolderField::new(texts.get("files-new-folder")));
            }
            self.crumbs_ui(ui);
        });
        self.new_folder_ui(ui, texts);
    }

    /// The row for a new folder, which is entered as soon as it is there.
    fn new_folder_ui(&mut self, ui: &mut Ui, texts: &Texts) {
        let Some(new_folder) = &mut self.new_folder else { return };
        match new_folder.ui(ui, &self.folder, texts) {
            NewFolderOutcome::Stay => {}
            NewFolderOutcome::Close => self.new_folder = None,
            NewFolderOutcome::Made(folder) => self.go_to(folder),
        }
        // What is typed next is the name of the file.
        self.is_new |= self.new_folder.is_none();
    }

    fn recent_ui(&mut self, ui: &mut Ui, texts: &Texts) {
        let icon = RichText::new(icons::ICON_HISTORY.codepoint).size(16.0);
        let menu = ui.menu_button(icon, |ui| {
            let mut chosen = None;
            for folder in &self.recent {
                if ui.button(folder.display().to_string()).clicked() {
                    chosen = Some(folder.clone());
                    ui.close();
                }
            }
            chosen
        });
        let name = texts.get("files-recent");
        menu.response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::Button, true, name));
        menu.response.on_hover_text(name);
        if let Some(Some(folder)) = menu.inner {
            self.go_to(folder);
        }
    }

    /// The folders on the way to the present one; a click goes there.
    fn crumbs_ui(&mut self, ui: &mut Ui) {
        let mut ancestors: Vec<&Path> = self.folder.ancestors().collect();
        ancestors.reverse();
        // The last ones say most.
        let hidden = ancestors.len().saturating_sub(5);
        let mut chosen = None;
        ui.spacing_mut().item_spacing.x = 2.0;
        if hidden > 0 {
            ui.weak("…");
        }
        for (index, ancestor) in ancestors.iter().enumerate().skip(hidden) {
            if index > hidden {
                let color = theme::palette(ui.visuals()).weak;
                icon_ui(ui, icons::ICON_CHEVRON_RIGHT, 14.0, color);
            }
            let name = ancestor.file_name().unwrap_or(ancestor.as_os_str()).to_string_lossy();
            let name: String = if name.chars().count() > 24 {
                name.chars().take(23).chain(['…']).collect()
            } else {
                name.into_owned()
            };
            let button = ui.add(egui::Button::new(name).frame_when_inactive(false));
            if button.clicked() {
                chosen = Some((*ancestor).to_owned());
            }
        }
        if let Some(folder) = chosen {
            self.go_to(folder);
        }
    }

    fn name_ui(&mut self, ui: &mut Ui, texts: &Texts) {
        ui.horizontal(|ui| {
            let label = ui.label(texts.get("files-name"));
            let edit = TextEdit::singleline(&mut self.name)
                .hint_text(texts.get("files-name-hint"))
                .desired_width(f32::INFINITY)
                .margin(vec2(8.0, 5.0));
            let response = ui.add(edit).labelled_by(label.id);
            if response.changed() {
                self.is_typed = true;
                self.selected = None;
                if let Some((folder, name)) = split(&self.folder, self.home.as_deref(), &self.name) {
                    self.go_to(folder);
                    self.name = name;
                }
            }
            if std::mem::take(&mut self.is_new) {
                response.request_focus();
                select_stem(ui, response.id, &self.name);
            }
        });
        let all = ui.checkbox(&mut self.shows_all, texts.get("files-all"));
        let kinds: Vec<String> =
            self.question.kind.extensions().iter().map(|extension| format!(".{extension}")).collect();
        let kinds = [("kinds", kinds.join(", ").into())];
        all.on_hover_text(texts.with("files-all-tip", &kinds));
    }

    /// What the default button means now.
    fn decide(&mut self, studio: &mut Studio) -> DialogFlow {
        let entries = self.entries();
        let selected = entries.iter().find(|entry| Some(&entry.name) == self.selected.as_ref());
        // With a single one left, what was typed needs not be complete.
        let only = match entries.as_slice() {
            [only] if self.is_typed && !self.question.is_saving => Some(only),
            _ => None,
        };
        let exact = entries.iter().find(|entry| entry.name == self.name);
        let entry = selected.or(exact).or(only).map(|entry| (entry.name.clone(), entry.is_folder));
        match entry {
            Some((name, true)) => {
                self.go_to(self.folder.join(name));
                if !self.question.is_saving {
                    self.name.clear();
                }
                DialogFlow::Stay
            }
            Some((name, false)) if !self.question.is_saving => self.answer(self.folder.join(name), false),
            _ if self.name.trim().is_empty() => DialogFlow::Stay,
            _ if self.question.is_saving => self.save_as(studio),
            // Perhaps a hidden file; if there is none, opening it says so.
            _ => self.answer(self.folder.join(self.name.trim()), false),
        }
    }

    /// Takes the typed name; asks before replacing a file.
    fn save_as(&mut self, studio: &mut Studio) -> DialogFlow {
        let path = completed(self.folder.join(self.name.trim()), &self.question);
        let file_name = name_of(&path);
        let is_taken = match &self.listing {
            Some(FolderListing { entries: Ok(entries), .. }) => {
                entries.iter().any(|entry| entry.name == file_name)
            }
            _ => false,
        };
        if !is_taken {
            return self.answer(path, false);
        }
        let texts = &studio.texts;
        let (sender, is_done) = (self.sender.clone(), Rc::clone(&self.is_done));
        let shown = path.display().to_string();
        let question = QuestionDialog::new(
            texts.with("replace-title", &[("name", file_name.into())]),
            texts.with("replace-text", &[("path", shown.into())]),
        )
        .choice(texts.get("cancel"), |_, _| {})
        .choice(texts.get("replace"), move |_, _| {
            let _ = sender.send(Some(ChosenFile { path, may_replace: true }));
            is_done.set(true);
        });
        studio.dialogs.open(question);
        DialogFlow::Stay
    }

    fn answer(&self, path: PathBuf, may_replace: bool) -> DialogFlow {
        // Whoever asked may have gone.
        let _ = self.sender.send(Some(ChosenFile { path, may_replace }));
        DialogFlow::Close
    }
}

impl Dialog for FileDialog {
    fn title(&self, _texts: &Texts) -> String {
        self.question.title.clone()
    }

    fn width(&self) -> f32 {
        640.0
    }

    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> DialogFlow {
        if self.is_done.get() {
            return DialogFlow::Close;
        }
        self.read(ui);
        if self.new_folder.is_none() {
            self.walk(ui);
        }
        let texts = &studio.texts;
        self.top_ui(ui, texts);
        let opened = table::table_ui(ui, self, texts);
        self.name_ui(ui, texts);
        let act = if self.question.is_saving { "save" } else { "open" };
        let is_ready = self.selected.is_some() || !self.name.trim().is_empty();
        let pressed = buttons_if(ui, &[texts.get(act), texts.get("cancel")], is_ready);
        match pressed {
            Some(0) => self.decide(studio),
            Some(_) => DialogFlow::Close,
            None if opened => self.decide(studio),
            None => DialogFlow::Stay,
        }
    }
}

/// Selects a file's name up to its extension, to be typed anew.
fn select_stem(ui: &Ui, field: egui::Id, name: &str) {
    let stem = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
    let mut state = TextEditState::load(ui.ctx(), field).unwrap_or_default();
    let selected = CCursorRange::two(CCursor::default(), CCursor::new(stem.chars().count()));
    state.cursor.set_char_range(Some(selected));
    state.store(ui.ctx(), field);
}

fn icon_button(ui: &mut Ui, icon: &str, texts: &Texts, key: &str, is_enabled: bool) -> bool {
    let button = egui::Button::new(RichText::new(icon).size(16.0)).min_size(vec2(26.0, 26.0));
    let response = ui.add_enabled(is_enabled, button);
    let name = texts.get(key);
    response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::Button, is_enabled, name));
    response.on_hover_text(name).clicked()
}
