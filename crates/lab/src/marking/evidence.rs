//! What a page shows of a picture: small, whatever the size of the picture.

use std::sync::Arc;

use catoptric_picture::{BitDepth, Codes, Developed, Development, Picture, SizeError, encode_png};
use serde_json::{Value, json};

use crate::detective::Orientation;
use crate::report::PageError;

/// The side of the neighborhood of the worst pixel that is shown, pixels.
const DETAIL: u32 = 15;

/// A picture as a file of PNG.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShownPicture {
    /// The file.
    pub png: Vec<u8>,
    /// Width and height of the picture that it shows, pixels.
    pub size: [u32; 2],
}

/// The pixel that differs most from the exact picture, and its neighborhood.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorstPlace {
    /// Column and row in the file.
    pub stored: [u32; 2],
    /// Column and row in the picture put upright.
    pub pixel: [u32; 2],
    /// Its codes, 0 to 255.
    pub found: [u8; 3],
    /// Those of the exact picture.
    pub exact: [u8; 3],
    /// The neighborhood in the picture put upright, and in the exact one.
    pub details: [ShownPicture; 2],
    /// The pixel's column and row in the neighborhood.
    pub middle: [u32; 2],
}

impl WorstPlace {
    /// With names that stay.
    pub(super) fn to_json(&self) -> Value {
        json!({ "stored": self.stored, "pixel": self.pixel, "found": self.found, "exact": self.exact })
    }
}

/// What a page shows of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// The picture as it is stored.
    pub picture: ShownPicture,
    /// The exact one, which pictures of one size share.
    pub exact: Arc<ShownPicture>,
    /// The pixel that differs most; `None` where all codes are equal.
    pub worst: Option<WorstPlace>,
}

/// The exact picture of a scene in one size, made ready for many others.
#[derive(Clone, Debug)]
pub struct ExactPicture {
    codes: Codes8,
    shown: Arc<ShownPicture>,
    longest_side: u32,
}

impl ExactPicture {
    /// The longest side of a picture on the page of a class, pixels.
    pub const LONGEST_SIDE: u32 = 320;

    /// Develops an exact picture. It and those beside it are shown with at most `longest_side` pixels along a side.
    ///
    /// # Errors
    /// When there is too little memory.
    pub fn new(picture: &Picture, development: &Development, longest_side: u32) -> Result<Self, PageError> {
        let longest_side = longest_side.max(1);
        let shown = Arc::new(small(picture, development, longest_side)?);
        Ok(Self { codes: Codes8::new(picture, development)?, shown, longest_side })
    }
}

impl Evidence {
    /// Compares a picture, developed as it is shown, with the exact one. Its stored pixels lie as `orientation` says.
    ///
    /// # Errors
    /// When there is too little memory.
    pub fn new(
        picture: &Picture,
        development: &Development,
        orientation: Orientation,
        exact: &ExactPicture,
    ) -> Result<Self, PageError> {
        let codes = Codes8::new(picture, development)?;
        let shown = small(picture, development, exact.longest_side)?;
        let worst = worst(&codes, orientation, &exact.codes)?;
        Ok(Self { picture: shown, exact: Arc::clone(&exact.shown), worst })
    }

    /// Pictures of a pixel.
    #[cfg(test)]
    pub(super) fn for_tests() -> Self {
        let exact = Picture::from_fn(2, 1, |_, _| [0.5; 3]).unwrap();
        let picture = Picture::from_fn(2, 1, |x, _| [0.5 * x as f32; 3]).unwrap();
        let development = Development::default();
        let exact = ExactPicture::new(&exact, &development, ExactPicture::LONGEST_SIDE).unwrap();
        Self::new(&picture, &development, Orientation::Upright, &exact).unwrap()
    }
}

/// A picture as codes of 8 bits.
#[derive(Clone, Debug)]
struct Codes8 {
    size: [u32; 2],
    developed: Developed,
}

impl Codes8 {
    fn new(picture: &Picture, development: &Development) -> Result<Self, SizeError> {
        let developed = development.develop(picture, BitDepth::Eight)?;
        Ok(Self { size: [picture.width(), picture.height()], developed })
    }

    /// The codes of a pixel; black outside.
    fn at(&self, [x, y]: [u32; 2]) -> [u8; 3] {
        let Codes::Eight(codes) = self.developed.codes() else { return [0; 3] };
        let start = 3 * (u64::from(y) * u64::from(self.size[0]) + u64::from(x)) as usize;
        codes.get(start..start + 3).and_then(|codes| codes.try_into().ok()).unwrap_or_default()
    }
}

