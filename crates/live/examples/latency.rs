//! Replays an orbit at 60 requests a second, without a window, and says how many frames come and how late.
//! A thread that works for half of every sixtieth of a second stands for a window drawn by software; how long it takes
//! for that says what a person would feel.
//!
//! `cargo run --release -p catoptric-live --example latency -- [SCENE] [WIDTHxHEIGHT] [SECONDS]`

#![allow(clippy::print_stdout, reason = "this is a program")]

use std::error::Error;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use catoptric_live::{GridSpec, Live, RenderJob, Request};
use catoptric_scene::{Camera, Example, Scene};
use catoptric_tracer::RenderSettings;
use glam::{DQuat, DVec3};

/// When each request was made, by its number, and when its frame came.
#[derive(Default)]
struct LatencyLog {
    asked: Vec<Instant>,
    frames: Vec<SeenFrame>,
}

struct SeenFrame {
    revision: u64,
    at: Instant,
    width: u32,
    milliseconds: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_else(|| "four-bodies".to_owned());
    let size = arguments.next().unwrap_or_else(|| "1280x720".to_owned());
    let seconds: f64 = arguments.next().map_or(Ok(5.0), |text| text.parse())?;
    let (width, height) = size.split_once('x').ok_or("a size is WIDTHxHEIGHT")?;
    let size = [width.parse()?, height.parse()?];
    let scene = Example::find(&name).ok_or("no such example")?.load()?.scene;

    let bell = Arc::new((Mutex::new(false), std::sync::Condvar::new()));
    let ring = Arc::clone(&bell);
    let live = Live::start(move || {
        *ring.0.lock().unwrap_or_else(PoisonError::into_inner) = true;
        ring.1.notify_all();
    })?;
    let stop = Arc::new(AtomicBool::new(false));
    let stopped = Arc::clone(&stop);
    let window = std::thread::spawn(move || window(Duration::from_millis(8), &stopped));
    let mut log = LatencyLog::default();
    let start = Instant::now();
    let mut base = Request::new(Arc::new(scene), 0, size);
    base.grid = Some(GridSpec::default());
    base.outline = vec![1];
    let steps = (60.0 * seconds) as u64;
    for step in 0..steps {
        let due = start + Duration::from_secs_f64(step as f64 / 60.0);
        watch(&live, &bell, due, &mut log);
        log.asked.push(Instant::now());
        let camera = orbit(&base.camera, 0.5 * step as f64);
        live.request(Request { revision: step, camera, moving: true, ..base.clone() });
    }
    let released = Instant::now();
    live.request(Request {
        revision: steps,
        camera: orbit(&base.camera, 0.5 * steps as f64),
        ..base.clone()
    });
    log.asked.push(released);
    report(&log, released - start);
    let mut first_full = None;
    while live.status().samples_done < Request::DEFAULT_SAMPLES {
        watch(&live, &bell, Instant::now() + Duration::from_millis(5), &mut log);
        if live.latest().is_some_and(|frame| frame.is_full() && frame.revision == steps) {
            first_full.get_or_insert_with(|| released.elapsed());
        }
        if released.elapsed() > Duration::from_secs(120) {
            break;
        }
    }
    println!(
        "released: full picture after {:.0} ms, {} samples after {:.0} ms",
        1e3 * first_full.unwrap_or_default().as_secs_f64(),
        live.status().samples_done,
        1e3 * released.elapsed().as_secs_f64()
    );
    println!("{:?}", live.status());
    stop.store(true, Ordering::Relaxed);
    let mut took = window.join().map_err(|_| "the window panicked")?;
    print_spread("window at work for 8 ms, ms", &mut took);
    overlays(&live, &bell, &base);
    drop(live);
    beside_a_render(&base.scene)
}

