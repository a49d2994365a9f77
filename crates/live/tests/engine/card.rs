//! A graphics card in place of the processor: by Mesa's lavapipe, where there is no card.

use std::io::Write as _;
use std::sync::Arc;
use std::thread::sleep;
use std::time::{Duration, Instant};

use catoptric_gpu::{Gpu, GpuChoice, GpuError, wait};
use catoptric_live::{Frame, Live, LiveOptions, Request};
use catoptric_picture::Development;
use catoptric_scene::Color;

use crate::{Window, expected, four_bodies, from_side, panes, request};

fn card(test: &str) -> Option<Arc<Gpu>> {
    match wait(Gpu::open(&GpuChoice { software: true, name: None })) {
        Ok(gpu) => Some(Arc::new(gpu)),
        Err(error) => {
            let _ = writeln!(std::io::stderr().lock(), "SKIPPED: {test}: {error}");
            None
        }
    }
}

/// The share of codes that differ by more than the rounding of a code.
fn off(found: &[u8], expected: &[u8]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let off = found.iter().zip(expected).filter(|(one, other)| one.abs_diff(**other) > 1).count();
    off as f64 / expected.len() as f64
}

#[test]
fn a_card_draws_and_hands_over_to_the_processor_and_back() {
    let Some(gpu) = card("a_card_draws_and_hands_over_to_the_processor_and_back") else { return };
    let window = Window::open();
    let asked = request(1);
    let exact = window.shown(asked.clone());
    assert!(exact.card.is_none() && *exact.pixels == expected(&asked, 3));
    window.live.draw_with(Some(gpu.into()));
    window.until(|live| {
        live.status().is_idle && live.latest().is_some_and(|frame| frame.card.is_some() && frame.samples == 3)
    });
    let status = window.live.status();
    assert_eq!((status.backend, status.card.is_some(), status.card_lost), ("GPU", true, None));
    let frame = window.live.latest().unwrap();
    assert!(frame.pixels.is_empty() && frame.is_full());
    assert!(off(&frame.codes().unwrap(), &expected(&asked, 3)) < 0.001);
    assert_eq!(frame.rays.primary, 160 * 90);
    // Another development needs no new light, another scene does.
    let development = Development { exposure_stops: 1.0, ..Development::default() };
    let brighter = Request { development, ..request(2) };
    let frame = window.shown(brighter.clone());
    assert!(off(&frame.codes().unwrap(), &expected(&brighter, 3)) < 0.001);
    let mut scene = (*asked.scene).clone();
    scene.environment.background = Color::new(1.0, 0.0, 0.0);
    let other = Request { scene: Arc::new(scene), ..request(3) };
    let frame = window.shown(other.clone());
    assert!(frame.card.is_some() && off(&frame.codes().unwrap(), &expected(&other, 3)) < 0.001);
    window.live.draw_with(None);
    window.until(|live| live.status().is_idle && live.latest().is_some_and(|frame| frame.card.is_none()));
    assert!(*window.live.latest().unwrap().pixels == expected(&other, 3));
    assert_eq!(window.live.status().backend, "CPU");
}

#[test]
fn the_processor_takes_over_from_a_card_that_is_lost() {
    let Some(gpu) = card("the_processor_takes_over_from_a_card_that_is_lost") else { return };
    let window = Window::open();
    window.live.draw_with(Some(Arc::clone(&gpu).into()));
    window.live.request(Request { samples: 100_000, ..request(1) });
    window.until(|live| live.latest().is_some_and(|frame| frame.card.is_some()));
    gpu.destroy();
    window.until(|live| live.status().card_lost.is_some());
    assert!(matches!(window.live.status().card_lost, Some(GpuError::Lost(_))));
    let asked = request(2);
    let frame = window.shown(asked.clone());
    assert!(frame.card.is_none() && *frame.pixels == expected(&asked, 3));
    // The same card cannot be had back.
    window.live.draw_with(Some(gpu.into()));
    window.until(|live| live.status().is_idle);
    assert!(window.live.status().card_lost.is_some());
    assert_eq!(window.live.status().backend, "CPU");
}

