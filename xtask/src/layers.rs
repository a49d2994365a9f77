//! The tracer's layers, as tests: who may import whom, and no circle between modules.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::tidy::rust_files;
use xtask::root;

/// The layers, each of which may import those before it: the table in docs/dev/tracer.md.
const LAYERS: [&str; 5] = ["simd", "geometry", "transport", "raster", "shaders"];

/// The modules that each module imports. A module is a layer's own file or a file in its folder, with all below it.
type Imports = BTreeMap<String, BTreeSet<String>>;

/// The code of a file without comments and without its tests, which may look anywhere.
fn code_of(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let is_tests = |at: usize| {
        lines[at] == "#[cfg(test)]"
            && lines.get(at + 1).is_some_and(|next| next.ends_with("mod tests {") && !next.starts_with(' '))
    };
    let end = (0..lines.len()).find(|&at| is_tests(at)).unwrap_or(lines.len());
    lines[..end].iter().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// The first two names of each path that begins with `crate::`; those in braces one by one.
fn paths_in(code: &str) -> Vec<(String, Option<String>)> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let name = |text: &str| text.chars().take_while(|&c| is_name(c)).collect::<String>();
    let mut found = Vec::new();
    for part in code.split("crate::").skip(1) {
        let layer = name(part);
        match part[layer.len()..].strip_prefix("::") {
            Some(rest) if rest.starts_with('{') => {
                let inner = rest[1..].split('}').next().unwrap_or_default();
                found.extend(inner.split(',').map(|leaf| (layer.clone(), Some(name(leaf.trim_start())))));
            }
            Some(rest) => found.push((layer, Some(name(rest)))),
            None => found.push((layer, None)),
        }
    }
    found
}

fn imports() -> Imports {
    let source = root().join("crates/tracer/src");
    let mut files = Vec::new();
    rust_files(&source, &mut files);
    let mut all = Imports::new();
    for file in files {
        let path = file.strip_prefix(&source).unwrap().with_extension("");
        let names: Vec<String> = path.iter().map(|name| name.to_string_lossy().into_owned()).collect();
        if names == ["lib"] || names.last().is_some_and(|name| name == "tests") {
            continue;
        }
        let module = names.iter().take(2).map(String::as_str).collect::<Vec<_>>().join("/");
        let imported =
            paths_in(&code_of(&fs::read_to_string(&file).unwrap())).into_iter().map(|path| match path {
                (layer, Some(name)) if source.join(&layer).join(format!("{name}.rs")).exists() => {
                    format!("{layer}/{name}")
                }
                (layer, _) => layer,
            });
        all.entry(module.clone()).or_default().extend(imported.filter(|other| *other != module));
    }
    all
}

fn layer(module: &str) -> usize {
    let name = module.split('/').next().unwrap_or_default();
    LAYERS.iter().position(|layer| *layer == name).unwrap_or_else(|| panic!("{module} is in no layer"))
}

/// Some circle among the modules, if there is one: what is left once those without imports are taken away again and again.
fn circle(imports: &Imports) -> Vec<String> {
    let mut left = imports.clone();
    loop {
        let before = left.len();
        let known: BTreeSet<String> = left.keys().cloned().collect();
        left.retain(|_, imported| imported.iter().any(|module| known.contains(module)));
        if left.len() == before {
            return left.into_keys().collect();
        }
    }
}

#[test]
fn layers_import_only_those_before_them() {
    assert!(Path::new(&root().join("crates/tracer/src/geometry.rs")).exists());
    let imports = imports();
    assert!(imports.len() > 40, "only {} modules were found", imports.len());
    for (module, imported) in &imports {
        for other in imported {
            assert!(layer(other) <= layer(module), "{module} imports {other}, of a later layer");
        }
    }
}

#[test]
fn modules_import_each_other_in_no_circle() {
    assert_eq!(circle(&imports()), Vec::<String>::new());
}

#[test]
fn imports_and_circles_are_found() {
    let code = code_of(
        "use crate::simd::{Mask as _, vector::Vector};\nuse crate::transport::tile::TILE; // crate::no\n\
         #[cfg(test)]\npub(crate) mod tests {\n    use crate::raster::Method;\n}\n",
    );
    let path = |layer: &str, name: &str| (layer.to_owned(), Some(name.to_owned()));
    assert_eq!(paths_in(&code), [path("simd", "Mask"), path("simd", "vector"), path("transport", "tile")]);
    let graph = |edges: &[(&str, &str)]| {
        let mut imports = Imports::new();
        for (from, to) in edges {
            imports.entry((*from).to_owned()).or_default().insert((*to).to_owned());
            imports.entry((*to).to_owned()).or_default();
        }
        circle(&imports)
    };
    assert_eq!(graph(&[("a", "b"), ("b", "c")]), Vec::<String>::new());
    assert_eq!(graph(&[("a", "b"), ("b", "c"), ("c", "b")]), ["a", "b", "c"]);
}
