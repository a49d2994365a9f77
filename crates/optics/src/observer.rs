//! Colors of spectra.

mod tables;

use std::sync::LazyLock;

/// Wavelengths of the tables.
const COUNT: usize = 81;
/// Visible light as it is taken here, nanometers.
pub const VISIBLE: std::ops::RangeInclusive<f64> = 380.0..=780.0;
/// Between two wavelengths of the tables, nanometers.
const STEP: f64 = 5.0;

/// The primaries' chromaticities x, y of sRGB (IEC 61966-2-1).
const PRIMARIES: [[f64; 2]; 3] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];

/// What each wavelength of daylight adds to linear sRGB; each channel adds up to 1.
static WEIGHTS: LazyLock<[[f64; 3]; COUNT]> = LazyLock::new(weights);

/// Linear sRGB of a reflectance or transmittance by wavelength in nanometers, under daylight (illuminant D65), as the
/// CIE's standard observer of 1931 sees it.
///
/// Sums in steps of 5 nm (CIE 15:2018, section 7.2). A spectrum of 1 gives white, 1, 1, 1. Colors that no mixture of
/// the primaries shows have negative parts, which become 0.
pub fn seen(spectrum: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (nanometers, weights) in wavelengths().zip(WEIGHTS.iter()) {
        let value = spectrum(nanometers);
        for (sum, weight) in sum.iter_mut().zip(weights) {
            *sum += value * weight;
        }
    }
    sum.map(|part| part.max(0.0))
}

/// What daylight around a wavelength adds to linear sRGB, for light of one wavelength in samples: the average over the
/// visible range is 1, 1, 1. Parts are negative where the wavelength's color is outside of sRGB.
pub fn weight(nanometers: f64) -> [f64; 3] {
    let place = ((nanometers - VISIBLE.start()) / STEP).clamp(0.0, (COUNT - 1) as f64);
    let below = place.floor() as usize;
    let share = place - place.floor();
    let at = |index: usize| WEIGHTS.get(index).or(WEIGHTS.last()).copied().unwrap_or_default();
    let (low, high) = (at(below), at(below + 1));
    // Straight lines between the points, so that their integral is a sum with halves at the ends.
    let ends = [at(0), at(COUNT - 1)];
    std::array::from_fn(|channel| {
        let [low, high, first, last] =
            [low, high, ends[0], ends[1]].map(|weights| weights.get(channel).copied().unwrap_or_default());
        let total = 1.0 - 0.5 * (first + last);
        (low + share * (high - low)) * (COUNT - 1) as f64 / total
    })
}

/// Light of one wavelength as a part of daylight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// In vacuum.
    pub nanometers: f64,
    /// Linear sRGB, with negative parts where the color is outside of it.
    pub color: [f64; 3],
}

/// Some waves that make white together, 1, 1, 1: close where the eye is sharp, wide where it sees little.
///
/// `offset`, 0 to 1, shifts all of them by that part of the way to the next: the mean over all offsets is daylight.
pub fn waves(count: usize, offset: f64) -> Vec<Wave> {
    let sharpness = SHARPNESS.last().copied().unwrap_or(1.0);
    let mut waves: Vec<Wave> = (0..count)
        .map(|index| {
            let part = (index as f64 + offset.clamp(0.0, 1.0)) / count as f64 * sharpness;
            let after = SHARPNESS.partition_point(|sum| *sum <= part).clamp(1, COUNT - 1);
            let [low, high] = [after - 1, after].map(|at| SHARPNESS.get(at).copied().unwrap_or_default());
            let nanometers = VISIBLE.start() + STEP * ((after - 1) as f64 + (part - low) / (high - low));
            let density = (high - low) / STEP / sharpness;
            let range = VISIBLE.end() - VISIBLE.start();
            let share = 1.0 / (count as f64 * density * range);
            Wave { nanometers, color: weight(nanometers).map(|part| part * share) }
        })
        .collect();
    // What some points make of an integral is a little off white.
    for channel in 0..3 {
        let sum: f64 = waves.iter().filter_map(|wave| wave.color.get(channel)).sum();
        for part in waves.iter_mut().filter_map(|wave| wave.color.get_mut(channel)) {
            *part /= sum;
        }
    }
    waves
}

/// How much is seen of daylight up to each wavelength of the tables.
static SHARPNESS: LazyLock<[f64; COUNT]> = LazyLock::new(|| {
    let mut sum = 0.0;
    let mut before = None;
    WEIGHTS.map(|weights| {
        // A little everywhere, so that no part of the range is without waves.
        let seen = weights.iter().map(|part| part.abs()).sum::<f64>() + 1e-3;
        sum += before.map_or(0.0, |before| 0.5 * (before + seen));
        before = Some(seen);
        sum
    })
});

