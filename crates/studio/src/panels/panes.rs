//! The docked panels: which one draws what.

mod tabs;

use egui::{Frame, Id, Margin, Response, Ui, Visuals, WidgetText};
use egui_tiles::{SimplificationOptions, TabState, Tabs, TileId, Tiles, UiResponse};

use crate::base::theme;
use crate::panels::audit::{AuditListing, panel_ui};
use crate::panels::compare::{CompareState, compare_ui};
use crate::panels::example_note::{ExampleNote, note_below};
use crate::panels::history::history_ui;
use crate::panels::inspector::{Inspector, inspector_ui};
use crate::panels::materials::{MaterialBrowser, materials_ui};
use crate::panels::measure::{MeasureState, measure_ui};
use crate::panels::outliner::{Outliner, outliner_ui};
use crate::panels::problems::{ProblemsPanel, problems_ui};
use crate::panels::viewport::{Viewport, viewport_ui};
use crate::state::context::Cx;
use crate::state::layout::{self, Pane};

/// What lies between panels, points.
pub(crate) const GAP: f32 = 2.0;

/// The state of the panels.
#[derive(Default)]
pub(crate) struct Panes {
    pub(crate) viewport: Viewport,
    pub(crate) outliner: Outliner,
    pub(crate) inspector: Inspector,
    pub(crate) problems: ProblemsPanel,
    pub(crate) compare: CompareState,
    pub(crate) measure: MeasureState,
    pub(crate) materials: MaterialBrowser,
    pub(crate) audit: AuditListing,
    pub(crate) example_note: ExampleNote,
}

/// The behavior of the docked panels for `egui_tiles`.
pub(crate) struct PaneBehavior<'a> {
    pub(crate) cx: Cx<'a>,
    pub(crate) panes: &'a mut Panes,
    /// The viewport's tile, which needs no title while it stands alone.
    pub(crate) viewport: Option<TileId>,
    /// The panels whose tabs are closed: they are hidden after the frame, since a layout must not change while it is
    /// drawn.
    pub(crate) closed: Vec<Pane>,
}

impl egui_tiles::Behavior<Pane> for PaneBehavior<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _tile: TileId, pane: &mut Pane) -> UiResponse {
        let cx = &mut self.cx;
        let panes = &mut *self.panes;
        if *pane == Pane::Viewport {
            if cx.view.is_auditing && cx.audit.pin().is_some() {
                // The panel of the audit needs the room, and the picture must keep its place.
                viewport_ui(ui, cx, &mut panes.viewport);
                return UiResponse::None;
            }
            let texts = cx.texts;
            note_below(ui, texts, &mut panes.example_note, |ui| viewport_ui(ui, cx, &mut panes.viewport));
            return UiResponse::None;
        }
        let fill = theme::palette(ui.visuals()).panel;
        Frame::new().fill(fill).inner_margin(Margin::symmetric(10, 8)).show(ui, |ui| {
            match pane {
                Pane::Viewport => {}
                Pane::Outliner => outliner_ui(ui, cx, &mut panes.outliner),
                Pane::Inspector => inspector_ui(ui, cx, &mut panes.inspector),
                Pane::History => history_ui(ui, cx),
                Pane::Audit => panel_ui(ui, cx, &mut panes.audit),
                Pane::Problems => problems_ui(ui, cx, &mut panes.problems),
                Pane::Compare => compare_ui(ui, cx, &mut panes.compare),
                Pane::Measure => measure_ui(ui, cx, &mut panes.measure),
                Pane::Materials => materials_ui(ui, cx, &mut panes.materials),
            }
            ui.allocate_space(ui.available_size());
        });
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> WidgetText {
        self.cx.t(pane.key()).into()
    }

    fn tab_title_for_tile(&mut self, tiles: &Tiles<Pane>, tile: TileId) -> WidgetText {
        tabs::title(self.cx.texts, tiles, tile).into()
    }

    /// The picture stays: everything else is about it.
    fn is_tab_closable(&self, tiles: &Tiles<Pane>, tile: TileId) -> bool {
        !tabs::panes_of(tiles, tile).contains(&Pane::Viewport)
    }

    fn tab_ui(
        &mut self,
        tiles: &mut Tiles<Pane>,
        ui: &mut Ui,
        id: Id,
        tile: TileId,
        state: &TabState,
    ) -> Response {
        let name = tabs::title(self.cx.texts, tiles, tile);
        let (response, is_closed) = tabs::tab_ui(ui, self.cx.texts, id, &name, state);
        if is_closed {
            // Panels are hidden by themselves, so that each of a group can be shown again.
            self.closed.extend(tabs::panes_of(tiles, tile));
            // The tool and its panel are open together.
            self.cx.view.is_auditing &= !self.closed.contains(&Pane::Audit);
        }
        response
    }

    fn is_tab_bar_visible(&self, _tile: TileId, tabs: &Tabs) -> bool {
        tabs.children.len() != 1 || tabs.active != self.viewport
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions { all_panes_must_have_tabs: true, ..SimplificationOptions::default() }
    }

    fn tab_bar_height(&self, _style: &egui::Style) -> f32 {
        28.0
    }

    fn min_size(&self) -> f32 {
        layout::LEAST_PANEL
    }

    fn gap_width(&self, _style: &egui::Style) -> f32 {
        GAP
    }

    fn tab_bar_color(&self, visuals: &Visuals) -> egui::Color32 {
        theme::palette(visuals).bar
    }
}
