//! The house's own rules, as tests: dependencies of crates, lengths of files and functions, names of types.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use xtask::root;

/// Each crate and the crates of this repository that it may use: the table in ARCHITECTURE.md.
const MAY_USE: &[(&str, &[&str])] = &[
    ("platform", &[]),
    ("optics", &[]),
    ("picture", &["platform"]),
    ("scene", &["optics", "picture"]),
    ("store", &["platform", "picture", "scene"]),
    ("exchange", &["store", "scene"]),
    ("tracer", &["scene", "picture", "optics", "platform"]),
    ("gpu", &["tracer", "picture", "platform"]),
    ("editor", &["store", "scene", "platform"]),
    ("live", &["gpu", "tracer", "scene", "picture", "platform"]),
    ("lab", &["tracer", "store", "scene", "picture", "platform", "optics"]),
    (
        "studio",
        &[
            "lab", "live", "editor", "gpu", "tracer", "exchange", "store", "scene", "picture", "platform",
            "optics",
        ],
    ),
    ("web", &["studio", "live", "lab", "tracer", "exchange", "store", "scene", "picture", "platform"]),
    ("catoptric", &["studio", "lab", "gpu", "tracer", "exchange", "store", "scene", "picture", "platform"]),
];

const LONGEST_FILE: usize = 600;
const LONGEST_FUNCTION: usize = 80;

pub(crate) fn crates() -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join("crates")).unwrap();
    entries.map(|entry| entry.unwrap().path()).filter(|path| path.join("Cargo.toml").exists()).collect()
}

pub(crate) fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

#[test]
fn dependencies_run_down_only() {
    for path in crates() {
        let name = name(&path);
        let Some((_, allowed)) = MAY_USE.iter().find(|(known, _)| *known == name) else {
            panic!("crates/{name} is not in the table of xtask/src/tidy.rs and ARCHITECTURE.md");
        };
        let text = fs::read_to_string(path.join("Cargo.toml")).unwrap();
        let manifest: toml_edit::DocumentMut = text.parse().unwrap();
        for section in ["dependencies", "build-dependencies"] {
            let Some(table) = manifest.get(section).and_then(toml_edit::Item::as_table) else { continue };
            for (dependency, _) in table {
                if let Some(used) = dependency.strip_prefix("catoptric-") {
                    assert!(allowed.contains(&used), "crates/{name} may not use crates/{used}");
                }
            }
        }
    }
}

#[test]
fn architecture_names_every_crate() {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    for path in crates() {
        let name = format!("`crates/{}`", name(&path));
        assert!(text.contains(&name), "ARCHITECTURE.md does not mention {name}");
    }
}

#[test]
fn every_direct_dependency_has_a_reason_in_architecture() {
    let manifest: toml_edit::DocumentMut =
        fs::read_to_string(root().join("Cargo.toml")).unwrap().parse().unwrap();
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let dependencies = manifest["workspace"]["dependencies"].as_table().unwrap();
    let missing: BTreeSet<&str> = dependencies
        .iter()
        .map(|(name, _)| name)
        .filter(|name| !name.starts_with("catoptric-") && !text.contains(&format!("`{name}`")))
        .collect();
    assert!(missing.is_empty(), "ARCHITECTURE.md gives no reason for {missing:?}");
}

pub(crate) fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// A browser has other files, threads and clocks, and the standard library's fail there.
#[test]
fn the_platform_alone_asks_the_system() {
    /// What runs on a desktop only.
    const DESKTOP: [&str; 2] = ["crates/platform/", "crates/catoptric/"];
    let asks = |line: &str| {
        let line = line.trim_start();
        let is_clock = || ["Instant", "SystemTime", "UNIX_EPOCH"].iter().any(|clock| line.contains(clock));
        !line.starts_with("//")
            && (line.contains("std::fs")
                || line.contains("std::process::id")
                || line.contains("temp_dir()")
                || [".exists()", ".is_dir()", ".is_file()"].iter().any(|asks| line.contains(asks))
                || line.contains("std::thread::") && !line.contains("std::thread::panicking")
                || line.contains("std::time") && is_clock())
    };
    let mut files = Vec::new();
    crates().iter().for_each(|path| rust_files(&path.join("src"), &mut files));
    let mut faults = Vec::new();
    for path in files {
        let shown = path.strip_prefix(root()).unwrap().display().to_string();
        let is_test = shown.ends_with("tests.rs") || shown.contains("/tests/");
        if is_test
            || shown.ends_with("host/desktop.rs")
            || DESKTOP.iter().any(|folder| shown.starts_with(folder))
        {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let lines = code.lines().enumerate().filter(|(_, line)| asks(line));
        faults.extend(lines.map(|(number, line)| format!("{shown}:{}: {}", number + 1, line.trim())));
    }
    assert!(faults.is_empty(), "use catoptric_platform instead:\n{}", faults.join("\n"));
}

/// Whoever cites the program says which one it was.
#[test]
fn the_citation_has_the_version_of_the_workspace() {
    let manifest: toml_edit::DocumentMut =
        fs::read_to_string(root().join("Cargo.toml")).unwrap().parse().unwrap();
    let version = manifest["workspace"]["package"]["version"].as_str().unwrap();
    let citation = fs::read_to_string(root().join("CITATION.cff")).unwrap();
    let value = |key: &str| citation.lines().find_map(|line| line.strip_prefix(key)).map(str::trim);
    assert_eq!((value("cff-version:"), value("version:")), (Some("1.2.0"), Some(version)));
}

#[test]
fn files_and_functions_are_short() {
    let mut files = Vec::new();
    for folder in ["crates", "workbench", "xtask"] {
        rust_files(&root().join(folder), &mut files);
    }
    assert!(files.len() > 50, "the walk found only {} files", files.len());
    let mut faults = Vec::new();
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        let shown = path.strip_prefix(root()).unwrap().display().to_string();
        let lines = text.lines().count();
        if lines > LONGEST_FILE {
            faults.push(format!("{shown}: {lines} lines"));
        }
        for (line, length) in long_functions(&text) {
            faults.push(format!("{shown}:{line}: a function of {length} lines"));
        }
    }
    assert!(faults.is_empty(), "too long:\n{}", faults.join("\n"));
}

