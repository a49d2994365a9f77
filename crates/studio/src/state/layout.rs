//! The docked panels and their first arrangement.

mod columns;
mod narrow;

use egui_tiles::{Container, Linear, LinearDir, Tabs, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

pub(crate) use columns::{LEAST_PANEL, fit, take_over};
pub(crate) use narrow::{SpareLayouts, is_narrow};

/// The widths of the panels beside the picture at first, points.
const OUTLINER: f32 = 220.0;
const INSPECTOR: f32 = 340.0;

/// A panel that can be docked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Pane {
    /// The traced picture.
    Viewport,
    /// Bodies, lights, camera, materials.
    Outliner,
    /// The values of what is selected.
    Inspector,
    /// The steps of editing.
    History,
    /// What is wrong in the file.
    Problems,
    /// The rays behind a pixel.
    Audit,
    /// Two pictures and how they differ.
    Compare,
    /// How long pictures take.
    Measure,
    /// Materials to choose from.
    Materials,
}

impl Pane {
    /// All panels.
    pub const ALL: [Self; 9] = [
        Self::Viewport,
        Self::Outliner,
        Self::Inspector,
        Self::History,
        Self::Problems,
        Self::Audit,
        Self::Compare,
        Self::Measure,
        Self::Materials,
    ];

    /// The panels of the drawer that older layouts lack; they are put there when they are asked for, and want room.
    const DRAWER: [Self; 4] = [Self::Audit, Self::Compare, Self::Measure, Self::Materials];

    /// The message that names the panel.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Viewport => "pane-viewport",
            Self::Outliner => "pane-outliner",
            Self::Inspector => "pane-inspector",
            Self::History => "pane-history",
            Self::Problems => "pane-problems",
            Self::Audit => "pane-audit",
            Self::Compare => "pane-compare",
            Self::Measure => "pane-measure",
            Self::Materials => "pane-materials",
        }
    }
}

/// Outliner and history at the left, the picture in the middle, the inspector at the right, the drawer with problems,
/// the lab and the materials below (hidden until there is something in it).
pub(crate) fn default_layout() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let viewport = tabs_of(&mut tiles, &[Pane::Viewport]);
    let outliner = tabs_of(&mut tiles, &[Pane::Outliner, Pane::History]);
    let inspector = tabs_of(&mut tiles, &[Pane::Inspector]);
    let drawer =
        tabs_of(&mut tiles, &[Pane::Problems, Pane::Audit, Pane::Compare, Pane::Measure, Pane::Materials]);
    let middle = divided(&mut tiles, LinearDir::Vertical, &[(viewport, 0.68), (drawer, 0.32)]);
    let root = divided(
        &mut tiles,
        LinearDir::Horizontal,
        &[(outliner, OUTLINER), (middle, 720.0), (inspector, INSPECTOR)],
    );
    let mut tree = Tree::new(egui::Id::unique("studio-layout"), root, tiles);
    for pane in [Pane::Problems].into_iter().chain(Pane::DRAWER) {
        set_visible(&mut tree, pane, false);
    }
    tree
}

fn tabs_of(tiles: &mut Tiles<Pane>, panes: &[Pane]) -> TileId {
    let panes = panes.iter().map(|&pane| tiles.insert_pane(pane)).collect();
    tiles.insert_new(Tile::Container(Container::Tabs(Tabs::new(panes))))
}

fn divided(tiles: &mut Tiles<Pane>, direction: LinearDir, children: &[(TileId, f32)]) -> TileId {
    let mut linear = Linear::new(direction, children.iter().map(|&(child, _)| child).collect());
    for &(child, share) in children {
        linear.shares.set_share(child, share);
    }
    tiles.insert_new(Tile::Container(Container::Linear(linear)))
}

/// Whether `pane` can be seen (it may still lie behind another tab).
pub(crate) fn is_visible(tree: &Tree<Pane>, pane: Pane) -> bool {
    tree.tiles.find_pane(&pane).is_some_and(|tile| tree.is_visible(tile))
}

/// Whether `pane` can be seen and lies before other tabs.
pub(crate) fn is_in_front(tree: &Tree<Pane>, pane: Pane) -> bool {
    tree.tiles
        .find_pane(&pane)
        .is_some_and(|tile| tree.is_visible(tile) && tree.active_tiles().contains(&tile))
}

/// Shows or hides `pane`; a shown one comes to the front, and one of the drawer gets room. A panel that the layout has
/// lost is put back.
pub(crate) fn set_visible(tree: &mut Tree<Pane>, pane: Pane, visible: bool) {
    let Some(tile) = tree.tiles.find_pane(&pane) else {
        if visible {
            put_back(tree, pane);
        }
        return;
    };
    tree.set_visible(tile, visible);
    if visible {
        bring_forward(tree, pane);
    }
}

fn bring_forward(tree: &mut Tree<Pane>, pane: Pane) {
    tree.make_active(|_, other| *other == Tile::Pane(pane));
    if Pane::DRAWER.contains(&pane) {
        make_room(tree, pane);
    }
}

