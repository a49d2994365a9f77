//! The noise of soft lights and rough surfaces: it may not gather anywhere, for the samples of each pixel are spread evenly.

use catoptric_picture::Picture;
use catoptric_scene::{Camera, Color, Light, Mirror, Projection, Scene, Sky, Surroundings};
use catoptric_tracer::{RenderControl, RenderSettings, render};
use glam::DVec3;

use crate::proof::common::{ball, chalk, plane, render_scene, scene, v};

/// An odd number of pixels, so that the middle of a row is where a coordinate is 0.
const SIZE: u32 = 33;

fn drawn(scene: &Scene) -> Picture {
    let settings = RenderSettings { width: SIZE, height: SIZE, samples: 64 };
    render(&render_scene(scene), settings, &RenderControl::default()).unwrap().picture
}

/// A view straight down, in which rows have a z and columns an x.
fn from_above(scene: Scene) -> Scene {
    let projection = Projection::Perspective { fov_degrees: 40.0 };
    let camera = Camera { position: v(0.0, 6.0, 0.0), target: DVec3::ZERO, up: DVec3::NEG_Z, projection };
    Scene { camera, ..scene }
}

/// The noise of each row and each column, where `noise` is that of a pixel.
fn lines(noise: impl Fn(u32, u32) -> f64) -> Vec<f64> {
    let mean = |of: &dyn Fn(u32) -> f64| {
        ((4..SIZE - 4).map(|at| of(at).powi(2)).sum::<f64>() / f64::from(SIZE - 8)).sqrt()
    };
    let rows = (4..SIZE - 4).map(|y| mean(&|x| noise(x, y)));
    rows.chain((4..SIZE - 4).map(|x| mean(&|y| noise(x, y)))).collect()
}

#[track_caller]
fn assert_even(mut noise: Vec<f64>, what: &str) {
    let (at, most) = noise.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    noise.sort_by(f64::total_cmp);
    let usual = noise[noise.len() / 2];
    assert!(most < 2.5 * usual && usual > 0.0, "{what}: {most:e} in line {at}, {usual:e} in others");
}

#[test]
fn a_soft_light_is_as_smooth_where_a_coordinate_of_its_direction_is_0() {
    let of = |radius: f64| {
        let mut scene = from_above(scene(vec![plane(DVec3::ZERO, 0.0, chalk())]));
        scene.lights = vec![Light { position: v(0.0, 1.5, 0.0), radius, ..Light::default() }];
        drawn(&scene)
    };
    // The mean of a ball's light on a ground that faces all of it is that of its center.
    let (soft, exact) = (of(0.5), of(0.0));
    let noise = |x, y| f64::from(soft.pixel(x, y).unwrap()[0] - exact.pixel(x, y).unwrap()[0]);
    assert!((0..SIZE).all(|at| noise(at, at).abs() < 0.01));
    assert_even(lines(noise), "a soft light");
}

#[test]
fn a_rough_mirror_is_as_smooth_where_a_coordinate_of_its_normal_is_0() {
    let rough = Mirror { pattern: Color::WHITE.into(), roughness: 0.5, ..Mirror::default() };
    let mut scene = from_above(scene(vec![ball(3.0, DVec3::ZERO, rough)]));
    scene.environment.surroundings = Surroundings::Sky(Sky::default());
    scene.tracing.generations = 2;
    let picture = drawn(&scene);
    let light = |x, y| f64::from(picture.pixel(x, y).unwrap()[0]);
    // What is not smooth along one of both: the fourth difference is that of noise alone.
    let along = |[a, b, c, d, e]: [f64; 5]| (a - 4.0 * b + 6.0 * c - 4.0 * d + e) / 70.0_f64.sqrt();
    let rows = lines(|x, y| along([x - 2, x - 1, x, x + 1, x + 2].map(|x| light(x, y))));
    let columns = lines(|x, y| along([y - 2, y - 1, y, y + 1, y + 2].map(|y| light(x, y))));
    let half = rows.len() / 2;
    assert_even(rows[..half].to_vec(), "rows of a rough mirror");
    assert_even(columns[half..].to_vec(), "columns of a rough mirror");
}
