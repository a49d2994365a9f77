//! Instructions for a ray: a figure that does not depend on what else the machine does.

use anyhow::{Context as _, Result};
use xtask::root;
use xtask::shell::{self, command, exists};

use super::folder;
use super::programs::{RenderStats, program, render_arguments};
use crate::povray::PovrayTask;

/// Samples of a pixel in the two runs whose difference is the tracing alone.
const SAMPLES: [u32; 2] = [1, 4];
const SIZE: (u32, u32) = (160, 90);

/// Counts what the release program does for `whitted` in a small picture with one thread, or says why not.
pub(super) fn count() -> Result<String> {
    if !exists("valgrind", "--version") {
        return Ok("Instructions: skipped, Valgrind is not installed; on Debian: apt-get install valgrind"
            .to_owned());
    }
    let [few, many] = SAMPLES.map(run);
    let ((few, few_rays), (many, many_rays)) = (few?, many?);
    Ok(format!(
        "Instructions (Valgrind, which has no AVX-512) for `whitted`, {}x{}, one thread: {:.0} a ray, from the \
         difference of {} and {} samples; {:.1} million from start to end with one sample, {:.0} rays.",
        SIZE.0,
        SIZE.1,
        (many - few) / (many_rays - few_rays),
        SAMPLES[0],
        SAMPLES[1],
        few / 1e6,
        few_rays
    ))
}

/// Instructions of the whole program, and rays.
fn run(samples: u32) -> Result<(f64, f64)> {
    let scene = root().join("tests/reference/whitted.toml");
    let output = folder().join("instructions.exr");
    let task = PovrayTask { output: &output, width: SIZE.0, height: SIZE.1, threads: 1 };
    let profile = format!("--callgrind-out-file={}", folder().join("callgrind.out").display());
    let mut words = vec!["--tool=callgrind".to_owned(), profile, program()];
    words.extend(render_arguments(&scene, &task));
    words.extend(["--samples".to_owned(), samples.to_string()]);
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let [printed, said] = shell::streams(&mut command("valgrind", &words))?;
    let count = collected(&said).with_context(|| format!("Valgrind told no count:\n{said}"))?;
    Ok((count, RenderStats::from_json(&printed)?.all_rays()))
}

/// From a line like "==123== Collected : 4567".
fn collected(text: &str) -> Option<f64> {
    text.lines().find_map(|line| line.split_once("Collected :")?.1.trim().parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_valgrinds_count() {
        let text =
            "==12== Events    : Ir\n==12== Collected : 71554000\n==12== \n==12== I   refs:      71,554,000\n";
        assert_eq!(collected(text), Some(71_554_000.0));
        assert_eq!(collected("nothing"), None);
    }
}
