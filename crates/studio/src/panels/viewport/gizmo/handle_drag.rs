//! The drag of a gizmo handle: from the pointer's place to a change.

use glam::{DVec2, DVec3};

use super::change::GizmoChange;
use super::lines::{across, along_axis, angle_about, angle_in, in_picture, on_plane, wrapped};
use super::{Gizmo, GizmoHandle, OUTER_RING, RING, arm, steps};
use crate::base::projector::Projector;

/// The least factor of one drag.
const LEAST_FACTOR: f64 = 0.01;

/// The precision of a drag, by modifier keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct DragPrecision {
    /// To whole steps.
    pub(crate) snaps: bool,
    /// With more digits.
    pub(crate) is_fine: bool,
}

/// The amount of a change, displayed beside the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum DragAmount {
    /// Meters along the axes of the gizmo; `None` where nothing moves.
    Meters([Option<f64>; 3]),
    /// Degrees.
    Degrees(f64),
    /// A factor.
    Factor(f64),
}

/// The drag of a gizmo handle.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HandleDrag {
    pub(crate) gizmo: Gizmo,
    pub(crate) handle: GizmoHandle,
    start: DVec2,
    grip: HandleGrip,
}

/// The part of a handle that was grabbed.
#[derive(Clone, Debug, PartialEq)]
enum HandleGrip {
    /// A point of an axis, meters from the center.
    Axis(f64),
    /// A point of the plane with this normal.
    Plane { normal: DVec3, from: DVec3 },
    /// A ring: the frame in its plane, the last angle and the sum of all turns, radians.
    Ring { frame: [DVec3; 2], last: f64, total: f64 },
    /// A ring seen edge-on: radians for each point that the pointer moves in the picture.
    Edge(DVec2),
    /// The outer ring.
    Outer { last: f64, total: f64 },
    /// The center of scaling.
    Middle,
}

impl HandleDrag {
    /// Begins the drag of a handle with the pointer at `at`.
    pub(crate) fn begin(gizmo: Gizmo, handle: GizmoHandle, projector: &Projector, at: DVec2) -> Option<Self> {
        let ray = projector.ray(at);
        let pivot = gizmo.pivot;
        let grip = match handle {
            GizmoHandle::Move(axis) => HandleGrip::Axis(along_axis(&ray, pivot, gizmo.axis(axis))?),
            GizmoHandle::Scale(axis) => {
                let along = along_axis(&ray, pivot, gizmo.axis(axis))?;
                HandleGrip::Axis(along.max(gizmo.grain(projector)))
            }
            GizmoHandle::MovePlane(axis) => {
                let normal = gizmo.axis(axis);
                HandleGrip::Plane { normal, from: on_plane(&ray, pivot, normal)? }
            }
            GizmoHandle::MoveScreen => {
                let [.., normal] = projector.axes();
                HandleGrip::Plane { normal, from: on_plane(&ray, pivot, normal)? }
            }
            GizmoHandle::Turn(axis) => turn_grip(&gizmo, axis, projector, at),
            GizmoHandle::TurnView => {
                HandleGrip::Outer { last: angle_about(projector.project(pivot)?, at)?, total: 0.0 }
            }
            GizmoHandle::ScaleAll => HandleGrip::Middle,
        };
        Some(Self { gizmo, handle, start: at, grip })
    }

    /// What the pointer at `at` makes of it; `None` when that place says nothing, and all is to stay as it is.
    pub(crate) fn to(
        &mut self,
        projector: &Projector,
        at: DVec2,
        precision: DragPrecision,
    ) -> Option<(GizmoChange, DragAmount)> {
        let pivot = self.gizmo.pivot;
        let start = self.start;
        let ray = projector.ray(at);
        match (&mut self.grip, self.handle) {
            (HandleGrip::Axis(from), GizmoHandle::Scale(axis)) => {
                let factor = along_axis(&ray, pivot, self.gizmo.axis(axis))? / *from;
                Some(self.scale(Some(axis), factor, precision))
            }
            (HandleGrip::Axis(from), GizmoHandle::Move(axis)) => {
                let direction = self.gizmo.axis(axis);
                let step = (along_axis(&ray, pivot, direction)? - *from) * direction;
                Some(self.step(step, [0, 1, 2].map(|other| other == axis), projector, precision))
            }
            (HandleGrip::Plane { normal, from }, handle) => {
                let step = on_plane(&ray, pivot, *normal)? - *from;
                let moves = [0, 1, 2].map(|other| handle != GizmoHandle::MovePlane(other));
                Some(self.step(step, moves, projector, precision))
            }
            (HandleGrip::Ring { frame, last, total }, GizmoHandle::Turn(axis)) => {
                let axis = self.gizmo.axis(axis);
                let angle = angle_in(pivot, *frame, on_plane(&ray, pivot, axis)?);
                *total += wrapped(angle - *last);
                *last = angle;
                Some(turn(pivot, axis, *total, precision))
            }
            (HandleGrip::Edge(radians), GizmoHandle::Turn(axis)) => {
                let total = radians.dot(at - start);
                Some(turn(pivot, self.gizmo.axis(axis), total, precision))
            }
            (HandleGrip::Outer { last, total }, _) => {
                let angle = angle_about(projector.project(pivot)?, at)?;
                *total += wrapped(angle - *last);
                *last = angle;
                Some(turn(pivot, -projector.towards(pivot), *total, precision))
            }
            (HandleGrip::Middle, _) => {
                let way = (at - start).dot(DVec2::new(1.0, -1.0));
                Some(self.scale(None, (way / 120.0).exp2(), precision))
            }
            (HandleGrip::Axis(_) | HandleGrip::Ring { .. } | HandleGrip::Edge(_), _) => None,
        }
    }

