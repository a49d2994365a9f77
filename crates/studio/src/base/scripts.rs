//! Letters above and below the line that the fonts of the window do not have, set from small ones.

use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Color32, FontId};

/// A letter above or below the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Script {
    /// An exponent.
    Above(char),
    /// An index.
    Below(char),
}

impl Script {
    /// What `sign` stands for, if it is such a letter.
    pub(crate) const fn of(sign: char) -> Option<Self> {
        Some(match sign {
            'ᵢ' => Self::Below('i'),
            'ᵦ' => Self::Below('β'),
            'ₐ' => Self::Below('a'),
            'ⁿ' => Self::Above('n'),
            'ᵏ' => Self::Above('k'),
            'ᴷ' => Self::Above('K'),
            _ => return None,
        })
    }
}

/// Running text in a font of `size` points, with small letters for those that the font does not have.
pub(crate) fn job(text: &str, size: f32, color: Color32) -> LayoutJob {
    let mut job = LayoutJob::default();
    let mut run = String::new();
    let format = |size, valign| TextFormat {
        font_id: FontId::proportional(size),
        color,
        valign,
        ..TextFormat::default()
    };
    for sign in text.chars() {
        let (letter, valign) = match Script::of(sign) {
            None => {
                run.push(sign);
                continue;
            }
            Some(Script::Above(letter)) => (letter, Align::TOP),
            Some(Script::Below(letter)) => (letter, Align::BOTTOM),
        };
        job.append(&std::mem::take(&mut run), 0.0, format(size, Align::BOTTOM));
        job.append(letter.encode_utf8(&mut [0; 4]), 0.0, format(0.72 * size, valign));
    }
    job.append(&run, 0.0, format(size, Align::BOTTOM));
    job
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_small_letters() {
        let job = job("0.78ᵏ of dᵢ", 13.5, Color32::WHITE);
        assert_eq!(job.text, "0.78k of di");
        let small: Vec<&str> = job
            .sections
            .iter()
            .filter(|section| section.format.font_id.size < 13.0)
            .map(|section| &job.text[section.byte_range.start.0..section.byte_range.end.0])
            .collect();
        assert_eq!(small, ["k", "i"]);
    }
}
