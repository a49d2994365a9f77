//! The state of commands: possible or not, on or off, and their names.

use catoptric_editor::{Action, Editor, Item, Label};
use catoptric_live::Live;
use egui_tiles::Tree;

use crate::base::texts::Texts;
use crate::state::audit::AuditState;
use crate::state::card::WindowCard;
use crate::state::command::{AuditCommand, Command, CompareCommand, MeasureCommand};
use crate::state::context::Cx;
use crate::state::exact::ExactState;
use crate::state::layout::{self, Pane};
use crate::state::maps::MapState;
use crate::state::methods;
use crate::state::settings::Settings;
use crate::state::view::ViewState;

/// The state that decides which commands are possible.
#[derive(Clone, Copy)]
pub(crate) struct CommandContext<'a> {
    pub(crate) editor: &'a Editor,
    pub(crate) texts: &'a Texts,
    pub(crate) settings: &'a Settings,
    /// What the lab has: `None` while the panels are being drawn.
    pub(crate) lab: Option<LabState>,
    pub(crate) view: &'a ViewState,
    pub(crate) audit: &'a AuditState,
    pub(crate) maps: &'a MapState,
    pub(crate) exact: &'a ExactState,
    pub(crate) live: &'a Live,
    pub(crate) card: &'a WindowCard,
    /// Whether the note about the example is open; `None` without an example, and while the panels are being drawn.
    pub(crate) example_note: Option<bool>,
    /// The panels; `None` while they are being drawn.
    pub(crate) layout: Option<&'a Tree<Pane>>,
}

/// The results that the lab has so far.
#[derive(Clone, Copy)]
pub(crate) struct LabState {
    pub(crate) is_compared: bool,
    pub(crate) is_measuring: bool,
    pub(crate) is_measured: bool,
}

impl Cx<'_> {
    /// What decides about commands.
    pub(crate) fn situation(&self) -> CommandContext<'_> {
        CommandContext {
            editor: self.editor,
            texts: self.texts,
            settings: self.settings,
            lab: None,
            view: self.view,
            audit: self.audit,
            maps: self.maps,
            exact: self.exact,
            live: self.live,
            card: self.card,
            example_note: None,
            layout: None,
        }
    }
}

