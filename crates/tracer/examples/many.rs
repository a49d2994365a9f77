//! What many bodies cost: preparing a scene of them, one picture, and following edits of one body.
//!
//! `cargo run --release -p catoptric-tracer --example many -- SCENE [RUNS] [THREADS]`, with a scene of more than a dozen
//! bodies, such as `cargo xtask cloud` writes.

#![allow(clippy::print_stdout, reason = "this is a program")]

use std::error::Error;
use std::time::Instant;

use catoptric_scene::Scene;
use catoptric_store::load;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use glam::DVec3;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("which scene?")?;
    let numbers: Vec<usize> = arguments.map(|text| text.parse()).collect::<Result<_, _>>()?;
    let at = |place: usize, otherwise: usize| numbers.get(place).copied().unwrap_or(otherwise);
    let (runs, threads) = (at(0, 5), at(1, 0));
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    let scene = load(&path)?.scene;
    let bodies = scene.bodies.len();
    let mut render_scene = None;
    let prepare = best_of(runs, || render_scene = Some(RenderScene::build(&scene)));
    let render_scene = render_scene.ok_or("no run")??;
    println!(
        "{bodies} bodies: prepared in {prepare:.1} ms, {:.1} bytes a body",
        render_scene.bytes() as f64 / bodies as f64
    );
    let settings = RenderSettings { width: 1280, height: 720, samples: 1 };
    let trace = best_of(runs, || drop(render(&render_scene, settings, &RenderControl::default())));
    println!("traced in {trace:.1} ms");
    follow(scene, render_scene, runs)
}

/// Moves a body back and forth as a hand does, then holds the scene that followed against a new one.
fn follow(mut scene: Scene, mut render_scene: RenderScene, runs: usize) -> Result<(), Box<dyn Error>> {
    let middle = scene.bodies.len() / 2;
    for (what, step) in [("a bit", 1e-3), ("far", 1.0)] {
        let (mut took, mut anew) = (Vec::new(), 0);
        for run in 0..runs.max(4) {
            // Telling what changed is the part of whoever edits.
            let before = scene.clone();
            let offset = DVec3::new(step, step * run as f64, -step);
            let placement = &mut scene.bodies[middle].placement;
            *placement = placement.moved_by(offset);
            let start = Instant::now();
            match render_scene.edit(&before, &scene, &[middle]) {
                Some(edit) => render_scene.apply(edit, &scene),
                None => {
                    render_scene = RenderScene::build(&scene)?;
                    anew += 1;
                }
            }
            took.push(1e3 * start.elapsed().as_secs_f64());
        }
        took.sort_by(f64::total_cmp);
        let (median, most) = (took[took.len() / 2], took[took.len() - 1]);
        println!("moved {what}: median {median:.3} ms, at most {most:.3} ms, {anew} times prepared anew");
    }
    let fresh = RenderScene::build(&scene)?;
    let settings = RenderSettings { width: 640, height: 360, samples: 1 };
    let traced = |render_scene: &RenderScene| {
        let mut picture = None;
        let time = best_of(runs, || picture = render(render_scene, settings, &RenderControl::default()).ok());
        (time, picture.map(|rendering| rendering.picture))
    };
    let ((time, one), (fresh_time, other)) = (traced(&render_scene), traced(&fresh));
    let is_same = one.is_some() && one == other;
    println!("then traced in {time:.1} ms, a new stage in {fresh_time:.1} ms");
    println!("the picture is {} a new stage's", if is_same { "that of" } else { "NOT that of" });
    Ok(())
}

/// The least milliseconds that some work takes.
fn best_of(runs: usize, mut work: impl FnMut()) -> f64 {
    let times = (0..runs).map(|_| {
        let start = Instant::now();
        work();
        1e3 * start.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min)
}
