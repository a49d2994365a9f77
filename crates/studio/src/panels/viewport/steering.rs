//! The keys that steer the camera while they are held.

use egui::{Event, Key, Modifiers, Ui};

use crate::base::held_keys::{HeldKeys, KeyPress};

/// A key that is released within a frame counts as held for so long, seconds.
const TAP: f64 = 0.05;
/// No frame counts as longer than this, seconds: a window that was not drawn for a while does not jump ahead.
const LONGEST_FRAME: f64 = 0.1;

/// The listener of the keys that steer the camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum KeyListener {
    /// Nobody: a text is being typed, a dialog or a menu is open, another panel has the focus.
    #[default]
    Nobody,
    /// The picture: arrows, Page Up and Page Down.
    Picture,
    /// A flight: W, A, S, D, Q and E.
    Flight,
}

/// The direction in which a key moves or turns the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Heading {
    Right,
    Left,
    Up,
    Down,
    /// Ahead, or closer.
    Forward,
    /// Back, or farther away.
    Back,
}

impl Heading {
    /// What a key means to a listener.
    fn of(listener: KeyListener, key: Key) -> Option<Self> {
        Some(match (listener, key) {
            (KeyListener::Picture, Key::ArrowRight) | (KeyListener::Flight, Key::D) => Self::Right,
            (KeyListener::Picture, Key::ArrowLeft) | (KeyListener::Flight, Key::A) => Self::Left,
            (KeyListener::Picture, Key::ArrowUp) | (KeyListener::Flight, Key::E) => Self::Up,
            (KeyListener::Picture, Key::ArrowDown) | (KeyListener::Flight, Key::Q) => Self::Down,
            (KeyListener::Picture, Key::PageUp | Key::Plus | Key::Equals) | (KeyListener::Flight, Key::W) => {
                Self::Forward
            }
            (KeyListener::Picture, Key::PageDown | Key::Minus) | (KeyListener::Flight, Key::S) => Self::Back,
            _ => return None,
        })
    }
}

/// The camera moves of held keys. A key counts only if it was pressed for the present listener, and keeps the heading
/// of its press; whatever else takes over the keyboard ends all of them.
#[derive(Debug, Default)]
pub(crate) struct Steering {
    listener: KeyListener,
    held: Vec<(KeyPress, Heading)>,
    /// Pressed in this frame.
    tapped: Vec<Heading>,
    /// The length of this frame, seconds.
    frame: f64,
    /// The number of the last frame.
    pass: u64,
}

impl Steering {
    /// Takes up the keys of this frame. In a frame without a call, nobody listens.
    pub(crate) fn update(&mut self, ui: &Ui, keys: &HeldKeys, listener: KeyListener) {
        let pass = ui.ctx().cumulative_pass_nr();
        if listener != self.listener || pass > self.pass + 1 {
            self.held.clear();
        }
        (self.listener, self.pass) = (listener, pass);
        self.tapped.clear();
        ui.input(|input| {
            self.frame = f64::from(input.stable_dt).min(LONGEST_FRAME);
            for event in &input.events {
                let Event::Key { key, physical_key, pressed: true, repeat: false, modifiers } = event else {
                    continue;
                };
                if let Some(heading) = Heading::of(listener, *key).filter(|_| is_plain(modifiers)) {
                    self.tapped.push(heading);
                    self.held.extend(keys.stroke(*key, *physical_key).map(|stroke| (stroke, heading)));
                }
            }
            if !is_plain(&input.modifiers) || !input.focused {
                self.clear();
            }
        });
        self.held.retain(|(stroke, _)| keys.holds(*stroke));
    }

    /// Lets all keys go.
    pub(crate) fn clear(&mut self) {
        self.held.clear();
        self.tapped.clear();
    }

    /// For how many seconds of this frame the camera goes one way rather than the other.
    pub(crate) fn seconds(&self, way: Heading, opposite: Heading) -> f64 {
        self.seconds_of(way) - self.seconds_of(opposite)
    }

    fn seconds_of(&self, heading: Heading) -> f64 {
        if self.tapped.contains(&heading) {
            TAP.max(self.frame)
        } else if self.held.iter().any(|(_, held)| *held == heading) {
            self.frame
        } else {
            0.0
        }
    }
}

/// Whether no shortcut can be meant.
fn is_plain(modifiers: &Modifiers) -> bool {
    !modifiers.command && !modifiers.ctrl && !modifiers.alt
}
