//! What a ray is inside of: nested and overlapping glass, bubbles, an eye in glass.

use catoptric_scene::{Body, Color};
use catoptric_tracer::{RayKind, RenderScene};
use glam::DVec3;

use crate::proof::common::{
    assert_close, assert_vec_close, ball, block, center, chain, direction, glass, glow, plane, ray,
    render_scene, scene, stage_of, v,
};

/// Sines of the angles between the vertical and each ray of a path through horizontal layers.
fn sines(render_scene: &RenderScene, start: DVec3, incidence: f64) -> Vec<f64> {
    let (sin, cos) = f64::to_radians(incidence).sin_cos();
    chain(render_scene, ray(start, v(sin, -cos, 0.0))).iter().map(|ray| direction(ray).x).collect()
}

/// A wide layer of glass between two heights.
fn layer(low: f64, high: f64, ior: f64) -> Body {
    block(v(400.0, high - low, 400.0), v(0.0, 0.5 * (low + high), 0.0), glass(ior))
}

/// Angles of incidence for paths that begin in air.
const FROM_AIR: [f64; 4] = [0.0, 10.0, 40.0, 80.0];
/// Those for paths that begin in glass, small enough not to be reflected totally.
const FROM_GLASS: [f64; 3] = [0.0, 10.0, 25.0];

/// Asserts that the rays of every path run in media of these indices, one after another.
#[track_caller]
fn assert_indices(render_scene: &RenderScene, start: DVec3, incidences: &[f64], indices: &[f64]) {
    for &incidence in incidences {
        let sines = sines(render_scene, start, incidence);
        assert_eq!(sines.len(), indices.len(), "at {incidence}: {sines:?}");
        for (sine, index) in sines.iter().zip(indices) {
            // n sin θ is the same in all parallel layers.
            assert_close(sine * index, f64::to_radians(incidence).sin() * indices[0], 3e-6);
        }
    }
}

#[test]
fn nested_glass_bends_by_the_ratio_to_the_next_one_out() {
    let render_scene = stage_of(vec![layer(-3.0, 3.0, 1.5), layer(-2.0, 2.0, 1.8), layer(-1.0, 1.0, 1.33)]);
    assert_indices(&render_scene, v(0.0, 5.0, 0.0), &FROM_AIR, &[1.0, 1.5, 1.8, 1.33, 1.8, 1.5, 1.0]);
}

#[test]
fn a_bubble_in_glass_is_a_body_of_index_1() {
    let render_scene = stage_of(vec![layer(-3.0, 3.0, 1.5), layer(-1.0, 1.0, 1.0)]);
    for incidence in [0.0, 20.0, 60.0] {
        let sines = sines(&render_scene, v(0.0, 5.0, 0.0), incidence);
        let sin = f64::to_radians(incidence).sin();
        for (sine, expected) in sines.iter().zip([sin, sin / 1.5, sin, sin / 1.5, sin]) {
            assert_close(*sine, expected, 1e-6);
        }
    }
    // From inside the glass, the bubble reflects totally beyond the critical angle.
    let path = chain(&render_scene, ray(v(0.0, 2.0, 0.0), v(1.0, -1.0, 0.0)));
    assert_eq!(path[1].kind, RayKind::Reflected);
}

#[test]
fn leaving_a_body_that_is_not_innermost_does_not_bend() {
    // Entered in the order A, B and left in the same order: A's far side lies within B.
    let render_scene = stage_of(vec![layer(-1.0, 2.0, 1.5), layer(-2.0, 1.0, 1.8)]);
    assert_indices(&render_scene, v(0.0, 5.0, 0.0), &FROM_AIR, &[1.0, 1.5, 1.8, 1.8, 1.0]);
    // From below the roles are exchanged.
    let (sin, cos) = 40.0_f64.to_radians().sin_cos();
    let path = chain(&render_scene, ray(v(0.0, -5.0, 0.0), v(sin, cos, 0.0)));
    let expected = [sin, sin / 1.8, sin / 1.5, sin / 1.5, sin];
    for (ray, expected) in path.iter().zip(expected) {
        assert_close(direction(ray).x, expected, 1e-6);
    }
    assert_eq!(path[2].ray.direction, path[3].ray.direction);
}

