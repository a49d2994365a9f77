//! Outlines compared with projections of the bodies.

use catoptric_scene::{Anchor, Body, Camera, Placement, Projection, Scene, Shape};
use catoptric_tracer::Stage;
use glam::{DVec2, DVec3};

use super::OutlineTracer;
use super::area::Area;
use crate::frame::Polyline;

const SIZE: DVec2 = DVec2::new(1280.0, 720.0);

/// How far a line may be from its true place, pixels.
const TOLERANCE: f64 = 0.2;

fn body(shape: Shape, position: DVec3) -> Body {
    Body { shape, placement: Placement::at(position), ..Body::default() }
}

fn turned(shape: Shape, position: DVec3, rotation_degrees: DVec3) -> Body {
    let placement = Placement { anchor: Anchor::Frame { position, rotation_degrees }, scale: DVec3::ONE };
    Body { shape, placement, ..Body::default() }
}

fn scene(bodies: Vec<Body>) -> Scene {
    Scene { bodies: bodies.into(), ..Scene::default() }
}

/// The stage of one body, and where it can be in a view of this size.
pub(super) fn one_body(shape: Shape, position: DVec3, degrees: DVec3, size: DVec2) -> (Stage, Area) {
    let scene = scene(vec![turned(shape, position, degrees)]);
    let stage = Stage::prepare(&scene).unwrap();
    let area = Area::of_bodies(scene.bodies.iter(), stage.camera(), size).unwrap();
    (stage, area)
}

fn outlines(scene: &Scene, bodies: &[usize]) -> Vec<Polyline> {
    let stage = Stage::prepare(scene).unwrap();
    OutlineTracer::new(scene, &stage, bodies).trace(scene, &stage, stage.camera(), SIZE)
}

/// The distance of a point from a line.
fn distance(point: DVec2, line: &[DVec2], closed: bool) -> f64 {
    let pieces = if closed { line.len() } else { line.len() - 1 };
    let following = line.iter().cycle().skip(1);
    let distance = |(&from, &to): (&DVec2, &DVec2)| {
        let way = to - from;
        let share = ((point - from).dot(way) / way.length_squared().max(1e-12)).clamp(0.0, 1.0);
        point.distance(from + share * way)
    };
    line.iter().zip(following).take(pieces).map(distance).fold(f64::INFINITY, f64::min)
}

fn points(line: &Polyline) -> Vec<DVec2> {
    line.points.iter().map(|point| point.as_dvec2()).collect()
}

/// Holds a closed outline against the true one, each way around.
fn assert_same(found: &[Polyline], expected: &[DVec2]) {
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].closed && !found[0].hidden);
    let found = points(&found[0]);
    for &point in &found {
        let off = distance(point, expected, true);
        assert!(off < TOLERANCE, "{point} is {off} px off");
    }
    for &point in expected {
        let off = distance(point, &found, true);
        assert!(off < TOLERANCE, "{point} is missed by {off} px");
    }
}

/// The outline of a sphere: where a cone around it meets the window.
fn sphere_outline(scene: &Scene, center: DVec3, radius: f64) -> Vec<DVec2> {
    let stage = Stage::prepare(scene).unwrap();
    let position = scene.camera.position;
    let offset = center - position;
    let axis = offset.normalize();
    let one = axis.any_orthonormal_vector();
    let other = axis.cross(one);
    let points = (0..2000).map(|k| f64::from(k) / 2000.0 * std::f64::consts::TAU).map(|turn| {
        let across = turn.cos() * one + turn.sin() * other;
        let point = match scene.camera.projection {
            Projection::Perspective { .. } => {
                let sin = radius / offset.length();
                position + 100.0 * ((1.0 - sin * sin).sqrt() * axis + sin * across)
            }
            Projection::Parallel { .. } => {
                let [right, up, _] = stage.camera().axes();
                center + radius * (turn.cos() * right + turn.sin() * up)
            }
        };
        stage.camera().project(point, SIZE).unwrap().0
    });
    points.collect()
}

#[test]
fn the_outline_of_a_sphere_is_the_ellipse_of_its_cone() {
    for (center, radius) in [
        (DVec3::new(0.0, 1.0, 0.0), 1.0),
        (DVec3::new(2.2, 0.3, 1.0), 0.5),
        (DVec3::new(-2.0, 1.5, -3.0), 0.05),
        (DVec3::new(0.5, 1.5, 0.0), 0.015),
    ] {
        for projection in [Projection::default(), Projection::Parallel { height: 5.0 }] {
            let mut scene = scene(vec![body(Shape::Sphere { radius }, center)]);
            scene.camera.projection = projection;
            let expected = sphere_outline(&scene, center, radius);
            assert_same(&outlines(&scene, &[0]), &expected);
        }
    }
}

