//! Shortcuts: from keys to commands.

use catoptric_editor::Action;
use egui::{Context, Event, Key, KeyboardShortcut, Modifiers, Popup, Ui};

use crate::shell::studio::Studio;
use crate::state::command::{CameraCommand, Command, SelectionCommand, WindowCommand, ZoomStep};

/// Other users of the keyboard, which take precedence over shortcuts.
#[derive(Clone, Copy, Debug, Default)]
struct KeyboardListeners {
    /// A text is being typed.
    is_typing: bool,
    /// A menu is open, or the menu bar has the keyboard.
    is_menu_open: bool,
    /// The keys fly the camera.
    is_flying: bool,
}

/// Takes the shortcuts that were pressed out of the input and asks for their commands.
///
/// While a text is being typed, only shortcuts with a command key count, and of them those that text fields do not
/// know; while flying, letters and digits belong to the flight; behind a dialog and during a drag there are none.
pub(crate) fn collect(ui: &mut Ui, studio: &mut Studio) {
    let context = ui.ctx().clone();
    context.input_mut(|input| {
        let now = input.time;
        studio.keys.held.take_up(&mut input.events, now);
    });
    let mut commands = Vec::new();
    let is_behind =
        studio.dialogs.is_any_open() || context.memory(|memory| memory.top_modal_layer().is_some());
    // What is being dragged must not be deleted or undone meanwhile.
    let is_dragging =
        context.egui_is_using_pointer() && context.input(|input| input.pointer.is_decidedly_dragging());
    if !is_behind && !is_dragging {
        let listeners = KeyboardListeners {
            is_typing: context.text_edit_focused(),
            is_menu_open: Popup::is_any_open(&context) || studio.menu_focus.is_active(),
            // The right button flies, too, while it is down.
            is_flying: studio.view.is_flying || context.input(|input| input.pointer.secondary_down()),
        };
        context.input_mut(|input| {
            input.events.retain(|event| match command_of(event, listeners) {
                Some(command) => {
                    commands.extend(command.into_iter().cloned());
                    false
                }
                None => true,
            });
        });
        if !listeners.is_typing {
            collect_clipboard(&context, &mut commands);
        }
    }
    if studio.menu_focus.is_alt_tapped(&context) && !is_behind && !is_dragging {
        commands.push(WindowCommand::FocusMenu.into());
    }
    if std::mem::take(&mut studio.keys.is_paste_asked) {
        take_paste(&context, &mut commands);
    }
    let situation = studio.situation();
    commands.retain(|command| situation.can(command));
    studio.commands.append(&mut commands);
}

/// The system's own events of cutting, copying and pasting.
fn collect_clipboard(context: &Context, commands: &mut Vec<Command>) {
    context.input_mut(|input| {
        input.events.retain(|event| {
            commands.push(match event {
                Event::Copy => SelectionCommand::Copy.into(),
                Event::Cut => SelectionCommand::Cut.into(),
                Event::Paste(text) => Command::Edit(Action::Paste(text.clone())),
                _ => return true,
            });
            false
        });
    });
}

/// Takes a text that was pasted.
fn take_paste(context: &Context, commands: &mut Vec<Command>) {
    context.input_mut(|input| {
        input.events.retain(|event| match event {
            Event::Paste(text) => {
                commands.push(Command::Edit(Action::Paste(text.clone())));
                false
            }
            _ => true,
        });
    });
}

/// The command whose shortcut `event` is; `Some(None)` for a shortcut whose repetition means nothing.
fn command_of(event: &Event, listeners: KeyboardListeners) -> Option<Option<&'static Command>> {
    let Event::Key { key, physical_key, pressed: true, repeat, modifiers } = event else { return None };
    let (command, shortcut) = find(*key, *modifiers).or_else(|| {
        // Layouts put other signs on the keys of digits and brackets: `"` on Shift+2 and ъ on ] in Russian. Letters
        // and digits of the layout itself go first, so that no other key than the one labeled Q quits.
        let physical = (*physical_key).filter(|_| !is_letter_or_digit(*key))?;
        find(physical, *modifiers)
    })?;
    if !is_heard(command, shortcut, listeners) {
        return None;
    }
    Some((!repeat || can_repeat(command)).then_some(command))
}

fn find(key: Key, modifiers: Modifiers) -> Option<(&'static Command, KeyboardShortcut)> {
    Command::all().find_map(|command| {
        let shortcuts = command.look()?.shortcuts;
        let hit = shortcuts
            .iter()
            .find(|shortcut| shortcut.logical_key == key && modifiers.matches_exact(shortcut.modifiers))?;
        Some((command, *hit))
    })
}