#[test]
fn three_overlapping_layers_keep_their_order() {
    let render_scene = stage_of(vec![layer(-1.0, 3.0, 1.2), layer(-2.0, 2.0, 1.4), layer(-3.0, 1.0, 1.6)]);
    // Entered 1.2, 1.4, 1.6; then 1.2 and 1.4 are left while 1.6 stays innermost.
    assert_indices(&render_scene, v(0.0, 5.0, 0.0), &FROM_AIR, &[1.0, 1.2, 1.4, 1.6, 1.6, 1.6, 1.0]);
}

#[test]
fn faces_in_contact_pass_the_light_on() {
    // Two panes that share a face: out of one and into the other in either order, no air between.
    for scale in [1e-3, 1.0, 1e3] {
        let mut pane = [layer(0.0, 1.0, 1.5), layer(-1.0, 0.0, 1.8)];
        for body in &mut pane {
            let catoptric_scene::Anchor::Frame { position, .. } = &mut body.placement.anchor else {
                unreachable!();
            };
            *position *= scale;
            body.placement.scale = DVec3::splat(scale);
        }
        let render_scene = stage_of(pane.to_vec());
        for incidence in [1.0, 30.0, 70.0] {
            let sines = sines(&render_scene, scale * v(0.1, 3.0, 0.2), incidence);
            let sin = f64::to_radians(incidence).sin();
            assert_eq!(sines.len(), 5, "{sines:?}");
            assert_close(sines[1], sin / 1.5, 1e-6);
            assert_close(sines[3], sin / 1.8, 1e-6);
            assert_close(sines[4], sin, 2e-6);
        }
    }
}

#[test]
fn glass_on_a_floor_shows_the_floor_through_a_film_of_air() {
    let floor = plane(DVec3::ZERO, 0.0, glow(Color::new(0.3, 0.6, 0.9)));
    let render_scene = stage_of(vec![floor, layer(0.0, 1.0, 1.5)]);
    let kinds = [RayKind::Primary, RayKind::Refracted, RayKind::Refracted];
    for step in 0..2000 {
        let x = 0.037 * f64::from(step) - 37.0;
        let path = chain(&render_scene, ray(v(x, 4.0, 1.3), v(0.3, -1.0, 0.2)));
        assert_eq!(path.iter().map(|ray| ray.kind).collect::<Vec<_>>(), kinds, "at {x}");
        assert_eq!(path[2].hit.unwrap().body, 0, "at {x}");
        assert_eq!(path[2].light, glam::Vec3::new(0.3, 0.6, 0.9));
        // From within and aslant, the film reflects totally.
        let path = chain(&render_scene, ray(v(x, 0.5, 1.3), v(1.0, -1.0, 0.0)));
        assert_eq!(path[1].kind, RayKind::Reflected, "at {x}");
    }
}

#[test]
fn a_ray_that_goes_straight_on_is_of_the_same_generation() {
    // Entered in the order A, B and left in the same order: leaving A does not bend the ray and costs no generation.
    let render_scene = stage_of(vec![layer(-1.0, 2.0, 1.5), layer(-2.0, 1.0, 1.8), layer(-9.0, -8.0, 1.0)]);
    let path = chain(&render_scene, ray(v(0.0, 5.0, 0.0), v(0.6, -0.8, 0.0)));
    let generations: Vec<u32> = path.iter().map(|ray| ray.generation).collect();
    assert_eq!(generations, [1, 2, 3, 3, 4, 4, 4]);
}

#[test]
fn an_eye_in_glass_is_in_glass() {
    let render_scene = stage_of(vec![layer(-2.0, 2.0, 1.5)]);
    let sin = 20.0_f64.to_radians().sin();
    let sines = sines(&render_scene, DVec3::ZERO, 20.0);
    assert_eq!(sines.len(), 2);
    assert_close(sines[1], 1.5 * sin, 1e-6);
}

