//! Spherical mirrors, balls of glass, and highlights.

use catoptric_scene::Light;
use catoptric_tracer::TracedRay;
use glam::{DVec3, Vec3};

use super::geometry::{Arc, alhazen, ball_crossing, ball_focal_length, crossing, sphere_image};
use super::probe::{Line, Probe};
use super::{Compared, ExactAnswer, MARGINAL, Place, Setting, radius};

pub(super) fn answer(setting: &Setting<'_>, found: &mut Vec<ExactAnswer>) {
    for mirror in &setting.mirrors {
        let Some(radius) = radius(mirror.body) else { continue };
        for object in setting.objects.iter().filter(|object| object.index != mirror.index) {
            found.extend(image(setting, mirror, radius, object));
            found.extend(reflection_point(setting, mirror, radius, object));
        }
    }
    for lens in &setting.lenses {
        found.extend(radius(lens.body).and_then(|radius| focus(setting, lens, radius)));
    }
    for glossy in &setting.glossy {
        let lights = setting.scene.lights.iter().enumerate().filter(|(_, light)| !light.hidden);
        for light in lights.take(super::MOST) {
            found.extend(highlight(setting, glossy, light));
        }
    }
}

/// Two rays from the body that meet the mirror near the line through both centers.
fn image(setting: &Setting<'_>, mirror: &Place<'_>, radius: f64, object: &Place<'_>) -> Option<ExactAnswer> {
    /// Half of what they see of the mirror, radians: the square of it is the aberration.
    const APERTURE: f64 = 0.004;
    let offset = object.center - mirror.center;
    let axis = offset.try_normalize()?;
    let at = sphere_image(radius, offset.length());
    if !at.is_finite() {
        return None;
    }
    let probe = Probe::of(setting.scene, [mirror.body], None)?;
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
        image: Compared { exact: mirror.center + at * axis, found },
    })
}

fn reflection_point(
    setting: &Setting<'_>,
    mirror: &Place<'_>,
    radius: f64,
    object: &Place<'_>,
) -> Option<ExactAnswer> {
    let (center, eye) = (mirror.center, setting.eye());
    let exact = alhazen(center, radius, object.center, eye)?;
    let probe = Probe::of(setting.scene, [mirror.body], None)?;
    let arc = Arc::new(center, radius, object.center, eye)?;
    // The tracer's rays from the eye go by the body on one side or the other.
    let side = |angle: f64| {
        let (point, along) = arc.at(angle);
        let Some(ray) = probe.reflected(eye, point - eye, 1) else { return f64::NAN };
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
        point: Compared { exact, found },
    })
}

fn focus(setting: &Setting<'_>, lens: &Place<'_>, radius: f64) -> Option<ExactAnswer> {
    /// Near enough to the axis for the aberration to vanish, far enough for single precision.
    const PARAXIAL: f64 = 0.01;
    let ior = setting.scene.material(&lens.body.material)?.ior();
    let axis = (lens.center - setting.eye()).try_normalize()?;
    let beside = axis.any_orthonormal_vector();
    let probe = Probe::of(setting.scene, [lens.body], None)?;
    let found = |height: f64| {
        let start = lens.center - 2.0 * radius * axis + height * radius * beside;
        let middle = Line { point: lens.center, direction: axis };
        middle.nearest_to(&probe.transmitted(start, axis)?)
    };
    let focal_length = ball_focal_length(radius, ior);
    let at = |distance: f64| lens.center + distance * axis;
    let marginal = at(ball_crossing(radius, ior, MARGINAL * radius));
    Some(ExactAnswer::Focus {
        body: lens.index,
        focal_length,
        paraxial: Compared { exact: at(focal_length), found: found(PARAXIAL) },
        marginal: Compared { exact: marginal, found: found(MARGINAL) },
    })
}

fn highlight(
    setting: &Setting<'_>,
    glossy: &Place<'_>,
    (place, light): (usize, &Light),
) -> Option<ExactAnswer> {
    let eye = setting.eye();
    let point = alhazen(glossy.center, radius(glossy.body)?, light.position, eye)?;
    let probe = Probe::of(setting.scene, [glossy.body], Some(light))?;
    let tree = probe.tree(eye, point - eye, 1);
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
