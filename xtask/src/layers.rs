//! Who imports whom, as tests: no circle between the modules of a crate, and layers that import only earlier ones.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::fs;
use std::path::{Path, PathBuf};

use crate::tidy::{crates, name, rust_files};
use xtask::root;

/// The crates whose modules lie in layers, each of which may import those before it: the tables in docs/dev.
const LAYERED: &[(&str, &[&str])] = &[
    ("tracer", &["simd", "geometry", "transport", "raster", "shaders"]),
    ("studio", &["base", "state", "panels", "shell"]),
];

/// For each module the modules that it imports, each with the files that do. A module is a file of the crate, or of a
/// layer, with all below it; `lib` or `main` has what the crate's root itself defines.
type Imports = BTreeMap<String, BTreeMap<String, BTreeSet<String>>>;

/// The source of a crate.
struct Source {
    folder: PathBuf,
    layers: &'static [&'static str],
    /// The names that the root takes from modules, and those modules.
    reexports: BTreeMap<String, String>,
    /// The module of the root: `lib`, or `main` of a program.
    root: &'static str,
}

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

fn is_name(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

/// The paths of a tree such as `a::{b, c::{self, d}}` at the beginning of `code`, as far as they go.
fn tree(code: &str) -> Vec<Vec<String>> {
    let code = code.trim_start();
    if let Some(inner) = code.strip_prefix('{') {
        let (mut depth, mut start, mut paths) = (0, 0, Vec::new());
        for (at, letter) in inner.char_indices() {
            match letter {
                '{' => depth += 1,
                '}' if depth > 0 => depth -= 1,
                ',' | '}' if depth == 0 => {
                    paths.extend(tree(&inner[start..at]).into_iter().filter(|path| !path.is_empty()));
                    start = at + 1;
                    if letter == '}' {
                        break;
                    }
                }
                _ => {}
            }
        }
        return paths;
    }
    let first: String = code.chars().take_while(|&letter| is_name(letter)).collect();
    if first.is_empty() {
        return vec![Vec::new()];
    }
    let rest = code[first.len()..].strip_prefix("::").map_or_else(|| vec![Vec::new()], tree);
    let with_first = |rest: Vec<String>| [first.clone()].into_iter().chain(rest).collect();
    rest.into_iter().map(with_first).collect()
}

/// How many modules within the file stand around a place of its code.
fn inline_modules(code: &str, at: usize) -> usize {
    let mut open: Vec<&str> = Vec::new();
    for line in code[..at].lines() {
        let statement = line.trim_start();
        let indent = &line[..line.len() - statement.len()];
        let words: Vec<&str> = statement.split_whitespace().collect();
        if words.len() >= 3 && words[words.len() - 3] == "mod" && statement.ends_with('{') {
            open.push(indent);
        } else if statement == "}" && open.last() == Some(&indent) {
            open.pop();
        }
    }
    open.len()
}

/// The paths in `code` that begin with `crate` or `super`, from the crate's root on, for a module at `own`.
fn paths_in(code: &str, own: &[String]) -> Vec<Vec<String>> {
    let mut paths = Vec::new();
    for start in ["crate::", "super::"] {
        for (at, _) in code.match_indices(start) {
            if code[..at].ends_with(|letter| is_name(letter) || letter == ':' || letter == '$') {
                continue;
            }
            for path in tree(&code[at..]) {
                let ups = path.iter().take_while(|part| *part == "super").count();
                let up = ups.saturating_sub(if ups > 0 { inline_modules(code, at) } else { 0 });
                let base = if ups > 0 { &own[..own.len().saturating_sub(up)] } else { &[] };
                let rest = path.into_iter().skip(ups.max(1));
                paths.push(base.iter().cloned().chain(rest).collect());
            }
        }
    }
    paths
}

impl Source {
    fn of(krate: &Path) -> Self {
        let folder = krate.join("src");
        let known = LAYERED.iter().find(|(layered, _)| *layered == name(krate));
        let layers = known.map_or(&[] as &[_], |(_, layers)| layers);
        let root = if folder.join("lib.rs").exists() { "lib" } else { "main" };
        let mut source = Self { folder, layers, reexports: BTreeMap::new(), root };
        let code = source.read(&source.folder.join(format!("{root}.rs")));
        for (at, _) in code.match_indices("use ") {
            for path in tree(&code[at + 4..]) {
                if let (Some(module), Some(last)) = (source.module(&path), path.last()) {
                    source.reexports.insert(last.clone(), module);
                }
            }
        }
        source
    }

    fn read(&self, file: &Path) -> String {
        code_of(&fs::read_to_string(file).unwrap())
    }

    fn has(&self, module: &str) -> bool {
        self.folder.join(module).with_extension("rs").exists()
    }

    /// The module in which a path of the crate leads.
    fn module(&self, path: &[String]) -> Option<String> {
        let first = path.first()?;
        if !self.has(first) {
            return None;
        }
        let second = path.get(1).map(|second| format!("{first}/{second}"));
        let is_layer = self.layers.contains(&first.as_str());
        Some(second.filter(|second| is_layer && self.has(second)).unwrap_or_else(|| first.clone()))
    }

    /// The modules that the code of a root uses for what it defines; what it only passes on counts as its module's.
    fn used_by_root(&self, code: &str) -> BTreeSet<String> {
        let statements = code.split_inclusive(';');
        let own: String = statements
            .filter(|statement| {
                let first = statement.trim_start();
                !["use ", "pub use ", "mod ", "pub mod ", "pub(crate) use "]
                    .iter()
                    .any(|word| first.starts_with(word))
            })
            .collect();
        let words = own.split(|letter| !is_name(letter)).collect::<BTreeSet<_>>();
        let taken = self.reexports.iter().filter(|(word, _)| words.contains(word.as_str()));
        let named = words.iter().filter(|word| self.has(word) && own.contains(&format!("{word}::")));
        taken.map(|(_, module)| module.clone()).chain(named.map(|word| (*word).to_owned())).collect()
    }

    fn imports(&self) -> Imports {
        let mut files = Vec::new();
        rust_files(&self.folder, &mut files);
        let mut all = Imports::new();
        for file in files {
            let shown = file.strip_prefix(&self.folder).unwrap();
            let own: Vec<String> =
                shown.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
            if own.last().is_some_and(|last| last == "tests") || own == ["main"] && self.root != "main" {
                continue;
            }
            let code = self.read(&file);
            let (module, imported) = if own == [self.root] {
                (self.root.to_owned(), self.used_by_root(&code))
            } else {
                let target = |path: Vec<String>| {
                    let first = path.first()?;
                    let found = self.module(&path).or_else(|| self.reexports.get(first).cloned());
                    Some(found.unwrap_or_else(|| self.root.to_owned()))
                };
                let paths = paths_in(&code, &own).into_iter();
                (self.module(&own).unwrap(), paths.filter_map(target).collect())
            };
            let entry = all.entry(module.clone()).or_default();
            for other in imported.into_iter().filter(|other| *other != module) {
                entry.entry(other).or_default().insert(shown.display().to_string());
            }
        }
        all
    }

    fn layer(&self, module: &str) -> Option<usize> {
        let first = module.split('/').next()?;
        self.layers.iter().position(|layer| *layer == first)
    }
}

/// The shortest way from a module back to itself: the modules on it, the first one last again.
fn way_back(imports: &Imports, module: &str) -> Option<Vec<String>> {
    let mut before: BTreeMap<&str, &str> = BTreeMap::new();
    let mut queue = VecDeque::from([module]);
    while let Some(here) = queue.pop_front() {
        for next in imports.get(here).into_iter().flat_map(BTreeMap::keys) {
            if next == module {
                let mut way = vec![module.to_owned()];
                let mut at = here;
                while at != module {
                    way.push(at.to_owned());
                    at = before[at];
                }
                way.push(module.to_owned());
                way.reverse();
                return Some(way);
            }
            if !before.contains_key(next.as_str()) {
                before.insert(next, here);
                queue.push_back(next);
            }
        }
    }
    None
}

/// The shortest circle among the modules, if there is one, with the files that close it.
fn circle(imports: &Imports) -> Option<String> {
    let ways = imports.keys().filter_map(|module| way_back(imports, module));
    let shortest = ways.min_by_key(Vec::len)?;
    let steps = shortest.windows(2).map(|step| {
        let files: Vec<&str> = imports[&step[0]][&step[1]].iter().map(String::as_str).collect();
        format!("{} imports {} ({})", step[0], step[1], files.join(", "))
    });
    Some(steps.collect::<Vec<_>>().join(", "))
}

fn all_crates() -> Vec<PathBuf> {
    let mut all = crates();
    all.extend(["xtask", "workbench"].map(|krate| root().join(krate)));
    all
}

#[test]
fn modules_of_a_crate_import_each_other_in_no_circle() {
    let (mut modules, mut circles) = (0, Vec::new());
    for krate in all_crates() {
        let imports = Source::of(&krate).imports();
        modules += imports.len();
        circles.extend(circle(&imports).map(|circle| format!("{}: {circle}", name(&krate))));
    }
    assert!(circles.is_empty(), "{}", circles.join("\n"));
    assert!(modules > 200, "only {modules} modules were found");
}

#[test]
fn layers_import_only_those_before_them() {
    for (krate, layers) in LAYERED {
        let source = Source::of(&root().join("crates").join(krate));
        let imports = source.imports();
        assert!(imports.len() > 10 * layers.len() / 2, "only {} modules of {krate}", imports.len());
        for (module, imported) in imports.iter().filter(|(module, _)| *module != source.root) {
            let own = source.layer(module);
            assert!(own.is_some(), "{krate}: {module} is in no layer");
            for (other, files) in imported {
                let is_earlier = source.layer(other) <= own && other != source.root;
                assert!(is_earlier, "{krate}: {module} imports {other}, of a later layer ({files:?})");
            }
        }
    }
}

#[test]
fn imports_are_found() {
    let code = code_of(
        "use crate::simd::{Mask as _, vector::{self, Vector}};\nuse crate::transport::tile::TILE; // crate::no\n\
         use super::sibling::Other;\nuse super::super::{above, far::Away};\npub(in crate::simd) fn f() {}\n\
         #[cfg(unix)]\nmod inner {\n    use super::Own;\n}\n\
         macro_rules! m { () => { $crate::no } }\n\
         #[cfg(test)]\npub(crate) mod tests {\n    use crate::raster::Method;\n}\n",
    );
    let own: Vec<String> = ["layer", "module"].map(str::to_owned).into();
    let found: Vec<String> = paths_in(&code, &own).into_iter().map(|path| path.join("/")).collect();
    assert_eq!(
        found,
        [
            "simd/Mask",
            "simd/vector/self",
            "simd/vector/Vector",
            "transport/tile/TILE",
            "simd",
            "layer/sibling/Other",
            "above",
            "far/Away",
            "layer/module/Own"
        ]
    );
}

#[test]
fn circles_are_named_with_their_files() {
    let graph = |edges: &[(&str, &str)]| {
        let mut imports = Imports::new();
        for (from, to) in edges {
            let files = imports.entry((*from).to_owned()).or_default().entry((*to).to_owned()).or_default();
            files.insert(format!("{from}.rs"));
            imports.entry((*to).to_owned()).or_default();
        }
        circle(&imports)
    };
    assert_eq!(graph(&[("a", "b"), ("b", "c"), ("a", "c")]), None);
    let found = graph(&[("a", "b"), ("b", "c"), ("c", "d"), ("d", "b"), ("d", "c")]);
    assert_eq!(found.as_deref(), Some("c imports d (c.rs), d imports c (d.rs)"));
}
