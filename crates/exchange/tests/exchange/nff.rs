//! NFF: known answers and errors.

use catoptric_exchange::{ForeignFormat, ImportOptions};
use catoptric_scene::Shape;

use crate::common::{assert_light, bad, good, pixel};

const FORMAT: ForeignFormat = ForeignFormat::Nff;
const VIEW: &str = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 8 8\nb 0.1 0.2 0.3\n";

#[test]
fn a_pixel_has_the_light_of_the_formula() {
    // n·L is 3/5; of a single light the intensity is 1.
    let text = format!("{VIEW}l 0 4 4\nf 1 0.5 0 0.5 0 1 0 0\ns 0 0 0 1\n");
    let found = good(FORMAT, &text, &ImportOptions::default());
    assert_light(pixel(&found, [1, 1], [0, 0]), [0.3, 0.15, 0.0]);
    assert_light(pixel(&found, [9, 9], [0, 0]), [0.1, 0.2, 0.3]);
    assert_eq!(found.size, Some([8, 8]));
    // Of four, it is 1/2 each.
    let text = format!("{VIEW}l 0 4 4\nl 0 4 4\nl 0 4 4\nl 0 4 4\nf 1 0.5 0 0.5 0 1 0 0\ns 0 0 0 1\n");
    let found = good(FORMAT, &text, &ImportOptions::default());
    assert_light(pixel(&found, [1, 1], [0, 0]), [0.6, 0.3, 0.0]);
}

#[test]
fn open_cones_and_polygons_are_refused_or_replaced() {
    let text =
        format!("{VIEW}f 1 1 1 1 0 1 0 0\nc\n0 0 0 0.5\n0 2 0 1\np 3\n0 0 0\n1 0 0\n0 1 0\ns 0 0 0 1\n");
    let found = bad(FORMAT, &text);
    assert_eq!(
        found,
        "10:1: error: cones and cylinders of NFF are open, and are not drawn\n13:1: error: polygons are not drawn"
    );
    let found = good(FORMAT, &text, &ImportOptions { is_approximate: true, ..ImportOptions::default() });
    let shapes: Vec<_> = found.scene.bodies.iter().map(|body| body.shape).collect();
    assert_eq!(
        shapes,
        [Shape::Cone { radius: 0.5, top_radius: 1.0, height: 2.0 }, Shape::Sphere { radius: 1.0 }]
    );
}

#[test]
fn cones_may_stand_on_one_line() {
    let text = format!("{VIEW}f 1 1 1 1 0 1 0 0\nc 0 0 0 1 0 2 0 1\ns 0 0 0 1\n");
    let found = good(FORMAT, &text, &ImportOptions { is_approximate: true, ..ImportOptions::default() });
    assert_eq!(found.scene.bodies.to_vec()[0].shape, Shape::Cylinder { radius: 1.0, height: 2.0 });
}

#[test]
fn errors_have_their_places() {
    for (text, expected) in [
        ("", "1:1: error: the scene has no view `v`"),
        (
            "s 0 0 0 1",
            "1:1: error: no `f` before this gives its material\n1:1: error: the scene has no view `v`",
        ),
        ("v\nat 0 0 0", "2:1: error: a line `from x y z` belongs here"),
        ("x 1", "1:1: error: there is no record `x`"),
        ("l 0 0", "1:1: error: `l` has the wrong number of values; it needs 3 / 6"),
        ("l 0 0 a", "1:1: error: the scene has no view `v`\n1:7: error: `a` is not a number"),
        ("p 1e9", "1:1: error: a polygon has from 3 to 10000 corners"),
    ] {
        let found = bad(FORMAT, text);
        assert!(found.starts_with(expected), "{text}\n{found}");
    }
}
