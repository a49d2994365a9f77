//! Blocks of pixels, and where their light goes.

use super::*;
use crate::simd::scalar::ScalarWidth;

#[test]
fn a_block_at_the_border_has_no_pixels_beyond_it() {
    let place = TileRect { x: 64, y: 0, width: 3, height: 2 };
    assert_eq!(PixelBlock::<ScalarWidth>::lanes(place, 2, 1), 1);
    assert_eq!(PixelBlock::<ScalarWidth>::lanes(place, 3, 1), 0);
}

/// Pixels are numbered by blocks and handed out by rows, whatever the size of the tile.
#[test]
fn light_comes_back_row_by_row() {
    let place = TileRect { x: 0, y: 0, width: 7, height: 6 };
    let mut light = TileRadiance::default();
    light.begin(place, [4, 4]);
    for block in 0..4 {
        let (left, top) = (4 * (block % 2), 4 * (block / 2));
        for lane in 0..16 {
            let at = [left + lane % 4, top + lane / 4, 1].map(|number| number as f32);
            light.set::<ScalarWidth>(16 * block + lane, Vector::from(glam::Vec3::from(at)));
        }
    }
    for y in 0..place.height {
        let mut row = vec![[0.0; 3]; place.width];
        light.each(y, &mut row, |pixel, light| *pixel = light);
        let wanted: Vec<[f32; 3]> = (0..place.width).map(|x| [x as f32, y as f32, 1.0]).collect();
        assert_eq!(row, wanted);
    }
}