/// Shows `pane`. If that opens the drawer, it takes the part `share` of the height, within what both need.
pub(crate) fn open_below_picture(tree: &mut Tree<Pane>, pane: Pane, share: f32) {
    /// The parts of the height in which a list can be read, and which leaves half to the picture.
    const SHARES: std::ops::RangeInclusive<f32> = 0.32..=0.5;
    let drawer = drawer_of(tree, pane);
    let is_open = Pane::ALL.iter().any(|other| drawer_of(tree, *other) == drawer && is_visible(tree, *other));
    set_visible(tree, pane, true);
    if !is_open && Pane::DRAWER.contains(&pane) {
        let share = share.clamp(*SHARES.start(), *SHARES.end());
        set_height(tree, pane, |_, others| share / (1.0 - share) * others);
    }
}

/// The group of tabs in which `pane` is.
fn drawer_of(tree: &Tree<Pane>, pane: Pane) -> Option<TileId> {
    tree.tiles.parent_of(tree.tiles.find_pane(&pane)?)
}

/// Puts a panel where it belongs: into the drawer, or beside all others.
fn put_back(tree: &mut Tree<Pane>, pane: Pane) {
    let tile = tree.tiles.insert_pane(pane);
    let drawer = tree.tiles.find_pane(&Pane::Problems).and_then(|problems| tree.tiles.parent_of(problems));
    match drawer.filter(|_| Pane::DRAWER.contains(&pane)).or(tree.root) {
        Some(place) => tree.move_tile_to_container(tile, place, usize::MAX, true),
        None => tree.root = Some(tile),
    }
    tree.set_visible(tile, true);
    bring_forward(tree, pane);
}

/// Makes the drawer with `pane` as high as the picture above it, if it is lower.
fn make_room(tree: &mut Tree<Pane>, pane: Pane) {
    /// The drawer's height over that of what it shares the window with.
    const SHARE: f32 = 1.05;
    set_height(tree, pane, |own, others| own.max(SHARE * others));
}

/// Gives the drawer with `pane` another height, from its own and that of what it shares the window with.
fn set_height(tree: &mut Tree<Pane>, pane: Pane, height: impl FnOnce(f32, f32) -> f32) {
    let Some(tabs) = drawer_of(tree, pane) else { return };
    let Some(Tile::Container(Container::Linear(linear))) =
        tree.tiles.parent_of(tabs).and_then(|parent| tree.tiles.get_mut(parent))
    else {
        return;
    };
    if linear.dir != LinearDir::Vertical {
        return;
    }
    let others: f32 =
        linear.children.iter().filter(|&&other| other != tabs).map(|&other| linear.shares[other]).sum();
    let height = height(linear.shares[tabs], others);
    linear.shares.set_share(tabs, height);
}

/// Whether a remembered layout can be used: every panel once, but for those that older versions did not have.
pub(crate) fn is_whole(tree: &Tree<Pane>) -> bool {
    Pane::ALL.iter().all(|pane| {
        let count =
            tree.tiles.tiles().filter(|tile| matches!(tile, Tile::Pane(other) if other == pane)).count();
        count == 1 || (count == 0 && Pane::DRAWER.contains(pane))
    }) && tree.root.is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_layout_has_every_panel_once() {
        let mut tree = default_layout();
        assert!(is_whole(&tree));
        assert!(is_visible(&tree, Pane::Viewport) && !is_visible(&tree, Pane::Problems));
        set_visible(&mut tree, Pane::Problems, true);
        assert!(is_visible(&tree, Pane::Problems));
    }

    #[test]
    fn the_lab_comes_into_the_drawer_of_an_older_layout() {
        for pane in Pane::DRAWER {
            let mut tree = default_layout();
            let tile = tree.tiles.find_pane(&pane).unwrap();
            tree.remove_recursively(tile);
            assert!(is_whole(&tree) && !is_visible(&tree, pane));
            set_visible(&mut tree, pane, true);
            assert!(is_in_front(&tree, pane));
            let drawer = |pane| tree.tiles.parent_of(tree.tiles.find_pane(&pane).unwrap());
            assert_eq!(drawer(pane), drawer(Pane::Problems));
        }
    }

    #[test]
    fn a_drawer_that_opens_has_the_height_asked_for() {
        let part = |tree: &Tree<Pane>| {
            let tabs = drawer_of(tree, Pane::Audit).unwrap();
            let Some(Tile::Container(Container::Linear(linear))) =
                tree.tiles.parent_of(tabs).and_then(|parent| tree.tiles.get(parent))
            else {
                panic!("no column")
            };
            let sum: f32 = linear.children.iter().map(|&child| linear.shares[child]).sum();
            linear.shares[tabs] / sum
        };
        for (asked, given) in [(0.4, 0.4), (0.05, 0.32), (0.9, 0.5)] {
            let mut tree = default_layout();
            open_below_picture(&mut tree, Pane::Audit, asked);
            assert!(is_in_front(&tree, Pane::Audit) && (part(&tree) - given).abs() < 1e-4, "{asked}");
        }
        // One that is open already keeps its height.
        let mut tree = default_layout();
        set_visible(&mut tree, Pane::Compare, true);
        let before = part(&tree);
        open_below_picture(&mut tree, Pane::Audit, 0.4);
        assert!((part(&tree) - before).abs() < 1e-6);
    }

    #[test]
    fn a_lost_panel_comes_back() {
        let mut tree = default_layout();
        let tile = tree.tiles.find_pane(&Pane::Inspector).unwrap();
        tree.remove_recursively(tile);
        assert!(!is_whole(&tree));
        set_visible(&mut tree, Pane::Inspector, true);
        assert!(is_whole(&tree) && is_visible(&tree, Pane::Inspector));
    }
}
