//! The color spaces of ꟻLIP (section 4.1 and appendix of the paper), all from linear light of Rec. 709 primaries.

/// CIE XYZ from linear light: the primaries and the white of Rec. 709 as exact fractions.
const XYZ_FROM_RGB: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

/// Linear light from CIE XYZ, the inverse of the above.
const RGB_FROM_XYZ: [[f64; 3]; 3] = [
    [3.241_003_232_976_361, -1.537_398_969_488_785, -0.498_615_881_996_362_9],
    [-0.969_224_252_202_516_2, 1.875_929_983_695_176, 0.041_554_226_340_084_72],
    [0.055_639_419_851_975_95, -0.204_011_206_123_909_97, 1.057_148_977_187_533_6],
];

/// XYZ of white, the sums of the rows above.
const WHITE: [f64; 3] = [0.950_428_545_377_181, 1.0, 1.088_900_370_798_128];

fn times(matrix: &[[f64; 3]; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    matrix.map(|[a, b, c]| a * x + b * y + c * z)
}

/// XYZ as parts of white.
fn relative_xyz(light: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = times(&XYZ_FROM_RGB, light);
    let [white_x, white_y, white_z] = WHITE;
    [x / white_x, y / white_y, z / white_z]
}

/// YCxCz, a linear form of L\*a\*b\*, in which pictures are filtered.
pub(super) fn ycxcz_from_linear(light: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = relative_xyz(light.map(f64::from));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)].map(|value| value as f32)
}

/// Linear light, clamped to 0…1.
pub(super) fn linear_from_ycxcz(color: [f32; 3]) -> [f64; 3] {
    let [luminance, cx, cz] = color.map(f64::from);
    let y = (luminance + 16.0) / 116.0;
    let [white_x, white_y, white_z] = WHITE;
    let xyz = [(y + cx / 500.0) * white_x, y * white_y, (y - cz / 200.0) * white_z];
    times(&RGB_FROM_XYZ, xyz).map(|value| value.clamp(0.0, 1.0))
}

/// L\*a\*b\* with the chroma after Hunt: a\* and b\* times L\*/100.
pub(super) fn hunt_lab_from_linear(light: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let [x, y, z] = relative_xyz(light).map(|value: f64| {
        if value > DELTA * DELTA * DELTA { value.cbrt() } else { value / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
    });
    let lightness = 116.0 * y - 16.0;
    [lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)]
}

/// The HyAB distance: |ΔL| plus the Euclidean distance of the chroma.
pub(super) fn hyab(one: [f64; 3], other: [f64; 3]) -> f64 {
    let [lightness, a, b] = [0, 1, 2].map(|axis: usize| match (one.get(axis), other.get(axis)) {
        (Some(one), Some(other)) => one - other,
        _ => 0.0,
    });
    lightness.abs() + a.hypot(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        for light in [[0.0; 3], [1.0; 3], [0.2, 0.7, 0.1], [1.0, 0.0, 0.5]] {
            let back = linear_from_ycxcz(ycxcz_from_linear(light));
            for (one, other) in back.into_iter().zip(light) {
                assert!((one - f64::from(other)).abs() < 1e-5, "{light:?} {back:?}");
            }
        }
        let white = times(&XYZ_FROM_RGB, [1.0; 3]);
        assert!(white.iter().zip(WHITE).all(|(one, other)| (one - other).abs() < 1e-12), "{white:?}");
    }

    #[test]
    fn black_and_white_are_a_hundred_apart() {
        let (black, white) = (hunt_lab_from_linear([0.0; 3]), hunt_lab_from_linear([1.0; 3]));
        assert!((hyab(black, white) - 100.0).abs() < 1e-9);
    }
}
