//! The tabs of docked panels: their names, and the crosses that close them.

use egui::{
    Align2, Id, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo, vec2,
};
use egui_material_icons::icons::ICON_CLOSE;
use egui_tiles::{TabState, Tile, TileId, Tiles};

use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::paint_icon;
use crate::state::layout::Pane;

/// Beside the name of a tab, points.
const MARGIN: f32 = 9.0;
/// The side of a cross, points.
const CROSS: f32 = 18.0;

/// The name of a tab: that of its panel, or those of the panels in a group.
pub(super) fn title(texts: &Texts, tiles: &Tiles<Pane>, tile: TileId) -> String {
    match tiles.get(tile) {
        Some(Tile::Pane(pane)) => texts.get(pane.key()).to_owned(),
        Some(Tile::Container(container)) => {
            let seen = container.children().copied().filter(|&child| tiles.is_visible(child));
            seen.map(|child| title(texts, tiles, child)).collect::<Vec<_>>().join(" · ")
        }
        None => String::new(),
    }
}

/// The panels of a tab.
pub(super) fn panes_of(tiles: &Tiles<Pane>, tile: TileId) -> Vec<Pane> {
    match tiles.get(tile) {
        Some(Tile::Pane(pane)) => vec![*pane],
        Some(Tile::Container(container)) => {
            container.children().flat_map(|&child| panes_of(tiles, child)).collect()
        }
        None => Vec::new(),
    }
}

/// Draws a tab; returns whether it is to be closed.
pub(super) fn tab_ui(ui: &mut Ui, texts: &Texts, id: Id, name: &str, state: &TabState) -> (Response, bool) {
    let palette = theme::palette(ui.visuals());
    let color = if state.active { palette.text } else { palette.weak };
    let font = TextStyle::Button.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(name.to_owned(), font, color);
    let cross_room = if state.closable { CROSS - 2.0 } else { 0.0 };
    let size = vec2(galley.size().x + 2.0 * MARGIN + cross_room, ui.available_height());
    let (_, rect) = ui.allocate_space(size);
    let response = ui.interact(rect, id, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), state.active, name));
    if ui.is_rect_visible(rect) && !state.is_being_dragged {
        let fill = match (state.active, response.hovered()) {
            (true, _) => palette.panel,
            (false, true) => palette.hovered,
            (false, false) => palette.bar,
        };
        ui.painter().rect_filled(rect, 0.0, fill);
        if response.has_focus() {
            let ring = Stroke::new(1.0, palette.accent);
            ui.painter().rect_stroke(rect.shrink(1.0), 2.0, ring, StrokeKind::Inside);
        }
        let text = Align2::LEFT_CENTER.align_size_within_rect(galley.size(), rect.shrink2(vec2(MARGIN, 0.0)));
        ui.painter().galley(text.min, galley, color);
    }
    let is_closed = state.closable && cross_ui(ui, texts, id, rect, name);
    let is_closed = is_closed || (state.closable && response.middle_clicked());
    (response, is_closed)
}

/// The cross at the right of a tab.
fn cross_ui(ui: &Ui, texts: &Texts, id: Id, tab: Rect, name: &str) -> bool {
    let center = tab.right_center() - vec2(0.5 * CROSS + 3.0, 0.0);
    let rect = Rect::from_center_size(center, Vec2::splat(CROSS));
    let response = ui.interact(rect, id.with("close"), Sense::click());
    let label = texts.with("pane-close", &[("name", name.into())]);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), &label));
    let palette = theme::palette(ui.visuals());
    let is_lit = response.hovered() || response.has_focus();
    if is_lit {
        ui.painter().rect_filled(rect, 4.0, palette.hovered);
    }
    paint_icon(ui, ICON_CLOSE, center, 13.0, if is_lit { palette.text } else { palette.weak });
    response.on_hover_text(label).clicked()
}
