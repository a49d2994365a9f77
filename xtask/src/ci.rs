//! The whole check, cheapest parts first.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use anyhow::{Context as _, Result, ensure};
use xtask::root;
use xtask::shell::{self, command, exists, output};

use crate::{licenses, packages};

/// How much is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    /// What finds nearly every fault.
    Usual,
    /// Also what takes minutes to build and seldom fails alone: the release build, other systems, `cargo deny` and the
    /// laboratory in a browser.
    Long,
}

/// The program without what its first picture does not need.
const SLIM: [&str; 4] = ["--package", "catoptric", "--locked", "--no-default-features"];

/// Other systems that a package is written for, with a feature: it is compiled for them as far as that goes without their
/// linkers. In a browser cards could be driven by WebGPU.
const SYSTEMS: [(&str, &str, &str); 3] = [
    ("catoptric", "aarch64-apple-darwin", ""),
    ("catoptric", "x86_64-pc-windows-gnu", ""),
    ("catoptric-gpu", BROWSER_TARGET, "webgpu"),
];

const BROWSER_TARGET: &str = "wasm32-unknown-unknown";

/// Runs everything and says what had to be skipped.
pub(crate) fn run(extent: Extent) -> Result<()> {
    let start = Instant::now();
    let skipped = checks(extent)?;
    for reason in &skipped {
        println!("skipped: {reason}");
    }
    let exception = if skipped.is_empty() { "" } else { ", but for those skipped" };
    println!("all checks passed{exception}, in {}", minutes(start));
    Ok(())
}

fn run_cargo(arguments: &[&str]) -> Result<()> {
    shell::run(&mut cargo(arguments))
}

/// Cargo, told to keep nothing for later builds: without that, and without debug information, everything is built
/// sooner. All steps are told, so that they share what is built.
fn cargo(arguments: &[&str]) -> Command {
    let mut command = command("cargo", arguments);
    command.env("CARGO_INCREMENTAL", "0").env("CARGO_PROFILE_DEV_DEBUG", "false");
    command
}

/// Does a part of something long, and tells when it begins and how long it took.
pub(crate) fn step(title: &str, work: impl FnOnce() -> Result<()>) -> Result<()> {
    println!("== {title}");
    let start = Instant::now();
    work().with_context(|| format!("{title}: failed"))?;
    println!("== {title}: {}", minutes(start));
    Ok(())
}

fn minutes(start: Instant) -> String {
    let seconds = start.elapsed().as_secs();
    format!("{}:{:02} min", seconds / 60, seconds % 60)
}

/// Runs all steps; returns those that could not be run, with the reason.
fn checks(extent: Extent) -> Result<Vec<String>> {
    let mut skipped = Vec::new();
    step("format", || run_cargo(&["fmt", "--all", "--check"]))?;
    step("dependencies", licenses::check)?;
    step("lints", || {
        run_cargo(&["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"])
    })?;
    step("lints without features", || {
        run_cargo(&[&["clippy"], &SLIM[..], &["--", "-D", "warnings"]].concat())
    })?;
    // In a browser the studio runs without the program.
    skipped.extend(check_for("catoptric-web", BROWSER_TARGET, "")?);
    step("documentation", || {
        let arguments = ["doc", "--workspace", "--no-deps", "--locked", "--document-private-items"];
        shell::run(cargo(&arguments).env("RUSTDOCFLAGS", "-D warnings"))
    })?;
    skipped.extend(packages::provide(&packages::WINDOW));
    // The examples of the crates are measurements: the lints have seen them, and no test needs them linked.
    step("tests", || run_cargo(&["test", "--workspace", "--lib", "--bins", "--tests", "--locked"]))?;
    step("programs in the documentation", || run_cargo(&["test", "--workspace", "--doc", "--locked"]))?;
    if extent == Extent::Long {
        step("the README's first command", first_command)?;
        for (package, target, feature) in SYSTEMS {
            skipped.extend(check_for(package, target, feature)?);
        }
        skipped.extend(deny()?);
        skipped.extend(browser()?);
    }
    Ok(skipped)
}

