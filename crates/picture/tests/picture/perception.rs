//! How different pictures look, against the published programs.
//!
//! The expected numbers come from `flip-evaluator` 1.7 (the authors' own, from PyPI) by
//! `evaluate(reference, test, "LDR" or "HDR", inputsRGB=False, applyMagma=False)`, and from scikit-image 0.26 by
//! `structural_similarity(a, b, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1)` on
//! Y′ = 0.2126 R′ + 0.7152 G′ + 0.0722 B′ in double precision, of the very pictures that are made here by rule.

use catoptric_picture::{CompareError, Flip, HeatMap, Picture, ssim};
use proptest::prelude::*;

type Color = [f32; 3];

fn make(width: u32, height: u32, color: impl Fn(u32, u32) -> Color) -> Picture {
    Picture::from_fn(width, height, color).unwrap()
}

/// A number in 0…1 that looks random.
fn noise(x: u32, y: u32, channel: u32) -> f32 {
    let mixed = x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663) ^ channel.wrapping_mul(83_492_791);
    (mixed.wrapping_mul(2_654_435_761) >> 16) as f32 / 65535.0
}

/// Two discs on a gradient, the red one moved to the right.
fn discs(x: u32, y: u32, shift: i64) -> Color {
    let inside = |center_x: i64, center_y: i64, radius: i64| {
        let (x, y) = (i64::from(x) - center_x, i64::from(y) - center_y);
        x * x + y * y <= radius * radius
    };
    if inside(20 + shift, 18, 11) {
        [0.9, 0.15, 0.1]
    } else if inside(44, 30, 13) {
        if (x / 4 + y / 4).is_multiple_of(2) { [0.1, 0.25, 0.8] } else { [0.95, 0.9, 0.2] }
    } else {
        [x as f32 / 63.0 * 0.5, y as f32 / 47.0 * 0.5, 0.5]
    }
}

fn pair(name: &str) -> (Picture, Picture) {
    let checker = |x: u32, y: u32| [((x / 2 + y / 2) % 2) as f32; 3];
    match name {
        "shifted" => (make(64, 48, |x, y| discs(x, y, 0)), make(64, 48, |x, y| discs(x, y, 3))),
        "noisy" => {
            let noisy = |x, y| {
                let light = discs(x, y, 0);
                [0, 1, 2].map(|c: u32| light[c as usize] * 0.75 + noise(x, y, c) * 0.25)
            };
            (make(64, 48, |x, y| discs(x, y, 0)), make(64, 48, noisy))
        }
        "checker" => (make(40, 40, checker), make(40, 40, |x, y| [((x / 2 + y.div_ceil(2)) % 2) as f32; 3])),
        "tint" => (make(33, 17, |_, _| [0.5; 3]), make(33, 17, |_, _| [0.5, 0.45, 0.55])),
        "sliver" => (
            make(3, 50, |_, y| [y as f32 / 49.0; 3]),
            make(3, 50, |_, y| [y as f32 / 49.0, (49 - y) as f32 / 49.0, 0.25]),
        ),
        "opposite" => (make(16, 16, |_, _| [0.0; 3]), make(16, 16, |_, _| [1.0; 3])),
        other => panic!("no pair {other}"),
    }
}

/// The picture under a light that grows downwards to far beyond white.
fn lit(picture: &Picture) -> Picture {
    make(picture.width(), picture.height(), |x, y| {
        let gain = y as f32 / 8.0;
        picture.pixel(x, y).unwrap().map(|value| value * (0.0625 + gain * gain))
    })
}

#[test]
fn flip_is_that_of_its_authors() {
    let sparse = Flip { pixels_per_degree: 30.0 };
    for (name, mean, largest, mean_at_30) in [
        ("shifted", 0.079_091, 0.751_75, 0.064_677),
        ("noisy", 0.326_233, 0.671_68, 0.388_151),
        ("checker", 0.103_405, 0.848_75, 0.450_842),
        ("tint", 0.271_729, 0.271_73, 0.271_715),
        ("sliver", 0.864_151, 0.988_27, 0.854_219),
        ("opposite", 0.967_391, 0.967_39, 0.967_388),
    ] {
        let (reference, test) = pair(name);
        let map = Flip::default().compare(&reference, &test).unwrap();
        assert!((map.mean() - mean).abs() < 5e-5, "{name}: {map:?}, {mean} expected");
        let worst = map.errors().iter().fold(0.0_f32, |worst, &error| worst.max(error));
        assert!((worst - largest).abs() < 1e-4, "{name}: {worst}");
        let map = sparse.compare(&reference, &test).unwrap();
        assert!((map.mean() - mean_at_30).abs() < 5e-5, "{name} at 30: {map:?}, {mean_at_30} expected");
    }
}

#[test]
fn flip_of_light_beyond_white_is_that_of_its_authors() {
    for (name, mean, largest) in [
        ("shifted", 0.072_398, 0.652_62),
        ("noisy", 0.341_490, 0.847_78),
        ("checker", 0.124_735, 0.848_75),
        ("sliver", 0.792_409, 0.984_14),
    ] {
        let (reference, test) = pair(name);
        let map = Flip::default().compare_hdr(&lit(&reference), &lit(&test)).unwrap();
        assert!((map.mean() - mean).abs() < 5e-5, "{name}: {map:?}, {mean} expected");
        let worst = map.errors().iter().fold(0.0_f32, |worst, &error| worst.max(error));
        assert!((worst - largest).abs() < 1e-4, "{name}: {worst}");
    }
}

