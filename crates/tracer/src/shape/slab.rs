//! The layer between two parallel planes.

use super::{Face, Span};

/// Where the line `origin + t·direction` (one coordinate) lies between `low` and `high`.
///
/// A line parallel to the layer (`direction` = 0) lies in it everywhere or nowhere; the division is not made then, so
/// that 0/0 cannot arise.
#[inline]
pub(super) fn span(origin: f32, direction: f32, low: (f32, Face), high: (f32, Face)) -> Span {
    if direction == 0.0 {
        let hit = low.0 <= origin && origin <= high.0;
        return Span::everywhere(low.1, high.1, hit);
    }
    let (near, far) = if direction > 0.0 { (low, high) } else { (high, low) };
    let enter = (near.0 - origin) / direction;
    let exit = (far.0 - origin) / direction;
    Span { enter, exit, enter_face: near.1, exit_face: far.1, hit: enter <= exit }
}
