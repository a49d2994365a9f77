//! A thin sheet of a clear substance with air on both sides: a window pane, a glass bulb.

use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32, Width};
use crate::transport::surface::bsdf::Bsdf;
use crate::transport::surface::fresnel_polarized;

/// It reflects as [`fresnel::sheet`](catoptric_optics::fresnel::sheet) says, and the rest goes straight on: the shift of a
/// thin sheet is not seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ThinDielectricMaterial {
    /// Index of air divided by that of the sheet.
    pub ratio: f32,
    /// What is left of light of each channel that goes through.
    pub tint: [f32; 3],
}

impl ThinDielectricMaterial {
    pub(crate) fn new(ior: f64, tint: [f32; 3]) -> Self {
        Self { ratio: (1.0 / ior) as f32, tint }
    }

    /// Takes up the lobes of surfaces that rays `lanes` met under angles of these cosines.
    #[inline(always)]
    pub(crate) fn add_lobes<W: Width>(&self, w: W, bsdf: &mut Bsdf<W>, cos: W::R, lanes: W::M) {
        let share = reflectance(cos, w.real(self.ratio));
        bsdf.reflection = W::R::select(lanes, share, bsdf.reflection);
        let rest = w.real(1.0) - share;
        let filter = Vector::splat(rest, self.tint) * rest;
        bsdf.filter = Vector::select(lanes, filter, bsdf.filter);
    }
}

/// The share of unpolarized light that a sheet reflects under an angle of this cosine, 0 to 1; `ratio` is the index of air
/// divided by that of the sheet.
#[inline(always)]
pub(crate) fn reflectance<R: Float32>(cos: R, ratio: R) -> R {
    let one = cos.like(1.0);
    let (polarized, is_total) = fresnel_polarized(cos, ratio);
    let [across, along] = polarized.map(|once| once / (one + once));
    R::select(is_total, one, (across + along).min(one))
}

#[cfg(test)]
mod tests {
    use catoptric_optics::fresnel;

    use super::*;

    /// Sums of the light that leaves a sheet after each way to and fro, in double precision.
    fn summed(cos: f64, ior: f64) -> f64 {
        let once = fresnel::dielectric(cos, ior);
        let of = |reflected: f64| {
            let mut inside = 1.0 - reflected;
            let mut back = reflected;
            for _ in 0..100_000 {
                inside *= reflected;
                back += inside * (1.0 - reflected);
                inside *= reflected;
            }
            back
        };
        (of(once.across) + of(once.along)) / 2.0
    }

    #[test]
    fn sheets_reflect_the_sum_of_all_ways_to_and_fro() {
        for ior in [1.0, 1.01, 1.333, 1.5, 2.417, 10.0, 0.7] {
            for cos in [1.0_f32, 0.9, 0.5, 0.3, 0.05] {
                let (found, exact) = (reflectance(cos, 1.0 / ior as f32), summed(f64::from(cos), ior));
                assert!((f64::from(found) - exact).abs() < 1e-5, "{cos} into {ior}: {found}, not {exact}");
            }
        }
        // Glass of 1.5: 0.04 at each face, 1/13 of a sheet.
        assert!((reflectance(1.0_f32, 1.0 / 1.5) - 1.0 / 13.0).abs() < 1e-6);
        assert_eq!(reflectance(0.0_f32, 1.0 / 1.5), 1.0);
    }
}
