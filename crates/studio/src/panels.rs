//! The panels. They get a context, [`Cx`](crate::state::context::Cx), and ask for commands.

pub(crate) mod add_menu;
pub(crate) mod audit;
pub(crate) mod compare;
pub(crate) mod example_note;
pub(crate) mod history;
pub(crate) mod inspector;
pub(crate) mod maps;
pub(crate) mod materials;
pub(crate) mod measure;
pub(crate) mod menu_entry;
pub(crate) mod method_chooser;
pub(crate) mod outliner;
pub(crate) mod panes;
pub(crate) mod problems;
pub(crate) mod status_bar;
pub(crate) mod viewport;

#[cfg(test)]
mod tests;
