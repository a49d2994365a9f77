//! Doing what was asked for.

use egui::Context;

use crate::app::Studio;
use crate::command::Command;

/// Does `command`.
pub(crate) fn run(_context: &Context, studio: &mut Studio, command: Command) {
    match command {
        _ => {}
    }
}
