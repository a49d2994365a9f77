//! Languages, and how they write numbers.

use std::fmt;
use std::str::FromStr;

/// The language of a report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Language {
    /// English, the default: decimal point.
    #[default]
    English,
    /// Russian: decimal comma.
    Russian,
}

/// There is no report in this language.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there are no reports in \"{0}\"; give en or ru")]
pub struct UnknownLanguage(String);

impl Language {
    /// All languages.
    pub const ALL: [Self; 2] = [Self::English, Self::Russian];

    /// The code of ISO 639: `en` or `ru`.
    pub const fn code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Russian => "ru",
        }
    }

    /// The one of two texts that is in this language.
    pub(crate) const fn choose(self, english: &'static str, russian: &'static str) -> &'static str {
        match self {
            Self::English => english,
            Self::Russian => russian,
        }
    }

    /// A number with so many places, thousands apart, and a real minus; ∞ and a dash for what is no number.
    pub fn fixed(self, value: f64, places: usize) -> String {
        if value.is_nan() {
            return "–".to_owned();
        }
        if value.is_infinite() {
            return if value > 0.0 { "∞" } else { "−∞" }.to_owned();
        }
        let text = format!("{:.places$}", value.abs());
        let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
        // What is rounded to zero has no sign.
        let negative = value < 0.0 && text.bytes().any(|byte| (b'1'..=b'9').contains(&byte));
        let mut result = if negative { "−".to_owned() } else { String::new() };
        for (index, digit) in whole.chars().enumerate() {
            if index > 0 && (whole.len() - index).is_multiple_of(3) && whole.len() > 4 {
                result.push('\u{a0}');
            }
            result.push(digit);
        }
        if !fraction.is_empty() {
            result.push_str(self.choose(".", ","));
            result.push_str(fraction);
        }
        result
    }

    /// A number with so many significant digits, very large and small ones with a power of ten.
    pub fn significant(self, value: f64, digits: usize) -> String {
        if value == 0.0 || !value.is_finite() {
            return self.fixed(value, 0);
        }
        let digits = digits.clamp(1, 15);
        // The power after rounding: 9.99 with two digits is 10.
        let rounded = format!("{:.*e}", digits - 1, value.abs());
        let power = rounded.split_once('e').and_then(|(_, power)| power.parse::<i32>().ok()).unwrap_or(0);
        if (-4..7).contains(&power) {
            let places = (digits as i32 - 1 - power).max(0) as usize;
            // Whole numbers are not rounded to less than they are.
            return self.fixed(value, places);
        }
        let mantissa = self.fixed(value / 10.0_f64.powi(power), digits - 1);
        format!("{mantissa}·10{}", superscript(power))
    }

    /// A number with all its places.
    pub(crate) fn decimal(self, value: f64) -> String {
        let places = format!("{value}").split_once('.').map_or(0, |(_, places)| places.len());
        if value != 0.0 && !(1e-5..1e9).contains(&value.abs()) {
            return self.significant(value, 6);
        }
        self.fixed(value, places)
    }

    /// A count with its thousands apart.
    pub fn count(self, count: u64) -> String {
        self.fixed(count as f64, 0)
    }

    /// Two ends of an interval.
    pub fn interval(self, low: f64, high: f64, digits: usize) -> String {
        if !(low.is_finite() && high.is_finite()) {
            return "–".to_owned();
        }
        // Both ends with the places that the width deserves, at least those asked for.
        let width = (high - low).abs().max(low.abs().max(high.abs()) * 10.0_f64.powi(-(digits as i32) - 1));
        let places = (1 - width.log10().floor() as i32).clamp(0, 12) as usize;
        format!("{}\u{a0}…\u{a0}{}", self.fixed(low, places), self.fixed(high, places))
    }
}

/// A power as small raised digits.
pub(crate) fn superscript(power: i32) -> String {
    let raised = |digit: char| match digit {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        other => other.to_digit(10).and_then(|digit| char::from_u32(0x2070 + digit)).unwrap_or(other),
    };
    power.to_string().chars().map(raised).collect()
}

impl From<Language> for catoptric_scene::Language {
    fn from(language: Language) -> Self {
        match language {
            Language::English => Self::English,
            Language::Russian => Self::Russian,
        }
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.code())
    }
}

impl FromStr for Language {
    type Err = UnknownLanguage;

    fn from_str(text: &str) -> Result<Self, UnknownLanguage> {
        let found = Self::ALL.into_iter().find(|language| language.code() == text);
        found.ok_or_else(|| UnknownLanguage(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_the_language_has_it() {
        let (en, ru) = (Language::English, Language::Russian);
        assert_eq!((en.fixed(1.25, 2), ru.fixed(1.25, 2)), ("1.25".to_owned(), "1,25".to_owned()));
        assert_eq!(ru.fixed(-1_234_567.5, 1), "−1\u{a0}234\u{a0}567,5");
        assert_eq!((en.count(1234), en.count(12_345)), ("1234".to_owned(), "12\u{a0}345".to_owned()));
        assert_eq!((en.fixed(-0.001, 2), en.fixed(0.0, 0)), ("0.00".to_owned(), "0".to_owned()));
        assert_eq!((en.fixed(f64::INFINITY, 2), en.fixed(f64::NAN, 2)), ("∞".to_owned(), "–".to_owned()));
        for (value, text) in [
            (0.0, "0"),
            (12.345, "12.3"),
            (9.999, "10.0"),
            (0.001_234, "0.00123"),
            (-0.5, "−0.500"),
            (123_456.0, "123\u{a0}456"),
            (1.5e9, "1.50·10⁹"),
            (-2.5e-7, "−2.50·10⁻⁷"),
        ] {
            assert_eq!(en.significant(value, 3), text);
        }
        assert_eq!(ru.interval(1.234, 1.256, 3), "1,234\u{a0}…\u{a0}1,256");
        assert_eq!(ru.interval(1.0, f64::INFINITY, 3), "–");
        assert_eq!("ru".parse(), Ok(ru));
        assert!("de".parse::<Language>().unwrap_err().to_string().contains("give en or ru"));
    }
}
