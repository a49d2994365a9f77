//! The base: texts, theme, widgets and work on threads. It knows nothing of the studio.

pub(crate) mod example_texts;
pub(crate) mod focus_turns;
pub(crate) mod fuzzy;
pub(crate) mod held_keys;
pub(crate) mod job;
pub(crate) mod latest;
pub(crate) mod notices;
pub(crate) mod picture_frame;
pub(crate) mod plates;
pub(crate) mod projector;
pub(crate) mod proof;
pub(crate) mod scripts;
pub(crate) mod shapes;
pub(crate) mod shortcut_text;
pub(crate) mod texts;
pub(crate) mod theme;
pub(crate) mod thumbnails;
pub(crate) mod tree_roles;
pub(crate) mod typeset;
pub(crate) mod widgets;
pub(crate) mod words;