fn is_letter_or_digit(key: Key) -> bool {
    let name = key.name();
    name.len() == 1 && name.chars().all(|letter| letter.is_ascii_alphanumeric())
}

/// Whether a shortcut counts beside what else listens.
fn is_heard(command: &Command, shortcut: KeyboardShortcut, listeners: KeyboardListeners) -> bool {
    let KeyboardShortcut { modifiers, logical_key: key } = shortcut;
    let is_function = key >= Key::F1 && key <= Key::F35;
    let is_bare = !modifiers.command && !modifiers.alt && !is_function;
    if listeners.is_typing {
        // Text fields know these themselves.
        let is_text = matches!(key, Key::A | Key::C | Key::V | Key::X | Key::Y | Key::Z);
        return is_function || modifiers.command && !is_text;
    }
    if listeners.is_menu_open {
        return !is_bare;
    }
    !(listeners.is_flying && is_bare && *command != Command::Camera(CameraCommand::ToggleFly))
}

/// Whether holding the key does it again and again.
fn can_repeat(command: &Command) -> bool {
    use Action::{MoveDown, MoveUp, Redo, SelectNext, SelectPrevious, Undo};
    matches!(
        command,
        Command::Edit(Undo | Redo | SelectNext | SelectPrevious | MoveUp | MoveDown)
            | Command::Window(WindowCommand::Zoom(ZoomStep::In | ZoomStep::Out))
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press(key: Key, physical: Key, modifiers: Modifiers) -> Event {
        Event::Key { key, physical_key: Some(physical), pressed: true, repeat: false, modifiers }
    }

    fn heard(event: &Event) -> Option<&'static Command> {
        command_of(event, KeyboardListeners::default()).flatten()
    }

    #[test]
    fn keys_that_a_layout_labels_otherwise_are_found_by_their_place() {
        use catoptric_editor::navigate::ViewSide;
        // Russian: `?` on Shift+7.
        let bottom = press(Key::Questionmark, Key::Num7, Modifiers::SHIFT);
        assert_eq!(heard(&bottom), Some(&CameraCommand::LookAlong(ViewSide::Bottom).into()));
        // German: `+` beside the return key, where ] is.
        let next = press(Key::Plus, Key::CloseBracket, Modifiers::NONE);
        assert_eq!(heard(&next), Some(&Command::Edit(Action::SelectNext)));
    }

    #[test]
    fn letters_of_the_layout_go_before_places() {
        // French: A on the place of Q; Ctrl+A must never quit.
        let all = press(Key::A, Key::Q, Modifiers::COMMAND | Modifiers::CTRL);
        assert_eq!(heard(&all), Some(&Command::Edit(Action::SelectAll)));
        // Dvorak: B on the place of N; there is no Ctrl+B.
        assert_eq!(heard(&press(Key::B, Key::N, Modifiers::COMMAND | Modifiers::CTRL)), None);
    }

    #[test]
    fn bare_keys_belong_to_who_listens() {
        let key = |key, modifiers| press(key, key, modifiers);
        let typing = KeyboardListeners { is_typing: true, ..KeyboardListeners::default() };
        let flying = KeyboardListeners { is_flying: true, ..KeyboardListeners::default() };
        let control = Modifiers::COMMAND | Modifiers::CTRL;
        for (event, typed, flown) in [
            (key(Key::W, Modifiers::NONE), false, false),
            (key(Key::Delete, Modifiers::NONE), false, false),
            (key(Key::F, Modifiers::SHIFT), false, true),
            (key(Key::H, Modifiers::ALT), false, true),
            (key(Key::Z, control), false, true),
            (key(Key::S, control), true, true),
            (key(Key::F1, Modifiers::NONE), true, true),
        ] {
            assert!(command_of(&event, KeyboardListeners::default()).is_some(), "{event:?}");
            assert_eq!(command_of(&event, typing).is_some(), typed, "{event:?}");
            assert_eq!(command_of(&event, flying).is_some(), flown, "{event:?}");
        }
    }

    #[test]
    fn a_held_key_deletes_once_and_undoes_many_times() {
        let held =
            |key, modifiers| Event::Key { key, physical_key: None, pressed: true, repeat: true, modifiers };
        let control = Modifiers::COMMAND | Modifiers::CTRL;
        assert_eq!(command_of(&held(Key::D, control), KeyboardListeners::default()), Some(None));
        let undo = command_of(&held(Key::Z, control), KeyboardListeners::default());
        assert_eq!(undo, Some(Some(&Command::Edit(Action::Undo))));
    }
}
