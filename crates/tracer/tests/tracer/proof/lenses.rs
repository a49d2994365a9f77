//! Lenses and dishes against the formulas of paraxial optics.

use catoptric_scene::{Body, MaterialChoice, Phong, read};
use catoptric_tracer::RenderScene;

use crate::proof::common::{chain, direction, glass, mirror, ray, stage_of, v};

/// A body by its own keys, made of what is given.
fn body(keys: &str, material: Phong) -> Body {
    let text = format!("format = \"catoptric/1\"\n[[bodies]]\n{keys}\n");
    let scene = read(&text).into_result().expect("the keys are right").value;
    Body { material: MaterialChoice::own(material), ..scene.bodies[0].clone() }
}

/// Where a ray that comes along the axis at `height` meets the axis again, and its tangent to the axis there.
fn focus(scene: &RenderScene, height: f64) -> (f64, f64) {
    let path = chain(scene, ray(v(height, -5.0, 0.0), v(0.0, 1.0, 0.0)));
    let last = path.last().expect("a ray has a path");
    let (from, along) = (scene.world_from_render(last.ray.origin), direction(last));
    (from.y - from.x * along.y / along.x, -along.x / along.y)
}

/// The limit of what differs from it in proportion to the square of the height.
fn limit(of: impl Fn(f64) -> f64) -> f64 {
    (4.0 * of(0.005) - of(0.01)) / 3.0
}

/// The thick lens of radii R₁, R₂, thickness d and index n (Hecht, Optics, 5th ed., eqs. 6.2 and 6.4):
/// 1/f = (n − 1) (1/R₁ − 1/R₂ + (n − 1) d / (n R₁ R₂)), and its focus lies f (1 − (n − 1) d / (n R₁)) behind it.
#[test]
fn lenses_bring_light_to_the_focus_of_the_thick_lens() {
    let lenses = [
        (2.0, -2.0, 0.4, 1.5),
        (1.5, -4.0, 0.5, 1.6),
        (1.0, -1.0, 1.6, 1.45),
        (1.5, 0.0, 0.3, 1.5168),
        (0.0, -1.5, 0.3, 1.5168),
        (1.0, 2.5, 0.35, 1.7),
        (3.0, 1.2, 0.15, 1.6),
        (-2.0, 2.0, 0.1, 1.5),
        (0.0, 1.5, 0.12, 1.33),
        (-2.0, -1.1, 0.6, 1.8),
        (5.0, -8.0, 0.2, 1.333),
        (-1.5, 3.0, 0.2, 2.417),
    ];
    for (front, back, thickness, ior) in lenses {
        let keys = format!(
            "shape = \"lens\"\nradius = 0.4\nthickness = {thickness:?}\nfront_radius = {front:?}\nback_radius = {back:?}"
        );
        let scene = stage_of(vec![body(&keys, glass(ior))]);
        let curvature = |radius: f64| if radius == 0.0 { 0.0 } else { 1.0 / radius };
        let (first, second, bending) = (curvature(front), curvature(back), ior - 1.0);
        let length = 1.0 / (bending * (first - second + bending * thickness * first * second / ior));
        let behind = 0.5 * thickness + length * (1.0 - bending * thickness * first / ior);
        let traced_length = limit(|height| height / focus(&scene, height).1);
        let traced_place = limit(|height| focus(&scene, height).0);
        let is_close = |traced: f64, exact: f64| (traced - exact).abs() < 1e-4 * length.abs();
        assert!(is_close(traced_length, length), "{keys}: {traced_length}, not {length}");
        assert!(is_close(traced_place, behind), "{keys}: {traced_place}, not {behind}");
    }
}

/// A lens that is given its focal length has it.
#[test]
fn a_focal_length_is_kept_when_traced() {
    for (keys, length, ior) in [
        ("thickness = 0.2\nfocal_length = 2.0", 2.0, 1.5),
        ("thickness = 0.3\nfocal_length = 1.25\nior = 1.8\nfront_radius = 0.9", 1.25, 1.8),
        ("thickness = 0.1\nfocal_length = -1.5", -1.5, 1.5),
    ] {
        let scene = stage_of(vec![body(&format!("shape = \"lens\"\nradius = 0.3\n{keys}"), glass(ior))]);
        let traced = limit(|height| height / focus(&scene, height).1);
        assert!((traced - length).abs() < 1e-4 * length.abs(), "{keys}: {traced}, not {length}");
    }
}

/// What comes along the axis of a parabolic dish meets in its focus from anywhere, of a spherical one near the axis.
#[test]
fn dishes_bring_light_to_their_focus() {
    for (profile, length, heights) in [
        ("parabolic", 0.5, &[0.02, 0.2, 0.35, 0.44][..]),
        ("parabolic", 2.0, &[0.01, 0.3]),
        ("spherical", 0.8, &[0.005]),
    ] {
        let keys = format!(
            "shape = \"mirror-dish\"\nradius = 0.45\nthickness = 0.1\nprofile = \"{profile}\"\nfocal_length = {length:?}"
        );
        let scene = stage_of(vec![body(&keys, mirror())]);
        for &height in heights {
            let path = chain(&scene, ray(v(height, 5.0, 0.0), v(0.0, -1.0, 0.0)));
            let (hit, back) = (path[0].hit.expect("the dish is met").position, direction(&path[1]));
            let meets = hit.y - hit.x * back.y / back.x;
            assert!((meets - length).abs() < 1e-4 * length, "{keys} at {height}: {meets}");
        }
    }
}
