//! The state that panels and shell share: settings, view, commands, results of the lab, and the context of panels.

pub(crate) mod audit;
pub(crate) mod card;
pub(crate) mod command;
pub(crate) mod command_context;
pub(crate) mod context;
pub(crate) mod exact;
pub(crate) mod host;
pub(crate) mod images;
pub(crate) mod layout;
pub(crate) mod maps;
pub(crate) mod methods;
pub(crate) mod refusal;
pub(crate) mod render_choices;
pub(crate) mod settings;
pub(crate) mod view;
