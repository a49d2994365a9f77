//! A change redoes what depends on it and nothing else.

use std::sync::Arc;
use std::time::Duration;

use catoptric_live::{GridSpec, Request};
use catoptric_picture::{Development, ToneCurve};
use catoptric_scene::{Body, Color, Falloff, MaterialChoice, Placement, Projection, Scene, Shape};
use catoptric_tracer::Ray;
use glam::DVec3;

use crate::{Window, expected, four_bodies, from_side, request};

#[test]
fn another_camera_does_not_prepare_the_scene_again() {
    let window = Window::open();
    window.shown(request(1));
    let (revision, render_scene) = window.live.render_scene().unwrap();
    assert_eq!(revision, 1);
    let mut asked = request(2);
    asked.camera = from_side(&asked.camera, 90.0);
    asked.camera.projection = Projection::Parallel { height: 4.0 };
    let frame = window.shown(asked.clone());
    assert!(*frame.pixels == expected(&asked, 3));
    // The scene's own camera is not looked at.
    let scene = Scene { camera: asked.camera, ..(*four_bodies()).clone() };
    window.shown(Request { scene: Arc::new(scene), revision: 3, ..asked });
    let (revision, same) = window.live.render_scene().unwrap();
    assert!(revision == 3 && Arc::ptr_eq(&render_scene, &same));
}

#[test]
fn another_scene_is_prepared_and_shown() {
    let window = Window::open();
    window.shown(request(1));
    let (_, render_scene) = window.live.render_scene().unwrap();
    let mut scene = (*four_bodies()).clone();
    scene.environment.background = Color::new(1.0, 0.0, 0.0);
    scene.bodies.truncate(2);
    let asked = Request { scene: Arc::new(scene), ..request(2) };
    let frame = window.shown(asked.clone());
    assert!(*frame.pixels == expected(&asked, 3));
    let (revision, other) = window.live.render_scene().unwrap();
    assert!(revision == 2 && !Arc::ptr_eq(&render_scene, &other) && other.body_count() == 2);
}

#[test]
fn names_and_locks_leave_the_stage_alone() {
    let window = Window::open();
    let before = window.shown(request(1));
    let (_, render_scene) = window.live.render_scene().unwrap();
    let shown = |revision: u64, edit: &dyn Fn(&mut Scene)| {
        let mut scene = (*four_bodies()).clone();
        edit(&mut scene);
        let frame = window.shown(Request { scene: Arc::new(scene), ..request(revision) });
        (frame, window.live.render_scene().unwrap().1)
    };
    let renamed = |scene: &mut Scene| {
        scene.bodies[0].name = "another".to_owned();
        scene.bodies[1].locked = true;
        scene.lights[0].name = "another".to_owned();
        scene.lights[0].locked = true;
    };
    let (frame, same) = shown(2, &renamed);
    assert!(Arc::ptr_eq(&render_scene, &same) && Arc::ptr_eq(&frame.pixels, &before.pixels));
    let edits: [&dyn Fn(&mut Scene); 9] = [
        &|scene| scene.bodies[1].hidden = true,
        &|scene| scene.bodies[1].placement = scene.bodies[1].placement.moved_by(DVec3::X),
        &|scene| scene.bodies[1].shape = Shape::SPHERE,
        &|scene| scene.bodies[1].material = MaterialChoice::default(),
        &|scene| scene.bodies.swap(0, 1),
        &|scene| scene.lights[0].hidden = true,
        &|scene| scene.lights[0].position.x += 1.0,
        &|scene| scene.lights[0].intensity *= 0.5,
        &|scene| scene.lights[0].falloff = Falloff::InverseSquare,
    ];
    for (edit, revision) in edits.into_iter().zip(3..) {
        let (frame, other) = shown(revision, edit);
        let mut scene = (*four_bodies()).clone();
        edit(&mut scene);
        assert!(!Arc::ptr_eq(&render_scene, &other), "edit {revision}");
        assert!(*frame.pixels == expected(&Request { scene: Arc::new(scene), ..request(revision) }, 3));
    }
}

/// Balls in rows over the floor of the four bodies.
fn crowd() -> Scene {
    let ball = |at: usize| Body {
        placement: Placement::at(DVec3::new(0.4 * (at % 10) as f64, 2.5, -0.4 * (at / 10) as f64)),
        shape: Shape::Sphere { radius: 0.15 },
        ..Body::default()
    };
    let mut scene = (*four_bodies()).clone();
    scene.bodies.extend((0..100).map(ball));
    scene
}

#[test]
fn moved_bodies_are_followed_in_the_scene() {
    let window = Window::open();
    let mut scene = crowd();
    window.shown(Request { scene: Arc::new(scene.clone()), ..request(1) });
    let address = || Arc::as_ptr(&window.live.render_scene().unwrap().1);
    let before = address();
    for revision in 2..6 {
        let body = &mut scene.bodies[20 + revision as usize];
        body.placement = body.placement.moved_by(0.1 * DVec3::ONE);
        scene.lights[0].intensity *= 0.9;
        let asked = Request { scene: Arc::new(scene.clone()), outline: vec![1], ..request(revision) };
        let frame = window.shown(asked.clone());
        assert!(*frame.pixels == expected(&asked, 3), "edit {revision}");
        assert!(!frame.outline.is_empty());
        assert_eq!(window.live.render_scene().unwrap().0, revision);
    }
    assert_eq!(address(), before, "the stage is edited, not prepared anew");
}

