//! Project chores: the whole check and archives; what traces is the workbench's, a program of its own.

mod ci;
mod dist;
mod icons;
#[cfg(test)]
mod layers;
mod licenses;
mod packages;
#[cfg(test)]
mod tidy;
#[cfg(feature = "web")]
mod web;

use anyhow::{Result, bail};
use xtask::shell::{self, command};

const HELP: &str = "\
Project chores

Usage: cargo xtask COMMAND

  ci           The whole check: format, dependencies, lints, documentation, tests
  ci --long    The same, the README's first command, other systems, cargo deny, and the laboratory in a browser
  dist         Make an archive of the program for Linux
  dist --try   The same, and try it on a bare Debian system (as root, with debootstrap)
  icons        Make the font of the icons that the studio uses anew (with pyftsubset)
  web          Make the studio for browsers: static files in target/web
               with --small made smaller by Binaryen, with --check driven in Chromium, with --measure measured
               there (all installed by npm), with --made as it is there already
  help         List the other commands, those of the workbench: measurements, pictures of the documents
";

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        [] | ["-h" | "--help"] => print!("{HELP}"),
        ["ci"] => ci::run(ci::Extent::Usual)?,
        ["ci", "--long"] => ci::run(ci::Extent::Long)?,
        ["dist"] => dist::run(false)?,
        ["dist", "--try"] => dist::run(true)?,
        ["icons"] => icons::run()?,
        ["web", ref rest @ ..] => web(rest)?,
        ["ci" | "dist" | "icons", ..] => bail!("wrong arguments: {}\n\n{HELP}", words.join(" ")),
        _ => workbench(&words)?,
    }
    Ok(())
}

#[cfg(feature = "web")]
fn web(words: &[&str]) -> Result<()> {
    match web::WebTask::of(words) {
        Some(task) => web::run(task),
        None => bail!("wrong arguments: web {}\n\n{HELP}", words.join(" ")),
    }
}

/// Builds these chores anew, with what the check can do without, and runs them.
#[cfg(not(feature = "web"))]
fn web(words: &[&str]) -> Result<()> {
    let build = ["run", "--quiet", "--package", "xtask", "--features", "web", "--", "web"];
    shell::run(command("cargo", &build).args(words))
}

/// Builds and runs the workbench, which needs the tracer: the check starts without it.
fn workbench(words: &[&str]) -> Result<()> {
    shell::run(command("cargo", &["run", "--quiet", "--package", "workbench", "--"]).args(words))
}
