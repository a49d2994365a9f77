//! A card that is lost, too small, or not there.

use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Waker};
use std::time::Duration;

use catoptric_gpu::{Gpu, GpuChoice, GpuError, GpuFilm, GpuScene, render, wait};
use catoptric_scene::{Body, Color, Material, MaterialChoice, Phong, Scene};
use catoptric_tracer::shaders::UnsupportedOnGpu;
use catoptric_tracer::{RenderControl, RenderSettings};

use crate::common::{card, own_card, reference, stage_of};

const SMALL: RenderSettings = RenderSettings { width: 64, height: 36, samples: 1 };

/// Work for seconds, so that something can happen meanwhile.
const LONG: RenderSettings = RenderSettings { width: 512, height: 288, samples: 1000 };

/// Runs a long render and does `act` once it has begun.
fn disturbed(gpu: &Arc<Gpu>, act: impl FnOnce(&Gpu, &RenderControl) + Send + 'static) -> GpuError {
    let render_scene = stage_of(&reference("whitted"));
    let control = Arc::new(RenderControl::default());
    let (other, watched) = (Arc::clone(gpu), Arc::clone(&control));
    let disturber = std::thread::spawn(move || {
        while watched.pixels_done() == 0 {
            std::thread::sleep(Duration::from_millis(1));
        }
        act(&other, &watched);
    });
    let error = wait(render(gpu, &render_scene, render_scene.camera(), LONG, &control)).unwrap_err();
    disturber.join().unwrap();
    error
}

#[test]
fn a_card_that_is_lost_in_the_middle_is_an_error() {
    let Some(gpu) = own_card("a_card_that_is_lost_in_the_middle_is_an_error") else { return };
    let error = disturbed(&gpu, |gpu, _| gpu.destroy());
    assert!(matches!(error, GpuError::Lost(_)), "{error}");
    // Whatever is asked of it from now on fails in the same way.
    let render_scene = stage_of(&reference("whitted"));
    let again = wait(render(&gpu, &render_scene, render_scene.camera(), SMALL, &RenderControl::default()));
    assert!(matches!(again, Err(GpuError::Lost(_))), "{again:?}");
    assert!(wait(GpuFilm::new(&gpu, 8, 8)).is_err() && wait(GpuScene::new(&gpu)).is_err());
}

#[test]
fn a_device_that_a_window_loses_is_an_error() {
    let Some(gpu) = own_card("a_device_that_a_window_loses_is_an_error") else { return };
    let Some(device) = crate::common::shared_device() else { return };
    drop(gpu);
    let (device, queue) = device;
    let gpu = Arc::new(Gpu::on(device.clone(), queue).unwrap());
    let render_scene = stage_of(&reference("whitted"));
    assert!(
        wait(render(&gpu, &render_scene, render_scene.camera(), SMALL, &RenderControl::default())).is_ok()
    );
    let error = disturbed(&gpu, move |_, _| device.destroy());
    assert!(matches!(error, GpuError::Lost(_)), "{error}");
}

#[test]
fn a_render_can_be_cancelled_and_gone_on_with() {
    let Some(gpu) = card("a_render_can_be_cancelled_and_gone_on_with") else { return };
    assert_eq!(disturbed(&gpu, |_, control| control.cancel()), GpuError::Cancelled);
    let render_scene = stage_of(&reference("mirrors"));
    let camera = render_scene.camera();
    let mut on_card = wait(GpuScene::new(&gpu)).unwrap();
    wait(on_card.follow(&gpu, &render_scene, camera)).unwrap();
    let mut film = wait(GpuFilm::new(&gpu, 200, 100)).unwrap();
    let cancelled = RenderControl::default();
    cancelled.cancel();
    let stopped = wait(film.add_samples(&gpu, (&render_scene, &on_card), camera, 3, &cancelled));
    assert_eq!(stopped, Err(GpuError::Cancelled));
    wait(film.add_samples(&gpu, (&render_scene, &on_card), camera, 3, &RenderControl::default())).unwrap();
    assert_eq!(film.samples(), 3);
    let settings = RenderSettings { width: 200, height: 100, samples: 3 };
    let whole = wait(render(&gpu, &render_scene, camera, settings, &RenderControl::default())).unwrap();
    assert_eq!(wait(film.picture(&gpu)).unwrap(), whole.picture);
}

/// As a page does it: nobody waits, the work is looked at now and then, and may be given up.
#[test]
fn work_that_is_dropped_half_way_can_be_gone_on_with() {
    let Some(gpu) = card("work_that_is_dropped_half_way_can_be_gone_on_with") else { return };
    let render_scene = stage_of(&reference("mirrors"));
    let (camera, control) = (render_scene.camera(), RenderControl::default());
    let mut on_card = wait(GpuScene::new(&gpu)).unwrap();
    wait(on_card.follow(&gpu, &render_scene, camera)).unwrap();
    let mut film = wait(GpuFilm::new(&gpu, 300, 200)).unwrap();
    let mut waited = 0;
    for looks in [1, 2, 5, 50] {
        let mut work = pin!(film.add_samples(&gpu, (&render_scene, &on_card), camera, 4, &control));
        for _ in 0..looks {
            match work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
                Poll::Ready(done) => {
                    done.unwrap();
                    break;
                }
                Poll::Pending => waited += 1,
            }
            std::thread::sleep(Duration::from_millis(1));
        }
    }
    assert!(waited > 0, "it never gave the thread back");
    wait(film.add_samples(&gpu, (&render_scene, &on_card), camera, 2, &control)).unwrap();
    let settings = RenderSettings { width: 300, height: 200, samples: film.samples() };
    let whole = wait(render(&gpu, &render_scene, camera, settings, &control)).unwrap();
    assert_eq!(wait(film.picture(&gpu)).unwrap(), whole.picture);
}

