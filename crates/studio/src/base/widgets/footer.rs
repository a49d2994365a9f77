//! The foot of a panel: what the panel is for stays in sight, however low the panel is.

use egui::{AsIdSalt, Frame, Margin, Panel, Ui};

/// Draws the foot at the bottom of what is left of `ui`; what is drawn after it has the room above.
pub(crate) fn footer_ui(ui: &mut Ui, id: impl AsIdSalt, foot: impl FnOnce(&mut Ui)) {
    let frame = Frame::NONE.inner_margin(Margin { left: 0, right: 0, top: 6, bottom: 0 });
    Panel::bottom(id).frame(frame).resizable(false).show_separator_line(false).show(ui, foot);
}
