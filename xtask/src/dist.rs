//! An archive for Linux: the stripped program and what a desktop needs to know of it.

mod trial;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail, ensure};

use xtask::root;
use xtask::shell::{self, command, exists, output};

/// Files of the repository and their places in the archive.
const FILES: &[(&str, &str)] = &[
    ("README.md", "README.md"),
    ("README.ru.md", "README.ru.md"),
    ("CHANGELOG.md", "CHANGELOG.md"),
    ("LICENSE-APACHE", "LICENSE-APACHE"),
    ("LICENSE-MIT", "LICENSE-MIT"),
    ("crates/studio/assets/catoptric.desktop", "share/applications/catoptric.desktop"),
    ("crates/studio/assets/icon.png", "share/icons/hicolor/256x256/apps/catoptric.png"),
];

/// Scripts that the program prints, and their places in the archive.
const PRINTED: &[(&[&str], &str)] = &[
    (&["completions", "bash"], "share/bash-completion/completions/catoptric"),
    (&["completions", "zsh"], "share/zsh/site-functions/_catoptric"),
    (&["completions", "fish"], "share/fish/vendor_completions.d/catoptric.fish"),
];

/// What every Linux system with the C library of GNU has. All else (windows, graphics cards) is loaded when it is used.
const LIBRARIES: &[&str] = &["ld-linux", "libc.so.6", "libgcc_s.so.1", "libm.so.6"];

/// Makes the archive; if `is_tried`, it is also tried on a system that has nothing else.
pub(crate) fn run(is_tried: bool) -> Result<()> {
    ensure!(cfg!(target_os = "linux"), "archives are made on Linux only");
    ensure!(exists("tar", "--version"), "tar is not installed");
    if is_tried {
        // Asked before the program is built, which takes minutes.
        ensure!(
            exists("debootstrap", "--version"),
            "debootstrap is not installed (apt-get install debootstrap)"
        );
    }
    let name = format!("catoptric-{}-{}-linux", env!("CARGO_PKG_VERSION"), std::env::consts::ARCH);
    let dist = root().join("target/dist");
    let folder = dist.join(&name);
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    for (from, to) in FILES {
        copy(&root().join(from), &folder.join(to))?;
    }
    let program = folder.join("bin/catoptric");
    copy(&built()?, &program)?;
    if exists("strip", "--version") {
        shell::run(command("strip", &["--strip-all"]).arg(&program))?;
    }
    println!("{}", needs(&program)?);
    for (arguments, to) in PRINTED {
        write(&folder.join(to), &printed(&program, arguments)?)?;
    }
    manual(&program, &folder.join("share/man/man1"))?;
    let archive = dist.join(format!("{name}.tar.gz"));
    pack(&dist, &name, &archive)?;
    let size = fs::metadata(&archive)?.len();
    println!("{} ({:.1} MB)", archive.display(), size as f64 / 1e6);
    if is_tried { trial::run(&dist, &name) } else { Ok(()) }
}

/// Builds the program; where it lies, as Cargo tells it: builds may go elsewhere.
fn built() -> Result<PathBuf> {
    let build = ["build", "--release", "--locked", "--package", "catoptric"];
    shell::run(&mut command("cargo", &build))?;
    let messages =
        output(&mut command("cargo", &[&build[..], &["--quiet", "--message-format=json"]].concat()))?;
    let path = messages.split("\"executable\":\"").nth(1).and_then(|rest| rest.split('"').next());
    Ok(PathBuf::from(path.context("Cargo does not tell where the program is")?))
}

/// Tells which C library the program needs; an error if it needs another library to start.
fn needs(program: &Path) -> Result<String> {
    if !exists("readelf", "--version") {
        return Ok("readelf is not installed: what the program links is not checked".to_owned());
    }
    let about = output(command("readelf", &["--wide", "--dynamic", "--version-info"]).arg(program))?;
    for line in about.lines().filter(|line| line.contains("(NEEDED)")) {
        if !LIBRARIES.iter().any(|library| line.contains(library)) {
            bail!("the program does not start where a library is missing: {}", line.trim());
        }
    }
    let versions = about.split("GLIBC_2.").skip(1).filter_map(|rest| {
        rest.split(|c: char| !c.is_ascii_digit()).next().and_then(|minor| minor.parse::<u32>().ok())
    });
    let newest = versions.max().context("readelf tells no version of the C library")?;
    Ok(format!("the program needs glibc 2.{newest} or newer, and no other library to start"))
}

/// Writes the manual page of the program and those of its commands, which it lists.
fn manual(program: &Path, folder: &Path) -> Result<()> {
    let page = printed(program, &["man"])?;
    let listed = page.lines().filter_map(|line| line.strip_prefix("catoptric\\-")?.strip_suffix("(1)"));
    // The pages of `help` are those of the others.
    for name in listed.filter(|&name| name != "help") {
        write(&folder.join(format!("catoptric-{name}.1")), &printed(program, &["man", name])?)?;
    }
    write(&folder.join("catoptric.1"), &page)
}

fn printed(program: &Path, arguments: &[&str]) -> Result<String> {
    output(&mut command(&program.to_string_lossy(), arguments))
}

/// Packs a folder reproducibly: sorted names, no owner, no time of the day.
fn pack(dist: &Path, name: &str, archive: &Path) -> Result<()> {
    let mut tar = command("tar", &["--sort=name", "--owner=0", "--group=0", "--numeric-owner", "--mtime=@0"]);
    tar.arg("--use-compress-program=gzip -n").arg("-C").arg(dist).arg("-cf").arg(archive).arg(name);
    shell::run(&mut tar)
}

fn copy(from: &Path, to: &Path) -> Result<()> {
    make_folder_of(to)?;
    fs::copy(from, to).with_context(|| format!("copying {}", from.display()))?;
    Ok(())
}

fn write(to: &Path, text: &str) -> Result<()> {
    make_folder_of(to)?;
    fs::write(to, text).with_context(|| to.display().to_string())
}

fn make_folder_of(path: &Path) -> Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    Ok(())
}
