//! Widgets that panels share. Each has an accessible name and explains itself when the pointer rests on it.

pub(crate) mod choice;
pub(crate) mod color;
pub(crate) mod icon;
pub(crate) mod number;
pub(crate) mod picker;
pub(crate) mod row;
pub(crate) mod section;
pub(crate) mod text;
