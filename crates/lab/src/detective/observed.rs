//! The picture that is checked, and the ways in which its pixels may be out of place.

use catoptric_picture::{Picture, PictureFormat, srgb};

/// A picture of another program, by its codes.
#[derive(Clone, Debug)]
pub struct ObservedPicture {
    size: [u32; 2],
    /// Codes as parts of the largest one, 0 to 1, row by row from the top.
    values: Vec<[f32; 3]>,
    /// The largest code, if all are whole numbers.
    largest_code: Option<f32>,
}

impl ObservedPicture {
    /// The codes of a picture that was read from a file of codes, of which reading has made light.
    pub fn of_codes(picture: &Picture) -> Self {
        Self::of(picture, |light| srgb::encode(f64::from(light)) as f32)
    }

    /// The light of a picture as it is, clamped to 0…1: what a file of light holds.
    pub fn of_light(picture: &Picture) -> Self {
        Self::of(picture, |light| light)
    }

    /// A picture that was read from a file of this format, if that is known: its light, or else its codes.
    pub fn of_file(picture: &Picture, format: Option<PictureFormat>) -> Self {
        match format.is_some_and(PictureFormat::is_of_light) {
            true => Self::of_light(picture),
            false => Self::of_codes(picture),
        }
    }

    fn of(picture: &Picture, value: impl Fn(f32) -> f32) -> Self {
        let value = |light: f32| if light > 0.0 { value(light).min(1.0) } else { 0.0 };
        let mut values: Vec<[f32; 3]> = picture.pixels().iter().map(|pixel| pixel.map(&value)).collect();
        let largest_code = LARGEST_CODES.into_iter().find(|largest| are_whole(&values, *largest));
        if let Some(largest) = largest_code {
            values.iter_mut().flatten().for_each(|value| *value = (*value * largest).round() / largest);
        }
        Self { size: [picture.width(), picture.height()], values, largest_code }
    }

    /// Width and height as stored, pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The codes of a stored pixel; black outside.
    pub(super) fn value(&self, [x, y]: [u32; 2]) -> [f32; 3] {
        let place = u64::from(y) * u64::from(self.size[0]) + u64::from(x);
        self.values.get(place as usize).copied().unwrap_or_default()
    }

    /// Codes rounded as those of the picture are.
    pub(super) fn rounded(&self, codes: [f32; 3]) -> [f32; 3] {
        match self.largest_code {
            Some(largest) => codes.map(|code| (code * largest).round() / largest),
            None => codes,
        }
    }
}

/// The largest codes of files, 8 and 16 bits.
const LARGEST_CODES: [f32; 2] = [255.0, 65_535.0];

/// Whether all codes are whole numbers, but for the rounding of the way to light and back.
fn are_whole(values: &[[f32; 3]], largest: f32) -> bool {
    const ROUNDING: f32 = 0.03;
    values.as_flattened().iter().all(|value| {
        let code = value * largest;
        (code - code.round()).abs() < ROUNDING
    })
}

/// How the stored pixels lie to those of the upright picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Orientation {
    /// As they should.
    #[default]
    Upright,
    /// Left and right are exchanged.
    FlippedAcross,
    /// Top and bottom are exchanged.
    FlippedDown,
    /// Both are exchanged.
    UpsideDown,
    /// Rows are stored as columns.
    Transposed,
    /// Turned to the left by a quarter.
    TurnedLeft,
    /// Turned to the right by a quarter.
    TurnedRight,
    /// Pixels are stored column by column in a picture of the right size.
    ColumnByColumn,
}

impl Orientation {
    pub(super) const OTHERS: [Self; 7] = [
        Self::FlippedAcross,
        Self::FlippedDown,
        Self::UpsideDown,
        Self::Transposed,
        Self::TurnedLeft,
        Self::TurnedRight,
        Self::ColumnByColumn,
    ];

    /// The size of the upright picture that is stored in this size.
    pub(super) fn upright_size(self, [width, height]: [u32; 2]) -> [u32; 2] {
        match self {
            Self::Transposed | Self::TurnedLeft | Self::TurnedRight => [height, width],
            _ => [width, height],
        }
    }

    /// Whether a picture stored in this size may lie so: a quarter turn exchanges
    /// the longer side and the shorter one.
    pub(super) fn fits(self, stored: [u32; 2], expected: Option<[u32; 2]>) -> bool {
        match self {
            Self::Transposed | Self::TurnedLeft | Self::TurnedRight => {
                let is_wide = |[width, height]: [u32; 2]| width >= height;
                expected.is_none_or(|expected| is_wide(expected) == is_wide(self.upright_size(stored)))
            }
            Self::ColumnByColumn => stored[0] != stored[1],
            _ => true,
        }
    }

    /// Where a pixel of the upright picture is stored, the stored picture having this size.
    pub(crate) fn stored(self, [x, y]: [u32; 2], [width, height]: [u32; 2]) -> [u32; 2] {
        let (right, below) = (width.saturating_sub(1), height.saturating_sub(1));
        match self {
            Self::Upright => [x, y],
            Self::FlippedAcross => [right.saturating_sub(x), y],
            Self::FlippedDown => [x, below.saturating_sub(y)],
            Self::UpsideDown => [right.saturating_sub(x), below.saturating_sub(y)],
            Self::Transposed => [y, x],
            Self::TurnedLeft => [y, below.saturating_sub(x)],
            Self::TurnedRight => [right.saturating_sub(y), x],
            Self::ColumnByColumn => {
                let place = u64::from(x) * u64::from(height) + u64::from(y);
                let width = u64::from(width.max(1));
                [(place % width) as u32, (place / width) as u32]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_rounded_as_in_the_file() {
        for largest in [255.0_f64, 65_535.0] {
            let code = |at: u32| f64::from(at * 37 % 251) / 251.0;
            let light = |x, y| [srgb::decode((code(x + 7 * y) * largest).round() / largest) as f32; 3];
            let observed = ObservedPicture::of_codes(&Picture::from_fn(16, 16, light).unwrap());
            assert_eq!(observed.largest_code, Some(largest as f32));
            let expected = (code(3 + 7 * 5) * largest).round() as f32 / largest as f32;
            assert_eq!(observed.value([3, 5]), [expected; 3]);
            assert_eq!(observed.rounded([expected + 0.4 / largest as f32; 3]), [expected; 3]);
        }
        let picture = Picture::from_fn(16, 16, |x, y| [(x + 16 * y) as f32 / 257.3; 3]).unwrap();
        let light = ObservedPicture::of_light(&picture);
        assert_eq!(light.rounded([0.123_456; 3]), [0.123_456; 3]);
    }

    #[test]
    fn every_orientation_moves_each_pixel_to_a_place_of_its_own() {
        let stored = [5, 3];
        for orientation in [Orientation::Upright].into_iter().chain(Orientation::OTHERS) {
            let [width, height] = orientation.upright_size(stored);
            let all = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
            let mut places: Vec<_> = all.map(|pixel| orientation.stored(pixel, stored)).collect();
            assert!(places.iter().all(|[x, y]| *x < 5 && *y < 3), "{orientation:?}");
            places.sort_unstable();
            places.dedup();
            assert_eq!(places.len(), 15, "{orientation:?}");
        }
        // A picture turned to the left has its upper right corner at the upper left.
        assert_eq!(Orientation::TurnedLeft.stored([2, 0], [5, 3]), [0, 0]);
        assert_eq!(Orientation::TurnedRight.stored([0, 4], [5, 3]), [0, 0]);
    }
}