fn wavelengths() -> impl Iterator<Item = f64> {
    (0..COUNT).map(|index| VISIBLE.start() + STEP * index as f64)
}

fn weights() -> [[f64; 3]; COUNT] {
    let mut white = [0.0; 3];
    for (power, observer) in tables::D65.iter().zip(tables::OBSERVER) {
        for (sum, part) in white.iter_mut().zip(observer) {
            *sum += power * part;
        }
    }
    let to_rgb = inverse(PRIMARIES.map(|[x, y]| [x / y, 1.0, (1.0 - x - y) / y]));
    let of = |xyz: [f64; 3]| -> [f64; 3] {
        to_rgb.map(|row| row.iter().zip(xyz).map(|(factor, part)| factor * part).sum())
    };
    // How much of each primary makes white.
    let white = of(white);
    let mut weights = [[0.0; 3]; COUNT];
    for ((weights, power), observer) in weights.iter_mut().zip(tables::D65).zip(tables::OBSERVER) {
        for ((weight, part), white) in weights.iter_mut().zip(of(observer)).zip(white) {
            *weight = power * part / white;
        }
    }
    weights
}

/// The rows that solve for the amounts of three columns.
fn inverse([a, b, c]: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant: f64 = a.iter().zip(cross(b, c)).map(|(part, other)| part * other).sum();
    rows.map(|row| row.map(|part| part / determinant))
}

fn cross([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> [f64; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_white_surface_is_white_and_half_of_it_is_gray() {
        for value in [0.0, 0.5, 1.0] {
            assert!(seen(|_| value).iter().all(|part| (part - value).abs() < 1e-12));
        }
    }

    #[test]
    fn daylight_has_its_known_chromaticity() {
        // Published for D65 and the observer of 1931: x = 0.31272, y = 0.32903 (CIE 15).
        let mut sum = [0.0; 3];
        for (power, observer) in tables::D65.iter().zip(tables::OBSERVER) {
            sum = std::array::from_fn(|index| sum[index] + power * observer[index]);
        }
        let whole: f64 = sum.iter().sum();
        assert!((sum[0] / whole - 0.312_72).abs() < 1e-4 && (sum[1] / whole - 0.329_03).abs() < 1e-4);
    }

    #[test]
    fn long_waves_are_red_and_short_ones_blue() {
        let [red, green, blue] = seen(|nanometers| if nanometers > 600.0 { 1.0 } else { 0.0 });
        assert!(red > 0.5 && green < 0.1 && blue < 0.01);
        let [red, green, blue] = seen(|nanometers| if nanometers < 490.0 { 1.0 } else { 0.0 });
        assert!(blue > 0.8 && red < 0.2 && green < 0.2);
    }

    #[test]
    fn waves_make_white_and_shift_over_all_colors() {
        for count in [1, 4, 8] {
            for offset in [0.0, 0.3, 0.5, 1.0] {
                let waves = waves(count, offset);
                assert!(waves.windows(2).all(|pair| pair[0].nanometers < pair[1].nanometers));
                for channel in 0..3 {
                    let sum: f64 = waves.iter().map(|wave| wave.color[channel]).sum();
                    assert!((sum - 1.0).abs() < 1e-12, "{count} {offset} {channel}: {sum}");
                }
            }
        }
        // A glass that lets through the more, the redder light is.
        let glass = |nanometers: f64| 0.2 + 0.8 * ((nanometers - 450.0) / 200.0).clamp(0.0, 1.0);
        let exact = seen(glass);
        let mut mean = [0.0; 3];
        for sample in 0..1000 {
            for wave in waves(8, (f64::from(sample) + 0.5) / 1000.0) {
                for (mean, part) in mean.iter_mut().zip(wave.color) {
                    *mean += part * glass(wave.nanometers) / 1000.0;
                }
            }
        }
        for (mean, exact) in mean.into_iter().zip(exact) {
            assert!((mean - exact).abs() < 0.005, "{mean} instead of {exact}");
        }
    }

    #[test]
    fn weights_of_single_wavelengths_average_to_white() {
        const SAMPLES: usize = 40_000;
        let mut sum = [0.0; 3];
        for index in 0..SAMPLES {
            let nanometers = 380.0 + 400.0 * (index as f64 + 0.5) / SAMPLES as f64;
            let weight = weight(nanometers);
            sum = std::array::from_fn(|channel| sum[channel] + weight[channel] / SAMPLES as f64);
        }
        assert!(sum.iter().all(|part| (part - 1.0).abs() < 1e-6), "{sum:?}");
        assert_eq!(weight(-1e9), weight(380.0));
        assert_eq!(weight(1e9), weight(780.0));
    }
}
