//! The studio as static files for browsers.

use std::collections::BTreeMap;
use std::fs;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail, ensure};
use brotli::enc::BrotliEncoderParams;
use flate2::Compression;
use flate2::write::GzEncoder;
use wasm_bindgen_cli_support::Bindgen;

use crate::ci::{has_library, library_advice, step};
use xtask::root;
use xtask::shell::{self, command, exists, output};

const TARGET: &str = "wasm32-unknown-unknown";

/// What is wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct WebTask {
    /// The site is there already.
    is_made: bool,
    /// Binaryen makes the programs smaller and quicker, which takes minutes.
    is_small: bool,
    /// The site is driven in Chromium.
    is_checked: bool,
    /// Its size, start and speed are measured in Chromium.
    is_measured: bool,
}

impl WebTask {
    /// What these arguments ask for; `None` when one of them is wrong.
    pub(crate) fn of(words: &[&str]) -> Option<Self> {
        let mut task = Self::default();
        for word in words {
            match *word {
                "--made" => task.is_made = true,
                "--small" => task.is_small = true,
                "--check" => task.is_checked = true,
                "--measure" => task.is_measured = true,
                _ => return None,
            }
        }
        Some(task)
    }
}

/// One of the programs: browsers share memory between workers only on pages that are isolated from others, and not all have
/// vectors that leave the rounding to the processor (relaxed SIMD), which are quicker.
struct Flavor {
    folder: &'static str,
    /// For which pages it is.
    purpose: &'static str,
    features: &'static str,
    link_arguments: &'static [&'static str],
    /// Whether the standard library has to be built with these features, too.
    builds_std: bool,
    /// Crates that may use relaxed SIMD.
    relaxed: &'static [&'static str],
}

const SINGLE: Flavor = Flavor {
    folder: "single",
    purpose: "for pages that may not share memory",
    features: "+simd128",
    link_arguments: &["-zstack-size=4194304"],
    builds_std: false,
    relaxed: &[],
};

const SHARED: &[&str] = &[
    "-zstack-size=4194304",
    "--shared-memory",
    "--import-memory",
    "--max-memory=4294967296",
    "--export=__wasm_init_tls",
    "--export=__tls_size",
    "--export=__tls_align",
    "--export=__tls_base",
];

const THREADS: Flavor = Flavor {
    folder: "threads",
    purpose: "for pages that may",
    features: "+simd128,+atomics,+bulk-memory",
    link_arguments: SHARED,
    builds_std: true,
    relaxed: &[],
};

// The tracer and its vectors alone: in letters that the toolkit draws so, shapes break (`vello_common` 0.2).
const RELAXED: Flavor = Flavor {
    folder: "relaxed",
    purpose: "the same with quicker vectors",
    relaxed: &["catoptric-tracer", "fearless_simd@1"],
    ..THREADS
};

const FLAVORS: [&Flavor; 3] = [&SINGLE, &THREADS, &RELAXED];

/// Does what is wanted, and says what had to be left out.
pub(crate) fn run(task: WebTask) -> Result<()> {
    if !task.is_made {
        make(task.is_small)?;
    }
    for (is_wanted, script) in [(task.is_checked, "check.mjs"), (task.is_measured, "measure.mjs")] {
        if is_wanted && let Some(reason) = drive(script)? {
            println!("skipped: the laboratory in Chromium: {reason}");
        }
    }
    Ok(())
}

/// Drives the laboratory in Chromium by a script; says why that cannot be done, if so.
fn drive(script: &str) -> Result<Option<String>> {
    let Some(tools) = tools("playwright-core", PLAYWRIGHT) else {
        return Ok(Some("there is no npm to install Playwright with".to_owned()));
    };
    let chromium = ["chromium", "chromium-browser", "google-chrome"];
    let Some(chromium) = chromium.into_iter().find(|name| exists(name, "--version")) else {
        return Ok(Some("Chromium is not installed (apt-get install chromium)".to_owned()));
    };
    let path = output(&mut command("which", &[chromium]))?;
    // Its pictures are held against the browser's. The README's first command builds just this one.
    let slim = ["--package", "catoptric", "--release", "--locked", "--no-default-features"];
    shell::run(&mut command("cargo", &[&["build"], &slim[..]].concat()))?;
    let program = target_folder()?.join("release").join(format!("catoptric{}", std::env::consts::EXE_SUFFIX));
    // Where the imports of the scripts find Playwright.
    let folder = root().join("crates/web/check");
    for entry in fs::read_dir(&folder)? {
        let path = entry?.path();
        if let Some(name) = path.file_name() {
            fs::copy(&path, tools.join(name))?;
        }
    }
    let mut node = command("node", &[]);
    node.arg(tools.join(script)).arg(root().join("target/web")).arg(path.trim()).arg(program);
    shell::run(node.arg(root().join("target/web-check")))?;
    Ok(None)
}

