use std::f64::consts::FRAC_PI_2;

use super::*;

fn rotation(degrees: DVec3) -> DMat3 {
    let anchor = Anchor::Frame { position: DVec3::ZERO, rotation_degrees: degrees };
    Placement { anchor, scale: DVec3::ONE }.world_from_body().matrix3
}

/// Numbers between 0 and 1, always the same.
fn numbers(count: usize) -> impl Iterator<Item = f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    std::iter::repeat_with(move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    })
    .take(count)
}

fn triples(count: usize) -> Vec<DVec3> {
    let numbers: Vec<f64> = numbers(3 * count).collect();
    numbers.chunks_exact(3).map(DVec3::from_slice).collect()
}

#[test]
fn turns_are_told_again() {
    let mut all: Vec<DVec3> = triples(2000).into_iter().map(|triple| 720.0 * triple - 360.0).collect();
    // All the right angles, where gimbal lock is, and their neighborhood.
    for steps in 0..512 {
        let right = DVec3::new(f64::from(steps % 8), f64::from(steps / 8 % 8), f64::from(steps / 64)) - 4.0;
        all.extend([0.0, 1e-3, 1e-6, 1e-9].map(|aside| 90.0 * right + DVec3::new(0.0, aside, 3.0 * aside)));
    }
    for degrees in all {
        let matrix = rotation(degrees);
        for near in [degrees, DVec3::ZERO, DVec3::new(17.0, -200.0, 400.0)] {
            let told = degrees_of(&matrix, near);
            let difference = (rotation(told) - matrix).to_cols_array().map(f64::abs);
            let worst = difference.into_iter().fold(0.0, f64::max);
            assert!(worst < 3e-8, "{degrees} near {near}: {told} is off by {worst}");
        }
        let told = degrees_of(&matrix, degrees);
        let is_locked = (degrees.y / 90.0).rem_euclid(2.0);
        if (is_locked - 1.0).abs() > 1e-3 {
            assert!(told.distance(degrees) < 1e-6, "{degrees} became {told}");
        }
    }
}

#[test]
fn a_whole_turn_about_any_axis_has_no_jump() {
    for axis in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(0.6, 0.0, 0.8), DVec3::new(2.0, 3.0, 6.0) / 7.0] {
        for start in [DVec3::ZERO, DVec3::new(10.0, 32.0, -20.0), DVec3::new(0.0, 80.0, 0.0)] {
            let placement = Placement {
                anchor: Anchor::Frame { position: DVec3::ONE, rotation_degrees: start },
                scale: DVec3::ONE,
            };
            let mut near = start;
            for step in 1..=1440 {
                let change = GizmoChange::Turn {
                    pivot: DVec3::ZERO,
                    axis,
                    radians: (0.25 * f64::from(step)).to_radians(),
                };
                let placement = change.placement(&placement, near);
                let Anchor::Frame { rotation_degrees, .. } = placement.anchor else { unreachable!() };
                let world = placement.world_from_body().matrix3;
                let expected =
                    DMat3::from_axis_angle(axis, (0.25 * f64::from(step)).to_radians()) * rotation(start);
                assert!(world.abs_diff_eq(expected, 1e-7));
                // Turning about one of the three axes alone changes one number, evenly.
                if start == DVec3::ZERO && axis.max_element() == 1.0 {
                    assert!(rotation_degrees.distance(0.25 * f64::from(step) * axis) < 1e-6);
                }
                near = rotation_degrees;
            }
        }
    }
}

#[test]
fn exact_angles_have_exact_numbers() {
    let placement = Placement {
        anchor: Anchor::Frame { position: DVec3::ZERO, rotation_degrees: DVec3::new(0.0, 32.0, 0.0) },
        scale: DVec3::ONE,
    };
    let change = GizmoChange::Turn { pivot: DVec3::ZERO, axis: DVec3::Y, radians: 15_f64.to_radians() };
    let Anchor::Frame { rotation_degrees, .. } = change.placement(&placement, DVec3::Y * 32.0).anchor else {
        unreachable!()
    };
    assert_eq!(rotation_degrees, DVec3::new(0.0, 47.0, 0.0));
}

