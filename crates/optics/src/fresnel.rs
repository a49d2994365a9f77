//! Fresnel's formulas: the reflectance of a smooth boundary.
//!
//! M. Born, E. Wolf, Principles of Optics, 7th ed., 1999, sections 1.5.2 (dielectrics) and 14.2 (metals).

/// Shares of the power that a boundary reflects, by polarization.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectance {
    /// Of light that swings across the plane of incidence (s).
    pub across: f64,
    /// Of light that swings in the plane of incidence (p).
    pub along: f64,
}

impl Reflectance {
    /// Everything is reflected.
    pub const TOTAL: Self = Self { across: 1.0, along: 1.0 };

    /// Of unpolarized light.
    pub fn mean(self) -> f64 {
        0.5 * (self.across + self.along)
    }
}

/// Reflectance of the boundary between two clear media.
///
/// `cos` is the cosine of the angle of incidence, brought within 0 to 1; `eta` is the refractive index behind the
/// boundary divided by that before it, positive. Total reflection gives [`Reflectance::TOTAL`], and equal indices
/// exactly 0.
pub fn dielectric(cos: f64, eta: f64) -> Reflectance {
    let cos = cos.clamp(0.0, 1.0);
    let Some(cos_behind) = refracted(cos, eta) else { return Reflectance::TOTAL };
    if eta == 1.0 {
        return Reflectance { across: 0.0, along: 0.0 };
    }
    if cos == 0.0 {
        return Reflectance::TOTAL;
    }
    let square = |amplitude: f64| amplitude * amplitude;
    Reflectance {
        across: square((cos - eta * cos_behind) / (cos + eta * cos_behind)),
        along: square((eta * cos - cos_behind) / (eta * cos + cos_behind)),
    }
}

/// Reflectance of a thin sheet of a clear medium whose index is `eta` times that on both sides: light goes to and fro
/// between the faces, and `2R/(1 + R)` of each polarization comes back in all (G. G. Stokes 1862, On the intensity of the
/// light reflected from or transmitted through a pile of plates). What passes, the rest, leaves under the angle of
/// incidence. As for [`dielectric`].
pub fn sheet(cos: f64, eta: f64) -> Reflectance {
    let Reflectance { across, along } = dielectric(cos, eta);
    let all = |once: f64| 2.0 * once / (1.0 + once);
    Reflectance { across: all(across), along: all(along) }
}

/// An estimate of [`dielectric`] that graphics uses: R₀ + (1 − R₀)(1 − cos)⁵ with R₀ = ((1 − η)/(1 + η))² and the cosine
/// on the side of the smaller index; 1 at total reflection (C. Schlick 1994, An Inexpensive BRDF Model for
/// Physically-based Rendering, eq. 15). Not 0 at equal indices. As for [`dielectric`].
pub fn schlick(cos: f64, eta: f64) -> f64 {
    let cos = if eta < 1.0 { refracted(cos, eta) } else { Some(cos.clamp(0.0, 1.0)) };
    let straight = ((1.0 - eta) / (1.0 + eta)).powi(2);
    cos.map_or(1.0, |cos| straight + (1.0 - straight) * (1.0 - cos).powi(5))
}

/// Cosine of the angle of refraction by Snell's law; `None` is total reflection. As for [`dielectric`].
pub fn refracted(cos: f64, eta: f64) -> Option<f64> {
    let cos = cos.clamp(0.0, 1.0);
    // 1 - sin²/η², without a difference of large numbers.
    let square = (eta * eta - 1.0 + cos * cos) / (eta * eta);
    (square >= 0.0).then(|| square.sqrt().min(1.0))
}

/// Reflectance of the boundary to a conductor of index n + ik, both relative to the index before the boundary.
///
/// `cos` is the cosine of the angle of incidence, brought within 0 to 1. For k = 0 this is [`dielectric`].
pub fn conductor(cos: f64, n: f64, k: f64) -> Reflectance {
    let cos = cos.clamp(0.0, 1.0);
    let (cos2, sin2) = (cos * cos, 1.0 - cos * cos);
    if cos2 == 0.0 {
        return Reflectance::TOTAL;
    }
    // (a + ib)² = (n + ik)² - sin².
    let real = n * n - k * k - sin2;
    let imaginary = 2.0 * n * k;
    let size = real.hypot(imaginary);
    // Of the two forms of a², the one without a difference.
    let a2 = if real >= 0.0 { 0.5 * (size + real) } else { 0.5 * imaginary * imaginary / (size - real) };
    let a = a2.sqrt();
    let across = (size + cos2 - 2.0 * a * cos) / (size + cos2 + 2.0 * a * cos);
    let (outer, inner) = (size * cos2 + sin2 * sin2, 2.0 * a * cos * sin2);
    let along = across * (outer - inner) / (outer + inner);
    Reflectance { across: across.clamp(0.0, 1.0), along: along.clamp(0.0, 1.0) }
}

/// Angle of incidence, radians, at which light that swings in the plane of incidence is not reflected at all (D.
/// Brewster 1815); `eta` as for [`dielectric`].
pub fn brewster_angle(eta: f64) -> f64 {
    eta.atan()
}

