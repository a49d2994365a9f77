//! Clear substances with known dispersion.

use crate::dispersion::Dispersion;

/// A clear substance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearSubstance {
    /// The substance's name in scene files.
    pub name: &'static str,
    /// Refractive index by wavelength.
    pub dispersion: Dispersion,
    /// Where the numbers come from.
    pub source: &'static str,
}

impl ClearSubstance {
    /// The substance of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        CLEAR.iter().find(|clear| clear.name == name)
    }
}

/// Clear substances, by rising index. Of crystals with two indices, the ordinary one.
pub const CLEAR: &[ClearSubstance] = &[
    ClearSubstance {
        name: "ice",
        dispersion: Dispersion::Measured(ICE),
        source: "S. G. Warren, R. E. Brandt, Optical constants of ice from the ultraviolet to the microwave, J. Geophys. Res. \
                 113, D14220 (2008); -7 °C",
    },
    ClearSubstance {
        name: "water",
        dispersion: Dispersion::Sellmeier(&[
            [5.684_027_565e-1, 5.101_829_712e-3],
            [1.726_177_391e-1, 1.821_153_936e-2],
            [2.086_189_578e-2, 2.620_722_293e-2],
            [1.130_748_688e-1, 1.069_792_721e1],
        ]),
        source: "M. Daimon, A. Masumura, Measurement of the refractive index of distilled water, Appl. Opt. 46, 3811 (2007); \
                 20 °C",
    },
    ClearSubstance {
        name: "fused-silica",
        dispersion: Dispersion::Sellmeier(&[
            [0.696_166_3, 0.068_404_3 * 0.068_404_3],
            [0.407_942_6, 0.116_241_4 * 0.116_241_4],
            [0.897_479_4, 9.896_161 * 9.896_161],
        ]),
        source: "I. H. Malitson, Interspecimen comparison of the refractive index of fused silica, J. Opt. Soc. Am. 55, 1205 \
                 (1965); 20 °C",
    },
    ClearSubstance {
        name: "acrylic",
        dispersion: Dispersion::Sellmeier(&[[1.1819, 0.011_313]]),
        source: "N. Sultanova, S. Kasarova, I. Nikolov, Dispersion properties of optical polymers, Acta Phys. Pol. A 116, \
                 585 (2009), fitted by M. Polyanskiy; 20 °C",
    },
    ClearSubstance {
        name: "crown-glass",
        dispersion: Dispersion::Sellmeier(&[
            [1.039_612_12, 0.006_000_698_67],
            [0.231_792_344, 0.020_017_914_4],
            [1.010_469_45, 103.560_653],
        ]),
        source: "Schott, optical glass catalog (2017), N-BK7; 20 °C",
    },
    ClearSubstance {
        name: "window-glass",
        dispersion: Dispersion::Rubin([1.5130, -0.003_169, 0.003_962]),
        source: "M. Rubin, Optical properties of soda lime silica glasses, Sol. Energy Mater. 12, 275 (1985), clear",
    },
    ClearSubstance {
        name: "polycarbonate",
        dispersion: Dispersion::Sellmeier(&[[1.4182, 0.021_304]]),
        source: "N. Sultanova, S. Kasarova, I. Nikolov, Dispersion properties of optical polymers, Acta Phys. Pol. A 116, \
                 585 (2009), fitted by M. Polyanskiy; 20 °C",
    },
    ClearSubstance {
        name: "flint-glass",
        dispersion: Dispersion::Sellmeier(&[
            [1.345_333_59, 0.009_977_438_71],
            [0.209_073_176, 0.047_045_076_7],
            [0.937_357_162, 111.886_764],
        ]),
        source: "Schott, optical glass catalog (2017), F2; 20 °C",
    },
    ClearSubstance {
        name: "sapphire",
        dispersion: Dispersion::Sellmeier(&[
            [1.431_349_3, 0.072_663_1 * 0.072_663_1],
            [0.650_547_13, 0.119_324_2 * 0.119_324_2],
            [5.341_402_1, 18.028_251 * 18.028_251],
        ]),
        source: "I. H. Malitson, M. J. Dodge, Refractive index and birefringence of synthetic sapphire, J. Opt. Soc. Am. 62, \
                 1405 (1972), ordinary ray; 20 °C",
    },
    ClearSubstance {
        name: "dense-flint-glass",
        dispersion: Dispersion::Sellmeier(&[
            [1.737_596_95, 0.013_188_707],
            [0.313_747_346, 0.062_306_814_2],
            [1.898_781_01, 155.236_29],
        ]),
        source: "Schott, optical glass catalog (2017), N-SF11; 20 °C",
    },
    ClearSubstance {
        name: "diamond",
        dispersion: Dispersion::Sellmeier(&[[0.3306, 0.1750 * 0.1750], [4.3356, 0.1060 * 0.1060]]),
        source: "F. Peter, Über Brechungsindizes und Absorptionskonstanten des Diamanten, Z. Phys. 15, 358 (1923)",
    },
];

/// Warren and Brandt's points from 380 to 780 nm.
const ICE: &[[f64; 2]] = &[
    [350.0, 1.3249],
    [400.0, 1.3194],
    [420.0, 1.3177],
    [440.0, 1.3163],
    [460.0, 1.3151],
    [480.0, 1.314],
    [500.0, 1.313],
    [520.0, 1.3121],
    [540.0, 1.3114],
    [560.0, 1.3106],
    [580.0, 1.31],
    [600.0, 1.3094],
    [620.0, 1.3088],
    [640.0, 1.3083],
    [660.0, 1.3078],
    [680.0, 1.3073],
    [700.0, 1.3069],
    [720.0, 1.3065],
    [740.0, 1.306],
    [760.0, 1.3057],
    [780.0, 1.3053],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dispersion::FraunhoferLines;

    #[test]
    fn indices_and_abbe_numbers_are_those_of_catalogs() {
        for (name, index, abbe, within) in [
            ("water", 1.3334, 55.7, 0.6),
            ("fused-silica", 1.458_46, 67.82, 0.02),
            ("crown-glass", 1.516_80, 64.17, 0.01),
            ("flint-glass", 1.620_04, 36.37, 0.01),
            ("dense-flint-glass", 1.784_72, 25.68, 0.01),
            ("acrylic", 1.4914, 55.3, 3.0),
            ("polycarbonate", 1.5848, 28.0, 2.0),
            ("sapphire", 1.768_2, 72.2, 0.3),
            ("diamond", 2.417_5, 55.3, 3.0),
            ("ice", 1.3098, 56.0, 8.0),
            ("window-glass", 1.5233, 64.0, 1.0),
        ] {
            let dispersion = ClearSubstance::named(name).unwrap().dispersion;
            let found = dispersion.index(FraunhoferLines::D);
            assert!((found - index).abs() < 1.5e-3, "{name}: {found}");
            assert!((dispersion.abbe() - abbe).abs() < within, "{name}: {}", dispersion.abbe());
        }
    }

    #[test]
    fn substances_rise_and_bend_blue_most() {
        let at_d = |clear: &ClearSubstance| clear.dispersion.index(FraunhoferLines::D);
        assert!(CLEAR.windows(2).all(|pair| at_d(&pair[0]) < at_d(&pair[1])));
        for clear in CLEAR {
            let indices: Vec<f64> =
                (380..=780).map(|nanometers| clear.dispersion.index(f64::from(nanometers))).collect();
            assert!(indices.windows(2).all(|pair| pair[0] >= pair[1]), "{}", clear.name);
        }
        assert!(ClearSubstance::named("unobtainium").is_none());
    }
}
