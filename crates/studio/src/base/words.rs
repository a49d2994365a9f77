//! Sizes, times and failures in words.

use std::path::Path;
use std::time::Duration;

use catoptric_live::JobError;
use catoptric_picture::{FormatError, Picture, SizeError};

use crate::base::texts::Texts;

/// `1920 × 1080`.
pub(crate) fn size(width: u32, height: u32) -> String {
    format!("{width} × {height}")
}

/// `0:07`, `12:30`, `1:02:03`.
pub(crate) fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    match hours {
        0 => format!("{minutes}:{seconds:02}"),
        _ => format!("{hours}:{minutes:02}:{seconds:02}"),
    }
}

/// Roughly how long something takes.
pub(crate) fn rough_time(texts: &Texts, seconds: f64) -> String {
    let with = |key, count: f64| texts.with(key, &[("count", decimal(texts, count).into())]);
    if seconds < 1.0 {
        texts.get("render-time-moment").to_owned()
    } else if seconds < 90.0 {
        with("render-time-seconds", two_digits(seconds))
    } else if seconds < 90.0 * 60.0 {
        with("render-time-minutes", two_digits(seconds / 60.0))
    } else if seconds < 48.0 * 3600.0 {
        with("render-time-hours", two_digits(seconds / 3600.0))
    } else {
        with("render-time-days", two_digits(seconds / 86400.0))
    }
}

/// An amount of memory, or the size of a file.
pub(crate) fn bytes(texts: &Texts, bytes: u64) -> String {
    let (key, unit) = match bytes {
        0..1_000 => ("size-bytes", 1.0),
        1_000..1_000_000 => ("size-kilobytes", 1e3),
        1_000_000..1_000_000_000 => ("render-megabytes", 1e6),
        _ => ("render-gigabytes", 1e9),
    };
    let count = bytes as f64 / unit;
    let count = if count < 100.0 { (10.0 * count).round() / 10.0 } else { count.round() };
    texts.with(key, &[("count", decimal(texts, count).into())])
}

/// Rounds to two digits; numbers below ten to halves at most, since more would pretend to know.
fn two_digits(number: f64) -> f64 {
    match number {
        ..3.0 => (number * 2.0).round() / 2.0,
        ..20.0 => number.round(),
        ..100.0 => (number / 5.0).round() * 5.0,
        _ => (number / 10.0).round() * 10.0,
    }
}

/// The number with the decimal sign of the language.
fn decimal(texts: &Texts, number: f64) -> String {
    texts.localized(format!("{number}"))
}

/// Why there can be no picture of a size, and what to do.
pub(crate) fn size_error(texts: &Texts, error: &SizeError) -> String {
    let sized = |key, width: u32, height: u32, needed: u64| {
        texts.with(
            key,
            &[
                ("size", size(width, height).into()),
                ("bytes", bytes(texts, needed).into()),
                ("side", Picture::MAX_SIDE.into()),
                ("megapixels", (Picture::MAX_PIXELS / 1_000_000).into()),
            ],
        )
    };
    match *error {
        SizeError::Empty { width, height } => sized("render-error-empty", width, height, 0),
        SizeError::Side { width, height, bytes } => sized("render-error-side", width, height, bytes),
        SizeError::Pixels { width, height, bytes } => sized("render-error-pixels", width, height, bytes),
        SizeError::Memory { width, height, bytes } => sized("render-error-memory", width, height, bytes),
        SizeError::Count { .. } => texts.with("render-error-fault", &[("reason", error.to_string().into())]),
    }
}

/// Why a format does not take a picture, and what to do.
pub(crate) fn format_error(texts: &Texts, error: &FormatError) -> String {
    match *error {
        FormatError::Side { format, width, height, most } => {
            let arguments = [
                ("format", format.name().into()),
                ("size", size(width, height).into()),
                ("side", most.into()),
            ];
            texts.with("render-error-format-side", &arguments)
        }
        FormatError::ReadOnly { format } | FormatError::Depth { format, .. } => {
            texts.with("render-error-format", &[("format", format.name().into())])
        }
    }
}