/// The convex hull by brute force: the edges with all points on one side.
fn hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut at = *points.iter().min_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
    let mut hull = Vec::new();
    while !hull.contains(&at) {
        hull.push(at);
        at = *points
            .iter()
            .filter(|&&to| to != at)
            .find(|&&to| points.iter().all(|&point| (to - at).perp_dot(point - at) > -1e-9))
            .unwrap();
    }
    hull
}

#[test]
fn the_outline_of_a_box_is_the_hull_of_its_corners() {
    for (size, rotation) in [
        (DVec3::ONE, DVec3::ZERO),
        (DVec3::new(2.0, 1.0, 0.5), DVec3::new(20.0, 35.0, 50.0)),
        // Long and thin, across the view.
        (DVec3::new(4.0, 0.02, 0.02), DVec3::new(0.0, 20.0, 33.0)),
    ] {
        let center = DVec3::new(0.3, 1.1, 0.0);
        let scene = scene(vec![turned(Shape::Cube { size }, center, rotation)]);
        let stage = Stage::prepare(&scene).unwrap();
        let frame = scene.bodies[0].placement.world_from_body();
        let corners: Vec<DVec2> = (0..8)
            .map(|k| {
                let sign = |axis: usize| if k >> axis & 1 == 0 { -0.5 } else { 0.5 };
                let corner = frame.transform_point3(size * DVec3::new(sign(0), sign(1), sign(2)));
                stage.camera().project(corner, SIZE).unwrap().0
            })
            .collect();
        assert_same(&outlines(&scene, &[0]), &hull(&corners));
    }
}

#[test]
fn a_body_three_pixels_wide_has_an_outline() {
    // 720 pixels show 2 · 8 · tan 13.5° meters.
    let radius = 1.5 * (2.0 * 8.1 * 13.5_f64.to_radians().tan()) / 720.0;
    let scene = scene(vec![body(Shape::Sphere { radius }, DVec3::new(0.0, 1.0, 0.0))]);
    let found = outlines(&scene, &[0]);
    assert_eq!(found.len(), 1);
    assert!(found[0].closed && found[0].points.len() >= 8);
}

#[test]
fn the_apex_of_a_cone_is_reached() {
    let scene = scene(vec![body(Shape::Cone { radius: 0.3, top_radius: 0.0, height: 2.0 }, DVec3::ZERO)]);
    let stage = Stage::prepare(&scene).unwrap();
    let apex = stage.camera().project(DVec3::new(0.0, 2.0, 0.0), SIZE).unwrap().0;
    let found = outlines(&scene, &[0]);
    assert_eq!(found.len(), 1);
    let off = distance(apex, &points(&found[0]), true);
    // In the last pixel the tip is a quarter of a pixel wide.
    assert!(off < 1.0, "{off}");
}

#[test]
fn a_plane_has_its_horizon_and_is_cut_by_the_view() {
    let mut scene = scene(vec![body(Shape::Plane, DVec3::ZERO)]);
    scene.camera.target = DVec3::new(0.0, 2.0, 0.0);
    let found = outlines(&scene, &[0]);
    assert_eq!(found.len(), 1);
    assert!(!found[0].closed);
    let stage = Stage::prepare(&scene).unwrap();
    let horizon = stage.camera().project(DVec3::new(0.0, 2.2, -1e6), SIZE).unwrap().0.y;
    for point in points(&found[0]) {
        assert!((point.y - horizon).abs() < TOLERANCE, "{point}, not {horizon}");
    }
    let ends = [found[0].points[0].x, found[0].points[found[0].points.len() - 1].x];
    assert_eq!(ends.map(f32::abs).into_iter().fold(0.0, f32::max), 1280.0);
}

#[test]
fn what_the_view_cuts_stays_open_and_what_it_does_not_show_has_no_outline() {
    let radius = 1.0;
    let cut = outlines(&scene(vec![body(Shape::Sphere { radius }, DVec3::new(3.3, 1.0, 0.0))]), &[0]);
    assert_eq!((cut.len(), cut[0].closed), (1, false));
    for position in [DVec3::new(30.0, 1.0, 0.0), DVec3::new(0.0, 1.0, 30.0)] {
        assert_eq!(outlines(&scene(vec![body(Shape::Sphere { radius }, position)]), &[0]), []);
    }
    // The eye is within.
    let around = Scene::default().camera.position;
    assert_eq!(outlines(&scene(vec![body(Shape::Sphere { radius }, around)]), &[0]), []);
    // Half behind the eye.
    let beside = turned(
        Shape::Cylinder { radius: 0.3, height: 40.0 },
        DVec3::new(0.0, 1.0, 20.0),
        DVec3::new(-90.0, 0.0, 0.0),
    );
    assert_eq!(outlines(&scene(vec![beside]), &[0]).iter().filter(|line| !line.closed).count(), 1);
    // There is no such body.
    assert_eq!(outlines(&scene(Vec::new()), &[0, 5]), []);
}

