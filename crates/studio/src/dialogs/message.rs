//! Something that must be read before going on.

use egui::{Label, Ui};

use super::{Dialog, Flow, buttons};
use crate::app::Studio;
use crate::texts::Texts;

/// A dialog that only tells something.
pub(crate) struct Message {
    title: String,
    text: String,
}

impl Message {
    /// Tells `text` below `title`, both in the present language.
    pub(crate) fn new(title: impl Into<String>, text: impl Into<String>) -> Self {
        Self { title: title.into(), text: text.into() }
    }
}

impl Dialog for Message {
    fn title(&self, _texts: &Texts) -> String {
        self.title.clone()
    }

    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> Flow {
        let size = egui::TextStyle::Body.resolve(ui.style()).size;
        let text = crate::scripts::job(&self.text, size, ui.visuals().text_color());
        ui.add(Label::new(text).wrap().selectable(true));
        match buttons(ui, &[studio.texts.get("ok")]) {
            Some(_) => Flow::Close,
            None => Flow::Stay,
        }
    }
}
