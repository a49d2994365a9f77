//! The choice whether the graphics card draws the picture.

use catoptric_gpu::GpuChoice;
use catoptric_live::CardSource;

use crate::shell::studio::Studio;
use crate::state::card::{KnownCard, why};

impl Studio {
    /// Lets the card draw: a real one unless the settings say otherwise, a software driver only if they say so.
    pub(crate) fn choose_card(&mut self) {
        let is_real = self.card.known().is_some_and(|card| !card.is_software);
        if self.settings.uses_card.unwrap_or(is_real) {
            self.card.switch(&self.live, true);
        }
    }

    /// Lets the card that a page has draw the picture, called `name`: a real one unless the settings say otherwise, a
    /// software driver only if they say so. Its pictures come to the window through memory.
    pub fn use_page_card(&mut self, name: String, is_software: bool) {
        let called = name.clone();
        let source = move || CardSource::open(GpuChoice { software: true, name: None }, called.clone());
        self.card.take(Some(KnownCard { name, is_software, source: Box::new(source), window: None }));
        self.choose_card();
    }

    /// The name of the card of the window or the page, if it can draw the picture.
    pub fn card_name(&self) -> Option<&str> {
        self.card.known().map(|card| card.name.as_str())
    }
}

/// Lets the card draw, or the processor.
pub(crate) fn toggle(studio: &mut Studio) {
    let is_on = !studio.card.is_on();
    studio.card.switch(&studio.live, is_on);
    if studio.card.is_there() {
        studio.settings.uses_card = Some(is_on);
    }
}

/// Tells of a card that was lost: once a frame.
pub(crate) fn keep_up(studio: &mut Studio) {
    if let Some(error) = studio.card.take_loss(&studio.live) {
        let reason = why(&studio.texts, &error);
        studio.toasts.warning(studio.texts.with("card-lost-notice", &[("reason", reason.into())]));
    }
}
