//! Leaving the studio while pictures are not kept.

use egui::{Context, ViewportCommand};

use super::save::Saving;
use crate::app::Studio;
use crate::dialogs::question::Question;

/// What has been said about leaving.
#[derive(Default)]
pub(crate) struct Leaving {
    /// The pictures of this moment may be lost.
    is_agreed: bool,
    /// The window closes when a file has been written.
    is_waiting: bool,
}

impl Leaving {
    /// There are other pictures now.
    pub(super) fn forget(&mut self) {
        self.is_agreed = false;
    }
}

/// Holds the window back from closing until nobody misses a picture: once a frame.
pub(crate) fn hold_window(context: &Context, studio: &mut Studio) {
    let is_writing =
        studio.pictures.finished.iter().any(|finished| matches!(finished.saving, Saving::Writing(..)));
    if studio.pictures.leaving.is_waiting && !is_writing {
        studio.pictures.leaving.is_waiting = false;
        context.send_viewport_cmd(ViewportCommand::Close);
    }
    if !context.input(|input| input.viewport().close_requested()) {
        return;
    }
    if is_writing {
        context.send_viewport_cmd(ViewportCommand::CancelClose);
        studio.pictures.leaving.is_waiting = true;
        studio.toasts.info(studio.texts.get("picture-leave-waits"));
    } else if may_be_missed(studio) {
        context.send_viewport_cmd(ViewportCommand::CancelClose);
        if !studio.dialogs.is_any_open() {
            ask(studio);
        }
    }
}

/// Whether something would be lost that nobody has agreed to lose.
fn may_be_missed(studio: &Studio) -> bool {
    let pictures = &studio.pictures;
    let is_missed =
        pictures.is_rendering() || pictures.finished.iter().any(|finished| finished.kept.is_none());
    is_missed && !pictures.leaving.is_agreed
}

fn ask(studio: &mut Studio) {
    let texts = &studio.texts;
    let unkept = studio.pictures.finished.iter().filter(|finished| finished.kept.is_none()).count();
    let text = match studio.pictures.is_rendering() {
        true => texts.get("picture-leave-rendering").to_owned(),
        false => texts.with("picture-leave-unsaved", &[("count", unkept.into())]),
    };
    let question = Question::new(texts.get("picture-leave-title"), text)
        .choice(texts.get("picture-leave-stay"), |_, _| {})
        .choice(texts.get("picture-leave-go"), |context, studio| {
            studio.pictures.leaving.is_agreed = true;
            context.send_viewport_cmd(ViewportCommand::Close);
        });
    studio.dialogs.open(question);
}
