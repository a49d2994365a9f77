//! The studio: its state, and what happens in one frame.

use catoptric_editor::Editor;
use catoptric_live::{DisplayContent, Live, Request};
use catoptric_scene::{Camera, Scene};
use egui::{CentralPanel, Frame, Panel, SurrenderFocusOn, Ui};
use egui_tiles::Tree;
use glam::DVec2;

use crate::StudioError;
use crate::audit::{self, AuditState};
use crate::card::{self, WindowCard};
use crate::command::Command;
use crate::context::Cx;
use crate::dialogs::Dialogs;
use crate::documents::Documents;
use crate::exact::ExactState;
use crate::exports::Exports;
use crate::first_steps::FirstSteps;
use crate::help::HelpWindow;
use crate::host::Host;
use crate::images::DocumentImages;
use crate::layout::{self, Pane};
use crate::manual::ManualWindow;
use crate::maps::MapState;
use crate::menu::MenuFocus;
use crate::notices::Toasts;
use crate::palette::CommandPalette;
use crate::panes::{PaneBehavior, Panes};
use crate::pictures::{self, RenderedPictures};
use crate::settings::Settings;
use crate::texts::Texts;
use crate::theme;
use crate::view::ViewState;
use crate::viewport::Projector;
use crate::window::Interruption;
use crate::{
    compare, documents, example_note, exports, images, measure, menu, panes, picture_frame, shortcuts,
    status_bar,
};

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
    pub(crate) documents: Documents,
    pub(crate) dialogs: Dialogs,
    pub(crate) palette: CommandPalette,
    pub(crate) help: HelpWindow,
    pub(crate) manual: ManualWindow,
    pub(crate) first_steps: FirstSteps,
    pub(crate) menu_focus: MenuFocus,
    pub(crate) keys: shortcuts::ShortcutState,
    pub(crate) toasts: Toasts,
    pub(crate) host: Box<dyn Host>,
    pub(crate) commands: Vec<Command>,
    pub(crate) panes: Panes,
    pub(crate) pictures: RenderedPictures,
    pub(crate) exports: Exports,
    pub(crate) images: DocumentImages,
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
}

impl Studio {
    /// Makes the studio for a window of `context`.
    ///
    /// # Errors
    /// When the thread that traces cannot be started.
    pub fn new(
        context: &egui::Context,
        start: &StartDocument,
        host: Box<dyn Host>,
    ) -> Result<Self, StudioError> {
        Self::interruptible(context, start, host, None)
    }

    /// Builds the studio with a way to end it from outside.
    pub(crate) fn interruptible(
        context: &egui::Context,
        start: &StartDocument,
        host: Box<dyn Host>,
        interruption: Option<Interruption>,
    ) -> Result<Self, StudioError> {
        let settings = host.settings_path().map_or_else(Settings::first, |path| Settings::load(&path));
        theme::install(context);
        theme::choose(context, settings.theme);
        context.options_mut(|options| {
            options.zoom_with_keyboard = false;
            // As desktops have it; egui's own is too short for slow displays.
            options.input_options.max_double_click_delay = 0.45;
            // A field is left, and its text taken, before the click does what it does elsewhere.
            options.input_options.surrender_focus_on = SurrenderFocusOn::Presses;
        });
        context.set_zoom_factor(settings.zoom);
        let wake = context.clone();
        let live = Live::start(move || wake.request_repaint()).map_err(StudioError::Thread)?;
        let layout = settings.layout.clone().filter(layout::is_whole).unwrap_or_else(layout::default_layout);
        let mut studio = Self {
            editor: Editor::new(Scene::default()),
            texts: Texts::new(settings.language),
            settings,
            view: ViewState::default(),
            audit: AuditState::default(),
            maps: MapState::default(),
            exact: ExactState::default(),
            live,
            card: WindowCard::default(),
            layout,
            documents: Documents::default(),
            dialogs: Dialogs::default(),
            palette: CommandPalette::default(),
            help: HelpWindow::default(),
            manual: ManualWindow::default(),
            first_steps: FirstSteps::default(),
            menu_focus: MenuFocus::default(),
            keys: shortcuts::ShortcutState::default(),
            toasts: Toasts::default(),
            host,
            commands: Vec::new(),
            panes: Panes::default(),
            pictures: RenderedPictures::default(),
            exports: Exports::default(),
            images: DocumentImages::default(),
        };
        studio.panes.compare.choose(&studio.settings.compared);
        documents::start(context, &mut studio, start, interruption);
        Ok(studio)
    }

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

    /// Has `command` done at the end of the next frame.
    pub fn run(&mut self, command: Command) {
        self.commands.push(command);
    }

