//! What goes straight on at the last generation.

use std::sync::atomic::AtomicBool;

use catoptric_scene::{Body, Color, Dielectric, Phong, Scene, Tracing};
use catoptric_tracer::{BranchOutcome, RenderControl, RenderSettings, WhittedIntegrator, render};
use glam::{DVec3, UVec2, Vec3};

use crate::proof::common::{
    assert_same_picture, ball, block, camera, glass, glow, mirror, picture, plane, render_scene, scene,
    turned, v,
};
use catoptric_scene::Shape;

fn clear(ior: f64) -> Dielectric {
    Dielectric { index: ior.into(), ..Dielectric::default() }
}

/// Things to be seen, and of them in mirrors.
fn things() -> Vec<Body> {
    vec![
        ball(0.6, v(0.3, 0.1, -3.0), glow(Color::new(0.2, 0.7, 0.4))),
        block(v(0.8, 0.8, 0.8), v(-1.6, 0.2, -3.5), mirror()),
        plane(v(0.0, -1.2, 0.0), 0.0, Phong { reflection: Some(0.5), ..glow(Color::new(0.3, 0.2, 0.1)) }),
    ]
}

fn look(bodies: Vec<Body>, generations: u32) -> Scene {
    let mut scene = scene(bodies);
    scene.environment.background = Color::new(0.4, 0.5, 0.9);
    scene.tracing = Tracing { generations, threshold: 0.0 };
    scene.camera = camera(v(0.0, 0.3, 8.0), DVec3::ZERO, 30.0);
    scene
}

/// Bodies that cannot be seen, of every shape and by both models: of the index of air, of that of the body around them, or
/// left while another is entered last.
fn invisible() -> Vec<Body> {
    let mut phong = glass(1.0);
    phong.reflection = Some(0.0);
    let tilt = v(20.0, 30.0, 40.0);
    vec![
        ball(1.0, v(0.2, 0.0, 0.0), clear(1.0)),
        ball(0.5, v(0.2, 0.0, 0.0), clear(1.0)),
        turned(Shape::CUBE, v(1.5, 0.0, 0.0), tilt, clear(1.0)),
        turned(Shape::CONE, v(-1.5, 0.0, 0.0), tilt, phong.clone()),
        turned(Shape::CYLINDER, v(-0.8, 0.4, 0.6), tilt, phong),
        ball(0.4, v(0.0, 0.8, 0.0), Dielectric { roughness: 0.8, ..clear(1.0) }),
        turned(Shape::CUBE, v(0.4, -0.4, 0.9), tilt, Dielectric { dispersion: true, ..clear(1.0) }),
    ]
}

#[test]
fn invisible_bodies_change_nothing_at_any_limit() {
    for generations in 1..=4 {
        let without = picture(&look(things(), generations), 90, 60);
        let with = look(invisible().into_iter().chain(things()).collect(), generations);
        assert_same_picture(&picture(&with, 90, 60), &without, 0.0);
        // Among many, rays go through a hierarchy and as streams.
        let far = |index: usize| ball(0.1, v(0.3 * index as f64, 60.0, 0.0), clear(1.0));
        let many = invisible().into_iter().chain(things()).chain((0..60).map(far)).collect();
        assert_same_picture(&picture(&look(many, generations), 90, 60), &without, 0.0);
    }
}

/// A body of the index of the glass that it lies in: once within the glass, it is passed at the last generation, too.
#[test]
fn equal_indices_within_glass_are_passed_at_the_limit() {
    let glass_around = || ball(1.5, DVec3::ZERO, clear(1.5));
    let within =
        || [ball(0.7, v(0.2, 0.1, 0.0), clear(1.5)), block(v(0.5, 0.6, 0.7), v(-0.5, 0.0, 0.2), clear(1.5))];
    for generations in 1..=4 {
        let without =
            picture(&look([glass_around()].into_iter().chain(things()).collect(), generations), 60, 40);
        let with = look([glass_around()].into_iter().chain(within()).chain(things()).collect(), generations);
        // The position of a point that is reached in two steps is rounded twice.
        assert_same_picture(&picture(&with, 60, 40), &without, 0.001);
    }
}

#[test]
fn what_is_visible_ends_at_the_limit() {
    let scene = look(vec![ball(1.0, DVec3::ZERO, clear(1.5))], 1);
    let (render_scene, cancel) = (render_scene(&scene), AtomicBool::new(false));
    let rays = WhittedIntegrator::new(&render_scene, &cancel).pixel_tree(
        UVec2::new(30, 20),
        UVec2::new(60, 40),
        0,
        100,
    );
    assert_eq!(rays.len(), 1);
    assert_eq!(rays[0].answer.as_ref().unwrap().refracted.fate, BranchOutcome::GenerationLimit);
    assert_eq!(rays[0].light, Vec3::ZERO);
}

/// The tree that is written down is that of the picture.
#[test]
fn the_tree_goes_straight_on_at_the_limit() {
    let size = UVec2::new(60, 40);
    let scene = look(invisible().into_iter().chain(things()).collect(), 1);
    let (render_scene, cancel) = (render_scene(&scene), AtomicBool::new(false));
    let settings = RenderSettings { width: size.x, height: size.y, samples: 1 };
    let picture = render(&render_scene, settings, &RenderControl::default()).unwrap().picture;
    let mut tracer = WhittedIntegrator::new(&render_scene, &cancel);
    let mut passed = 0;
    for (place, pixel) in (0..).zip(picture.pixels()) {
        let rays = tracer.pixel_tree(UVec2::new(place % size.x, place / size.x), size, 0, 1000);
        let sum: DVec3 = rays.iter().map(|ray| ray.light.as_dvec3()).sum();
        // Rounded once: the order of adding shows in the last digit only.
        assert!((sum.as_vec3() - Vec3::from(*pixel)).abs().max_element() < 1e-6, "{place}: {sum}");
        for ray in &rays {
            assert_eq!(ray.generation, 1);
            let Some(answer) = &ray.answer else { continue };
            if let BranchOutcome::Followed(next) = answer.refracted.fate {
                assert_eq!(rays[next].ray.direction, ray.ray.direction);
                passed += 1;
            }
        }
    }
    assert!(passed > 500, "{passed}");
}

/// Distances are those from the eye, wherever single precision has rays start.
#[test]
fn distances_count_from_the_eye() {
    for far in [10.0, 1e3, 1e5] {
        let mut scene = scene(vec![ball(1.0, v(0.5, 0.0, 0.0), glow(Color::WHITE))]);
        scene.camera = camera(v(0.5, 0.0, far), v(0.5, 0.0, 0.0), 50.0 / far);
        for projection in [scene.camera.projection, catoptric_scene::Projection::Parallel { height: 0.5 }] {
            scene.camera.projection = projection;
            let (render_scene, cancel) = (render_scene(&scene), AtomicBool::new(false));
            let size = UVec2::new(9, 9);
            let rays =
                WhittedIntegrator::new(&render_scene, &cancel).pixel_tree(UVec2::new(4, 4), size, 0, 10);
            let distance = rays[0].distance().unwrap();
            assert!((distance - (far - 1.0)).abs() < 1e-6 * far, "{distance} from {far}");
        }
    }
}
