//! Running other programs.

use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::root;

/// A command that runs in the repository's root.
pub(crate) fn command(program: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(root());
    command
}

/// Runs a command, its output going where ours goes.
pub(crate) fn run(command: &mut Command) -> Result<()> {
    let name = command.get_program().to_string_lossy().into_owned();
    let status = command.status().with_context(|| format!("cannot start {name}"))?;
    if !status.success() {
        bail!("{name} failed ({status})");
    }
    Ok(())
}

/// Runs a command and returns what it prints.
pub(crate) fn output(command: &mut Command) -> Result<String> {
    let [printed, _] = streams(command)?;
    Ok(printed)
}

/// Runs a command and returns what it prints, also as errors.
pub(crate) fn output_of_both(command: &mut Command) -> Result<String> {
    Ok(streams(command)?.concat())
}

/// Runs a command and returns what it prints, and what it prints as errors.
pub(crate) fn streams(command: &mut Command) -> Result<[String; 2]> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().with_context(|| format!("cannot start {name}"))?;
    let texts = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    if !output.status.success() {
        bail!("{name} failed ({}):\n{}", output.status, texts.concat());
    }
    Ok(texts)
}

/// Whether a program can be started.
pub(crate) fn exists(program: &str, probe: &str) -> bool {
    Command::new(program).arg(probe).output().is_ok_and(|output| output.status.success())
}
