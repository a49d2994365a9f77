//! Bodies that touch, nearly touch, or are thinner than rounding; and numbers at the limits of the format.

use catoptric_scene::{Color, Falloff, Phong, Shape};
use catoptric_tracer::{RenderControl, RenderSettings, render};
use glam::DVec3;

use crate::proof::common::{
    assert_same_picture, ball, block, body, camera, chalk, glass, glow, light, picture, plane, render_scene,
    scene, v,
};

/// A pane that lies behind another one does not shade it, though both are thinner than the rounding of their place.
#[test]
fn thin_panes_far_from_the_origin_do_not_shade_their_neighbors() {
    for (far, thickness) in [(1000.0, 1e-3), (100.0, 1e-4), (10.0, 1e-5)] {
        for gap in [0.0, thickness] {
            let place = |layer: f64| v(far, layer * thickness, 0.0);
            let pane = |layer: f64| block(v(1.0, thickness, 1.0), place(layer), chalk());
            let upper = 1.5 + gap / thickness;
            let take = |bodies| {
                let mut scene = scene(bodies);
                scene.camera = camera(v(far, 2.0, 0.001), v(far, 0.0, 0.0), 20.0);
                scene.lights = vec![light(v(far + 0.5, 5.0, 0.3), 1.0, Falloff::None)];
                picture(&scene, 64, 64)
            };
            assert_same_picture(&take(vec![pane(upper)]), &take(vec![pane(upper), pane(0.5)]), 0.0);
        }
    }
}

/// Two surfaces in one plane do not shade each other, however flat the light falls.
#[test]
fn coincident_surfaces_do_not_shade_each_other_at_grazing_light() {
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let (along, up) = (v(cos, sin, 0.0), v(-sin, cos, 0.0));
    let point = v(3.1, 1.7, 2.3);
    let floor = plane(point, 30.0, chalk());
    let mut block = block(v(9.0, 1.4, 9.0), point - 0.7 * up, chalk());
    if let catoptric_scene::Anchor::Frame { rotation_degrees, .. } = &mut block.placement.anchor {
        *rotation_degrees = v(0.0, 0.0, 30.0);
    }
    for elevation in [10.0_f64, 3.0, 1.0, 0.3, 0.1] {
        let (rise, reach) = elevation.to_radians().sin_cos();
        let take = |bodies| {
            let mut scene = scene(bodies);
            scene.camera = camera(point + 8.0 * up - v(0.0, 0.0, 1.0), point, 15.0);
            scene.lights = vec![light(point + 50.0 * (reach * along + rise * up), 1.0 / rise, Falloff::None)];
            picture(&scene, 64, 36)
        };
        assert_same_picture(&take(vec![floor.clone()]), &take(vec![floor.clone(), block.clone()]), 0.0);
    }
}

/// Which of two nearly coincident surfaces comes first does not depend on the order of the file.
#[test]
fn contacts_do_not_depend_on_the_order_of_bodies() {
    for sunk in [0.0, 5e-5, 1e-4, 2e-4, 1e-3] {
        let slab = block(v(200.0, 1.0, 200.0), v(0.0, -0.5, 0.0), glass(1.3));
        let small = block(DVec3::ONE, v(0.0, 0.5 - sunk, 0.0), glass(1.6));
        let below = plane(v(0.0, -3.0, 0.0), 0.0, glow(Color::new(0.9, 0.5, 0.2)));
        let take = |bodies| {
            let mut scene = scene(bodies);
            scene.camera = camera(v(1.0, 3.0, 1.5), v(0.0, 0.2, 0.0), 20.0);
            scene.tracing.generations = 6;
            picture(&scene, 64, 36)
        };
        let one = take(vec![slab.clone(), small.clone(), below.clone()]);
        assert!(one == take(vec![below, small, slab]), "sunk by {sunk}");
    }
}

/// The limits of radius allow a frustum that widens 10¹² times; it is a cone upside down.
#[test]
fn a_frustum_that_widens_enormously_is_a_cone_upside_down() {
    let take = |shape, turn: f64| {
        let mut cone = body(shape, v(0.0, if turn == 0.0 { -1.0 } else { 1.0 }, 0.0), chalk());
        if let catoptric_scene::Anchor::Frame { rotation_degrees, .. } = &mut cone.placement.anchor {
            rotation_degrees.x = turn;
        }
        let mut scene = scene(vec![cone]);
        scene.camera = camera(v(1.0, 2.0, 6.0), DVec3::ZERO, 40.0);
        scene.lights = vec![light(v(3.0, 5.0, 4.0), 1.0, Falloff::None)];
        picture(&scene, 64, 64)
    };
    let cone = take(Shape::Cone { radius: 1.5, top_radius: 0.0, height: 2.0 }, 180.0);
    let widening = take(Shape::Cone { radius: 1e-9, top_radius: 1.5, height: 2.0 }, 0.0);
    assert_same_picture(&cone, &widening, 0.0);
}

#[test]
fn light_at_the_limits_is_a_number_and_highlights_stay_within_their_coefficient() {
    let red = Phong { pattern: Color::new(1.0, 0.0, 0.0).into(), ..chalk() };
    let mut scene = scene(vec![plane(DVec3::ZERO, 0.0, red.clone())]);
    scene.camera = camera(v(0.0, 5.0, 0.001), DVec3::ZERO, 10.0);
    scene.lights = vec![light(v(0.0, 1e-17, 0.0), 1e6, Falloff::InverseSquare)];
    assert!(picture(&scene, 9, 9).pixels().as_flattened().iter().all(|value| !value.is_nan()));

    let shiny = Phong { diffuse: 0.0, specular: 1.0, shininess: 1e6, ..red };
    scene.bodies = [ball(1.0, DVec3::ZERO, Phong { reflection: Some(0.0), ..shiny })].into();
    scene.environment.background = Color::BLACK;
    scene.camera = camera(v(0.0, 0.0, 5.0), DVec3::ZERO, 0.05);
    scene.lights = vec![light(v(0.01, 0.0, 5.0), 1.0, Falloff::None)];
    let brightest =
        picture(&scene, 200, 200).pixels().as_flattened().iter().fold(0.0_f32, |most, &x| most.max(x));
    assert!(brightest > 0.5 && brightest <= 1.0, "{brightest}");
}

#[test]
fn the_mean_of_many_equal_samples_is_their_value() {
    let mut empty = scene(Vec::new());
    empty.environment.background = Color::new(0.1, 0.3, 0.7);
    let settings = RenderSettings { width: 1, height: 1, samples: 65536 };
    let rendering = render(&render_scene(&empty), settings, &RenderControl::default()).unwrap();
    assert_eq!(rendering.picture.pixels(), [[0.1, 0.3, 0.7]]);
}