#[test]
fn a_turn_carries_places_about_the_pivot() {
    let change = GizmoChange::Turn { pivot: DVec3::X, axis: DVec3::Y, radians: FRAC_PI_2 };
    let placement = change.placement(&Placement::at(DVec3::new(2.0, 5.0, 0.0)), DVec3::ZERO);
    assert!(placement.world_from_body().translation.distance(DVec3::new(1.0, 5.0, -1.0)) < 1e-12);
    let ends = Placement {
        anchor: Anchor::Axis { base: DVec3::X, top: DVec3::new(2.0, 1.0, 0.0) },
        scale: DVec3::ONE,
    };
    let Anchor::Axis { base, top } = change.placement(&ends, DVec3::ZERO).anchor else { unreachable!() };
    assert!(base.distance(DVec3::X) < 1e-12 && top.distance(DVec3::new(1.0, 1.0, -1.0)) < 1e-12);
}

#[test]
fn scaling_along_a_bodys_own_axes_is_exact() {
    let degrees = DVec3::new(10.0, 32.0, -7.0);
    let start = Placement {
        anchor: Anchor::Frame { position: DVec3::new(1.0, 2.0, 3.0), rotation_degrees: degrees },
        scale: DVec3::new(1.0, 2.0, 0.5),
    };
    let own = rotation(degrees);
    let change = GizmoChange::Scale {
        pivot: start.world_from_body().translation,
        axes: [own.x_axis, own.y_axis, own.z_axis],
        factors: DVec3::new(1.5, 1.0, 2.0),
    };
    let scaled = change.placement(&start, degrees);
    assert_eq!(scaled.scale, DVec3::new(1.5, 2.0, 1.0));
    assert_eq!(scaled.anchor, start.anchor);
}

#[test]
fn scaling_along_the_world_reaches_as_far() {
    // A quarter turn about Z: the body's Y axis lies along the world's X.
    let start = Placement {
        anchor: Anchor::Frame { position: DVec3::X, rotation_degrees: DVec3::Z * 90.0 },
        scale: DVec3::ONE,
    };
    let change = GizmoChange::Scale {
        pivot: DVec3::ZERO,
        axes: [DVec3::X, DVec3::Y, DVec3::Z],
        factors: DVec3::new(3.0, 1.0, 1.0),
    };
    let scaled = change.placement(&start, DVec3::ZERO);
    assert_eq!(scaled.scale, DVec3::new(1.0, 3.0, 1.0));
    assert_eq!(scaled.world_from_body().translation, DVec3::X * 3.0);
}

#[test]
fn scaling_all_over_scales_an_axis_too() {
    let (base, top) = (DVec3::new(1.0, 0.0, 0.0), DVec3::new(1.0, 2.0, 1.0));
    let start = Placement { anchor: Anchor::Axis { base, top }, scale: DVec3::ONE };
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let change = GizmoChange::Scale { pivot: base, axes, factors: DVec3::splat(2.0) };
    let scaled = change.placement(&start, DVec3::ZERO);
    assert_eq!(scaled.anchor, Anchor::Axis { base, top: DVec3::new(1.0, 4.0, 2.0) });
    assert_eq!(scaled.scale, DVec3::new(2.0, 1.0, 2.0));
}

#[test]
fn moving_moves_and_nothing_else() {
    let start = Placement {
        anchor: Anchor::Frame {
            position: DVec3::new(0.1, 0.2, 0.3),
            rotation_degrees: DVec3::new(5.0, 400.0, 1.0),
        },
        scale: DVec3::new(1.0, 2.0, 3.0),
    };
    let moved = GizmoChange::Move(DVec3::new(1.0, 0.0, 0.0)).placement(&start, DVec3::ZERO);
    let Anchor::Frame { position, rotation_degrees } = moved.anchor else { unreachable!() };
    assert_eq!(position, DVec3::new(1.1, 0.2, 0.3));
    assert_eq!(rotation_degrees, DVec3::new(5.0, 400.0, 1.0));
    assert_eq!(moved.scale, start.scale);
}