impl CommandContext<'_> {
    /// Whether there is something that `command` could be done to.
    pub(crate) fn can(&self, command: &Command) -> bool {
        let selection = self.editor.selection();
        match command {
            Command::Edit(action) => self.editor.can(action),
            Command::Cut => self.editor.can(&Action::Cut),
            Command::Copy => selection
                .iter()
                .any(|item| matches!(item, Item::Body(_) | Item::Light(_) | Item::Material(_))),
            Command::Rename => {
                matches!(selection.primary(), Some(Item::Body(_) | Item::Light(_) | Item::Material(_)))
            }
            Command::ToggleCard => self.card.is_there(),
            Command::ExampleNote => self.example_note.is_some(),
            Command::Revert => self.editor.path().is_some(),
            Command::Show(shows) => methods::has(&self.settings.methods.method(), *shows),
            Command::Render => !self.view.is_measuring,
            Command::RenderShown => self.live.latest().is_some() && !self.view.is_measuring,
            Command::CopyPicture => self.live.latest().is_some(),
            Command::Compare(CompareCommand::Save) => self.lab.is_some_and(|lab| lab.is_compared),
            Command::Measure(act) => self.lab.is_some_and(|lab| match act {
                MeasureCommand::Start => !lab.is_measuring,
                MeasureCommand::Stop => lab.is_measuring,
                MeasureCommand::Save => lab.is_measured && !lab.is_measuring,
            }),
            Command::FrameSelection => selection.bodies().next().or(selection.lights().next()).is_some(),
            Command::FrameAll => !self.editor.scene().bodies.is_empty(),
            Command::CameraFromView => self.view.free_camera.is_some(),
            Command::AimLight => self.view.is_aiming || !self.editor.scene().lights.is_empty(),
            Command::Audit(act) => self.can_audit(*act),
            _ => true,
        }
    }

    fn can_audit(&self, act: AuditCommand) -> bool {
        let generations = self.audit.found().map(|found| found.generations());
        match act {
            AuditCommand::Tool => true,
            AuditCommand::Release | AuditCommand::View => self.audit.pin().is_some(),
            AuditCommand::Previous => generations.is_some_and(|count| count > 1 && self.audit.shows(2)),
            AuditCommand::Next => generations.is_some_and(|count| !self.audit.shows(count)),
            AuditCommand::All => {
                generations.is_some_and(|count| !self.audit.shows(count)) || self.audit.light.front.is_some()
            }
            AuditCommand::Play | AuditCommand::Copy | AuditCommand::Save => generations.is_some(),
        }
    }

    /// Whether what `command` switches is on; `None` for a command that switches nothing.
    pub(crate) fn is_on(&self, command: &Command) -> Option<bool> {
        Some(match command {
            Command::ToggleFreeView => self.view.free_camera.is_some(),
            Command::ToggleFly => self.view.is_flying,
            Command::ToggleGizmoSpace => self.view.is_gizmo_local,
            Command::ToggleGrid => self.settings.shows_grid,
            Command::ToggleCard => self.card.is_on(),
            Command::ToggleHandles => self.settings.shows_handles,
            Command::ToggleProjection => {
                let camera = self.view.camera(self.editor.scene());
                matches!(camera.projection, catoptric_scene::Projection::Parallel { .. })
            }
            Command::Method(kind) => self.settings.methods.kind() == *kind,
            Command::Show(shows) => self.view.shows == *shows,
            Command::Tool(tool) => self.view.tool == *tool && !self.view.is_auditing && !self.view.is_aiming,
            Command::AimLight => self.view.is_aiming,
            Command::Audit(AuditCommand::Tool) => self.view.is_auditing,
            Command::Audit(AuditCommand::Play) => self.audit.light.is_running,
            Command::ToggleExact => self.exact.is_on,
            Command::Map(kind) => self.maps.kind == *kind,
            Command::Theme(theme) => self.settings.theme == *theme,
            Command::Language(language) => self.settings.language == *language,
            Command::ExampleNote => self.example_note?,
            Command::TogglePane(pane) => layout::is_in_front(self.layout?, *pane),
            _ => return None,
        })
    }

    /// What to call `command` now: undoing tells what it undoes.
    pub(crate) fn name(&self, command: &Command) -> String {
        let step = match command {
            Command::Edit(Action::Undo) => self.editor.undo_label().map(|label| ("undo-step", label)),
            Command::Edit(Action::Redo) => self.editor.redo_label().map(|label| ("redo-step", label)),
            _ => None,
        };
        if let Some((key, label)) = step {
            return self.texts.with(key, &[("step", step_name(self.texts, label).into())]);
        }
        command.look().map_or_else(String::new, |look| self.texts.get(look.key).to_owned())
    }

    /// One sentence that explains `command`.
    pub(crate) fn tip(&self, command: &Command) -> Option<&str> {
        command.look().and_then(|look| self.texts.tip(look.key))
    }
}

/// The name of a step: what was done, and to what.
pub(crate) fn step_name(texts: &Texts, label: &Label) -> String {
    let act = texts.get(label.key);
    if label.subject.is_empty() {
        return act.to_owned();
    }
    texts.with("step-of", &[("act", act.into()), ("subject", label.subject.as_str().into())])
}

impl Command {
    /// Whether it chooses one of several, of which one is always chosen.
    pub(crate) fn is_choice(&self) -> bool {
        matches!(
            self,
            Self::Tool(_)
                | Self::Method(_)
                | Self::Show(_)
                | Self::Map(_)
                | Self::Theme(_)
                | Self::Language(_)
        )
    }
}
