//! The gizmo: handles at the selection to move, turn and scale it. Its geometry and its answers to a hand know nothing
//! of egui; `draw` paints it.

pub(crate) mod change;
pub(crate) mod draw;
pub(crate) mod handle_drag;
pub(crate) mod lines;
pub(crate) mod steps;

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::base::projector::Projector;
use crate::state::command::Tool;
use lines::across;

/// Length of an axis in the picture, points.
const LENGTH: f64 = 84.0;
/// Where the axes begin, points from the center.
const GAP: f64 = 14.0;
/// The near and far edges of the plane squares, points along both axes.
const SQUARE: [f64; 2] = [24.0, 42.0];
/// Radius of the rings and of the outer ring, points.
const RING: f64 = 72.0;
const OUTER_RING: f64 = 90.0;
/// Radius of the center, points.
const CENTER: f64 = 9.0;
/// The distance within which the pointer grabs a line, points.
const REACH: f64 = 8.0;
/// Segments of a ring.
const SEGMENTS: usize = 72;

/// A handle of the gizmo. Numbers are axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum GizmoHandle {
    /// Moves along an axis.
    Move(usize),
    /// Moves in the plane across an axis.
    MovePlane(usize),
    /// Moves parallel to the picture.
    MoveScreen,
    /// Turns about an axis.
    Turn(usize),
    /// Turns about the direction of view.
    TurnView,
    /// Scales along an axis.
    Scale(usize),
    /// Scales all over.
    ScaleAll,
}

/// The tool, place and axes of the gizmo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Gizmo {
    pub(crate) tool: Tool,
    /// The center of the gizmo.
    pub(crate) pivot: DVec3,
    /// The axes of the gizmo, a right-handed frame.
    pub(crate) axes: [DVec3; 3],
    /// Whether the axes are a body's own ones.
    pub(crate) is_local: bool,
    /// The place of the primary thing: what snapping brings to round numbers.
    pub(crate) lead: DVec3,
}

impl Gizmo {
    fn axis(&self, axis: usize) -> DVec3 {
        self.axes.get(axis).copied().unwrap_or(DVec3::X)
    }

    /// Meters that a point of the picture spans at the center.
    pub(crate) fn grain(&self, projector: &Projector) -> f64 {
        projector.meters_per_point(self.pivot)
    }

    /// An axis in the picture, from near the center to its end.
    pub(crate) fn shaft(&self, projector: &Projector, axis: usize) -> Option<[DVec2; 2]> {
        let grain = self.grain(projector);
        let end = |length: f64| projector.project(self.pivot + length * grain * self.axis(axis));
        Some([end(GAP)?, end(LENGTH)?])
    }

    /// The corners of the square across an axis.
    pub(crate) fn square(&self, projector: &Projector, axis: usize) -> Option<[DVec2; 4]> {
        let grain = self.grain(projector);
        let (first, second) = (self.axis((axis + 1) % 3), self.axis((axis + 2) % 3));
        let corner = |a: f64, b: f64| projector.project(self.pivot + grain * (a * first + b * second));
        let [near, far] = SQUARE;
        Some([corner(near, near)?, corner(far, near)?, corner(far, far)?, corner(near, far)?])
    }

    /// The points of the ring about an axis, each with whether it is on the near side.
    pub(crate) fn ring(&self, projector: &Projector, axis: usize) -> Vec<(DVec2, bool)> {
        let radius = RING * self.grain(projector);
        let towards = projector.towards(self.pivot);
        let frame = across(self.axis(axis));
        (0..=SEGMENTS)
            .filter_map(|step| {
                let arm = arm(frame, TAU * step as f64 / SEGMENTS as f64);
                let is_near = arm.dot(towards) < 0.05;
                projector.project(self.pivot + radius * arm).map(|at| (at, is_near))
            })
            .collect()
    }

