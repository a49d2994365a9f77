//! What a graphics card achieves on scenes of all kinds.

use anyhow::Result;
use catoptric_lab::cloud::cloud;
use catoptric_scene::{Scene, write};
use catoptric_store::{load, save};
use clap::Args;
use xtask::root;
use xtask::shell::{self, command};

use crate::scenes::sphereflake;

#[derive(Debug, Args)]
pub(crate) struct BenchGpuArguments {
    /// Bodies of the cloud
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    bodies: usize,
    /// What else the measuring program is told: `-- --help` lists it
    #[arg(last = true)]
    others: Vec<String>,
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
    run.args(["--example", "throughput", "--"]).args(&arguments.others);
    for (name, scene, sizes) in scenes {
        let file = folder.join(format!("{name}.toml"));
        save(&file, &write(&scene))?;
        run.args(sizes.iter().map(|size| format!("{}@{size}", file.display())));
    }
    shell::run(&mut run)
}
