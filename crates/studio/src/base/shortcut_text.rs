//! Shortcuts as menus show them.

use egui::{Context, Key, KeyboardShortcut, ModifierNames};

/// A shortcut as menus show it.
pub(crate) fn text(context: &Context, shortcut: &KeyboardShortcut) -> String {
    let names = ModifierNames::NAMES;
    let modifiers = names.format(&shortcut.modifiers, context.os().is_mac());
    let key = match shortcut.logical_key {
        Key::OpenBracket => "[",
        Key::CloseBracket => "]",
        Key::Plus => "+",
        Key::Minus => "−",
        Key::Equals => "=",
        Key::Delete => "Del",
        other => other.name(),
    };
    if modifiers.is_empty() { key.to_owned() } else { format!("{modifiers}{}{key}", names.concat) }
}
