//! The laws: mirror images, the mirror equation, Alhazen's problem, and the ball lens.

use glam::{DVec2, DVec3};

/// The mirror image of a point in the plane through `on_plane` with the unit normal `normal`.
pub fn mirrored(point: DVec3, on_plane: DVec3, normal: DVec3) -> DVec3 {
    point - 2.0 * (point - on_plane).dot(normal) * normal
}

/// The images of a point before two plane mirrors, each a point on it and its unit normal, with the number of
/// reflections that make them: an image before the other mirror is mirrored again, one behind both is the last of its
/// row. Where the last ones of both rows coincide, they are one.
///
/// At the angle 2π/n there are n − 1; for an odd n that is so in the middle between the mirrors only, and elsewhere
/// there are n. Parallel mirrors have images without end; no more than `most` are listed.
pub fn ring_of_images(object: DVec3, mirrors: [(DVec3, DVec3); 2], most: usize) -> Vec<(DVec3, u32)> {
    // An image that lies in the other mirror's plane, as in the middle between mirrors at an odd part of the circle, is
    // its own image there: rounding must not put it before the mirror.
    let rounding = |point: DVec3| 1e-9 * (1.0 + point.distance(object));
    let before =
        |point: DVec3, (on_plane, normal): (DVec3, DVec3)| (point - on_plane).dot(normal) > rounding(point);
    let mut images: Vec<(DVec3, u32)> = Vec::new();
    for first in 0..2 {
        let (mut point, mut reflections) = (object, 0);
        let [a, b] = mirrors;
        let mut next = if first == 0 { a } else { b };
        while before(point, next) && images.len() < most {
            point = mirrored(point, next.0, next.1);
            reflections += 1;
            let same =
                |other: &(DVec3, u32)| other.1 == reflections && other.0.distance(point) < rounding(point);
            if images.iter().any(same) {
                break;
            }
            images.push((point, reflections));
            next = if next == a { b } else { a };
        }
    }
    images
}

/// How far from the center of a sphere of radius R, towards the object, the image of an object at the distance D from
/// the center stands, for rays near the line through both: R·D/(2D − R).
///
/// That is the mirror equation 1/u + 1/v = −2/R for an object outside (u = D − R, the image |v| behind the surface),
/// and 1/u + 1/v = 2/R for one inside, mirrored by the wall beside it (u = R − D). At D = R/2 the image is infinitely
/// far.
pub fn sphere_image(radius: f64, distance: f64) -> f64 {
    radius * distance / (2.0 * distance - radius)
}

/// The point of a sphere where a ray from `object` is mirrored to `eye`, both outside: Alhazen's problem. `None` if the
/// sphere hides it.
///
/// The point lies in the plane of the two and the center, between them, where the way is the shortest (Fermat's
/// principle). The slope of the way changes its sign once there, and is halved until nothing is left of the interval.
pub fn alhazen(center: DVec3, radius: f64, object: DVec3, eye: DVec3) -> Option<DVec3> {
    alhazen_from(center, radius, object, Viewpoint::Near(eye))
}

/// [`alhazen`] for an eye that may be infinitely far away.
pub(super) fn alhazen_from(center: DVec3, radius: f64, object: DVec3, eye: Viewpoint) -> Option<DVec3> {
    let arc = Arc::new(center, radius, object, eye)?;
    let slope = |angle: f64| {
        let (point, along) = arc.at(angle);
        along.dot((point - object).normalize_or_zero() - eye.direction_from(point))
    };
    let (point, _) = arc.at(crossing(arc.visible()?, slope)?);
    let out = point - center;
    let is_seen = (object - point).dot(out) > 0.0 && eye.direction_from(point).dot(out) > 0.0;
    is_seen.then_some(point)
}

/// Where light goes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Viewpoint {
    /// A point.
    Near(DVec3),
    /// Infinitely far away, in this unit direction.
    Far(DVec3),
}

impl Viewpoint {
    /// The unit direction from a point to it.
    pub(super) fn direction_from(self, point: DVec3) -> DVec3 {
        match self {
            Self::Near(eye) => (eye - point).normalize_or_zero(),
            Self::Far(direction) => direction,
        }
    }

    fn distance(self, point: DVec3) -> f64 {
        match self {
            Self::Near(eye) => eye.distance(point),
            Self::Far(_) => f64::INFINITY,
        }
    }
}

/// The part of a sphere between two points outside.
pub(super) struct Arc {
    center: DVec3,
    radius: f64,
    /// Unit vectors: towards the object, and at right angles towards the eye.
    axes: [DVec3; 2],
    /// Between the directions to the object and to the eye, radians.
    angle: f64,
    /// How far from either direction the sphere is seen from there, radians.
    horizons: [f64; 2],
}