#[test]
fn a_stage_that_somebody_holds_stays_as_it_is() {
    let window = Window::open();
    let mut scene = crowd();
    window.shown(Request { scene: Arc::new(scene.clone()), ..request(1) });
    let (_, held) = window.live.render_scene().unwrap();
    let ball = 4 + 55;
    let from = scene.bodies[ball].placement.origin() + 0.2 * DVec3::Z;
    let ray = Ray::from_point(from.as_vec3(), DVec3::NEG_Z.as_vec3());
    assert_eq!(held.closest_hit(&ray).map(|hit| hit.body), Some(ball));
    scene.bodies[ball].placement = Placement::at(DVec3::new(0.0, 4.0, 0.0));
    let asked = Request { scene: Arc::new(scene), ..request(2) };
    assert!(*window.shown(asked.clone()).pixels == expected(&asked, 3));
    let (revision, edited) = window.live.render_scene().unwrap();
    assert_eq!(revision, 2);
    assert_eq!(held.closest_hit(&ray).map(|hit| hit.body), Some(ball));
    assert_ne!(edited.closest_hit(&ray).map(|hit| hit.body), Some(ball));
}

#[test]
fn exposure_and_tone_curve_only_develop_again() {
    let window = Window::open();
    let before = window.shown(request(1));
    let mut asked = request(1);
    // What would have to be traced is counted as frames below the wanted samples.
    for development in [
        Development { exposure_stops: 1.5, tone_curve: ToneCurve::None },
        Development { exposure_stops: -0.5, tone_curve: ToneCurve::Filmic },
    ] {
        asked.development = development;
        let serial = window.live.latest().unwrap().serial;
        let frame = window.shown(asked.clone());
        assert!(*frame.pixels == expected(&asked, 3));
        assert_eq!((frame.serial, frame.samples), (serial + 1, 3));
    }
    assert_ne!(before.pixels, window.live.latest().unwrap().pixels);
}

#[test]
fn outlines_and_grid_leave_the_picture_alone() {
    let window = Window::open();
    let before = window.shown(request(1));
    assert!(before.outline.is_empty() && before.hover.is_empty() && before.grid.is_empty());
    let mut asked = request(1);
    asked.outline = vec![1, 4];
    asked.hover = Some(2);
    asked.grid = Some(GridSpec::default());
    let frame = window.shown(asked.clone());
    assert_eq!(frame.picture_serial, before.picture_serial);
    assert!(Arc::ptr_eq(&frame.pixels, &before.pixels) && frame.serial == before.serial + 1);
    assert!(frame.outline.iter().any(|line| line.body == Some(1)));
    assert!(frame.outline.iter().any(|line| line.body == Some(4)));
    assert!(frame.hover.iter().all(|line| line.body == Some(2)) && !frame.hover.is_empty());
    assert!(!frame.grid.is_empty());
    // What is outlined is not outlined twice.
    asked.hover = Some(4);
    assert!(window.shown(asked.clone()).hover.is_empty());
    (asked.outline, asked.hover, asked.grid) = (Vec::new(), Some(99), None);
    let frame = window.shown(asked);
    assert!(frame.outline.is_empty() && frame.hover.is_empty() && frame.grid.is_empty());
}

#[test]
fn the_same_request_again_changes_nothing() {
    let window = Window::open();
    let before = window.shown(request(1));
    let again = window.shown(request(1));
    assert_eq!(again.serial, before.serial);
    // Only its number is new.
    let renamed = window.shown(request(2));
    assert_eq!((renamed.serial, renamed.picture_serial), (before.serial + 1, before.picture_serial));
}

#[test]
fn a_window_that_always_asks_the_same_is_left_in_peace() {
    let window = Window::open();
    let unknown = Body { material: MaterialChoice::Named("gold".into()), ..Body::default() };
    let broken = Arc::new(Scene { bodies: [unknown].into(), ..Scene::default() });
    for asked in [request(1), Request::new(broken, 2, [16, 16])] {
        window.live.request(asked.clone());
        window.settle();
        // The last ring may come just after the engine is idle.
        while window.bell.recv_timeout(Duration::from_millis(100)).is_ok() {}
        for _ in 0..3 {
            window.live.request(asked.clone());
            window.settle();
        }
        assert!(window.bell.recv_timeout(Duration::from_millis(100)).is_err());
    }
}

#[test]
fn more_samples_go_on_from_where_the_picture_is() {
    let window = Window::open();
    window.shown(request(1));
    let asked = Request { samples: 6, ..request(1) };
    let frame = window.shown(asked.clone());
    assert_eq!(frame.samples, 6);
    assert!(*frame.pixels == expected(&asked, 6));
    // Fewer take nothing back.
    assert_eq!(window.shown(Request { samples: 0, ..request(1) }).samples, 6);
}

#[test]
fn while_paused_first_pictures_come_but_are_not_refined() {
    let window = Window::open();
    let paused = Request { paused: true, samples: 50, ..request(1) };
    let frame = window.shown(paused.clone());
    assert_eq!(frame.samples, 1);
    let frame = window.shown(Request { paused: false, samples: 4, ..paused });
    assert_eq!(frame.samples, 4);
}

#[test]
fn a_view_of_another_size_has_a_picture_of_its_size() {
    let window = Window::open();
    window.shown(request(1));
    for size in [[1, 1], [333, 10], [7, 250], [160, 90]] {
        let asked = Request { size, ..request(2) };
        let frame = window.shown(asked.clone());
        assert_eq!((frame.view_size, frame.picture_size), (size, size));
        assert!(*frame.pixels == expected(&asked, 3));
    }
}
