//! Where bodies stand: the transform from a body's own frame to the world.

use glam::{DAffine3, DMat3, DQuat, DVec3};

/// The transform from a body's own frame to the world: `T · R · S`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Where the frame's origin stands and how the frame is turned.
    pub anchor: Anchor,
    /// Scale along the frame's own axes, applied first. Default 1 each.
    pub scale: DVec3,
}

impl Default for Placement {
    fn default() -> Self {
        Self::at(DVec3::ZERO)
    }
}

impl Placement {
    /// Unturned and unscaled at `position`.
    pub const fn at(position: DVec3) -> Self {
        Self { anchor: Anchor::Frame { position, rotation_degrees: DVec3::ZERO }, scale: DVec3::ONE }
    }

    /// Moves the placement in the world by `offset`, meters.
    pub fn moved_by(self, offset: DVec3) -> Self {
        let anchor = match self.anchor {
            Anchor::Frame { position, rotation_degrees } => {
                Anchor::Frame { position: position + offset, rotation_degrees }
            }
            Anchor::Axis { base, top } => Anchor::Axis { base: base + offset, top: top + offset },
        };
        Self { anchor, ..self }
    }

    /// World place of the frame's origin, meters: the position, or the center of the lower base.
    pub const fn origin(&self) -> DVec3 {
        match self.anchor {
            Anchor::Frame { position, .. } => position,
            Anchor::Axis { base, .. } => base,
        }
    }

    /// The rotation `R` of the body's own frame.
    pub fn rotation(&self) -> DMat3 {
        match self.anchor {
            Anchor::Frame { rotation_degrees, .. } => rotation_from_degrees(rotation_degrees),
            Anchor::Axis { base, top } => {
                let axis = (top - base).try_normalize().unwrap_or(DVec3::Y);
                DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Y, axis))
            }
        }
    }

    /// The transform from the body's own frame to the world, `T · R · S`.
    pub fn world_from_body(&self) -> DAffine3 {
        let matrix3 = self.rotation() * DMat3::from_diagonal(self.scale);
        DAffine3 { matrix3, translation: self.origin() }
    }
}

/// The two ways of saying where a body stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    /// By the place of its frame's origin and three turns.
    Frame {
        /// World place of the frame's origin, meters.
        position: DVec3,
        /// Turns about the fixed X, then Y, then Z axis, degrees, right-hand rule.
        rotation_degrees: DVec3,
    },
    /// By the ends of its axis (shapes with a height only), which also set the height.
    Axis {
        /// Center of the lower base, meters.
        base: DVec3,
        /// Center of the upper base, or the apex, meters.
        top: DVec3,
    },
}

/// `Rz · Ry · Rx` for turns in degrees; multiples of 90° are exact.
fn rotation_from_degrees(degrees: DVec3) -> DMat3 {
    let (sx, cx) = sin_cos_degrees(degrees.x);
    let (sy, cy) = sin_cos_degrees(degrees.y);
    let (sz, cz) = sin_cos_degrees(degrees.z);
    let rx = DMat3::from_cols(DVec3::X, DVec3::new(0.0, cx, sx), DVec3::new(0.0, -sx, cx));
    let ry = DMat3::from_cols(DVec3::new(cy, 0.0, -sy), DVec3::Y, DVec3::new(sy, 0.0, cy));
    let rz = DMat3::from_cols(DVec3::new(cz, sz, 0.0), DVec3::new(-sz, cz, 0.0), DVec3::Z);
    rz * ry * rx
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90°.
fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let turn = degrees.rem_euclid(360.0);
    match turn {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => turn.to_radians().sin_cos(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn world_from(rotation_degrees: DVec3) -> DAffine3 {
        Placement { anchor: Anchor::Frame { position: DVec3::ZERO, rotation_degrees }, scale: DVec3::ONE }
            .world_from_body()
    }

    #[test]
    fn turns_are_about_x_then_y_then_z() {
        let turned = world_from(DVec3::new(90.0, 0.0, 90.0)).transform_vector3(DVec3::Y);
        // About X, +Y goes to +Z; about Z it stays there.
        assert_eq!(turned, DVec3::Z);
        let turned = world_from(DVec3::new(90.0, 90.0, 0.0)).transform_vector3(DVec3::Y);
        // +Y → +Z → +X.
        assert_eq!(turned, DVec3::X);
        // By the right-hand rule a turn about Z carries +X to +Y.
        assert_eq!(world_from(DVec3::new(0.0, 0.0, 90.0)).transform_vector3(DVec3::X), DVec3::Y);
    }

    #[test]
    fn scale_comes_before_rotation() {
        let placement = Placement {
            anchor: Anchor::Frame { position: DVec3::new(1.0, 2.0, 3.0), rotation_degrees: DVec3::Z * 90.0 },
            scale: DVec3::new(2.0, 1.0, 1.0),
        };
        assert_eq!(placement.world_from_body().transform_point3(DVec3::X), DVec3::new(1.0, 4.0, 3.0));
    }

    #[test]
    fn a_moved_placement_carries_its_points_along() {
        let (offset, scale) = (DVec3::new(1.0, -2.0, 4.0), DVec3::new(1.0, 2.0, 3.0));
        let frame = Anchor::Frame { position: DVec3::Z, rotation_degrees: DVec3::splat(20.0) };
        let axis = Anchor::Axis { base: DVec3::Y, top: DVec3::X };
        for placement in [frame, axis].map(|anchor| Placement { anchor, scale }) {
            let moved = placement.moved_by(offset);
            assert_eq!(moved.origin(), placement.origin() + offset);
            let point = |placement: Placement| placement.world_from_body().transform_point3(DVec3::ONE);
            assert!((point(moved) - point(placement) - offset).length() < 1e-12);
        }
    }
}
