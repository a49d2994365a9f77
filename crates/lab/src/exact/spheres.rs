//! Spherical mirrors, and highlights on balls.

use catoptric_scene::Light;
use catoptric_tracer::TracedRay;
use glam::{DVec3, Vec3};

use super::geometry::{Arc, alhazen_from, crossing, sphere_image};
use super::probe::Probe;
use super::{AnswerCollector, ExactAnswer, ExactDeviation, ExactSetup, Inapplicable, PlacedBody, radius};

/// An image farther away than so many radii cannot be distinguished from none: rays of single precision towards it are
/// parallel.
const FARTHEST_IMAGE: f64 = 100.0;

pub(super) fn answer(setting: &ExactSetup<'_>, found: &mut AnswerCollector) {
    for mirror in &setting.mirrors {
        let Some(radius) = radius(mirror.body) else { continue };
        for object in setting.objects.iter().filter(|object| object.index != mirror.index) {
            match image_distance(mirror, radius, object) {
                Some(at) if at.abs() <= FARTHEST_IMAGE * radius => {
                    found.answers.extend(image(setting, mirror, radius, object, at));
                }
                Some(_) => found
                    .inapplicable
                    .push(Inapplicable::ObjectInFocus { mirror: mirror.index, body: object.index }),
                None => {}
            }
            found.answers.extend(reflection_point(setting, mirror, radius, object));
        }
    }
    for glossy in &setting.glossy {
        let lights = setting.scene.lights.iter().enumerate().filter(|(_, light)| !light.hidden);
        for light in lights.take(super::MOST) {
            found.answers.extend(highlight(setting, glossy, light));
        }
    }
}

/// How far from the mirror's center the image stands, towards the object; infinite in the focus, `None` for an object in
/// the center.
fn image_distance(mirror: &PlacedBody<'_>, radius: f64, object: &PlacedBody<'_>) -> Option<f64> {
    let distance = object.center.distance(mirror.center);
    (distance > 0.0).then(|| sphere_image(radius, distance))
}

/// Two rays from the body that meet the mirror near the line through both centers.
fn image(
    setting: &ExactSetup<'_>,
    mirror: &PlacedBody<'_>,
    radius: f64,
    object: &PlacedBody<'_>,
    at: f64,
) -> Option<ExactAnswer> {
    /// Half of what they see of the mirror, radians: the square of it is the aberration.
    const APERTURE: f64 = 0.004;
    let offset = object.center - mirror.center;
    let axis = offset.try_normalize()?;
    let probe = Probe::of(setting.scene, [mirror.body], None, mirror.center)?;
    let beside = axis.any_orthonormal_vector();
    let [first, second] = [APERTURE, -APERTURE].map(|angle: f64| {
        let on_mirror = mirror.center + radius * (angle.cos() * axis + angle.sin() * beside);
        probe.reflected(object.center, on_mirror - object.center, 1)
    });
    let found = first.zip(second).and_then(|(first, second)| {
        let ends = first.nearest_to(&second).zip(second.nearest_to(&first));
        ends.map(|(a, b)| a.midpoint(b))
    });
    Some(ExactAnswer::SphereImage {
        mirror: mirror.index,
        body: object.index,
        object: object.center,
        image: ExactDeviation { exact: mirror.center + at * axis, found },
    })
}

fn reflection_point(
    setting: &ExactSetup<'_>,
    mirror: &PlacedBody<'_>,
    radius: f64,
    object: &PlacedBody<'_>,
) -> Option<ExactAnswer> {
    let (center, eye) = (mirror.center, setting.viewpoint());
    let exact = alhazen_from(center, radius, object.center, eye)?;
    setting.sight(exact)?;
    let probe = Probe::of(setting.scene, [mirror.body], None, mirror.center)?;
    let arc = Arc::new(center, radius, object.center, eye)?;
    // The tracer's rays from the eye go by the body on one side or the other.
    let side = |angle: f64| {
        let (point, along) = arc.at(angle);
        let ray = setting.sight(point).and_then(|(start, way)| probe.reflected(start, way, 1));
        let Some(ray) = ray else { return f64::NAN };
        let to_object = (object.center - ray.point).normalize_or_zero();
        -(to_object - ray.direction).dot(along)
    };
    let found = arc.visible().and_then(|[least, most]| {
        let inner = 1e-6 * (most - least);
        crossing([least + inner, most - inner], side).map(|angle| arc.at(angle).0)
    });
    Some(ExactAnswer::ReflectionPoint {
        mirror: mirror.index,
        body: object.index,
        object: object.center,
        point: ExactDeviation { exact, found },
    })
}

fn highlight(
    setting: &ExactSetup<'_>,
    glossy: &PlacedBody<'_>,
    (place, light): (usize, &Light),
) -> Option<ExactAnswer> {
    let point = alhazen_from(glossy.center, radius(glossy.body)?, light.position, setting.viewpoint())?;
    let (start, way) = setting.sight(point)?;
    let probe = Probe::of(setting.scene, [glossy.body], Some(light), glossy.center)?;
    let tree = probe.tree(start, way, 1);
    let off = tree.first().and_then(angle_off);
    Some(ExactAnswer::Highlight { body: glossy.index, light: place, point, off })
}

/// The angle between the mirrored light and the way back, where a ray ends.
fn angle_off(ray: &TracedRay) -> Option<f64> {
    let (hit, answer) = (ray.hit?, ray.answer.as_ref()?);
    let term = answer.lights.first()?;
    let [normal, to_light, direction] =
        [hit.normal, term.direction, Vec3::from(ray.ray.direction)].map(Vec3::as_dvec3);
    let to_viewer: DVec3 = -direction;
    let mirrored = 2.0 * normal.dot(to_light) * normal - to_light;
    Some(mirrored.cross(to_viewer).length().atan2(mirrored.dot(to_viewer)))
}
