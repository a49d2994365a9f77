//! The built-in scenes.

use crate::format::{Diagnostics, LoadedScene, nearest, read};
use crate::image::NoResources;
use crate::language::Language;

/// A scene that comes with the program: something to look at, to learn from, and to start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Example {
    /// The example's name, as on the command line.
    pub name: &'static str,
    /// The scene file's text; it begins with a title in English, one in Russian, and what to notice.
    pub text: &'static str,
}

macro_rules! examples {
    ($($name:literal),+ $(,)?) => {
        [$(Example { name: $name, text: include_str!(concat!("../examples/", $name, ".toml")) }),+]
    };
}

impl Example {
    /// All built-in scenes, in the order in which to show them.
    pub const ALL: &'static [Self] = &examples![
        "four-bodies",
        "whitted",
        "hall-of-mirrors",
        "kaleidoscope",
        "mirror-box",
        "corner-reflector",
        "corner-cubes",
        "ring-of-images",
        "sphereflake",
        "wada-basins",
        "glass-row",
        "lens",
        "optical-bench",
        "nested-glass",
        "total-reflection",
        "tinted-glass",
        "rising-index",
        "prism",
        "metals",
        "roughness-row",
        "soft-shadow",
        "sky-room",
        "textures",
        "anamorphosis",
        "anamorphic-cone",
        "concave-mirror",
        "parabolic-mirror",
        "telescope",
        "falloff",
        "colored-lights",
        "mirror-bowl",
        "cardioid-cup",
        "dice",
        "still-life",
    ];

    /// The built-in scene of this name.
    pub fn find(name: &str) -> Option<&'static Self> {
        Self::ALL.iter().find(|example| example.name == name)
    }

    /// The built-in scene whose name is most like this one, if any is.
    pub fn nearest(name: &str) -> Option<&'static Self> {
        nearest(name, Self::ALL.iter().map(|example| example.name)).and_then(Self::find)
    }

    /// The title in English.
    pub fn title(&self) -> &'static str {
        self.comment_line(0)
    }

    /// The title in Russian.
    pub fn russian_title(&self) -> &'static str {
        self.comment_line(1)
    }

    /// What to notice: a paragraph of the comments at the head of the file.
    pub fn notice(&self, language: Language) -> String {
        let start = language.pick("# What to notice: ", "# На что смотреть: ");
        let mut lines = self.text.lines().skip_while(|line| !line.starts_with(start));
        let first = lines.next().and_then(|line| line.strip_prefix(start));
        let words: Vec<&str> =
            first.into_iter().chain(lines.map_while(|line| line.strip_prefix("# "))).collect();
        let notice = words.join(" ");
        // In the file it goes on after a colon.
        let mut letters = notice.chars();
        letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
    }

    fn comment_line(&self, line: usize) -> &'static str {
        self.text.lines().nth(line).map_or(self.name, |line| line.trim_start_matches('#').trim())
    }

    /// Reads the scene.
    ///
    /// # Errors
    /// None; a test reads every example.
    pub fn load(&self) -> Result<LoadedScene, Diagnostics> {
        let mut reading = read(self.text);
        reading.open_images(&NoResources, self.text);
        let read = reading.into_result()?;
        Ok(LoadedScene { scene: read.value, text: self.text.to_owned(), warnings: read.warnings })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_example_is_listed_and_reads_without_a_finding() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
        let mut files: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        files.sort();
        let mut listed: Vec<String> =
            Example::ALL.iter().map(|example| format!("{}.toml", example.name)).collect();
        listed.sort();
        assert_eq!(files, listed);
        for example in Example::ALL {
            let loaded = example.load().unwrap_or_else(|error| panic!("{}: {error}", example.name));
            assert!(loaded.warnings.is_empty(), "{}: {}", example.name, loaded.warnings);
        }
    }

    #[test]
    fn every_example_has_its_texts_in_the_letters_of_the_language() {
        let is_cyrillic = |letter: char| ('а'..='я').contains(&letter);
        for example in Example::ALL {
            assert!(!example.title().contains(is_cyrillic), "{}", example.title());
            assert!(example.russian_title().contains(is_cyrillic), "{}", example.russian_title());
            for language in Language::ALL {
                let notice = example.notice(language);
                assert!(notice.len() > 40 && !notice.contains('#'), "{}: {notice}", example.name);
                assert!(
                    notice.starts_with(char::is_uppercase) || notice.starts_with(char::is_numeric),
                    "{notice}"
                );
                assert_eq!(notice.contains(is_cyrillic), language == Language::Russian, "{notice}");
            }
        }
    }

    #[test]
    fn a_misspelt_name_finds_its_neighbor() {
        assert_eq!(Example::nearest("whited").map(|example| example.name), Some("whitted"));
        assert_eq!(Example::nearest("xyzzy"), None);
    }
}
