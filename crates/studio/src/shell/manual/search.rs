//! Search over all pages.

use super::markdown::{BlockContent, ManualPage};

/// At most so many hits are listed.
const MOST: usize = 60;
/// How many letters of a hit's block are shown before the words that were found, and after them.
const BEFORE: usize = 28;
const AFTER: usize = 70;

/// A block that contains the searched words.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct SearchHit {
    pub(super) page: usize,
    pub(super) block: usize,
    /// A part of the block, in three: before the words, the words, after them.
    pub(super) excerpt: [String; 3],
    is_heading: bool,
}

/// The blocks of `pages` that have all words of `search`, headings first. Case does not matter.
pub(super) fn hits(pages: &[ManualPage], search: &str) -> Vec<SearchHit> {
    let words: Vec<String> = search.split_whitespace().map(folded).collect();
    let Some(first) = words.first() else { return Vec::new() };
    let mut hits = Vec::new();
    for (page, content) in pages.iter().enumerate() {
        for (block, content) in content.blocks.iter().enumerate() {
            let plain = folded(&content.plain);
            if !words.iter().all(|word| plain.contains(word.as_str())) {
                continue;
            }
            // The whole search in one place says more than its first word.
            let whole = folded(search.trim());
            let found = if plain.contains(&whole) { &whole } else { first };
            let is_heading = matches!(content.content, BlockContent::Heading { .. });
            hits.push(SearchHit { page, block, excerpt: excerpt(&content.plain, found), is_heading });
        }
    }
    hits.sort_by_key(|hit| !hit.is_heading);
    hits.truncate(MOST);
    hits
}

/// Small letters; ё and е are one.
fn folded(text: &str) -> String {
    text.chars().map(fold).collect()
}

/// One letter for one letter, so that places stay the same.
fn fold(letter: char) -> char {
    let small = letter.to_lowercase().next().unwrap_or(letter);
    if small == 'ё' { 'е' } else { small }
}

fn excerpt(plain: &str, found: &str) -> [String; 3] {
    let letters: Vec<char> = plain.chars().map(|c| if c.is_whitespace() { ' ' } else { c }).collect();
    let small: Vec<char> = letters.iter().map(|letter| fold(*letter)).collect();
    let wanted: Vec<char> = found.chars().collect();
    let at = small.windows(wanted.len().max(1)).position(|window| window == wanted).unwrap_or(0);
    let end = (at + wanted.len()).min(letters.len());
    let start = at.saturating_sub(BEFORE);
    let stop = (end + AFTER).min(letters.len());
    let part = |from: usize, to: usize| letters.get(from..to).unwrap_or_default().iter().collect::<String>();
    let before = if start > 0 { format!("…{}", part(start, at)) } else { part(start, at) };
    let after = if stop < letters.len() { format!("{}…", part(end, stop)) } else { part(end, stop) };
    [before, part(at, end), after]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::manual::markdown::read;

    #[test]
    fn all_words_must_be_there_and_headings_come_first() {
        let pages =
            [read("# A\n\nThe beam of light\n\n## Beams\n\ndark", 0, "a.md"), read("# B\n\nЁлка", 1, "b.md")];
        let places =
            |search| hits(&pages, search).iter().map(|hit| (hit.page, hit.block)).collect::<Vec<_>>();
        assert_eq!(places("beam"), [(0, 2), (0, 1)]);
        assert_eq!(places("LIGHT beam"), [(0, 1)]);
        assert_eq!(places("елка"), [(1, 1)]);
        assert!(places("").is_empty() && places("xyzzy").is_empty());
    }

    #[test]
    fn an_excerpt_shows_what_stands_around() {
        assert_eq!(excerpt("a long beam", "long"), ["a ", "long", " beam"]);
        let long = format!("{}needle{}", "a".repeat(50), "b".repeat(100));
        let [before, found, after] = excerpt(&long, "needle");
        assert_eq!((before.chars().count(), found.as_str(), after.chars().count()), (29, "needle", 71));
    }
}