impl Arc {
    pub(super) fn new(center: DVec3, radius: f64, object: DVec3, eye: Viewpoint) -> Option<Self> {
        let object = Viewpoint::Near(object);
        let lengths = [object, eye].map(|end| end.distance(center));
        let is_outside = lengths.iter().all(|length| *length > radius);
        if radius.is_nan() || radius <= 0.0 || !is_outside {
            return None;
        }
        let [first, to_eye] = [object, eye].map(|end| end.direction_from(center));
        let across = to_eye - to_eye.dot(first) * first;
        let second = across.try_normalize().unwrap_or_else(|| first.any_orthonormal_vector());
        let angle = across.length().atan2(to_eye.dot(first));
        Some(Self {
            center,
            radius,
            axes: [first, second],
            angle,
            horizons: lengths.map(|length| (radius / length).acos()),
        })
    }

    /// The angles that both see; `None` if there are none.
    pub(super) fn visible(&self) -> Option<[f64; 2]> {
        let [object, eye] = self.horizons;
        let (least, most) = ((self.angle - eye).max(0.0), self.angle.min(object));
        (least <= most).then_some([least, most])
    }

    /// The point at an angle from the direction to the object, and the direction in which it grows.
    pub(super) fn at(&self, angle: f64) -> (DVec3, DVec3) {
        let [first, second] = self.axes;
        let (sin, cos) = angle.sin_cos();
        (self.center + self.radius * (cos * first + sin * second), cos * second - sin * first)
    }
}

/// Where a function that grows from below 0 to above is 0, to the last digit.
pub(super) fn crossing([mut least, mut most]: [f64; 2], value: impl Fn(f64) -> f64) -> Option<f64> {
    for _ in 0..200 {
        let middle = 0.5 * (least + most);
        let value = value(middle);
        if value.is_nan() {
            return None;
        }
        if value < 0.0 { least = middle } else { most = middle }
    }
    Some(0.5 * (least + most))
}

/// The focal length of a ball of the radius R and the index n in air, from its center: n·R/(2(n − 1)).
///
/// It is the lensmaker's equation for two surfaces ±R a distance 2R apart (Hecht 2017, Optics, sec. 6.1).
pub fn ball_focal_length(radius: f64, ior: f64) -> f64 {
    ior * radius / (2.0 * (ior - 1.0))
}

/// How far behind the center of a ball a ray crosses the axis that came parallel to it at the height h:
/// h/sin 2(θ − θ′) with sin θ = h/R and sin θ′ = h/(n·R). Both surfaces bend it alike, and on its way out it passes the
/// center as far as on its way in.
pub fn ball_crossing(radius: f64, ior: f64, height: f64) -> f64 {
    let (outside, inside) = ((height / radius).asin(), (height / (ior * radius)).asin());
    height / (2.0 * (outside - inside)).sin()
}

/// How far behind its last vertex a ray crosses the axis of a lens in air that came parallel to it at the height h; below
/// 0 for light that is spread. The radii of curvature of both faces are in the order of the light: 0 is flat, above 0 are
/// those whose center lies behind the face. `None` where the ray misses a face or is reflected wholly.
///
/// Snell's law at both faces, in the plane of the ray and the axis.
pub fn lens_crossing(faces: [f64; 2], thickness: f64, ior: f64, height: f64) -> Option<f64> {
    let mut ray = MeridionalRay { at: DVec2::new(-thickness.max(height), height), towards: DVec2::X };
    ray.refract(0.0, faces[0], ior.recip())?;
    ray.refract(thickness, faces[1], ior)?;
    let MeridionalRay { at, towards } = ray;
    Some(at.x - at.y * towards.x / towards.y - thickness)
}

/// A ray in a plane with the axis of a lens, which is X there.
struct MeridionalRay {
    at: DVec2,
    /// A unit vector.
    towards: DVec2,
}

impl MeridionalRay {
    /// Follows the ray through a face with this vertex on the axis; `ratio` is the index before it over that behind.
    fn refract(&mut self, vertex: f64, radius: f64, ratio: f64) -> Option<()> {
        let Self { at, towards } = *self;
        let (way, normal) = if radius == 0.0 {
            ((vertex - at.x) / towards.x, DVec2::NEG_X)
        } else {
            let center = DVec2::new(vertex + radius, 0.0);
            let from_center = at - center;
            let half = from_center.dot(towards);
            let discriminant = half * half - from_center.length_squared() + radius * radius;
            let way = -half - discriminant.sqrt().copysign(radius);
            (way, (from_center + way * towards) / radius)
        };
        let cosine = -normal.dot(towards);
        let beyond = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
        // Not a number where the ray misses the face.
        (beyond >= 0.0).then(|| {
            self.at = at + way * towards;
            self.towards = (ratio * towards + (ratio * cosine - beyond.sqrt()) * normal).normalize();
        })
    }
}
