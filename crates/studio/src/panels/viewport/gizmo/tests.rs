use catoptric_scene::{Camera, Projection};

use super::change::GizmoChange;
use super::handle_drag::{DragAmount, DragPrecision, HandleDrag};
use super::*;

const SIZE: DVec2 = DVec2::new(800.0, 600.0);
const SNAPS: DragPrecision = DragPrecision { snaps: true, is_fine: false };
const FREE: DragPrecision = DragPrecision { snaps: false, is_fine: false };

fn camera(position: [f64; 3]) -> Camera {
    Camera { position: position.into(), target: DVec3::ZERO, ..Camera::default() }
}

fn slanted() -> Projector {
    Projector::new(&camera([4.0, 3.0, 6.0]), SIZE)
}

fn gizmo(tool: Tool) -> Gizmo {
    Gizmo { tool, pivot: DVec3::ZERO, axes: DVec3::AXES, is_local: false, lead: DVec3::ZERO }
}

/// All handles of all tools.
fn handles() -> impl Iterator<Item = (Tool, GizmoHandle)> {
    let of_axis = |axis| {
        [
            (Tool::Move, GizmoHandle::Move(axis)),
            (Tool::Move, GizmoHandle::MovePlane(axis)),
            (Tool::Rotate, GizmoHandle::Turn(axis)),
            (Tool::Scale, GizmoHandle::Scale(axis)),
        ]
    };
    let whole = [
        (Tool::Move, GizmoHandle::MoveScreen),
        (Tool::Rotate, GizmoHandle::TurnView),
        (Tool::Scale, GizmoHandle::ScaleAll),
    ];
    (0..3).flat_map(of_axis).chain(whole)
}

/// A place where a handle is.
fn place_of(gizmo: &Gizmo, projector: &Projector, handle: GizmoHandle) -> DVec2 {
    let center = projector.project(gizmo.pivot).unwrap();
    match handle {
        GizmoHandle::Move(axis) | GizmoHandle::Scale(axis) => gizmo.shaft(projector, axis).unwrap()[1],
        GizmoHandle::MovePlane(axis) => gizmo.square(projector, axis).unwrap().iter().sum::<DVec2>() / 4.0,
        GizmoHandle::MoveScreen | GizmoHandle::ScaleAll => center,
        GizmoHandle::Turn(axis) => {
            // Where no other ring is near.
            let ring = gizmo.ring(projector, axis);
            let is_free = |at: DVec2| {
                (0..3)
                    .filter(|other| *other != axis)
                    .all(|other| gizmo.ring(projector, other).iter().all(|point| point.0.distance(at) > 12.0))
            };
            ring.iter().find(|(at, is_near)| *is_near && is_free(*at)).unwrap().0
        }
        GizmoHandle::TurnView => center + DVec2::from_angle(0.3) * OUTER_RING,
    }
}

#[test]
fn every_handle_is_found_where_it_is() {
    let projector = slanted();
    for (tool, handle) in handles() {
        let gizmo = gizmo(tool);
        assert_eq!(gizmo.handle_at(&projector, place_of(&gizmo, &projector, handle)), Some(handle));
        assert_eq!(gizmo.handle_at(&projector, DVec2::new(30.0, 30.0)), None);
    }
}

#[test]
fn it_has_one_size_at_every_distance() {
    for distance in [1.0, 10.0, 1e4] {
        let projector = Projector::new(&camera([distance, 0.0, 0.0]), SIZE);
        let [_, end] = gizmo(Tool::Move).shaft(&projector, 1).unwrap();
        assert!((end - DVec2::new(400.0, 300.0 - LENGTH)).length() < 1e-6);
    }
}

#[test]
fn pulling_an_axis_moves_along_it_alone() {
    let projector = slanted();
    for axis in 0..3 {
        let gizmo = gizmo(Tool::Move);
        let at = place_of(&gizmo, &projector, GizmoHandle::Move(axis));
        let mut drag = HandleDrag::begin(gizmo, GizmoHandle::Move(axis), &projector, at).unwrap();
        // From the axis' end to the place of a point 1.5 m farther along it.
        let end = LENGTH * gizmo.grain(&projector);
        let to = projector.project((end + 1.5) * DVec3::AXES[axis]).unwrap();
        let Some((GizmoChange::Move(step), DragAmount::Meters(shown))) = drag.to(&projector, to, FREE) else {
            panic!()
        };
        assert!(step.distance(1.5 * DVec3::AXES[axis]) < 1e-9, "{step}");
        assert_eq!(shown.iter().flatten().count(), 1);
        let Some((GizmoChange::Move(step), _)) = drag.to(&projector, at + DVec2::new(23.0, 17.0), FREE)
        else {
            panic!()
        };
        for other in (0..3).filter(|other| *other != axis) {
            assert_eq!(step[other], 0.0);
        }
    }
}

