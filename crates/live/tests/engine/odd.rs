//! Requests that cannot be served, or hardly.

use std::sync::Arc;

use catoptric_live::{GridSpec, LiveError, Request};
use catoptric_scene::{Body, Camera, MaterialChoice, Projection, Scene, Shape};
use glam::DVec3;

use crate::{Window, expected, request};

#[test]
fn a_view_of_no_pixels_asks_for_nothing() {
    let window = Window::open();
    for size in [[0, 0], [0, 90], [160, 0]] {
        window.live.request(Request { size, ..request(1) });
        assert_eq!(window.settle().error, None);
        assert!(window.live.latest().is_none());
    }
    assert!(window.shown(request(2)).is_full());
}

#[test]
fn what_cannot_be_shown_is_an_error_and_the_last_frame_stays() {
    let window = Window::open();
    let last = window.shown(request(1));
    let refused = |request: Request| {
        window.live.request(request);
        let error = window.settle().error;
        assert_eq!(window.live.latest().unwrap().serial, last.serial);
        error
    };
    let too_large = Some(LiveError::TooLarge { width: 100_000, height: 100_000 });
    assert_eq!(refused(Request { size: [100_000; 2], ..request(2) }), too_large);
    assert!(refused(Request { size: [u32::MAX; 2], ..request(2) }).is_some());
    for camera in [
        Camera { position: DVec3::new(0.0, f64::NAN, 1.0), ..Camera::default() },
        Camera { target: DVec3::INFINITY, ..Camera::default() },
        Camera { up: DVec3::NAN, ..Camera::default() },
        Camera { projection: Projection::Perspective { fov_degrees: f64::NAN }, ..Camera::default() },
        Camera { projection: Projection::Parallel { height: f64::INFINITY }, ..Camera::default() },
    ] {
        assert_eq!(refused(Request { camera, ..request(3) }), Some(LiveError::Camera));
    }
    let gold = Body { material: MaterialChoice::Named("gold".into()), ..Body::default() };
    let scene = Arc::new(Scene { bodies: [gold].into(), ..Scene::default() });
    let error = refused(Request::new(scene, 4, [16, 16]));
    assert!(matches!(&error, Some(LiveError::Stage(_))), "{error:?}");
    assert!(error.unwrap().to_string().contains("gold"));
    // The same number of samples, and no error any more.
    let again = window.shown(request(5));
    assert!(again.pixels == last.pixels && again.serial > last.serial);
}

#[test]
fn what_is_prepared_outlives_requests_of_nothing() {
    let window = Window::open();
    let asked = request(1);
    let last = window.shown(asked.clone());
    let (_, render_scene) = window.live.render_scene().unwrap();
    let nowhere = Camera { position: DVec3::NAN, ..Camera::default() };
    for nothing in [Request { size: [0, 90], ..request(2) }, Request { camera: nowhere, ..request(2) }] {
        let serial = window.live.latest().unwrap().serial;
        window.live.request(nothing);
        window.settle();
        assert_eq!(window.live.latest().unwrap().serial, serial, "nothing is traced");
        // The picture is the same one, and the window is told of it.
        let frame = window.shown(asked.clone());
        assert!(Arc::ptr_eq(&frame.pixels, &last.pixels) && frame.serial == serial + 1);
        let (_, same) = window.live.render_scene().unwrap();
        assert!(Arc::ptr_eq(&render_scene, &same));
    }
    // What was still to be done then is done later.
    let mut asked = Request { samples: 1, ..request(3) };
    for degrees in 1..=10 {
        asked.camera = crate::from_side(&asked.camera, f64::from(degrees));
        window.live.request(asked.clone());
        std::thread::yield_now();
        window.live.request(Request { size: [0, 0], ..asked.clone() });
        window.settle();
        assert!(*window.shown(asked.clone()).pixels == expected(&asked, 1));
    }
}

#[test]
fn odd_scenes_and_cameras_have_pictures() {
    let window = Window::open();
    let one = Scene { bodies: [Body::default()].into(), ..Scene::default() };
    let plane =
        Scene { bodies: [Body { shape: Shape::Plane, ..Body::default() }].into(), ..Scene::default() };
    let inside = Camera { position: DVec3::new(0.1, 0.2, 0.0), target: DVec3::X, ..Camera::default() };
    let nowhere = Camera { position: DVec3::ZERO, target: DVec3::ZERO, ..Camera::default() };
    let upright = Camera { up: DVec3::NEG_Z, target: DVec3::ZERO, position: DVec3::Z, ..Camera::default() };
    let far = Camera { position: DVec3::splat(1e12), ..Camera::default() };
    let flat = Camera { projection: Projection::Parallel { height: 0.0 }, ..Camera::default() };
    let wide = Camera { projection: Projection::Perspective { fov_degrees: 180.0 }, ..Camera::default() };
    let mut revision = 0;
    for scene in [Scene::default(), one, plane].map(Arc::new) {
        for camera in [Camera::default(), inside, nowhere, upright, far, flat, wide] {
            revision += 1;
            let asked = Request {
                camera,
                samples: 2,
                outline: vec![0, 7],
                hover: Some(1),
                grid: Some(GridSpec::default()),
                ..Request::new(Arc::clone(&scene), revision, [40, 30])
            };
            let frame = window.shown(asked.clone());
            assert!(*frame.pixels == expected(&asked, 2), "{camera:?}");
        }
    }
}

#[test]
fn an_engine_that_nobody_asks_stops_too() {
    for _ in 0..20 {
        let window = Window::open();
        assert!(window.live.status().is_idle && window.live.latest().is_none());
        window.live.request(request(1));
    }
}
