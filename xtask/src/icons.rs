//! The icons of the studio: of a font with thousands, a small one with those in use.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};
use xtask::root;
use xtask::shell::{self, command, exists, output};

/// The crate that names the icons and has the whole font.
const CRATE: &str = "egui_material_icons";
const FONT: &str = "MaterialSymbolsRounded-Regular.ttf";

/// Writes `crates/studio/assets/icons.ttf` anew.
pub(crate) fn run() -> Result<()> {
    ensure!(exists("pyftsubset", "--help"), "pyftsubset is not installed (pip install fonttools)");
    let mut used = BTreeSet::new();
    collect(&root().join("crates/studio/src"), &mut used)?;
    let folder = crate_folder()?;
    let names = fs::read_to_string(folder.join("src/icons.rs"))?;
    let codes: Vec<&str> = used.iter().filter_map(|name| code_of(&names, name)).collect();
    let font = root().join("crates/studio/assets/icons.ttf");
    let mut subset = command("pyftsubset", &["--layout-features=", "--no-hinting", "--desubroutinize"]);
    subset.arg(folder.join(FONT)).arg(format!("--unicodes={}", codes.join(",")));
    shell::run(subset.arg(format!("--output-file={}", font.display())))?;
    println!("{} icons in {}", codes.len(), font.display());
    Ok(())
}

/// The names of icons in the sources under a folder.
fn collect(folder: &Path, used: &mut BTreeSet<String>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, used)?;
        } else {
            let text = fs::read_to_string(&path)?;
            let names = text.split(|letter: char| !letter.is_ascii_alphanumeric() && letter != '_');
            used.extend(names.filter(|name| name.starts_with("ICON_")).map(str::to_owned));
        }
    }
    Ok(())
}

/// The code point of an icon, hexadecimal.
fn code_of<'a>(names: &'a str, name: &str) -> Option<&'a str> {
    let after = names.split(&format!("pub const {name}:")).nth(1)?;
    after.split("\\u{").nth(1)?.split('}').next()
}

/// Where cargo keeps the source of the crate.
fn crate_folder() -> Result<PathBuf> {
    let told = output(&mut command("cargo", &["metadata", "--locked", "--format-version", "1"]))?;
    let part = format!("/{CRATE}-");
    let manifest = told
        .split("\"manifest_path\":\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .find(|path| path.contains(&part));
    let manifest = manifest.with_context(|| format!("cargo does not know {CRATE}"))?;
    Path::new(manifest).parent().map(Path::to_owned).context("a manifest without a folder")
}