#[test]
fn absurd_sizes_are_errors() {
    let Some(gpu) = card("absurd_sizes_are_errors") else { return };
    assert!(matches!(wait(GpuFilm::new(&gpu, 0, 5)), Err(GpuError::Size(_))));
    assert!(matches!(wait(GpuFilm::new(&gpu, u32::MAX, u32::MAX)), Err(GpuError::Size(_))));
    let error = wait(GpuFilm::new(&gpu, 1 << 14, 1 << 14)).err().unwrap();
    assert!(matches!(error, GpuError::TooLarge { .. } | GpuError::OutOfMemory(_)), "{error}");
    // The card is none the worse for it.
    let render_scene = stage_of(&reference("whitted"));
    assert!(
        wait(render(&gpu, &render_scene, render_scene.camera(), SMALL, &RenderControl::default())).is_ok()
    );
}

#[test]
fn a_card_that_is_not_there_is_an_error() {
    let choice = GpuChoice { software: true, name: Some("no card has this name".to_owned()) };
    let error = wait(Gpu::open(&choice)).err().unwrap();
    assert!(matches!(error, GpuError::NoSuchAdapter { .. } | GpuError::NoAdapter), "{error}");
}

/// Panes between which rays double at every step.
fn panes(generations: u32) -> Scene {
    let pane = Material::Phong(Phong {
        diffuse: 0.0,
        specular: 0.0,
        reflection: Some(0.5),
        transmission: 0.5,
        ior: 1.5,
        ..Phong::default()
    });
    let body = |at: u32| Body {
        shape: catoptric_scene::Shape::Cube { size: glam::DVec3::new(1e3, 1e3, 0.1) },
        placement: catoptric_scene::Placement::at(glam::DVec3::new(0.0, 0.0, -f64::from(at))),
        material: MaterialChoice::Inline(Box::new(pane.clone())),
        ..Body::default()
    };
    let mut scene = Scene { bodies: (0..4).map(body).collect(), ..Scene::default() };
    scene.tracing.generations = generations;
    scene.tracing.threshold = 0.0;
    scene
}

#[test]
fn trees_without_end_are_refused() {
    let Some(gpu) = card("trees_without_end_are_refused") else { return };
    let settings = RenderSettings { width: 2, height: 2, samples: 1 };
    let draw = |generations| {
        let render_scene = stage_of(&panes(generations));
        wait(render(&gpu, &render_scene, render_scene.camera(), settings, &RenderControl::default()))
            .map(|_| ())
    };
    assert_eq!(draw(10), Ok(()));
    // With room for more generations a software driver compiles the shader for a minute.
    assert_eq!(draw(20), Err(GpuError::Unsupported(UnsupportedOnGpu::LongTree)));
}

/// Glass balls one in the other: `count` of them around the origin.
fn onion(count: usize) -> Scene {
    let glass = Material::Phong(Phong {
        pattern: Color { r: 0.0, g: 0.0, b: 0.0 }.into(),
        specular: 0.0,
        reflection: Some(0.0),
        transmission: 1.0,
        ior: 1.1,
        ..Phong::default()
    });
    let skin = |index: usize| Body {
        shape: catoptric_scene::Shape::Sphere { radius: 1.0 + 0.1 * index as f64 },
        material: MaterialChoice::Inline(Box::new(glass.clone())),
        ..Body::default()
    };
    Scene { bodies: (0..count).map(skin).collect(), ..Scene::default() }
}

#[test]
fn more_media_than_there_is_room_for_are_refused() {
    let Some(gpu) = card("more_media_than_there_is_room_for_are_refused") else { return };
    let draw = |scene: &Scene| {
        let mut scene = scene.clone();
        scene.tracing.generations = 20;
        let render_scene = stage_of(&scene);
        wait(render(&gpu, &render_scene, render_scene.camera(), SMALL, &RenderControl::default())).map(|_| ())
    };
    let mut scene = onion(20);
    scene.camera.position = glam::DVec3::new(0.0, 0.0, 9.0);
    scene.camera.target = glam::DVec3::ZERO;
    assert_eq!(draw(&scene), Err(GpuError::Unsupported(UnsupportedOnGpu::NestedMedia)));
    scene.camera.position = glam::DVec3::new(0.0, 0.0, 0.5);
    assert_eq!(draw(&scene), Err(GpuError::Unsupported(UnsupportedOnGpu::EyeMedia(20))));
    let mut fewer = onion(16);
    fewer.camera = scene.camera;
    assert_eq!(draw(&fewer), Ok(()));
}
