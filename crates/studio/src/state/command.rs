//! The commands of the studio: one list that feeds menus, shortcuts and the command palette.

#[cfg(test)]
mod icon_tests;
mod table;

use std::path::PathBuf;

use catoptric_editor::Action;
use catoptric_editor::navigate::ViewSide;
use catoptric_lab::maps::MapKind;
use catoptric_live::DisplayContent;
use catoptric_scene::{ScenePath, ShapeKind};
use catoptric_tracer::raster::MethodKind;
use egui::{Key, KeyboardShortcut};
use egui_material_icons::MaterialIcon;

use crate::base::texts::Language;
use crate::base::theme::Theme;
use crate::state::images::ImageUse;
use crate::state::layout::Pane;

/// The acts that make one body of the selected ones.
pub(crate) const JOINS: [Action; 5] = [
    join(ShapeKind::Union),
    join(ShapeKind::Intersection),
    join(ShapeKind::Difference),
    join(ShapeKind::Surface),
    join(ShapeKind::Group),
];

/// Joins the selected bodies; the whole is named when it is done.
pub(crate) const fn join(shape: ShapeKind) -> Action {
    Action::Join { shape, name: String::new() }
}

/// A discrete act. Acts of one area stand in a sum of their own; each sum converts into a command.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Open, save, leave.
    File(FileCommand),
    /// Make pictures, or take them into the scene.
    Picture(PictureCommand),
    /// Change the document.
    Edit(Action),
    /// Do something with the selected things that the document does not know.
    Selection(SelectionCommand),
    /// Add something where the view looks.
    Add(AddCommand),
    /// Move the camera of the view.
    Camera(CameraCommand),
    /// Choose what the viewport shows.
    Display(DisplayCommand),
    /// Choose what the pointer does in the picture.
    Tool(ToolCommand),
    /// Look into a pixel.
    Audit(AuditCommand),
    /// Compare pictures.
    Compare(CompareCommand),
    /// Measure times.
    Measure(MeasureCommand),
    /// Change the window.
    Window(WindowCommand),
    /// Explain the studio or the scene.
    Help(HelpCommand),
}

/// A command about the document as a whole.
#[derive(Clone, Debug, PartialEq)]
pub enum FileCommand {
    /// An empty scene.
    New,
    /// Ask for a scene file and open it.
    Open,
    /// Open this file.
    OpenFile(PathBuf),
    /// Show the built-in scenes.
    Examples,
    /// Open this built-in scene.
    OpenExample(&'static str),
    /// Ask how the scene of another ray tracer is to be read, and read it again.
    ReadOtherwise,
    /// Back to the saved file.
    Revert,
    /// Write the scene to its file.
    Save,
    /// Ask for a file and write the scene to it.
    SaveAs,
    /// Give the person a link to what is shown.
    CopyLink,
    /// Close the window.
    Quit,
}

/// A command about pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PictureCommand {
    /// Make a picture file.
    Render,
    /// Make a picture of what the viewport shows, to be saved.
    RenderShown,
    /// Copy the picture of the viewport to the clipboard.
    Copy,
    /// Ask for a picture that the scene uses.
    Choose(ImageUse),
}

/// A command about the selected things.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SelectionCommand {
    /// Put the selected bodies and lights into the clipboard as text.
    Copy,
    /// Copy, then delete.
    Cut,
    /// Take bodies and lights from the clipboard.
    Paste,
    /// Type another name for the selected thing.
    Rename,
}

/// A command that adds something to the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AddCommand {
    /// A body where the view looks.
    Body(ShapeKind),
    /// A light above where the view looks.
    Light,
    /// A material that bodies can share.
    Material,
}

/// A command about the camera of the view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CameraCommand {
    /// Bring the selection into view.
    FrameSelection,
    /// Bring all bodies into view.
    FrameAll,
    /// Look along an axis.
    LookAlong(ViewSide),
    /// Perspective or parallel projection.
    ToggleProjection,
    /// Look around without moving the scene's camera, or back through it.
    ToggleFreeView,
    /// Put the scene's camera where the free view is.
    FromView,
    /// Fly with the keys.
    ToggleFly,
}

/// A command about what the viewport shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DisplayCommand {
    /// Choose how the picture is drawn.
    Method(MethodKind),
    /// Choose what of the drawing is seen.
    Show(DisplayContent),
    /// Show a map over the picture, or the picture alone.
    Map(Option<MapKind>),
    /// Draw where images, focal points and highlights must be.
    ToggleExact,
    /// Ground grid and axes.
    ToggleGrid,
    /// Lights and gizmo over the picture.
    ToggleHandles,
    /// The graphics card draws the picture, or the processor.
    ToggleCard,
}

/// A command about what the pointer does in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ToolCommand {
    /// Choose what the gizmo does.
    Take(Tool),
    /// Drags in the picture move a light by its highlight or its shadow, or no longer do.
    AimLight,
    /// Gizmo along the world's axes or the body's own.
    ToggleGizmoSpace,
}

/// A command about the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum WindowCommand {
    /// Show or hide a panel.
    TogglePane(Pane),
    /// The first arrangement of the panels.
    ResetLayout,
    /// Bigger, smaller, normal.
    Zoom(ZoomStep),
    /// Choose the colors of the window.
    Theme(Theme),
    /// Choose the language.
    Language(Language),
    /// Find a command by typing.
    Palette,
    /// Give the keyboard to the menu bar.
    FocusMenu,
}

/// A command that explains something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HelpCommand {
    /// What to notice in the example that is open.
    ExampleNote,
    /// The documents, to be read in the window.
    Manual,
    /// The list of shortcuts.
    Shortcuts,
    /// The terms of optics, explained.
    Terms,
    /// The three steps of the first start.
    FirstSteps,
    /// Version and licenses.
    About,
}

