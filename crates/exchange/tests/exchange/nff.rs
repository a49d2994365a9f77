//! NFF: known answers and errors.

use catoptric_exchange::{ForeignFormat, ImportOptions};
use catoptric_scene::{
    Body, BodyShape, OpenCone, OpenCylinder, ParametricShape, Shape, ShapeKind, VisibleSide,
};

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
fn cones_and_polygons_are_surfaces() {
    let text = format!(
        "{VIEW}f 1 1 1 1 0 1 0 0\nc\n0 0 0 0.5\n0 2 0 1\np 3\n0 0 0\n1 0 0\n0 1 0\ns 0 0 0 1\n\
         c\n0 0 0 0\n3 0 0 2\nc 0 0 0 -1 0 2 0 -1\np 4\n0 0 0\n1 0 0\n1 0 1\n0 0 1\n"
    );
    let found = good(FORMAT, &text, &ImportOptions::default());
    let shapes: Vec<_> = found.scene.bodies.iter().map(Body::body_shape).collect();
    let parametric = |shape: ParametricShape| BodyShape::Parametric(shape);
    let open_cone = |radius, top_radius, height| {
        parametric(ParametricShape::OpenCone(OpenCone {
            radius,
            top_radius,
            height,
            side: VisibleSide::Outer,
        }))
    };
    assert_eq!(shapes[0], open_cone(0.5, 1.0, 2.0));
    assert_eq!(shapes[1].kind(), ShapeKind::Triangle);
    assert_eq!(shapes[2], BodyShape::Plain(Shape::Sphere { radius: 1.0 }));
    assert_eq!(shapes[3], open_cone(2.0, 0.0, 3.0), "an apex is above");
    // A negative radius is that of the inner side.
    let cylinder = OpenCylinder { radius: 1.0, height: 2.0, side: VisibleSide::Inner };
    let cylinder = ParametricShape::OpenCylinder(cylinder);
    assert_eq!(shapes[4], parametric(cylinder));
    assert_eq!((shapes[5].kind(), found.scene.bodies[5].parts.len()), (ShapeKind::Surface, 6));
}

/// Polygons are seen from where their corners go around against the clock, cones from outside, or from inside if their radii
/// are negative. One after another of the same material, both sides are one surface.
#[test]
fn surfaces_have_one_side() {
    let [red, black] = [[1.0, 0.0, 0.0], [0.0; 3]];
    let view = VIEW.replace("0.1 0.2 0.3", "0 0 0");
    let square = ["-1 -1 0", "1 -1 0", "1 1 0", "-1 1 0"];
    let polygon = |corners: &[&str]| format!("p {}\n{}\n", corners.len(), corners.join("\n"));
    let backwards: Vec<&str> = square.iter().rev().copied().collect();
    let (front, back) = (polygon(&square), polygon(&backwards));
    // The light is within the pipe, at the eye.
    let cone = |sign: f64| format!("c\n0 0 -9 {}\n0 0 9 {}\n", sign, sign * 2.0);
    for (surfaces, bodies, seen) in [
        (front.clone(), 1, red),
        (back.clone(), 1, black),
        (format!("{front}{back}"), 1, red),
        (format!("{back}{front}"), 1, red),
        (format!("{back}{back}"), 2, black),
        (format!("{back}f 0 1 0 1 0 1 0 0\n{front}"), 2, [0.0, 1.0, 0.0]),
        (format!("{front}s 9 9 9 1\n{back}"), 3, red),
        (polygon(&backwards[..3]), 1, black),
        (cone(1.0), 1, black),
        (cone(1.0) + &cone(-1.0), 1, [1.0, 0.0, 0.0]),
    ] {
        let text = format!("{view}l 0 0 5\nf 1 0 0 1 0 1 0 0\n{surfaces}");
        let found = good(FORMAT, &text, &ImportOptions::default());
        assert_eq!(found.scene.bodies.len(), bodies, "{surfaces}");
        let light = pixel(&found, [9, 9], [2, 5]);
        let is_seen = light.iter().any(|part| *part > 0.01);
        assert_eq!(is_seen, seen != black, "{surfaces}: {light:?}");
    }
}

#[test]
fn what_polygons_and_cones_cannot_be_is_said() {
    for (rest, expected) in [
        ("p 4\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n", "10:1: error: only flat polygons without notches"),
        ("p 4\n0 0 0\n4 0 0\n4 4 1\n0 4 0\n", "10:1: error: only flat polygons without notches"),
        ("p 3\n0 0 0\n1 0 0\n2 0 0\n", "10:1: error: body 1: the corners"),
        ("pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n", "10:1: error: the normals of a patch"),
        ("c 0 0 0 -1 0 2 0 1\n", "10:1: error: one radius of the cone is negative"),
        ("c 0 0 0 1 0 0 0 1\n", "10:1: error: body 1: "),
        ("c 0 0 0 0 0 1 0 0\n", "10:1: error: body 1: "),
    ] {
        let found = bad(FORMAT, &format!("{VIEW}f 1 1 1 1 0 1 0 0\n{rest}"));
        assert!(found.starts_with(expected), "{rest}\n{found}");
    }
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

/// What would be an error of one record leaves out that record, and a view that is not there sees all.
#[test]
fn one_record_does_not_stop_a_scene() {
    let text = "f 1 1 1 1 0 1 0 0\nq 1\ns 0 0 0 1\ns 0 0 0 0\ns 0 0\np 3\n0 0 0\n1 0 0\n2 0 0\nc 0 0 0 1 0 1 0 -1\nl 0 x 0\n";
    assert!(bad(FORMAT, text).starts_with("1:1: error: the scene has no view `v`"));
    let options = ImportOptions { is_approximate: true, ..ImportOptions::default() };
    for view in ["", "v\nfrom 0 0 5\nat nowhere\n"] {
        let found = good(FORMAT, &format!("{view}{text}"), &options);
        let shapes: Vec<_> = found.scene.bodies.iter().map(|body| body.shape).collect();
        assert_eq!(shapes, [Shape::SPHERE], "{}", found.report);
        assert_eq!(found.scene.camera.target, glam::DVec3::ZERO);
    }
}
