//! Plane mirrors.

use std::f64::consts::PI;

use catoptric_scene::{Body, Shape};
use glam::{DVec3, Vec3Swizzles as _};

use super::geometry::{mirrored, ring_of_images};
use super::probe::Probe;
use super::{ExactAnswer, ExactDeviation, ExactSetup, PlacedBody, RingImage};

/// The most images of a ring that are listed.
const MOST_IMAGES: usize = 64;

pub(super) fn answer(setting: &ExactSetup<'_>, found: &mut Vec<ExactAnswer>) {
    for &object in &setting.objects {
        let flat: Vec<(PlacedBody<'_>, MirrorFace)> = setting
            .mirrors
            .iter()
            .filter(|mirror| mirror.index != object.index)
            .filter_map(|&mirror| Some((mirror, MirrorFace::before(mirror.body, object.center)?)))
            .collect();
        for (mirror, face) in &flat {
            found.extend(plane_image(setting, mirror, face, &object));
        }
        for (number, first) in flat.iter().enumerate() {
            for second in flat.iter().skip(number + 1) {
                found.extend(ring(setting, [first, second], &object));
            }
        }
    }
}

/// A flat face of a mirror.
struct MirrorFace {
    /// The middle of the face; of a plane, some point on it.
    point: DVec3,
    normal: DVec3,
    is_endless: bool,
}

impl MirrorFace {
    /// The largest flat side that a point lies before.
    fn before(body: &Body, point: DVec3) -> Option<Self> {
        let frame = body.placement.world_from_body();
        let side = |on_side: DVec3, normal: DVec3| {
            let normal = (frame.matrix3.inverse().transpose() * normal).try_normalize()?;
            let on_side = frame.transform_point3(on_side);
            let is_endless = body.shape == Shape::Plane;
            ((point - on_side).dot(normal) > 0.0).then_some(Self { point: on_side, normal, is_endless })
        };
        match body.shape {
            Shape::Plane => side(DVec3::ZERO, DVec3::Y),
            Shape::Cube { size } => {
                let size = size * body.placement.scale.abs();
                let area =
                    |axis: DVec3| (axis.yzx() * size).element_sum() * (axis.zxy() * size).element_sum();
                let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
                let sides = axes.filter_map(|axis| {
                    let half = 0.5 * (size / body.placement.scale) * axis;
                    Some((area(axis.abs()), side(half, axis)?))
                });
                let largest = sides.reduce(|largest, next| if next.0 > largest.0 { next } else { largest });
                largest.map(|(_, side)| side)
            }
            _ => None,
        }
    }

    /// Whether something of it lies before `other`, so that it is seen there.
    fn is_before(&self, other: &Self) -> bool {
        self.is_endless || (self.point - other.point).dot(other.normal) > 0.0
    }
}

/// Two rays from the body to the mirror: extended backwards, what is reflected meets where the image is.
fn plane_image(
    setting: &ExactSetup<'_>,
    mirror: &PlacedBody<'_>,
    face: &MirrorFace,
    object: &PlacedBody<'_>,
) -> Option<ExactAnswer> {
    let image = mirrored(object.center, face.point, face.normal);
    let probe = Probe::of(setting.scene, [mirror.body], None, object.center)?;
    let to_middle = match mirror.body.shape {
        // Straight down, and a little beside.
        Shape::Plane => image - object.center,
        _ => face.point - object.center,
    };
    let beside = to_middle.any_orthogonal_vector().normalize_or_zero() * (0.05 * to_middle.length());
    let lines =
        [to_middle, to_middle + beside].map(|way| probe.reflected_by(object.center, way, face.normal));
    let [first, second] = lines;
    let met = first.zip(second).and_then(|(first, second)| first.nearest_to(&second));
    Some(ExactAnswer::PlaneImage {
        mirror: mirror.index,
        body: object.index,
        object: object.center,
        image: ExactDeviation { exact: image, found: met },
    })
}

fn ring(
    setting: &ExactSetup<'_>,
    mirrors: [&(PlacedBody<'_>, MirrorFace); 2],
    object: &PlacedBody<'_>,
) -> Option<ExactAnswer> {
    let [(first, a), (second, b)] = mirrors;
    let angle = PI - a.normal.dot(b.normal).clamp(-1.0, 1.0).acos();
    // Mirrors side by side, face to face, or turned away from each other make no ring.
    if !(1e-3..0.99 * PI).contains(&angle) || !a.is_before(b) || !b.is_before(a) {
        return None;
    }
    let probe = Probe::of(setting.scene, [first.body, second.body], None, object.center)?;
    let planes = [a, b].map(|face| (face.point, face.normal));
    let images = ring_of_images(object.center, planes, MOST_IMAGES);
    let images = images.into_iter().map(|(position, reflections)| {
        let miss = setting.sight(position).and_then(|(start, direction)| {
            let miss = probe.reflected(start, direction, reflections)?.distance(object.center);
            // A ray that is mirrored elsewhere goes elsewhere.
            (miss < 1e-3 * start.distance(position)).then_some(miss)
        });
        RingImage { position, reflections, miss }
    });
    Some(ExactAnswer::Ring {
        mirrors: [first.index, second.index],
        body: object.index,
        object: object.center,
        angle,
        images: images.collect(),
    })
}
