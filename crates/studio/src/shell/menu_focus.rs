//! The keyboard in the menu bar: F10 or Alt leads to it, arrows walk along it and between open menus, Esc leaves.

mod alt_key;

use egui::{Context, EventFilter, FocusDirection, Id, Key, Modifiers, Popup, Response};

use alt_key::AltKey;

/// A button of the bar and the menu that it opens.
#[derive(Clone, Copy, Debug)]
struct BarButton {
    id: Id,
    menu: Id,
}

/// An entry of an open menu of the bar.
#[derive(Clone, Copy, Debug)]
struct OpenEntry {
    id: Id,
    /// Whether it opens a menu of its own.
    is_submenu: bool,
}

/// The keyboard focus in the menu bar.
#[derive(Debug, Default)]
pub(crate) struct MenuFocus {
    alt: AltKey,
    /// The buttons of the bar as they were drawn last, from left to right.
    buttons: Vec<BarButton>,
    /// The entries of the open menu as they were drawn last, from top to bottom; those of submenus are not among them.
    entries: Vec<OpenEntry>,
    /// The bar is to have the keyboard.
    is_wanted: bool,
    /// The first entry of the open menu is to have it.
    enters_menu: bool,
    /// Whether the bar or one of its menus has it.
    is_active: bool,
    /// What had it before.
    before: Option<Id>,
}

impl MenuFocus {
    /// Gives the keyboard to the bar; takes it away again if the bar has it.
    pub(crate) fn toggle(&mut self, context: &Context) {
        if self.is_active {
            self.leave(context);
        } else {
            self.before = context.memory(egui::Memory::focused);
            self.is_wanted = true;
        }
    }

    /// Whether keys are for the bar or one of its menus.
    pub(crate) fn is_active(&self) -> bool {
        self.is_active
    }

    /// Whether Alt was pressed and released alone, in this frame.
    pub(crate) fn is_alt_tapped(&mut self, context: &Context) -> bool {
        let is_tapped = self.alt.is_tapped(context);
        // Option chooses letters on a Mac, whose menus are elsewhere.
        is_tapped && !context.os().is_mac()
    }

    /// What the keys mean before the bar is drawn.
    pub(super) fn begin(&mut self, context: &Context) {
        if std::mem::take(&mut self.is_wanted) {
            match self.buttons.first() {
                Some(first) => {
                    context.memory_mut(|memory| memory.request_focus(first.id));
                    self.is_active = true;
                }
                None => self.is_wanted = true,
            }
        } else if self.is_active && take(context, Key::Escape) {
            self.leave(context);
        } else {
            self.walk(context);
        }
        self.buttons.clear();
        self.entries.clear();
    }

    /// Takes note of a button of the bar.
    pub(super) fn add_button(&mut self, response: &Response) {
        if response.has_focus() {
            // Arrows are for the bar.
            let filter =
                EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
            response.ctx.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        }
        self.buttons.push(BarButton { id: response.id, menu: Popup::default_response_id(response) });
    }

    /// Takes note of an entry of an open menu, and gives it the keyboard if it is the first to get it.
    pub(super) fn add_entry(&mut self, response: &Response, is_submenu: bool) {
        if response.enabled() {
            if std::mem::take(&mut self.enters_menu) {
                response.request_focus();
            }
            self.entries.push(OpenEntry { id: response.id, is_submenu });
        }
    }

    /// Finds out whether the bar still has the keyboard.
    pub(super) fn end(&mut self, context: &Context) {
        let focused = context.memory(egui::Memory::focused);
        let is_open = self.open_menu(context).is_some();
        let is_in_bar = self.buttons.iter().any(|button| Some(button.id) == focused);
        self.is_active = is_in_bar || is_open && focused.is_some() || self.is_wanted;
        self.enters_menu &= is_open;
        if !self.is_active {
            // The keyboard went elsewhere by itself.
            self.before = None;
        }
    }

    /// Back to what had the keyboard before; open menus close.
    fn leave(&mut self, context: &Context) {
        self.is_active = false;
        if self.open_menu(context).is_some() {
            Popup::close_all(context);
        }
        context.memory_mut(|memory| {
            if let Some(focused) = memory.focused() {
                memory.surrender_focus(focused);
            }
            if let Some(before) = self.before.take() {
                memory.request_focus(before);
            }
        });
    }

    /// Which menu of the bar is open.
    fn open_menu(&self, context: &Context) -> Option<usize> {
        self.buttons.iter().position(|button| Popup::is_id_open(context, button.menu))
    }

    fn walk(&mut self, context: &Context) {
        let focused = context.memory(egui::Memory::focused);
        let in_bar = self.buttons.iter().position(|button| Some(button.id) == focused);
        let open = self.open_menu(context);
        let Some(place) = open.or(in_bar) else { return };
        let entry = self.entries.iter().find(|entry| Some(entry.id) == focused);
        let is_in_submenu = focused.is_some() && in_bar.is_none() && entry.is_none();
        if in_bar.is_some() && (open.is_none() || entry.is_none()) {
            // Enter and the space bar press the button, which opens the menu, or closes it.
            let opens =
                [Key::Enter, Key::Space].into_iter().any(|key| pressed(context, key)) && open.is_none();
            if opens {
                self.enters_menu = true;
                return;
            }
            if take(context, Key::ArrowDown) || take(context, Key::ArrowUp) {
                self.open(context, place, true);
                return;
            }
        }
        if open.is_some() && self.buttons.len() < 2 {
            // The menus are folded into one, and the toolkit walks through it.
            return;
        }
        // Left closes a submenu, and right opens one; all else is between the menus.
        if !is_in_submenu && take(context, Key::ArrowLeft) {
            self.step(context, place.checked_sub(1), open.is_some());
        } else if !entry.is_some_and(|entry| entry.is_submenu) && take(context, Key::ArrowRight) {
            self.step(context, Some(place + 1), open.is_some());
        }
    }

    /// Goes to the button at `place`, or around to the other end of the bar.
    fn step(&mut self, context: &Context, place: Option<usize>, is_open: bool) {
        let last = self.buttons.len().saturating_sub(1);
        let place = place.map_or(last, |place| if place > last { 0 } else { place });
        if is_open {
            self.open(context, place, true);
        } else if let Some(button) = self.buttons.get(place) {
            context.memory_mut(|memory| memory.request_focus(button.id));
        }
    }

    fn open(&mut self, context: &Context, place: usize, enters: bool) {
        let Some(button) = self.buttons.get(place) else { return };
        Popup::open_id(context, button.menu);
        context.memory_mut(|memory| memory.request_focus(button.id));
        self.enters_menu = enters;
        context.request_repaint();
    }
}

fn pressed(context: &Context, key: Key) -> bool {
    context.input(|input| input.key_pressed(key) && input.modifiers.is_none())
}

/// Whether `key` was pressed; then nothing else sees it, nor does the toolkit move the focus by it.
fn take(context: &Context, key: Key) -> bool {
    let is_pressed = context.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    if is_pressed {
        context.memory_mut(|memory| memory.move_focus(FocusDirection::None));
    }
    is_pressed
}
