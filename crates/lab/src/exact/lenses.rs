//! Balls of glass as lenses.

use super::geometry::{ball_crossing, ball_focal_length};
use super::probe::{Line, Probe};
use super::{
    AnswerCollector, ExactAnswer, ExactDeviation, ExactSetup, Inapplicable, MARGINAL, PlacedBody, radius,
};

pub(super) fn answer(setting: &ExactSetup<'_>, found: &mut AnswerCollector) {
    for lens in &setting.lenses {
        match Inapplicable::of_lens(setting.scene, lens) {
            Some(reason) => found.inapplicable.push(reason),
            None => found.answers.extend(radius(lens.body).and_then(|radius| focus(setting, lens, radius))),
        }
    }
}

fn focus(setting: &ExactSetup<'_>, lens: &PlacedBody<'_>, radius: f64) -> Option<ExactAnswer> {
    /// Near enough to the axis for the aberration to vanish, far enough for single precision.
    const PARAXIAL: f64 = 0.01;
    let ior = setting.scene.material(&lens.body.material)?.ior()?;
    let axis = match setting.parallel_view() {
        Some(view) => view,
        None => (lens.center - setting.scene.camera.position).try_normalize()?,
    };
    let beside = axis.any_orthonormal_vector();
    let probe = Probe::of(setting.scene, [lens.body], None, lens.center)?;
    let found = |height: f64| {
        let start = lens.center - 2.0 * radius * axis + height * radius * beside;
        let middle = Line { point: lens.center, direction: axis };
        middle.nearest_to(&probe.transmitted(start, axis)?)
    };
    let at = |distance: f64| lens.center + distance * axis;
    let focal_length = ball_focal_length(radius, ior);
    // Within the ball the ray is still to be bent once more, and crosses the axis elsewhere.
    let marginal = Some(ball_crossing(radius, ior, MARGINAL * radius)).filter(|crossing| *crossing > radius);
    Some(ExactAnswer::Focus {
        body: lens.index,
        focal_length,
        paraxial: ExactDeviation { exact: at(focal_length), found: found(PARAXIAL) },
        marginal: marginal.map(|crossing| ExactDeviation { exact: at(crossing), found: found(MARGINAL) }),
    })
}
