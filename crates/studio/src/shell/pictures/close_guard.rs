//! The question about unsaved pictures, before the studio ends.

use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::question::QuestionDialog;
use crate::shell::studio::pictures::{FinishedPicture, PictureSaveState, SavedPlace};
use crate::state::command::FileCommand;

/// Whether the studio must not be left yet, since a picture would be lost that nobody has agreed to lose. Asks then,
/// or waits for the file being written, and leaves afterwards.
pub(crate) fn hold(studio: &mut Studio) -> bool {
    let pictures = &mut studio.pictures;
    if pictures.finished.iter().any(|finished| matches!(finished.saving, PictureSaveState::Writing(..))) {
        pictures.close_guard.is_waiting = true;
        studio.toasts.info(studio.texts.get("picture-leave-waits"));
        return true;
    }
    // On some systems the clipboard loses what the studio has put there as soon as the studio is gone.
    let is_in_file = |finished: &&FinishedPicture| matches!(finished.kept, Some(SavedPlace::File(_)));
    let unkept = pictures.finished.iter().filter(|finished| !is_in_file(finished)).count();
    if pictures.close_guard.is_agreed || (unkept == 0 && !pictures.is_rendering()) {
        return false;
    }
    if pictures.close_guard.asked.strong_count() == 0 {
        ask(studio, unkept);
    }
    true
}

/// Leaves when the last file has been written.
pub(super) fn poll(studio: &mut Studio) {
    let pictures = &mut studio.pictures;
    let is_writing =
        pictures.finished.iter().any(|finished| matches!(finished.saving, PictureSaveState::Writing(..)));
    if pictures.close_guard.is_waiting && !is_writing {
        pictures.close_guard.is_waiting = false;
        studio.run(FileCommand::Quit);
    }
}

fn ask(studio: &mut Studio, unkept: usize) {
    let texts = &studio.texts;
    let text = if studio.pictures.is_rendering() {
        texts.get("picture-leave-rendering").to_owned()
    } else {
        texts.with("picture-leave-unsaved", &[("count", unkept.into())])
    };
    let question = QuestionDialog::new(texts.get("picture-leave-title"), text)
        .choice(texts.get("picture-leave-stay"), |_, _| {})
        .choice(texts.get("picture-leave-go"), |_, studio| {
            studio.pictures.close_guard.is_agreed = true;
            studio.run(FileCommand::Quit);
        });
    studio.pictures.close_guard.asked = question.watch();
    studio.dialogs.open(question);
}