/// Drives the laboratory in a browser; returns why that cannot be done, if so.
fn browser() -> Result<Option<String>> {
    let what = packages::BROWSER.what;
    if !exists("npm", "--version") {
        return Ok(Some(format!("{what}: there is no npm to install Playwright with")));
    }
    if !has_library(BROWSER_TARGET)? {
        return Ok(Some(format!("{what}: {}", library_advice(BROWSER_TARGET))));
    }
    if let Some(reason) = packages::provide(&packages::BROWSER) {
        return Ok(Some(reason));
    }
    let web = ["run", "--package", "xtask", "--features", "web", "--locked", "--", "web", "--check"];
    step(what, || run_cargo(&web)).map(|()| None)
}

/// Whether the standard library for a system is installed.
pub(crate) fn has_library(target: &str) -> Result<bool> {
    let library = output(&mut command("rustc", &["--print", "target-libdir", "--target", target]))?;
    Ok(Path::new(library.trim()).exists())
}

pub(crate) fn library_advice(target: &str) -> String {
    format!("its standard library is not installed (rustup target add {target})")
}

/// Checks a package's Rust for another system; returns why that cannot be done, if so.
fn check_for(package: &str, target: &str, features: &str) -> Result<Option<String>> {
    if !has_library(target)? {
        return Ok(Some(format!("{package} on {target}: {}", library_advice(target))));
    }
    step(&format!("{package} on {target}"), || {
        let mut check = cargo(&["check", "--package", package, "--locked", "--target", target]);
        check.args(["--features", features]);
        // Nothing is linked, so that what is written in C need not be compiled.
        for tool in ["CC", "CXX", "AR"] {
            check.env(format!("{tool}_{}", target.replace('-', "_")), "true");
        }
        shell::run(check.env("RUSTFLAGS", "-D warnings"))
    })
    .map(|()| None)
}

/// Draws the picture, and asks the same program for the studio, which it does not have.
fn first_command() -> Result<()> {
    let folder = root().join("target");
    // Builds may go elsewhere.
    fs::create_dir_all(&folder)?;
    let picture = folder.join("whitted.png");
    let picture = picture.to_string_lossy();
    let render = ["--", "render", "whitted", "-o", &picture, "--samples", "16"];
    run_cargo(&[&["run", "--release"], &SLIM[..], &render].concat())?;
    let output =
        cargo(&[&["run", "--release", "--quiet"], &SLIM[..], &["--", "studio"]].concat()).output()?;
    let words = String::from_utf8_lossy(&output.stderr);
    ensure!(
        output.status.code() == Some(2) && words.contains("cargo run --release"),
        "the program without the studio does not say how to get it: {words}"
    );
    Ok(())
}

/// Runs `cargo deny`; returns why it cannot be had, if so.
fn deny() -> Result<Option<String>> {
    match deny_program() {
        Ok(program) => step("cargo deny", || {
            let program = program.to_string_lossy();
            shell::run(&mut command(&program, &["check", "bans", "licenses", "sources"]))
        })
        .map(|()| None),
        Err(error) => Ok(Some(format!("cargo deny cannot be had: {error:#}"))),
    }
}

/// The cargo-deny program: the installed one, or one built for this repository.
fn deny_program() -> Result<PathBuf> {
    if exists("cargo-deny", "--version") {
        return Ok(PathBuf::from("cargo-deny"));
    }
    let tools = root().join("target/tools");
    let program = tools.join("bin").join(format!("cargo-deny{}", std::env::consts::EXE_SUFFIX));
    if !program.exists() {
        println!("== cargo-deny is not installed; building it");
        let place = tools.to_string_lossy();
        // A debug build takes half the time, and is quick enough for one look.
        let version = ["cargo-deny", "--version", "0.20.2", "--debug"];
        run_cargo(&[&["install"], &version[..], &["--locked", "--quiet", "--root", &place]].concat())?;
    }
    Ok(program)
}
