//! Scene files: opening, saving, and never losing a change.

use catoptric_editor::Editor;
use catoptric_scene::Example;
use egui::Context;

use crate::app::{Start, Studio};
use crate::command::Command;

/// The example shown at the very first start.
const FIRST: &str = "four-bodies";

/// What is known about the open document beyond the editor.
#[derive(Default)]
pub(crate) struct Documents {}

/// Opens the scene to start with.
pub(crate) fn start(studio: &mut Studio, start: &Start) {
    let name = match start {
        Start::Example(name) => name.as_str(),
        Start::Last | Start::File(_) => FIRST,
    };
    if let Some(loaded) = Example::find(name).and_then(|example| example.load().ok()) {
        studio.editor = Editor::untitled(name, loaded.text, loaded.scene);
    }
}

/// Keeps what is not saved: once a frame.
pub(crate) fn keep(_context: &Context, _studio: &mut Studio) {}

/// The studio is being left.
pub(crate) fn leave(_studio: &mut Studio) {}

/// Does a command of the menu File.
pub(crate) fn run(_context: &Context, _studio: &mut Studio, _command: Command) {}
