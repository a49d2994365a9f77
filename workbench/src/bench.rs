//! Our times against those of POV-Ray and other renderers: the same scenes, in the same run, by turns. The pictures are
//! compared too.

mod case;
mod first_picture;
mod instructions;
mod measure;
mod programs;
mod report;
mod scaling;
mod series;

use anyhow::{Result, bail};
use clap::{Args, ValueEnum};
use xtask::root;
use xtask::shell::{self, command};

use crate::povray;
use case::{CASES, Case};
use programs::OtherRenderer;

#[derive(Debug, Args)]
#[command(after_help = "\
Another renderer is a shell command. In it {scene} stands for the scene file, {pov} for the same scene for POV-Ray, \
{width}, {height} and {threads} for numbers, and {output} for the picture to write (.exr, linear light). It says its \
trace time in milliseconds in a line of its standard output, such as: trace 12.3. A picture that it writes is compared \
with POV-Ray's.

  cargo xtask bench B1 B3 --other 'mine=./mine {scene} {width} {height} {threads} {output}'")]
pub(crate) struct BenchArguments {
    /// Scenes, such as B1 or whitted; without them all ten
    #[arg(value_name = "SCENE", value_parser = case::find)]
    scenes: Vec<&'static Case>,
    /// Numbers of threads
    #[arg(long, value_delimiter = ',', default_values_t = [1, 2])]
    threads: Vec<u32>,
    /// Runs of each program on each scene
    #[arg(long, value_name = "N", default_value_t = 5)]
    runs: usize,
    /// Runs of POV-Ray on each scene, if fewer or more than of the others: it needs a minute to read B8
    #[arg(long, value_name = "N")]
    povray_runs: Option<usize>,
    /// Width of the pictures; the height is 9/16 of it
    #[arg(long, default_value_t = 1280)]
    width: u32,
    /// Another renderer to measure
    #[arg(long = "other", value_name = "NAME=COMMAND")]
    others: Vec<OtherRenderer>,
    /// What to measure; without it everything
    #[arg(long, value_enum, value_delimiter = ',')]
    only: Vec<BenchPart>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum BenchPart {
    /// Trace times and pictures of the scenes
    Scenes,
    /// How much quicker more threads are in one process
    Scaling,
    /// Time from starting the program to the first picture
    FirstPicture,
    /// Instructions for a ray, counted by Valgrind
    Instructions,
}

impl BenchArguments {
    fn size(&self) -> [u32; 2] {
        [self.width, self.width * 9 / 16]
    }

    fn wants(&self, part: BenchPart) -> bool {
        self.only.is_empty() || self.only.contains(&part)
    }
}

pub(crate) fn run(arguments: &BenchArguments) -> Result<()> {
    if arguments.wants(BenchPart::Scenes) {
        povray::require()?;
    }
    shell::run(&mut command("cargo", &["build", "--release", "--quiet"]))?;
    std::fs::create_dir_all(folder())?;
    let cases = if arguments.scenes.is_empty() { CASES.iter().collect() } else { arguments.scenes.clone() };
    let mut faults = Vec::new();
    if arguments.wants(BenchPart::Scenes) {
        let mut results = Vec::new();
        for case in &cases {
            let result = measure::measure(case, arguments)?;
            faults.extend(result.fault());
            results.push(result);
        }
        let others: Vec<&str> = arguments.others.iter().map(|other| other.name.as_str()).collect();
        println!("{}", report::tables(&results, &others, arguments.size()));
    }
    if arguments.wants(BenchPart::Scaling) {
        println!("{}", scaling::measure(&cases, arguments)?);
    }
    if arguments.wants(BenchPart::FirstPicture) {
        println!("{}\n", first_picture::measure(arguments.runs.max(9))?);
    }
    if arguments.wants(BenchPart::Instructions) {
        println!("{}", instructions::count()?);
    }
    if !faults.is_empty() {
        bail!("the pictures differ from POV-Ray's:\n{}", faults.join("\n"));
    }
    Ok(())
}

/// Where scenes and pictures are left.
fn folder() -> std::path::PathBuf {
    root().join("target/bench")
}
