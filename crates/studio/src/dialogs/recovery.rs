//! Unsaved scenes of a studio that did not end well.

use std::cell::RefCell;
use std::rc::Rc;

use egui::{Align, Button, Frame, Label, Layout, Margin, RichText, ScrollArea, Ui};

use super::files::age;
use super::question::Question;
use super::{Dialog, Flow, buttons};
use crate::app::Studio;
use crate::documents::{self, Found};
use crate::texts::Texts;
use crate::theme;

/// Offers what was left behind.
pub(crate) struct Recovery {
    found: Rc<RefCell<Vec<Found>>>,
}

impl Recovery {
    /// Offers `found`, at least one.
    pub(crate) fn new(found: Vec<Found>) -> Self {
        Self { found: Rc::new(RefCell::new(found)) }
    }

    fn row(ui: &mut Ui, studio: &Studio, found: &Found) -> Option<Act> {
        let texts = &studio.texts;
        let palette = theme::palette(ui.visuals());
        let mut act = None;
        Frame::new().fill(palette.field).corner_radius(6.0).inner_margin(Margin::symmetric(12, 8)).show(
            ui,
            |ui| {
                ui.set_width(ui.available_width());
                ui.horizontal(|ui| {
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        let restore = Button::new(texts.get("restore")).fill(palette.selection);
                        if named(ui.add(restore), texts.get("restore"), &found.title).clicked() {
                            act = Some(Act::Restore);
                        }
                        if named(ui.button(texts.get("discard")), texts.get("discard"), &found.title)
                            .clicked()
                        {
                            act = Some(Act::Discard);
                        }
                        ui.with_layout(Layout::top_down(Align::Min), |ui| {
                            ui.add(Label::new(RichText::new(&found.title).strong()).truncate());
                            let place = match &found.path {
                                Some(path) => path.display().to_string(),
                                None => texts.get("recovery-no-file").to_owned(),
                            };
                            ui.add(Label::new(RichText::new(place).weak()).truncate());
                            ui.weak(age(texts, found.written));
                        });
                    });
                });
            },
        );
        act
    }
}

enum Act {
    Restore,
    Discard,
}

fn named(response: egui::Response, act: &str, title: &str) -> egui::Response {
    let name = format!("{act}: {title}");
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &name));
    response
}

impl Dialog for Recovery {
    fn title(&self, texts: &Texts) -> String {
        texts.get("recovery-title").to_owned()
    }

    fn width(&self) -> f32 {
        560.0
    }

    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> Flow {
        ui.add(Label::new(studio.texts.get("recovery-text")).wrap());
        ui.add_space(4.0);
        let mut act = None;
        ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
            for (index, found) in self.found.borrow().iter().enumerate() {
                if let Some(wanted) = Self::row(ui, studio, found) {
                    act = Some((index, wanted));
                }
            }
        });
        match act {
            Some((index, Act::Restore)) => {
                if let Some(found) = self.found.borrow().get(index) {
                    documents::restore(ui.ctx(), studio, found);
                }
                return Flow::Close;
            }
            Some((index, Act::Discard)) => self.ask_to_discard(studio, index),
            None if self.found.borrow().is_empty() => return Flow::Close,
            None => {}
        }
        match buttons(ui, &[studio.texts.get("decide-later")]) {
            Some(_) => Flow::Close,
            None => Flow::Stay,
        }
    }
}

impl Recovery {
    /// Asks first, since this cannot be undone.
    fn ask_to_discard(&self, studio: &mut Studio, index: usize) {
        let texts = &studio.texts;
        let title = self.found.borrow().get(index).map(|found| found.title.clone()).unwrap_or_default();
        let found = Rc::clone(&self.found);
        let title = texts.with("discard-title", &[("name", title.into())]);
        let question = Question::new(title, texts.get("discard-text"))
            .choice(texts.get("cancel"), |_, _| {})
            .choice(texts.get("discard"), move |_, studio| {
                let mut found = found.borrow_mut();
                if index < found.len() {
                    documents::discard(studio, found.remove(index));
                }
            });
        studio.dialogs.open(question);
    }
}
