//! Project chores: `cargo xtask ci`, and those that `cargo xtask help` lists.

mod bench;
mod bench_gpu;
mod ci;
mod dist;
mod gallery;
#[cfg(test)]
mod layers;
mod methods;
mod packages;
mod povray;
mod same;
mod scenes;
mod sheet;
mod shell;
#[cfg(test)]
mod tidy;
mod window;

use std::path::PathBuf;

use clap::{Parser, Subcommand};

/// Project chores.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Debug, Subcommand)]
enum Chore {
    /// The whole check: format, lints, documentation, dependencies, tests, the README's first command
    Ci,
    /// Render the built-in scenes into docs/gallery and the README's picture
    Gallery(gallery::GalleryArguments),
    /// Draw the documents' pictures of the methods
    Methods,
    /// Write a scene of very many bodies, for measuring
    Cloud(scenes::CloudArguments),
    /// Time the tracer against POV-Ray and other renderers on nine scenes, by turns
    Bench(bench::BenchArguments),
    /// Time the tracer on a graphics card
    BenchGpu(bench_gpu::BenchGpuArguments),
    /// Time how quickly the studio answers, in a real window
    BenchStudio,
    /// Draw the documents' pictures of the studio
    Screenshots(window::ScreenshotArguments),
    /// Compare the pictures of two builds of the program, bit by bit
    Same(same::SameArguments),
    /// Make an archive of the program for Linux
    Dist,
}

fn main() -> anyhow::Result<()> {
    match Arguments::parse().chore {
        Chore::Ci => ci::run(),
        Chore::Gallery(arguments) => gallery::run(&arguments),
        Chore::Methods => methods::run(),
        Chore::Cloud(arguments) => scenes::write_cloud(&arguments),
        Chore::Bench(arguments) => bench::run(&arguments),
        Chore::BenchGpu(arguments) => bench_gpu::run(&arguments),
        Chore::BenchStudio => window::bench(),
        Chore::Screenshots(arguments) => window::screenshots(&arguments),
        Chore::Same(arguments) => same::run(&arguments),
        Chore::Dist => dist::run(),
    }
}

/// The repository's root.
fn root() -> PathBuf {
    let manifest = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    manifest.parent().map_or(manifest.clone(), std::path::Path::to_path_buf)
}
