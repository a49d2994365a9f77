//! A frame of the window, and the begin of the studio.

use catoptric_editor::Editor;
use catoptric_live::{Live, Request};
use catoptric_platform::time::{Duration, Instant};
use catoptric_scene::{Scene, ScenePart};
use egui::{CentralPanel, Context, Frame, Panel, SurrenderFocusOn, Ui};
use egui_tiles::Tree;

use crate::base::focus_turns::FocusTurns;
use crate::base::notices::Toasts;
use crate::base::texts::Texts;
use crate::base::{theme, tree_roles};
use crate::panels::panes::{self, PaneBehavior, Panes};
use crate::panels::{materials, outliner, status_bar};
use crate::shell::failure::StudioError;
use crate::shell::first_steps::{FirstSteps, first_steps_ui};
use crate::shell::help::{self, HelpWindow};
use crate::shell::host::Host;
use crate::shell::interruption::Interruption;
use crate::shell::manual::{self, ManualWindow};
use crate::shell::menu_focus::MenuFocus;
use crate::shell::palette::{CommandPalette, PaletteAction, palette_ui};
use crate::shell::studio::dialogs::{self, Dialogs};
use crate::shell::studio::documents::Documents;
use crate::shell::studio::exports::Exports;
use crate::shell::studio::pictures::RenderedPictures;
use crate::shell::studio::{ShortcutState, StartDocument, Studio};
use crate::shell::{
    audit, card, compare, documents, exports, images, measure, menu, pictures, run, shortcuts,
};
use crate::state::audit::AuditState;
use crate::state::card::WindowCard;
use crate::state::exact::ExactState;
use crate::state::images::DocumentImages;
use crate::state::layout::{self, Pane, SpareLayouts};
use crate::state::maps::MapState;
use crate::state::settings::Settings;
use crate::state::view::ViewState;

impl Studio {
    /// Makes the studio for a window of `context`.
    ///
    /// # Errors
    /// When the thread that traces cannot be started.
    pub fn new(context: &Context, start: &StartDocument, host: Box<dyn Host>) -> Result<Self, StudioError> {
        Self::interruptible(context, start, host, None)
    }

