//! Windows over the window, which must be answered before anything else.
//!
//! A dialog is a type that implements [`Dialog`], in a file of its own in `dialogs/`; [`Dialogs::open`] opens it. One
//! that asks something more about itself opens another on top.

mod message;
pub(crate) mod question;
mod shield;

use egui::{
    Align, Button, Context, Frame, Key, Layout, Margin, Modal, Modifiers, Popup, RichText, ScrollArea,
    Stroke, Ui,
};

use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::thumbnails::Thumbnails;
use crate::shell::studio::Studio;
pub(crate) use message::MessageDialog;
use shield::ClickShield;

/// What a dialog has above and below its body (its title, its buttons and the margins), and the least that is left for
/// the body, points.
const BESIDE_BODY: f32 = 150.0;
const LEAST_BODY: f32 = 60.0;

/// The fate of a dialog after a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DialogFlow {
    /// The dialog stays open.
    Stay,
    /// The dialog has been answered, or is no longer needed.
    Close,
}

/// A window over the window.
pub(crate) trait Dialog {
    /// What stands above it; also its accessible name.
    fn title(&self, texts: &Texts) -> String;

    /// The width of the content, points; less in a small window.
    fn width(&self) -> f32 {
        420.0
    }

    /// Draws what stands below the title, the [`buttons`] last, and does what they say.
    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> DialogFlow;
}

/// The open dialogs.
#[derive(Default)]
pub(crate) struct Dialogs {
    /// The last one is on top and has the keyboard.
    open: Vec<DialogSlot>,
    /// Pictures of the examples.
    pub(crate) thumbnails: Thumbnails<usize>,
    /// Where a dialog has just been closed by a click.
    shield: Option<ClickShield>,
}

struct DialogSlot {
    /// Tells it from the other open ones, once it has been drawn.
    number: Option<usize>,
    is_new: bool,
    dialog: Box<dyn Dialog>,
}

impl Dialogs {
    /// Opens `dialog` on top of the others.
    pub(crate) fn open(&mut self, dialog: impl Dialog + 'static) {
        self.open.push(DialogSlot { number: None, is_new: true, dialog: Box::new(dialog) });
    }

    /// The device of the window is another.
    pub(crate) fn forget_textures(&mut self) {
        self.thumbnails.forget_textures();
    }

    /// Whether any dialog is open; shortcuts rest then.
    pub(crate) fn is_any_open(&self) -> bool {
        !self.open.is_empty()
    }
}

/// Draws the open dialogs.
pub(crate) fn dialogs_ui(ui: &mut Ui, studio: &mut Studio) {
    let mut open = std::mem::take(&mut studio.dialogs.open);
    studio.dialogs.shield = studio.dialogs.shield.filter(|shield| shield.show(ui.ctx()));
    number_new(&mut open);
    let top = open.last().and_then(|opened| opened.number);
    open.retain_mut(|opened| {
        let is_top = top == opened.number;
        show(ui.ctx(), studio, opened, is_top) == DialogFlow::Stay
    });
    // Those that were opened meanwhile lie on top.
    open.append(&mut studio.dialogs.open);
    studio.dialogs.open = open;
}

/// Gives new dialogs the least numbers that are free, for the toolkit never forgets what it kept for a number.
fn number_new(open: &mut [DialogSlot]) {
    for index in 0..open.len() {
        let least = (0..).find(|number| open.iter().all(|other| other.number != Some(*number)));
        if let Some(opened) = open.get_mut(index) {
            opened.number = opened.number.or(least);
        }
    }
}

/// True if Enter presses the default button, for [`buttons`].
#[derive(Clone, Copy)]
struct EnterDefault(bool);

