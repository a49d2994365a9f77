//! Our program and other renderers, and what they say of their work.

use std::path::Path;
use std::str::FromStr;

use anyhow::{Context as _, Result};
use serde_json::Value;
use xtask::root;
use xtask::shell::{self, command};

use super::case::CaseFiles;
use crate::povray::PovrayTask;

/// What our program says of a render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RenderStats {
    pub prepare: f64,
    pub trace: f64,
    /// Primary, shadow, reflected, refracted.
    pub rays: [f64; 4],
    pub stage_bytes: f64,
}

impl RenderStats {
    pub(super) fn from_json(text: &str) -> Result<Self> {
        let stats: Value = serde_json::from_str(text).context("the statistics")?;
        let number = |path: &str| {
            stats
                .pointer(path)
                .and_then(Value::as_f64)
                .with_context(|| format!("no {path} in the statistics"))
        };
        Ok(Self {
            prepare: number("/milliseconds/prepare")?,
            trace: number("/milliseconds/trace")?,
            rays: [
                number("/rays/primary")?,
                number("/rays/shadow")?,
                number("/rays/reflected")?,
                number("/rays/refracted")?,
            ],
            stage_bytes: number("/stage_bytes")?,
        })
    }

    pub(super) fn all_rays(&self) -> f64 {
        self.rays.iter().sum()
    }
}

/// Our program, built for release.
pub(super) fn program() -> String {
    root().join("target/release/catoptric").to_string_lossy().into_owned()
}

/// The arguments with which our program draws a picture and tells its statistics.
pub(super) fn render_arguments(scene: &Path, task: &PovrayTask<'_>) -> Vec<String> {
    let PovrayTask { output, width, height, threads } = task;
    let [scene, output] = [scene, output].map(|path| path.display().to_string());
    let size = format!("{width}x{height}");
    let threads = threads.to_string();
    let words = ["render", &scene, "-o", &output, "--size", &size, "--threads", &threads];
    words.into_iter().chain(["--quiet", "--stats", "-"]).map(str::to_owned).collect()
}

pub(super) fn catoptric(scene: &Path, task: &PovrayTask<'_>) -> Result<RenderStats> {
    let arguments = render_arguments(scene, task);
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    RenderStats::from_json(&shell::output(&mut command(&program(), &arguments))?)
}

/// Another renderer, as a shell command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct OtherRenderer {
    pub name: String,
    template: String,
}

impl FromStr for OtherRenderer {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once('=') {
            Some((name, template)) if !name.is_empty() && !template.is_empty() => {
                Ok(Self { name: name.to_owned(), template: template.to_owned() })
            }
            _ => Err("give a name and a command, such as mine='./mine {scene} {output}'".to_owned()),
        }
    }
}

impl OtherRenderer {
    fn command_line(&self, files: &CaseFiles, task: &PovrayTask<'_>) -> String {
        let quoted = |path: &Path| format!("'{}'", path.to_string_lossy().replace('\'', r"'\''"));
        self.template
            .replace("{scene}", &quoted(&files.scene))
            .replace("{pov}", &quoted(&files.pov))
            .replace("{output}", &quoted(task.output))
            .replace("{width}", &task.width.to_string())
            .replace("{height}", &task.height.to_string())
            .replace("{threads}", &task.threads.to_string())
    }

    /// The milliseconds that the renderer says it traced.
    pub(super) fn trace(&self, files: &CaseFiles, task: &PovrayTask<'_>) -> Result<f64> {
        let text = shell::output(&mut command("sh", &["-c", &self.command_line(files, task)]))
            .with_context(|| self.name.clone())?;
        told_milliseconds(&text).with_context(|| format!("{} told no trace time:\n{text}", self.name))
    }
}

/// From a line like "trace 12.3".
fn told_milliseconds(text: &str) -> Option<f64> {
    let told = text.lines().find_map(|line| line.trim().strip_prefix("trace "))?;
    told.split_whitespace().next()?.parse().ok().filter(|time: &f64| *time > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn work() -> (CaseFiles, PovrayTask<'static>) {
        let files = CaseFiles { scene: "a b.toml".into(), pov: "it's.pov".into(), bodies: 1 };
        (files, PovrayTask { output: Path::new("c.exr"), width: 320, height: 180, threads: 2 })
    }

    #[test]
    fn the_command_of_another_renderer_is_filled_in() {
        let other: OtherRenderer =
            "mine=run {scene} {pov} {width}x{height} -t{threads} -o {output} ${HOME}".parse().unwrap();
        assert_eq!(other.name, "mine");
        let (files, task) = work();
        let line = other.command_line(&files, &task);
        assert_eq!(line, r"run 'a b.toml' 'it'\''s.pov' 320x180 -t2 -o 'c.exr' ${HOME}");
        for wrong in ["mine", "=run", "mine="] {
            assert!(wrong.parse::<OtherRenderer>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn another_renderer_tells_its_time() {
        let other: OtherRenderer = "echo=echo tracing; echo trace {width}.5 ms".parse().unwrap();
        let (files, task) = work();
        assert_eq!(other.trace(&files, &task).unwrap(), 320.5);
        for silent in ["x=echo traced 5", "x=echo trace nan", "x=echo trace 0", "x=exit 3"] {
            assert!(silent.parse::<OtherRenderer>().unwrap().trace(&files, &task).is_err(), "{silent}");
        }
    }

    #[test]
    fn the_statistics_are_read() {
        let text = r#"{"milliseconds": {"prepare": 0.5, "trace": 12.25}, "stage_bytes": 4096,
            "rays": {"primary": 4, "shadow": 3, "reflected": 2, "refracted": 1, "total": 10}}"#;
        let stats = RenderStats::from_json(text).unwrap();
        let rays = [4.0, 3.0, 2.0, 1.0];
        assert_eq!(stats, RenderStats { prepare: 0.5, trace: 12.25, rays, stage_bytes: 4096.0 });
        assert_eq!(stats.all_rays(), 10.0);
        let error = RenderStats::from_json(&text.replace("shadow", "x")).unwrap_err();
        assert!(error.to_string().contains("/rays/shadow"), "{error}");
    }
}