#[test]
fn an_eye_in_nested_glass_takes_the_larger_for_the_outer() {
    for order in [[0, 1, 2], [2, 0, 1], [1, 2, 0]] {
        let layers = [layer(-3.0, 3.0, 1.5), layer(-2.0, 2.0, 1.7), layer(-1.0, 1.0, 1.9)];
        let render_scene = stage_of(order.map(|place| layers[place].clone()).to_vec());
        assert_indices(&render_scene, DVec3::ZERO, &FROM_GLASS, &[1.9, 1.7, 1.5, 1.0]);
    }
}

#[test]
fn a_picture_from_within_glass_agrees_with_its_rays() {
    // What the picture shows in its middle is what the ray along the view finds, with the same media.
    let mut scene =
        scene(vec![ball(2.0, DVec3::ZERO, glass(1.5)), ball(0.5, v(0.9, 0.0, -5.0), glow(Color::WHITE))]);
    scene.camera = crate::proof::common::camera(v(0.8, 0.0, 0.0), v(0.8, 0.0, -1.0), 30.0);
    let light = center(&scene);
    let path = chain(&render_scene(&scene), ray(v(0.8, 0.0, 0.0), DVec3::NEG_Z));
    assert_eq!(path.len(), 2);
    assert_eq!(path[1].kind, RayKind::Refracted);
    // Leaving a ball of radius 2 at height 0.8: bent towards the axis by asin(1.5·0.4) - asin(0.4).
    let bend = (0.6_f64).asin() - (0.4_f64).asin();
    assert_close(direction(&path[1]).angle_between(DVec3::NEG_Z), bend, 1e-6);
    assert_eq!(light, path.iter().map(|ray| ray.light).sum());
}

#[test]
fn an_eye_under_water_looks_out_of_an_endless_body() {
    let render_scene = stage_of(vec![plane(DVec3::ZERO, 0.0, glass(1.333))]);
    assert_indices(&render_scene, v(0.0, 5.0, 0.0), &FROM_AIR, &[1.0, 1.333]);
    let path = chain(&render_scene, ray(v(0.0, -5.0, 0.0), v(0.3, 1.0, 0.0)));
    assert_close(direction(&path[1]).x, 1.333 * 0.3 / 1.09_f64.sqrt(), 1e-6);
}

#[test]
fn nesting_is_not_limited() {
    const SHELLS: usize = 31;
    let shells: Vec<Body> = (0..SHELLS)
        .map(|shell| layer(-1.0 - 0.1 * shell as f64, 1.0 + 0.1 * shell as f64, 1.2 + 0.02 * shell as f64))
        .collect();
    let render_scene = stage_of(shells);
    let path = chain(&render_scene, ray(v(0.0, 9.0, 0.0), v(0.5, -1.0, 0.0)));
    assert_eq!(path.len(), 2 * SHELLS + 1);
    assert_vec_close(direction(path.last().unwrap()), direction(&path[0]), 2e-6);
    let sin = direction(&path[0]).x;
    for (shell, ray) in path[1..=SHELLS].iter().enumerate() {
        let index = 1.2 + 0.02 * (SHELLS - 1 - shell) as f64;
        assert_close(direction(ray).x, sin / index, 2e-6);
    }
}

#[test]
fn a_branching_tree_keeps_the_media_of_each_branch() {
    // Each surface both reflects and refracts; whatever the order of tracing, every ray in a layer has its sine.
    let mut bodies = [layer(-2.0, 2.0, 1.5), layer(-1.0, 1.0, 1.8)];
    for body in &mut bodies {
        let catoptric_scene::MaterialChoice::Inline(material) = &mut body.material else { unreachable!() };
        let phong = material.as_phong_mut().unwrap();
        (phong.reflection, phong.transmission) = (Some(0.4), 0.6);
    }
    let render_scene = stage_of(bodies.to_vec()).with_generations(9);
    let d = v(0.6, -0.8, 0.0);
    let rays = crate::proof::common::tree(&render_scene, ray(v(0.0, 3.0, 0.0), d));
    assert!(rays.len() > 100);
    for ray in &rays {
        let middle = ray.ray.origin.y + 0.01 * ray.ray.direction.y;
        let index = if middle.abs() < 1.0 {
            1.8
        } else if middle.abs() < 2.0 {
            1.5
        } else {
            1.0
        };
        assert_close(direction(ray).x * index, 0.6, 5e-6);
    }
}