#[test]
fn parts_behind_other_bodies_are_hidden() {
    let behind = body(Shape::Sphere { radius: 1.0 }, DVec3::new(0.0, 1.0, -3.0));
    let floor = body(Shape::Plane, DVec3::ZERO);
    // Covers what is to the right of x = 0.
    let screen = body(Shape::Cube { size: DVec3::new(4.0, 4.0, 0.1) }, DVec3::new(2.0, 2.0, 1.0));
    let scene = scene(vec![behind, floor, screen]);
    let found = outlines(&scene, &[0]);
    let center =
        outlines(&Scene { bodies: scene.bodies.iter().take(1).cloned().collect(), ..scene.clone() }, &[0]);
    assert_eq!(center.len(), 1);
    assert_eq!(found.iter().filter(|line| line.hidden).count(), 1);
    assert_eq!(found.iter().filter(|line| !line.hidden).count(), 1);
    let stage = Stage::prepare(&scene).unwrap();
    let edge = stage.camera().project(DVec3::new(0.0, 1.0, 1.0), SIZE).unwrap().0.x;
    for line in &found {
        assert_eq!(line.body, Some(0));
        for point in points(line) {
            let right = point.x - edge;
            assert!(if line.hidden { right > -4.0 } else { right < 4.0 }, "{right}: {}", line.hidden);
        }
        let ends = [line.points[0], line.points[line.points.len() - 1]];
        assert!(ends.iter().all(|end| (f64::from(end.x) - edge).abs() < 4.0));
    }
    // The one in front is not hidden, nor is what stands on a floor hidden by it.
    assert!(outlines(&scene, &[2]).iter().all(|line| !line.hidden));
    let cylinder = body(Shape::Cylinder { radius: 0.5, height: 1.0 }, DVec3::ZERO);
    let standing = Scene { bodies: [cylinder, body(Shape::Plane, DVec3::ZERO)].into(), ..scene.clone() };
    let found = outlines(&standing, &[0]);
    let visible: usize = found.iter().filter(|line| !line.hidden).map(|line| line.points.len()).sum();
    let hidden: usize = found.iter().filter(|line| line.hidden).map(|line| line.points.len()).sum();
    assert!(visible > 20 * hidden, "{visible} points are visible, {hidden} hidden");
    // All of it.
    let front = body(Shape::Cube { size: DVec3::new(9.0, 9.0, 0.1) }, DVec3::new(0.0, 0.0, 2.0));
    let covered = Scene { bodies: [scene.bodies[0].clone(), front].into(), ..scene };
    let found = outlines(&covered, &[0]);
    assert!(found.len() == 1 && found[0].hidden && found[0].closed);
}

#[test]
fn many_bodies_have_one_outline() {
    let bodies: Vec<Body> =
        (0..40).map(|k| body(Shape::SPHERE, DVec3::new(0.05 * f64::from(k) - 1.0, 1.0, -4.0))).collect();
    let found = outlines(&scene(bodies), &(0..40).collect::<Vec<_>>());
    assert_eq!(found.len(), 1);
    assert!(found[0].closed && found[0].body.is_none());
}

#[test]
fn no_camera_and_no_body_is_too_odd() {
    for position in [DVec3::ZERO, DVec3::splat(1e9), DVec3::new(0.0, 1.0, 0.0)] {
        for scale in [1e-9, 1.0, 1e9] {
            let mut odd = body(Shape::CONE, DVec3::ZERO);
            odd.placement.scale = DVec3::splat(scale);
            let mut scene = scene(vec![odd, body(Shape::Plane, DVec3::ZERO)]);
            scene.camera = Camera { position, ..Camera::default() };
            let stage = Stage::prepare(&scene).unwrap();
            for size in [DVec2::ONE, DVec2::new(1.0, 500.0), DVec2::new(3000.0, 2.0)] {
                OutlineTracer::new(&scene, &stage, &[0, 1]).trace(&scene, &stage, stage.camera(), size);
            }
        }
    }
}
