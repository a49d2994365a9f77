//! From keys to commands.

use egui::Ui;

use crate::app::Studio;

/// Takes the shortcuts that were pressed out of the input and asks for their commands.
///
/// While a text is being typed, only shortcuts with a command key count.
pub(crate) fn collect(_ui: &mut Ui, _studio: &mut Studio) {}
