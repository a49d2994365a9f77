//! Running other programs.

use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::root;

/// A command that runs in the repository's root.
#[must_use]
pub fn command(program: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(root());
    command
}

/// Runs a command, its output going where ours goes.
///
/// # Errors
///
/// The command cannot be started, or fails.
pub fn run(command: &mut Command) -> Result<()> {
    let name = command.get_program().to_string_lossy().into_owned();
    let status = command.status().with_context(|| format!("cannot start {name}"))?;
    if !status.success() {
        bail!("{name} failed ({status})");
    }
    Ok(())
}

/// Runs a command and returns what it prints.
///
/// # Errors
///
/// The command cannot be started, or fails; the message has what it printed.
pub fn output(command: &mut Command) -> Result<String> {
    let [printed, _] = streams(command)?;
    Ok(printed)
}

/// Runs a command and returns what it prints, also as errors.
///
/// # Errors
///
/// Those of [`output`].
pub fn output_of_both(command: &mut Command) -> Result<String> {
    Ok(streams(command)?.concat())
}

/// Runs a command and returns what it prints, and what it prints as errors.
///
/// # Errors
///
/// Those of [`output`].
pub fn streams(command: &mut Command) -> Result<[String; 2]> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().with_context(|| format!("cannot start {name}"))?;
    let texts = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    if !output.status.success() {
        bail!("{name} failed ({}):\n{}", output.status, texts.concat());
    }
    Ok(texts)
}

/// Whether a program can be started, tried with the argument `probe`.
#[must_use]
pub fn exists(program: &str, probe: &str) -> bool {
    Command::new(program).arg(probe).output().is_ok_and(|output| output.status.success())
}
