//! Lenses of two faces, and where they gather light.

use catoptric_scene::{Body, BodyShape, Lens, ParametricShape};
use glam::DVec3;

use super::geometry::lens_crossing;
use super::probe::{Line, Probe};
use super::{AnswerCollector, ExactAnswer, ExactDeviation, ExactSetup, Inapplicable, MARGINAL, PlacedBody};

/// How far from the axis the inner ray runs, in radii of the rim: the aberration vanishes, and single precision still
/// tells the ray from the axis.
const PARAXIAL: f64 = 0.02;

/// A lens in the world, as the light meets it that comes along its axis from the side of the eye.
struct PlacedLens {
    /// The vertex of the face that the light leaves by.
    last: DVec3,
    /// The unit direction of the light.
    axis: DVec3,
    across: DVec3,
    /// Radii of curvature of the faces in the order of the light, meters; 0 is flat, above 0 are those whose center lies
    /// behind the face.
    faces: [f64; 2],
    thickness: f64,
    rim: f64,
    /// Meters.
    focal_length: f64,
}

/// The lens that a body is, if it is one that is scaled evenly.
pub(super) fn lens_of(body: &Body) -> Option<Lens> {
    let BodyShape::Parametric(ParametricShape::Lens(lens)) = body.body_shape() else { return None };
    let scale = body.placement.scale.abs();
    (scale.max_element() - scale.min_element() <= 1e-12 * scale.max_element()).then_some(lens)
}

pub(super) fn answer(setting: &ExactSetup<'_>, found: &mut AnswerCollector) {
    for lens in &setting.thick_lenses {
        match Inapplicable::of_thick_lens(setting.scene, lens) {
            Some(reason) => found.inapplicable.push(reason),
            None => found.answers.extend(focus(setting, lens)),
        }
    }
}

impl PlacedLens {
    fn of(body: &Body, ior: f64, eye: DVec3) -> Option<Self> {
        let lens = lens_of(body)?;
        let (front, back) = lens.radii()?;
        let scale = body.placement.scale.abs().x;
        let rotation = body.placement.rotation();
        let middle = body.placement.world_from_body().translation;
        // Light from the other side meets the faces in the other order, and each from behind.
        let is_turned = (eye - middle).dot(rotation.y_axis) > 0.0;
        let (axis, faces) =
            if is_turned { (-rotation.y_axis, [-back, -front]) } else { (rotation.y_axis, [front, back]) };
        let thickness = lens.thickness * scale;
        Some(Self {
            last: middle + 0.5 * thickness * axis,
            axis,
            across: rotation.x_axis,
            faces: faces.map(|radius| radius * scale + 0.0),
            thickness,
            rim: lens.radius * scale,
            focal_length: lens.focal_length(ior) * scale,
        })
    }
}

fn focus(setting: &ExactSetup<'_>, body: &PlacedBody<'_>) -> Option<ExactAnswer> {
    let ior = setting.scene.material(&body.body.material)?.ior()?;
    let eye = match setting.parallel_view() {
        Some(view) => body.center - view,
        None => setting.scene.camera.position,
    };
    let PlacedLens { last, axis, across, faces, thickness, rim, focal_length } =
        PlacedLens::of(body.body, ior, eye)?;
    let probe = Probe::of(setting.scene, [body.body], None, body.center)?;
    let middle = Line { point: last, direction: axis };
    let far = 2.0 * (thickness + rim) * axis;
    let at = |height: f64| {
        let crossing = lens_crossing(faces, thickness, ior, height)?;
        let found = probe.transmitted(last - far + height * across, axis);
        let found = found.and_then(|ray| middle.nearest_to(&ray));
        Some(ExactDeviation { exact: last + crossing * axis, found })
    };
    // The second principal plane (Hecht 2017, Optics, eq. 6.3 and 6.4).
    let bulge = if faces[0] == 0.0 { 0.0 } else { faces[0].recip() };
    let back_focal_length = focal_length * (1.0 - (ior - 1.0) * thickness * bulge / ior);
    let found = at(PARAXIAL * rim)?.found;
    Some(ExactAnswer::LensFocus {
        body: body.index,
        focal_length,
        paraxial: ExactDeviation { exact: last + back_focal_length * axis, found },
        marginal: at(MARGINAL * rim),
    })
}
