//! The widths of the panels beside the picture: they stay when the window changes, and the picture takes the rest.
//!
//! `egui_tiles` divides a row in proportion. At rest the shares of a row's panels are therefore their widths in points;
//! while a frame is drawn, they are the widths that the window has room for.

use egui_tiles::{Container, LinearDir, Shares, Tile, TileId, Tree};

use super::Pane;

/// The width of a panel at first, points.
const USUAL: f32 = 320.0;
/// A share below this is not a width in points: a panel that was just put there, or a remembered layout of an older
/// version, whose shares are parts of the window.
const LEAST_SHARE: f32 = 40.0;
/// The widest panel that is taken over from an older layout, points.
const MOST_FROM_OLDER: f32 = 420.0;
/// The width that panels leave to the picture as long as they can be narrower, points.
const PICTURE: f32 = 320.0;
/// The part of a small window that panels take at most.
const MOST_PART: f32 = 0.6;
/// The least width of a panel of names, points.
pub(crate) const LEAST_PANEL: f32 = 110.0;
/// The least width of a panel of values, points: narrower, three numbers side by side could not be read.
const LEAST_OF_VALUES: f32 = 200.0;

/// A row of panels while it is drawn.
pub(crate) struct FittedRow {
    row: TileId,
    panels: Vec<FittedPanel>,
}

struct FittedPanel {
    tile: TileId,
    /// The narrowest that it gets while others have more, points.
    least: f32,
    /// The width that its user gave it, points.
    wanted: f32,
    /// The width that it has in this frame, points.
    given: f32,
}

/// Gives each panel beside the picture its width in a window of `width` points, of which `gap` lie between panels.
pub(crate) fn fit(tree: &mut Tree<Pane>, width: f32, gap: f32) -> Vec<FittedRow> {
    let mut rows = Vec::new();
    let Some(mut inner) = tree.tiles.find_pane(&Pane::Viewport).filter(|&tile| tree.is_visible(tile)) else {
        return rows;
    };
    while let Some(outer) = tree.tiles.parent_of(inner) {
        let room = if tree.root == Some(outer) {
            Some(width)
        } else {
            tree.tiles.rect(outer).map(|rect| rect.width())
        };
        if let Some(panels) = room.and_then(|room| fit_row(tree, outer, inner, room, gap)) {
            rows.push(FittedRow { row: outer, panels });
        }
        inner = outer;
    }
    rows
}

/// Takes over the widths that were changed by hand while the frame was drawn, and brings the others back.
pub(crate) fn take_over(tree: &mut Tree<Pane>, rows: &[FittedRow]) {
    for FittedRow { row, panels } in rows {
        let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get_mut(*row) else { continue };
        for panel in panels.iter().filter(|panel| linear.children.contains(&panel.tile)) {
            let is_moved = (linear.shares[panel.tile] - panel.given).abs() > 0.01;
            if !is_moved {
                linear.shares.set_share(panel.tile, panel.wanted);
            }
        }
    }
}

fn fit_row(
    tree: &mut Tree<Pane>,
    row: TileId,
    picture: TileId,
    room: f32,
    gap: f32,
) -> Option<Vec<FittedPanel>> {
    let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get(row) else { return None };
    let seen: Vec<TileId> =
        linear.children.iter().copied().filter(|&tile| tree.tiles.is_visible(tile)).collect();
    if linear.dir != LinearDir::Horizontal || seen.len() < 2 || room <= 0.0 {
        return None;
    }
    let room = (room - gap * (seen.len() - 1) as f32).max(1.0);
    let wanted = wanted_widths(&linear.shares, &linear.children, room);
    let beside = wanted.iter().filter(|(tile, _)| *tile != picture && seen.contains(tile));
    let mut panels: Vec<FittedPanel> = beside
        .map(|&(tile, wanted)| FittedPanel { tile, least: least_width(tree, tile), wanted, given: wanted })
        .collect();
    shrink(&mut panels, (room - PICTURE).max(MOST_PART * room));
    let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get_mut(row) else { return None };
    for (tile, wanted) in wanted {
        linear.shares.set_share(tile, wanted);
    }
    for panel in &panels {
        linear.shares.set_share(panel.tile, panel.given);
    }
    let taken: f32 = panels.iter().map(|panel| panel.given).sum();
    linear.shares.set_share(picture, (room - taken).max(1.0));
    Some(panels)
}

/// The widths of all panels of a row in points, from whatever its shares are.
fn wanted_widths(shares: &Shares, children: &[TileId], room: f32) -> Vec<(TileId, f32)> {
    let sum: f32 = children.iter().map(|&tile| shares[tile]).sum();
    let is_older = sum < LEAST_SHARE;
    let width = |tile: TileId| match shares[tile] {
        share if is_older => (room * share / sum.max(1e-6)).clamp(LEAST_PANEL, MOST_FROM_OLDER),
        share if share < LEAST_SHARE => USUAL,
        share => share.max(LEAST_PANEL),
    };
    children.iter().map(|&tile| (tile, width(tile))).collect()
}

