//! The state of the studio. What it does stands in the other modules of the shell.

pub(crate) mod autosave;
pub(crate) mod dialogs;
pub(crate) mod documents;
pub(crate) mod exports;
pub(crate) mod file_prompt;
mod picture_proof;
pub(crate) mod pictures;
pub(crate) mod recovery;
pub(crate) mod watch;

use catoptric_editor::Editor;
use catoptric_live::{DisplayContent, Live};
use catoptric_scene::Camera;
use egui_tiles::Tree;
use glam::DVec2;

use crate::base::held_keys::HeldKeys;
use crate::base::notices::Toasts;
use crate::base::picture_frame;
use crate::base::projector::Projector;
use crate::base::texts::Texts;
use crate::panels::panes::Panes;
use crate::shell::first_steps::FirstSteps;
use crate::shell::help::HelpWindow;
use crate::shell::host::Host;
use crate::shell::manual::ManualWindow;
use crate::shell::menu_focus::MenuFocus;
use crate::shell::palette::CommandPalette;
use crate::state::audit::AuditState;
use crate::state::card::WindowCard;
use crate::state::command::Command;
use crate::state::command_context::{CommandContext, LabState};
use crate::state::context::Cx;
use crate::state::exact::ExactState;
use crate::state::images::{DocumentImages, ImageUse};
use crate::state::layout::{self, Pane, SpareLayouts};
use crate::state::maps::MapState;
use crate::state::settings::Settings;
use crate::state::view::ViewState;
use dialogs::Dialogs;
use documents::Documents;
use exports::Exports;
use file_prompt::FilePrompt;
use pictures::RenderedPictures;

/// The whole window.
pub struct Studio {
    pub(crate) editor: Editor,
    pub(crate) texts: Texts,
    pub(crate) settings: Settings,
    pub(crate) view: ViewState,
    pub(crate) audit: AuditState,
    pub(crate) maps: MapState,
    pub(crate) exact: ExactState,
    pub(crate) live: Live,
    pub(crate) card: WindowCard,
    pub(crate) layout: Tree<Pane>,
    pub(crate) spare_layouts: SpareLayouts,
    pub(crate) documents: Documents,
    pub(crate) dialogs: Dialogs,
    pub(crate) palette: CommandPalette,
    pub(crate) help: HelpWindow,
    pub(crate) manual: ManualWindow,
    pub(crate) first_steps: FirstSteps,
    pub(crate) menu_focus: MenuFocus,
    pub(crate) keys: ShortcutState,
    pub(crate) toasts: Toasts,
    pub(crate) host: Box<dyn Host>,
    pub(crate) commands: Vec<Command>,
    pub(crate) panes: Panes,
    pub(crate) pictures: RenderedPictures,
    pub(crate) exports: Exports,
    pub(crate) images: DocumentImages,
    /// The choice of a picture for the scene, with the number of the document that is to have it.
    pub(crate) image_prompt: Option<(FilePrompt, ImageUse, u64)>,
    /// The choice of a picture file for one of the two sides that are compared.
    pub(crate) compare_prompt: Option<(FilePrompt, usize)>,
}

/// The state of the keyboard from frame to frame.
#[derive(Debug, Default)]
pub(crate) struct ShortcutState {
    /// The keys that are held.
    pub(crate) held: HeldKeys,
    /// A command has asked for the clipboard in this frame; its text comes with the next one, whatever has the focus
    /// then. No text comes when the clipboard holds none.
    pub(crate) is_paste_asked: bool,
}

/// The document to open at the start.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum StartDocument {
    /// The scene of the last time, or else a beautiful example.
    #[default]
    Last,
    /// A scene file.
    File(std::path::PathBuf),
    /// A built-in example, by name.
    Example(String),
    /// What a [link](crate::host::Host::copy_link) holds.
    Link(String),
}

impl Studio {
    /// The open document.
    pub fn editor(&self) -> &Editor {
        &self.editor
    }

    /// The open document, to be changed from outside the window.
    pub fn editor_mut(&mut self) -> &mut Editor {
        &mut self.editor
    }

    /// What is remembered.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The messages of the present language.
    pub fn texts(&self) -> &Texts {
        &self.texts
    }

    /// The traced picture.
    pub fn live(&self) -> &Live {
        &self.live
    }

    /// Whether the document is being written to a file.
    pub fn is_saving(&self) -> bool {
        self.documents.is_saving()
    }

    /// Whether a scene file is being read.
    pub fn is_opening(&self) -> bool {
        self.documents.is_opening()
    }

    /// Whether a picture that the scene names is being read.
    pub fn is_opening_images(&self) -> bool {
        self.images.is_opening()
    }

