//! Rays estimated before tracing, against those that tracing counts.

use catoptric_lab::work::RayEstimate;
use catoptric_scene::{Dielectric, Example, Material, Scene, Shape};
use catoptric_tracer::{RenderControl, RenderError, RenderScene, RenderSettings, render};
use glam::{DVec3, UVec2};

use crate::scenes::{ball, body};

/// A hollow ball of glass on a floor.
fn hollow(generations: u32) -> Scene {
    let clear = |ior: f64| Material::Dielectric(Dielectric { index: ior.into(), ..Dielectric::default() });
    let at = DVec3::new(0.0, 1.2, 0.0);
    let bodies = [
        body(Shape::Plane, DVec3::ZERO, Material::default()),
        ball(1.0, at, clear(1.5)),
        ball(0.9, at, clear(1.0)),
    ];
    let mut scene = Scene { bodies: bodies.into_iter().collect(), ..Scene::default() };
    scene.tracing.generations = generations;
    scene
}

fn estimated(scene: &Scene, size: UVec2) -> RayEstimate {
    let render_scene = RenderScene::build(scene).unwrap();
    RayEstimate::of(&render_scene, render_scene.camera(), size, &RenderControl::default()).unwrap()
}

#[test]
fn estimates_are_near_what_is_counted() {
    let example = |name: &str| Example::find(name).unwrap().load().unwrap().scene;
    let scenes =
        [example("whitted"), example("four-bodies"), example("prism"), hollow(6), hollow(9), hollow(12)];
    for (number, scene) in scenes.iter().enumerate() {
        let size = UVec2::new(120, 80);
        let settings = RenderSettings { width: size.x, height: size.y, samples: 1 };
        let render_scene = RenderScene::build(scene).unwrap();
        let counted =
            render(&render_scene, settings, &RenderControl::default()).unwrap().counts.total() as f64;
        let estimated = estimated(scene, size).of_picture(u64::from(size.x * size.y), 1);
        // A walk takes one of many ways; thousands of them leave some percent.
        assert!((estimated / counted - 1.0).abs() < 0.15, "{number}: {estimated}, counted {counted}");
    }
}

#[test]
fn trees_without_end_are_estimated_too() {
    let [few, many] = [12, 30].map(|generations| estimated(&hollow(generations), UVec2::new(160, 120)));
    assert!(!few.is_worth_a_warning() && many.is_worth_a_warning(), "{few:?}, {many:?}");
    // Of each ray at a wall two come, of which some leave: the number grows, but by less than twice a generation.
    let growth = (many.per_sample / few.per_sample).powf(1.0 / 18.0);
    assert!((1.2..2.0).contains(&growth), "{growth}");
    let render_scene = RenderScene::build(&hollow(30)).unwrap();
    let limits = (30, RayEstimate::ADVISED_THRESHOLD as f32);
    let bounded = RayEstimate::within(
        &render_scene,
        render_scene.camera(),
        UVec2::new(160, 120),
        limits,
        &RenderControl::default(),
    )
    .unwrap();
    assert!(bounded.per_sample < 100.0, "{bounded:?}");
}

#[test]
fn estimating_can_be_cancelled() {
    let render_scene = RenderScene::build(&hollow(64)).unwrap();
    let control = RenderControl::default();
    control.cancel();
    let ended = RayEstimate::of(&render_scene, render_scene.camera(), UVec2::new(100, 100), &control);
    assert!(matches!(ended, Err(RenderError::Cancelled)), "{ended:?}");
}
