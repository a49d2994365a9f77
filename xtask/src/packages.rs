//! System packages that the check wants, installed where that is allowed.

use std::process::Command;

use anyhow::Result;

use xtask::shell::{self, command, exists, output};

/// What a part of the check needs of the system.
pub(crate) struct Need {
    /// The part of the check.
    pub(crate) what: &'static str,
    /// Debian's packages.
    packages: &'static [&'static str],
    /// A program of theirs, with an argument that it takes, for other systems.
    program: [&'static str; 2],
}

/// A display without a screen, a software driver, and what a window on X11 loads when it opens.
pub(crate) const WINDOW: Need = Need {
    what: "the studio in a real window",
    packages: &["libegl1", "libxcursor1", "libxi6", "libxkbcommon-x11-0", "mesa-vulkan-drivers", "xvfb"],
    program: ["Xvfb", "-help"],
};

/// A browser that scripts can drive.
pub(crate) const BROWSER: Need =
    Need { what: "the laboratory in a browser", packages: &["chromium"], program: ["chromium", "--version"] };

/// Installs what is missing on a Debian-like system as root; returns why something cannot be had, if so.
pub(crate) fn provide(need: &Need) -> Option<String> {
    let Need { what, packages, program: [program, argument] } = need;
    if !exists("dpkg-query", "--version") {
        return (!exists(program, argument)).then(|| format!("{what}: {program} is not installed"));
    }
    let missing: Vec<&str> = packages.iter().copied().filter(|package| !is_installed(package)).collect();
    if missing.is_empty() {
        return None;
    }
    let wanted = missing.join(" ");
    let advice = format!("{what}: not installed: {wanted} (apt-get install {wanted})");
    if !is_root() {
        return Some(advice);
    }
    match install(&missing) {
        Ok(()) => None,
        Err(error) => Some(format!("{advice}: {error:#}")),
    }
}

fn is_installed(package: &str) -> bool {
    let mut query = Command::new("dpkg-query");
    query.args(["--show", "--showformat", "${db:Status-Status}", package]);
    output(&mut query).is_ok_and(|status| status == "installed")
}

fn is_root() -> bool {
    output(&mut command("id", &["-u"])).is_ok_and(|id| id.trim() == "0")
}

fn install(packages: &[&str]) -> Result<()> {
    println!("== installing {}", packages.join(" "));
    shell::run(&mut command("apt-get", &["update", "--quiet=2"]))?;
    let mut install = command("apt-get", &["install", "--yes", "--quiet=2", "--no-install-recommends"]);
    shell::run(install.args(packages).env("DEBIAN_FRONTEND", "noninteractive"))
}
