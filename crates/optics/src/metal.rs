//! Metals with measured indices.

mod tables;

use crate::dispersion::between;
use crate::{fresnel, observer};

/// A metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    /// The metal's name in scene files.
    pub name: &'static str,
    /// Measured points in rising order: wavelength in nanometers, n, k.
    pub points: &'static [[f64; 3]],
    /// Where they come from.
    pub source: &'static str,
}

impl Metal {
    /// The metal of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        METALS.iter().find(|metal| metal.name == name)
    }

    /// n and k at a wavelength in nanometers: on straight lines between the points.
    pub fn index(&self, nanometers: f64) -> [f64; 2] {
        between(self.points, nanometers).unwrap_or([1.0, 0.0])
    }

    /// Reflectance of unpolarized daylight as linear sRGB, under the angle of incidence of this cosine, out of a medium
    /// of index `outside`.
    pub fn reflectance(&self, cos: f64, outside: f64) -> [f64; 3] {
        observer::seen(|nanometers| {
            let [n, k] = self.index(nanometers);
            fresnel::conductor(cos, n / outside, k / outside).mean()
        })
    }
}

const NOBLE: &str =
    "P. B. Johnson, R. W. Christy, Optical constants of the noble metals, Phys. Rev. B 6, 4370 (1972)";
const TRANSITION: &str =
    "P. B. Johnson, R. W. Christy, Optical constants of transition metals, Phys. Rev. B 9, 5056 (1974)";

/// Metals by name.
pub const METALS: &[Metal] = &[
    Metal {
        name: "aluminum",
        points: tables::ALUMINUM,
        source: "A. D. Rakić, Algorithm for the determination of intrinsic optical constants of metal films, Appl. Opt. 34, \
                 4755 (1995)",
    },
    Metal {
        name: "brass",
        points: tables::BRASS,
        source: "M. R. Querry, Optical constants, Contractor Report CRDC-CR-85034 (1985), 70 % Cu, 30 % Zn",
    },
    Metal { name: "chromium", points: tables::CHROMIUM, source: TRANSITION },
    Metal { name: "copper", points: tables::COPPER, source: NOBLE },
    Metal { name: "gold", points: tables::GOLD, source: NOBLE },
    Metal { name: "iron", points: tables::IRON, source: TRANSITION },
    Metal { name: "nickel", points: tables::NICKEL, source: TRANSITION },
    Metal { name: "silver", points: tables::SILVER, source: NOBLE },
    Metal { name: "titanium", points: tables::TITANIUM, source: TRANSITION },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_cover_the_visible_range_in_rising_order() {
        for metal in METALS {
            let wavelengths: Vec<f64> = metal.points.iter().map(|point| point[0]).collect();
            assert!(wavelengths.is_sorted() && wavelengths[0] <= 380.0, "{}", metal.name);
            assert!(*wavelengths.last().unwrap() >= 780.0, "{}", metal.name);
            assert!(metal.points.iter().all(|[_, n, k]| *n > 0.0 && *k > 0.0), "{}", metal.name);
            assert_eq!(Metal::named(metal.name), Some(metal));
        }
        assert!(METALS.is_sorted_by_key(|metal| metal.name));
        assert_eq!(Metal::named("unobtainium"), None);
    }

    #[test]
    fn metals_have_the_reflectances_that_others_computed() {
        // Linear sRGB at normal incidence by the same data with the library colour-science 0.4 (Python).
        for (name, known) in [
            ("aluminum", [0.9072, 0.9159, 0.9223]),
            ("brass", [0.9096, 0.7783, 0.4228]),
            ("chromium", [0.5496, 0.5560, 0.5542]),
            ("copper", [0.9316, 0.6227, 0.5223]),
            ("gold", [1.0375, 0.7284, 0.3646]),
            ("iron", [0.5296, 0.5132, 0.4942]),
            ("nickel", [0.6970, 0.6405, 0.5632]),
            ("silver", [0.9892, 0.9840, 0.9778]),
            ("titanium", [0.6185, 0.5794, 0.5425]),
        ] {
            let found = Metal::named(name).unwrap().reflectance(1.0, 1.0);
            for (found, known) in found.iter().zip(known) {
                assert!((found - known).abs() < 1e-3, "{name}: {found:?}");
            }
        }
    }

    #[test]
    fn metals_reflect_everything_at_grazing_incidence_and_less_under_water() {
        for metal in METALS {
            assert!(
                metal.reflectance(0.0, 1.0).iter().all(|share| (share - 1.0).abs() < 1e-9),
                "{}",
                metal.name
            );
            let (air, water) = (metal.reflectance(1.0, 1.0), metal.reflectance(1.0, 1.33));
            assert!(water.iter().zip(air).all(|(water, air)| *water < air), "{}", metal.name);
        }
    }
}
