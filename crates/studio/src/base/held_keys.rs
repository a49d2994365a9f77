//! The held keys, from the events of keys.
//!
//! egui keeps its own set by the logical key, and a release does not always have that of its press: `=` with Shift is
//! pressed as Plus and released as Equals once Shift is up. Releases can be lost as well, to window managers, input
//! methods and dialogs of the system. Here a key is the place on the keyboard, where that is known, and one that has
//! repeated and does so no more counts as released. Where another key was pressed after it, so that nobody can tell, it
//! counts as released after a while, and at once when Escape is pressed.

use egui::{Event, Key};

/// The shortest silence after which a key that repeats counts as released, seconds.
const LEAST_SILENCE: f64 = 0.75;
/// How many repeats a key must have missed to count as released.
const MISSED_REPEATS: f64 = 3.0;
/// A key that is known to repeat does so for the first time within this time, seconds.
const FIRST_REPEAT: f64 = 2.5;
/// A key that is not expected to repeat counts as released after this time without any sign of it, seconds.
const LONGEST_UNSEEN: f64 = 15.0;

/// One press of a key, with what follows until its release.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct KeyPress(u64);

/// A key between its press and its release.
#[derive(Clone, Copy, Debug)]
struct HeldKey {
    stroke: KeyPress,
    logical: Key,
    /// The place on the keyboard, if the system tells it.
    physical: Option<Key>,
    /// When it was pressed or has repeated last, seconds.
    last: f64,
    /// How long after the event before that.
    interval: Option<f64>,
    /// Whether it should repeat: systems repeat only the key that was pressed last.
    is_expected: bool,
    /// Whether it has stopped repeating, so that its release must have been lost.
    is_silent: bool,
}

/// The keys that are held.
#[derive(Debug, Default)]
pub(crate) struct HeldKeys {
    keys: Vec<HeldKey>,
    /// The number of the last stroke.
    strokes: u64,
    /// Keys that have been seen to repeat.
    repeating: Vec<Key>,
    /// Whether the command key of a Mac is held.
    has_command: bool,
}

impl HeldKeys {
    /// Takes up the events of a frame, at the time `now` in seconds, and corrects which presses of them are repeats.
    pub(crate) fn take_up(&mut self, events: &mut [Event], now: f64) {
        for event in events {
            match event {
                Event::Key { key, physical_key, pressed: true, repeat, .. } => {
                    if *key == Key::Escape {
                        self.keys.retain(|held| held.logical == Key::Escape);
                    }
                    *repeat = self.press(*key, *physical_key, now);
                }
                Event::Key { key, physical_key, pressed: false, .. } => {
                    self.keys.retain(|held| !held.ends_with(*key, *physical_key));
                }
                Event::ModifiersChanged(modifiers) => {
                    // On some systems this ends the repeating of other keys.
                    self.expect_no_repeats();
                    // macOS tells no releases while its command key is held.
                    if std::mem::replace(&mut self.has_command, modifiers.mac_cmd) != modifiers.mac_cmd {
                        self.keys.clear();
                    }
                }
                Event::WindowFocused(_) => self.keys.clear(),
                _ => {}
            }
        }
        for held in &mut self.keys {
            let is_known = held.interval.is_some() || self.repeating.contains(&held.place());
            let silence = now - held.last;
            held.is_silent |= if held.is_expected {
                is_known && silence > held.patience()
            } else {
                silence > LONGEST_UNSEEN
            };
        }
    }

    /// The present press of a key, if it is held.
    pub(crate) fn stroke(&self, logical: Key, physical: Option<Key>) -> Option<KeyPress> {
        let held = self.keys.iter().find(|held| held.is(logical, physical) && !held.is_silent);
        held.map(|held| held.stroke)
    }

    /// Whether a stroke goes on.
    pub(crate) fn holds(&self, stroke: KeyPress) -> bool {
        self.keys.iter().any(|held| held.stroke == stroke && !held.is_silent)
    }

