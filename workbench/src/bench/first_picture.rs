//! How long a person waits for the first picture.

use std::time::Instant;

use anyhow::Result;
use xtask::root;
use xtask::shell::{self, command};

use super::folder;
use super::programs::program;
use super::series::TimeSeries;

/// Runs the program from its start to the PNG file of `whitted` at 1280×720 with two threads.
pub(super) fn measure(runs: usize) -> Result<String> {
    let scene = root().join("tests/reference/whitted.toml").display().to_string();
    let output = folder().join("first-picture.png").display().to_string();
    let words = ["render", &scene, "-o", &output, "--size", "1280x720", "--threads", "2", "--quiet"];
    let mut series = TimeSeries::default();
    for _ in 0..runs {
        let start = Instant::now();
        shell::run(&mut command(&program(), &words))?;
        series.push(start.elapsed().as_secs_f64() * 1e3);
    }
    Ok(format!(
        "First picture of `whitted`, 1280x720, two threads, from starting the program to the written PNG, ms: \
         median {:.0} of {runs} runs, best {:.0}, worst {:.0}.",
        series.median(),
        series.best(),
        series.worst()
    ))
}
