//! The pictures of the front page.

use anyhow::Result;
use catoptric_scene::Example;

use crate::gallery::{jpeg, picture};

/// A kind of picture on the page.
pub(super) struct PageImage {
    /// Width and height, pixels.
    pub size: (u32, u32),
    /// The most that its file may take.
    bytes: usize,
}

pub(super) const CARD: PageImage = PageImage { size: (480, 270), bytes: 25_000 };
pub(super) const FIRST: PageImage = PageImage { size: (1440, 810), bytes: 150_000 };
/// The scene of the large picture. What surrounds it in `gallery.css` is as dark as its room.
pub(super) const FIRST_SCENE: &str = "metals";

/// Qualities of a JPEG to try, from the best on.
const QUALITIES: [u8; 9] = [90, 85, 80, 75, 70, 65, 60, 50, 40];

impl PageImage {
    /// The picture of a scene as a JPEG, in the best quality that fits, or else in the lowest.
    pub(super) fn of(&self, example: &Example, samples: u32) -> Result<Vec<u8>> {
        let picture = picture(example, self.size, samples)?;
        let mut bytes = Vec::new();
        for quality in QUALITIES {
            bytes = jpeg(&picture, quality)?;
            if bytes.len() <= self.bytes {
                break;
            }
        }
        Ok(bytes)
    }
}