/// How long outlines and grid take by themselves, the way to the worker and back included.
fn overlays(live: &Live, bell: &(Mutex<bool>, std::sync::Condvar), base: &Request) {
    let still = Request { outline: Vec::new(), grid: None, paused: true, ..base.clone() };
    // Every request has a number of its own, so that a frame comes of each.
    let mut revision = 1 << 32;
    let mut wait = |request: Request| {
        revision += 1;
        let request = Request { revision, ..request };
        let start = Instant::now();
        live.request(request);
        while !live.status().is_idle || live.latest().is_none_or(|frame| frame.revision != revision) {
            watch(live, bell, Instant::now() + Duration::from_micros(100), &mut LatencyLog::default());
        }
        1e3 * start.elapsed().as_secs_f64()
    };
    wait(still.clone());
    for (what, outline, grid) in [
        ("outline of a body, ms", vec![1], None),
        ("outlines of all bodies, ms", (0..base.scene.bodies.len()).collect(), None),
        ("grid, ms", Vec::new(), Some(GridSpec::default())),
    ] {
        let mut took: Vec<f64> = (0..30)
            .map(|_| {
                wait(still.clone());
                wait(Request { outline: outline.clone(), grid, ..still.clone() })
            })
            .collect();
        print_spread(what, &mut took);
    }
}

/// How the window fares while a large picture is rendered.
fn beside_a_render(scene: &Arc<Scene>) -> Result<(), Box<dyn Error>> {
    let stop = Arc::new(AtomicBool::new(false));
    let stopped = Arc::clone(&stop);
    let window = std::thread::spawn(move || window(Duration::from_millis(8), &stopped));
    let settings = RenderSettings { width: 3840, height: 2160, samples: 4 };
    let job = RenderJob::start(Arc::clone(scene), settings, None, 0)?;
    std::thread::sleep(Duration::from_secs(3));
    println!("4K render: {:?}", job.progress());
    drop(job);
    stop.store(true, Ordering::Relaxed);
    let mut took = window.join().map_err(|_| "the window panicked")?;
    print_spread("window beside the render, ms", &mut took);
    Ok(())
}

fn orbit(camera: &Camera, degrees: f64) -> Camera {
    let turn = DQuat::from_axis_angle(DVec3::Y, degrees.to_radians());
    Camera { position: camera.target + turn * (camera.position - camera.target), ..*camera }
}

/// Works for `busy` in every sixtieth of a second, as a window drawn by software does, until it is to stop. Returns
/// what each of them took, milliseconds.
fn window(busy: Duration, stop: &AtomicBool) -> Vec<f64> {
    let mut took = Vec::new();
    while !stop.load(Ordering::Relaxed) {
        let start = Instant::now();
        // Steps of some microseconds, so that the work is the same however long it takes.
        for _ in 0..busy.as_micros() / 10 {
            let step = Instant::now();
            while step.elapsed() < Duration::from_micros(10) {
                std::hint::spin_loop();
            }
        }
        took.push(1e3 * start.elapsed().as_secs_f64());
        std::thread::sleep(Duration::from_secs_f64(1.0 / 60.0).saturating_sub(start.elapsed()));
    }
    took
}

/// Takes note of frames until a moment.
fn watch(live: &Live, bell: &(Mutex<bool>, std::sync::Condvar), until: Instant, log: &mut LatencyLog) {
    loop {
        if let Some(frame) = live.latest()
            && log.frames.last().is_none_or(|last| frame.revision > last.revision)
        {
            let (width, milliseconds) = (frame.picture_size[0], frame.milliseconds);
            log.frames.push(SeenFrame { revision: frame.revision, at: Instant::now(), width, milliseconds });
        }
        let left = until.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return;
        }
        let rung = bell.0.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = bell.1.wait_timeout_while(rung, left, |rung| !*rung);
        *waited.unwrap_or_else(PoisonError::into_inner).0 = false;
    }
}

fn report(log: &LatencyLog, time: Duration) {
    let mut latencies: Vec<f64> = log
        .frames
        .iter()
        .filter_map(|frame| Some(1e3 * (frame.at - *log.asked.get(frame.revision as usize)?).as_secs_f64()))
        .collect();
    println!("{} frames, {:.1} a second", latencies.len(), latencies.len() as f64 / time.as_secs_f64());
    print_spread("latency, ms", &mut latencies);
    print_spread("pass, ms", &mut log.frames.iter().map(|frame| frame.milliseconds).collect::<Vec<_>>());
    print_spread("width", &mut log.frames.iter().map(|frame| f64::from(frame.width)).collect::<Vec<_>>());
}

fn print_spread(what: &str, values: &mut [f64]) {
    values.sort_by(f64::total_cmp);
    let at =
        |share: f64| values.get((share * (values.len().max(1) - 1) as f64) as usize).copied().unwrap_or(0.0);
    println!("{what}: min {:.1}, median {:.1}, 95 % {:.1}, max {:.1}", at(0.0), at(0.5), at(0.95), at(1.0));
}
