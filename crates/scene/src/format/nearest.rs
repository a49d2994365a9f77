//! The nearest word, for hints.

/// Words longer than this are not compared: nobody mistypes a key into them.
const LONGEST_WORD: usize = 40;
/// The most candidates that are compared: a scene can define a million materials.
const MOST_CANDIDATES: usize = 2000;

/// The candidate that `word` is most likely a misspelling of: at most a third of its letters (and at least one) wrong,
/// missing, surplus or swapped with a neighbor; case does not count.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if word.is_empty() || word.len() > LONGEST_WORD {
        return None;
    }
    let word = word.to_lowercase();
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates.into_iter().take(MOST_CANDIDATES) {
        if candidate.len() > LONGEST_WORD {
            continue;
        }
        let allowed = (word.chars().count().max(candidate.chars().count()) / 3).max(1);
        let distance = strsim::damerau_levenshtein(&word, &candidate.to_lowercase());
        // One letter for another one is no misspelling.
        let alike = distance <= allowed && distance < candidate.chars().count()
            || distance <= 3 && same_beginning(&word, &candidate.to_lowercase());
        if alike && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Whether the words share their first letters but for the last three: another ending, as `body` for `bodies`.
fn same_beginning(a: &str, b: &str) -> bool {
    let shared = a.chars().zip(b.chars()).take_while(|(a, b)| a == b).count();
    shared >= 3 && a.chars().count() <= shared + 3 && b.chars().count() <= shared + 3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misspelt_words_are_recognized() {
        let keys = ["color", "ambient", "diffuse", "specular", "position"];
        // Meant: the British spelling is the likeliest misspelling of all.
        assert_eq!(nearest("colour", keys), Some("color"));
        assert_eq!(nearest("Color", keys), Some("color"));
        assert_eq!(nearest("postion", keys), Some("position"));
        assert_eq!(nearest("diffues", keys), Some("diffuse"));
        assert_eq!(nearest("radius", keys), None);
        assert_eq!(nearest("body", ["lights", "bodies"]), Some("bodies"));
        assert_eq!(nearest("", keys), None);
        assert_eq!(nearest("x", ["y"]), None);
        assert_eq!(nearest(&"c".repeat(1_000_000), keys), None);
    }
}
