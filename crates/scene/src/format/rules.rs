//! Rules that hold between several values; the reader and the validation of scenes in memory share them.

use glam::DVec3;

use crate::format::spec::Limits;

/// Two points, or a direction and a line, that differ by less than this part of their size are taken as the same: no
/// direction can be told from them in single precision.
const RELATIVE: f64 = 1e-7;

/// A broken rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Broken {
    /// The key that is marked.
    pub(crate) key: &'static str,
    /// What is wrong.
    pub(crate) message: &'static str,
    /// What to do.
    pub(crate) help: &'static str,
}

/// A camera needs a direction of view, and an upward direction across it.
pub(crate) fn camera(position: DVec3, target: DVec3, up: DVec3) -> Option<Broken> {
    if are_same(position, target) {
        return Some(Broken {
            key: "target",
            message: "`target` and `position` of the camera are the same point",
            help: "the camera looks from `position` towards `target`; move one of them",
        });
    }
    if up.abs().max_element() < Limits::LENGTH.min {
        return Some(Broken {
            key: "up",
            message: "`up` is zero, but must be a direction",
            help: "`up` is the direction that points up in the picture, mostly `[0.0, 1.0, 0.0]`",
        });
    }
    // Scaled first, so that no square overflows or vanishes.
    let view = target - position;
    let view = (view / view.abs().max_element()).normalize();
    let up = (up / up.abs().max_element()).normalize();
    if view.cross(up).length() < RELATIVE {
        return Some(Broken {
            key: "up",
            message: "`up` is parallel to the direction of view",
            help: "choose another `up`, for example `[0.0, 0.0, -1.0]` for a camera that looks straight down",
        });
    }
    None
}

/// An axis needs two different points at a distance that can be a height.
pub(crate) fn axis(base: DVec3, top: DVec3) -> Option<Broken> {
    let help = "`base` and `top` are the ends of the axis; move one of them";
    if are_same(base, top) {
        return Some(Broken { key: "top", message: "`base` and `top` are the same point", help });
    }
    if !Limits::LENGTH.contains(base.distance(top)) {
        return Some(Broken { key: "top", message: "`base` and `top` are more than 1e9 meters apart", help });
    }
    None
}

fn are_same(a: DVec3, b: DVec3) -> bool {
    let size = a.abs().max(b.abs()).max_element();
    (a - b).abs().max_element() <= (size * RELATIVE).max(Limits::LENGTH.min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_relative() {
        let up = DVec3::Y;
        assert_eq!(camera(DVec3::Z, DVec3::ZERO, up), None);
        assert_eq!(camera(DVec3::Z * 1e-6, DVec3::ZERO, up * 1e-6), None);
        let key = |broken: Option<Broken>| broken.map(|broken| broken.key);
        assert_eq!(key(camera(DVec3::Z, DVec3::Z, up)), Some("target"));
        assert_eq!(key(camera(DVec3::Z * 1e8, DVec3::Z * (1e8 + 1.0), up)), Some("target"));
        assert_eq!(key(camera(DVec3::Z, DVec3::ZERO, DVec3::ZERO)), Some("up"));
        assert_eq!(key(camera(DVec3::Y * 3.0, DVec3::ZERO, up * 1e9)), Some("up"));
        assert_eq!(key(axis(DVec3::ONE, DVec3::ONE)), Some("top"));
        assert_eq!(key(axis(DVec3::X * 1e9, DVec3::X * -1e9)), Some("top"));
        assert_eq!(axis(DVec3::ZERO, DVec3::X * 1e-6), None);
    }
}
