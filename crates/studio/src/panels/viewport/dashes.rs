//! Dashed lines that may be far longer than the window.

use egui::{Painter, Pos2, Rect, Shape, Stroke};

/// Draws a dashed line. Only what may be seen of it becomes dashes: the line to something almost beside the eye can be
/// a million points long, and each dash is a shape.
pub(crate) fn dashed(painter: &Painter, ends: [Pos2; 2], stroke: Stroke, dash: f32, gap: f32) {
    let Some(ends) = seen(ends, painter.clip_rect().expand(dash + stroke.width), dash + gap) else { return };
    painter.extend(Shape::dashed_line(&ends, stroke, dash, gap));
}

/// The part of a line in a rectangle (Liang, Barsky 1984), from the last whole period before it, so that the dashes
/// stay where they are when the rectangle moves.
fn seen([from, to]: [Pos2; 2], rect: Rect, period: f32) -> Option<[Pos2; 2]> {
    let way = to - from;
    let length = way.length();
    let (mut enter, mut leave) = (0.0_f32, 1.0_f32);
    for (way, low, high) in
        [(way.x, rect.min.x - from.x, rect.max.x - from.x), (way.y, rect.min.y - from.y, rect.max.y - from.y)]
    {
        if way == 0.0 {
            if low > 0.0 || high < 0.0 {
                return None;
            }
            continue;
        }
        let (first, last) = if way > 0.0 { (low / way, high / way) } else { (high / way, low / way) };
        enter = enter.max(first);
        leave = leave.min(last);
    }
    // Also not for lengths that are not numbers.
    let is_seen = length > 0.0 && length.is_finite() && enter <= leave;
    let start = (enter * length / period).floor() * period / length;
    is_seen.then(|| [from + start * way, from + leave * way])
}

#[cfg(test)]
mod tests {
    use egui::{pos2, vec2};

    use super::*;

    const RECT: Rect = Rect { min: pos2(0.0, 0.0), max: pos2(100.0, 50.0) };

    #[test]
    fn a_line_inside_stays_whole() {
        let ends = [pos2(10.0, 10.0), pos2(90.0, 40.0)];
        assert_eq!(seen(ends, RECT, 8.0), Some(ends));
    }

    #[test]
    fn a_long_line_is_cut_at_a_whole_period() {
        let [from, to] = seen([pos2(-1e6, 25.0), pos2(1e6, 25.0)], RECT, 8.0).unwrap();
        assert!((-8.1..=0.1).contains(&from.x) && (to.x - 100.0).abs() < 0.2, "{from} {to}");
        assert_eq!((from.x + 1e6) % 8.0, 0.0);
        let shapes = Shape::dashed_line(&[from, to], Stroke::NONE, 4.0, 4.0);
        assert!(shapes.len() < 20, "{}", shapes.len());
    }

    #[test]
    fn lines_beside_the_window_and_points_are_not_drawn() {
        for ends in [
            [pos2(-5.0, 60.0), pos2(105.0, 60.0)],
            [pos2(-50.0, 20.0), pos2(20.0, -50.0)],
            [pos2(-9.0, 1.0), pos2(-1.0, 1.0)],
            [pos2(5.0, 5.0), pos2(5.0, 5.0)],
            [pos2(5.0, 5.0), pos2(5.0, 5.0) + vec2(f32::INFINITY, 0.0)],
            [pos2(5.0, 5.0), pos2(f32::NAN, 0.0)],
        ] {
            assert_eq!(seen(ends, RECT, 8.0), None, "{ends:?}");
        }
    }
}
