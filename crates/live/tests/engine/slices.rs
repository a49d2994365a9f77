//! A worker without a thread of its own, as in a browser that gives no threads.

use std::time::{Duration, Instant};

use catoptric_live::{Live, LiveOptions};

use crate::{expected, four_bodies, from_side, request};

fn live() -> Live {
    Live::with_options(LiveOptions { own_thread: false, threads: 1, ..LiveOptions::default() }, || {})
        .unwrap()
}

/// Gives the worker slices until it rests; returns their number.
fn settle(live: &Live) -> u32 {
    let (start, mut slices) = (Instant::now(), 0);
    while !live.status().is_idle {
        assert!(start.elapsed() < Duration::from_secs(60), "{:?}", live.status());
        slices += 1;
        // A tile and no more.
        live.advance(Instant::now());
    }
    slices
}

#[test]
fn slices_come_to_the_picture_of_a_thread() {
    let live = live();
    let mut asked = request(3);
    asked.size = [320, 180];
    asked.outline = vec![1];
    live.request(asked.clone());
    assert!(live.latest().is_none(), "nothing is done before a slice");
    assert!(settle(&live) > 20);
    let frame = live.latest().unwrap();
    assert_eq!((frame.samples, frame.revision, live.status().error), (3, 3, None));
    assert!(frame.is_full() && !frame.outline.is_empty() && *frame.pixels == expected(&asked, 3));
    assert!(frame.rays.primary >= u64::from(320 * 180_u32), "{:?}", frame.rays);
    live.advance(Instant::now() + Duration::from_secs(60));
    assert_eq!(live.latest().unwrap().serial, frame.serial, "a worker at rest does nothing");
}

#[test]
fn pictures_come_while_requests_come_in_every_slice() {
    let live = live();
    let (mut serial, mut pictures, mut step) = (0, 0, 0_u32);
    // A busy machine gets little done in a slice.
    while pictures <= 10 {
        assert!(step < 20_000, "{pictures} pictures");
        let mut asked = request(u64::from(step));
        asked.moving = true;
        asked.camera = from_side(&four_bodies().camera, f64::from(step));
        live.request(asked);
        live.advance(Instant::now() + Duration::from_millis(1));
        if let Some(frame) = live.latest().filter(|frame| frame.picture_serial != serial) {
            (serial, pictures) = (frame.picture_serial, pictures + 1);
        }
        step += 1;
    }
    settle(&live);
    assert_eq!(live.latest().unwrap().revision, u64::from(step) - 1);
}
