//! The arithmetic of spans. What the shapes make of it is proved from outside, in `tests/tracer/proof/shapes.rs`.

use super::*;

fn span(enter: f32, exit: f32, face: FaceId) -> ShapeSpan {
    ShapeSpan { enter, exit, enter_face: face, exit_face: face, hit: enter <= exit }
}

#[test]
fn a_later_entry_and_an_earlier_exit_win_with_their_faces() {
    let both = span(1.0, 4.0, SIDE).intersect(span(2.0, 5.0, UPPER_CAP));
    assert_eq!(both, ShapeSpan { enter: 2.0, exit: 4.0, enter_face: UPPER_CAP, exit_face: SIDE, hit: true });
    // Of equal ends the first span's face stays.
    assert_eq!(span(1.0, 2.0, SIDE).intersect(span(1.0, 2.0, LOWER_CAP)), span(1.0, 2.0, SIDE));
}

#[test]
fn spans_apart_or_missed_do_not_meet() {
    assert!(!span(1.0, 2.0, SIDE).intersect(span(3.0, 4.0, SIDE)).hit);
    assert!(!span(1.0, 2.0, SIDE).intersect(span(1.5, 1.4, SIDE)).hit);
    assert!(span(1.0, 2.0, SIDE).intersect(span(2.0, 3.0, SIDE)).hit, "they touch");
}

#[test]
fn ends_that_are_no_numbers_are_misses() {
    for bad in [span(f32::NAN, 1.0, SIDE), span(1.0, f32::NAN, SIDE)] {
        assert!(!bad.hit && !bad.intersect(span(0.0, 2.0, SIDE)).hit);
    }
}

#[test]
fn a_line_in_a_layer_stays_in_it() {
    let inside = |y| slab::closed(y, 0.0, (0.0, LOWER_CAP), (1.0, UPPER_CAP));
    assert!([0.0, 0.5, 1.0].into_iter().all(|y| inside(y).hit && inside(y).exit == f32::INFINITY));
    assert!([-1e-7, 1.0 + 1e-6, f32::NAN].into_iter().all(|y| !inside(y).hit));
}
