//! The note about the open example, below the picture.

use catoptric_scene::Example;
use egui::text::LayoutJob;
use egui::{
    Align, Frame, Key, Label, Layout, Margin, Modifiers, Popup, Rect, RichText, ScrollArea, Stroke,
    TextStyle, Ui, UiBuilder, vec2,
};
use egui_material_icons::icons;

use crate::base::example_texts::example_title;
use crate::base::texts::Texts;
use crate::base::widgets::{icon_button, icon_ui};
use crate::base::{scripts, theme};

/// The least panel that the note fits into besides the picture, points.
const LEAST_WIDTH: f32 = 340.0;
const LEAST_HEIGHT: f32 = 330.0;
/// The note takes at most this share of the panel's height; more can be scrolled to.
const MOST_SHARE: f32 = 0.3;
/// Height of the line with the title, and the margins of the note, points.
const TITLE: f32 = 22.0;
const MARGIN: Margin = Margin { left: 12, right: 8, top: 6, bottom: 8 };
/// Room between the title and the text, and for the bar that scrolls the text, points.
const GAP: f32 = 2.0;
const SCROLL_BAR: f32 = 14.0;

/// The note about the document, if it is an example or was made of one.
#[derive(Debug, Default)]
pub(crate) struct ExampleNote {
    document: u64,
    example: Option<&'static Example>,
    is_closed: bool,
    /// Whether the panel had room for it.
    has_room: bool,
    /// Whether Esc meant something else in the last frame.
    is_esc_taken: bool,
}

impl ExampleNote {
    /// Whether it is open; `None` when there is nothing to say.
    pub(crate) fn is_open(&self) -> Option<bool> {
        self.example.map(|_| !self.is_closed)
    }

    /// Learns which example is open; once a frame. A document keeps its note when it is saved as a file. `is_busy` while
    /// Esc means something else.
    pub(crate) fn keep(&mut self, document: u64, example: Option<&'static Example>, is_busy: bool) {
        self.is_esc_taken |= is_busy;
        if self.document != document {
            *self = Self { document, has_room: self.has_room, example, ..Self::default() };
        }
    }

    /// Opens the note or closes it. Where there is no room for it, returns its title and text, to be told otherwise.
    pub(crate) fn toggle(&mut self, texts: &Texts) -> Option<(String, String)> {
        let example = self.example?;
        if self.has_room {
            self.is_closed = !self.is_closed;
            return None;
        }
        Some((title(texts, example), example.notice(texts.language().into())))
    }

    fn is_shown(&self) -> bool {
        self.is_open() == Some(true)
    }
}

fn title(texts: &Texts, example: &Example) -> String {
    let name = example_title(example, texts.language());
    texts.with("example-note-title", &[("name", name.into())])
}

/// Draws what the panel shows, and below it the note if it is open and has room.
pub(crate) fn note_below(ui: &mut Ui, texts: &Texts, note: &mut ExampleNote, above: impl FnOnce(&mut Ui)) {
    let room = ui.available_rect_before_wrap();
    note.has_room = room.width() >= LEAST_WIDTH && room.height() >= LEAST_HEIGHT;
    let shown = note.example.filter(|_| note.is_shown() && note.has_room);
    let Some(example) = shown else { return above(ui) };
    let notice = example.notice(texts.language().into());
    let width = room.width() - MARGIN.sum().x - SCROLL_BAR;
    let size = TextStyle::Body.resolve(ui.style()).size;
    let notice = scripts::job(&notice, size, ui.visuals().text_color());
    let mut wrapped = notice.clone();
    wrapped.wrap.max_width = width;
    let lines = ui.painter().layout_job(wrapped).size().y;
    let most = MOST_SHARE * room.height() - TITLE - GAP - MARGIN.sum().y;
    let height = TITLE + GAP + lines.min(most) + MARGIN.sum().y;
    let (picture, below) = room.split_top_bottom_at_y((room.bottom() - height).floor());
    ui.scope_builder(UiBuilder::new().max_rect(picture), above);
    let is_closed = note_ui(ui, below, &title(texts, example), notice, texts);
    // What Esc ends in the picture goes first.
    let is_escaped =
        !note.is_esc_taken && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    note.is_closed = is_closed || is_escaped;
    note.is_esc_taken = Popup::is_any_open(ui.ctx())
        || ui.memory(|memory| memory.focused().is_some() || memory.top_modal_layer().is_some())
        || ui.input(|input| input.pointer.any_down());
    ui.advance_cursor_after_rect(room);
}

/// Draws the note; returns whether it is to be closed.
fn note_ui(ui: &mut Ui, rect: Rect, title: &str, notice: LayoutJob, texts: &Texts) -> bool {
    let palette = theme::palette(ui.visuals());
    let frame = Frame::new().fill(palette.panel).inner_margin(MARGIN);
    let builder = UiBuilder::new().max_rect(rect).layout(Layout::top_down(Align::Min));
    let is_closed = ui.scope_builder(builder, |ui| {
        frame
            .show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = GAP;
                let is_closed = title_ui(ui, title, texts);
                ScrollArea::vertical().id_salt("example note").auto_shrink(false).show(ui, |ui| {
                    ui.set_width(ui.available_width() - SCROLL_BAR);
                    ui.add(Label::new(notice).wrap().selectable(true));
                });
                is_closed
            })
            .inner
    });
    ui.painter().hline(rect.x_range(), rect.top(), Stroke::new(1.0, palette.line));
    is_closed.inner
}

fn title_ui(ui: &mut Ui, title: &str, texts: &Texts) -> bool {
    let palette = theme::palette(ui.visuals());
    let size = vec2(ui.available_width(), TITLE);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        let is_closed = icon_button(ui, icons::ICON_CLOSE, texts.get("example-note-close"), false).clicked();
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            icon_ui(ui, icons::ICON_TIPS_AND_UPDATES, 16.0, palette.accent);
            ui.add(Label::new(RichText::new(title).strong()).truncate());
        });
        is_closed
    })
    .inner
}