/// Why a render gave no picture, and what to do.
pub(crate) fn job_error(texts: &Texts, error: &JobError) -> String {
    match error {
        JobError::Size(error) => size_error(texts, error),
        JobError::Stage(error) => texts.with("render-error-scene", &[("reason", error.to_string().into())]),
        JobError::Setting(error) => {
            texts.with("render-error-method", &[("reason", error.to_string().into())])
        }
        JobError::TooManyCubeMaps { bodies, size } => {
            let arguments = [("bodies", (*bodies).into()), ("size", (*size).into())];
            texts.with("viewport-error-maps", &arguments)
        }
        JobError::Cancelled => texts.get("render-cancelled").to_owned(),
        JobError::Fault(reason) => fault(texts, reason),
    }
}

/// What went wrong in the program itself.
pub(crate) fn fault(texts: &Texts, reason: &str) -> String {
    texts.with("render-error-fault", &[("reason", reason.into())])
}

/// A document's name as the beginning of the name of a file.
pub(crate) fn plain_name(name: &str) -> String {
    let plain: String = name
        .chars()
        .map(|letter| if letter.is_control() || "/\\:*?\"<>|".contains(letter) { '-' } else { letter })
        .collect();
    let stem = plain.trim().trim_end_matches(".toml");
    if stem.is_empty() { "catoptric" } else { stem }.to_owned()
}

/// What the file at `path` is called.
pub(crate) fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::texts::Language;
    use catoptric_picture::PictureFormat;

    #[test]
    fn times_are_read_easily() {
        assert_eq!(clock(Duration::from_millis(7900)), "0:07");
        assert_eq!(clock(Duration::from_secs(750)), "12:30");
        assert_eq!(clock(Duration::from_secs(3723)), "1:02:03");
        let texts = Texts::new(Language::English);
        let told: Vec<String> =
            [0.2, 1.3, 12.4, 83.0, 400.0, 9000.0, 1e6].map(|seconds| rough_time(&texts, seconds)).into();
        assert_eq!(told, ["a moment", "1.5 s", "12 s", "85 s", "7 min", "2.5 h", "12 days"]);
    }

    #[test]
    fn bytes_are_told_in_the_unit_that_suits_them() {
        let amounts = [0, 999, 1_000, 1_249, 250_400, 10_000_000, 2_530_000_000];
        let told = |language| amounts.map(|amount| bytes(&Texts::new(language), amount));
        let english = ["0 B", "999 B", "1 kB", "1.2 kB", "250 kB", "10 MB", "2.5 GB"];
        assert_eq!(told(Language::English), english);
        let russian = ["0 Б", "999 Б", "1 кБ", "1,2 кБ", "250 кБ", "10 МБ", "2,5 ГБ"];
        assert_eq!(told(Language::Russian), russian);
    }

    #[test]
    fn every_failure_is_told_in_every_language() {
        let (width, height) = (5, 7);
        for language in Language::ALL {
            let texts = Texts::new(language);
            let sizes = [
                SizeError::Empty { width, height },
                SizeError::Side { width, height, bytes: 1 << 33 },
                SizeError::Pixels { width, height, bytes: 1 << 33 },
                SizeError::Memory { width, height, bytes: 1 << 33 },
            ];
            for error in sizes {
                assert!(size_error(&texts, &error).contains("5 × 7"), "{error:?}");
            }
            let (format, most) = (PictureFormat::WebP, 16_384);
            for error in [FormatError::Side { format, width, height, most }, FormatError::ReadOnly { format }]
            {
                assert!(format_error(&texts, &error).contains("WebP"), "{error:?}");
            }
            let _ = job_error(&texts, &JobError::Size(SizeError::Count { width, height, count: 1 }));
            let _ = job_error(&texts, &JobError::Cancelled);
            assert!(job_error(&texts, &JobError::Fault("out of luck".to_owned())).contains("out of luck"));
            assert_ne!(bytes(&texts, 25_000_000), bytes(&texts, 25_000_000_000));
            assert_eq!(texts.missing(), Vec::<String>::new());
        }
    }
}
