//! An archive for Linux: the stripped program and what a desktop needs to know of it.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};

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
    (&["man"], "share/man/man1/catoptric.1"),
    (&["completions", "bash"], "share/bash-completion/completions/catoptric"),
    (&["completions", "zsh"], "share/zsh/site-functions/_catoptric"),
    (&["completions", "fish"], "share/fish/vendor_completions.d/catoptric.fish"),
];

pub(crate) fn run() -> Result<()> {
    ensure!(cfg!(target_os = "linux"), "archives are made on Linux only");
    ensure!(exists("tar", "--version"), "tar is not installed");
    shell::run(&mut command("cargo", &["build", "--release", "--locked", "--package", "catoptric"]))?;
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
    copy(&root().join("target/release/catoptric"), &program)?;
    if exists("strip", "--version") {
        shell::run(command("strip", &["--strip-all"]).arg(&program))?;
    }
    for (arguments, to) in PRINTED {
        let text = output(&mut command(&program.to_string_lossy(), arguments))?;
        let to = folder.join(to);
        make_folder_of(&to)?;
        fs::write(&to, text)?;
    }
    let archive = dist.join(format!("{name}.tar.gz"));
    pack(&dist, &name, &archive)?;
    let size = fs::metadata(&archive)?.len();
    println!("{} ({:.1} MB)", archive.display(), size as f64 / 1e6);
    Ok(())
}

/// Packs a folder reproducibly: sorted names, no owner, no time of the day.
fn pack(dist: &Path, name: &str, archive: &Path) -> Result<()> {
    let mut tar = command("tar", &["--sort=name", "--owner=0", "--group=0", "--numeric-owner", "--mtime=@0"]);
    tar.env("GZIP", "-n").arg("-C").arg(dist).arg("-czf").arg(archive).arg(name);
    shell::run(&mut tar)
}

fn copy(from: &Path, to: &Path) -> Result<()> {
    make_folder_of(to)?;
    fs::copy(from, to).with_context(|| format!("copying {}", from.display()))?;
    Ok(())
}

fn make_folder_of(path: &Path) -> Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    Ok(())
}