/// The tool of the gizmo.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tool {
    /// Moves.
    #[default]
    Move,
    /// Turns.
    Rotate,
    /// Scales.
    Scale,
}

/// A command of the audit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AuditCommand {
    /// Clicks in the picture pin pixels, or no longer do.
    Tool,
    /// Shows a generation less.
    Previous,
    /// Shows a generation more.
    Next,
    /// Shows all rays whole.
    All,
    /// Slow light runs along the rays, or stops.
    Play,
    /// Looks again from where the pixel was pinned.
    View,
    /// Copies the tree as text.
    Copy,
    /// Saves the tree as a picture.
    Save,
    /// Looks into no pixel.
    Release,
}

/// A command of the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CompareCommand {
    /// Exchanges the two pictures.
    Swap,
    /// Asks for a picture file as the first picture.
    FileA,
    /// Asks for a picture file as the second picture.
    FileB,
    /// Saves the report.
    Save,
}

/// A command of the measurement.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum MeasureCommand {
    /// Varies the number of the scene at this address; without one, asks for it.
    Vary(Option<ScenePath>),
    /// Begins to measure.
    Start,
    /// Ends it; what was measured stays.
    Stop,
    /// Copies the table as CSV.
    Copy,
    /// Saves report, plots and tables.
    Save,
}

/// A step of the window's magnification.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ZoomStep {
    /// A tenth bigger.
    In,
    /// A tenth smaller.
    Out,
    /// The magnification of the system.
    Normal,
}

/// The group of a command: the sections of the list of shortcuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CommandGroup {
    /// Files and pictures.
    File,
    /// The document.
    Edit,
    /// What is selected.
    Select,
    /// New things.
    Add,
    /// The camera and the view.
    View,
    /// What the pointer does in the picture.
    Tool,
    /// Experiments: looking into what is seen.
    Lab,
    /// Panels, theme, language.
    Window,
    /// Explanations.
    Help,
}

impl CommandGroup {
    /// All groups, in the order in which to show them.
    pub const ALL: [Self; 9] = [
        Self::File,
        Self::Edit,
        Self::Select,
        Self::Add,
        Self::View,
        Self::Tool,
        Self::Lab,
        Self::Window,
        Self::Help,
    ];

    /// The message that names the group.
    pub const fn key(self) -> &'static str {
        match self {
            Self::File => "group-file",
            Self::Edit => "group-edit",
            Self::Select => "group-select",
            Self::Add => "group-add",
            Self::View => "group-view",
            Self::Tool => "group-tool",
            Self::Lab => "group-lab",
            Self::Window => "group-window",
            Self::Help => "group-help",
        }
    }
}

/// The name, message, icon and shortcuts of a command.
#[derive(Clone, Copy, Debug)]
pub struct CommandStyle {
    /// The name by which programs and tests ask for it, such as `view.method.ssr`. It stays as it is in all languages
    /// and versions.
    pub name: &'static str,
    /// The message that names it; its attribute `.tip` explains it.
    pub key: &'static str,
    /// The command's icon.
    pub icon: MaterialIcon,
    /// Where it belongs.
    pub group: CommandGroup,
    /// The command's shortcuts, the usual one first.
    pub shortcuts: &'static [KeyboardShortcut],
}

impl CommandStyle {
    /// The shortcuts that the system leaves to the studio, the main one first.
    pub(crate) fn usable_shortcuts(&self) -> impl Iterator<Item = &'static KeyboardShortcut> {
        self.shortcuts.iter().filter(|shortcut| !cfg!(target_family = "wasm") || !is_of_browsers(shortcut))
    }
}

/// Whether browsers keep a shortcut for themselves: reload, tabs and windows, the address, the tools of developers.
fn is_of_browsers(shortcut: &KeyboardShortcut) -> bool {
    match shortcut.logical_key {
        Key::F5 | Key::F11 | Key::F12 => true,
        Key::L | Key::N | Key::R | Key::T | Key::W => shortcut.modifiers.command,
        _ => false,
    }
}

impl Command {
    /// All commands that need nothing to be said besides, in the order in which to show them.
    pub fn all() -> impl Iterator<Item = &'static Self> {
        table::ROWS.iter().map(|row| &row.command)
    }

    /// How it is shown; `None` for a command of which there is one for each file, example, thing or
    /// number.
    pub fn look(&self) -> Option<&'static CommandStyle> {
        table::ROWS.iter().find(|row| row.command == *self).map(|row| &row.look)
    }

    /// Its stable name, such as `edit.duplicate`; `None` for a command of which there is one for each file, example or
    /// thing.
    pub fn name(&self) -> Option<&'static str> {
        self.look().map(|look| look.name)
    }

    /// The command with a stable name.
    pub fn from_name(name: &str) -> Option<&'static Self> {
        table::ROWS.iter().find(|row| row.look.name == name).map(|row| &row.command)
    }
}

/// Each sum of an area as a command.
macro_rules! into_command {
    ($($variant:ident: $sum:ty),+ $(,)?) => {
        $(impl From<$sum> for Command {
            fn from(act: $sum) -> Self {
                Self::$variant(act)
            }
        })+
    };
}

into_command! {
    File: FileCommand,
    Picture: PictureCommand,
    Edit: Action,
    Selection: SelectionCommand,
    Add: AddCommand,
    Camera: CameraCommand,
    Display: DisplayCommand,
    Tool: ToolCommand,
    Audit: AuditCommand,
    Compare: CompareCommand,
    Measure: MeasureCommand,
    Window: WindowCommand,
    Help: HelpCommand,
}
