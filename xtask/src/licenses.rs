//! A quick look at the dependencies by the rules of `deny.toml`: their declared licenses, sources, and no wildcards.
//! `cargo deny`, which also reads the texts of licenses, takes longer to build than all lints.

use std::collections::BTreeSet;
use std::fs;
use std::iter::Peekable;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};
use xtask::root;
use xtask::shell::{command, output};

/// Where every package comes from, as the lock file has it.
const SOURCE: &str = "source = \"registry+https://github.com/rust-lang/crates.io-index\"";

/// What `cargo tree` adds to a package that it has listed before.
const REPEATED: &str = " (*)";

/// Fails with all packages that break a rule.
pub(crate) fn check() -> Result<()> {
    let rules = read(&root().join("deny.toml"))?;
    let allowed = allowed_licenses(&rules);
    let tree = output(&mut command(
        "cargo",
        &[
            "tree",
            "--workspace",
            "--locked",
            "--all-features",
            "--target=all",
            "--edges=normal,build,dev",
            "--prefix=none",
            "--format={p}|{l}",
        ],
    ))?;
    let mut faults: BTreeSet<String> =
        tree.lines().filter_map(|line| license_fault(line, &allowed)).collect();
    faults.extend(foreign_sources(&read(&root().join("Cargo.lock"))?));
    for manifest in manifests()? {
        faults.extend(wildcards(&read(&manifest)?).map(|line| format!("{}: {line}", manifest.display())));
    }
    ensure!(faults.is_empty(), "{}", faults.into_iter().collect::<Vec<_>>().join("\n"));
    Ok(())
}

fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).with_context(|| path.display().to_string())
}

/// The manifests of the workspace.
fn manifests() -> Result<Vec<PathBuf>> {
    let mut folders = vec![root(), root().join("workbench"), root().join("xtask")];
    for entry in fs::read_dir(root().join("crates"))? {
        folders.push(entry?.path());
    }
    Ok(folders.iter().map(|folder| folder.join("Cargo.toml")).filter(|path| path.exists()).collect())
}

/// The names in the list `allow` of `deny.toml`.
fn allowed_licenses(rules: &str) -> Vec<&str> {
    let list = rules.lines().skip_while(|line| *line != "allow = [").take_while(|line| *line != "]");
    list.filter_map(|line| line.trim().strip_prefix('"')?.strip_suffix("\",")).collect()
}

/// What is wrong with a line `package|license`; empty lines stand between the packages of the workspace.
fn license_fault(line: &str, allowed: &[&str]) -> Option<String> {
    let (package, license) = line.strip_suffix(REPEATED).unwrap_or(line).split_once('|')?;
    (!is_allowed(license, allowed)).then(|| format!("{package}: the license {license:?} is not allowed"))
}

/// Whether an SPDX expression can be met by allowed licenses; `/` is an old way to write `OR`.
fn is_allowed(expression: &str, allowed: &[&str]) -> bool {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let mut words = spaced.split_whitespace().peekable();
    any(&mut words, allowed) && words.next().is_none()
}

fn any<'a>(words: &mut Peekable<impl Iterator<Item = &'a str>>, allowed: &[&str]) -> bool {
    let mut is_met = all(words, allowed);
    while words.next_if_eq(&"OR").is_some() {
        is_met |= all(words, allowed);
    }
    is_met
}

fn all<'a>(words: &mut Peekable<impl Iterator<Item = &'a str>>, allowed: &[&str]) -> bool {
    let mut is_met = one(words, allowed);
    while words.next_if_eq(&"AND").is_some() {
        is_met &= one(words, allowed);
    }
    is_met
}

/// A license, or an expression in parentheses. A license with an exception counts as another one.
fn one<'a>(words: &mut Peekable<impl Iterator<Item = &'a str>>, allowed: &[&str]) -> bool {
    match words.next() {
        Some("(") => {
            let is_met = any(words, allowed);
            words.next() == Some(")") && is_met
        }
        Some(name) if words.next_if_eq(&"WITH").is_some() => {
            let exception = words.next().unwrap_or_default();
            allowed.contains(&format!("{name} WITH {exception}").as_str())
        }
        Some(name) => allowed.contains(&name),
        None => false,
    }
}

/// Lines of the lock file that name another source than crates.io.
fn foreign_sources(lock: &str) -> impl Iterator<Item = String> {
    lock.lines().filter(|line| line.starts_with("source = ") && *line != SOURCE).map(str::to_owned)
}

/// Lines of a manifest that take any version of a package.
fn wildcards(manifest: &str) -> impl Iterator<Item = &str> {
    manifest.lines().filter(|line| line.contains("\"*\"") && !line.starts_with('['))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALLOWED: [&str; 3] = ["MIT", "Zlib", "Unicode-3.0"];

    #[test]
    fn expressions_are_met_or_not() {
        for met in ["MIT", "MIT/Apache-2.0", "GPL-3.0 OR MIT", "(MIT OR GPL-3.0) AND Unicode-3.0"] {
            assert!(is_allowed(met, &ALLOWED), "{met}");
        }
        for unmet in [
            "",
            "GPL-3.0",
            "MIT AND GPL-3.0",
            "MIT WITH Some-exception",
            "(MIT OR GPL-3.0) AND Apache-2.0",
            "GPL-3.0 OR MIT AND Apache-2.0",
            "(MIT",
            "MIT Zlib",
            "MIT AND",
        ] {
            assert!(!is_allowed(unmet, &ALLOWED), "{unmet}");
        }
    }

    #[test]
    fn faults_are_found() {
        assert_eq!(
            allowed_licenses("x = 1\nallow = [\n    \"MIT\",\n    # Why.\n    \"Zlib\",\n]\n"),
            ["MIT", "Zlib"]
        );
        for good in ["good v1.0.0|MIT", "good v1.0.0|MIT (*)"] {
            assert_eq!(license_fault(good, &ALLOWED), None, "{good}");
        }
        assert_eq!(license_fault("", &ALLOWED), None);
        assert!(
            license_fault("bad v1.0.0|GPL-3.0", &ALLOWED).is_some_and(|fault| fault.contains("bad v1.0.0"))
        );
        let lock = format!("{SOURCE}\nsource = \"git+https://example.org/x\"\n");
        assert_eq!(foreign_sources(&lock).collect::<Vec<_>>(), ["source = \"git+https://example.org/x\""]);
        let manifest = "[profile.dev.package.\"*\"]\nglam = \"*\"\nmembers = [\"crates/*\"]\n";
        assert_eq!(wildcards(manifest).collect::<Vec<_>>(), ["glam = \"*\""]);
    }
}
