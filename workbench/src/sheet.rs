//! Many pictures on one sheet.

use anyhow::Result;
use catoptric_picture::Picture;

/// Pictures of one size, each made smaller, side by side with a gap between.
pub(crate) struct Sheet {
    tile: (u32, u32),
    reduced: u32,
    columns: u32,
    tiles: Vec<Vec<[f32; 3]>>,
}

/// Pixels between pictures.
const GAP: u32 = 4;
/// Linear light of the gaps; near the middle between a light and a dark page.
const GAP_COLOR: [f32; 3] = [0.2; 3];

impl Sheet {
    /// A sheet of pictures of `size` pixels, `columns` across, made `reduced` times smaller.
    pub(crate) fn new(size: (u32, u32), reduced: u32, columns: u32) -> Self {
        Self { tile: (size.0 / reduced, size.1 / reduced), reduced, columns, tiles: Vec::new() }
    }

    /// Adds a picture: each pixel of the sheet is the mean of a square of its linear light, as the display shows it.
    pub(crate) fn add(&mut self, picture: &Picture) {
        let scale = 1.0 / (self.reduced * self.reduced) as f32;
        let mut tile = Vec::new();
        for y in 0..self.tile.1 {
            for x in 0..self.tile.0 {
                let mut sum = [0.0; 3];
                for offset in 0..self.reduced * self.reduced {
                    let (dx, dy) = (offset % self.reduced, offset / self.reduced);
                    let pixel =
                        picture.pixel(x * self.reduced + dx, y * self.reduced + dy).unwrap_or_default();
                    sum = [0, 1, 2].map(|channel: usize| sum[channel] + pixel[channel].clamp(0.0, 1.0));
                }
                tile.push(sum.map(|channel| channel * scale));
            }
        }
        self.tiles.push(tile);
    }

    /// The sheet.
    pub(crate) fn picture(&self) -> Result<Picture> {
        let (width, height) = self.tile;
        let rows = (self.tiles.len() as u32).div_ceil(self.columns).max(1);
        let across = self.columns * (width + GAP) - GAP;
        let down = rows * (height + GAP) - GAP;
        Ok(Picture::from_fn(across, down, |x, y| {
            let (column, row) = (x / (width + GAP), y / (height + GAP));
            let (x, y) = (x % (width + GAP), y % (height + GAP));
            let tile = self.tiles.get((row * self.columns + column) as usize);
            match tile {
                Some(tile) if x < width && y < height => tile[(y * width + x) as usize],
                _ => GAP_COLOR,
            }
        })?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_stand_in_their_places() {
        let mut sheet = Sheet::new((4, 2), 2, 2);
        for value in [0.25, 0.5, 1.0] {
            sheet.add(&Picture::from_fn(4, 2, |_, _| [value; 3]).unwrap());
        }
        let picture = sheet.picture().unwrap();
        assert_eq!((picture.width(), picture.height()), (2 * 2 + GAP, 2 + GAP));
        let at = |x, y| picture.pixel(x, y).unwrap()[0];
        assert_eq!([at(0, 0), at(1, 0), at(2 + GAP, 0), at(1, 1 + GAP)], [0.25, 0.25, 0.5, 1.0]);
        assert_eq!([at(2, 0), at(0, 1), at(3 + GAP, 1 + GAP)], [GAP_COLOR[0]; 3]);
    }
}
