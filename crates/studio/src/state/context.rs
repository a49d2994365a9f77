//! The context of a panel in a frame.

use catoptric_editor::Editor;
use catoptric_live::Live;

use crate::base::held_keys::HeldKeys;
use crate::base::texts::Texts;
use crate::state::audit::AuditState;
use crate::state::card::WindowCard;
use crate::state::command::Command;
use crate::state::exact::ExactState;
use crate::state::images::DocumentImages;
use crate::state::maps::MapState;
use crate::state::settings::Settings;
use crate::state::view::ViewState;

/// The parts of the studio that panels read and change. Borrowed for one frame.
pub(crate) struct Cx<'a> {
    /// The document, the selection, the history.
    pub(crate) editor: &'a mut Editor,
    /// The messages of the present language.
    pub(crate) texts: &'a Texts,
    /// What is remembered.
    pub(crate) settings: &'a mut Settings,
    /// How the document is looked at.
    pub(crate) view: &'a mut ViewState,
    /// The keys that are held.
    pub(crate) held_keys: &'a HeldKeys,
    /// The pixel that is looked into.
    pub(crate) audit: &'a mut AuditState,
    /// The map over the picture.
    pub(crate) maps: &'a mut MapState,
    /// What the laws of optics say of the selected body.
    pub(crate) exact: &'a mut ExactState,
    /// The traced picture.
    pub(crate) live: &'a Live,
    /// The pictures that the scene names.
    pub(crate) images: &'a DocumentImages,
    /// The graphics card that may draw it.
    pub(crate) card: &'a mut WindowCard,
    /// What is to be done when the frame is drawn.
    pub(crate) commands: &'a mut Vec<Command>,
}

impl<'a> Cx<'a> {
    /// The message `key`, which takes no arguments.
    pub(crate) fn t(&self, key: &'a str) -> &'a str {
        self.texts.get(key)
    }

    /// Has `command` done at the end of the frame.
    pub(crate) fn run(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }
}
