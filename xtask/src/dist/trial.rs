//! The archive tried on a bare Debian system, which has no Rust and nothing of this repository.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, Result};

use xtask::shell::{self, command};

/// The oldest Debian on which the archive is promised to run.
const SUITE: &str = "bookworm";

/// What the trial itself needs: a display without a screen, and readers of what the archive brings.
const READERS: &str = "bash-completion,desktop-file-utils,man-db,x11-utils,xvfb";

/// What the documents say that the studio needs of a system without a desktop.
const STUDIO: &str = "libxcursor1,libxi6,libxkbcommon-x11-0,mesa-vulkan-drivers";

/// What is tried, and the command of a shell that succeeds where it works.
const TRIALS: &[(&str, &str)] = &[
    ("has no Rust", "! command -v cargo && ! command -v rustc"),
    ("starts", "catoptric --version"),
    ("draws", "catoptric render whitted -o /tmp/whitted.png --size 320x180 && test -s /tmp/whitted.png"),
    ("manual", "man -M /opt/catoptric/share/man catoptric | grep -q whitted"),
    ("manual of a command", "man -M /opt/catoptric/share/man catoptric-render | grep -q -e --samples"),
    (
        "completions",
        "bash -c '. /opt/catoptric/share/bash-completion/completions/catoptric && complete -p catoptric &&
             COMP_LINE=\"catoptric render whit\" COMP_POINT=21 COMP_WORDS=(catoptric render whit) COMP_CWORD=2 &&
             _catoptric catoptric whit render && test \"$COMPREPLY\" = whitted'",
    ),
    ("desktop entry", "desktop-file-validate /opt/catoptric/share/applications/catoptric.desktop"),
    (
        "studio",
        "export DISPLAY=:77 HOME=/tmp XDG_RUNTIME_DIR=/tmp
         timeout 90 Xvfb $DISPLAY -screen 0 1280x720x24 -nolisten tcp & sleep 2
         timeout 60 catoptric studio whitted & studio=$!
         for second in $(seq 50); do
             sleep 1
             kill -0 $studio || exit 1
             xwininfo -root -tree | grep -q 'Catoptric\"' && sleep 5 && kill $studio && exit 0
         done
         exit 1",
    ),
];

/// Makes the system if it is not there yet, and tries everything in it.
pub(super) fn run(dist: &Path, name: &str) -> Result<()> {
    let system = dist.join(SUITE);
    if !system.join("usr/bin/Xvfb").exists() {
        let include = format!("--include={READERS},{STUDIO}");
        let mut debootstrap = command("debootstrap", &["--variant=minbase", &include, SUITE]);
        shell::run(debootstrap.arg(&system))?;
    }
    let place = system.join("opt/catoptric");
    if place.exists() {
        fs::remove_dir_all(&place)?;
    }
    fs::create_dir_all(&place)?;
    let mut tar = command("tar", &["--strip-components=1", "-xzf"]);
    shell::run(tar.arg(dist.join(format!("{name}.tar.gz"))).arg("-C").arg(&place))?;
    for (title, script) in TRIALS {
        println!("== {SUITE}: {title}");
        shell::run(&mut inside(&system, script)).with_context(|| format!("on {SUITE}: {title}: failed"))?;
    }
    println!("the archive works on {SUITE}");
    Ok(())
}

/// A shell in the system, with the archive's program on its path and nothing of this system's environment.
fn inside(system: &Path, script: &str) -> Command {
    let mut chroot = Command::new("chroot");
    chroot.env_clear().env("PATH", "/opt/catoptric/bin:/usr/sbin:/usr/bin:/sbin:/bin").env("LANG", "C.UTF-8");
    chroot.arg(system).args(["sh", "-c", script]);
    chroot
}
