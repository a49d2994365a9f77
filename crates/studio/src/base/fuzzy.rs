//! Finding names by some of their letters.

/// The Russian letters on the keys of the Latin ones, for queries typed in the wrong layout.
const LATIN: &str = "qwertyuiop[]asdfghjkl;'zxcvbnm,.`";
const RUSSIAN: &str = "йцукенгшщзхъфывапролджэячсмитьбюё";

/// A query, also as it would read in the other keyboard layout.
pub(crate) struct Query {
    readings: Vec<Vec<char>>,
}

impl Query {
    pub(crate) fn new(text: &str) -> Self {
        let typed = folded(text.trim());
        let others = [swapped(&typed, LATIN, RUSSIAN), swapped(&typed, RUSSIAN, LATIN)];
        let mut readings = vec![typed];
        for other in others {
            if !readings.contains(&other) {
                readings.push(other);
            }
        }
        Self { readings }
    }

    /// How well the best of `names` fits; `None` when none does. A reading in another layout counts less.
    pub(crate) fn best<'a>(&self, names: impl Iterator<Item = &'a str>) -> Option<i32> {
        names
            .filter_map(|name| {
                let name = folded(name);
                let scores = self.readings.iter().enumerate();
                scores
                    .filter_map(|(place, reading)| {
                        Some(score(reading, &name)? - if place > 0 { 15 } else { 0 })
                    })
                    .max()
            })
            .max()
    }
}

/// Lower case, ё as е.
fn folded(text: &str) -> Vec<char> {
    text.chars().flat_map(char::to_lowercase).map(|letter| if letter == 'ё' { 'е' } else { letter }).collect()
}

fn swapped(text: &[char], from: &str, to: &str) -> Vec<char> {
    let swap = |letter: &char| {
        let place = from.chars().position(|other| other == *letter);
        let letter = place.and_then(|place| to.chars().nth(place)).unwrap_or(*letter);
        if letter == 'ё' { 'е' } else { letter }
    };
    text.iter().map(swap).collect()
}

/// How well the letters of `query` stand in this order in `name`: together and at the beginnings of words is best.
fn score(query: &[char], name: &[char]) -> Option<i32> {
    let Some(first) = query.first() else { return Some(0) };
    let starts = name.iter().enumerate().filter(|(_, letter)| *letter == first).map(|(place, _)| place);
    let best = starts.filter_map(|start| score_from(query, name, start)).max()?;
    // Of equal hits the shorter name is the one that is meant.
    Some(best * 4 - name.len().min(60) as i32)
}

/// The score with the first letter at `start`. The others are matched as early as possible, at beginnings of words
/// first.
fn score_from(query: &[char], name: &[char], start: usize) -> Option<i32> {
    let is_beginning = |place: usize| {
        place
            .checked_sub(1)
            .and_then(|before| name.get(before))
            .is_none_or(|letter| !letter.is_alphanumeric())
    };
    let mut total = if start == 0 { 12 } else { 0 };
    let mut place = start;
    for (count, letter) in query.iter().enumerate() {
        let next = if count == 0 {
            start
        } else if name.get(place + 1) == Some(letter) {
            total += 6;
            place + 1
        } else {
            let later = |wanted: &dyn Fn(usize) -> bool| {
                (place + 1..name.len()).find(|&other| name.get(other) == Some(letter) && wanted(other))
            };
            let next = later(&is_beginning).or_else(|| later(&|_| true))?;
            total -= (next - place).min(5) as i32;
            next
        };
        if is_beginning(next) {
            total += 5;
        }
        place = next;
    }
    Some(total)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find<'a>(query: &str, names: &[&'a str]) -> Option<&'a str> {
        let query = Query::new(query);
        let scored = names.iter().filter_map(|name| Some((query.best([*name].into_iter())?, *name)));
        scored.max_by_key(|(score, _)| *score).map(|(_, name)| name)
    }

    const NAMES: [&str; 6] =
        ["Save", "Save As…", "Select All", "Show All", "Frame Selection", "Добавить сферу"];

    #[test]
    fn letters_in_order_find_the_likeliest_name() {
        for (query, name) in [
            ("save", "Save"),
            ("sa", "Save"),
            ("sas", "Save As…"),
            ("sel all", "Select All"),
            ("shal", "Show All"),
            ("selection", "Frame Selection"),
            ("fs", "Frame Selection"),
            ("сфер", "Добавить сферу"),
        ] {
            assert_eq!(find(query, &NAMES), Some(name), "{query}");
        }
        assert_eq!(find("xyz", &NAMES), None);
    }

    #[test]
    fn the_wrong_keyboard_layout_finds_it_too() {
        assert_eq!(find("ыфму", &NAMES), Some("Save"));
        assert_eq!(find("cathe", &NAMES), Some("Добавить сферу"));
    }

    #[test]
    fn an_empty_query_fits_everything_alike() {
        let query = Query::new("  ");
        assert!(NAMES.iter().all(|name| query.best([*name].into_iter()) == Some(0)));
    }
}
