//! The state of commands: possible or not, on or off, and their names.

use catoptric_editor::{Action, Editor, Item, Label};
use catoptric_live::Live;
use egui_tiles::Tree;

use crate::base::shapes::shape_name;
use crate::base::texts::Texts;
use crate::state::audit::AuditState;
use crate::state::card::WindowCard;
use crate::state::command::{
    AddCommand, AuditCommand, CameraCommand, Command, CompareCommand, DisplayCommand, FileCommand,
    HelpCommand, MeasureCommand, PictureCommand, SelectionCommand, ToolCommand, WindowCommand,
};
use crate::state::context::Cx;
use crate::state::exact::ExactState;
use crate::state::host::HostAbilities;
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
    pub(crate) host: HostAbilities,
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
            // What is offered otherwise elsewhere stands in no panel.
            host: HostAbilities::DESKTOP,
            example_note: None,
            layout: None,
        }
    }
}

impl CommandContext<'_> {
    /// Whether there is something that `command` could be done to.
    pub(crate) fn can(&self, command: &Command) -> bool {
        match command {
            Command::Edit(action) => self.editor.can(action),
            Command::File(act) => self.can_file(act),
            Command::Picture(act) => self.can_picture(*act),
            Command::Selection(act) => self.can_select(*act),
            Command::Camera(act) => self.can_look(*act),
            Command::Display(act) => self.can_display(*act),
            Command::Tool(ToolCommand::AimLight) => {
                self.view.is_aiming || !self.editor.scene().lights.is_empty()
            }
            Command::Audit(act) => self.can_audit(*act),
            Command::Compare(CompareCommand::Save) => self.lab.is_some_and(|lab| lab.is_compared),
            Command::Measure(MeasureCommand::Vary(_)) => !self.view.is_measuring,
            Command::Measure(act) => self.lab.is_some_and(|lab| match act {
                MeasureCommand::Start | MeasureCommand::Vary(_) => !lab.is_measuring,
                MeasureCommand::Stop => lab.is_measuring,
                MeasureCommand::Copy | MeasureCommand::Save => lab.is_measured && !lab.is_measuring,
            }),
            Command::Help(HelpCommand::ExampleNote) => self.example_note.is_some(),
            Command::Add(AddCommand::Body(_) | AddCommand::Light | AddCommand::Material)
            | Command::Tool(ToolCommand::Take(_) | ToolCommand::ToggleGizmoSpace)
            | Command::Compare(CompareCommand::Swap | CompareCommand::FileA | CompareCommand::FileB)
            | Command::Window(
                WindowCommand::TogglePane(_)
                | WindowCommand::ResetLayout
                | WindowCommand::Zoom(_)
                | WindowCommand::Theme(_)
                | WindowCommand::Language(_)
                | WindowCommand::Palette
                | WindowCommand::FocusMenu,
            )
            | Command::Help(
                HelpCommand::Manual
                | HelpCommand::Shortcuts
                | HelpCommand::Terms
                | HelpCommand::FirstSteps
                | HelpCommand::About,
            ) => true,
        }
    }

    /// Whether a command is offered at all, possible or not.
    pub(crate) fn is_offered(&self, command: &Command) -> bool {
        match command {
            Command::File(act @ (FileCommand::ReadOtherwise | FileCommand::CopyLink | FileCommand::Quit)) => {
                self.can_file(act)
            }
            _ => true,
        }
    }

    fn can_file(&self, act: &FileCommand) -> bool {
        match act {
            FileCommand::ReadOtherwise => self.editor.path().is_none() && self.settings.last_is_minirt(),
            FileCommand::Revert => self.editor.path().is_some(),
            FileCommand::New
            | FileCommand::Open
            | FileCommand::OpenFile(_)
            | FileCommand::Examples
            | FileCommand::OpenExample(_)
            | FileCommand::Save
            | FileCommand::SaveAs => true,
            FileCommand::CopyLink => self.host.has_links,
            FileCommand::Quit => self.host.can_quit,
        }
    }

    fn can_picture(&self, act: PictureCommand) -> bool {
        match act {
            PictureCommand::Render => !self.view.is_measuring,
            PictureCommand::RenderShown => self.live.latest().is_some() && !self.view.is_measuring,
            PictureCommand::Copy => self.live.latest().is_some(),
            PictureCommand::Choose(_) => true,
        }
    }

    fn can_select(&self, act: SelectionCommand) -> bool {
        let selection = self.editor.selection();
        let is_named = |item| matches!(item, Item::Body(_) | Item::Light(_) | Item::Material(_));
        match act {
            SelectionCommand::Cut => self.editor.can(&Action::Cut),
            SelectionCommand::Copy => selection.iter().any(is_named),
            SelectionCommand::Rename => selection.primary().is_some_and(is_named),
            SelectionCommand::Paste => true,
        }
    }

    fn can_look(&self, act: CameraCommand) -> bool {
        match act {
            CameraCommand::FrameSelection => {
                self.editor.selection().iter().any(|item| matches!(item, Item::Body(_) | Item::Light(_)))
            }
            CameraCommand::FrameAll => !self.editor.scene().bodies.is_empty(),
            CameraCommand::FromView => self.view.free_camera.is_some(),
            CameraCommand::LookAlong(_)
            | CameraCommand::ToggleProjection
            | CameraCommand::ToggleFreeView
            | CameraCommand::ToggleFly => true,
        }
    }

    fn can_display(&self, act: DisplayCommand) -> bool {
        match act {
            DisplayCommand::ToggleCard => self.card.is_there(),
            DisplayCommand::Show(shows) => methods::has(&self.settings.methods.method(), shows),
            DisplayCommand::Method(_)
            | DisplayCommand::Map(_)
            | DisplayCommand::ToggleExact
            | DisplayCommand::ToggleGrid
            | DisplayCommand::ToggleHandles => true,
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
        match command {
            Command::Camera(act) => self.is_camera_on(*act),
            Command::Display(act) => Some(self.is_displayed(*act)),
            Command::Tool(act) => Some(match *act {
                ToolCommand::Take(tool) => {
                    self.view.tool == tool && !self.view.is_auditing && !self.view.is_aiming
                }
                ToolCommand::AimLight => self.view.is_aiming,
                ToolCommand::ToggleGizmoSpace => self.view.is_gizmo_local,
            }),
            Command::Audit(AuditCommand::Tool) => Some(self.view.is_auditing),
            Command::Audit(AuditCommand::Play) => Some(self.audit.light.is_running),
            Command::Window(act) => self.is_window_on(*act),
            Command::Help(HelpCommand::ExampleNote) => self.example_note,
            Command::File(_)
            | Command::Picture(_)
            | Command::Edit(_)
            | Command::Selection(_)
            | Command::Add(_)
            | Command::Audit(
                AuditCommand::Previous
                | AuditCommand::Next
                | AuditCommand::All
                | AuditCommand::View
                | AuditCommand::Copy
                | AuditCommand::Save
                | AuditCommand::Release,
            )
            | Command::Compare(_)
            | Command::Measure(_)
            | Command::Help(
                HelpCommand::Manual
                | HelpCommand::Shortcuts
                | HelpCommand::Terms
                | HelpCommand::FirstSteps
                | HelpCommand::About,
            ) => None,
        }
    }

    fn is_camera_on(&self, act: CameraCommand) -> Option<bool> {
        match act {
            CameraCommand::ToggleFreeView => Some(self.view.free_camera.is_some()),
            CameraCommand::ToggleFly => Some(self.view.is_flying),
            CameraCommand::ToggleProjection => {
                let camera = self.view.camera(self.editor.scene());
                Some(matches!(camera.projection, catoptric_scene::Projection::Parallel { .. }))
            }
            CameraCommand::FrameSelection
            | CameraCommand::FrameAll
            | CameraCommand::LookAlong(_)
            | CameraCommand::FromView => None,
        }
    }

    fn is_displayed(&self, act: DisplayCommand) -> bool {
        match act {
            DisplayCommand::Method(kind) => self.settings.methods.kind() == kind,
            DisplayCommand::Show(shows) => self.view.shows == shows,
            DisplayCommand::Map(kind) => self.maps.kind == kind,
            DisplayCommand::ToggleExact => self.exact.is_on,
            DisplayCommand::ToggleGrid => self.settings.shows_grid,
            DisplayCommand::ToggleHandles => self.settings.shows_handles,
            DisplayCommand::ToggleCard => self.card.is_on(),
        }
    }

    fn is_window_on(&self, act: WindowCommand) -> Option<bool> {
        match act {
            WindowCommand::TogglePane(pane) => Some(layout::is_in_front(self.layout?, pane)),
            WindowCommand::Theme(theme) => Some(self.settings.theme == theme),
            WindowCommand::Language(language) => Some(self.settings.language == language),
            WindowCommand::ResetLayout
            | WindowCommand::Zoom(_)
            | WindowCommand::Palette
            | WindowCommand::FocusMenu => None,
        }
    }

    /// What to call `command` now: undoing tells what it undoes.
    pub(crate) fn label(&self, command: &Command) -> String {
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

    /// What a menu calls `command`: what stands in the menu *Add* is not called so again.
    pub(crate) fn entry_label(&self, command: &Command) -> String {
        match command {
            Command::Add(act) => self.texts.get(added_name(*act)).to_owned(),
            _ => self.label(command),
        }
    }

    /// One sentence that explains `command`.
    pub(crate) fn tip(&self, command: &Command) -> Option<&str> {
        command.look().and_then(|look| self.texts.tip(look.key))
    }
}

/// The message that names what a command adds.
const fn added_name(act: AddCommand) -> &'static str {
    match act {
        AddCommand::Body(shape) => shape_name(shape),
        AddCommand::Light => "name-light-source",
        AddCommand::Material => "name-material",
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
            Self::Tool(ToolCommand::Take(_))
                | Self::Display(DisplayCommand::Method(_) | DisplayCommand::Show(_) | DisplayCommand::Map(_))
                | Self::Window(WindowCommand::Theme(_) | WindowCommand::Language(_))
        )
    }
}