fn least_width(tree: &Tree<Pane>, tile: TileId) -> f32 {
    match tree.tiles.get(tile) {
        Some(Tile::Pane(Pane::Outliner | Pane::History)) | None => LEAST_PANEL,
        Some(Tile::Pane(_)) => LEAST_OF_VALUES,
        Some(Tile::Container(container)) => {
            container.children().map(|&child| least_width(tree, child)).fold(LEAST_PANEL, f32::max)
        }
    }
}

/// Makes panels narrower in proportion to what they can spare, so that all of them together take `room`.
fn shrink(panels: &mut [FittedPanel], room: f32) {
    let wanted: f32 = panels.iter().map(|panel| panel.wanted).sum();
    if wanted <= room {
        return;
    }
    let least: f32 = panels.iter().map(|panel| panel.least.min(panel.wanted)).sum();
    let kept = ((room - least) / (wanted - least).max(1e-3)).clamp(0.0, 1.0);
    // Where not even the least fits, all get their part of what there is.
    let part = (room / least.max(1.0)).min(1.0);
    for panel in panels {
        let least = panel.least.min(panel.wanted);
        panel.given = part * (least + kept * (panel.wanted - least));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::layout::default_layout;

    fn widths(tree: &Tree<Pane>, panes: [Pane; 3]) -> [f32; 3] {
        panes.map(|pane| {
            let mut tile = tree.tiles.find_pane(&pane).unwrap();
            loop {
                let parent = tree.tiles.parent_of(tile).unwrap();
                match tree.tiles.get(parent) {
                    Some(Tile::Container(Container::Linear(linear)))
                        if linear.dir == LinearDir::Horizontal =>
                    {
                        return linear.shares[tile];
                    }
                    _ => tile = parent,
                }
            }
        })
    }

    const ROW: [Pane; 3] = [Pane::Outliner, Pane::Viewport, Pane::Inspector];

    #[test]
    fn panels_keep_their_width_and_the_picture_takes_the_rest() {
        let mut tree = default_layout();
        let [outliner, _, inspector] = {
            let rows = fit(&mut tree, 1280.0, 2.0);
            let found = widths(&tree, ROW);
            take_over(&mut tree, &rows);
            found
        };
        for room in [1920.0, 3840.0, 700.0, 1280.0] {
            let rows = fit(&mut tree, room, 2.0);
            let [left, picture, right] = widths(&tree, ROW);
            assert!((left + picture + right - (room - 4.0)).abs() < 0.01, "{room}");
            assert!(picture >= (1.0 - MOST_PART) * (room - 4.0) - 0.01, "{room}: {picture}");
            if room >= 1280.0 {
                assert_eq!([left, right], [outliner, inspector], "{room}");
            } else {
                assert!(left < outliner && right < inspector, "{room}: {left} {right}");
            }
            take_over(&mut tree, &rows);
        }
    }

    #[test]
    fn in_any_window_every_panel_has_some_width() {
        let mut tree = default_layout();
        for room in [1.0, 60.0, 200.0, 333.0, 533.0, 800.0, 16384.0] {
            let rows = fit(&mut tree, room, 2.0);
            assert!(widths(&tree, ROW).iter().all(|width| *width > 0.0), "{room}");
            take_over(&mut tree, &rows);
        }
    }

    #[test]
    fn a_width_given_by_hand_stays() {
        let mut tree = default_layout();
        let rows = fit(&mut tree, 1280.0, 2.0);
        let row = rows[0].row;
        let inspector = rows[0].panels.last().unwrap().tile;
        if let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get_mut(row) {
            linear.shares.set_share(inspector, 400.0);
        }
        take_over(&mut tree, &rows);
        for room in [700.0, 2560.0] {
            let rows = fit(&mut tree, room, 2.0);
            take_over(&mut tree, &rows);
        }
        let _ = fit(&mut tree, 1920.0, 2.0);
        assert_eq!(widths(&tree, ROW)[2], 400.0);
    }

    #[test]
    fn an_older_layout_gets_widths_in_points() {
        let mut tree = default_layout();
        let rows = fit(&mut tree, 1000.0, 2.0);
        let row = rows[0].row;
        if let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get_mut(row) {
            for (&tile, share) in linear.children.clone().iter().zip([0.17, 0.58, 0.25]) {
                linear.shares.set_share(tile, share);
            }
        }
        let rows = fit(&mut tree, 1284.0, 2.0);
        let [left, _, right] = widths(&tree, ROW);
        assert!((left - 217.6).abs() < 0.1 && (right - 320.0).abs() < 0.1, "{left} {right}");
        take_over(&mut tree, &rows);
        let _ = fit(&mut tree, 3840.0, 2.0);
        let [wide_left, _, wide_right] = widths(&tree, ROW);
        assert_eq!([wide_left, wide_right], [left, right]);
    }
}
