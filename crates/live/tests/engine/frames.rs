//! The frames themselves: what they show, and in which order they come.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use catoptric_live::Request;

use crate::{Window, endless, expected, four_bodies, from_side, panes, request};

#[test]
fn a_refined_frame_equals_a_render_whatever_the_threads() {
    for threads in [1, 2, 5] {
        let window = Window::on_threads(threads);
        let mut asked = request(7);
        asked.samples = 5;
        asked.camera = from_side(&asked.camera, 40.0);
        let frame = window.shown(asked.clone());
        assert!(frame.is_full());
        assert_eq!((frame.samples, frame.view_size), (5, asked.size));
        assert_eq!(frame.camera, asked.camera);
        assert!(*frame.pixels == expected(&asked, 5), "{threads} threads");
        let status = window.live.status();
        assert_eq!((status.samples_done, status.samples_wanted, status.progress), (5, 5, 1.0));
        assert_eq!((status.backend, status.threads), ("CPU", threads));
        assert!(status.rays_per_second > 0.0 && status.milliseconds > 0.0 && frame.rays.primary > 0);
    }
}

#[test]
fn interrupted_refinement_comes_to_the_same_picture() {
    let window = Window::open();
    let mut asked = request(1);
    asked.samples = 12;
    for round in 0..30 {
        // Outlines that change interrupt passes, but not the picture.
        asked.outline = vec![round % 5];
        window.live.request(asked.clone());
        std::thread::yield_now();
        let _ = window.bell.recv_timeout(Duration::from_millis(u64::try_from(round).unwrap()));
    }
    let frame = window.shown(asked.clone());
    assert_eq!(frame.samples, 12);
    assert!(*frame.pixels == expected(&asked, 12));
}

#[test]
fn frames_never_go_back_under_a_burst_of_requests() {
    let window = Window::open();
    let cameras: Vec<_> = (0..400).map(|k| from_side(&four_bodies().camera, 0.7 * f64::from(k))).collect();
    let (done, newest) = (AtomicBool::new(false), AtomicU64::new(0));
    std::thread::scope(|scope| {
        let watcher = scope.spawn(|| {
            let mut seen = 0;
            let mut before = None;
            while !done.load(Ordering::Relaxed) {
                if let Some(frame) = window.live.latest() {
                    let now = (frame.serial, frame.picture_serial, frame.revision);
                    if let Some((serial, picture, revision)) = before {
                        assert!(
                            now.0 >= serial && now.1 >= picture && now.2 >= revision,
                            "{before:?}, {now:?}"
                        );
                        assert!(now.0 > serial || now == (serial, picture, revision));
                    }
                    assert_eq!(frame.camera, cameras[usize::try_from(frame.revision).unwrap()]);
                    seen += u32::from(before != Some(now));
                    before = Some(now);
                    newest.store(frame.revision, Ordering::Relaxed);
                }
                std::thread::yield_now();
            }
            seen
        });
        let mut last = request(0);
        for (revision, camera) in (0..).zip(&cameras) {
            last = Request { camera: *camera, moving: true, ..request(revision) };
            window.live.request(last.clone());
            if revision % 3 == 0 {
                // However busy the machine is, the watcher follows.
                window.until(|_| newest.load(Ordering::Relaxed) + 30 > revision);
            }
        }
        window.live.request(Request { moving: false, ..last.clone() });
        window.until(|live| live.status().is_idle);
        done.store(true, Ordering::Relaxed);
        assert!(watcher.join().unwrap() >= 10);
        let frame = window.live.latest().unwrap();
        assert_eq!((frame.revision, frame.samples), (399, 3));
        assert!(*frame.pixels == expected(&last, 3));
    });
}

#[test]
fn a_drag_that_never_rests_is_not_starved() {
    for (scene, size) in [(four_bodies(), [160, 90]), (panes(11), [640, 360])] {
        let window = Window::open();
        let asked = Request { moving: true, ..Request::new(scene, 0, size) };
        let start = Instant::now();
        // Each request comes as the one before is being worked on.
        for revision in 0_u32.. {
            let camera = from_side(&asked.camera, 0.01 * f64::from(revision % 1000));
            window.live.request(Request { camera, revision: u64::from(revision), ..asked.clone() });
            if window.live.latest().is_some_and(|frame| frame.serial > 5) {
                break;
            }
            assert!(start.elapsed() < Duration::from_secs(60), "{:?}", window.live.status());
            std::thread::sleep(Duration::from_millis(3));
        }
    }
}

#[test]
fn a_newer_request_ends_an_endless_picture_and_so_does_dropping() {
    let window = Window::open();
    window.live.request(Request::new(endless(), 1, [64, 64]));
    window.until(|live| live.render_scene().is_some_and(|(revision, _)| revision == 1));
    let frame = window.shown(request(2));
    assert!(frame.is_full());
    window.live.request(Request::new(endless(), 3, [64, 64]));
    window.until(|live| live.render_scene().is_some_and(|(revision, _)| revision == 3));
    drop(window);
}

#[test]
fn a_held_hand_lets_the_picture_sharpen() {
    let window = Window::open();
    let asked = Request { moving: true, ..request(5) };
    let frame = window.shown(asked.clone());
    assert!(*frame.pixels == expected(&asked, 3));
}
