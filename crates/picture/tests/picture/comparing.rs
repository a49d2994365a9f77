//! The comparer: it must find what is wrong, wherever it is.

use catoptric_picture::{
    BitDepth, Codes, CompareError, Comparison, Development, Difference, HeatMap, Picture, SizeMismatch,
    decode, encode_png, heat_map,
};
use proptest::prelude::*;

fn picture(width: u32, height: u32) -> Picture {
    Picture::from_fn(width, height, |x, y| [0.1 + x as f32 * 0.01, 0.5, 0.9 - y as f32 * 0.01]).unwrap()
}

/// The picture with `amount` added to one channel of one pixel.
fn wrong_at(picture: &Picture, x: u32, y: u32, channel: usize, amount: f32) -> Picture {
    let mut wrong = picture.clone();
    wrong.pixels_mut()[(y * picture.width() + x) as usize][channel] += amount;
    wrong
}

#[test]
fn equal_pictures_pass() {
    let a = picture(16, 9);
    let difference = Difference::between(&a, &a.clone()).unwrap();
    assert_eq!((difference.max, difference.mean, difference.rmse), (0.0, 0.0, 0.0));
    assert_eq!(difference.psnr_db, f64::INFINITY);
    assert_eq!((difference.above, difference.share_above, difference.worst), (0, 0.0, None));
}

#[test]
fn one_wrong_channel_at_any_corner_is_caught() {
    let a = picture(16, 9);
    for (x, y) in [(0, 0), (15, 0), (0, 8), (15, 8), (7, 4)] {
        for channel in 0..3 {
            for amount in [0.005, -0.005] {
                let b = wrong_at(&a, x, y, channel, amount);
                for difference in [Difference::between(&a, &b), Difference::between(&b, &a)] {
                    let difference = difference.unwrap();
                    assert_eq!((difference.above, difference.worst), (1, Some([x, y])));
                    assert_eq!(difference.share_above, 1.0 / 144.0);
                    assert!((difference.max - 0.005).abs() < 1e-6);
                }
            }
        }
    }
}

proptest! {
    #[test]
    fn a_pixel_counts_exactly_when_it_is_off_by_more_than_the_bound(
        width in 1_u32..20, height in 1_u32..20, place: (u32, u32), channel in 0_usize..3, amount in -0.2_f32..0.2,
    ) {
        let a = Picture::from_fn(width, height, |_, _| [0.5; 3]).unwrap();
        let (x, y) = (place.0 % width, place.1 % height);
        let b = wrong_at(&a, x, y, channel, amount);
        let off = (f64::from(0.5_f32 + amount) - 0.5).abs();
        let difference = Difference::between(&a, &b).unwrap();
        prop_assert_eq!(difference.above, u64::from(off > 1.0 / 255.0));
        prop_assert_eq!(difference.max, off);
        prop_assert_eq!(difference.worst, (off > 0.0).then_some([x, y]));
    }
}

#[test]
fn a_difference_of_the_bound_itself_still_passes() {
    let a = Picture::new(1, 1).unwrap();
    let b = wrong_at(&a, 0, 0, 1, 0.25);
    let at = |bound| Comparison { bound, ..Comparison::default() }.compare(&a, &b).unwrap().above;
    assert_eq!(at(0.25), 0);
    assert_eq!(at(0.249_999), 1);
    assert_eq!(at(f64::NAN), 1, "a bound that is no number lets nothing pass");
}

#[test]
fn means_and_psnr_by_hand() {
    // Two of the 2 · 1 · 3 channels are off, by 0.5 and 0.25.
    let a = Picture::new(2, 1).unwrap();
    let b = Picture::from_pixels(2, 1, vec![[0.5, 0.0, 0.0], [0.0, 0.0, 0.25]]).unwrap();
    let difference = Difference::between(&a, &b).unwrap();
    assert_eq!(difference.max, 0.5);
    assert_eq!(difference.mean, 0.75 / 6.0);
    let mse = (0.25 + 0.0625) / 6.0;
    assert!((difference.rmse - f64::sqrt(mse)).abs() < 1e-15);
    // 10 log10(1 / 0.0520833…) = 12.833012 dB.
    assert!((difference.psnr_db - 12.833_012).abs() < 1e-6, "{}", difference.psnr_db);
    assert_eq!(difference.worst, Some([0, 0]));
    assert_eq!(difference.share_above, 1.0);
}

