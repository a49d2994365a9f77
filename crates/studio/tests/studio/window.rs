//! The window as a whole.

use crate::kit::studio;

#[test]
fn the_studio_opens_with_four_bodies() {
    let mut harness = studio();
    harness.run();
    assert_eq!(harness.state().editor().scene().bodies.len(), 5);
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}
