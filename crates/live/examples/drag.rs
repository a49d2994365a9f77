//! Drags one body of a scene with very many as the studio does, without a window, and says what each step costs: the
//! edit, and the way to a prepared scene. At the end the picture is held against that of the scene prepared anew.
//!
//! `cargo xtask cloud` writes such a scene.
//! `cargo run --release -p catoptric-live --example drag -- [FILE] [STEPS]`

#![allow(clippy::print_stdout, reason = "this is a program")]

use std::error::Error;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use catoptric_editor::{Editor, Label};
use catoptric_live::{Live, Request};
use catoptric_picture::Development;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use glam::DVec3;

const SIZE: [u32; 2] = [320, 180];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().map_or_else(|| PathBuf::from("target/cloud.toml"), PathBuf::from);
    let steps: usize = arguments.next().map_or(Ok(60), |text| text.parse())?;
    let scene = catoptric_store::load(&file)?.scene;
    let body = scene.bodies.len() / 2;
    println!("{} bodies", scene.bodies.len());
    let mut editor = Editor::new(scene);
    let item = editor.edited().bodies().nth(body).ok_or("there is no such body")?;
    editor.select(item);
    let live = Live::start(|| ())?;
    println!("opened: {:.1} ms to the stage", ask(&live, &editor));
    let (mut edits, mut render_scenes) = (Vec::new(), Vec::new());
    for step in 0..steps {
        let start = Instant::now();
        let offset = DVec3::new(0.02, 0.01 * step as f64, 0.0);
        editor.change_body(body, Label::new("edit-move", ""), |body| {
            body.placement = body.placement.moved_by(offset);
        })?;
        edits.push(1e3 * start.elapsed().as_secs_f64());
        render_scenes.push(ask(&live, &editor));
        // The worker traces meanwhile, as between two moves of a mouse.
        std::thread::sleep(Duration::from_millis(16));
    }
    print_spread("the edit, ms", &mut edits);
    print_spread("from the request to the stage, ms", &mut render_scenes);
    let start = Instant::now();
    editor.settle();
    println!("the end of the gesture: {:.1} ms", 1e3 * start.elapsed().as_secs_f64());
    check(&live, &editor)
}

fn request(editor: &Editor) -> Request {
    let mut request = Request::new(Arc::clone(editor.scene()), editor.revision(), SIZE);
    request.outline = editor.selected_bodies().collect();
    request.samples = 1;
    request
}

/// Asks for a picture of the document and waits for its scene; milliseconds.
fn ask(live: &Live, editor: &Editor) -> f64 {
    let start = Instant::now();
    live.request(Request { moving: true, ..request(editor) });
    while live.render_scene().is_none_or(|(revision, _)| revision != editor.revision()) {
        std::thread::sleep(Duration::from_micros(200));
    }
    1e3 * start.elapsed().as_secs_f64()
}

/// Whether the last picture is that of the scene as it is now.
fn check(live: &Live, editor: &Editor) -> Result<(), Box<dyn Error>> {
    live.request(request(editor));
    while !live.status().is_idle {
        std::thread::sleep(Duration::from_millis(1));
    }
    let render_scene = RenderScene::build(editor.scene())?;
    let settings = RenderSettings { width: SIZE[0], height: SIZE[1], samples: 1 };
    let picture = render(&render_scene, settings, &RenderControl::default())?.picture;
    let mut codes = vec![[0; 4]; picture.pixels().len()];
    Development::default().develop_rgba8(picture.pixels(), &mut codes);
    let frame = live.latest().ok_or("no frame")?;
    let is_same = frame.is_full() && *frame.pixels == *codes.as_flattened();
    println!("the picture is {} the scene's", if is_same { "that of" } else { "NOT that of" });
    Ok(())
}

fn print_spread(what: &str, values: &mut [f64]) {
    values.sort_by(f64::total_cmp);
    let at =
        |share: f64| values.get((share * (values.len().max(1) - 1) as f64) as usize).copied().unwrap_or(0.0);
    println!("{what}: min {:.2}, median {:.2}, 95 % {:.2}, max {:.2}", at(0.0), at(0.5), at(0.95), at(1.0));
}
