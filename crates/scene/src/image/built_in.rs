//! The pictures that come with the program. They are computed, not stored.

use std::f64::consts::{PI, TAU};
use std::sync::{Arc, Mutex, PoisonError, Weak};

use catoptric_picture::Picture;
use glam::DVec3;

use super::sane;

/// A picture that is computed, not stored.
pub(super) struct BuiltInImage {
    name: &'static str,
    size: [u32; 2],
    /// The light at a place of the picture, from its upper left corner (0, 0) to its lower right one (1, 1).
    color: fn(f64, f64) -> DVec3,
}

pub(super) const ALL: [BuiltInImage; 4] = [
    BuiltInImage { name: "evening", size: [1536, 768], color: |u, v| evening(direction(u, v)) },
    BuiltInImage { name: "studio", size: [1024, 512], color: |u, v| studio(direction(u, v)) },
    BuiltInImage { name: "planet", size: [1024, 512], color: |u, v| planet(direction(u, v)) },
    BuiltInImage { name: "grid", size: [1024, 1024], color: grid },
];

pub(super) const NAMES: [&str; ALL.len()] = {
    let mut names = [""; ALL.len()];
    let mut at = 0;
    while at < names.len() {
        names[at] = ALL[at].name;
        at += 1;
    }
    names
};

static KEPT: [Mutex<Weak<Picture>>; ALL.len()] = [const { Mutex::new(Weak::new()) }; ALL.len()];

/// The picture of this name, made when it is asked for and kept while anyone has it.
pub(super) fn picture(name: &str) -> Option<Arc<Picture>> {
    let (built_in, kept) = ALL.iter().zip(&KEPT).find(|(built_in, _)| built_in.name == name)?;
    let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(picture) = kept.upgrade() {
        return Some(picture);
    }
    let [width, height] = built_in.size;
    let middle = |pixel: u32, of: u32| (f64::from(pixel) + 0.5) / f64::from(of);
    let color = |x, y| (built_in.color)(middle(x, width), middle(y, height)).as_vec3().to_array().map(sane);
    let picture = Arc::new(Picture::from_fn(width, height, color).ok()?);
    *kept = Arc::downgrade(&picture);
    Some(picture)
}

/// Where a place of a picture of everything around lies, as [`Surroundings::Picture`](crate::Surroundings::Picture)
/// says.
fn direction(u: f64, v: f64) -> DVec3 {
    let ((sin, cos), (height, around)) = ((TAU * (u - 0.5)).sin_cos(), (PI * (0.5 - v)).sin_cos());
    DVec3::new(around * sin, height, -around * cos)
}

