use proptest::prelude::*;

use super::*;

fn looking(position: DVec3) -> Camera {
    Camera { position, target: DVec3::Y, up: DVec3::Y * 2.0, ..Camera::default() }
}

fn assert_near(a: DVec3, b: DVec3) {
    assert!((a - b).length() < 1e-9, "{a} is not {b}");
}

/// Where a point is in the picture: to the right and up, in tangents (perspective) or meters (parallel).
fn seen(camera: &Camera, point: DVec3) -> [f64; 2] {
    let local = axes(camera).transpose() * (point - camera.position);
    match camera.projection {
        Projection::Perspective { fov_degrees } => {
            let height = local.z * (0.5 * fov_degrees).to_radians().tan();
            [local.x / height, local.y / height]
        }
        Projection::Parallel { height } => [2.0 * local.x / height, 2.0 * local.y / height],
    }
}

#[test]
fn orbits_turn_about_the_target() {
    let camera = looking(DVec3::new(0.0, 1.0, 5.0));
    let right = orbit(&camera, FRAC_PI_2, 0.0);
    assert_near(right.position, DVec3::new(5.0, 1.0, 0.0));
    assert_eq!((right.target, right.up), (camera.target, camera.up));
    let above = orbit(&camera, 0.0, std::f64::consts::FRAC_PI_4);
    assert_near(above.position, DVec3::new(0.0, 1.0 + 12.5f64.sqrt(), 12.5f64.sqrt()));
    // Over the pole is not reached from either side.
    for pitch in [3.0, -3.0] {
        let pole = orbit(&camera, 0.0, pitch);
        assert!(pole.position.z > 0.0 && (pole.position.y - 1.0).abs() > 4.99, "{}", pole.position);
        assert_near(orbit(&pole, 0.0, pitch).position, pole.position);
    }
    assert_eq!(orbit(&camera, 0.0, 0.0), camera);
}

#[test]
fn views_along_the_axes_orbit_about_the_vertical_again() {
    let camera = looking(DVec3::new(0.0, 1.0, 5.0));
    let top = look_along(&camera, ViewSide::Top, DVec3::X);
    assert_eq!((top.position, top.target, top.up), (DVec3::new(1.0, 5.0, 0.0), DVec3::X, DVec3::NEG_Z));
    let front = orbit(&top, 0.0, -FRAC_PI_2);
    assert_near(front.position, DVec3::new(1.0, 0.0, 5.0));
    assert_eq!(front.up, DVec3::Y);
    // What is up in the picture stays up at the start.
    let a_little = orbit(&top, 0.0, -0.01);
    assert!(axes(&a_little).y_axis.dot(DVec3::NEG_Z) > 0.99);
    let bottom = orbit(&look_along(&camera, ViewSide::Bottom, DVec3::X), 0.0, 0.01);
    assert!(axes(&bottom).y_axis.dot(DVec3::Z) > 0.99 && bottom.position.y < 0.0);
    let spun = orbit(&top, FRAC_PI_2, 0.0);
    assert!(axes(&spun).y_axis.dot(DVec3::NEG_X) > 0.99);
    for (axis, right) in [
        (ViewSide::Front, DVec3::X),
        (ViewSide::Back, DVec3::NEG_X),
        (ViewSide::Left, DVec3::Z),
        (ViewSide::Right, DVec3::NEG_Z),
        (ViewSide::Top, DVec3::X),
        (ViewSide::Bottom, DVec3::X),
    ] {
        let camera = look_along(&camera, axis, DVec3::ZERO);
        assert_near(axes(&camera).x_axis, right);
        assert_eq!(camera.position.length(), 5.0);
    }
    // Flying on from above starts with what is up in the picture ahead.
    let up = fly(&top, DVec3::ZERO, 0.0, FRAC_PI_2);
    assert_near(up.target - up.position, DVec3::NEG_Z * 5.0);
}

#[test]
fn pan_dolly_and_fly_go_where_they_say() {
    let camera = looking(DVec3::new(0.0, 1.0, 5.0));
    let panned = pan(&camera, 2.0, -3.0);
    assert_eq!((panned.position, panned.target), (DVec3::new(2.0, -2.0, 5.0), DVec3::new(2.0, -2.0, 0.0)));
    assert_eq!(dolly(&camera, 0.5).position, DVec3::new(0.0, 1.0, 2.5));
    let parallel = Camera { projection: Projection::Parallel { height: 4.0 }, ..camera };
    let nearer = dolly(&parallel, 0.5);
    assert_eq!((nearer.position, nearer.projection), (camera.position, Projection::Parallel { height: 2.0 }));
    assert_eq!(dolly(&camera, 0.0), camera);
    assert_eq!(dolly(&camera, -1.0), camera);
    let flown = fly(&camera, DVec3::new(1.0, 2.0, 3.0), FRAC_PI_2, 0.0);
    assert_near(flown.position, DVec3::new(1.0, 3.0, 2.0));
    assert_near(flown.target, DVec3::new(6.0, 3.0, 2.0));
    let looked = fly(&camera, DVec3::ZERO, 0.0, std::f64::consts::FRAC_PI_4);
    assert_near(looked.target, DVec3::new(0.0, 1.0 + 12.5f64.sqrt(), 5.0 - 12.5f64.sqrt()));
}

