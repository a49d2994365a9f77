//! A question with a few answers.

use std::rc::{Rc, Weak};

use egui::{Context, Label, Ui};

use super::{Dialog, DialogFlow, body_ui, buttons};
use crate::base::texts::Texts;
use crate::shell::studio::Studio;

/// The action of an answer.
pub(crate) type AnswerAction = Box<dyn FnOnce(&Context, &mut Studio)>;

/// A dialog with a question; Esc chooses no answer.
pub(crate) struct QuestionDialog {
    title: String,
    text: String,
    choices: Vec<(String, AnswerAction)>,
    alive: Rc<()>,
}

impl QuestionDialog {
    /// Asks `title`, explained by `text`, both in the present language.
    pub(crate) fn new(title: impl Into<String>, text: impl Into<String>) -> Self {
        Self { title: title.into(), text: text.into(), choices: Vec::new(), alive: Rc::default() }
    }

    /// An answer; the first one is the default.
    pub(crate) fn choice(mut self, label: &str, act: impl FnOnce(&Context, &mut Studio) + 'static) -> Self {
        self.choices.push((label.to_owned(), Box::new(act)));
        self
    }

    /// Tells whether the question is still open.
    pub(crate) fn watch(&self) -> Weak<()> {
        Rc::downgrade(&self.alive)
    }
}

impl Dialog for QuestionDialog {
    fn title(&self, _texts: &Texts) -> String {
        self.title.clone()
    }

    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> DialogFlow {
        body_ui(ui, |ui| ui.add(Label::new(&self.text).wrap()));
        let labels: Vec<&str> = self.choices.iter().map(|(label, _)| label.as_str()).collect();
        let Some(pressed) = buttons(ui, &labels) else { return DialogFlow::Stay };
        let (_, act) = self.choices.swap_remove(pressed);
        act(ui.ctx(), studio);
        DialogFlow::Close
    }
}
