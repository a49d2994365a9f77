//! A dialog with a message.

use egui::{Label, Ui};

use super::{Dialog, DialogFlow, body_ui, buttons};
use crate::base::texts::Texts;
use crate::shell::studio::Studio;

/// A dialog with a message and one button.
pub(crate) struct MessageDialog {
    title: String,
    text: String,
}

impl MessageDialog {
    /// Tells `text` below `title`, both in the present language.
    pub(crate) fn new(title: impl Into<String>, text: impl Into<String>) -> Self {
        Self { title: title.into(), text: text.into() }
    }
}

impl Dialog for MessageDialog {
    fn title(&self, _texts: &Texts) -> String {
        self.title.clone()
    }

    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> DialogFlow {
        let size = egui::TextStyle::Body.resolve(ui.style()).size;
        let text = crate::base::scripts::job(&self.text, size, ui.visuals().text_color());
        body_ui(ui, |ui| ui.add(Label::new(text).wrap().selectable(true)));
        match buttons(ui, &[studio.texts.get("ok")]) {
            Some(_) => DialogFlow::Close,
            None => DialogFlow::Stay,
        }
    }
}
