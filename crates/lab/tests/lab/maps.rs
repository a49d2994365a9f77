//! Maps against pictures and trees.

use catoptric_lab::maps::{Map, MapKind, MapSettings, map};
use catoptric_scene::{Color, Example, Material, Phong, Scene, Shape, Tracing};
use catoptric_tracer::{RenderControl, RenderError, RenderScene, RenderSettings, WhittedIntegrator, render};
use glam::{DVec3, UVec2};

use crate::scenes::{ball, body};

const PICTURE: RenderSettings = RenderSettings { width: 37, height: 35, samples: 1 };

fn made(scene: &Scene, kind: MapKind, picture: RenderSettings) -> Map {
    let render_scene = RenderScene::build(scene).unwrap();
    let settings = MapSettings { kind, picture, exposure_stops: 0.0 };
    let control = RenderControl::default();
    let map = map(&render_scene, render_scene.camera(), &settings, &control).unwrap();
    assert_eq!(control.pixels_done(), u64::from(picture.width * picture.height));
    map
}

/// Two mirrors face to face, that reflect `rho` and give 1 of their own; the camera between them.
fn corridor(rho: f64, generations: u32) -> Scene {
    let glow = Material::Phong(Phong {
        pattern: Color::WHITE.into(),
        ambient: 1.0,
        diffuse: 0.0,
        reflection: Some(rho),
        ..Phong::default()
    });
    let wall = |x: f64| body(Shape::Cube { size: DVec3::new(1.0, 100.0, 100.0) }, DVec3::X * x, glow.clone());
    let mut scene = Scene { bodies: [wall(-2.0), wall(2.0)].into_iter().collect(), ..Scene::default() };
    scene.camera.position = DVec3::ZERO;
    scene.camera.target = DVec3::X;
    scene.tracing = Tracing { generations, threshold: 0.0 };
    scene
}

#[test]
fn rays_and_generations_are_those_of_the_trees() {
    let scene = Example::find("whitted").unwrap().load().unwrap().scene;
    let render_scene = RenderScene::build(&scene).unwrap();
    let (rays, generations) =
        (made(&scene, MapKind::Rays, PICTURE), made(&scene, MapKind::Generations, PICTURE));
    let control = RenderControl::default();
    let size = UVec2::new(PICTURE.width, PICTURE.height);
    let total: f64 = rays.values.iter().map(|rays| f64::from(*rays)).sum();
    let counts = render(&render_scene, PICTURE, &control).unwrap().counts;
    assert_eq!(total, counts.total() as f64);
    let mut whitted = WhittedIntegrator::watched(&render_scene, render_scene.camera(), &control);
    for number in (0..size.x * size.y).step_by(11) {
        let pixel = UVec2::new(number % size.x, number / size.x);
        let tree = whitted.pixel_tree(pixel, size, 0, usize::MAX);
        let deepest = tree.iter().map(|ray| ray.generation).max().unwrap();
        assert_eq!(generations.value(pixel), Some(deepest as f32));
    }
    assert_eq!(generations.value(size), None);
    assert_eq!(generations.value(UVec2::new(size.x, 0)), None);
}

#[test]
fn what_the_limit_leaves_out_of_a_corridor_is_the_rest_of_its_series() {
    for (rho, generations) in [(0.5, 3), (0.8, 6), (0.3, 1)] {
        let losses = made(&corridor(rho, generations), MapKind::LimitLoss, PICTURE);
        // Rays below 2⁻¹² are in neither; of the series 1 + ρ + ρ² + … the first G are there.
        let followed = (1..=64).take_while(|g| rho.powi(g - 1) >= 1.0 / 4096.0).count() as i32;
        let sum = |terms: i32| (1.0 - rho.powi(terms)) / (1.0 - rho);
        let wanted = 1.0 - sum(generations as i32) / sum(followed);
        for loss in &losses.values {
            assert!((f64::from(*loss) - wanted).abs() < 1e-5, "{rho} {generations}: {loss}, not {wanted}");
        }
    }
}