    /// Draws the window and does what was asked for in it.
    pub fn ui(&mut self, ui: &mut Ui) {
        self.view.is_moving = false;
        shortcuts::collect(ui, self);
        let palette = theme::palette(ui.visuals());
        let bar = Frame::new().fill(palette.bar).inner_margin(egui::Margin::symmetric(8, 3));
        Panel::top("menu").frame(bar).show(ui, |ui| menu::menu_ui(ui, self));
        documents::banner_ui(ui, self);
        audit::keep_up(ui.ctx(), &mut self.cx());
        Panel::bottom("status").frame(bar).show(ui, |ui| status_bar::status_ui(ui, &mut self.cx()));
        CentralPanel::default().frame(Frame::new().fill(palette.bar)).show(ui, |ui| self.panes_ui(ui));
        audit::open_panel(ui.ctx(), self);
        crate::first_steps::first_steps_ui(ui.ctx(), self);
        crate::manual::manual_ui(ui.ctx(), self);
        pictures::pictures_ui(ui, self);
        crate::dialogs::dialogs_ui(ui, self);
        crate::palette::palette_ui(ui.ctx(), self);
        crate::help::help_ui(ui.ctx(), self);
        documents::progress_ui(ui, self);
        self.toasts.show(ui.ctx(), self.texts.get("close"));
        for command in std::mem::take(&mut self.commands) {
            crate::run::run(ui.ctx(), self, command);
            // What it did is seen in the next frame, and a text to be pasted comes with it.
            ui.ctx().request_repaint();
        }
        example_note::keep(self);
        card::keep_up(self);
        documents::keep(ui.ctx(), self);
        images::keep(ui.ctx(), self);
        compare::keep_up(ui.ctx(), self);
        compare::poll_opening(ui.ctx(), self);
        exports::poll(ui.ctx(), self);
        measure::keep_up(ui.ctx(), self);
        self.settle(ui);
        self.request_picture();
    }

    /// The device that draws the window is lost: makes the studio ready for another window. `context` goes on, too.
    pub fn outlive_window(&mut self, context: &egui::Context) {
        documents::outlive_window(self);
        let key = if self.card.leave_window(&self.live) { "window-lost-card" } else { "window-lost" };
        self.toasts.warning(self.texts.get(key)).duration(None);
        // What lay in the memory of the device is made anew when it is wanted.
        self.panes.viewport.forget_textures();
        self.panes.compare.forget_textures();
        self.panes.materials.forget_textures();
        self.dialogs.forget_textures();
        self.maps.forget_textures();
        self.pictures.forget_textures();
        // So are the glyphs; the toolkit brings the system's fonts along with each window.
        context.set_font_providers(Vec::new());
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

    /// Ends the open gesture when nothing is being dragged or typed any more: it becomes one step of the history.
    fn settle(&mut self, ui: &Ui) {
        let is_pointer_down = ui.input(|input| input.pointer.any_down());
        // Lists and pages have the focus while they are used, and nothing is typed into them.
        let lists = [crate::outliner::list_id(), crate::materials::list_id(), crate::manual::page_id()];
        let is_used = ui.memory(egui::Memory::focused).is_some_and(|id| !lists.contains(&id));
        if !is_pointer_down && !self.view.is_moving && !is_used {
            self.editor.settle();
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
                DisplayContent::UnfoldedCube(self.editor.selection().bodies().next())
            }
            shows => shows,
        }
    }

    /// Tells the tracer what to show; it finds out what has changed.
    fn request_picture(&mut self) {
        let Some(size) = self.panes.viewport.size_in_pixels() else { return };
        let scene = self.editor.scene();
        let mut request = Request::new(scene.clone(), self.editor.revision(), size);
        request.camera = self.shown_camera();
        request.method = self.settings.methods.method();
        request.shows = self.shown();
        request.moving = self.view.is_moving || self.editor.is_in_gesture();
        request.samples = self.settings.viewport_samples;
        request.development = self.view.development;
        request.outline = self.editor.selection().bodies().collect();
        request.hover = self.view.hovered_body;
        request.grid = self.settings.shows_grid.then(catoptric_live::GridSpec::default);
        request.paused = self.view.is_rendering || self.panes.compare.is_running();
        if self.view.is_measuring {
            // Nothing else is to be traced meanwhile.
            request.size = [0, 0];
        }
        self.live.request(request);
    }

    fn panes_ui(&mut self, ui: &mut Ui) {
        let mut layout = std::mem::replace(&mut self.layout, Tree::empty(egui::Id::unique("being drawn")));
        let mut kept = std::mem::take(&mut self.panes);
        let viewport = layout.tiles.find_pane(&Pane::Viewport);
        let rows = layout::fit(&mut layout, ui.available_width(), panes::GAP);
        let mut docked = PaneBehavior { cx: self.cx(), panes: &mut kept, viewport, closed: Vec::new() };
        layout.ui(&mut docked, ui);
        let closed = docked.closed;
        layout::take_over(&mut layout, &rows);
        for pane in closed {
            layout::set_visible(&mut layout, pane, false);
        }
        self.layout = layout;
        self.panes = kept;
        if !layout::is_in_front(&self.layout, Pane::Viewport) {
            self.view.seen = None;
        }
    }
}

impl eframe::App for Studio {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        Self::ui(self, ui);
    }

    fn on_exit(&mut self) {
        documents::leave(self);
    }
}