#[test]
fn a_point_stays_where_it_is_zoomed_towards() {
    let point = DVec3::new(1.0, 2.0, -3.0);
    let perspective = looking(DVec3::new(0.5, 1.5, 5.0));
    for camera in [perspective, toggle_projection(&perspective)] {
        for factor in [0.5, 3.0] {
            let zoomed = zoom_towards(&camera, point, factor);
            assert_ne!(zoomed, camera);
            let (before, after) = (seen(&camera, point), seen(&zoomed, point));
            assert!((before[0] - after[0]).abs() + (before[1] - after[1]).abs() < 1e-12);
        }
    }
}

#[test]
fn a_framed_ball_touches_the_margin() {
    let camera = looking(DVec3::new(1.0, 4.0, 5.0));
    let center = DVec3::new(3.0, -1.0, 2.0);
    for aspect in [0.5, 1.0, 16.0 / 9.0] {
        let framed = frame(&camera, center, 2.0, aspect);
        assert_eq!(framed.target, center);
        let view = direction(framed.target - framed.position);
        assert_near(view, direction(camera.target - camera.position));
        // The tangent of the ball's outline against that of the narrower side.
        let distance = framed.position.distance(center);
        let outline = 2.2 / (distance * distance - 2.2 * 2.2).sqrt();
        let side = 13.5f64.to_radians().tan() * aspect.min(1.0);
        assert!((outline - side).abs() < 1e-12);
        let flat = frame(&toggle_projection(&camera), center, 2.0, aspect);
        let Projection::Parallel { height } = flat.projection else { panic!() };
        assert!((height * aspect.min(1.0) - 4.4).abs() < 1e-12);
        assert!(flat.position.distance(center) > 2.2);
    }
}

#[test]
fn projections_keep_the_size_at_the_target() {
    let camera = Camera {
        projection: Projection::Perspective { fov_degrees: 60.0 },
        ..looking(DVec3::new(3.0, 1.0, 5.0))
    };
    let up = camera.target + axes(&camera).y_axis;
    let parallel = toggle_projection(&camera);
    let back = toggle_projection(&parallel);
    assert_eq!(back.projection, Projection::default());
    for other in [parallel, back] {
        assert!((seen(&camera, up)[1] - seen(&other, up)[1]).abs() < 1e-12);
    }
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![-10.0..10.0f64, -1e9..1e9f64, Just(0.0), Just(1e-9), any::<f64>()]
}

fn vector() -> impl Strategy<Value = DVec3> {
    (number(), number(), number()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn camera() -> impl Strategy<Value = Camera> {
    let height = prop_oneof![0.1..10.0f64, Just(1e-9), Just(1e9)];
    let projection = prop_oneof![
        (0.001..179.9f64).prop_map(|fov_degrees| Projection::Perspective { fov_degrees }),
        height.prop_map(|height| Projection::Parallel { height })
    ];
    let up = prop_oneof![3 => Just(DVec3::Y), 1 => vector()];
    (vector(), vector(), up, projection).prop_map(|(position, target, up, projection)| {
        let camera = Camera { position, target, up, projection };
        if camera.is_valid() { camera } else { Camera { projection, ..Camera::default() } }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn every_move_gives_a_camera(camera in camera(), point in vector(), a in number(), b in number(), side in 0usize..6) {
        let axis = ViewSide::ALL[side];
        let moves = [
            ("orbit", orbit(&camera, a, b)),
            ("pan", pan(&camera, a, b)),
            ("dolly", dolly(&camera, a)),
            ("zoom", zoom_towards(&camera, point, a)),
            ("fly", fly(&camera, point, a, b)),
            ("frame", frame(&camera, point, a, b)),
            ("look", look_along(&camera, axis, point)),
            ("toggle", toggle_projection(&camera)),
        ];
        for (name, moved) in moves {
            prop_assert!(moved.is_valid(), "{name}: {moved:?}");
        }
        // Two further turns from there are moves as well.
        let turned = orbit(&orbit(&look_along(&camera, axis, DVec3::ZERO), a, 0.1), 0.1, b);
        prop_assert!(turned.is_valid());
    }
}
