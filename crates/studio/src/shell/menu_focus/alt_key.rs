//! The Alt key by itself, which leads to the menu bar on desktops.

use egui::{Context, Event, Key, Modifiers};

/// Tells presses of Alt alone from Alt as a modifier: with another key, in a drag, or when the system takes it to
/// switch windows.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AltKey {
    is_down: bool,
    /// The key went down by itself, and nothing else has been used since.
    is_alone: bool,
    /// The key came up alone. The loss of the focus that may come with it arrives up to a frame later.
    was_released: bool,
}

impl AltKey {
    /// A frame of input: whether Alt has been pressed and released alone.
    pub(super) fn is_tapped(&mut self, context: &Context) -> bool {
        let is_tapped = context.input(|input| {
            let was_released = std::mem::take(&mut self.was_released);
            let is_cancelled = self.take(&input.raw.events, input.pointer.any_down());
            was_released && !is_cancelled && input.focused
        });
        if self.was_released {
            context.request_repaint();
        }
        is_tapped
    }

    /// Takes the events of a frame; returns whether any of them uses the keyboard or the pointer for something else.
    fn take(&mut self, events: &[Event], is_pointer_down: bool) -> bool {
        let mut is_used = false;
        for event in events {
            match event {
                Event::ModifiersChanged(modifiers) => self.turn(*modifiers, is_pointer_down),
                Event::Key { key: Key::AltLeft, .. } | Event::PointerMoved(_) | Event::MouseMoved(_) => {}
                Event::Key { .. }
                | Event::Text(_)
                | Event::PointerButton { .. }
                | Event::MouseWheel { .. }
                | Event::Zoom(_)
                | Event::Touch { .. }
                | Event::WindowFocused(false) => {
                    is_used = true;
                    self.is_alone = false;
                    self.was_released = false;
                }
                _ => {}
            }
        }
        is_used
    }

    fn turn(&mut self, modifiers: Modifiers, is_pointer_down: bool) {
        let was_down = std::mem::replace(&mut self.is_down, modifiers.alt);
        let is_only = !modifiers.ctrl && !modifiers.shift && !modifiers.command && !modifiers.mac_cmd;
        self.was_released |= was_down && !modifiers.alt && self.is_alone && is_only;
        self.is_alone = modifiers.alt && is_only && (self.is_alone || !was_down && !is_pointer_down);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{PointerButton, Pos2};

    const DOWN: Event = Event::ModifiersChanged(Modifiers::ALT);
    const UP: Event = Event::ModifiersChanged(Modifiers::NONE);

    fn key(key: Key) -> Event {
        Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::ALT }
    }

    fn button(pressed: bool) -> Event {
        let button = PointerButton::Primary;
        Event::PointerButton { pos: Pos2::ZERO, button, pressed, modifiers: Modifiers::ALT }
    }

    /// Whether Alt counts as released alone after `events`, all in one frame or each in its own.
    fn taps(events: &[Event]) -> bool {
        let mut at_once = AltKey::default();
        at_once.take(events, false);
        let mut one_by_one = AltKey::default();
        for event in events {
            one_by_one.take(std::slice::from_ref(event), false);
        }
        assert_eq!(at_once.was_released, one_by_one.was_released, "{events:?}");
        at_once.was_released
    }

    #[test]
    fn alt_alone_is_a_tap() {
        assert!(taps(&[DOWN, UP]));
        assert!(taps(&[key(Key::AltLeft), DOWN, Event::PointerMoved(Pos2::ZERO), key(Key::AltLeft), UP]));
    }

    #[test]
    fn alt_as_a_modifier_is_none() {
        assert!(!taps(&[DOWN, key(Key::H), UP]));
        assert!(!taps(&[DOWN, button(true), button(false), UP]));
        assert!(!taps(&[DOWN, Event::Text("x".to_owned()), UP]));
        assert!(!taps(&[DOWN, Event::ModifiersChanged(Modifiers::ALT | Modifiers::SHIFT), DOWN, UP]));
        assert!(!taps(&[Event::ModifiersChanged(Modifiers::ALT | Modifiers::CTRL), UP]));
        let mut dragging = AltKey::default();
        dragging.take(&[DOWN], true);
        dragging.take(&[UP], false);
        assert!(!dragging.was_released, "it went down in a drag");
    }

    #[test]
    fn alt_that_switches_windows_is_none() {
        let lost = Event::WindowFocused(false);
        assert!(!taps(&[DOWN, lost.clone(), UP]));
        assert!(!taps(&[DOWN, UP, lost]));
    }
}