    /// Takes up a press; returns whether it is the repeat of one before.
    fn press(&mut self, logical: Key, physical: Option<Key>, now: f64) -> bool {
        // Of another key than the last one, there are no repeats: its release was lost.
        let last = KeyPress(self.strokes);
        if let Some(held) = self.keys.iter_mut().find(|held| held.is(logical, physical))
            && held.stroke == last
        {
            held.interval = Some(now - held.last);
            (held.last, held.is_expected, held.is_silent) = (now, true, false);
            let place = held.place();
            if !self.repeating.contains(&place) {
                self.repeating.push(place);
            }
            return true;
        }
        self.keys.retain(|held| !held.is(logical, physical));
        self.expect_no_repeats();
        self.strokes += 1;
        self.keys.push(HeldKey {
            stroke: KeyPress(self.strokes),
            logical,
            physical,
            last: now,
            interval: None,
            is_expected: true,
            is_silent: false,
        });
        false
    }

    fn expect_no_repeats(&mut self) {
        self.keys.iter_mut().for_each(|held| held.is_expected = false);
    }
}

impl HeldKey {
    /// The identity of the key.
    fn place(&self) -> Key {
        self.physical.unwrap_or(self.logical)
    }

    /// Whether it is the key of these names.
    fn is(&self, logical: Key, physical: Option<Key>) -> bool {
        match (self.physical, physical) {
            (Some(own), Some(other)) => own == other,
            _ => self.logical == logical,
        }
    }

    /// Whether a release of the key of these names ends it. In doubt it does.
    fn ends_with(&self, logical: Key, physical: Option<Key>) -> bool {
        self.logical == logical || self.is(logical, physical)
    }

    /// How long it may be without a repeat, seconds.
    fn patience(&self) -> f64 {
        self.interval.map_or(FIRST_REPEAT, |interval| LEAST_SILENCE.max(MISSED_REPEATS * interval))
    }
}

#[cfg(test)]
mod tests {
    use egui::Modifiers;

    use super::*;

    fn key(logical: Key, physical: Option<Key>, pressed: bool) -> Event {
        // As egui has it, which may be wrong.
        Event::Key { key: logical, physical_key: physical, pressed, repeat: true, modifiers: Modifiers::NONE }
    }

    /// Takes up one event; whether it is a repeat.
    fn take(keys: &mut HeldKeys, event: Event, now: f64) -> bool {
        let mut events = [event];
        keys.take_up(&mut events, now);
        matches!(events, [Event::Key { repeat: true, pressed: true, .. }])
    }

    fn is_held(keys: &HeldKeys, logical: Key) -> bool {
        keys.stroke(logical, None).is_some()
    }

    #[test]
    fn a_release_under_another_name_is_a_release() {
        let mut keys = HeldKeys::default();
        assert!(!take(&mut keys, key(Key::Plus, Some(Key::Equals), true), 0.0));
        assert!(is_held(&keys, Key::Plus));
        take(&mut keys, key(Key::Equals, Some(Key::Equals), false), 0.1);
        assert!(!is_held(&keys, Key::Plus));
        assert!(!take(&mut keys, key(Key::Plus, Some(Key::Equals), true), 0.2), "a press and no repeat");
        // The plus of the numeric pad has another place.
        take(&mut keys, key(Key::Plus, Some(Key::Plus), false), 0.3);
        assert!(!is_held(&keys, Key::Plus), "in doubt it is released");
    }

    #[test]
    fn a_window_that_loses_the_focus_holds_no_keys() {
        let mut keys = HeldKeys::default();
        take(&mut keys, key(Key::W, Some(Key::W), true), 0.0);
        take(&mut keys, key(Key::A, None, true), 0.0);
        let stroke = keys.stroke(Key::W, Some(Key::W)).unwrap();
        assert!(keys.holds(stroke) && is_held(&keys, Key::A));
        take(&mut keys, Event::WindowFocused(false), 0.1);
        assert!(!keys.holds(stroke) && !is_held(&keys, Key::A));
        assert!(!take(&mut keys, key(Key::W, Some(Key::W), true), 0.2));
        assert!(!keys.holds(stroke), "another stroke");
    }