#[test]
fn what_the_threshold_leaves_out_of_a_corridor_is_the_rest_of_its_series() {
    let mut scene = corridor(0.5, 6);
    scene.tracing.threshold = 0.2;
    // Of the weights 1, 1/2, … 1/32 the first three are traced.
    let losses = made(&scene, MapKind::ThresholdLoss, PICTURE);
    let wanted = 1.0 - 1.75 / (2.0 - 1.0 / 32.0);
    assert!(losses.values.iter().all(|loss| (f64::from(*loss) - wanted).abs() < 1e-5));
    scene.tracing.threshold = 0.0;
    assert_eq!(made(&scene, MapKind::ThresholdLoss, PICTURE).greatest(), 0.0);
}

#[test]
fn light_beyond_white_is_counted_after_exposure() {
    let mut scene = Scene::default();
    scene.environment.background = Color::new(3.0, 0.5, 0.5);
    let clipped = made(&scene, MapKind::Clipped, PICTURE);
    assert!(clipped.values.iter().all(|share| *share == 0.5));
    let render_scene = RenderScene::build(&scene).unwrap();
    let settings = MapSettings { kind: MapKind::Clipped, picture: PICTURE, exposure_stops: -2.0 };
    let darker = map(&render_scene, render_scene.camera(), &settings, &RenderControl::default()).unwrap();
    assert_eq!(darker.greatest(), 0.0);
}

#[test]
fn a_map_is_the_same_for_any_number_of_threads_and_can_be_cancelled() {
    let scene = Example::find("mirror-box").unwrap().load().unwrap().scene;
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| made(&scene, MapKind::LimitLoss, PICTURE))
    };
    assert_eq!(with(1), with(5));
    let render_scene = RenderScene::build(&scene).unwrap();
    let control = RenderControl::default();
    control.cancel();
    for kind in MapKind::ALL {
        let settings = MapSettings { kind, picture: PICTURE, exposure_stops: 0.0 };
        let outcome = map(&render_scene, render_scene.camera(), &settings, &control);
        assert!(matches!(outcome, Err(RenderError::Cancelled)), "{kind:?}");
    }
}

#[test]
fn maps_have_legends_with_round_scales() {
    let scene = corridor(0.5, 3);
    for kind in MapKind::ALL {
        let map = made(&scene, kind, RenderSettings { width: 200, height: 9, samples: 2 });
        let picture = map.to_picture().unwrap();
        assert!(picture.height() > map.height && picture.width() == map.width);
        assert!(map.greatest() <= map.scale_end());
        assert_eq!(picture.pixels()[0], map.color(map.values[0]));
        // The strip has letters, and a scale from dark to light.
        let strip = &picture.pixels()[200 * 9..];
        assert!(strip.iter().filter(|pixel| **pixel == [0.8; 3]).count() > 100);
        assert_eq!(map.to_numbers().unwrap().pixels()[5], [map.values[5]; 3]);
    }
    // No wider than one pixel, and still a picture.
    let narrow = made(&scene, MapKind::Rays, RenderSettings { width: 1, height: 1, samples: 1 });
    assert_eq!(narrow.to_picture().unwrap().width(), 1);
}

#[test]
fn a_pixel_with_too_many_rays_is_told() {
    let glass = Material::Phong(Phong {
        transmission: 1.0,
        reflection: Some(1.0),
        ambient: 0.0,
        diffuse: 0.0,
        specular: 0.0,
        ..Phong::default()
    });
    let mut scene =
        Scene { bodies: std::iter::once(ball(1.0, DVec3::Y, glass)).collect(), ..Scene::default() };
    scene.tracing.generations = 64;
    let map = made(&scene, MapKind::Rays, RenderSettings { width: 3, height: 3, samples: 1 });
    assert_eq!(map.incomplete, 0, "a ball alone splits a ray once a generation");
    let glass = scene.bodies.iter().next().unwrap().clone();
    let others = [1.5, -1.5].map(|z| {
        let mut other = glass.clone();
        other.placement = catoptric_scene::Placement::at(DVec3::new(0.0, 1.0, z * 1.4));
        other
    });
    scene.bodies = others.into_iter().chain([glass]).collect();
    let map = made(&scene, MapKind::Rays, RenderSettings { width: 3, height: 3, samples: 1 });
    assert!(map.incomplete > 0);
}
