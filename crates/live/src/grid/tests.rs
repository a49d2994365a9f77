//! The grid compared with the places where its lines must lie.

use catoptric_scene::{Body, Camera, Placement, Projection, Scene, Shape};
use catoptric_tracer::Stage;
use glam::{DVec2, DVec3};

use super::{GridMeasures, trace};
use crate::frame::{GridKind, GridLine};
use crate::request::GridSpec;

const SIZE: DVec2 = DVec2::new(1280.0, 720.0);

fn body(shape: Shape, position: DVec3) -> Body {
    Body { shape, placement: Placement::at(position), ..Body::default() }
}

fn grid(scene: &Scene) -> Vec<GridLine> {
    let stage = Stage::prepare(scene).unwrap();
    trace(GridSpec::default(), &scene.camera, stage.camera(), &stage, SIZE)
}

/// The place on the ground that a pixel shows.
fn ground(camera: &Camera, at: DVec2) -> DVec3 {
    let stage = Stage::prepare(&Scene { camera: *camera, ..Scene::default() }).unwrap();
    let ray = stage.camera().ray(at, SIZE);
    let (origin, direction) = (stage.world_from_render(ray.origin), ray.direction.as_dvec3());
    origin - origin.y / direction.y * direction
}

#[test]
fn lines_lie_on_multiples_of_the_step() {
    for projection in [Projection::default(), Projection::Parallel { height: 5.0 }] {
        let camera = Camera { projection, ..Camera::default() };
        let lines = grid(&Scene { camera, ..Scene::default() });
        assert!(lines.len() > 20);
        let step = GridMeasures::new(&camera).unwrap().step;
        assert_eq!(step, 1.0);
        for line in &lines {
            assert!(line.strength > 0.0 && line.strength <= 1.0);
            let [from, to] = [line.from, line.to].map(|end| {
                let end = end.as_dvec2();
                assert!(end.cmpge(DVec2::splat(-0.01)).all() && end.cmple(SIZE + 0.01).all(), "{end}");
                ground(&camera, end)
            });
            let middle = ground(&camera, 0.5 * (line.from + line.to).as_dvec2());
            for point in [from, to, middle] {
                let [x, z] = [point.x, point.z].map(|along| (along - along.round()).abs());
                let off = match line.kind {
                    GridKind::AxisX => point.z.abs(),
                    GridKind::AxisZ => point.x.abs(),
                    GridKind::Minor | GridKind::Major => x.min(z),
                };
                // Far away a pixel is wide.
                assert!(off < 2e-3 * point.length().max(1.0), "{line:?} is {off} m off");
            }
        }
        for kind in [GridKind::AxisX, GridKind::AxisZ, GridKind::Minor] {
            assert!(lines.iter().any(|line| line.kind == kind), "{kind:?}");
        }
    }
}

#[test]
fn bodies_hide_what_is_behind_them_and_a_floor_hides_nothing() {
    let open = Scene::default();
    let length = |lines: &[GridLine]| -> f32 { lines.iter().map(|line| line.from.distance(line.to)).sum() };
    let floor = Scene { bodies: [body(Shape::Plane, DVec3::ZERO)].into(), ..Scene::default() };
    assert_eq!(grid(&floor), grid(&open));
    let ball = Scene { bodies: [body(Shape::SPHERE, DVec3::new(0.0, 1.0, 0.0))].into(), ..Scene::default() };
    let cut = grid(&ball);
    assert!(length(&cut) < 0.97 * length(&grid(&open)));
    let stage = Stage::prepare(&ball).unwrap();
    for line in &cut {
        for share in [0.02, 0.5, 0.98] {
            let at = line.from.lerp(line.to, share).as_dvec2();
            let ray = stage.camera().ray(at, SIZE);
            if let Some(hit) = stage.nearest(&ray) {
                let ground = ground(&ball.camera, at).distance(stage.world_from_render(ray.origin));
                // A pixel at the ball's rim may be off.
                let rim = (0..8).any(|k| {
                    let turn = f64::from(k) * std::f64::consts::FRAC_PI_4;
                    let beside = at + 2.0 * DVec2::from_angle(turn);
                    stage.nearest(&stage.camera().ray(beside, SIZE)).is_none()
                });
                assert!(rim || f64::from(hit.hit.t) > 0.99 * ground, "{at} is behind the ball");
            }
        }
    }
    let wall = body(Shape::Cube { size: DVec3::new(99.0, 99.0, 0.1) }, DVec3::new(0.0, 0.0, 7.0));
    assert_eq!(grid(&Scene { bodies: [wall].into(), ..Scene::default() }), []);
}

#[test]
fn the_step_follows_the_distance_without_jumps() {
    let at = |distance: f64| {
        let camera =
            Camera { position: DVec3::new(0.0, 0.0, distance), target: DVec3::ZERO, ..Camera::default() };
        GridMeasures::new(&camera).unwrap()
    };
    assert_eq!(
        [0.5, 5.0, 39.0, 41.0, 5000.0].map(|distance| at(distance).step),
        [0.1, 1.0, 1.0, 10.0, 1000.0]
    );
    let (before, after) = (at(39.999), at(40.001));
    for number in [1, 2, 10, 30] {
        let [one, other] = [before.strength(10 * number), after.strength(number)];
        assert!((one - other).abs() < 1e-3, "{number}: {one} becomes {other}");
        assert!((before.reach(10 * number) / after.reach(number) - 1.0).abs() < 1e-3);
    }
    assert!(before.strength(1) < 1e-3);
}

#[test]
fn what_is_not_wanted_is_not_there_and_odd_cameras_have_no_grid() {
    let stage = Stage::prepare(&Scene::default()).unwrap();
    let of = |spec| trace(spec, &Camera::default(), stage.camera(), &stage, SIZE);
    assert_eq!(of(GridSpec { lines: false, axes: false }), []);
    let is_axis = |line: &GridLine| matches!(line.kind, GridKind::AxisX | GridKind::AxisZ);
    assert!(of(GridSpec { lines: false, axes: true }).iter().all(is_axis));
    assert!(!of(GridSpec { lines: true, axes: false }).iter().any(is_axis));
    for position in [DVec3::ZERO, DVec3::NAN, DVec3::splat(1e300), DVec3::new(0.0, 0.0, 1e-300)] {
        let camera = Camera { position, target: DVec3::ZERO, ..Camera::default() };
        let view = stage.camera_for(&camera);
        assert_eq!(trace(GridSpec::default(), &camera, &view, &stage, SIZE), []);
    }
    // On the ground itself, and looking straight down.
    for position in [DVec3::X, DVec3::new(0.0, 5.0, 0.0)] {
        let camera = Camera { position, target: DVec3::ZERO, ..Camera::default() };
        trace(GridSpec::default(), &camera, &stage.camera_for(&camera), &stage, SIZE);
    }
}
