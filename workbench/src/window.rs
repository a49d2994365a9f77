//! Chores that need the studio: its pictures in the documents, and how quickly it answers.

use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};

use anyhow::{Context as _, Result, bail};
use clap::Args;
use xtask::root;
use xtask::shell::{self, command};

#[derive(Debug, Args)]
pub(crate) struct ScreenshotArguments {
    /// Only these pictures
    names: Vec<String>,
}

/// Size of the pictures of the studio.
const SCREENSHOT: &str = "1440x900";

/// Draws the studio without a window into `docs/studio`.
pub(crate) fn screenshots(arguments: &ScreenshotArguments) -> Result<()> {
    let folder = root().join("docs/studio");
    let folder = folder.to_string_lossy();
    let mut example = example("screenshots");
    example.args([&*folder, SCREENSHOT]).args(&arguments.names);
    shell::run(&mut example)
}

/// Opens the studio at 1280×720, on a virtual display if there is no other, and prints the table of its times.
pub(crate) fn bench() -> Result<()> {
    // Built first: no display waits for it.
    shell::run(&mut command(
        "cargo",
        &["build", "--release", "--quiet", "--package", "catoptric-studio", "--examples"],
    ))?;
    let display = if std::env::var_os("DISPLAY").is_none() { Some(Display::start()?) } else { None };
    let mut example = example("bench");
    example.args(["1280", "720"]);
    if let Some(display) = &display {
        example.env("DISPLAY", &display.name).env_remove("WAYLAND_DISPLAY");
    }
    println!("| what | figure |\n|---|---|");
    shell::run(&mut example)
}

fn example(name: &str) -> Command {
    let arguments = ["run", "--release", "--quiet", "--package", "catoptric-studio", "--example", name, "--"];
    command("cargo", &arguments)
}

/// A display without a screen, for as long as this lives.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    fn start() -> Result<Self> {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0", "1280x720x24"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .context("there is no display, and Xvfb cannot be started; on Debian: apt-get install xvfb")?;
        let mut number = String::new();
        if let Some(output) = server.stdout.take() {
            BufReader::new(output).read_line(&mut number)?;
        }
        if number.trim().is_empty() {
            let _ = server.kill();
            bail!("Xvfb gives no display");
        }
        Ok(Self { server, name: format!(":{}", number.trim()) })
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
