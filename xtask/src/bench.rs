//! Our trace time against POV-Ray's: the same scenes, the same run, by turns, the pictures held against each other.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail, ensure};
use catoptric_picture::{Difference, read};
use clap::Args;

use crate::root;
use crate::shell::{self, command, exists};

#[derive(Debug, Args)]
pub(crate) struct BenchArguments {
    /// Reference scenes that have a .pov file beside them
    #[arg(default_values_t = ["whitted", "four-bodies", "mirrors", "corridor"].map(str::to_owned))]
    scenes: Vec<String>,
    /// Numbers of threads
    #[arg(long, value_delimiter = ',', default_values_t = [1, 2])]
    threads: Vec<u32>,
    /// Runs of each program on each scene
    #[arg(long, default_value_t = 5)]
    runs: usize,
    /// Width of the picture; the height is 9/16 of it
    #[arg(long, default_value_t = 1280)]
    width: u32,
}

/// Trace times of one scene, milliseconds.
#[derive(Default)]
struct Times {
    ours: Vec<f64>,
    povray: Vec<f64>,
    mrays_per_second: f64,
}

pub(crate) fn run(arguments: &BenchArguments) -> Result<()> {
    ensure!(exists("povray", "--version"), "POV-Ray is not installed; on Debian: apt-get install povray");
    shell::run(&mut command("cargo", &["build", "--release", "--quiet"]))?;
    let folder = root().join("target/bench");
    std::fs::create_dir_all(&folder)?;
    let bench = Bench { folder, width: arguments.width, height: arguments.width * 9 / 16 };
    println!(
        "Trace times in ms at {}x{}, best of {} runs by turns (median in brackets); ratio of the best times.\n",
        bench.width, bench.height, arguments.runs
    );
    println!("| scene | threads | POV-Ray | Catoptric | ratio | Mray/s |");
    println!("|---|---|---|---|---|---|");
    for scene in &arguments.scenes {
        for &threads in &arguments.threads {
            let mut times = Times::default();
            for _ in 0..arguments.runs.max(1) {
                times.povray.push(bench.povray(scene, threads)?);
                let (ours, mrays_per_second) = bench.catoptric(scene, threads)?;
                times.ours.push(ours);
                times.mrays_per_second = times.mrays_per_second.max(mrays_per_second);
            }
            bench.check(scene)?;
            println!("{}", times.row(scene, threads));
        }
    }
    Ok(())
}

impl Times {
    fn row(&mut self, scene: &str, threads: u32) -> String {
        let [povray, ours] = [&mut self.povray, &mut self.ours].map(|times| {
            times.sort_by(f64::total_cmp);
            (times[0], times[times.len() / 2])
        });
        format!(
            "| {scene} | {threads} | {:.0} ({:.0}) | {:.1} ({:.1}) | {:.2} | {:.1} |",
            povray.0,
            povray.1,
            ours.0,
            ours.1,
            povray.0 / ours.0,
            self.mrays_per_second
        )
    }
}

struct Bench {
    folder: PathBuf,
    width: u32,
    height: u32,
}

impl Bench {
    fn reference(scene: &str, extension: &str) -> PathBuf {
        root().join("tests/reference").join(format!("{scene}.{extension}"))
    }

    fn file(&self, name: &str) -> String {
        self.folder.join(name).to_string_lossy().into_owned()
    }

    /// Milliseconds that POV-Ray says it traced; its picture is left in the folder.
    fn povray(&self, scene: &str, threads: u32) -> Result<f64> {
        let mut arguments = vec!["-V".to_owned(), "+FE".to_owned(), "-D".to_owned(), "-A".to_owned()];
        arguments.push(format!("+I{}", Self::reference(scene, "pov").display()));
        arguments.push(format!("+O{}", self.file("povray.exr")));
        arguments.push(format!("+W{}", self.width));
        arguments.push(format!("+H{}", self.height));
        arguments.push(format!("+WT{threads}"));
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let text = shell::output_of_both(&mut command("povray", &arguments))?;
        trace_milliseconds(&text).with_context(|| format!("POV-Ray told no trace time:\n{text}"))
    }

    /// Our trace milliseconds and millions of rays a second; our picture is left in the folder.
    fn catoptric(&self, scene: &str, threads: u32) -> Result<(f64, f64)> {
        let program = root().join("target/release/catoptric");
        let reference = Self::reference(scene, "toml");
        let text = shell::output(&mut command(
            &program.to_string_lossy(),
            &[
                "render",
                &reference.to_string_lossy(),
                "-o",
                &self.file("catoptric.exr"),
                "--size",
                &format!("{}x{}", self.width, self.height),
                "--threads",
                &threads.to_string(),
                "--quiet",
                "--stats",
                "-",
            ],
        ))?;
        let stats: serde_json::Value = serde_json::from_str(&text).context("the statistics")?;
        let number = |value: &serde_json::Value| value.as_f64().context("a number in the statistics");
        Ok((number(&stats["milliseconds"]["trace"])?, number(&stats["mrays_per_second"])?))
    }

    /// Fails unless the two pictures are the same within the reference tests' bound.
    fn check(&self, scene: &str) -> Result<()> {
        let read = |name: &str| read(Path::new(&self.file(name)));
        let difference = Difference::between(&read("catoptric.exr")?, &read("povray.exr")?)?;
        if difference.share_above > 0.001 {
            bail!("{scene}: {} pixels differ from POV-Ray's", difference.above);
        }
        Ok(())
    }
}

/// From a line like "Trace Time: 0 hours 0 minutes 1 seconds (1.234 seconds)".
fn trace_milliseconds(text: &str) -> Option<f64> {
    let line = text.lines().find(|line| line.trim_start().starts_with("Trace Time"))?;
    let seconds: f64 = line.split_once('(')?.1.split_whitespace().next()?.parse().ok()?;
    Some(seconds * 1e3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_povrays_trace_time() {
        let text = "  Parse Time:  0 hours  0 minutes  0 seconds (0.001 seconds)\n\
                    \x20 Trace Time:  0 hours  1 minutes  5 seconds (65.816 seconds)\n";
        assert_eq!(trace_milliseconds(text), Some(65816.0));
        assert_eq!(trace_milliseconds("nothing"), None);
    }
}
