//! POV-Ray, the independent program whose pictures and times ours are compared with.

mod source;

use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use xtask::shell::{self, command, exists};

pub(crate) use source::source;

/// A picture to draw: one ray through each pixel's center, linear light.
pub(crate) struct PovrayTask<'a> {
    /// An EXR file.
    pub output: &'a Path,
    pub width: u32,
    pub height: u32,
    pub threads: u32,
}

/// Fails with advice when POV-Ray cannot be started.
pub(crate) fn require() -> Result<()> {
    ensure!(exists("povray", "--version"), "POV-Ray is not installed; on Debian: apt-get install povray");
    Ok(())
}

/// Draws the scene of a `.pov` file; the milliseconds that POV-Ray says it traced.
pub(crate) fn trace(scene: &Path, task: &PovrayTask<'_>) -> Result<f64> {
    // No window (-D), no antialiasing (-A), no chatter of progress (-V), EXR (+FE).
    let arguments = [
        "-V".to_owned(),
        "+FE".to_owned(),
        "-D".to_owned(),
        "-A".to_owned(),
        format!("+I{}", scene.display()),
        format!("+O{}", task.output.display()),
        format!("+W{}", task.width),
        format!("+H{}", task.height),
        format!("+WT{}", task.threads),
    ];
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let text = shell::output_of_both(&mut command("povray", &arguments))?;
    trace_milliseconds(&text).with_context(|| format!("POV-Ray told no trace time:\n{text}"))
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
