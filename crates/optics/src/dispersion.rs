//! Refractive index by wavelength.

/// The refractive index of a clear medium as a function of the wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dispersion {
    /// One index for all wavelengths.
    Constant(f64),
    /// n = A + B/λ² (A.-L. Cauchy 1836), B in square micrometers.
    Cauchy {
        /// The index of infinitely long waves.
        a: f64,
        /// Square micrometers.
        b: f64,
    },
    /// n² = 1 + Σ B λ²/(λ² - C) (W. Sellmeier 1872), with pairs of B and C in square micrometers.
    Sellmeier(&'static [[f64; 2]]),
    /// n = A + B λ² + C/λ² (M. Rubin 1985, for soda-lime glass), micrometers.
    Rubin([f64; 3]),
    /// Measured points, nanometers and index, in rising order, with straight lines between them.
    Measured(&'static [[f64; 2]]),
}

/// Fraunhofer's lines F, d and C, by which glasses are described, nanometers.
pub struct FraunhoferLines;

impl FraunhoferLines {
    /// Hydrogen, blue.
    pub const F: f64 = 486.132_7;
    /// Helium, yellow.
    pub const D: f64 = 587.561_8;
    /// Hydrogen, red.
    pub const C: f64 = 656.281;
}

impl Dispersion {
    /// The formula of Cauchy with this index at the line d and this Abbe number, V = (n_d - 1)/(n_F - n_C).
    ///
    /// An infinite Abbe number gives a constant index.
    pub fn from_abbe(index: f64, abbe: f64) -> Self {
        let inverse = |nanometers: f64| (1e3 / nanometers).powi(2);
        let b = (index - 1.0) / abbe / (inverse(FraunhoferLines::F) - inverse(FraunhoferLines::C));
        Self::Cauchy { a: index - b * inverse(FraunhoferLines::D), b }
    }

    /// The index at a wavelength in nanometers, at the nearest known one where measured points end.
    pub fn index(self, nanometers: f64) -> f64 {
        let square = (nanometers * 1e-3).powi(2);
        match self {
            Self::Constant(index) => index,
            Self::Cauchy { a, b } => a + b / square,
            Self::Sellmeier(terms) => {
                (1.0 + terms.iter().map(|[b, c]| b * square / (square - c)).sum::<f64>()).sqrt()
            }
            Self::Rubin([a, b, c]) => a + b * square + c / square,
            Self::Measured(points) => between(points, nanometers).map_or(1.0, |[index]| index),
        }
    }

    /// The Abbe number; infinite for a constant index.
    pub fn abbe(self) -> f64 {
        let spread = self.index(FraunhoferLines::F) - self.index(FraunhoferLines::C);
        if spread == 0.0 { f64::INFINITY } else { (self.index(FraunhoferLines::D) - 1.0) / spread }
    }
}

/// What lies between measured points, each a wavelength and values; `None` without points.
pub(crate) fn between<const POINT: usize, const VALUES: usize>(
    points: &[[f64; POINT]],
    nanometers: f64,
) -> Option<[f64; VALUES]> {
    let wavelength = |point: &[f64; POINT]| point.first().copied().unwrap_or_default();
    let values = |point: &[f64; POINT]| -> [f64; VALUES] {
        std::array::from_fn(|index| point.get(index + 1).copied().unwrap_or_default())
    };
    let after = points.partition_point(|point| wavelength(point) <= nanometers);
    let (low, high) = match (points.get(after.wrapping_sub(1)), points.get(after)) {
        (Some(low), Some(high)) => (low, high),
        (Some(only), None) | (None, Some(only)) => (only, only),
        (None, None) => return None,
    };
    let width = wavelength(high) - wavelength(low);
    let share = if width > 0.0 { (nanometers - wavelength(low)) / width } else { 0.0 };
    let (low, high) = (values(low), values(high));
    Some(std::array::from_fn(|index| match (low.get(index), high.get(index)) {
        (Some(low), Some(high)) => low + share * (high - low),
        _ => 0.0,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_abbe_number_gives_itself_back() {
        for (index, abbe) in [(1.5168, 64.17), (1.7847, 25.7), (2.417, 55.3)] {
            let dispersion = Dispersion::from_abbe(index, abbe);
            assert!((dispersion.index(FraunhoferLines::D) - index).abs() < 1e-12);
            assert!((dispersion.abbe() - abbe).abs() < 1e-9);
        }
        let constant = Dispersion::from_abbe(1.5, f64::INFINITY);
        assert_eq!((constant.index(400.0), constant.abbe()), (1.5, f64::INFINITY));
    }

    #[test]
    fn measured_points_are_joined_and_end_flat() {
        let points = Dispersion::Measured(&[[400.0, 1.6], [500.0, 1.5]]);
        for (nanometers, index) in [(300.0, 1.6), (400.0, 1.6), (450.0, 1.55), (500.0, 1.5), (900.0, 1.5)] {
            assert!((points.index(nanometers) - index).abs() < 1e-12);
        }
        assert_eq!(Dispersion::Measured(&[]).index(500.0), 1.0);
    }
}
