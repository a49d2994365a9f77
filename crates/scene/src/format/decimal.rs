//! Decimal commas, which half the world writes and TOML reads as the end of a number.

/// A list such as `[0,5, 1, 2,25]` with points in the place of its decimal commas, if that makes it a list of `count`
/// numbers in one way only.
pub(crate) fn list_with_points(list: &str, count: usize) -> Option<String> {
    let inner = list.strip_prefix('[')?.strip_suffix(']')?;
    let mut pieces: Vec<&str> = inner.split(',').collect();
    // A comma may stand after the last value.
    if pieces.last().is_some_and(|last| last.trim().is_empty()) {
        pieces.pop();
    }
    let is_joint =
        |pair: &[&str]| matches!(pair, [whole, rest] if is_whole(whole.trim_start()) && is_fraction(rest));
    let joints: Vec<bool> = pieces.windows(2).map(is_joint).collect();
    let mut numbers: Vec<String> = Vec::new();
    let mut place = 0;
    while let Some(piece) = pieces.get(place) {
        match (joints.get(place), pieces.get(place + 1)) {
            (Some(true), Some(rest)) => {
                numbers.push(format!("{}.{}", piece.trim(), rest.trim_end()));
                place += 2;
            }
            _ => {
                numbers.push(piece.trim().to_owned());
                place += 1;
            }
        }
    }
    let is_joined = numbers.len() < pieces.len();
    let are_numbers = numbers.iter().all(|number| number.parse::<f64>().is_ok());
    (is_joined && are_numbers && numbers.len() == count).then(|| format!("[{}]", numbers.join(", ")))
}

/// The number around the decimal comma before `at`, with a point, and where it begins: `1,5` with `at` at the 5.
pub(crate) fn number_before(text: &str, at: usize) -> Option<(usize, String)> {
    let before = text.get(..at)?.strip_suffix(',')?;
    let is_part = |character: char| character.is_ascii_digit() || "+-_".contains(character);
    let start = before.rfind(|character| !is_part(character)).map_or(0, |place| {
        place + before.get(place..).and_then(|rest| rest.chars().next()).map_or(1, char::len_utf8)
    });
    let whole = before.get(start..)?;
    let rest = text.get(at..)?;
    let end =
        rest.find(|character: char| !is_part(character) && !"eE".contains(character)).unwrap_or(rest.len());
    let fraction = rest.get(..end)?;
    (is_whole(whole) && is_fraction(fraction)).then(|| (start, format!("{whole}.{fraction}")))
}

/// Whether this can stand before a decimal comma: `-0`.
fn is_whole(text: &str) -> bool {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    digits.starts_with(|first: char| first.is_ascii_digit())
        && digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_')
}

/// Whether this can stand behind a decimal comma, without a blank before it: `25`, `5e-3`.
fn is_fraction(text: &str) -> bool {
    let text = text.trim_end();
    text.starts_with(|first: char| first.is_ascii_digit()) && format!("0.{text}").parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_get_their_points() {
        let three = |list: &str| list_with_points(list, 3);
        assert_eq!(three("[0,5, 1,0, 2,25]").as_deref(), Some("[0.5, 1.0, 2.25]"));
        assert_eq!(three("[0,5,1,0,2,25]").as_deref(), Some("[0.5, 1.0, 2.25]"));
        assert_eq!(three("[0,5, 1, 2]").as_deref(), Some("[0.5, 1, 2]"));
        assert_eq!(three("[ 1, -0,05 , 2e3, ]").as_deref(), Some("[1, -0.05, 2e3]"));
        assert_eq!(three("[1, 2, 3,5e-1]").as_deref(), Some("[1, 2, 3.5e-1]"));
        for other in
            ["[1, 2, 3, 4]", "[1, 2]", "[0,5, 1]", "[a,5, 1, 2]", "[0.5,5, 1, 2, 3]", "1,5", "[]", "[,]"]
        {
            assert_eq!(three(other), None, "{other}");
        }
    }

    #[test]
    fn a_number_is_found_around_its_comma() {
        let found = |text: &str| number_before(text, text.find(',').unwrap() + 1);
        assert_eq!(found("a = { b = 1,5 }"), Some((10, "1.5".to_owned())));
        assert_eq!(found("[-0,05, 1]"), Some((1, "-0.05".to_owned())));
        assert_eq!(found("ж1,5"), Some((2, "1.5".to_owned())));
        assert_eq!(found("1, 5"), None);
        assert_eq!(found("a,5"), None);
        assert_eq!(number_before("", 0), None);
    }
}