    /// Builds the studio with a way to end it from outside.
    pub(crate) fn interruptible(
        context: &Context,
        start: &StartDocument,
        host: Box<dyn Host>,
        interruption: Option<Interruption>,
    ) -> Result<Self, StudioError> {
        let settings = host.settings_path().map_or_else(Settings::first, |path| Settings::load(&path));
        theme::install(context);
        FocusTurns::install(context);
        tree_roles::install(context);
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
            spare_layouts: SpareLayouts::default(),
            documents: Documents::default(),
            dialogs: Dialogs::default(),
            palette: CommandPalette::default(),
            help: HelpWindow::default(),
            manual: ManualWindow::default(),
            first_steps: FirstSteps::default(),
            menu_focus: MenuFocus::default(),
            keys: ShortcutState::default(),
            toasts: Toasts::default(),
            host,
            commands: Vec::new(),
            panes: Panes::default(),
            pictures: RenderedPictures::default(),
            exports: Exports::default(),
            images: DocumentImages::default(),
            image_prompt: None,
            compare_prompt: None,
        };
        studio.panes.compare.choose(&studio.settings.compared);
        documents::start(context, &mut studio, start, interruption);
        Ok(studio)
    }

    /// Whether a crash would lose nothing: all work is in a file, or kept to be offered at the next start.
    pub fn is_kept(&mut self) -> bool {
        documents::is_kept(self)
    }

    /// Draws the window and does what was asked for in it.
    pub fn ui(&mut self, ui: &mut Ui) {
        let begin = Instant::now();
        self.view.is_moving = false;
        shortcuts::collect(ui, self);
        let palette = theme::palette(ui.visuals());
        let bar = Frame::new().fill(palette.bar).inner_margin(egui::Margin::symmetric(8, 3));
        if !self.view.is_alone {
            Panel::top("menu").frame(bar).show(ui, |ui| menu::menu_ui(ui, self));
            documents::banner_ui(ui, self);
        }
        self.audit.keep_up(ui.ctx());
        if !self.view.is_measuring {
            self.audit.want(ui.ctx(), &self.editor, &self.live);
        }
        if !self.view.is_alone {
            Panel::bottom("status").frame(bar).show(ui, |ui| status_bar::status_ui(ui, &mut self.cx()));
        }
        CentralPanel::default().frame(Frame::new().fill(palette.bar)).show(ui, |ui| self.panes_ui(ui));
        audit::open_panel(ui.ctx(), self);
        if !self.view.is_alone {
            self.first_steps_ui(ui.ctx());
        }
        let is_behind = self.dialogs.is_any_open();
        manual::manual_ui(ui.ctx(), &self.texts, &mut self.manual, is_behind);
        pictures::pictures_ui(ui, self);
        dialogs::dialogs_ui(ui, self);
        self.palette_ui(ui.ctx());
        help::help_ui(ui.ctx(), &self.texts, &mut self.help);
        documents::progress_ui(ui, self);
        self.toasts.show(ui.ctx(), self.texts.get("close"));
        for command in std::mem::take(&mut self.commands) {
            run::run(ui.ctx(), self, command);
            // What it did is seen in the next frame, and a text to be pasted comes with it.
            ui.ctx().request_repaint();
        }
        if !self.view.is_alone {
            self.keep_example_note();
        }
        card::keep_up(self);
        documents::keep(ui.ctx(), self);
        images::keep(ui.ctx(), self);
        compare::keep_up(ui.ctx(), self);
        compare::poll_opening(ui.ctx(), self);
        exports::poll(ui.ctx(), self);
        measure::keep_up(ui.ctx(), self);
        self.settle(ui);
        self.request_picture();
        self.trace_slice(ui.ctx(), begin);
    }

    fn first_steps_ui(&mut self, context: &Context) {
        // The hint would lie over the window of a picture, and over its buttons.
        let view = self.visible_rect().filter(|_| !self.pictures.has_windows());
        let mut steps = std::mem::take(&mut self.first_steps);
        first_steps_ui(context, &mut self.cx(), &mut steps, view);
        self.first_steps = steps;
    }

    fn palette_ui(&mut self, context: &Context) {
        let mut palette = std::mem::take(&mut self.palette);
        let chosen = palette_ui(context, self.situation(), &mut palette);
        self.palette = palette;
        match chosen {
            Some(PaletteAction::Run(command)) => self.run(command),
            Some(PaletteAction::Select(item)) => self.editor.select(item),
            None => {}
        }
    }

    fn keep_example_note(&mut self) {
        let is_busy = self.dialogs.is_any_open() || self.help.is_any_open() || self.manual.has_keys();
        let documents = &self.documents;
        self.panes.example_note.keep(documents.number(), documents.example(), is_busy);
    }

    /// The device that draws the window is lost: makes the studio ready for another window. `context` goes on, too.
    pub fn outlive_window(&mut self, context: &Context) {
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

    /// Ends the open gesture when nothing is being dragged or typed any more: it becomes one step of the history.
    fn settle(&mut self, ui: &Ui) {
        let is_pointer_down = ui.input(|input| input.pointer.any_down());
        // Lists and pages have the focus while they are used, and nothing is typed into them.
        let lists = [outliner::list_id(), materials::list_id(), manual::page_id()];
        let is_used = ui.memory(egui::Memory::focused).is_some_and(|id| !lists.contains(&id));
        if !is_pointer_down && !self.view.is_moving && !is_used {
            self.editor.settle();
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
        request.outline = self.editor.selected_bodies().collect();
        request.hover = self.view.hovered_body.and_then(|body| match self.editor.edited().part(body)? {
            ScenePart::Body(index) => Some(index),
            _ => None,
        });
        request.grid = self.settings.shows_grid.then(catoptric_live::GridSpec::default);
        request.paused = self.view.is_rendering || self.panes.compare.is_running();
        if self.view.is_measuring {
            // Nothing else is to be traced meanwhile.
            request.size = [0, 0];
        }
        self.live.request(request);
    }

    /// Traces for a moment where the tracer has no thread of its own: as long as the rest of the frame took, so that slow
    /// windows do not starve it.
    fn trace_slice(&self, context: &Context, begin: Instant) {
        /// What a frame may take for it at least.
        const LEAST: Duration = Duration::from_millis(8);
        if !self.live.has_thread() {
            let now = Instant::now();
            self.live.advance(now + (now - begin).max(LEAST));
            if !self.live.status().is_idle {
                context.request_repaint();
            }
        }
    }

    fn panes_ui(&mut self, ui: &mut Ui) {
        let mut layout = std::mem::replace(&mut self.layout, Tree::empty(egui::Id::unique("being drawn")));
        self.spare_layouts.keep_up(&mut layout, ui.available_size());
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
