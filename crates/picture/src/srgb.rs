//! The sRGB transfer function: between linear light and display values.
//!
//! Source: IEC 61966-2-1:1999, section 5.2, with its own rounded constants (the two branches meet
//! within 10⁻⁷ there). Both functions take any number and clamp: below 0 and NaN give 0, above 1 gives 1.
//!
//! ```
//! use catoptric_picture::srgb;
//! assert!((srgb::encode(0.5) - 0.735357).abs() < 1e-6);
//! assert!((srgb::decode(0.5) - 0.214041).abs() < 1e-6);
//! ```

/// Display value in 0…1 for a linear value: 12.92 x up to 0.0031308, then 1.055 x^(1/2.4) − 0.055.
pub fn encode(linear: f64) -> f64 {
    let x = unit(linear);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// Linear value in 0…1 for a display value: v / 12.92 up to 0.04045, then ((v + 0.055) / 1.055)^2.4.
pub fn decode(display: f64) -> f64 {
    let v = unit(display);
    if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

/// Into 0…1; NaN becomes 0, since `max` prefers the number.
#[expect(clippy::manual_clamp, reason = "NaN must become 0")]
fn unit(x: f64) -> f64 {
    x.max(0.0).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        // Linear value of display codes, from the standard's formula worked in 50 digits.
        for (code, linear) in [
            (0.0, 0.0),
            (1.0, 0.000_303_526_983_548_837_5),
            (10.0, 0.003_035_269_835_488_375),
            (11.0, 0.003_346_535_763_899_161),
            (128.0, 0.215_860_500_113_899_26),
            (188.0, 0.502_886_458_032_500_6),
            (255.0, 1.0),
        ] {
            let display = code / 255.0;
            assert!((decode(display) - linear).abs() < 1e-12, "decode {code}: {}", decode(display));
            assert!((encode(linear) - display).abs() < 1e-7, "encode {code}: {}", encode(linear));
        }
    }

    #[test]
    fn out_of_range_and_not_a_number() {
        for f in [encode, decode] {
            assert_eq!(f(-1.0), 0.0);
            assert_eq!(f(f64::NEG_INFINITY), 0.0);
            assert_eq!(f(f64::NAN), 0.0);
            // One step below 1 in the encoding, where 1.055 − 0.055 is rounded.
            assert!((f(2.0) - 1.0).abs() <= f64::EPSILON);
            assert_eq!(f(f64::INFINITY), f(1.0));
        }
    }

    #[test]
    fn monotonic() {
        let values: Vec<f64> = (0..=100_000).map(|i| encode(f64::from(i) / 100_000.0)).collect();
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
