//! Rules that hold between several values; the reader and the validation of scenes in memory share them.

use glam::{DAffine3, DVec3};

use crate::Scene;
use crate::compound::{BodyPart, BodyShape, BrokenSize, Form, SizeFault};
use crate::format::message::{Component, FoundValue, Message, Subject, size_fault, size_help};
use crate::format::quote::quoted;
use crate::format::spec::Limits;
use crate::instances::{InstanceFault, InstanceProblem};
use crate::shape::Shape;

/// Directions are parallel if the sine of the angle between them is less than this: some thousand times the error of
/// rounding of their product in double precision, in which cameras are placed.
const PARALLEL: f64 = 1e-12;

/// A rule that a scene breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct BrokenRule {
    /// The key that is marked.
    pub(crate) key: &'static str,
    /// What is wrong.
    pub(crate) message: Message,
    /// What to do.
    pub(crate) help: Message,
}

impl BrokenRule {
    /// Sizes of a shape that contradict each other.
    fn of_size(broken: BrokenSize) -> Self {
        let help = Message::ChangeSizes { help: size_help(broken) };
        let message = match broken.fault {
            // For its shape the number has closer limits than its key.
            SizeFault::NoLength { value } => Message::OutOfRange {
                subject: Subject::component(Component::Whole, broken.key),
                value: FoundValue::Value(value.into()),
                requirement: Limits::LENGTH.requirement(value),
            },
            _ => Message::Sizes { fault: size_fault(broken) },
        };
        Self { key: broken.key, message, help }
    }
}

/// A camera needs a direction of view, and an upward direction across it.
pub(crate) fn camera(position: DVec3, target: DVec3, up: DVec3) -> Option<BrokenRule> {
    // The difference of two doubles is exact, or off by one rounding: it gives a direction wherever both points are.
    if let Some(how) = are_too_near(position, target) {
        return Some(BrokenRule {
            key: "target",
            message: match how {
                Nearness::Same => Message::TargetIsPosition,
                Nearness::Near => Message::TargetIsNear,
            },
            help: Message::CameraLooks,
        });
    }
    if up.abs().max_element() < Limits::LENGTH.min {
        return Some(BrokenRule { key: "up", message: Message::UpIsZero, help: Message::UpPoints });
    }
    // Scaled first, so that no square overflows or vanishes.
    let view = target - position;
    let view = (view / view.abs().max_element()).normalize();
    let up = (up / up.abs().max_element()).normalize();
    if view.cross(up).length() < PARALLEL {
        return Some(BrokenRule { key: "up", message: Message::UpIsParallel, help: Message::ChooseUp });
    }
    None
}

/// An axis needs two different points at a distance that can be a height.
pub(crate) fn axis(base: DVec3, top: DVec3) -> Option<BrokenRule> {
    let help = Message::AxisEnds;
    if let Some(how) = are_too_near(base, top) {
        let message = match how {
            Nearness::Same => Message::BaseIsTop,
            Nearness::Near => Message::BaseIsNearTop,
        };
        return Some(BrokenRule { key: "top", message, help });
    }
    if !Limits::LENGTH.contains(base.distance(top)) {
        return Some(BrokenRule { key: "top", message: Message::BaseIsFarFromTop, help });
    }
    None
}

/// Sizes that only together are wrong.
pub(crate) fn sizes(shape: &BodyShape) -> Option<BrokenRule> {
    match shape {
        BodyShape::Plain(shape) => depth(shape),
        BodyShape::Parametric(shape) => shape.broken_size().map(BrokenRule::of_size),
    }
}

/// The focal length of a paraboloid has the limits of a length, and so has the height that it gives.
fn depth(shape: &Shape) -> Option<BrokenRule> {
    let length = shape.number("focal_length")?;
    if !Limits::LENGTH.contains(length) {
        let fault = SizeFault::NoLength { value: length };
        return Some(BrokenRule::of_size(BrokenSize { key: "focal_length", fault }));
    }
    (!Limits::LENGTH.contains(shape.height()?)).then_some(BrokenRule {
        key: "focal_length",
        message: Message::FocalLengthBesideRadius,
        help: Message::HeightOfParaboloid,
    })
}

/// What has parts needs one, surfaces stand alone, and what is joined has no more parts than rays can keep apart.
pub(crate) fn parts(form: &Form<'_>) -> Option<BrokenRule> {
    let shape = form.shape.key();
    if !form.shape.is_compound() {
        return None;
    }
    if form.parts.is_empty() {
        return Some(BrokenRule {
            key: "parts",
            message: Message::NoParts { shape },
            help: Message::BeginPart,
        });
    }
    if let Some(broken) = surface(form) {
        return Some(broken);
    }
    let mut count = 0_usize;
    // A part that has too many is named itself.
    if form.shape != Shape::Group && form.parts.iter().all(|part| parts(&part.form()).is_none()) {
        form.each_simple(DAffine3::IDENTITY, &mut |_| count += 1);
    }
    (count > Shape::MAX_PARTS).then(|| BrokenRule {
        key: "parts",
        message: Message::TooManyParts {
            shape,
            count: count.to_string(),
            most: Shape::MAX_PARTS.to_string(),
        },
        help: Message::GroupHasMore,
    })
}