    #[test]
    fn a_key_that_stops_repeating_is_released() {
        let mut keys = HeldKeys::default();
        take(&mut keys, key(Key::W, Some(Key::W), true), 0.0);
        keys.take_up(&mut [], 100.0);
        assert!(is_held(&keys, Key::W), "not every system repeats");
        for tick in 1..20 {
            assert!(take(&mut keys, key(Key::W, Some(Key::W), true), 100.0 + 0.03 * f64::from(tick)));
        }
        keys.take_up(&mut [], 101.0);
        assert!(is_held(&keys, Key::W));
        keys.take_up(&mut [], 101.6);
        assert!(!is_held(&keys, Key::W));
        // Now it is known to repeat; a stroke whose release is lost before that ends, too.
        take(&mut keys, key(Key::W, Some(Key::W), false), 102.0);
        take(&mut keys, key(Key::W, Some(Key::W), true), 103.0);
        keys.take_up(&mut [], 105.0);
        assert!(is_held(&keys, Key::W));
        keys.take_up(&mut [], 106.0);
        assert!(!is_held(&keys, Key::W));
    }

    #[test]
    fn only_the_last_key_is_expected_to_repeat() {
        let mut keys = HeldKeys::default();
        for now in [0.0, 0.5, 0.53] {
            take(&mut keys, key(Key::W, Some(Key::W), true), now);
        }
        take(&mut keys, key(Key::D, Some(Key::D), true), 0.6);
        take(&mut keys, key(Key::D, Some(Key::D), false), 0.9);
        keys.take_up(&mut [], 15.0);
        assert!(is_held(&keys, Key::W));
        // W again after another key can be no repeat.
        assert!(!take(&mut keys, key(Key::W, Some(Key::W), true), 15.1));
        // Shift ends repeating on some systems.
        assert!(take(&mut keys, key(Key::W, Some(Key::W), true), 15.6));
        take(&mut keys, Event::ModifiersChanged(Modifiers::SHIFT), 15.7);
        keys.take_up(&mut [], 30.0);
        assert!(is_held(&keys, Key::W));
        // Its release may have been lost.
        keys.take_up(&mut [], 31.0);
        assert!(!is_held(&keys, Key::W));
    }

    #[test]
    fn escape_lets_all_keys_go() {
        let mut keys = HeldKeys::default();
        for now in [0.0, 0.5, 0.53] {
            take(&mut keys, key(Key::W, Some(Key::W), true), now);
        }
        assert!(!take(&mut keys, key(Key::Escape, Some(Key::Escape), true), 0.6));
        assert!(!is_held(&keys, Key::W));
        assert!(take(&mut keys, key(Key::Escape, Some(Key::Escape), true), 1.0), "a repeat of its own");
    }

    #[test]
    fn slow_repeats_are_waited_for_and_late_ones_are_no_presses() {
        let mut keys = HeldKeys::default();
        for now in [0.0, 2.0, 4.0] {
            take(&mut keys, key(Key::Delete, None, true), now);
        }
        keys.take_up(&mut [], 9.0);
        assert!(is_held(&keys, Key::Delete));
        keys.take_up(&mut [], 11.0);
        assert!(!is_held(&keys, Key::Delete));
        assert!(take(&mut keys, key(Key::Delete, None, true), 12.0), "nothing is deleted twice");
    }

    #[test]
    fn the_command_key_of_a_mac_hides_releases() {
        let mut keys = HeldKeys::default();
        let command = Modifiers { mac_cmd: true, command: true, ..Modifiers::NONE };
        take(&mut keys, Event::ModifiersChanged(command), 0.0);
        take(&mut keys, key(Key::W, Some(Key::W), true), 0.1);
        take(&mut keys, Event::ModifiersChanged(Modifiers::NONE), 0.2);
        assert!(!is_held(&keys, Key::W));
    }
}