    /// The points of the ring's sector that has been swept, from the center.
    pub(crate) fn swept(&self, projector: &Projector) -> Option<Vec<DVec2>> {
        let (axis, total, from) = match (&self.grip, self.handle) {
            (HandleGrip::Ring { total, .. }, GizmoHandle::Turn(axis)) => {
                let axis = self.gizmo.axis(axis);
                (axis, *total, on_plane(&projector.ray(self.start), self.gizmo.pivot, axis)?)
            }
            (HandleGrip::Outer { total, .. }, _) => {
                let axis = -projector.towards(self.gizmo.pivot);
                (axis, *total, on_plane(&projector.ray(self.start), self.gizmo.pivot, axis)?)
            }
            _ => return None,
        };
        let pivot = self.gizmo.pivot;
        let radius = if self.handle == GizmoHandle::TurnView { OUTER_RING } else { RING };
        let first = (from - pivot).reject_from_normalized(axis).try_normalize()?;
        let frame = [first, axis.cross(first)];
        let steps = ((total.abs() * 24.0).ceil() as usize).clamp(1, 160);
        let rim = (0..=steps).filter_map(|step| {
            let arm = arm(frame, total * step as f64 / steps as f64);
            projector.project(pivot + radius * self.gizmo.grain(projector) * arm)
        });
        Some(projector.project(pivot).into_iter().chain(rim).collect())
    }

    /// A move with round numbers.
    fn step(
        &self,
        step: DVec3,
        moves: [bool; 3],
        projector: &Projector,
        precision: DragPrecision,
    ) -> (GizmoChange, DragAmount) {
        let fine = if precision.is_fine { 0.1 } else { 1.0 };
        let grid = if precision.snaps {
            steps::MOVE
        } else {
            steps::decimal_below(fine * self.gizmo.grain(projector))
        };
        let axes = self.gizmo.axes;
        let lead = if self.gizmo.is_local { DVec3::ZERO } else { self.gizmo.lead };
        let parts = steps::to_grid(DVec3::from_array(axes.map(|axis| axis.dot(step))), lead, moves, grid);
        let mut shown = [None; 3];
        let mut step = DVec3::ZERO;
        for (((part, axis), moves), shown) in
            parts.to_array().into_iter().zip(axes).zip(moves).zip(&mut shown)
        {
            if moves {
                step += part * axis;
                *shown = Some(part);
            }
        }
        (GizmoChange::Move(step), DragAmount::Meters(shown))
    }

    fn scale(&self, axis: Option<usize>, factor: f64, precision: DragPrecision) -> (GizmoChange, DragAmount) {
        let step = match (precision.snaps, precision.is_fine) {
            (true, _) => steps::SCALE,
            (false, true) => 0.001,
            (false, false) => 0.01,
        };
        let least = if precision.snaps { steps::SCALE } else { LEAST_FACTOR };
        let factor = steps::rounded(factor, step).clamp(least, 1e6);
        let factors = DVec3::from_array(
            [0, 1, 2].map(|other| if axis.is_none_or(|axis| axis == other) { factor } else { 1.0 }),
        );
        let change = GizmoChange::Scale { pivot: self.gizmo.pivot, axes: self.gizmo.axes, factors };
        (change, DragAmount::Factor(factor))
    }
}

fn turn_grip(gizmo: &Gizmo, axis: usize, projector: &Projector, at: DVec2) -> HandleGrip {
    /// The sine of the angle at which a ring counts as seen edge-on: there, its plane is met too far away.
    const EDGE_ON: f64 = 0.25;
    let (pivot, axis) = (gizmo.pivot, gizmo.axis(axis));
    let frame = across(axis);
    let met = on_plane(&projector.ray(at), pivot, axis);
    if projector.towards(pivot).dot(axis).abs() > EDGE_ON
        && let Some(met) = met
    {
        return HandleGrip::Ring { frame, last: angle_in(pivot, frame, met), total: 0.0 };
    }
    // The near point of the ring goes where the pointer goes.
    let radius = RING * gizmo.grain(projector);
    let near = (-projector.towards(pivot)).reject_from_normalized(axis).normalize_or(frame[0]);
    let along = axis.cross(near);
    let meter = in_picture(projector, pivot + radius * near, along).unwrap_or(DVec2::ZERO);
    let length_squared = meter.length_squared();
    HandleGrip::Edge(if length_squared > 0.0 { meter / length_squared / radius } else { DVec2::ZERO })
}

fn turn(pivot: DVec3, axis: DVec3, radians: f64, precision: DragPrecision) -> (GizmoChange, DragAmount) {
    let step = match (precision.snaps, precision.is_fine) {
        (true, _) => steps::TURN,
        (false, true) => 0.01,
        (false, false) => 0.1,
    };
    let degrees = steps::rounded(radians.to_degrees(), step);
    (GizmoChange::Turn { pivot, axis, radians: degrees.to_radians() }, DragAmount::Degrees(degrees))
}
