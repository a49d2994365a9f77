//! Numbers that a picture answers beside its time.

use std::fmt;

use catoptric_picture::{CompareError, Flip, Picture};
use catoptric_tracer::RayCounts;

/// What is asked of each picture of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PictureQuestion {
    /// The mean of its linear light.
    Mean,
    /// The linear light of the pixel in this column and row, from 0 at the upper left.
    Pixel([u32; 2]),
    /// The mean ꟻLIP difference from the first picture of its curve.
    Flip,
    /// The numbers of its rays by kind.
    Rays,
}

/// The reason why a text asks nothing of a picture.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum QuestionError {
    /// There is no such question.
    #[error("\"{0}\" cannot be asked of a picture; ask for mean, pixel:X,Y, flip or rays")]
    Unknown(String),
    /// One question is asked twice.
    #[error("{0} is asked twice; ask each question once")]
    Twice(PictureQuestion),
}

impl PictureQuestion {
    /// Reads questions with commas between them, such as `mean,pixel:320,180,flip`.
    ///
    /// # Errors
    /// What is wrong, and what can be asked.
    pub fn read(text: &str) -> Result<Vec<Self>, QuestionError> {
        let mut questions: Vec<Self> = Vec::new();
        let mut words = text.split(',').map(str::trim);
        while let Some(word) = words.next() {
            let question = match (word, word.strip_prefix("pixel:")) {
                ("mean", _) => Self::Mean,
                ("flip", _) => Self::Flip,
                ("rays", _) => Self::Rays,
                (_, Some(column)) => {
                    let row = words.next().unwrap_or_default();
                    let place = column.trim().parse().ok().zip(row.parse().ok());
                    let (x, y) = place.ok_or_else(|| QuestionError::Unknown(format!("{word},{row}")))?;
                    Self::Pixel([x, y])
                }
                _ => return Err(QuestionError::Unknown(word.to_owned())),
            };
            if questions.contains(&question) {
                return Err(QuestionError::Twice(question));
            }
            questions.push(question);
        }
        Ok(questions)
    }

    /// The name of its files: `mean`, `pixel-320-180`, `flip`, `rays`.
    pub fn file_stem(&self) -> String {
        match self {
            Self::Pixel([x, y]) => format!("pixel-{x}-{y}"),
            other => other.to_string(),
        }
    }

    /// The names of its numbers in tables for programs. The last one is what a plot shows.
    pub fn columns(&self) -> Vec<String> {
        match self {
            Self::Mean | Self::Pixel(_) => {
                let name = self.file_stem().replace('-', "_");
                ["red", "green", "blue", "luminance"].map(|part| format!("{name}_{part}")).to_vec()
            }
            Self::Flip => vec!["flip".to_owned()],
            Self::Rays => {
                ["primary", "shadow", "reflected", "refracted", "total"].map(str::to_owned).to_vec()
            }
        }
    }

    /// The numbers of a picture, as many as [`Self::columns`]; `first` is the first picture of the curve.
    pub(super) fn answer(
        &self,
        picture: &Picture,
        rays: RayCounts,
        first: &Picture,
    ) -> Result<Vec<f64>, CompareError> {
        Ok(match *self {
            Self::Mean => {
                let mut sum = [0.0; 3];
                for pixel in picture.pixels() {
                    for (sum, part) in sum.iter_mut().zip(pixel) {
                        *sum += f64::from(*part);
                    }
                }
                with_luminance(sum.map(|sum: f64| sum / picture.pixels().len().max(1) as f64))
            }
            Self::Pixel([x, y]) => {
                with_luminance(picture.pixel(x, y).unwrap_or([f32::NAN; 3]).map(f64::from))
            }
            Self::Flip => vec![Flip::default().compare(first, picture)?.mean()],
            Self::Rays => [rays.primary, rays.shadow, rays.reflected, rays.refracted, rays.total()]
                .map(|count| count as f64)
                .to_vec(),
        })
    }
}

/// The channels and the luminance of linear sRGB (ITU-R BT.709).
fn with_luminance([red, green, blue]: [f64; 3]) -> Vec<f64> {
    vec![red, green, blue, 0.2126 * red + 0.7152 * green + 0.0722 * blue]
}

/// As it is written to ask it.
impl fmt::Display for PictureQuestion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mean => f.pad("mean"),
            Self::Pixel([x, y]) => write!(f, "pixel:{x},{y}"),
            Self::Flip => f.pad("flip"),
            Self::Rays => f.pad("rays"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn questions_are_read_as_they_are_written() {
        let text = "mean,pixel:3,4,flip,rays,pixel:5,6";
        let read = PictureQuestion::read(text).unwrap();
        assert_eq!(read.iter().map(ToString::to_string).collect::<Vec<_>>().join(","), text);
        assert_eq!(read.iter().map(|question| question.columns().len()).sum::<usize>(), 4 + 4 + 1 + 5 + 4);
        for (text, said) in [
            ("", "\"\" cannot be asked of a picture; ask for mean, pixel:X,Y"),
            ("median", "\"median\" cannot be asked"),
            ("pixel:3", "\"pixel:3,\" cannot be asked"),
            ("pixel:3,mean", "\"pixel:3,mean\" cannot be asked"),
            ("pixel:-3,4", "\"pixel:-3,4\""),
            ("mean,mean", "mean is asked twice"),
        ] {
            let error = PictureQuestion::read(text).unwrap_err().to_string();
            assert!(error.starts_with(said), "{text}: {error}");
        }
    }

    #[test]
    fn answers_are_those_of_the_picture() {
        let mut picture = Picture::new(2, 1).unwrap();
        picture.pixels_mut().copy_from_slice(&[[1.0, 0.5, 0.0], [3.0, 0.5, 2.0]]);
        let answer = |question: PictureQuestion| {
            question
                .answer(&picture, RayCounts { primary: 2, shadow: 3, ..RayCounts::default() }, &picture)
                .unwrap()
        };
        let mean = answer(PictureQuestion::Mean);
        assert_eq!(mean[..3], [2.0, 0.5, 1.0]);
        assert!((mean[3] - (2.0 * 0.2126 + 0.5 * 0.7152 + 0.0722)).abs() < 1e-12);
        assert_eq!(answer(PictureQuestion::Pixel([1, 0]))[..3], [3.0, 0.5, 2.0]);
        assert_eq!(answer(PictureQuestion::Flip), [0.0]);
        assert_eq!(answer(PictureQuestion::Rays), [2.0, 3.0, 0.0, 0.0, 5.0]);
    }
}
