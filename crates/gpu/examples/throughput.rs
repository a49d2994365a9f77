//! What a graphics card achieves: times of frames by its own clock, rays a second, the share of what it could compute,
//! and whether the picture is that of the CPU. `cargo xtask bench-gpu` makes the scenes and runs it.

use std::error::Error;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use catoptric_gpu::{Gpu, GpuChoice, GpuFilm, GpuPass, GpuScene, wait};
use catoptric_picture::Difference;
use catoptric_scene::{Scene, Shape};
use catoptric_store::load;
use catoptric_tracer::{RayCounts, RenderControl, RenderScene, RenderSettings, render};
use clap::Parser;

#[derive(Debug, Parser)]
struct Arguments {
    /// Scenes and the size of their pictures
    #[arg(value_name = "FILE@WxH", required = true)]
    cases: Vec<String>,
    /// Part of the name of the graphics card
    #[arg(long, value_name = "NAME")]
    gpu: Option<String>,
    /// Let a driver that computes on the processor count as a graphics card
    #[arg(long)]
    software_gpu: bool,
    /// The card's peak for single precision, in 10¹² operations a second, where its name does not tell
    #[arg(long, value_name = "TFLOPS")]
    peak: Option<f64>,
    /// Frames of each scene; the middle one counts
    #[arg(long, value_name = "N", default_value_t = 9)]
    frames: usize,
}

/// Peaks for single precision (fused operations count twice), in 10¹² operations a second, from the makers' data
/// sheets; of cards with alike names the longer comes first.
const PEAKS: [(&str, f64); 14] = [
    ("H200", 66.9),
    ("H100 PCIe", 51.2),
    ("H100", 66.9),
    ("A100", 19.5),
    ("L40S", 91.6),
    ("L4", 30.3),
    ("RTX 5090", 104.8),
    ("RTX 4090", 82.6),
    ("RTX 4070", 29.1),
    ("RTX 3090", 35.6),
    ("RTX 3060", 12.7),
    ("RX 7900 XTX", 61.4),
    ("RX 6800", 16.2),
    ("Arc(TM) A770", 19.7),
];

/// A scene and the size of its picture.
struct Case {
    name: String,
    scene: Scene,
    size: [u32; 2],
}

impl Case {
    fn parse(text: &str) -> Result<Self, Box<dyn Error>> {
        let unclear = || format!("{text}: give a scene file and a size, such as whitted.toml@1920x1080");
        let (file, size) = text.rsplit_once('@').ok_or_else(unclear)?;
        let (width, height) = size.split_once('x').ok_or_else(unclear)?;
        let path = PathBuf::from(file);
        let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        Ok(Self { name, scene: load(&path)?.scene, size: [width.parse()?, height.parse()?] })
    }

    /// Operations that a ray costs at least, if every body is looked at: those of the test against a sphere of its own
    /// (24), of a plane (14), and of the sphere around another shape (21). What is met, and shading, come on top.
    fn least_operations(&self) -> Option<f64> {
        let planes = self.scene.bodies.iter().filter(|body| body.shape == Shape::Plane).count();
        let bodies = self.scene.bodies.iter().filter(|body| !body.hidden).map(|body| match body.shape {
            Shape::Sphere { .. } => 24.0,
            Shape::Plane => 14.0,
            _ => 21.0,
        });
        (self.scene.bodies.len() - planes <= RenderScene::FEW).then(|| bodies.sum())
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let gpu = wait(Gpu::open(&GpuChoice { software: arguments.software_gpu, name: arguments.gpu.clone() }))?;
    let card = gpu.info();
    let peak = arguments.peak.or_else(|| {
        let known = PEAKS.iter().find(|(name, _)| card.name.contains(name));
        known.map(|(_, peak)| *peak)
    });
    let software = if card.is_software { ", a driver without a card" } else { "" };
    println!("{} ({}, {}){software}\n", card.name, card.interface, card.driver);
    println!(
        "| scene | picture | ms a frame | Mray/s | primary | shadow | reflected | refracted | of fp32 peak | pixels like the CPU's |"
    );
    println!(
        "|-------|---------|------------|--------|---------|--------|-----------|-----------|--------------|-----------------------|"
    );
    for case in &arguments.cases {
        let case = Case::parse(case)?;
        let render_scene = RenderScene::build(&case.scene)?;
        let (frame, alike) = measure(&gpu, &render_scene, case.size, arguments.frames.max(1))?;
        println!("{}", row(&case, &frame, alike, peak));
    }
    Ok(())
}

/// The middle frame, and the share of pixels within 1/255 of the CPU's.
fn measure(
    gpu: &Gpu,
    render_scene: &RenderScene,
    [width, height]: [u32; 2],
    frames: usize,
) -> Result<(Frame, f64), Box<dyn Error>> {
    let camera = render_scene.camera();
    let mut on_card = wait(GpuScene::new(gpu))?;
    wait(on_card.follow(gpu, render_scene, camera))?;
    let mut film = wait(GpuFilm::new(gpu, width, height))?;
    let control = RenderControl::default();
    let mut times = Vec::new();
    // The first frames compile the shader and find out how much the card can do at once.
    let first = if gpu.info().is_software { 1 } else { 3 };
    for frame in 0..frames + first {
        film.clear();
        let start = Instant::now();
        let pass = wait(film.add_samples(gpu, (render_scene, &on_card), camera, 1, &control))?;
        if frame >= first {
            times.push(Frame { pass, time: pass.on_card.unwrap_or_else(|| start.elapsed()) });
        }
    }
    times.sort_by_key(|frame| frame.time);
    let middle = times.swap_remove(times.len() / 2);
    let cpu = render(render_scene, RenderSettings { width, height, samples: 1 }, &control)?;
    let difference = Difference::between(&wait(film.picture(gpu))?, &cpu.picture)?;
    Ok((middle, 1.0 - difference.share_above))
}

struct Frame {
    pass: GpuPass,
    time: Duration,
}

fn row(case: &Case, frame: &Frame, alike: f64, peak: Option<f64>) -> String {
    let seconds = frame.time.as_secs_f64();
    let rate = |rays: u64| format!("{:.1}", rays as f64 / seconds / 1e6);
    let RayCounts { primary, shadow, reflected, refracted } = frame.pass.counts;
    let total = frame.pass.counts.total();
    let share = case.least_operations().zip(peak).map(|(operations, peak)| {
        format!("≥ {:.1} %", 100.0 * operations * total as f64 / seconds / (1e12 * peak))
    });
    format!(
        "| {} | {}×{} | {:.2} | {} | {} | {} | {} | {} | {} | {:.3} % |",
        case.name,
        case.size[0],
        case.size[1],
        1e3 * seconds,
        rate(total),
        rate(primary),
        rate(shadow),
        rate(reflected),
        rate(refracted),
        share.unwrap_or_else(|| "–".to_owned()),
        100.0 * alike
    )
}
