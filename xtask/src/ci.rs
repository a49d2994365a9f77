//! The whole check, cheapest parts first.

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context as _, Result};

use crate::packages;
use xtask::root;
use xtask::shell::{self, command, exists};

/// Runs everything and says what had to be skipped.
pub(crate) fn run() -> Result<()> {
    let skipped = checks()?;
    for reason in &skipped {
        println!("skipped: {reason}");
    }
    println!("all checks passed{}", if skipped.is_empty() { "" } else { ", but for those skipped" });
    Ok(())
}

fn run_cargo(arguments: &[&str]) -> Result<()> {
    shell::run(&mut cargo(arguments))
}

fn cargo(arguments: &[&str]) -> Command {
    command("cargo", arguments)
}

fn step(title: &str, work: impl FnOnce() -> Result<()>) -> Result<()> {
    println!("== {title}");
    work().with_context(|| format!("{title}: failed"))
}

/// Runs all steps; returns those that could not be run, with the reason.
fn checks() -> Result<Vec<String>> {
    let mut skipped = Vec::new();
    step("format", || run_cargo(&["fmt", "--all", "--check"]))?;
    step("lints", || {
        run_cargo(&["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"])
    })?;
    step("documentation", || {
        let arguments = ["doc", "--workspace", "--no-deps", "--locked", "--document-private-items"];
        shell::run(cargo(&arguments).env("RUSTDOCFLAGS", "-D warnings"))
    })?;
    match deny() {
        Ok(program) => step("dependencies", || {
            let program = program.to_string_lossy();
            shell::run(&mut command(&program, &["check", "bans", "licenses", "sources"]))
        })?,
        Err(error) => skipped.push(format!("dependencies: cargo-deny cannot be had: {error:#}")),
    }
    skipped.extend(packages::provide());
    step("tests", || run_cargo(&["test", "--workspace", "--locked"]))?;
    step("the README's first command", || {
        let picture = root().join("target/whitted.png");
        let picture = picture.to_string_lossy();
        run_cargo(&[
            "run",
            "--release",
            "--locked",
            "--",
            "render",
            "whitted",
            "-o",
            &picture,
            "--samples",
            "16",
        ])
    })?;
    Ok(skipped)
}

/// The cargo-deny program: the installed one, or one built for this repository.
fn deny() -> Result<PathBuf> {
    if exists("cargo-deny", "--version") {
        return Ok(PathBuf::from("cargo-deny"));
    }
    let tools = root().join("target/tools");
    let program = tools.join("bin").join(format!("cargo-deny{}", std::env::consts::EXE_SUFFIX));
    if !program.exists() {
        println!("== cargo-deny is not installed; building it");
        let place = tools.to_string_lossy();
        run_cargo(&[
            "install",
            "cargo-deny",
            "--version",
            "0.20.2",
            // Built in half the time, and quick enough for one look.
            "--debug",
            "--locked",
            "--quiet",
            "--root",
            &place,
        ])?;
    }
    Ok(program)
}