#[test]
fn snapping_goes_to_round_places_of_the_world_and_round_steps_of_local_axes() {
    let projector = slanted();
    let world = Gizmo { lead: DVec3::new(0.234, 0.0, 0.0), ..gizmo(Tool::Move) };
    let local = Gizmo { is_local: true, ..world };
    for (gizmo, expected) in [(world, 0.566), (local, 0.6)] {
        let at = place_of(&gizmo, &projector, GizmoHandle::Move(0));
        let to = projector.project((LENGTH * gizmo.grain(&projector) + 0.58) * DVec3::X).unwrap();
        let mut drag = HandleDrag::begin(gizmo, GizmoHandle::Move(0), &projector, at).unwrap();
        let Some((GizmoChange::Move(step), _)) = drag.to(&projector, to, SNAPS) else { panic!() };
        assert!(step.distance(expected * DVec3::X) < 1e-12, "{step}");
    }
}

#[test]
fn a_square_moves_in_its_plane_and_the_center_along_the_picture() {
    let projector = slanted();
    let gizmo = gizmo(Tool::Move);
    let at = place_of(&gizmo, &projector, GizmoHandle::MovePlane(1));
    let mut drag = HandleDrag::begin(gizmo, GizmoHandle::MovePlane(1), &projector, at).unwrap();
    let Some((GizmoChange::Move(step), _)) = drag.to(&projector, at + DVec2::new(40.0, -20.0), FREE) else {
        panic!()
    };
    assert!(step.y == 0.0 && step.x != 0.0 && step.z != 0.0);
    let center = projector.project(DVec3::ZERO).unwrap();
    let mut drag = HandleDrag::begin(gizmo, GizmoHandle::MoveScreen, &projector, center).unwrap();
    let Some((GizmoChange::Move(step), _)) = drag.to(&projector, center + DVec2::new(40.0, -20.0), FREE)
    else {
        panic!()
    };
    let [_, _, forward] = projector.axes();
    assert!(step.dot(forward).abs() < 0.01 * step.length());
    let arrived = projector.project(step).unwrap();
    assert!((arrived - center - DVec2::new(40.0, -20.0)).length() < 0.5);
}

#[test]
fn a_ring_turns_by_the_angle_that_the_pointer_goes_about_it() {
    // From above, the ring about Y is a circle.
    let above = Camera { up: DVec3::NEG_Z, ..camera([0.0, 8.0, 0.0]) };
    let projector = Projector::new(&above, SIZE);
    let gizmo = gizmo(Tool::Rotate);
    let center = projector.project(DVec3::ZERO).unwrap();
    // Counterclockwise in the picture: the pointer's y goes down.
    let at = |degrees: f64| center + RING * DVec2::from_angle(-degrees.to_radians());
    let mut drag = HandleDrag::begin(gizmo, GizmoHandle::Turn(1), &projector, at(10.0)).unwrap();
    let mut last = 0.0;
    for degrees in (10..=800).step_by(5) {
        let Some((GizmoChange::Turn { axis, .. }, DragAmount::Degrees(turned))) =
            drag.to(&projector, at(f64::from(degrees)), FREE)
        else {
            panic!()
        };
        assert_eq!(axis, DVec3::Y);
        last = turned;
    }
    assert!((last - 790.0).abs() < 0.1, "{last}");
    let Some((_, DragAmount::Degrees(turned))) = drag.to(&projector, at(803.0), SNAPS) else { panic!() };
    assert_eq!(turned, 795.0);
    // The outer ring turns about the direction towards the viewer, the same way from here.
    let mut drag = HandleDrag::begin(gizmo, GizmoHandle::TurnView, &projector, at(0.0)).unwrap();
    let Some((GizmoChange::Turn { axis, radians, .. }, _)) = drag.to(&projector, at(90.0), FREE) else {
        panic!()
    };
    assert!(axis.distance(DVec3::Y) < 1e-12 && (radians.to_degrees() - 90.0).abs() < 1e-9);
}

