//! The layout of upright, narrow windows, such as a tablet's or a telephone's: the picture above, all panels in one
//! drawer below.

use egui::Vec2;
use egui_tiles::{LinearDir, Tiles, Tree};

use super::{Pane, default_layout, divided, is_visible, tabs_of};

/// Narrower windows that are higher than wide have no room beside the picture, points.
const NARROW: f32 = 900.0;

/// The panels of the drawer, the most useful ones first.
const DRAWER: [Pane; 8] = [
    Pane::Inspector,
    Pane::Outliner,
    Pane::History,
    Pane::Problems,
    Pane::Audit,
    Pane::Compare,
    Pane::Measure,
    Pane::Materials,
];

/// Whether a window of this size, points, has no room beside the picture.
pub(crate) fn is_narrow(size: Vec2) -> bool {
    size.x < NARROW && size.y > size.x
}

/// The layouts that wait while the window has another shape.
#[derive(Debug, Default)]
pub(crate) struct SpareLayouts {
    /// That of wide windows, while the window is narrow.
    wide: Option<Tree<Pane>>,
    /// That of narrow windows, as it was left.
    narrow: Option<Tree<Pane>>,
}

impl SpareLayouts {
    /// Exchanges the layouts when a window of this size has another shape than before. The same panels stay visible.
    pub(crate) fn keep_up(&mut self, shown: &mut Tree<Pane>, size: Vec2) {
        let is_narrow = is_narrow(size);
        match self.wide.take() {
            None if is_narrow => {
                let narrow = self.narrow.take().unwrap_or_else(narrow_layout);
                self.wide = Some(exchange(shown, narrow));
            }
            Some(wide) if !is_narrow => self.narrow = Some(exchange(shown, wide)),
            wide => self.wide = wide,
        }
    }

    /// The layout of wide windows, which is the one to be remembered.
    pub(crate) fn wide<'a>(&'a self, shown: &'a Tree<Pane>) -> &'a Tree<Pane> {
        self.wide.as_ref().unwrap_or(shown)
    }

    /// Makes all layouts as they were at first.
    pub(crate) fn reset(&mut self, shown: &mut Tree<Pane>) {
        (*self, *shown) = (Self::default(), default_layout());
    }
}

/// Shows another layout with the same panels; gives back the present one.
fn exchange(shown: &mut Tree<Pane>, mut other: Tree<Pane>) -> Tree<Pane> {
    for pane in Pane::ALL {
        if let Some(tile) = other.tiles.find_pane(&pane) {
            other.set_visible(tile, is_visible(shown, pane));
        }
    }
    std::mem::replace(shown, other)
}

fn narrow_layout() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let viewport = tabs_of(&mut tiles, &[Pane::Viewport]);
    let drawer = tabs_of(&mut tiles, &DRAWER);
    let root = divided(&mut tiles, LinearDir::Vertical, &[(viewport, 0.56), (drawer, 0.44)]);
    Tree::new(egui::Id::unique("studio-narrow-layout"), root, tiles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::layout::{is_in_front, is_whole, set_visible};

    const WIDE: Vec2 = Vec2::new(1280.0, 800.0);
    const TABLET: Vec2 = Vec2::new(820.0, 1180.0);

    #[test]
    fn a_narrow_window_has_all_panels_below_the_picture() {
        let mut shown = default_layout();
        let mut spare = SpareLayouts::default();
        spare.keep_up(&mut shown, WIDE);
        assert_eq!(shown, default_layout());
        spare.keep_up(&mut shown, TABLET);
        assert!(is_whole(&shown) && shown != default_layout());
        assert_eq!(spare.wide(&shown), &default_layout());
        assert!(is_in_front(&shown, Pane::Viewport) && is_in_front(&shown, Pane::Inspector));
        assert!(!is_visible(&shown, Pane::Audit));
    }

    #[test]
    fn panels_stay_visible_when_the_window_is_turned() {
        let mut shown = default_layout();
        let mut spare = SpareLayouts::default();
        spare.keep_up(&mut shown, TABLET);
        set_visible(&mut shown, Pane::Audit, true);
        set_visible(&mut shown, Pane::Outliner, false);
        let narrow = shown.clone();
        spare.keep_up(&mut shown, WIDE);
        assert!(is_visible(&shown, Pane::Audit) && !is_visible(&shown, Pane::Outliner));
        assert_eq!(spare.wide(&shown), &shown);
        spare.keep_up(&mut shown, TABLET);
        assert_eq!(shown, narrow);
    }

    #[test]
    fn a_reset_is_one_of_both_layouts() {
        let mut shown = default_layout();
        let mut spare = SpareLayouts::default();
        spare.keep_up(&mut shown, TABLET);
        set_visible(&mut shown, Pane::Inspector, false);
        spare.reset(&mut shown);
        spare.keep_up(&mut shown, TABLET);
        assert!(is_visible(&shown, Pane::Inspector));
        assert_eq!(spare.wide(&shown), &default_layout());
    }
}
