//! Small angles, of which a cosine in single precision keeps no digit: lights that are small or far away, narrow views,
//! narrow highlights.

use std::f64::consts::{FRAC_1_PI, PI};

use catoptric_picture::Picture;
use catoptric_scene::{Camera, Falloff, Light, Phong, Projection, Scene};
use catoptric_tracer::{RenderControl, RenderSettings, render};
use glam::DVec3;

use crate::proof::common::oracle::Oracle;
use crate::proof::common::*;

/// A ground below the edge of a thin plate, which takes half of the light of a lamp above.
struct Penumbra {
    /// Height of the plate, meters.
    height: f64,
    /// Direction to the lamp, of length 1, and its distance from the ground below the edge, meters.
    direction: DVec3,
    distance: f64,
    /// Radius of the lamp, divided by its distance.
    ratio: f64,
}

impl Penumbra {
    const SIZE: (u32, u32) = (96, 4);

    /// The width of the picture, which has all of the penumbra in it, meters.
    fn width(&self) -> f64 {
        let level = self.direction.y;
        let (edge, lamp) = (self.height / level, self.distance);
        4.0 * self.ratio * edge * lamp / (lamp - edge)
    }

    /// Where the edge lies, from the middle of its penumbra.
    fn edge(&self) -> f64 {
        self.height * self.direction.x / self.direction.y
    }

    fn scene(&self) -> Scene {
        let size = self.height;
        let middle = v(self.edge() - 0.5 * size, size, 0.0);
        let plate = block(v(size, 1e-7 * size, 40.0 * size), middle, chalk());
        let (position, radius) = (self.distance * self.direction, self.ratio * self.distance);
        let (width, height) = Self::SIZE;
        let mut scene = scene(vec![plane(DVec3::ZERO, 0.0, chalk()), plate]);
        scene.lights = vec![Light { position, radius, ..Light::default() }];
        scene.camera = Camera {
            position: v(0.0, 0.4 * size, 0.0),
            target: DVec3::ZERO,
            up: DVec3::NEG_Z,
            projection: Projection::Parallel { height: self.width() * f64::from(height) / f64::from(width) },
        };
        scene
    }

    /// The part of the lamp that is seen from a place of the ground so far from the middle of the penumbra.
    fn seen_from(&self, x: f64) -> f64 {
        let to_lamp = self.distance * self.direction - v(x, 0.0, 0.0);
        // The plane through the place and the edge cuts a part from the disc that the lamp is seen as.
        let beside =
            v(self.height, x - self.edge(), 0.0).normalize().dot(to_lamp) / (self.ratio * self.distance);
        let t = beside.clamp(-1.0, 1.0);
        0.5 + FRAC_1_PI * (t.asin() + t * (1.0 - t * t).sqrt())
    }

    /// The sum of part times rest over the penumbra, which is proportional to its width: as drawn, and as it is.
    fn widths(&self) -> [f64; 2] {
        let (width, height) = Self::SIZE;
        let settings = RenderSettings { width, height, samples: 64 };
        let picture = render(&render_scene(&self.scene()), settings, &RenderControl::default()).unwrap();
        (0..width)
            .map(|x| {
                let light: f64 = picture.picture.rows().map(|row| f64::from(row[x as usize][0])).sum();
                let place = ((f64::from(x) + 0.5) / f64::from(width) - 0.5) * self.width();
                let lit = (self.distance * self.direction - v(place, 0.0, 0.0)).normalize().y;
                [light / f64::from(height) / lit, self.seen_from(place)]
            })
            .fold([0.0; 2], |sum, parts| [0, 1].map(|which| sum[which] + parts[which] * (1.0 - parts[which])))
    }
}

#[test]
fn penumbras_are_as_wide_as_the_lamp_is_seen() {
    for ratio in [1e-2, 1e-3, 2e-4, 1.6e-4, 1e-5, 1e-6] {
        for (distance, height) in [(1.0, 0.5), (1e-3, 5e-4), (1e6, 1.0), (1e3, 500.0)] {
            for direction in [DVec3::Y, v(0.0, 0.8, 0.6), v(0.48, 0.8, 0.36)] {
                let [found, exact] = Penumbra { height, direction, distance, ratio }.widths();
                let off = found / exact - 1.0;
                assert!(off.abs() < 0.01, "{ratio:e} at {distance} m along {direction}: {off:.4} too wide");
            }
        }
    }
}

/// The limb of a ball through views of less than a tenth of a degree, in a tile that has its axis beside the ball.
#[test]
fn narrow_views_have_all_of_a_body_in_them() {
    let shown = glow(catoptric_scene::Color::WHITE);
    for eye in [1.3, 2.0, 5.0] {
        // Where a line from the eye touches the ball, and what is up there.
        let (sin, cos) = (1.0 / eye, (1.0_f64 - 1.0 / (eye * eye)).sqrt());
        let (touched, up) = (v(0.0, cos, sin), v(0.0, cos, sin));
        let eye = v(0.0, 0.0, eye);
        for fov_degrees in [0.2, 0.1, 0.06, 0.05, 0.04, 0.03, 0.026, 0.024, 0.02, 0.01, 0.001] {
            let height = touched.distance(eye) * fov_degrees * PI / 180.0;
            let mut scene = scene(vec![ball(1.0, DVec3::ZERO, shown.clone())]);
            scene.camera = camera(eye, touched + 0.3 * height * up, fov_degrees);
            let exact = Oracle::new(&scene, 1.0).picture(60, 60);
            assert_same_picture(&picture(&scene, 60, 60), &exact, 0.005);
        }
    }
}

/// The largest difference of two pictures in any channel.
fn most_apart(one: &Picture, other: &Picture) -> f32 {
    let pixels = one.pixels().iter().flatten().zip(other.pixels().iter().flatten());
    pixels.map(|(one, other)| (one - other).abs()).fold(0.0, f32::max)
}

#[test]
fn narrow_highlights_are_those_of_double_precision() {
    for shininess in [1e3, 4e3, 5e3, 3e4, 1e6] {
        let glossy = Phong { diffuse: 0.0, ambient: 0.0, specular: 1.0, shininess, ..Phong::default() };
        let mut scene = scene(vec![ball(1.0, DVec3::ZERO, glossy)]);
        scene.lights = vec![light(v(3.0, 4.0, 5.0), 1.0, Falloff::None)];
        // Where the normal halves the angle between both.
        let eye = v(1.0, -2.0, 8.0);
        let mut middle = DVec3::Z;
        for _ in 0..60 {
            let toward = |end: DVec3| (end - middle).normalize();
            middle = (toward(scene.lights[0].position) + toward(eye)).normalize();
        }
        let seen = 4.0 / shininess.sqrt() / eye.distance(middle);
        scene.camera = camera(eye, middle, seen.to_degrees());
        let exact = Oracle::new(&scene, 1.0).picture(40, 40);
        assert!(exact.pixels().iter().any(|pixel| pixel[0] > 0.9), "{shininess}: the highlight is in view");
        let off = most_apart(&picture(&scene, 40, 40), &exact);
        assert!(off < 2e-3, "{shininess:e}: off by {off}");
    }
}
