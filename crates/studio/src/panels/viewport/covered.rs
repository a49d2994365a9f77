//! The picture while a panel that opened over a part of it covers that part.
//!
//! The panel of the audit opens at a click into the picture. A picture that was fitted to what is left would slide away
//! under the pointer; this one keeps its size and, if the pixel can still be seen, its place.

use egui::{Pos2, Rect, Vec2, vec2};

/// How far from the border of what is left the pixel is seen, points.
const MARGIN: f32 = 48.0;
/// How far below the pixel the panel opens, where there is room for it, points.
pub(crate) const ROOM: f32 = MARGIN + 12.0;
/// Lengths that differ less are equal, points.
const NEARLY: f32 = 0.75;

/// A picture that is larger than its tile of the layout.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoveredPicture {
    /// Where the picture was when the panel opened.
    whole: Rect,
    /// The place in it that stays in view.
    shown: Pos2,
    /// The window's size then.
    window: Vec2,
    /// The tile of the last frame, and where the picture was.
    last: Option<(Rect, Rect)>,
}

impl CoveredPicture {
    /// Keeps the picture at `whole` in a window of this size, with `shown` in view.
    pub(crate) fn new(whole: Rect, shown: Pos2, window: Vec2) -> Self {
        Self { whole, shown, window, last: None }
    }

    /// Where the picture is, now that its tile is `tile`; `None` when it has to be fitted to that, since nothing covers
    /// it any more or the window has another size. As long as the tile stays, so does the picture.
    pub(crate) fn place(&mut self, tile: Rect, window: Vec2) -> Option<Rect> {
        let is_equal = |one: f32, other: f32| (one - other).abs() < NEARLY;
        let is_within = self.whole.expand(NEARLY).contains_rect(tile);
        let is_whole =
            is_equal(tile.width(), self.whole.width()) && is_equal(tile.height(), self.whole.height());
        // In the first frame the panel is not there yet.
        let is_uncovered = is_whole && self.last.is_some();
        if self.window != window || !is_within || is_uncovered || tile.area() <= 0.0 {
            return None;
        }
        if is_whole {
            return Some(self.whole);
        }
        if let Some((_, rect)) = self.last.filter(|(last, _)| *last == tile) {
            return Some(rect);
        }
        let (whole, shown) = (self.whole, self.shown);
        let way = |tile: egui::Rangef, whole: egui::Rangef, shown: f32| {
            let margin = MARGIN.min(0.5 * tile.span());
            let way = shown.clamp(tile.min + margin, tile.max - margin) - shown;
            // The picture leaves no part of the tile empty.
            way.clamp((tile.max - whole.max).min(0.0), (tile.min - whole.min).max(0.0)).round()
        };
        let rect = whole.translate(vec2(
            way(tile.x_range(), whole.x_range(), shown.x),
            way(tile.y_range(), whole.y_range(), shown.y),
        ));
        self.last = Some((tile, rect));
        Some(rect)
    }
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    const WINDOW: Vec2 = vec2(1200.0, 900.0);

    fn whole() -> Rect {
        Rect::from_min_size(pos2(200.0, 30.0), vec2(600.0, 800.0))
    }

    /// What is left of the picture above a panel.
    fn above(height: f32) -> Rect {
        Rect::from_min_size(whole().min, vec2(600.0, height))
    }

    #[test]
    fn it_stays_where_the_pixel_is_seen() {
        let mut picture = CoveredPicture::new(whole(), pos2(300.0, 200.0), WINDOW);
        assert_eq!(picture.place(whole(), WINDOW), Some(whole()), "before the panel is there");
        assert_eq!(picture.place(above(400.0), WINDOW), Some(whole()));
        assert_eq!(picture.place(above(300.0), WINDOW), Some(whole()));
    }

    #[test]
    fn it_moves_only_as_far_as_the_pixel_needs() {
        let mut picture = CoveredPicture::new(whole(), pos2(300.0, 730.0), WINDOW);
        let rect = picture.place(above(400.0), WINDOW).unwrap();
        assert_eq!(rect, whole().translate(vec2(0.0, 430.0 - MARGIN - 730.0)));
        assert_eq!(picture.place(above(400.0), WINDOW), Some(rect), "and then stays");
        // At the lowest edge no part of the tile is left empty.
        let mut lowest = CoveredPicture::new(whole(), pos2(300.0, 829.0), WINDOW);
        assert_eq!(lowest.place(above(400.0), WINDOW).unwrap().max.y, 430.0);
    }

    #[test]
    fn it_ends_with_the_panel_and_with_the_size_of_the_window() {
        let mut picture = CoveredPicture::new(whole(), pos2(300.0, 200.0), WINDOW);
        assert!(picture.place(above(400.0), WINDOW).is_some());
        assert_eq!(picture.place(above(400.0), WINDOW + Vec2::X), None);
        assert_eq!(picture.place(above(800.0), WINDOW), None);
        assert_eq!(picture.place(above(900.0), WINDOW), None);
        assert_eq!(picture.place(above(400.0).translate(vec2(-50.0, 0.0)), WINDOW), None);
    }
}
