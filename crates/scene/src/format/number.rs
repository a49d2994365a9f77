//! Numbers as text.

/// Appends the shortest text that reads back as `value` and is a TOML float: `1.0`, `0.1`, `1e-9`. Minus zero is
/// written as zero, for the two are equal.
pub(crate) fn push_number(out: &mut String, value: f64) {
    use std::fmt::Write as _;
    let value = if value == 0.0 { 0.0 } else { value };
    // Writing to a string cannot fail.
    let _ = write!(out, "{value:?}");
}

/// A number for people: as short as it can be, `27` rather than `27.0`, `1e9` rather than nine zeros.
pub(crate) fn short_number(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1e-4..1e6).contains(&magnitude) {
        format!("{value:e}").replace("inf", "infinity")
    } else {
        format!("{}", if value == 0.0 { 0.0 } else { value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_stay_floats() {
        let text = |value| {
            let mut out = String::new();
            push_number(&mut out, value);
            out
        };
        assert_eq!(text(1.0), "1.0");
        assert_eq!(text(0.1), "0.1");
        assert_eq!(text(1e-9), "1e-9");
        assert_eq!(text(-0.0), "0.0");
        assert_eq!(text(1e300), "1e300");
        assert_eq!(short_number(1e9), "1e9");
        assert_eq!(short_number(27.0), "27");
        assert_eq!(short_number(0.001), "0.001");
        assert_eq!(short_number(-0.5), "-0.5");
    }
}
