//! A clear coat on a matte ground.

use catoptric_optics::fresnel;

use crate::simd::vector::Vector;
use crate::simd::{Float as _, Width};
use crate::transport::surface::bsdf::{Bsdf, SurfaceColors};
use crate::transport::surface::fresnel as reflectance;

/// A clear coat on a matte ground.
///
/// Light that goes in, is scattered evenly and goes out again, or is reflected back to the ground any number of times:
/// `(1 - R(θ_v))·(1 - R(θ_l))·C / (η²·(1 - C·(1 - lets_out)))` (M. Pharr, G. Humphreys 2004; W. Jakob 2010, Mitsuba,
/// `plastic`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CoatedMaterial {
    /// Index of air divided by that of the coat.
    pub ratio: f32,
    /// 1/η².
    pub spread: f32,
    /// What the coat lets out of light scattered evenly below it; kept instead of what it reflects, which is so near to 1
    /// at extreme indices that single precision would not tell them apart.
    pub lets_out: f32,
    /// What the coat lets in of light that comes evenly from all sides.
    pub lets_in: f32,
}

impl CoatedMaterial {
    pub(crate) fn new(ior: f64) -> Self {
        let spread = 1.0 / (ior * ior);
        // A pencil of light and its reverse lose alike: of even light, η² times as much passes into the medium of the
        // relative index η as comes back out of it. So only the way into the denser medium is integrated, where nothing
        // is totally reflected.
        let (lets_in, lets_out) = if ior >= 1.0 {
            let into = passed_of_even_light(ior);
            (into, into * spread)
        } else {
            let into = passed_of_even_light(1.0 / ior);
            (into * ior * ior, into)
        };
        Self {
            ratio: (1.0 / ior) as f32,
            spread: spread as f32,
            lets_out: lets_out as f32,
            lets_in: lets_in as f32,
        }
    }
}

/// The share of even light that passes into a medium of the relative index `eta`, at least 1: ∫ (1 - R(θ)) dcos²θ.
///
/// By the midpoint rule in x with cos θ = x²: near the surface, where R changes within angles of about 1/`eta`, the
/// steps are small.
fn passed_of_even_light(eta: f64) -> f64 {
    const STEPS: u32 = 4096;
    let passed = |step| {
        let x = (f64::from(step) + 0.5) / f64::from(STEPS);
        4.0 * x.powi(3) * (1.0 - fresnel::dielectric(x * x, eta).mean()) / f64::from(STEPS)
    };
    (0..STEPS).map(passed).sum()
}

impl CoatedMaterial {
    /// Takes up the lobes of surfaces that rays `lanes` met under angles of these cosines; of even light, this coat and its
    /// ground send on `ambient`.
    #[inline(always)]
    pub(crate) fn add_lobes<W: Width>(
        &self,
        w: W,
        bsdf: &mut Bsdf<W>,
        SurfaceColors { color, ground }: SurfaceColors<W::R>,
        ambient: [f32; 3],
        cos: W::R,
        lanes: W::M,
    ) {
        let one = w.real(1.0);
        let share = reflectance(cos, w.real(self.ratio));
        bsdf.reflection = W::R::select(lanes, share, bsdf.reflection);
        bsdf.coated = bsdf.coated | lanes;
        bsdf.coat_ratio = W::R::select(lanes, w.real(self.ratio), bsdf.coat_ratio);
        let [color, ground] = [color, ground].map(|color| color.map(|part| part.min(one)));
        // Between ground and coat light goes to and fro, and leaves a little of itself each time.
        let again = ground.map(|part| one / (one - part + part * self.lets_out));
        let below = color.times(again) * ((one - share) * self.spread);
        bsdf.diffuse = Vector::select(lanes, below, bsdf.diffuse);
        let even = ambient.map(|light| light * self.lets_in);
        bsdf.ambient = Vector::select(lanes, below.times_all(even), bsdf.ambient);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ (1 - R(θ)) dcos²θ into any medium, from where total reflection ends, in very many steps.
    fn passed_in_many_steps(eta: f64) -> f64 {
        const STEPS: u32 = 400_000;
        let least = (1.0 - eta * eta).max(0.0);
        let passed = |step| {
            // cos² = least + (1 - least)·u⁴: small steps where the curve is steep.
            let u = (f64::from(step) + 0.5) / f64::from(STEPS);
            let cos = (least + (1.0 - least) * u.powi(4)).sqrt();
            (1.0 - least) * 4.0 * u.powi(3) * (1.0 - fresnel::dielectric(cos, eta).mean())
        };
        (0..STEPS).map(passed).sum::<f64>() / f64::from(STEPS)
    }

    #[test]
    fn coats_let_through_what_the_integral_says_at_every_index() {
        for ior in
            [0.01, 0.012, 0.015, 0.03, 0.1, 0.5, 0.9, 0.999, 1.0, 1.001, 1.1, 1.5, 2.4, 10.0, 33.0, 100.0]
        {
            let coat = CoatedMaterial::new(ior);
            for (found, exact) in
                [(coat.lets_in, passed_in_many_steps(ior)), (coat.lets_out, passed_in_many_steps(1.0 / ior))]
            {
                let off = f64::from(found) / exact - 1.0;
                assert!(off.abs() < 1e-3, "{ior}: {found}, not {exact}");
            }
        }
    }
}