/// The surface of one simple shape is cut; what has no inside cannot be joined.
fn surface(form: &Form<'_>) -> Option<BrokenRule> {
    let is_compound = |part: &BodyPart| part.form().shape.is_compound();
    let (message, help) = if form.shape.is_surface() && form.parts.first().is_some_and(is_compound) {
        (Message::SurfaceOfJoined, Message::SurfaceOfSimple)
    } else if form.shape != Shape::Group && form.parts.iter().any(|part| has_surface(&part.form())) {
        (Message::SurfaceWithin { shape: form.shape.key() }, Message::SurfaceStandsAlone)
    } else {
        return None;
    };
    Some(BrokenRule { key: "parts", message, help })
}

/// Whether a form is a surface, or a group with one.
fn has_surface(form: &Form<'_>) -> bool {
    let is_group = form.shape == Shape::Group;
    form.shape.is_surface() || is_group && form.parts.iter().any(|part| has_surface(&part.form()))
}

/// An instance needs another body, which must not need it, and there is an end to what instances can be.
pub(crate) fn instance(fault: &InstanceFault) -> BrokenRule {
    let name = quoted(&fault.of);
    let (message, help) = match fault.problem {
        InstanceProblem::Unknown => (Message::UndefinedBody { name }, Message::InstanceOfBody),
        InstanceProblem::OfItself => (Message::InstanceOfItself { name }, Message::InstanceOfOther),
        InstanceProblem::TooDeep => {
            (Message::PartsTooDeep, Message::DeepestParts { most: Shape::MAX_DEPTH.to_string() })
        }
        InstanceProblem::TooManyParts { shape, count } => {
            let (count, most) = (count.to_string(), Shape::MAX_PARTS.to_string());
            (Message::TooManyParts { shape: shape.key(), count, most }, Message::GroupHasMore)
        }
        InstanceProblem::SurfaceWithin { shape } => {
            (Message::SurfaceWithin { shape: shape.key() }, Message::SurfaceStandsAlone)
        }
        InstanceProblem::TooMany { count } => {
            let most = Scene::MAX_INSTANCED.to_string();
            (Message::TooManyInstances { count: count.to_string(), most }, Message::FewerInstances)
        }
    };
    BrokenRule { key: "instance_of", message, help }
}

/// Whether an intersection holds nothing, as far as the boxes around its parts show it.
pub(crate) fn is_empty(form: &Form<'_>) -> bool {
    form.shape == Shape::Intersection && form.extent() == Some([DVec3::ZERO; 2])
}

/// The distance of two points that should be apart.
enum Nearness {
    /// No number differs.
    Same,
    /// Nearer than any length can be.
    Near,
}

fn are_too_near(a: DVec3, b: DVec3) -> Option<Nearness> {
    match a.distance(b) {
        _ if a == b => Some(Nearness::Same),
        distance if distance < Limits::LENGTH.min => Some(Nearness::Near),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_apart_wherever_they_are() {
        let up = DVec3::Y;
        assert_eq!(camera(DVec3::Z, DVec3::ZERO, up), None);
        assert_eq!(camera(DVec3::Z * 1e-6, DVec3::ZERO, up * 1e-6), None);
        let key = |broken: Option<BrokenRule>| broken.map(|broken| broken.key);
        assert_eq!(key(camera(DVec3::Z, DVec3::Z, up)), Some("target"));
        let message = |broken: Option<BrokenRule>| broken.map(|broken| broken.message);
        for far in [1e5, 1e8, 1e9] {
            let at = DVec3::new(far, -far, far);
            for step in [DVec3::X, DVec3::Z * 1e-3, DVec3::NEG_ONE] {
                assert_eq!(
                    (camera(at, at + step, DVec3::new(0.1, 0.3, 0.2)), axis(at + step, at)),
                    (None, None)
                );
            }
            assert_eq!(message(camera(at, at, up)), Some(Message::TargetIsPosition));
            assert_eq!(message(axis(at, at)), Some(Message::BaseIsTop));
        }
        assert_eq!(message(camera(DVec3::ZERO, DVec3::Z * 1e-10, up)), Some(Message::TargetIsNear));
        assert_eq!(message(axis(DVec3::ZERO, DVec3::Z * 1e-10)), Some(Message::BaseIsNearTop));
        assert_eq!(camera(DVec3::Y * 3.0, DVec3::ZERO, DVec3::new(1e-9, 1.0, 0.0)), None);
        assert_eq!(key(camera(DVec3::Z, DVec3::ZERO, DVec3::ZERO)), Some("up"));
        assert_eq!(key(camera(DVec3::Y * 3.0, DVec3::ZERO, up * 1e9)), Some("up"));
        assert_eq!(key(axis(DVec3::ONE, DVec3::ONE)), Some("top"));
        assert_eq!(key(axis(DVec3::X * 1e9, DVec3::X * -1e9)), Some("top"));
        assert_eq!(axis(DVec3::ZERO, DVec3::X * 1e-6), None);
    }
}