    /// How well a handle can be dragged from here, 0…1: an axis seen end-on, or a plane seen edge-on, cannot.
    pub(crate) fn clearness(&self, projector: &Projector, handle: GizmoHandle) -> f64 {
        let towards = projector.towards(self.pivot);
        let clear = |sine: f64| ((sine - 0.12) / 0.15).clamp(0.0, 1.0);
        match handle {
            GizmoHandle::Move(axis) | GizmoHandle::Scale(axis) => {
                clear(towards.cross(self.axis(axis)).length())
            }
            GizmoHandle::MovePlane(axis) => clear(towards.dot(self.axis(axis)).abs()),
            GizmoHandle::MoveScreen
            | GizmoHandle::Turn(_)
            | GizmoHandle::TurnView
            | GizmoHandle::ScaleAll => 1.0,
        }
    }

    /// The handle at a place in the picture.
    pub(crate) fn handle_at(&self, projector: &Projector, at: DVec2) -> Option<GizmoHandle> {
        let center = projector.project(self.pivot)?;
        let from_center = center.distance(at);
        let middle = from_center <= CENTER + 1.0;
        let holds = |handle: &GizmoHandle| self.clearness(projector, *handle) > 0.3;
        match self.tool {
            Tool::Move if middle => Some(GizmoHandle::MoveScreen),
            Tool::Move => {
                let is_in =
                    |axis: &usize| self.square(projector, *axis).is_some_and(|square| is_inside(&square, at));
                let square = (0..3).filter(is_in).map(GizmoHandle::MovePlane).find(|handle| holds(handle));
                square.or_else(|| {
                    self.shaft_at(projector, at).map(GizmoHandle::Move).filter(|handle| holds(handle))
                })
            }
            Tool::Rotate => {
                let is_outer = (from_center - OUTER_RING).abs() <= REACH;
                self.ring_at(projector, at)
                    .map(GizmoHandle::Turn)
                    .or(is_outer.then_some(GizmoHandle::TurnView))
            }
            Tool::Scale if middle => Some(GizmoHandle::ScaleAll),
            Tool::Scale => {
                self.shaft_at(projector, at).map(GizmoHandle::Scale).filter(|handle| holds(handle))
            }
        }
    }

    /// The axis under a place.
    fn shaft_at(&self, projector: &Projector, at: DVec2) -> Option<usize> {
        let shafts = (0..3).filter_map(|axis| Some((axis, distance_to(self.shaft(projector, axis)?, at))));
        nearest(shafts, REACH)
    }

    /// The ring under a place; its far side cannot be dragged.
    fn ring_at(&self, projector: &Projector, at: DVec2) -> Option<usize> {
        let rings = (0..3).map(|axis| {
            let points = self.ring(projector, axis);
            let near = points.windows(2).filter_map(|pair| match pair {
                [(from, true), (to, true)] => Some(distance_to([*from, *to], at)),
                _ => None,
            });
            (axis, near.fold(f64::INFINITY, f64::min))
        });
        nearest(rings, REACH - 1.0)
    }
}

/// The unit vector at an angle in the plane of two others.
fn arm([first, second]: [DVec3; 2], radians: f64) -> DVec3 {
    radians.cos() * first + radians.sin() * second
}

/// Which of several things with their distances is the nearest, within `reach`.
fn nearest(distances: impl Iterator<Item = (usize, f64)>, reach: f64) -> Option<usize> {
    distances.filter(|near| near.1 <= reach).min_by(|a, b| a.1.total_cmp(&b.1)).map(|near| near.0)
}

/// Distance of a place from a segment.
pub(crate) fn distance_to([from, to]: [DVec2; 2], at: DVec2) -> f64 {
    let along = to - from;
    let share = ((at - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    // A segment of no length gives no number for the share.
    let foot = if share.is_nan() { from } else { from + share * along };
    foot.distance(at)
}

/// Whether a place is inside a convex quadrilateral.
fn is_inside(corners: &[DVec2; 4], at: DVec2) -> bool {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let turns: Vec<f64> = sides.map(|(from, to)| (*to - *from).perp_dot(at - *from)).collect();
    turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0)
}

#[cfg(test)]
mod tests;
