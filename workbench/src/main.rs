//! The workbench: chores that trace scenes or measure, started by `cargo xtask COMMAND`.

mod bench;
mod bench_gpu;
mod front_page;
mod gallery;
mod methods;
mod povray;
mod same;
mod scenes;
mod sheet;
mod window;

use clap::{Parser, Subcommand};

/// Chores that trace scenes or measure; `cargo xtask` without a command explains the others.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Debug, Subcommand)]
enum Chore {
    /// Render the built-in scenes into docs/gallery and the README's picture
    Gallery(gallery::GalleryArguments),
    /// Write the front page of the laboratory in a browser, with pictures of the built-in scenes
    FrontPage(front_page::FrontPageArguments),
    /// Draw the documents' pictures of the methods
    Methods,
    /// Write a scene of very many bodies, for measuring
    Cloud(scenes::CloudArguments),
    /// Time the tracer against POV-Ray and other renderers on ten scenes, by turns
    Bench(bench::BenchArguments),
    /// Time the tracer on a graphics card
    BenchGpu(bench_gpu::BenchGpuArguments),
    /// Time how quickly the studio answers, in a real window
    BenchStudio,
    /// Draw the documents' pictures of the studio
    Screenshots(window::ScreenshotArguments),
    /// Compare the pictures of two builds of the program, bit by bit
    Same(same::SameArguments),
}

fn main() -> anyhow::Result<()> {
    match Arguments::parse().chore {
        Chore::Gallery(arguments) => gallery::run(&arguments),
        Chore::FrontPage(arguments) => front_page::run(&arguments),
        Chore::Methods => methods::run(),
        Chore::Cloud(arguments) => scenes::write_cloud(&arguments),
        Chore::Bench(arguments) => bench::run(&arguments),
        Chore::BenchGpu(arguments) => bench_gpu::run(&arguments),
        Chore::BenchStudio => window::bench(),
        Chore::Screenshots(arguments) => window::screenshots(&arguments),
        Chore::Same(arguments) => same::run(&arguments),
    }
}
