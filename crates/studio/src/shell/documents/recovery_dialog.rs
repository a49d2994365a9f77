//! Unsaved scenes of a studio that did not end well.

use std::cell::RefCell;
use std::rc::Rc;

use egui::{Align, Button, Frame, Label, Layout, Margin, RichText, ScrollArea, Ui, Vec2, vec2};

use super::recover;
use crate::base::texts::Texts;
use crate::base::theme;
use crate::shell::files::age;
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::question::QuestionDialog;
use crate::shell::studio::dialogs::{Dialog, DialogFlow};
use crate::shell::studio::recovery::RecoverableDocument;

/// Height of an entry's content, and the least size of a button.
const ROW: f32 = 60.0;
const BUTTON: Vec2 = vec2(84.0, 28.0);

/// A dialog that offers recovered documents.
pub(crate) struct RecoveryDialog {
    found: Rc<RefCell<Vec<RecoverableDocument>>>,
}

impl RecoveryDialog {
    /// Offers `found`, at least one.
    pub(crate) fn new(found: Vec<RecoverableDocument>) -> Self {
        Self { found: Rc::new(RefCell::new(found)) }
    }

    fn row(ui: &mut Ui, studio: &Studio, found: &RecoverableDocument) -> Option<RecoveryAction> {
        let texts = &studio.texts;
        let palette = theme::palette(ui.visuals());
        let mut act = None;
        let frame = Frame::new().fill(palette.field).corner_radius(6.0);
        frame.inner_margin(Margin::symmetric(12, 8)).show(ui, |ui| {
            let size = vec2(ui.available_width(), ROW);
            ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
                let restore = Button::new(texts.get("restore")).fill(palette.selection).min_size(BUTTON);
                let restore = named(ui.add(restore), texts.get("restore"), &found.title);
                if restore.clicked() {
                    act = Some(RecoveryAction::Restore);
                }
                // The first one is what Enter restores.
                if ui.memory(|memory| memory.focused().is_none()) {
                    restore.request_focus();
                }
                let discard = ui.add(Button::new(texts.get("discard")).min_size(BUTTON));
                if named(discard, texts.get("discard"), &found.title).clicked() {
                    act = Some(RecoveryAction::Discard);
                }
                ui.with_layout(Layout::top_down(Align::Min), |ui| Self::words(ui, texts, found));
            });
        });
        act
    }

    /// What it is, where it belongs, and how old it is.
    fn words(ui: &mut Ui, texts: &Texts, found: &RecoverableDocument) {
        ui.spacing_mut().item_spacing.y = 2.0;
        ui.add(Label::new(RichText::new(&found.title).strong()).truncate());
        let place = match &found.path {
            Some(path) => path.display().to_string(),
            None => texts.get("recovery-no-file").to_owned(),
        };
        ui.add(Label::new(RichText::new(place).weak()).truncate());
        ui.weak(age(texts, found.written));
    }
}

enum RecoveryAction {
    Restore,
    Discard,
}

fn named(response: egui::Response, act: &str, title: &str) -> egui::Response {
    let name = format!("{act}: {title}");
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &name));
    response
}

impl Dialog for RecoveryDialog {
    fn title(&self, texts: &Texts) -> String {
        texts.get("recovery-title").to_owned()
    }

    fn width(&self) -> f32 {
        560.0
    }

    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> DialogFlow {
        ui.add(Label::new(studio.texts.get("recovery-text")).wrap());
        ui.add_space(4.0);
        let mut act = None;
        ScrollArea::vertical().max_height(320.0).min_scrolled_height(320.0).show(ui, |ui| {
            for (index, found) in self.found.borrow().iter().enumerate() {
                if let Some(wanted) = Self::row(ui, studio, found) {
                    act = Some((index, wanted));
                }
            }
        });
        match act {
            Some((index, RecoveryAction::Restore)) => {
                if let Some(found) = self.found.borrow().get(index) {
                    recover::restore(ui.ctx(), studio, found);
                }
                return DialogFlow::Close;
            }
            Some((index, RecoveryAction::Discard)) => self.ask_to_discard(studio, index),
            None if self.found.borrow().is_empty() => return DialogFlow::Close,
            None => {}
        }
        ui.add_space(10.0);
        let later = Button::new(studio.texts.get("decide-later")).min_size(BUTTON);
        let later = ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.add(later)).inner;
        if later.clicked() { DialogFlow::Close } else { DialogFlow::Stay }
    }
}

impl RecoveryDialog {
    /// Asks first, since this cannot be undone.
    fn ask_to_discard(&self, studio: &mut Studio, index: usize) {
        let texts = &studio.texts;
        let title = self.found.borrow().get(index).map(|found| found.title.clone()).unwrap_or_default();
        let found = Rc::clone(&self.found);
        let title = texts.with("discard-title", &[("name", title.into())]);
        let question = QuestionDialog::new(title, texts.get("discard-text"))
            .choice(texts.get("cancel"), |_, _| {})
            .choice(texts.get("discard"), move |_, studio| {
                let mut found = found.borrow_mut();
                if index < found.len() {
                    recover::discard(studio, found.remove(index));
                }
            });
        studio.dialogs.open(question);
    }
}
