//! The titles of the examples, and what to notice in them.

use catoptric_scene::Example;

use crate::base::texts::Language;

/// The example's title in a language.
pub(crate) fn example_title(example: &Example, language: Language) -> &'static str {
    match language {
        Language::English => example.title(),
        Language::Russian => example.russian_title(),
    }
}

/// What to notice in an example: a paragraph of the comments at its head.
pub(crate) fn example_notice(example: &Example, language: Language) -> String {
    let start = match language {
        Language::English => "# What to notice: ",
        Language::Russian => "# На что смотреть: ",
    };
    let mut lines = example.text.lines().skip_while(|line| !line.starts_with(start));
    let mut words: Vec<&str> = lines.next().map(|line| line.trim_start_matches(start)).into_iter().collect();
    words.extend(lines.map_while(|line| line.strip_prefix("# ")));
    let notice = words.join(" ");
    // In the file it goes on after a colon.
    let mut letters = notice.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_example_has_its_notice_in_the_letters_of_the_language() {
        let is_cyrillic = |letter: char| ('а'..='я').contains(&letter);
        for example in Example::ALL {
            for language in Language::ALL {
                let notice = example_notice(example, language);
                assert!(notice.len() > 40 && !notice.contains('#'), "{}: {notice}", example.name);
                assert_eq!(notice.contains(is_cyrillic), language == Language::Russian, "{notice}");
            }
        }
    }
}