/// The first line and length of each function that is too long. In formatted code a function ends with a brace in the
/// column where it began; a function that a trait only declares has a semicolon before any brace.
fn long_functions(text: &str) -> Vec<(usize, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        let indent = &line[..line.len() - code.len()];
        let is_function = code.split("fn ").next().is_some_and(|before| {
            code.contains("fn ")
                && before.split_whitespace().all(|word| {
                    word.starts_with("pub") || ["const", "async", "unsafe", "extern"].contains(&word)
                })
        });
        let head = lines[index..].iter().find(|line| line.ends_with(['{', '}', ';']));
        if !is_function || head.is_some_and(|head| head.ends_with(';')) {
            continue;
        }
        let end = format!("{indent}}}");
        if let Some(length) = lines[index..].iter().position(|line| *line == end)
            && length + 1 > LONGEST_FUNCTION
        {
            found.push((index + 1, length + 1));
        }
    }
    found
}

#[test]
fn long_functions_are_found() {
    let body = "    work();\n".repeat(LONGEST_FUNCTION - 1);
    let text = format!("pub(crate) fn long() {{\n{body}}}\n\nfn short() {{\n    work();\n}}\n");
    assert_eq!(long_functions(&text), [(1, LONGEST_FUNCTION + 1)]);
    let declared = "fn one(&self);\n\n    fn two(\n        &self,\n    ) -> u32;\n\n";
    let text =
        format!("trait Long {{\n    {}    fn last(&self) {{}}\n}}\n", declared.repeat(LONGEST_FUNCTION));
    assert_eq!(long_functions(&text), []);
}

#[test]
fn a_type_name_occurs_once_in_a_crate() {
    let mut faults = Vec::new();
    for path in crates().into_iter().chain([root().join("workbench"), root().join("xtask")]) {
        let crate_name = name(&path);
        let mut files = Vec::new();
        rust_files(&path.join("src"), &mut files);
        let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for file in files.iter().filter(|file| !is_test_file(file)) {
            let shown = file.strip_prefix(root()).unwrap().display().to_string();
            for type_name in type_names(&fs::read_to_string(file).unwrap()) {
                places.entry(type_name).or_default().push(shown.clone());
            }
        }
        assert!(!places.is_empty(), "no type was found in {crate_name}");
        let shared = places.into_iter().filter(|(_, files)| files.len() > 1);
        faults.extend(shared.map(|(type_name, files)| format!("{type_name}: {}", files.join(", "))));
    }
    assert!(faults.is_empty(), "types of one crate share a name:\n{}", faults.join("\n"));
}

/// True for `tests.rs` and for files in a folder `tests`.
fn is_test_file(path: &Path) -> bool {
    path.file_stem().is_some_and(|stem| stem == "tests") || path.iter().any(|part| part == "tests")
}

/// The names of the types that formatted code defines. Types of test modules and associated types are left out, and a
/// type with one definition for each platform counts once.
fn type_names(text: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        if line == "#[cfg(test)]" && lines.peek().is_some_and(|next| next.ends_with('{')) {
            lines.by_ref().find(|line| *line == "}");
            continue;
        }
        let words: Vec<&str> = line.split_whitespace().skip_while(|word| word.starts_with("pub")).collect();
        let is_alias = words.first() == Some(&"type") && !line.starts_with(' ');
        if let [keyword, head, ..] = words[..]
            && (is_alias || ["struct", "enum", "union", "trait"].contains(&keyword))
        {
            let end = head.find(|letter: char| !letter.is_alphanumeric() && letter != '_');
            names.insert(head[..end.unwrap_or(head.len())].to_owned());
        }
    }
    names
}

#[test]
fn defined_types_are_found() {
    let text = "\
pub(crate) struct Disk<T>(T);

enum Color {
    Red,
}

pub trait Walk: Sized {
    type Item;
}

type Pair<T> = (T, T);

/// A struct Mentioned in a comment.
fn main() {
    struct Inner;
}

#[cfg(test)]
mod tests {
    struct Helper;
}

union Word {
    number: u32,
}
";
    let expected = ["Color", "Disk", "Inner", "Pair", "Walk", "Word"];
    assert!(type_names(text).iter().eq(expected), "{:?}", type_names(text));
}