#[test]
fn clamping_hides_what_the_display_cannot_show() {
    let a = Picture::from_pixels(1, 1, vec![[2.0, -1.0, f32::INFINITY]]).unwrap();
    let b = Picture::from_pixels(1, 1, vec![[7.0, 0.0, 1.0]]).unwrap();
    assert_eq!(Difference::between(&a, &b).unwrap().max, 0.0);
    let unclamped = Comparison { clamp: false, ..Comparison::default() };
    assert_eq!(unclamped.compare(&a, &b).unwrap().max, f64::INFINITY);
    assert_eq!(unclamped.compare(&a, &a).unwrap().max, 0.0, "infinity equals itself");
    assert_eq!(unclamped.compare(&a, &b).unwrap().psnr_db, f64::NEG_INFINITY);
}

#[test]
fn not_a_number_never_equals_anything() {
    let a = Picture::from_pixels(2, 1, vec![[0.5; 3], [0.5, f32::NAN, 0.5]]).unwrap();
    let b = Picture::from_pixels(2, 1, vec![[0.5; 3]; 2]).unwrap();
    for (a, b) in [(&a, &b), (&b, &a), (&a, &a)] {
        let clamped = Difference::between(a, b).unwrap();
        assert_eq!((clamped.max, clamped.above, clamped.not_a_number), (1.0, 1, 1));
        assert_eq!(clamped.worst, Some([1, 0]));
        let unclamped = Comparison { clamp: false, bound: f64::INFINITY }.compare(a, b).unwrap();
        assert_eq!((unclamped.max, unclamped.above), (f64::INFINITY, 1));
    }
}

#[test]
fn sizes_must_agree() {
    let error = Difference::between(&picture(3, 2), &picture(2, 3)).unwrap_err();
    assert_eq!(error, SizeMismatch { a: [3, 2], b: [2, 3] });
    assert!(error.to_string().contains("3x2 and 2x3"), "{error}");
    let error = heat_map(&picture(3, 2), &picture(2, 3), &HeatMap::default());
    assert!(matches!(error, Err(CompareError::Mismatch(_))));
}

#[test]
fn equal_pixels_are_dark_and_wrong_ones_are_light() {
    let a = picture(16, 9);
    let b = wrong_at(&wrong_at(&a, 15, 8, 2, 0.05), 0, 0, 0, 0.5);
    let options = HeatMap { maximum: 0.1, legend: false, ..HeatMap::default() };
    let map = heat_map(&a, &b, &options).unwrap();
    assert_eq!((map.width(), map.height()), (16, 9));
    let shown = Development::default().develop(&map, BitDepth::Eight).unwrap();
    let Codes::Eight(codes) = shown.codes() else { panic!("8 bits") };
    let lit: Vec<usize> =
        codes.chunks(3).enumerate().filter(|(_, code)| code.iter().any(|&c| c > 2)).map(|(i, _)| i).collect();
    assert_eq!(lit, [0, 143]);
    // Inferno at 1/2 and at its end, within the fit of the published table.
    let near = |index: usize, color: [u8; 3]| {
        codes[index * 3..][..3].iter().zip(color).all(|(a, b)| a.abs_diff(b) < 6)
    };
    assert!(near(143, [188, 55, 84]) && near(0, [252, 255, 164]), "{codes:?}");
}

#[test]
fn any_difference_is_light_when_the_maximum_is_senseless() {
    let a = picture(2, 1);
    let b = wrong_at(&a, 1, 0, 0, 0.01);
    for maximum in [0.0, -1.0, f64::NAN] {
        let map = heat_map(&a, &b, &HeatMap { maximum, ..HeatMap::default() }).unwrap();
        assert!(map.pixel(0, 0).unwrap()[1] < 0.01);
        assert!(map.pixel(1, 0).unwrap()[1] > 0.9, "{maximum}");
    }
}

#[test]
fn the_legend_shows_the_scale_and_moves_no_pixel() {
    let a = picture(41, 5);
    let mut b = wrong_at(&a, 40, 4, 1, 0.3);
    b.pixels_mut()[3] = [f32::NAN; 3];
    let map = heat_map(&a, &b, &HeatMap::default()).unwrap();
    let plain = heat_map(&a, &b, &HeatMap { legend: false, ..HeatMap::default() }).unwrap();
    assert_eq!(map.pixels()[..41 * 5], plain.pixels()[..]);
    assert_eq!(map.pixel(3, 0), Some([0.0, 1.0, 0.0]), "a NaN is off the scale");
    let ticks: Vec<u32> = (0..41).filter(|&x| map.pixel(x, 5) == Some([1.0; 3])).collect();
    assert_eq!(ticks, [0, 10, 20, 30, 40]);
    assert_eq!(map.pixel(40, map.height() - 1), map.pixel(40, 4), "the scale ends with the top color");
    // It is an ordinary picture.
    let png = encode_png(&Development::default().develop(&map, BitDepth::Eight).unwrap()).unwrap();
    assert_eq!(decode(&png).unwrap().height(), map.height());
}
