//! What a graphics card achieves on scenes of all kinds.

use anyhow::Result;
use catoptric_lab::cloud::cloud;
use catoptric_scene::{Scene, load, save, write};
use clap::Args;

use crate::root;
use crate::scenes::sphereflake;
use crate::shell::{self, command};

#[derive(Debug, Args)]
pub(crate) struct BenchGpuArguments {
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
    /// Bodies of the cloud
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    bodies: usize,
}

/// Writes the scenes and measures them in a program of its own, built for release.
pub(crate) fn run(arguments: &BenchGpuArguments) -> Result<()> {
    let folder = root().join("target/bench");
    std::fs::create_dir_all(&folder)?;
    let whitted = load(root().join("tests/reference/whitted.toml"))?.scene;
    let scenes: [(&str, Scene, &[&str]); 3] = [
        ("whitted", whitted, &["1920x1080", "3840x2160"]),
        ("sphereflake-7381", sphereflake(5), &["1920x1080"]),
        ("cloud", cloud(arguments.bodies), &["1920x1080"]),
    ];
    let mut run = command("cargo", &["run", "--release", "--quiet", "-p", "catoptric-gpu"]);
    run.args(["--example", "throughput", "--", "--frames", &arguments.frames.to_string()]);
    for (name, scene, sizes) in scenes {
        let file = folder.join(format!("{name}.toml"));
        save(&file, &write(&scene))?;
        run.args(sizes.iter().map(|size| format!("{}@{size}", file.display())));
    }
    if let Some(name) = &arguments.gpu {
        run.args(["--gpu", name]);
    }
    if let Some(peak) = arguments.peak {
        run.args(["--peak", &peak.to_string()]);
    }
    if arguments.software_gpu {
        run.arg("--software-gpu");
    }
    shell::run(&mut run)
}