#[test]
fn a_ring_seen_edge_on_turns_with_the_pointer() {
    // The ring about Y is a level line; its near point goes to the right in a turn about +Y.
    let projector = Projector::new(&camera([0.0, 0.0, 8.0]), SIZE);
    let gizmo = gizmo(Tool::Rotate);
    let center = projector.project(DVec3::ZERO).unwrap();
    let mut drag = HandleDrag::begin(gizmo, GizmoHandle::Turn(1), &projector, center).unwrap();
    let Some((_, DragAmount::Degrees(turned))) = drag.to(&projector, center + DVec2::new(36.0, 5.0), FREE)
    else {
        panic!()
    };
    // Half the radius is half a radian, but for the perspective.
    assert!((turned - 0.5_f64.to_degrees()).abs() < 3.0, "{turned}");
}

#[test]
fn scaling_follows_the_cube_and_never_reaches_zero() {
    let projector = slanted();
    let gizmo = gizmo(Tool::Scale);
    let at = place_of(&gizmo, &projector, GizmoHandle::Scale(2));
    let twice = projector.project(2.0 * LENGTH * gizmo.grain(&projector) * DVec3::Z).unwrap();
    let mut drag = HandleDrag::begin(gizmo, GizmoHandle::Scale(2), &projector, at).unwrap();
    let Some((GizmoChange::Scale { factors, .. }, _)) = drag.to(&projector, twice, FREE) else { panic!() };
    assert_eq!(factors, DVec3::new(1.0, 1.0, 2.0));
    let behind = projector.project(-LENGTH * gizmo.grain(&projector) * DVec3::Z).unwrap();
    let Some((_, DragAmount::Factor(factor))) = drag.to(&projector, behind, FREE) else { panic!() };
    assert_eq!(factor, 0.01);
    let center = place_of(&gizmo, &projector, GizmoHandle::ScaleAll);
    let mut drag = HandleDrag::begin(gizmo, GizmoHandle::ScaleAll, &projector, center).unwrap();
    let Some((GizmoChange::Scale { factors, .. }, _)) =
        drag.to(&projector, center + DVec2::new(120.0, 0.0), FREE)
    else {
        panic!()
    };
    assert_eq!(factors, DVec3::splat(2.0));
}

#[test]
fn no_view_and_no_place_gives_a_number_that_is_none() {
    let straight = [
        [8.0, 0.0, 0.0],
        [0.0, 8.0, 0.0],
        [0.0, 0.0, 8.0],
        [1e-7, 8.0, 0.0],
        [0.0, 0.0, 1e-3],
        [1e6, 1.0, 0.0],
    ];
    let projections = [Projection::default(), Projection::Parallel { height: 4.0 }];
    let places =
        [DVec2::ZERO, SIZE, 0.5 * SIZE, 0.5 * SIZE + DVec2::Y, DVec2::splat(-1e5), DVec2::splat(1e7)];
    for (position, projection) in
        straight.into_iter().flat_map(|at| projections.map(|projection| (at, projection)))
    {
        let projector = Projector::new(&Camera { projection, ..camera(position) }, SIZE);
        for (tool, handle) in handles() {
            for start in places {
                let gizmo = gizmo(tool);
                let _ = gizmo.handle_at(&projector, start);
                let Some(mut drag) = HandleDrag::begin(gizmo, handle, &projector, start) else { continue };
                for at in places {
                    let Some((change, _)) = drag.to(&projector, at, FREE) else { continue };
                    let moved = change.point(DVec3::new(1.0, 2.0, 3.0));
                    assert!(moved.is_finite(), "{handle:?} from {position:?}: {change:?}");
                    let _ = drag.swept(&projector);
                }
            }
        }
    }
}

#[test]
fn an_axis_seen_end_on_is_not_taken() {
    let projector = Projector::new(&camera([8.0, 0.0, 0.0]), SIZE);
    let gizmo = gizmo(Tool::Move);
    assert!(
        gizmo.clearness(&projector, GizmoHandle::Move(0)) == 0.0
            && gizmo.clearness(&projector, GizmoHandle::Move(1)) == 1.0
    );
    assert!(
        gizmo.clearness(&projector, GizmoHandle::MovePlane(1)) == 0.0
            && gizmo.clearness(&projector, GizmoHandle::MovePlane(0)) == 1.0
    );
}