/// Makes `target/web`.
fn make(is_small: bool) -> Result<()> {
    let folder = root().join("target/web");
    if folder.exists() {
        fs::remove_dir_all(&folder).with_context(|| format!("cannot empty {}", folder.display()))?;
    }
    fs::create_dir_all(&folder)?;
    copy_page(&folder)?;
    let no_source = why_no_source()?;
    let has_library = has_library(TARGET)?;
    if let Some(reason) = &no_source {
        ensure!(has_library, "{TARGET}: {}", library_advice(TARGET));
        println!("skipped: several threads: {reason}");
    }
    let flavors: Vec<_> =
        FLAVORS.into_iter().filter(|flavor| !flavor.builds_std || no_source.is_none()).collect();
    let steps = flavors.len() + 1;
    println!(
        "The site has {} programs and a first page. Made for the first time, it takes ten to twenty minutes on two cores; \
         later, only what has changed.",
        flavors.len()
    );
    for (index, flavor) in flavors.into_iter().enumerate() {
        step(&format!("{} of {steps}: {}, {}", index + 1, flavor.folder, flavor.purpose), || {
            build(flavor, &folder, flavor.builds_std || !has_library, is_small)
        })?;
    }
    let told = FLAVORS.map(|flavor| {
        let bytes = fs::metadata(program(flavor, &folder)).map(|found| found.len());
        let value = bytes.map_or("null".to_owned(), |bytes| format!("{{ bytes: {bytes} }}"));
        format!("{}: {value}", flavor.folder)
    });
    fs::write(folder.join("build.js"), format!("export const programs = {{ {} }};\n", told.join(", ")))?;
    step(&format!("{steps} of {steps}: the first page, with pictures by the native program"), || {
        shell::run(command("cargo", &["run", "--package", "workbench", "--", "front-page"]).arg(&folder))
    })?;
    write_manual(&folder)?;
    write_service_worker(&folder)?;
    compress(&folder)?;
    println!("{}", folder.display());
    Ok(())
}

/// Why the standard library cannot be built, if so: with threads, it must be.
fn why_no_source() -> Result<Option<String>> {
    let sysroot = output(&mut command("rustc", &["--print", "sysroot"]))?;
    let source = Path::new(sysroot.trim()).join("lib/rustlib/src/rust/library/std");
    let advice = "the source of the standard library is not there (rustup component add rust-src)";
    Ok((!source.exists()).then(|| advice.to_owned()))
}

fn build(flavor: &Flavor, folder: &Path, builds_std: bool, is_small: bool) -> Result<()> {
    // One folder: cargo keeps apart what has other flags, and builds once what runs here, macros and build scripts.
    let target = target_folder()?.join("web-build");
    let mut cargo =
        command("cargo", &["build", "--package", "catoptric-web", "--locked", "--profile", "web"]);
    cargo.args(["--target", TARGET, "--target-dir"]).arg(&target);
    if !flavor.relaxed.is_empty() {
        cargo.args(["-Z", "profile-rustflags"]);
    }
    for package in flavor.relaxed {
        let flag = r#"["-Ctarget-feature=+relaxed-simd"]"#;
        cargo.arg("--config").arg(format!("profile.web.package.\"{package}\".rustflags={flag}"));
    }
    let mut flags = vec![format!("-Ctarget-feature={}", flavor.features)];
    flags.extend(flavor.link_arguments.iter().map(|argument| format!("-Clink-arg={argument}")));
    flags.extend(crate_folders().iter().map(|folder| format!("--remap-path-prefix={}/=", folder.display())));
    if flavor.builds_std {
        cargo.args(["--features", "threads"]);
    }
    if builds_std {
        // A stable compiler builds its own library only if it is told that it may.
        cargo.args(["-Z", "build-std=std,panic_abort"]).env("RUSTC_BOOTSTRAP", "1");
        // What a panic says of its place: the column would be another number for each place that may panic.
        flags.push("-Zlocation-detail=file,line".to_owned());
    }
    cargo.env("CARGO_ENCODED_RUSTFLAGS", flags.join("\x1f"));
    shell::run(&mut cargo)?;
    let program = target.join(TARGET).join("web/catoptric_web.wasm");
    let out = folder.join(flavor.folder);
    let mut bindgen = Bindgen::new();
    bindgen.input_path(&program).out_name("studio").typescript(false).remove_name_section(true);
    bindgen.web(true)?.generate(&out).with_context(|| format!("cannot bind {}", program.display()))?;
    if is_small { make_small(&self::program(flavor, folder)) } else { Ok(()) }
}

/// Where cargo unpacks crates: what a panic says of its place is none of that.
fn crate_folders() -> Vec<PathBuf> {
    let own = std::env::home_dir().map(|home| home.join(".cargo"));
    let Some(home) = std::env::var_os("CARGO_HOME").map(PathBuf::from).or(own) else { return Vec::new() };
    let entries = fs::read_dir(home.join("registry/src")).into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).collect()
}