#[test]
fn similarity_is_that_of_another_program() {
    for (name, expected) in [
        ("shifted", 0.940_281_488),
        ("noisy", 0.536_603_524),
        ("checker", 0.001_796_763),
        ("tint", 0.999_540_347),
        ("opposite", 0.000_099_990),
    ] {
        let (a, b) = pair(name);
        let found = ssim(&a, &b).unwrap();
        assert!((found - expected).abs() < 1e-6, "{name}: {found}, {expected} expected");
        assert_eq!(ssim(&b, &a).unwrap(), found, "{name}");
    }
}

#[test]
fn constant_pictures_follow_the_formula() {
    // Without variance the similarity is (2 a b + C₁) / (a² + b² + C₁).
    let gray = |value: f64| make(20, 12, |_, _| [catoptric_picture::srgb::decode(value) as f32; 3]);
    let found = ssim(&gray(0.5), &gray(0.75)).unwrap();
    let expected = (2.0 * 0.5 * 0.75 + 1e-4) / (0.25 + 0.5625 + 1e-4);
    assert!((found - expected).abs() < 1e-6, "{found} {expected}");
}

#[test]
fn what_a_display_shows_alike_is_alike() {
    let shown = make(12, 12, |x, _| [if x < 6 { 1.0 } else { 0.0 }; 3]);
    let beyond = make(12, 12, |x, y| match (x < 6, y % 2) {
        (true, _) => [f32::INFINITY, 7.0, 1.0],
        (false, 0) => [-1.0, f32::NAN, 0.0],
        (false, _) => [f32::NEG_INFINITY; 3],
    });
    assert!((ssim(&shown, &beyond).unwrap() - 1.0).abs() < 1e-12);
    assert!(Flip::default().compare(&shown, &beyond).unwrap().mean() < 1e-6);
    // Beyond white, a display of higher range tells them apart.
    assert!(Flip::default().compare_hdr(&shown, &beyond).unwrap().mean().is_finite());
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let (small, wide) = (make(10, 50, |_, _| [0.0; 3]), make(50, 10, |_, _| [0.0; 3]));
    assert!(matches!(ssim(&small, &wide), Err(CompareError::Mismatch(_))));
    assert!(matches!(ssim(&small, &small), Err(CompareError::TooSmall { width: 10, height: 50 })));
    assert!(ssim(&small, &small).unwrap_err().to_string().contains("11x11"));
    assert!(matches!(Flip::default().compare(&small, &wide), Err(CompareError::Mismatch(_))));
    for pixels_per_degree in [0.0, -5.0, f64::NAN, f64::INFINITY] {
        let map = Flip { pixels_per_degree }.compare(&small, &small).unwrap();
        assert_eq!(map.mean(), 0.0, "{pixels_per_degree}");
    }
}

#[test]
fn the_map_is_drawn_on_the_scale() {
    let (reference, test) = pair("shifted");
    let map = Flip::default().compare(&reference, &test).unwrap();
    let options = HeatMap { maximum: 1.0, legend: false, ..HeatMap::default() };
    let picture = map.heat_map(&options).unwrap();
    assert_eq!((picture.width(), picture.height()), (64, 48));
    let light = |x, y| picture.pixel(x, y).unwrap().iter().sum::<f32>();
    assert!(light(32, 18) > 10.0 * light(2, 44), "the moved edge is light, a corner far from it dark");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn any_pictures_are_compared(
        width in 1_u32..24, height in 1_u32..24, seed: u32, odd in proptest::collection::vec(any::<f32>(), 4),
    ) {
        let random = |seed: u32| make(width, height, |x, y| [0, 1, 2].map(|c| noise(x + seed % 977, y, c)));
        let (a, mut b) = (random(seed), random(seed.wrapping_add(1)));
        b.pixels_mut().iter_mut().zip(odd).for_each(|(pixel, value)| pixel[1] = value);
        let flip = Flip::default();
        for map in [flip.compare(&a, &b).unwrap(), flip.compare_hdr(&b, &a).unwrap()] {
            prop_assert!(map.errors().iter().all(|error| (0.0..=1.0).contains(error)), "{map:?}");
        }
        prop_assert_eq!(flip.compare(&a, &a).unwrap().mean(), 0.0);
        if let Ok(similarity) = ssim(&a, &b) {
            prop_assert!((-1.0..=1.0).contains(&similarity));
            prop_assert!((ssim(&a, &a).unwrap() - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn pictures_are_compared_band_by_band_without_seams() {
    // Rows of a period, so that every band but those at the border sees the same; the pictures have several bands.
    let (width, height, period) = (40, 15_000, 50);
    let reference = make(width, height, |x, y| [0, 1, 2].map(|c| noise(x, y % period, c)));
    let test = make(width, height, |x, y| [0, 1, 2].map(|c| noise(x + 1, y % period, c)));
    let map = Flip::default().compare(&reference, &test).unwrap();
    let rows: Vec<&[f32]> = map.errors().chunks(width as usize).collect();
    for y in period..height - period {
        let same = period + y % period;
        assert!(rows[y as usize] == rows[same as usize], "row {y}");
    }
}