#[test]
fn the_processor_draws_what_a_card_cannot() {
    let Some(gpu) = card("the_processor_draws_what_a_card_cannot") else { return };
    let window = Window::open();
    window.live.draw_with(Some(gpu.into()));
    let mut scene = (*panes(40)).clone();
    scene.tracing.threshold = 0.0;
    window.live.request(Request::new(Arc::new(scene), 1, [2, 2]));
    window.until(|live| live.status().card_refuses.is_some());
    let asked = request(2);
    window.live.request(asked.clone());
    window.until(|live| {
        let is_drawn = |frame: Arc<Frame>| frame.revision == 2 && frame.card.is_some();
        live.status().is_idle && live.latest().is_some_and(is_drawn)
    });
    assert_eq!((window.live.status().card_refuses, window.live.status().card_lost), (None, None));
}

/// Gives a worker without a thread slices until it has come to what is wanted.
fn sliced(live: &Live, wanted: impl Fn(&Frame) -> bool) -> Arc<Frame> {
    let start = Instant::now();
    loop {
        if let Some(frame) = live.latest().filter(|frame| live.status().is_idle && wanted(frame)) {
            return frame;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "{:?}", live.status());
        live.advance(Instant::now() + Duration::from_millis(5));
        sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_card_draws_between_the_slices_of_a_worker_without_a_thread() {
    let Some(gpu) = card("a_card_draws_between_the_slices_of_a_worker_without_a_thread") else { return };
    let options = LiveOptions { own_thread: false, threads: 1, ..LiveOptions::default() };
    let live = Live::with_options(options, || {}).unwrap();
    live.draw_with(Some(Arc::clone(&gpu).into()));
    let asked = request(1);
    live.request(asked.clone());
    let frame = sliced(&live, |frame| frame.card.is_some());
    assert_eq!((frame.samples, frame.rays.primary, live.status().error), (3, 160 * 90, None));
    assert!(off(&frame.codes().unwrap(), &expected(&asked, 3)) < 0.001);
    // Whatever the card is at, what is asked for last is drawn last.
    for step in 2..60 {
        let mut moving = request(step);
        moving.moving = true;
        moving.camera = from_side(&four_bodies().camera, step as f64);
        if step % 7 == 0 {
            moving.development.exposure_stops = 0.5;
        }
        live.request(moving);
        live.advance(Instant::now());
        sleep(Duration::from_millis(step % 3));
    }
    let development = Development { exposure_stops: 1.0, ..Development::default() };
    let last = Request { camera: from_side(&four_bodies().camera, 9.0), development, ..request(60) };
    live.request(last.clone());
    // Another camera may need another shader, which is compiled first.
    let frame = sliced(&live, |frame| frame.revision == 60 && frame.card.is_some());
    assert!(frame.is_full() && frame.samples == 3);
    assert!(off(&frame.codes().unwrap(), &expected(&last, 3)) < 0.001);
    // A window asks in every frame, for the same or for something else.
    for (revision, angle, wanted) in [(100, 0.0, 2), (200, 1.0, 5)] {
        let (mut serial, mut pictures, mut step) = (live.latest().unwrap().picture_serial, 0, 0_u32);
        while pictures < wanted {
            assert!(step < 20_000, "{revision}: {pictures} pictures, {:?}", live.status());
            let mut asked = request(revision);
            asked.moving = true;
            asked.camera = from_side(&four_bodies().camera, 5.0 + angle * f64::from(step));
            live.request(asked);
            live.advance(Instant::now() + Duration::from_millis(1));
            sleep(Duration::from_millis(1));
            let is_new = |frame: &Arc<Frame>| frame.card.is_some() && frame.picture_serial != serial;
            if let Some(frame) = live.latest().filter(is_new) {
                (serial, pictures) = (frame.picture_serial, pictures + 1);
            }
            step += 1;
        }
    }
    gpu.destroy();
    let again = request(261);
    live.request(again.clone());
    let frame = sliced(&live, |frame| frame.revision == 261 && frame.card.is_none());
    assert!(live.status().card_lost.is_some());
    assert!(*frame.pixels == expected(&again, 3));
}