/// The pixel that differs most, the first of several.
fn worst(found: &Codes8, orientation: Orientation, exact: &Codes8) -> Result<Option<WorstPlace>, PageError> {
    let [width, height] = exact.size;
    let stored = |pixel: [u32; 2]| orientation.stored(pixel, found.size);
    let mut most = (0, [0; 2]);
    for pixel in (0..height).flat_map(|y| (0..width).map(move |x| [x, y])) {
        let (one, other) = (found.at(stored(pixel)), exact.at(pixel));
        let difference = one.iter().zip(other).map(|(one, other)| one.abs_diff(other)).max().unwrap_or(0);
        if difference > most.0 {
            most = (difference, pixel);
        }
    }
    let (difference, pixel) = most;
    if difference == 0 {
        return Ok(None);
    }
    let side = [width, height].map(|side| side.min(DETAIL));
    // Inside of the picture.
    let start = |place: u32, all: u32, side: u32| place.saturating_sub(side / 2).min(all - side);
    let start = [start(pixel[0], width, side[0]), start(pixel[1], height, side[1])];
    let detail = |codes: &dyn Fn([u32; 2]) -> [u8; 3]| -> Result<ShownPicture, PageError> {
        let light = |code: u8| catoptric_picture::srgb::decode(f64::from(code) / 255.0) as f32;
        let picture =
            Picture::from_fn(side[0], side[1], |x, y| codes([start[0] + x, start[1] + y]).map(light))?;
        let png = encode_png(&Development::default().develop(&picture, BitDepth::Eight)?)?;
        Ok(ShownPicture { png, size: side })
    };
    Ok(Some(WorstPlace {
        stored: stored(pixel),
        pixel,
        found: found.at(stored(pixel)),
        exact: exact.at(pixel),
        details: [detail(&|pixel| found.at(stored(pixel)))?, detail(&|pixel| exact.at(pixel))?],
        middle: [pixel[0] - start[0], pixel[1] - start[1]],
    }))
}

/// The picture, its pixels averaged until its longest side is short enough.
fn small(picture: &Picture, development: &Development, longest_side: u32) -> Result<ShownPicture, PageError> {
    let size = [picture.width(), picture.height()];
    let step = size[0].max(size[1]).div_ceil(longest_side);
    if step <= 1 {
        let png = encode_png(&development.develop(picture, BitDepth::Eight)?)?;
        return Ok(ShownPicture { png, size });
    }
    let mean = |x: u32, y: u32| {
        let (mut sum, mut count) = ([0.0_f32; 3], 0.0_f32);
        for y in step * y..(step * (y + 1)).min(size[1]) {
            for x in step * x..(step * (x + 1)).min(size[0]) {
                let light = picture.pixel(x, y).unwrap_or_default();
                sum.iter_mut().zip(light).for_each(|(sum, light)| *sum += light.clamp(0.0, 1.0));
                count += 1.0;
            }
        }
        sum.map(|sum| sum / count.max(1.0))
    };
    let reduced = Picture::from_fn(size[0].div_ceil(step), size[1].div_ceil(step), mean)?;
    let png = encode_png(&development.develop(&reduced, BitDepth::Eight)?)?;
    Ok(ShownPicture { png, size })
}

#[cfg(test)]
mod tests {
    use catoptric_picture::decode;

    use super::*;

    fn evidence(picture: &Picture, exact: &Picture, orientation: Orientation) -> Evidence {
        let development = Development::default();
        let exact = ExactPicture::new(exact, &development, ExactPicture::LONGEST_SIDE).unwrap();
        Evidence::new(picture, &development, orientation, &exact).unwrap()
    }

    #[test]
    fn the_worst_pixel_is_found_where_it_is_stored() {
        let exact = Picture::from_fn(40, 30, |x, _| [x as f32 / 40.0; 3]).unwrap();
        // Upside down, and one pixel is white.
        let mut picture = Picture::from_fn(40, 30, |x, _| [(39 - x) as f32 / 40.0; 3]).unwrap();
        *picture.pixels_mut().get_mut(2 * 40 + 35).unwrap() = [1.0; 3];
        let found = evidence(&picture, &exact, Orientation::UpsideDown);
        let worst = found.worst.unwrap();
        assert_eq!((worst.stored, worst.pixel), ([35, 2], [4, 27]));
        assert_eq!((worst.found, worst.exact), ([255; 3], [89; 3]));
        assert_eq!((worst.middle, worst.details[0].size), ([4, 12], [15, 15]));
        let [x, y] = worst.middle;
        let shown = worst.details.map(|detail| decode(&detail.png).unwrap().pixel(x, y).unwrap()[0]);
        assert!(shown[0] == 1.0 && (shown[1] - 0.1).abs() < 0.01, "{shown:?}");
        assert_eq!(evidence(&exact, &exact, Orientation::Upright).worst, None);
    }

    #[test]
    fn large_pictures_are_shown_small() {
        let exact = Picture::from_fn(1000, 10, |x, _| [(x % 2) as f32; 3]).unwrap();
        let shown = evidence(&exact, &exact, Orientation::Upright).picture;
        assert_eq!(shown.size, [1000, 10]);
        let small = decode(&shown.png).unwrap();
        assert_eq!((small.width(), small.height()), (250, 3));
        assert!((small.pixel(7, 0).unwrap()[0] - 0.5).abs() < 0.01, "the mean of black and white");
    }
}