fn show(context: &Context, studio: &mut Studio, opened: &mut DialogSlot, is_top: bool) -> DialogFlow {
    let is_new = std::mem::take(&mut opened.is_new);
    if is_new {
        // Whatever lies below must not hear the keys any more.
        context.memory_mut(|memory| memory.focused().map(|focused| memory.surrender_focus(focused)));
    }
    let has_keys = is_top && !Popup::is_any_open(context);
    // On another button, Enter presses that one.
    let is_typing = context.text_edit_focused() || context.memory(|memory| memory.focused().is_none());
    let enter = has_keys && is_typing && context.input(|input| input.key_pressed(Key::Enter));
    let enter_id = egui::Id::unique("enter decides");
    context.data_mut(|data| data.insert_temp(enter_id, EnterDefault(enter)));

    let title = opened.dialog.title(&studio.texts);
    let id = egui::Id::unique(("dialog", opened.number));
    // Not in the size of the one that had this number before, and not in its place.
    let area = Modal::default_area(id).accessible_name(&title).sizing_pass(is_new);
    if is_new {
        context.move_to_top(area.layer());
    }
    let style = context.global_style();
    let frame = Frame::window(&style).inner_margin(Margin::symmetric(20, 16));
    let flow = Modal::new(id)
        .area(area)
        .frame(frame)
        .show(context, |ui| {
            ui.set_width(opened.dialog.width().min(ui.ctx().content_rect().width() - 80.0));
            ui.heading(RichText::new(&title).strong());
            ui.add_space(6.0);
            opened.dialog.ui(ui, studio)
        })
        .inner;
    let escape = || context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    if flow == DialogFlow::Close {
        studio.dialogs.shield = ClickShield::raise(context).or(studio.dialogs.shield);
    }
    if flow == DialogFlow::Close || has_keys && escape() {
        context.request_repaint();
        return DialogFlow::Close;
    }
    DialogFlow::Stay
}

/// Draws the body of a dialog that may be larger than the window: it scrolls, and the buttons below it stay in sight.
pub(crate) fn body_ui<R>(ui: &mut Ui, body: impl FnOnce(&mut Ui) -> R) -> R {
    let room = (ui.ctx().content_rect().height() - BESIDE_BODY).max(LEAST_BODY);
    let width = ui.available_width();
    // As high as it needs in the first frame, not a little more in each.
    let scroll =
        ScrollArea::both().id_salt("body").min_scrolled_height(room).max_height(room).max_width(width);
    let shown = scroll.show(ui, |ui| {
        ui.set_width(width);
        body(ui)
    });
    shown.inner
}

/// Whether Enter was pressed: it is then not taken for the default button of the dialog that is being drawn.
pub(crate) fn withhold_enter(ui: &Ui) -> bool {
    let enter_id = egui::Id::unique("enter decides");
    ui.data_mut(|data| {
        let enter = data.get_temp::<EnterDefault>(enter_id).is_some_and(|enter| enter.0);
        data.insert_temp(enter_id, EnterDefault(false));
        enter
    })
}

/// Draws the row of buttons of a dialog, the first label at the right as the default, which Enter presses, the others
/// to the left of it. Returns which one was pressed.
pub(crate) fn buttons(ui: &mut Ui, labels: &[&str]) -> Option<usize> {
    buttons_if(ui, labels, true)
}

/// Draws the row of buttons of a dialog; the default button can be pressed only if `is_ready`.
pub(crate) fn buttons_if(ui: &mut Ui, labels: &[&str], is_ready: bool) -> Option<usize> {
    let palette = theme::palette(ui.visuals());
    let enter_id = egui::Id::unique("enter decides");
    let enter = ui.data(|data| data.get_temp::<EnterDefault>(enter_id)).is_some_and(|enter| enter.0);
    let mut pressed = None;
    ui.add_space(10.0);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        for (index, label) in labels.iter().enumerate() {
            let mut button = Button::new(*label).min_size(egui::vec2(84.0, 28.0));
            if index == 0 {
                button = button.fill(palette.selection).stroke(Stroke::new(1.0, palette.accent));
            }
            let response = ui.add_enabled(index > 0 || is_ready, button);
            if index == 0 && is_ready && ui.memory(|memory| memory.focused().is_none()) {
                response.request_focus();
            }
            if response.clicked() || index == 0 && is_ready && enter {
                pressed = Some(index);
            }
        }
    });
    pressed
}
