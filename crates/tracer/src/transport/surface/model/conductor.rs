//! How much a metal reflects, by angle.

use std::sync::{Arc, OnceLock};

use catoptric_optics::{METALS, fresnel};
use catoptric_scene::MetalOptics;

use crate::simd::vector::Vector;
use crate::simd::{Float32 as _, MOST_LANES, Width};

/// The reflectance of a conductor in air by the cosine of the angle of incidence, for each channel.
///
/// Fresnel's formulas are summed over the visible spectrum in double precision at even steps of the cosine; a cubic
/// through the four nearest of these points lies within 10⁻⁵ of them everywhere.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ConductorTable {
    points: Box<[[f32; 3]; POINTS]>,
}

pub(crate) const STEPS: usize = 512;
/// One more at each end, for the cubics there.
const POINTS: usize = STEPS + 3;

/// The curves of the measured metals, each made when it is first asked for: a sum over the spectrum takes its time.
static MEASURED: [OnceLock<Arc<ConductorTable>>; METALS.len()] = [const { OnceLock::new() }; METALS.len()];

impl ConductorTable {
    pub(crate) fn of(conductor: &MetalOptics) -> Arc<Self> {
        let place = match conductor {
            MetalOptics::Metal(metal) => METALS.iter().position(|other| other.name == metal.name),
            MetalOptics::Index { .. } => None,
        };
        let make = || Arc::new(Self::new(conductor));
        match place.and_then(|place| MEASURED.get(place)) {
            Some(kept) => Arc::clone(kept.get_or_init(make)),
            None => make(),
        }
    }

    fn new(conductor: &MetalOptics) -> Self {
        let exact = |cos: f64| reflectance(conductor, cos);
        let mut points = Box::new([[0.0; 3]; POINTS]);
        for (index, point) in points.iter_mut().enumerate() {
            let cos = (index as f64 - 1.0) / STEPS as f64;
            *point = match cos {
                // Beyond the ends the curve goes on as a cubic does.
                ..0.0 => beyond([1.0, 2.0, 3.0, 4.0].map(|step| exact(cos + step / STEPS as f64))),
                1.0.. if cos > 1.0 => {
                    beyond([1.0, 2.0, 3.0, 4.0].map(|step| exact(cos - step / STEPS as f64)))
                }
                _ => exact(cos),
            }
            .map(|part| part as f32);
        }
        Self { points }
    }

    /// The points, the second at the cosine 0.
    pub(crate) fn points(&self) -> &[[f32; 3]] {
        self.points.as_slice()
    }

    /// The reflectances at a cosine from 0 to 1. The red of gold is a little above 1.
    pub(crate) fn at(&self, cos: f32) -> [f32; 3] {
        let place = cos.clamp(0.0, 1.0) * STEPS as f32;
        let before = (place as usize).min(STEPS - 1);
        let x = place - before as f32;
        // Lagrange's cubic through -1, 0, 1 and 2.
        let (up, down, far) = (x + 1.0, x - 1.0, x - 2.0);
        let weights = [
            x * down * far * (-1.0 / 6.0),
            up * down * far * 0.5,
            up * x * far * -0.5,
            up * x * down * (1.0 / 6.0),
        ];
        let Some([a, b, c, d]) = self.points.get(before..before + 4) else { return [1.0; 3] };
        std::array::from_fn(|channel| {
            let sum = a[channel] * weights[0]
                + b[channel] * weights[1]
                + c[channel] * weights[2]
                + d[channel] * weights[3];
            sum.max(0.0)
        })
    }
}

/// The value before four even steps of a cubic.
fn beyond([a, b, c, d]: [[f64; 3]; 4]) -> [f64; 3] {
    std::array::from_fn(|channel| 4.0 * a[channel] - 6.0 * b[channel] + 4.0 * c[channel] - d[channel])
}

/// What a conductor in air reflects of unpolarized daylight as linear sRGB. The red of gold is above 1, a little outside
/// of what sRGB shows.
fn reflectance(conductor: &MetalOptics, cos: f64) -> [f64; 3] {
    match *conductor {
        MetalOptics::Metal(metal) => metal.reflectance(cos, 1.0),
        MetalOptics::Index { n, k } => {
            let channel = |n: f64, k: f64| fresnel::conductor(cos, n, k).mean();
            [channel(n.x, k.x), channel(n.y, k.y), channel(n.z, k.z)]
        }
    }
}

/// The reflectances of a metal under angles of these cosines.
pub(crate) fn reflectances<W: Width>(w: W, curve: &ConductorTable, cos: W::R) -> Vector<W::R> {
    let mut cosines = [0.0; MOST_LANES];
    cos.store(&mut cosines);
    let [mut red, mut green, mut blue] = [[0.0; MOST_LANES]; 3];
    for (lane, cos) in cosines.into_iter().enumerate().take(W::LANES) {
        [red[lane], green[lane], blue[lane]] = curve.at(cos);
    }
    Vector::new(w.load(&red), w.load(&green), w.load(&blue))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn the_curve_is_that_of_double_precision() {
        let measured = METALS.iter().map(MetalOptics::Metal);
        let made = [(0.05, 4.0), (1.5, 0.0), (2.9, 3.1), (1.4, 7.6), (0.2, 0.1)];
        let made = made.map(|(n, k)| MetalOptics::Index { n: DVec3::splat(n), k: DVec3::splat(k) });
        for conductor in measured.chain(made) {
            // Of the first one that is asked for, too.
            let curve = ConductorTable::of(&conductor);
            for step in 0..=3000_u16 {
                let cos = f32::from(step) / 3000.0;
                let (found, exact) = (curve.at(cos), reflectance(&conductor, f64::from(cos)));
                for (found, exact) in found.into_iter().zip(exact) {
                    assert!(
                        (f64::from(found) - exact).abs() < 1e-5,
                        "{conductor:?} at {cos}: {found}, not {exact}"
                    );
                }
            }
        }
    }
}