/// 0 up to `from`, 1 from `to` on, and smooth between them.
fn step(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A low sun over hills, and clouds lit from below.
fn evening(at: DVec3) -> DVec3 {
    /// Hills are never higher.
    const HIGHEST: f64 = 0.18;
    let sun = DVec3::new(-0.55, 0.16, -0.82).normalize();
    let near_sun = at.dot(sun).max(0.0);
    let height = at.y.max(0.0);
    let warm = DVec3::new(1.35, 0.62, 0.26);
    let sky = DVec3::new(0.10, 0.20, 0.46).lerp(DVec3::new(0.62, 0.55, 0.62), (-height * 3.5).exp());
    let sky = sky.lerp(warm, 0.85 * (-height * 7.0).exp() * (0.25 + 0.75 * near_sun.powi(3)));
    let glow = warm * (0.5 * near_sun.powi(24) + 1.6 * near_sun.powi(300));
    let disc = DVec3::new(10.0, 7.0, 4.0) * step(0.9990, 0.9994, near_sun);
    // Clouds lie on a level far above: they draw together towards the horizon.
    let level = DVec3::new(at.x, 0.0, at.z) / (at.y.max(0.0) + 0.09);
    let clouds = if at.y > 0.0 { fractal(level * 0.75 + DVec3::new(3.1, 0.4, 7.7), 6) } else { 0.0 };
    let cloud = step(0.50, 0.78, clouds) * step(0.0, 0.10, at.y);
    let lit = DVec3::new(0.50, 0.42, 0.48).lerp(warm * 1.25, near_sun.powi(2) * (-height * 1.6).exp());
    let above = (sky + glow).lerp(lit, 0.85 * cloud) + disc * (1.0 - cloud);
    if at.y > HIGHEST {
        return above;
    }
    let ridge = |turn: f64, roughness: f64| {
        let flat = DVec3::new(at.x, 0.0, at.z).normalize_or(DVec3::X);
        fractal(flat * roughness + DVec3::splat(turn), 5) * 0.22
    };
    // Edges as wide as a pixel or two.
    let far = step(0.0, 0.008, ridge(11.0, 2.5) - 0.045 - at.y);
    let close = step(0.0, 0.008, ridge(29.0, 3.5) - 0.10 - at.y);
    let haze = DVec3::new(0.36, 0.26, 0.30).lerp(warm * 0.6, near_sun.powi(4) * 0.7);
    let meadow = DVec3::new(0.055, 0.05, 0.042) * (1.0 + fractal(at / (0.05 - at.y.min(0.0)), 3));
    above.lerp(haze, far).lerp(meadow, close)
}

/// A dark room with three large lamps, as photographers hang them around things that shine.
fn studio(at: DVec3) -> DVec3 {
    let room = DVec3::splat(0.10).lerp(DVec3::splat(0.32), step(-0.2, 1.0, at.y));
    let floor = DVec3::splat(0.055);
    let mut light = floor.lerp(room, step(-0.03, 0.03, at.y));
    let lamps = [
        (DVec3::new(-0.85, 0.55, 0.25), [0.34, 0.46], DVec3::new(6.0, 5.7, 5.2)),
        (DVec3::new(0.95, 0.35, -0.10), [0.16, 0.62], DVec3::new(3.2, 3.5, 4.0)),
        (DVec3::new(0.10, 0.95, -0.35), [0.52, 0.26], DVec3::new(4.4, 4.4, 4.4)),
        (DVec3::new(0.35, 0.30, 0.95), [0.10, 0.50], DVec3::new(2.4, 2.3, 2.2)),
    ];
    for (toward, size, color) in lamps {
        let ahead = toward.normalize();
        let across = ahead.cross(DVec3::Y).normalize();
        let along = at / at.dot(ahead).max(1e-3);
        let within = |axis: DVec3, half: f64| 1.0 - step(half, half + 0.02, along.dot(axis).abs());
        let inside = within(across, size[0]) * within(across.cross(ahead), size[1]);
        light = light.lerp(color, if at.dot(ahead) > 0.0 { inside } else { 0.0 });
    }
    light
}

/// A world of seas, lands, ice and clouds.
fn planet(at: DVec3) -> DVec3 {
    let land = fractal(at * 1.7 + DVec3::new(5.2, 1.3, 9.1), 7);
    let sea = DVec3::new(0.012, 0.045, 0.13).lerp(DVec3::new(0.03, 0.17, 0.26), step(0.40, 0.52, land));
    let dry = fractal(at * 3.1 + DVec3::splat(17.0), 5);
    let low = DVec3::new(0.07, 0.16, 0.035).lerp(DVec3::new(0.42, 0.29, 0.13), step(0.42, 0.62, dry));
    let ground = low.lerp(DVec3::new(0.30, 0.25, 0.21), step(0.60, 0.70, land));
    let surface = sea.lerp(ground, step(0.515, 0.525, land));
    let ice = step(0.0, 0.04, at.y.abs() - 0.86 + 0.16 * (land - 0.5));
    let cloud = 0.9 * step(0.53, 0.74, fractal(at * DVec3::new(2.3, 4.2, 2.3) + DVec3::splat(31.0), 7));
    surface.lerp(DVec3::splat(0.86), ice).lerp(DVec3::splat(0.9), cloud)
}

/// Squares with lines between them, whose hue tells the place across and whose brightness the place down.
fn grid(u: f64, v: f64) -> DVec3 {
    let line = |x: f64| {
        let off = (x * 16.0 + 0.5).rem_euclid(1.0) - 0.5;
        1.0 - step(0.02, 0.05, off.abs())
    };
    let is_odd = ((u * 16.0).floor() + (v * 16.0).floor()).rem_euclid(2.0) == 1.0;
    let hue = |shift: f64| 0.5 + 0.5 * (TAU * (u + shift)).cos();
    let color = DVec3::new(hue(0.0), hue(-1.0 / 3.0), hue(1.0 / 3.0)) * 0.7 + 0.15;
    let square = color * (0.9 - 0.6 * v) * if is_odd { 0.55 } else { 1.0 };
    square.lerp(DVec3::splat(0.85), line(u).max(line(v)))
}

/// Noise of several sizes, each half as large and half as strong as the one before; about 0.5, between 0 and 1.
fn fractal(mut at: DVec3, octaves: u32) -> f64 {
    let (mut sum, mut strength, mut whole) = (0.0, 1.0, 0.0);
    for _ in 0..octaves {
        sum += strength * noise(at);
        whole += strength;
        strength *= 0.5;
        // A little off the double, so that the lattices do not lie on each other.
        at = at * 2.03 + DVec3::new(13.7, 7.1, 3.9);
    }
    sum / whole
}

/// Random values at whole places, smoothly joined (K. Perlin 1985, An image synthesizer; the joint of 2002).
fn noise(at: DVec3) -> f64 {
    let cell = at.floor();
    let within = at - cell;
    let part = |x: f64| x * x * x * (x * (x * 6.0 - 15.0) + 10.0);
    let [x, y, z] = within.to_array().map(part);
    let corner = |dx: f64, dy: f64, dz: f64| lattice(cell + DVec3::new(dx, dy, dz));
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let edge = |dy, dz| mix(corner(0.0, dy, dz), corner(1.0, dy, dz), x);
    mix(mix(edge(0.0, 0.0), edge(1.0, 0.0), y), mix(edge(0.0, 1.0), edge(1.0, 1.0), y), z)
}

/// A number from 0 to 1 for a whole place, that looks random.
fn lattice(place: DVec3) -> f64 {
    let mixed = place.to_array().into_iter().fold(0x9e37_79b9_u32, |hash, x| {
        let mut hash = (hash ^ (x as i64 as u32)).wrapping_mul(0x85eb_ca6b);
        hash ^= hash >> 13;
        hash = hash.wrapping_mul(0xc2b2_ae35);
        hash ^ hash >> 16
    });
    f64::from(mixed) / f64::from(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_made_once_and_has_light_in_it() {
        for name in NAMES {
            let made = picture(name).unwrap();
            assert!(Arc::ptr_eq(&made, &picture(name).unwrap()), "{name}");
            let all = made.pixels().iter().flatten();
            assert!(all.clone().all(|part| part.is_finite() && *part >= 0.0), "{name}");
            let mean = all.sum::<f32>() / (3 * made.pixels().len()) as f32;
            assert!((0.05..1.5).contains(&mean), "{name}: {mean}");
        }
        assert!(picture("nothing").is_none());
    }

    #[test]
    fn places_lie_where_surroundings_say() {
        let near = |u, v, expected: DVec3| direction(u, v).distance(expected) < 1e-12;
        assert!(near(0.5, 0.5, DVec3::NEG_Z) && near(0.75, 0.5, DVec3::X) && near(0.0, 0.5, DVec3::Z));
        assert!(near(0.3, 0.0, DVec3::Y) && near(0.9, 1.0, DVec3::NEG_Y));
    }
}
