//! The pages of the manual: the documents of the repository, part of the program. A page in a browser loads them once the
//! studio is there, so that they do not keep it waiting.

use std::borrow::Cow;

use crate::base::texts::Language;

/// A document in both languages.
pub(super) struct ManualDocument {
    /// The path below the folder of a language.
    pub(super) path: &'static str,
    #[cfg(not(target_family = "wasm"))]
    english: &'static str,
    #[cfg(not(target_family = "wasm"))]
    russian: &'static str,
}

macro_rules! sources {
    ($($path:literal),+ $(,)?) => {
        [$(ManualDocument {
            path: $path,
            #[cfg(not(target_family = "wasm"))]
            english: include_str!(concat!("../../../../../docs/en/", $path)),
            #[cfg(not(target_family = "wasm"))]
            russian: include_str!(concat!("../../../../../docs/ru/", $path)),
        }),+]
    };
}

/// All documents, in the order in which to list them.
pub(super) const SOURCES: &[ManualDocument] = &sources![
    "studio.md",
    "browser.md",
    "scene-format.md",
    "exchange.md",
    "check-your-tracer.md",
    "materials.md",
    "surroundings.md",
    "model.md",
    "audit.md",
    "methods/README.md",
    "methods/ssr.md",
    "methods/cube-map.md",
    "methods/phong.md",
    "methods/gouraud.md",
    "methods/flat.md",
    "compare.md",
    "measure.md",
    "command-line.md",
    "gpu.md",
];

impl ManualDocument {
    /// The document's text in a language; `None` while it is still loaded.
    #[cfg(not(target_family = "wasm"))]
    #[expect(clippy::unnecessary_wraps, reason = "a browser has to load it")]
    pub(super) const fn text(&self, language: Language) -> Option<Cow<'static, str>> {
        Some(Cow::Borrowed(match language {
            Language::English => self.english,
            Language::Russian => self.russian,
        }))
    }

    /// The document's text in a language; `None` while it is still loaded.
    #[cfg(target_family = "wasm")]
    pub(super) fn text(&self, language: Language) -> Option<Cow<'static, str>> {
        let path = std::path::Path::new("/manual").join(language.letters().to_lowercase()).join(self.path);
        let bytes = catoptric_platform::files::read_bytes(&path, u64::MAX).ok()?;
        String::from_utf8(bytes).ok().map(Cow::Owned)
    }

    /// Whether it belongs to the one listed before it that stands for its folder.
    pub(super) fn is_below(&self) -> bool {
        self.path.contains('/') && !self.path.ends_with("README.md")
    }
}

/// The place in [`SOURCES`] of the document that `link` names on the page at `path`, if it is one of them.
pub(super) fn find(path: &str, link: &str) -> Option<usize> {
    let mut parts: Vec<&str> = path.split('/').collect();
    parts.pop();
    for part in link.split('/') {
        match part {
            "." | "" => {}
            ".." => {
                parts.pop()?;
            }
            other => parts.push(other),
        }
    }
    let whole = parts.join("/");
    SOURCES.iter().position(|source| source.path == whole)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    use super::*;

    fn files(folder: &Path, prefix: &str, into: &mut BTreeSet<String>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = format!("{prefix}{}", path.file_name().unwrap().to_str().unwrap());
            if path.is_dir() {
                files(&path, &format!("{name}/"), into);
            } else if name.ends_with(".md") {
                into.insert(name);
            }
        }
    }

    #[test]
    fn every_document_is_a_page() {
        let listed: BTreeSet<String> = SOURCES.iter().map(|source| source.path.to_owned()).collect();
        assert_eq!(listed.len(), SOURCES.len());
        for language in ["en", "ru"] {
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(language);
            let mut found = BTreeSet::new();
            files(&folder, "", &mut found);
            assert_eq!(found, listed, "docs/{language}");
        }
    }

    #[test]
    fn paths_of_links_are_followed() {
        let path = |page, link| find(page, link).map(|place| SOURCES[place].path);
        assert_eq!(path("studio.md", "methods/README.md"), Some("methods/README.md"));
        assert_eq!(path("methods/ssr.md", "../model.md"), Some("model.md"));
        assert_eq!(path("methods/ssr.md", "flat.md"), Some("methods/flat.md"));
        assert_eq!(path("studio.md", "../README.md"), None);
        assert_eq!(path("studio.md", "../../README.md"), None);
    }
}
