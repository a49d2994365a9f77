//! The drag of bodies, lights or the camera: the grabbed point stays under the pointer. Knows nothing of egui.

use glam::{DVec2, DVec3};

use super::gizmo::handle_drag::DragPrecision;
use super::gizmo::lines::{along_axis, on_level, on_plane};
use super::gizmo::steps;
use crate::base::projector::Projector;

/// A level plane seen at a smaller angle than this (its sine; 6°) runs away under the pointer.
const LEAST_SLOPE: f64 = 0.1;

/// How far things can be dragged towards the horizon, in distances at which the drag began.
const FARTHEST: f64 = 8.0;

/// The drag of bodies, lights or the camera by a grabbed point.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ItemDrag {
    /// The point that was grabbed.
    grabbed: DVec3,
    /// The place of the primary thing when it was taken: what snapping brings to the grid.
    lead: DVec3,
    /// The move before the present stage.
    before: DVec3,
    render_scene: DragStage,
}

/// A scene of a drag with one plane of motion.
#[derive(Clone, Debug, PartialEq)]
struct DragStage {
    plane: DragPlane,
    /// Where the pointer was at the beginning.
    from: DVec2,
}

/// The plane or line of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DragPlane {
    /// In the level plane.
    Level,
    /// Up and down.
    Upright,
    /// Parallel to the picture, where the level plane is seen edge-on.
    Facing,
}

impl ItemDrag {
    /// Takes the thing at `lead` by its point `grabbed`, with the pointer at `at`, perhaps to move it up and down.
    pub(crate) fn begin(
        grabbed: DVec3,
        lead: DVec3,
        projector: &Projector,
        at: DVec2,
        is_upright: bool,
    ) -> Self {
        let render_scene = DragStage { plane: plane(projector, at, is_upright), from: at };
        Self { grabbed, lead, before: DVec3::ZERO, render_scene }
    }

    /// The move from the beginning to the pointer at `at`; `None` when that place says nothing.
    pub(crate) fn to(
        &mut self,
        projector: &Projector,
        at: DVec2,
        is_upright: bool,
        precision: DragPrecision,
    ) -> Option<DVec3> {
        if is_upright != (self.render_scene.plane == DragPlane::Upright) {
            self.before =
                self.way(projector, at).map_or(self.before, |way| self.rounded(way, projector, precision));
            self.render_scene = DragStage { plane: plane(projector, at, is_upright), from: at };
        }
        Some(self.rounded(self.way(projector, at)?, projector, precision))
    }

    /// Rounds a move so that the components of the present stage reach round numbers.
    fn rounded(&self, way: DVec3, projector: &Projector, precision: DragPrecision) -> DVec3 {
        let fine = if precision.is_fine { 0.1 } else { 1.0 };
        let grain = fine * projector.meters_per_point(self.grabbed);
        let grid = if precision.snaps { steps::MOVE } else { steps::decimal_below(grain) };
        let moves = match self.render_scene.plane {
            DragPlane::Level => [true, false, true],
            DragPlane::Upright => [false, true, false],
            DragPlane::Facing => [true; 3],
        };
        steps::to_grid(way, self.lead, moves, grid)
    }

    /// The whole move, without rounding.
    fn way(&self, projector: &Projector, at: DVec2) -> Option<DVec3> {
        let start = self.grabbed + self.before;
        let [from, to] =
            [self.render_scene.from, at].map(|at| met(projector, at, start, self.render_scene.plane));
        let mut step = to? - from?;
        match self.render_scene.plane {
            DragPlane::Level => step.y = 0.0,
            DragPlane::Upright => step = DVec3::new(0.0, step.y, 0.0),
            DragPlane::Facing => {}
        }
        (self.before + step).is_finite().then_some(self.before + step)
    }
}

fn plane(projector: &Projector, at: DVec2, is_upright: bool) -> DragPlane {
    if is_upright {
        DragPlane::Upright
    } else if projector.ray(at).direction.y.abs() < LEAST_SLOPE {
        DragPlane::Facing
    } else {
        DragPlane::Level
    }
}

