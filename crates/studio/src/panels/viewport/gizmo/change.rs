//! A rigid or scaling change of the world, and what it makes of placements.

use catoptric_scene::{Anchor, Camera, Placement};
use glam::{DAffine3, DMat3, DQuat, DVec3};

/// A change of the dragged things by the gizmo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum GizmoChange {
    /// Moves it, meters.
    Move(DVec3),
    /// Turns it about an axis through a point.
    Turn {
        /// A point of the axis.
        pivot: DVec3,
        /// The axis, of length 1.
        axis: DVec3,
        /// By how much, by the right-hand rule.
        radians: f64,
    },
    /// Scales it about a point.
    Scale {
        /// The point that stays.
        pivot: DVec3,
        /// Unit vectors, at right angles, along which the factors count.
        axes: [DVec3; 3],
        /// The factors, more than 0.
        factors: DVec3,
    },
}

impl GizmoChange {
    /// Where a point goes.
    pub(crate) fn point(&self, point: DVec3) -> DVec3 {
        match *self {
            Self::Move(step) => DVec3::select(step.cmpeq(DVec3::ZERO), point, (point + step).map(neat)),
            Self::Turn { pivot, .. } | Self::Scale { pivot, .. } => pivot + self.matrix() * (point - pivot),
        }
    }

    /// Applies the change to a placement. Turns are written by the numbers nearest to `near`, degrees, so that they do
    /// not jump.
    ///
    /// A scale that does not go along a body's own axes would shear it; the body's axes then stay at right angles and
    /// get the lengths that they would have had.
    pub(crate) fn placement(&self, start: &Placement, near: DVec3) -> Placement {
        let anchor = match start.anchor {
            Anchor::Axis { base, top } => Anchor::Axis { base: self.point(base), top: self.point(top) },
            Anchor::Frame { position, rotation_degrees } => {
                let position = self.point(position);
                let rotation_degrees = match self {
                    Self::Turn { .. } => degrees_of(&(self.matrix() * start.rotation()), near),
                    Self::Move(_) | Self::Scale { .. } => rotation_degrees,
                };
                Anchor::Frame { position, rotation_degrees }
            }
        };
        Placement { anchor, scale: self.scale(start) }
    }

    /// The change as the parts of a whole see it: in the frame that `around_from_world` leads to, whose rotation in the
    /// world is `turn`. In a whole that is stretched, turns and scales are those of the frame.
    pub(crate) fn within(&self, around_from_world: DAffine3, turn: DMat3) -> Self {
        let point = |point: DVec3| around_from_world.transform_point3(point);
        let direction = |direction: DVec3| turn.transpose() * direction;
        match *self {
            Self::Move(step) => Self::Move(around_from_world.transform_vector3(step)),
            Self::Turn { pivot, axis, radians } => {
                Self::Turn { pivot: point(pivot), axis: direction(axis), radians }
            }
            Self::Scale { pivot, axes, factors } => {
                Self::Scale { pivot: point(pivot), axes: axes.map(direction), factors }
            }
        }
    }

    /// What a camera becomes.
    pub(crate) fn camera(&self, start: &Camera) -> Camera {
        let up = match self {
            Self::Turn { .. } => self.matrix() * start.up,
            Self::Move(_) | Self::Scale { .. } => start.up,
        };
        Camera { position: self.point(start.position), target: self.point(start.target), up, ..*start }
    }

    fn scale(&self, start: &Placement) -> DVec3 {
        let Self::Scale { .. } = self else { return start.scale };
        let scaled = self.matrix() * start.rotation();
        let lengths =
            DVec3::new(scaled.x_axis.length(), scaled.y_axis.length(), scaled.z_axis.length()).map(neat);
        match start.anchor {
            Anchor::Frame { .. } => start.scale * lengths,
            // The ends of the axis already carry the length.
            Anchor::Axis { .. } => start.scale * DVec3::new(lengths.x, 1.0, lengths.z),
        }
    }

    /// The linear part.
    fn matrix(&self) -> DMat3 {
        match *self {
            Self::Move(_) => DMat3::IDENTITY,
            Self::Turn { axis, radians, .. } => DMat3::from_quat(DQuat::from_axis_angle(axis, radians)),
            Self::Scale { axes: [x, y, z], factors, .. } => {
                let frame = DMat3::from_cols(x, y, z);
                frame * DMat3::from_diagonal(factors) * frame.transpose()
            }
        }
    }
}

/// Without the rounding of matrices in the last digits, which would end up in files.
pub(crate) fn neat(value: f64) -> f64 {
    let rounded = (value * 1e9).round() / 1e9;
    if (rounded - value).abs() < 1e-12 * value.abs().max(1.0) { rounded } else { value }
}

/// The turns about X, then Y, then Z, degrees, that make the rotation `matrix`, of all such triples the nearest to
/// `near`.
///
/// With the matrix Rz·Ry·Rx its entries are r₂₀ = −sin y, r₂₁ = cos y sin x, r₂₂ = cos y cos x, r₁₀ = sin z cos y and
/// r₀₀ = cos z cos y. Where cos y = 0 (gimbal lock), only x ∓ z is known, from r₀₁ = ±sin(x ∓ z) and
/// r₀₂ = ±cos(x ∓ z); x then stays as it was.
pub(crate) fn degrees_of(matrix: &DMat3, near: DVec3) -> DVec3 {
    /// Below this, the rounding of the matrix weighs more than what the first case would gain.
    const LOCK: f64 = 1e-8;
    let entry = |row: usize, column: usize| matrix.col(column)[row];
    let cosine = entry(2, 1).hypot(entry(2, 2));
    let y = (-entry(2, 0)).atan2(cosine);
    let turns = if cosine > LOCK {
        DVec3::new(entry(2, 1).atan2(entry(2, 2)), y, entry(1, 0).atan2(entry(0, 0)))
    } else {
        let sign = y.signum();
        let x = near.x.to_radians();
        let joint = (sign * entry(0, 1)).atan2(sign * entry(0, 2));
        DVec3::new(x, y, sign * (x - joint))
    };
    nearest_turns(turns.map(f64::to_degrees), near).map(neat_degrees)
}

/// Of the triples that turn alike, the nearest to `near`: (x + 180, 180 − y, z + 180) turns as (x, y, z) does, and
/// whole turns change nothing.
fn nearest_turns(degrees: DVec3, near: DVec3) -> DVec3 {
    let other = DVec3::new(degrees.x + 180.0, 180.0 - degrees.y, degrees.z + 180.0);
    let [first, second] = [degrees, other].map(|turns| turns - 360.0 * ((turns - near) / 360.0).round());
    if first.distance_squared(near) <= second.distance_squared(near) { first } else { second }
}

/// Rounded to a millionth of a degree where it is that within the precision of a rotation matrix.
fn neat_degrees(degrees: f64) -> f64 {
    let rounded = (degrees * 1e6).round() / 1e6;
    if (rounded - degrees).abs() < 1e-9 { rounded } else { degrees }
}

#[cfg(test)]
mod tests;