/// Angle of incidence, radians, from which on everything is reflected; `None` unless `eta` is below 1.
pub fn critical_angle(eta: f64) -> Option<f64> {
    (eta < 1.0).then(|| eta.asin())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const GLASS: f64 = 1.5;

    fn at(degrees: f64) -> f64 {
        degrees.to_radians().cos()
    }

    #[test]
    fn glass_has_its_known_angles() {
        assert!((dielectric(1.0, GLASS).mean() - 0.04).abs() < 1e-12);
        let brewster = brewster_angle(GLASS);
        assert!((brewster.to_degrees() - 56.309_932_474).abs() < 1e-9);
        let there = dielectric(brewster.cos(), GLASS);
        assert!(there.along < 1e-30 && (there.across - 25.0 / 169.0).abs() < 1e-12);
        assert!((critical_angle(1.0 / GLASS).unwrap().to_degrees() - 41.810_314_896).abs() < 1e-9);
        assert_eq!(critical_angle(GLASS), None);
        let water = 1.333;
        assert!((brewster_angle(water).to_degrees() - 53.123_225_760).abs() < 1e-8);
        assert!((critical_angle(1.0 / water).unwrap().to_degrees() - 48.606_626_392).abs() < 1e-8);
    }

    #[test]
    fn glass_reflects_inside_as_much_as_the_tables_say() {
        for (degrees, known) in [(30.0, 0.055_190_2), (40.0, 0.245_291_2), (41.0, 0.379_751_3)] {
            let found = dielectric(at(degrees), 1.0 / GLASS).mean();
            assert!((found - known).abs() < 5e-8, "{degrees}: {found}");
        }
        assert_eq!(dielectric(at(41.82), 1.0 / GLASS), Reflectance::TOTAL);
    }

    #[test]
    fn a_metal_reflects_straight_light_by_the_known_formula() {
        for (n, k) in [(0.05_f64, 4.2_f64), (2.9, 3.1), (1.0, 1e6), (1e-6, 3.0), (1.5, 0.0)] {
            let known = ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
            assert!((conductor(1.0, n, k).mean() - known).abs() < 1e-12, "{n} + {k}i");
        }
    }

    #[test]
    fn odd_numbers_stay_shares() {
        for cos in [-1.0, 0.0, 1e-300, 0.5, 1.0, 2.0] {
            for n in [1e-9, 0.3, 1.0, 1e9] {
                for k in [0.0, 1e-9, 1e9] {
                    let Reflectance { across, along } = conductor(cos, n, k);
                    assert!((0.0..=1.0).contains(&across) && (0.0..=1.0).contains(&along), "{cos} {n} {k}");
                }
                let Reflectance { across, along } = dielectric(cos, n);
                assert!((0.0..=1.0).contains(&across) && (0.0..=1.0).contains(&along), "{cos} {n}");
            }
        }
    }

    /// The examples of J. Buck 2019, The Ray Tracer Challenge, chapter 11; the last one has distances of four digits.
    #[test]
    fn schlick_is_that_of_the_book() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        assert_eq!(schlick(half, 1.0 / 1.5), 1.0);
        assert!((schlick(1.0, 1.5) - 0.04).abs() < 1e-12);
        let cos = (1.0 - 0.99 * 0.99_f64).sqrt();
        assert!((schlick(cos, 1.5) - 0.48873).abs() < 1e-4);
    }

    proptest! {
        #[test]
        fn a_ray_and_its_reverse_are_reflected_alike(cos in 0.001..1.0, eta in 0.3..3.0_f64) {
            let Some(behind) = refracted(cos, eta) else { return Ok(()) };
            prop_assume!(behind > 1e-3);
            let (there, back) = (dielectric(cos, eta), dielectric(behind, 1.0 / eta));
            prop_assert!((there.across - back.across).abs() < 1e-9 && (there.along - back.along).abs() < 1e-9);
        }

        #[test]
        fn what_is_not_reflected_goes_on(cos in 0.001..1.0, eta in 0.3..3.0_f64) {
            // The transmitted power by the transmitted amplitudes (Born, Wolf, eq. 1.5.20).
            let Some(behind) = refracted(cos, eta) else { return Ok(()) };
            let across = 2.0 * cos / (cos + eta * behind);
            let along = 2.0 * cos / (eta * cos + behind);
            let wider = eta * behind / cos;
            let Reflectance { across: reflected_across, along: reflected_along } = dielectric(cos, eta);
            prop_assert!((reflected_across + wider * across * across - 1.0).abs() < 1e-12);
            prop_assert!((reflected_along + wider * along * along - 1.0).abs() < 1e-12);
        }

        #[test]
        fn a_conductor_that_does_not_conduct_is_a_dielectric(cos in 0.0..1.0, n in 1.0..4.0_f64) {
            let (metal, clear) = (conductor(cos, n, 0.0), dielectric(cos, n));
            prop_assert!((metal.across - clear.across).abs() < 1e-12);
            prop_assert!((metal.along - clear.along).abs() < 1e-9);
        }

        #[test]
        fn schlick_is_near_what_it_estimates(cos in 0.0..1.0, eta in 1.3..1.7_f64) {
            prop_assert!((schlick(cos, eta) - dielectric(cos, eta).mean()).abs() < 0.08);
        }

        #[test]
        fn equal_indices_reflect_nothing(cos in 0.0..1.0) {
            prop_assert_eq!(dielectric(cos, 1.0).mean(), 0.0);
            prop_assert_eq!(refracted(cos, 1.0), Some(cos));
        }
    }
}