/// The program, ready to be loaded.
fn program(flavor: &Flavor, folder: &Path) -> PathBuf {
    folder.join(flavor.folder).join("studio_bg.wasm")
}

/// Where cargo builds.
fn target_folder() -> Result<PathBuf> {
    let told = output(&mut command("cargo", &["metadata", "--no-deps", "--format-version", "1"]))?;
    let after = told.split("\"target_directory\":\"").nth(1).context("cargo told no target folder")?;
    Ok(after.split('"').next().unwrap_or_default().into())
}

/// Lets Binaryen make the program smaller and quicker, where it can be had.
fn make_small(program: &Path) -> Result<()> {
    let Some(tools) = tools("binaryen", BINARYEN) else {
        println!("skipped: optimization by Binaryen: there is no npm to install it with");
        return Ok(());
    };
    let mut optimize = Command::new(tools.join("node_modules/.bin/wasm-opt"));
    optimize.args(["-O2", "--all-features"]).arg(program).arg("-o").arg(program);
    shell::run(&mut optimize)
}

const BINARYEN: &str = "132.0.0";
const PLAYWRIGHT: &str = "1.65.1";

/// The folder of the tools that npm installs for this repository, with this package in it; `None` if it cannot be had.
fn tools(package: &str, version: &str) -> Option<PathBuf> {
    let folder = root().join("target/web-tools");
    if !folder.join("node_modules").join(package).exists() {
        fs::create_dir_all(&folder).ok()?;
        let manifest = folder.join("package.json");
        if !manifest.exists() {
            fs::write(manifest, "{}\n").ok()?;
        }
        let mut install = command("npm", &["install", "--silent", "--no-audit", "--no-fund"]);
        shell::run(install.arg(format!("{package}@{version}")).current_dir(&folder)).ok()?;
    }
    Some(folder)
}

fn copy_page(folder: &Path) -> Result<()> {
    let page = root().join("crates/web/page");
    for entry in fs::read_dir(&page)? {
        let path = entry?.path();
        if let Some(name) = path.file_name() {
            fs::copy(&path, folder.join(name))?;
        }
    }
    Ok(())
}

/// Writes the pages of the manual, which the studio on a page does not bring along: pairs of path and text.
fn write_manual(folder: &Path) -> Result<()> {
    fs::create_dir_all(folder.join("manual"))?;
    for language in ["en", "ru"] {
        let (documents, mut files) = (root().join("docs").join(language), BTreeMap::new());
        collect(&documents, &documents, &mut files)?;
        files.retain(|name, _| name.ends_with(".md"));
        let pages: Vec<_> =
            files.iter().map(|(name, bytes)| (name, String::from_utf8_lossy(bytes))).collect();
        fs::write(folder.join(format!("manual/{language}.json")), serde_json::to_vec(&pages)?)?;
    }
    Ok(())
}

/// Writes packed copies beside the files, for servers that hand those out.
fn compress(folder: &Path) -> Result<()> {
    let mut files = BTreeMap::new();
    collect(folder, folder, &mut files)?;
    let is_packed = |name: &str| name.ends_with(".jpg") || name.ends_with(".png");
    for (name, bytes) in files.iter().filter(|(name, _)| !is_packed(name)) {
        let mut gz = GzEncoder::new(Vec::new(), Compression::best());
        gz.write_all(bytes)?;
        fs::write(folder.join(format!("{name}.gz")), gz.finish()?)?;
        let mut br = Vec::new();
        let parameters = BrotliEncoderParams { quality: 11, lgwin: 24, ..BrotliEncoderParams::default() };
        brotli::BrotliCompress(&mut bytes.as_slice(), &mut br, &parameters)?;
        println!("{name}: {} bytes, {} packed", bytes.len(), br.len());
        fs::write(folder.join(format!("{name}.br")), br)?;
    }
    Ok(())
}

/// Tells the service worker which files there are, and a name for just these contents.
fn write_service_worker(folder: &Path) -> Result<()> {
    let mut files = BTreeMap::new();
    collect(folder, folder, &mut files)?;
    let mut hasher = DefaultHasher::new();
    files.hash(&mut hasher);
    let names: Vec<String> =
        files.keys().filter(|name| *name != "service-worker.js").map(|name| format!("{name:?}")).collect();
    let path = folder.join("service-worker.js");
    let script = fs::read_to_string(&path)?;
    let (version, list) = (format!("{:016x}", hasher.finish()), format!("[{}]", names.join(", ")));
    let told = script.replace("\"VERSION\"", &format!("\"{version}\"")).replace("[\"FILES\"]", &list);
    if told == script {
        bail!("the service worker has no place for its files");
    }
    fs::write(path, told)?;
    Ok(())
}

fn collect(folder: &Path, root: &Path, files: &mut BTreeMap<String, Vec<u8>>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, root, files)?;
        } else {
            let name = path.strip_prefix(root)?.to_string_lossy().replace('\\', "/");
            files.insert(name, fs::read(&path)?);
        }
    }
    Ok(())
}
