//! The color scale "inferno": black → violet → orange → pale yellow, with even steps of perceived lightness.
//!
//! Source: S. van der Walt, N. Smith, matplotlib 1.5 (CC0); here as the polynomial fit of sixth degree by
//! M. Zucker, "perceptually uniform colormaps", 2019 (public domain), within 0.02 of the table.

/// Coefficients of t⁰ … t⁶ for red, green, blue.
const COEFFICIENTS: [[f64; 3]; 7] = [
    [0.000_218_940_369_119_226_5, 0.001_651_004_631_001_012, -0.019_480_898_437_091_84],
    [0.106_513_419_485_611_6, 0.563_956_436_788_409_1, 3.932_712_388_889_277],
    [11.602_493_082_471_87, -3.972_853_965_665_698, -15.942_394_106_291_4],
    [-41.703_996_131_394_59, 17.436_398_882_053_13, 44.354_145_198_728_13],
    [77.162_935_699_427, -33.402_358_942_100_92, -81.807_309_257_389_93],
    [-71.319_428_244_992_14, 32.626_064_263_977_23, 73.209_519_858_032_02],
    [25.131_126_224_773_41, -12.242_668_952_385_67, -23.070_325_002_871_72],
];

/// The sRGB color at `t`, clamped to 0…1 (NaN gives the top, since it must not look harmless).
pub fn inferno(t: f64) -> [f64; 3] {
    let t = if t.is_nan() { 1.0 } else { t.clamp(0.0, 1.0) };
    let mut color = [0.0; 3];
    for row in COEFFICIENTS.iter().rev() {
        for (channel, coefficient) in color.iter_mut().zip(row) {
            *channel = *channel * t + coefficient;
        }
    }
    color.map(|channel: f64| channel.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::srgb;

    #[test]
    fn near_the_published_table() {
        for (t, color) in [
            (0.0, [0.001462, 0.000466, 0.013866]),
            (128.0 / 255.0, [0.735683, 0.215906, 0.330245]),
            (1.0, [0.988362, 0.998364, 0.644924]),
        ] {
            for (ours, theirs) in inferno(t).into_iter().zip(color) {
                assert!((ours - theirs).abs() < 0.02, "{t}: {:?}", inferno(t));
            }
        }
    }

    #[test]
    fn dark_at_zero_and_ever_lighter() {
        assert!(inferno(0.0).iter().all(|&channel| channel < 0.002));
        let luminance = |t: f64| {
            let [r, g, b] = inferno(t).map(srgb::decode);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let values: Vec<f64> = (0..=200).map(|i| luminance(f64::from(i) / 200.0)).collect();
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "{values:?}");
    }
}
