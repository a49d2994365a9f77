//! What becomes of changes of the open file by other programs.

use std::sync::Arc;

use egui::{Align, Context, Event, Frame, Label, Layout, Margin, Panel, Ui};
use egui_material_icons::icons;

use super::{has_unsaved_work, open};
use crate::base::theme;
use crate::base::widgets::icon_ui;
use crate::base::words::name_of;
use crate::shell::disk::OverwriteRule;
use crate::shell::studio::Studio;
use crate::shell::studio::watch::{ExternalChanges, FileChange, FileWatch, WatchedFile};

/// Looks at the file of the document, unless it is being read or written here.
pub(super) fn keep(context: &Context, studio: &mut Studio) {
    let known = known(studio);
    let documents = &mut studio.documents;
    let outside = &mut documents.outside;
    let is_watched = match (&outside.watch, &known) {
        (Some(watch), Some(known)) => watch.known.is_same(known),
        (None, None) => true,
        _ => false,
    };
    if !is_watched {
        *outside = ExternalChanges::default();
        outside.watch = known.and_then(|known| FileWatch::start(context, known));
    }
    let Some(watch) = &outside.watch else { return };
    if context.input(|input| input.raw.events.contains(&Event::WindowFocused(true))) {
        watch.look();
    }
    for change in watch.changes.try_iter() {
        match change {
            FileChange::Touched(stamp) => {
                documents.may = Some(OverwriteRule::Update(stamp));
                outside.is_rewritten = false;
            }
            FileChange::Rewritten => outside.is_rewritten = true,
        }
    }
}

fn known(studio: &Studio) -> Option<WatchedFile> {
    let documents = &studio.documents;
    let (Some(OverwriteRule::Update(stamp)), None, None) =
        (documents.may, &documents.saving, &documents.reading)
    else {
        return None;
    };
    let (path, text) = (studio.editor.path()?.to_owned(), Arc::clone(documents.text_on_disk.as_ref()?));
    Some(WatchedFile { document: documents.number, path, stamp, text })
}

/// Draws the banner that offers to reload a file that another program has changed.
pub(super) fn banner_ui(ui: &mut Ui, studio: &mut Studio) {
    if !studio.documents.outside.is_rewritten {
        return;
    }
    let has_changes = has_unsaved_work(studio);
    let texts = &studio.texts;
    let name = studio.editor.path().map(name_of).unwrap_or_default();
    let key = if has_changes { "outside-changed-both" } else { "outside-changed" };
    let text = texts.with(key, &[("name", name.into())]);
    let palette = theme::palette(ui.visuals());
    let frame = Frame::new().fill(palette.field).inner_margin(Margin::symmetric(10, 4));
    let (mut reloads, mut keeps) = (false, false);
    Panel::top("changed outside").frame(frame).show_separator_line(false).show(ui, |ui| {
        ui.horizontal(|ui| {
            icon_ui(ui, icons::ICON_SYNC_PROBLEM, 16.0, palette.warning);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let tip = |key| texts.tip(key).unwrap_or_default();
                keeps = ui.button(texts.get("outside-keep")).on_hover_text(tip("outside-keep")).clicked();
                reloads =
                    ui.button(texts.get("outside-reload")).on_hover_text(tip("outside-reload")).clicked();
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    ui.add(Label::new(text).truncate());
                });
            });
        });
    });
    if reloads {
        open::reload(ui.ctx(), studio);
    }
    if reloads || keeps {
        // The next change is offered anew, and saving asks before it replaces this one.
        studio.documents.outside.is_rewritten = false;
    }
}
