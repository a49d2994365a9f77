//! Keys and presses that move the focus, each in a frame of its own.
//!
//! egui moves the focus before the widgets of a frame read what was typed. In a slow frame a text and the Tab after it
//! come together: the field has lost the focus by then, and the text would be lost.

use std::mem;

use egui::{Context, Event, Key, Plugin, RawInput};

/// Holds events back that must not come in the same frame as those before them.
#[derive(Default)]
pub(crate) struct FocusTurns {
    held: Vec<Event>,
}

impl FocusTurns {
    /// From now on `context` gets them so.
    pub(crate) fn install(context: &Context) {
        context.add_plugin(Self::default());
    }
}

impl Plugin for FocusTurns {
    fn debug_name(&self) -> &'static str {
        "focus turns"
    }

    fn input_hook(&mut self, context: &Context, input: &mut RawInput) {
        let mut events = mem::take(&mut self.held);
        events.append(&mut input.events);
        self.held = events.split_off(turn_length(&events));
        input.events = events;
        if !self.held.is_empty() {
            context.request_repaint();
        }
    }
}

/// How many of the events may come in one frame: those before the first that moves the focus after others, or comes
/// after one that has moved it.
fn turn_length(events: &[Event]) -> usize {
    let mut before = None;
    for (at, event) in events.iter().enumerate().filter(|(_, event)| is_input(event)) {
        let moves = moves_focus(event);
        if before.is_some_and(|had_moved| moves || had_moved) {
            return at;
        }
        before = Some(moves);
    }
    events.len()
}

/// Whether something is typed or pressed.
fn is_input(event: &Event) -> bool {
    match event {
        Event::Key { pressed, .. } => *pressed,
        Event::PointerButton { pressed, .. } => *pressed,
        Event::Cut | Event::Paste(_) | Event::Text(_) | Event::Ime(_) => true,
        _ => false,
    }
}

fn moves_focus(event: &Event) -> bool {
    matches!(event, Event::Key { key: Key::Tab | Key::Escape, .. } | Event::PointerButton { .. })
}

#[cfg(test)]
mod tests {
    use egui::{Id, Modifiers, PointerButton, TextEdit, pos2};

    use super::*;

    fn key(key: Key) -> Event {
        Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE }
    }

    fn text(text: &str) -> Event {
        Event::Text(text.to_owned())
    }

    fn press(pressed: bool) -> Event {
        let (pos, button) = (pos2(0.0, 0.0), PointerButton::Primary);
        Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }
    }

    #[test]
    fn what_moves_the_focus_waits_for_what_was_typed() {
        assert_eq!(turn_length(&[]), 0);
        assert_eq!(turn_length(&[key(Key::Num1), text("1"), key(Key::Num2), text("2")]), 4);
        assert_eq!(turn_length(&[key(Key::Num1), text("1"), key(Key::Tab), text("2")]), 2);
        assert_eq!(turn_length(&[key(Key::Tab), key(Key::Num2), text("2")]), 1);
        assert_eq!(turn_length(&[key(Key::Tab), key(Key::Tab)]), 1);
        assert_eq!(turn_length(&[text("1"), press(true), press(false)]), 1);
        assert_eq!(turn_length(&[press(true), press(false), text("1")]), 2);
    }

    #[test]
    fn a_text_and_the_tab_after_it_may_come_at_once() {
        let context = Context::default();
        FocusTurns::install(&context);
        let mut texts = [String::new(), String::new()];
        let ids = ["first", "second"].map(Id::unique);
        context.memory_mut(|memory| memory.request_focus(ids[0]));
        let mut frame = |events| {
            let input = RawInput { events, ..RawInput::default() };
            let mut output = context.run_ui(input, |ui| {
                for (id, text) in ids.iter().zip(&mut texts) {
                    ui.add(TextEdit::singleline(text).id(*id));
                }
            });
            output.textures_delta.clear();
        };
        frame(Vec::new());
        frame(vec![text("12"), key(Key::Tab), text("34"), key(Key::Tab)]);
        for _ in 0..4 {
            frame(Vec::new());
        }
        assert_eq!(texts, ["12", "34"]);
    }
}