/// Where the pointer's ray meets the plane or line through `point` in which things move.
fn met(projector: &Projector, at: DVec2, point: DVec3, plane: DragPlane) -> Option<DVec3> {
    let ray = projector.ray(at);
    let [_, _, forward] = projector.axes();
    match plane {
        DragPlane::Level => on_level(&ray, point, FARTHEST * ray.origin.distance(point)),
        DragPlane::Facing => on_plane(&ray, point, -forward),
        DragPlane::Upright => match along_axis(&ray, point, DVec3::Y) {
            Some(up) if forward.y.abs() < 0.95 => Some(point + up * DVec3::Y),
            // From straight above, height has no direction in the picture; the pointer's own up stands for it.
            _ => Some(point - at.y * projector.meters_per_point(point) * DVec3::Y),
        },
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::Camera;

    use super::*;

    const SIZE: DVec2 = DVec2::new(800.0, 600.0);
    const FREE: DragPrecision = DragPrecision { snaps: false, is_fine: false };

    fn projector(position: [f64; 3]) -> Projector {
        Projector::new(&Camera { position: position.into(), target: DVec3::Y, ..Camera::default() }, SIZE)
    }

    #[test]
    fn the_grabbed_point_stays_under_the_pointer() {
        let projector = projector([0.0, 4.0, 8.0]);
        let grabbed = DVec3::new(0.3, 0.7, 0.4);
        let at = projector.project(grabbed).unwrap();
        let mut drag = ItemDrag::begin(grabbed, DVec3::ZERO, &projector, at, false);
        for to in [DVec2::new(100.0, 400.0), DVec2::new(700.0, 300.0), at] {
            let step = drag.to(&projector, to, false, FREE).unwrap();
            assert_eq!(step.y, 0.0);
            assert!((projector.project(grabbed + step).unwrap() - to).length() < 0.5);
        }
    }

    #[test]
    fn up_and_down_takes_over_where_the_level_way_ends() {
        let projector = projector([0.0, 4.0, 8.0]);
        let at = projector.project(DVec3::Y).unwrap();
        let mut drag = ItemDrag::begin(DVec3::Y, DVec3::Y, &projector, at, false);
        let aside = at + DVec2::new(50.0, 30.0);
        let level = drag.to(&projector, aside, false, FREE).unwrap();
        let turned = drag.to(&projector, aside, true, FREE).unwrap();
        assert!(turned.distance(level) < 0.01);
        let up = drag.to(&projector, aside - DVec2::new(0.0, 60.0), true, FREE).unwrap();
        assert!(up.y > 0.3 && (up.x - level.x).abs() < 0.01 && (up.z - level.z).abs() < 0.01);
        let high = aside - DVec2::new(0.0, 60.0);
        assert!(drag.to(&projector, high, false, FREE).unwrap().distance(up) < 0.01);
        let back = drag.to(&projector, high - DVec2::new(30.0, 0.0), false, FREE).unwrap();
        assert!((back.y - up.y).abs() < 1e-9 && back.x < up.x);
    }

    #[test]
    fn seen_from_the_ground_things_move_with_the_picture() {
        let projector = projector([0.0, 1.05, 8.0]);
        let at = projector.project(DVec3::Y).unwrap();
        let mut drag = ItemDrag::begin(DVec3::Y, DVec3::Y, &projector, at, false);
        assert_eq!(drag.render_scene.plane, DragPlane::Facing);
        let step = drag.to(&projector, at + DVec2::new(30.0, -40.0), false, FREE).unwrap();
        assert!(step.x > 0.0 && step.y > 0.0 && step.z.abs() < 0.02);
    }

    #[test]
    fn towards_the_horizon_nothing_flies_away() {
        let projector = projector([0.0, 2.5, 8.0]);
        let at = projector.project(DVec3::ZERO).unwrap();
        let mut drag = ItemDrag::begin(DVec3::ZERO, DVec3::ZERO, &projector, at, false);
        let mut last = 0.0;
        for y in (-2000..400).rev().step_by(10) {
            let step = drag.to(&projector, DVec2::new(400.0, f64::from(y)), false, FREE).unwrap();
            assert!(step.length() < 10.0 * 9.0, "{step}");
            // Ever farther away, up to the limit and no way back.
            assert!(step.z <= last + 1e-9, "{y}: {step}");
            last = step.z;
        }
    }

    #[test]
    fn snapping_brings_the_thing_itself_to_the_grid() {
        let projector = projector([0.0, 4.0, 8.0]);
        let (grabbed, lead) = (DVec3::new(0.3, 0.7, 0.4), DVec3::new(0.123, 0.456, 0.789));
        let at = projector.project(grabbed).unwrap();
        let mut drag = ItemDrag::begin(grabbed, lead, &projector, at, false);
        let snaps = DragPrecision { snaps: true, is_fine: false };
        let placed = lead + drag.to(&projector, at + DVec2::new(111.0, 37.0), false, snaps).unwrap();
        for part in [placed.x, placed.z] {
            assert!((10.0 * part - (10.0 * part).round()).abs() < 1e-9, "{placed}");
        }
        assert_eq!(placed.y, lead.y);
    }
}