    /// Whether a final picture is being rendered.
    pub fn is_rendering(&self) -> bool {
        self.pictures.is_rendering()
    }

    /// Whether times are being measured.
    pub fn is_measuring(&self) -> bool {
        self.panes.measure.is_running()
    }

    /// Whether there is a finished comparison of what was chosen last.
    pub fn is_compared(&self) -> bool {
        self.panes.compare.is_found() && !self.panes.compare.is_running()
    }

    /// How many materials of the browser have been pictured so far.
    pub fn pictured_materials(&self) -> usize {
        self.panes.materials.pictured()
    }

    /// Where the whole picture is in the window, points, once it has been drawn; a panel may cover a part of it.
    pub fn viewport_rect(&self) -> Option<egui::Rect> {
        self.panes.viewport.rect()
    }

    /// Where the picture is seen in the window, points.
    pub fn visible_rect(&self) -> Option<egui::Rect> {
        self.panes.viewport.visible_rect()
    }

    /// The camera that the picture is seen through: the scene's, or that of the free view.
    pub fn view_camera(&self) -> Camera {
        self.view.camera(self.editor.scene())
    }

    /// The audited pixel, as column and row of a picture of so many columns and rows.
    pub fn audited_pixel(&self) -> Option<[[u32; 2]; 2]> {
        self.audit.pin().map(|pin| [pin.pixel.into(), pin.size.into()])
    }

    /// Where a panel is in the window, points, while it is seen.
    pub fn pane_rect(&self, pane: Pane) -> Option<egui::Rect> {
        self.layout.tiles.rect(self.layout.tiles.find_pane(&pane)?)
    }

    /// How many rays the audited pixel has, once they have been traced.
    pub fn audit_rays(&self) -> Option<usize> {
        self.audit.found()?.tree().map(|tree| tree.nodes.len())
    }

    /// Where a ray of the audit begins and ends in the window, points, if it is seen; rays are counted from 0.
    pub fn audit_ray_in_window(&self, ray: usize) -> Option<[egui::Pos2; 2]> {
        let (camera, rect) = (self.live.latest()?.camera, self.viewport_rect()?);
        let way = self.audit.found()?.ways.iter().find(|way| way.is_ray() && way.node == ray)?;
        let size = DVec2::new(rect.width().into(), rect.height().into());
        let ends = Projector::new(&camera, size).segment(way.from, way.to)?;
        Some(ends.map(|end| rect.min + egui::vec2(end.x as f32, end.y as f32)))
    }

    /// Leaves nothing but the picture, for somebody's page: what is pinned, selected and turned there can still be.
    pub fn show_picture_alone(&mut self) {
        self.view.is_alone = true;
        (self.settings.shows_grid, self.settings.shows_handles) = (false, false);
        for pane in Pane::ALL {
            layout::set_visible(&mut self.layout, pane, pane == Pane::Viewport);
        }
    }

    /// Has `command` done at the end of the next frame.
    pub fn run(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }

    /// The parts that panels see.
    pub(crate) fn cx(&mut self) -> Cx<'_> {
        Cx {
            editor: &mut self.editor,
            texts: &self.texts,
            settings: &mut self.settings,
            view: &mut self.view,
            held_keys: &self.keys.held,
            audit: &mut self.audit,
            maps: &mut self.maps,
            exact: &mut self.exact,
            live: &self.live,
            images: &self.images,
            card: &mut self.card,
            commands: &mut self.commands,
        }
    }

    /// What decides about commands.
    pub(crate) fn situation(&self) -> CommandContext<'_> {
        CommandContext {
            editor: &self.editor,
            texts: &self.texts,
            settings: &self.settings,
            lab: Some(LabState {
                is_compared: self.panes.compare.is_found(),
                is_measuring: self.panes.measure.is_running(),
                is_measured: self.panes.measure.is_measured(),
            }),
            view: &self.view,
            audit: &self.audit,
            maps: &self.maps,
            exact: &self.exact,
            live: &self.live,
            card: &self.card,
            host: self.host.abilities(),
            example_note: self.panes.example_note.is_open(),
            layout: Some(&self.layout),
        }
    }

    /// The camera whose picture is asked for.
    pub(crate) fn shown_camera(&self) -> Camera {
        let camera = self.view.eased.unwrap_or_else(|| self.view.camera(self.editor.scene()));
        picture_frame::fitted(&camera, self.panes.viewport.aspect(), self.settings.picture_aspect())
    }

    /// What of the drawing is asked for: of cube maps, that of the selected body.
    pub(crate) fn shown(&self) -> DisplayContent {
        match self.view.shows {
            DisplayContent::UnfoldedCube(_) => {
                DisplayContent::UnfoldedCube(self.editor.selected_bodies().next())
            }
            shows => shows,
        }
    }
}
