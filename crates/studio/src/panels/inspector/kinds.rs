//! Kinds of reflection and named media: what numbers mean in words.

use catoptric_scene::Phong;

/// A kind of reflection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ReflectionKind {
    /// Diffuse light only.
    Matte,
    /// Diffuse light with a highlight (Phong 1975), and at most a weak mirror image.
    Glossy,
    /// Nearly nothing but mirrored light.
    Mirror,
    /// Light goes through (Whitted 1980).
    Glass,
}

/// A kind of reflection with its coefficients, and the test that recognizes it.
pub(crate) struct CoefficientPreset {
    pub(crate) kind: ReflectionKind,
    /// The message that names it.
    pub(crate) key: &'static str,
    ambient: f64,
    diffuse: f64,
    specular: f64,
    shininess: f64,
    reflection: f64,
    transmission: f64,
    /// Whether a material is of this kind.
    fits: fn(&Phong) -> bool,
}

/// The kinds in the order in which to offer them. No material fits two.
pub(crate) static PRESETS: [CoefficientPreset; 4] = [
    CoefficientPreset {
        kind: ReflectionKind::Matte,
        key: "kind-matte",
        ambient: 0.1,
        diffuse: 0.9,
        specular: 0.0,
        shininess: 32.0,
        reflection: 0.0,
        transmission: 0.0,
        fits: |m| is_opaque(m) && m.specular == 0.0 && m.reflection() == 0.0 && m.diffuse > 0.0,
    },
    // Plastic, lacquer, porcelain: a white highlight over the color.
    CoefficientPreset {
        kind: ReflectionKind::Glossy,
        key: "kind-glossy",
        ambient: 0.1,
        diffuse: 0.8,
        specular: 0.5,
        shininess: 60.0,
        reflection: 0.1,
        transmission: 0.0,
        fits: |m| is_opaque(m) && m.specular > 0.0 && m.reflection() < m.diffuse,
    },
    // About the reflectance of polished silver; what is left of its own color only keeps it from looking like a hole.
    CoefficientPreset {
        kind: ReflectionKind::Mirror,
        key: "kind-mirror",
        ambient: 0.02,
        diffuse: 0.02,
        specular: 0.6,
        shininess: 200.0,
        reflection: 0.9,
        transmission: 0.0,
        fits: |m| is_opaque(m) && m.reflection() >= 0.5 && m.diffuse <= 0.2,
    },
    // The glass ball of Whitted's picture: a little mirrored, most let through.
    CoefficientPreset {
        kind: ReflectionKind::Glass,
        key: "kind-glass",
        ambient: 0.0,
        diffuse: 0.0,
        specular: 0.7,
        shininess: 200.0,
        reflection: 0.1,
        transmission: 0.9,
        fits: |m| m.transmission >= 0.5 && m.diffuse <= 0.2,
    },
];

fn is_opaque(phong: &Phong) -> bool {
    phong.transmission == 0.0
}

/// The kind of a material; `None` when it is one of its own.
pub(super) fn kind_of(phong: &Phong) -> Option<&'static CoefficientPreset> {
    PRESETS.iter().find(|preset| (preset.fits)(phong))
}

impl CoefficientPreset {
    /// Makes a material of this kind. Colors, tint, checker and index of refraction stay.
    pub(crate) fn give(&self, phong: &mut Phong) {
        phong.ambient = self.ambient;
        phong.diffuse = self.diffuse;
        phong.specular = self.specular;
        phong.shininess = self.shininess;
        phong.reflection = Some(self.reflection);
        phong.transmission = self.transmission;
    }
}

/// A transparent medium and its index of refraction for yellow light (the sodium D line, 589 nm), at room
/// temperature if nothing else is said.
pub(super) struct Medium {
    /// The message that names it.
    pub(super) key: &'static str,
    pub(super) ior: f64,
}

/// Media by index.
pub(super) static MEDIA: [Medium; 8] = [
    // 1.00028; the model calls it 1. (Hecht, Optics, 5th ed., table 4.1.)
    Medium { key: "medium-air", ior: 1.0 },
    // At 0 °C, the ordinary ray. (Hecht, table 4.1.)
    Medium { key: "medium-ice", ior: 1.31 },
    // At 20 °C. (Hecht, table 4.1.)
    Medium { key: "medium-water", ior: 1.333 },
    // Polymethyl methacrylate. (refractiveindex.info, G. Beadie et al. 2015: 1.491.)
    Medium { key: "medium-acrylic", ior: 1.49 },
    // (Hecht, table 4.1; Schott N-BK7: 1.5168.)
    Medium { key: "medium-crown", ior: 1.52 },
    // Light flint. (Hecht, table 4.1; Schott F2: 1.6200.)
    Medium { key: "medium-flint", ior: 1.62 },
    // The ordinary ray. (I. H. Malitson and M. J. Dodge 1972: 1.768.)
    Medium { key: "medium-sapphire", ior: 1.77 },
    // (F. Peter 1923: 2.417.)
    Medium { key: "medium-diamond", ior: 2.42 },
];

#[cfg(test)]
mod tests {
    use super::*;
    use catoptric_scene::Color;

    #[test]
    fn a_preset_makes_what_it_is_called_and_keeps_the_color() {
        for preset in &PRESETS {
            let color = Color::new(0.8, 0.1, 0.05);
            let mut phong = Phong { pattern: color.into(), ior: 1.7, ..Phong::default() };
            preset.give(&mut phong);
            assert_eq!(kind_of(&phong).map(|found| found.kind), Some(preset.kind));
            assert_eq!((phong.pattern.color, phong.ior), (color, 1.7));
            let fitting = PRESETS.iter().filter(|other| (other.fits)(&phong)).count();
            assert_eq!(fitting, 1, "{}", preset.key);
            let whole = phong.diffuse + phong.reflection() + phong.transmission;
            assert!(whole <= 1.0, "{}", preset.key);
        }
    }

    #[test]
    fn no_material_is_of_two_kinds() {
        let levels = [0.0, 0.1, 0.2, 0.5, 0.9, 1.0];
        for diffuse in levels {
            for specular in levels {
                for reflection in [None, Some(0.0), Some(0.15), Some(0.5), Some(1.0)] {
                    for transmission in levels {
                        let phong = Phong { diffuse, specular, reflection, transmission, ..Phong::default() };
                        let fitting = PRESETS.iter().filter(|preset| (preset.fits)(&phong)).count();
                        assert!(fitting <= 1, "{phong:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn half_transparent_paint_is_of_no_kind() {
        let phong = Phong { transmission: 0.3, ..Phong::default() };
        assert!(kind_of(&phong).is_none());
    }
}
