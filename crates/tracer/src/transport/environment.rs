//! The light of what surrounds the bodies, infinitely far away.

use std::f32::consts::{PI, TAU};

use catoptric_scene::{Environment, Surroundings};

use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float32 as _, MOST_LANES, Mask as _, Width};
use crate::transport::color::linear_rgb;
use crate::transport::texture::lookup::{AddressMode, ImageLookup};

/// What rays that hit nothing bring.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum EnvironmentLight {
    /// The same from everywhere.
    Even([f32; 3]),
    /// Light that changes with the height.
    Gradient { zenith: [f32; 3], horizon: [f32; 3], nadir: [f32; 3] },
    /// Longitudes across, latitudes down.
    Picture {
        image: ImageLookup,
        /// The part of a full turn by which the picture is turned about the y axis, from z to x.
        turn: f32,
        strength: f32,
    },
}

impl EnvironmentLight {
    pub(crate) fn new(environment: &Environment) -> Self {
        let strength = environment.strength as f32;
        let even = Self::Even(linear_rgb(environment.background));
        match &environment.surroundings {
            Surroundings::Even => even,
            Surroundings::Sky(sky) => {
                let light = |color| linear_rgb(color).map(|part| part * strength);
                let [zenith, horizon, nadir] = [sky.zenith, sky.horizon, sky.nadir].map(light);
                Self::Gradient { zenith, horizon, nadir }
            }
            Surroundings::Picture(image) => ImageLookup::new(image).map_or(even, |image| {
                let turn = (environment.rotation_degrees / 360.0).rem_euclid(1.0) as f32;
                Self::Picture { image, turn, strength }
            }),
        }
    }

    /// Whether it is more than an even light.
    pub(crate) fn is_full(&self) -> bool {
        !matches!(self, Self::Even(_))
    }

    /// The light that comes from everywhere, where it is the same; else none.
    #[inline(always)]
    pub(crate) fn even(&self) -> [f32; 3] {
        match self {
            Self::Even(color) => *color,
            _ => [0.0; 3],
        }
    }

    /// The light that comes to rays `lanes` from where they go to; `direction` is of length 1.
    #[inline(always)]
    pub(crate) fn light<W: Width>(&self, w: W, direction: Vector<W::R>, lanes: W::M) -> Vector<W::R> {
        match self {
            Self::Even(color) => Vector::splat(w.real(0.0), *color),
            _ => self.from(w, direction, lanes),
        }
    }

    /// The light that comes from a direction of length 1.
    pub(crate) fn along(&self, direction: Vector<f32>) -> Vector<f32> {
        self.light(ScalarWidth, direction, true)
    }

    #[cold]
    #[inline(never)]
    fn from<W: Width>(&self, w: W, direction: Vector<W::R>, lanes: W::M) -> Vector<W::R> {
        let [mut x, mut y, mut z] = [[0.0; MOST_LANES]; 3];
        direction.x.store(&mut x);
        direction.y.store(&mut y);
        direction.z.store(&mut z);
        let [mut red, mut green, mut blue] = [[0.0; MOST_LANES]; 3];
        let asked = lanes.bits();
        for lane in (0..W::LANES).filter(|lane| asked >> lane & 1 == 1) {
            [red[lane], green[lane], blue[lane]] = self.at([x[lane], y[lane], z[lane]]);
        }
        Vector::new(w.load(&red), w.load(&green), w.load(&blue))
    }

    fn at(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Even(color) => *color,
            Self::Gradient { zenith, horizon, nadir } => {
                let end = if y < 0.0 { nadir } else { zenith };
                std::array::from_fn(|part| horizon[part] + (end[part] - horizon[part]) * y.abs().min(1.0))
            }
            Self::Picture { image, turn, strength } => {
                let longitude = x.atan2(-z) / TAU;
                let latitude = y.atan2((x * x + z * z).sqrt()) / PI;
                // Turned from z to x, the picture's middle, at -z, goes towards -x.
                image
                    .at(0.5 + longitude + turn, 0.5 - latitude, [AddressMode::Repeats, AddressMode::Ends])
                    .map(|part| part * strength)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Color, Sky};

    use super::*;

    fn along(sky: &EnvironmentLight, direction: [f32; 3]) -> f32 {
        let direction = glam::Vec3::from(direction).normalize();
        sky.along(direction.into()).x
    }

    #[test]
    fn a_sky_is_a_gradient_of_the_height() {
        let of = |gray| Color::gray(gray);
        let sky = Sky { zenith: of(1.0), horizon: of(3.0), nadir: of(7.0) };
        let environment =
            Environment { surroundings: Surroundings::Sky(sky), strength: 2.0, ..Environment::default() };
        let sky = EnvironmentLight::new(&environment);
        let found = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 3.0, 4.0], [4.0, -3.0, 0.0]];
        let found = found.map(|direction| along(&sky, direction));
        for (found, exact) in found.into_iter().zip([2.0, 6.0, 14.0, 3.6, 10.8]) {
            assert!((found - exact).abs() < 1e-5, "{found}, not {exact}");
        }
    }

    #[test]
    fn the_middle_of_a_picture_is_ahead_and_turns_as_bodies_do() {
        // From left to right: behind, left, ahead, right. The pole has the mean of two rows.
        let image =
            ImageLookup::of_grays(&[[10.0; 4], [0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 2.0, 3.0], [20.0; 4]]);
        let picture = |turn| EnvironmentLight::Picture { image: image.clone(), turn, strength: 1.0 };
        // A quarter of a pixel's width from centers: halves of pixels.
        let eighth = std::f32::consts::FRAC_PI_4;
        let at = |sky: &EnvironmentLight, degrees: f32| {
            let (sin, cos) = (degrees.to_radians() + eighth).sin_cos();
            along(sky, [sin, 0.0, -cos])
        };
        let straight = picture(0.0);
        for (degrees, exact) in [(0.0, 2.0), (90.0, 3.0), (180.0, 0.0), (270.0, 1.0)] {
            assert!((at(&straight, degrees) - exact).abs() < 1e-4, "{degrees}: {}", at(&straight, degrees));
        }
        // 90 degrees about y take -z to -x: what was ahead is seen on the left.
        let turned = picture(0.25);
        assert!((at(&turned, 270.0) - 2.0).abs() < 1e-4 && (at(&turned, 0.0) - 3.0).abs() < 1e-4);
        assert_eq!((along(&straight, [0.0, 1.0, 0.0]), along(&straight, [0.0, -1.0, 0.0])), (10.0, 20.0));
    }

    #[test]
    fn a_picture_that_is_not_there_leaves_the_background() {
        let surroundings = Surroundings::Picture(catoptric_scene::Image::new("nowhere.png"));
        let environment =
            Environment { background: Color::gray(0.25), surroundings, ..Environment::default() };
        assert_eq!(EnvironmentLight::new(&environment), EnvironmentLight::Even([0.25; 3]));
    }
}
