//! The question about unsaved changes, before a document is replaced or the studio ends.

use std::rc::Rc;

use egui::{Context, ViewportCommand};

use super::{has_unsaved_work, name, open, recover, save, show_example, show_fresh, show_opened};
use crate::shell::interruption::Interruption;
use crate::shell::pictures;
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::question::QuestionDialog;
use crate::shell::studio::documents::NextDocument;

/// Goes on to `next`; asks first if the document has unsaved work.
pub(crate) fn replace(context: &Context, studio: &mut Studio, next: NextDocument) {
    studio.editor.settle();
    if matches!(next, NextDocument::Quit) && pictures::hold(studio) {
        return;
    }
    if let Some(saving) = &mut studio.documents.saving {
        // What is being saved decides whether there is something to ask.
        saving.then(next);
    } else if has_unsaved_work(studio) {
        ask(studio, next);
    } else {
        go(context, studio, next);
    }
}

fn ask(studio: &mut Studio, next: NextDocument) {
    let texts = &studio.texts;
    let name = name(studio);
    let after = next.clone();
    let question = QuestionDialog::new(
        texts.with("unsaved-title", &[("name", name.clone().into())]),
        texts.with("unsaved-text", &[("name", name.into())]),
    )
    .choice(texts.get("save"), move |context, studio| save::save(context, studio, Some(after)))
    .choice(texts.get("cancel"), |_, _| {})
    .choice(texts.get("do-not-save"), move |context, studio| go(context, studio, next));
    studio.documents.asked_to_save = question.watch();
    studio.dialogs.open(question);
}

/// Goes on to `next`, whatever becomes of the document.
fn go(context: &Context, studio: &mut Studio, next: NextDocument) {
    if matches!(next, NextDocument::Show(_) | NextDocument::Example(_)) {
        studio.first_steps.hold_back();
    }
    match next {
        NextDocument::New => show_fresh(studio),
        NextDocument::Open(path) => open::begin(context, studio, &path),
        NextDocument::Show(opened) => show_opened(studio, Rc::unwrap_or_clone(opened)),
        NextDocument::Example(example) => show_example(studio, example),
        NextDocument::Recovered(recovered) => recover::show(studio, &recovered),
        NextDocument::Quit => {
            studio.documents.is_leaving = true;
            context.send_viewport_cmd(ViewportCommand::Close);
        }
    }
}

/// Holds the window back from closing until nothing can be lost.
pub(super) fn mind_close(context: &Context, studio: &mut Studio) {
    if studio.documents.interruption.as_ref().is_some_and(Interruption::is_asked)
        && !studio.documents.is_leaving
    {
        // Nobody is there to answer; what is unsaved is kept for the next start.
        studio.documents.is_leaving = true;
        studio.documents.autosave.hold();
        context.send_viewport_cmd(ViewportCommand::Close);
    }
    if !context.input(|input| input.viewport().close_requested()) || studio.documents.is_leaving {
        return;
    }
    if pictures::hold(studio) {
        context.send_viewport_cmd(ViewportCommand::CancelClose);
        return;
    }
    let is_asked = studio.documents.asked_to_save.strong_count() > 0;
    if is_asked || studio.documents.saving.is_some() || has_unsaved_work(studio) {
        context.send_viewport_cmd(ViewportCommand::CancelClose);
        if !is_asked {
            replace(context, studio, NextDocument::Quit);
        }
    } else {
        studio.documents.is_leaving = true;
    }
}
