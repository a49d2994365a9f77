//! The canonical shapes against textbook formulas in double precision.

use catoptric_scene::{ParaboloidDepth, Shape};
use catoptric_tracer::shape::{CanonicalShape, FaceId, LOWER_CAP, SIDE, ShapeKind, ShapeSpan, UPPER_CAP};
use glam::{DVec3, Vec3};
use proptest::prelude::*;

use crate::proof::common::{cases, textbook, v};

/// Rounding granted, in units of single precision at the distance of the ray's origin.
const UNITS: f64 = 4.0;

fn bounded() -> impl Strategy<Value = CanonicalShape> {
    prop_oneof![
        Just(CanonicalShape { kind: ShapeKind::Sphere, cone_ratio: 0.0 }),
        Just(CanonicalShape { kind: ShapeKind::Cube, cone_ratio: 0.0 }),
        Just(CanonicalShape { kind: ShapeKind::Cylinder, cone_ratio: 1.0 }),
        prop_oneof![Just(0.0_f32), Just(1.0), Just(0.5), 0.0_f32..3.0]
            .prop_map(|cone_ratio| CanonicalShape { kind: ShapeKind::Cone, cone_ratio }),
        Just(PARABOLOID),
    ]
}

/// The same shape for the textbook.
fn textbook_shape(canonical: &CanonicalShape) -> Shape {
    match canonical.kind {
        ShapeKind::Sphere | ShapeKind::Ellipsoid => Shape::Sphere { radius: 1.0 },
        ShapeKind::Cube => Shape::Cube { size: DVec3::splat(2.0) },
        ShapeKind::Cylinder => Shape::Cylinder { radius: 1.0, height: 1.0 },
        ShapeKind::Cone => {
            Shape::Cone { radius: 1.0, top_radius: f64::from(canonical.cone_ratio), height: 1.0 }
        }
        ShapeKind::Paraboloid => Shape::Paraboloid { radius: 1.0, depth: ParaboloidDepth::Height(1.0) },
        ShapeKind::Plane => Shape::Plane,
        ShapeKind::Joined | ShapeKind::JoinedEndless => {
            unreachable!("{kind:?} is no canonical shape", kind = canonical.kind)
        }
    }
}

/// The textbook's span of the shape grown about a point inside it by `by`; parameters stay what they are.
fn grown_span(canonical: &CanonicalShape, o: DVec3, d: DVec3, by: f64) -> Option<(f64, f64)> {
    let inside = match canonical.kind {
        ShapeKind::Cylinder | ShapeKind::Cone => v(0.0, 0.3, 0.0),
        ShapeKind::Paraboloid => v(0.0, 0.5, 0.0),
        _ => DVec3::ZERO,
    };
    textbook::span(&textbook_shape(canonical), inside + (o - inside) / (1.0 + by), d / (1.0 + by))
}

/// The distance from the point about which [`grown_span`] scales to the nearest part of the surface.
fn distance_inside(canonical: &CanonicalShape) -> f64 {
    match canonical.kind {
        ShapeKind::Cylinder | ShapeKind::Cone => 0.3,
        ShapeKind::Paraboloid => 0.5,
        _ => 1.0,
    }
}

/// Asserts that `span` is the span of the shape moved in or out by no more than rounding. Unlike a bound on t, this
/// is as strict for grazing rays, whose t is ill-conditioned, as for all others.
fn check_span(canonical: &CanonicalShape, o: Vec3, d: Vec3, span: &ShapeSpan) -> Result<(), TestCaseError> {
    let (o, d) = (o.as_dvec3(), d.as_dvec3());
    let slack = UNITS * f64::from(f32::EPSILON) * (3.0 + o.length());
    let by = slack / distance_inside(canonical);
    let (outer, inner) = (grown_span(canonical, o, d, by), grown_span(canonical, o, d, -by));
    if !span.hit {
        prop_assert!(inner.is_none(), "missed a chord {inner:?} of the shrunk shape");
        return Ok(());
    }
    let Some((first, last)) = outer else {
        return Err(TestCaseError::fail(format!("hit {span:?} where even the grown shape is missed")));
    };
    let rounding = |t: f64| 2.0 * f64::from(f32::EPSILON) * t.abs() + slack / d.length();
    let (enter, exit) = (f64::from(span.enter), f64::from(span.exit));
    let (latest, earliest) = inner.unwrap_or((last, first));
    prop_assert!(enter <= exit);
    prop_assert!(enter >= first - rounding(first), "enters at {enter}, not after {first}");
    prop_assert!(enter <= latest + rounding(latest), "enters at {enter}, not before {latest}");
    prop_assert!(exit <= last + rounding(last), "leaves at {exit}, not before {last}");
    prop_assert!(exit >= earliest - rounding(earliest), "leaves at {exit}, not after {earliest}");
    Ok(())
}

fn span(canonical: &CanonicalShape, o: Vec3, d: Vec3) -> ShapeSpan {
    canonical.span(o.into(), d.into())
}

fn pull_to_surface(canonical: &CanonicalShape, face: FaceId, point: Vec3) -> Vec3 {
    canonical.pull_to_surface(face, point.into()).into()
}

fn normal(canonical: &CanonicalShape, face: FaceId, point: Vec3) -> Vec3 {
    Vec3::from(canonical.normal(face, point.into())).normalize()
}

/// Coordinates that find edges: exact small numbers as often as any others.
fn coordinate(reach: f32) -> impl Strategy<Value = f32> {
    prop_oneof![
        3 => -reach..reach,
        1 => prop_oneof![Just(0.0_f32), Just(-0.0), Just(1.0), Just(-1.0), Just(0.5), Just(1.0 - f32::EPSILON)],
    ]
}

fn vector(reach: f32) -> impl Strategy<Value = Vec3> {
    (coordinate(reach), coordinate(reach), coordinate(reach)).prop_map(Vec3::from)
}

/// A vector whose length is between 10⁻³ and 10³, of any direction.
fn any_direction() -> impl Strategy<Value = Vec3> {
    (vector(1.0), -3.0_f32..3.0)
        .prop_filter("no direction", |(d, _)| d.length() > 1e-3)
        .prop_map(|(d, power)| d.normalize() * 10.0_f32.powf(power))
}

proptest! {
    #![proptest_config(cases(4000))]

    #[test]
    fn spans_agree_with_the_textbook(shape in bounded(), o in vector(3.0), d in any_direction()) {
        check_span(&shape, o, d, &span(&shape, o, d))?;
    }

    /// Far rays aimed at the shape, so that most of them hit.
    #[test]
    fn spans_of_far_rays_agree_with_the_textbook(
        shape in bounded(), towards in any_direction(), at in vector(1.2), power in 0.0_f32..4.0,
    ) {
        let o = at - towards.normalize() * 10.0_f32.powf(power);
        let d = (at - o).normalize();
        check_span(&shape, o, d, &span(&shape, o, d))?;
    }

    /// Bodies squashed or stretched to 1:1000 give directions and origins such as these.
    #[test]
    fn spans_under_anisotropic_scales_agree_with_the_textbook(
        shape in bounded(), o in vector(3.0), d in any_direction(), powers in vector(3.0),
    ) {
        let scale = Vec3::from_array(powers.to_array().map(|power| 10.0_f32.powf(power)));
        let (o, d) = (o * scale, d.normalize() * scale);
        check_span(&shape, o, d, &span(&shape, o, d))?;
    }

    #[test]
    fn origins_on_the_surface_are_an_end_of_the_span(
        shape in bounded(), from in any_direction(), at in vector(0.3), d in any_direction(),
    ) {
        // A point of the surface, found by the tracer itself.
        let at = at + Vec3::Y * 0.4;
        let through = span(&shape, at, from);
        prop_assume!(through.hit);
        let o = pull_to_surface(&shape, through.exit_face, at + from * through.exit);
        let span = span(&shape, o, d);
        check_span(&shape, o, d, &span)?;
        let within = textbook::implicit(&textbook_shape(&shape), (o + d.normalize() * 1e-3).as_dvec3());
        prop_assert!(span.hit || within > -1e-6, "missed from the surface, though {within} inside");
    }

    #[test]
    fn origins_inside_lie_in_the_span(shape in bounded(), o in vector(1.0), d in any_direction()) {
        let depth = textbook::implicit(&textbook_shape(&shape), o.as_dvec3());
        prop_assert!(depth.abs() < 1e-6 || shape.contains(o.into()) == (depth < 0.0));
        prop_assume!(depth < -1e-5);
        let span = span(&shape, o, d);
        prop_assert!(span.hit && span.enter < 0.0 && span.exit > 0.0, "{span:?}");
    }

    /// The faces that the span names are those the crossings lie on, and pulling there moves by rounding only.
    #[test]
    fn crossings_lie_on_their_faces(shape in bounded(), o in vector(3.0), d in any_direction()) {
        let d = d.normalize();
        let span = span(&shape, o, d);
        prop_assume!(span.hit);
        for (t, face) in [(span.enter, span.enter_face), (span.exit, span.exit_face)] {
            let near = o + d * t;
            let on = pull_to_surface(&shape, face, near);
            let outside = textbook::implicit(&textbook_shape(&shape), on.as_dvec3());
            prop_assert!(outside.abs() < 3e-7, "{on} is off the surface by {outside:e}");
            let moved = near.distance(on);
            let normal = normal(&shape, face, on);
            let cos = normal.dot(d).abs();
            let allowed = 4e-6 / cos.max(1e-3);
            prop_assert!(moved < allowed, "{face} pulled by {moved:e}, cos {cos}");
            // Entering is against the normal, leaving along it.
            let sign = if t == span.enter { -1.0 } else { 1.0 };
            prop_assert!(span.enter == span.exit || sign * normal.dot(d) > -1e-3, "{face} {normal}");
        }
    }

    #[test]
    fn normals_are_gradients(shape in bounded(), at in vector(0.3), from in any_direction()) {
        let at = at + Vec3::Y * 0.4;
        let span = span(&shape, at, from);
        prop_assume!(span.hit);
        let on = pull_to_surface(&shape, span.exit_face, at + from * span.exit);
        let normal = normal(&shape, span.exit_face, on).as_dvec3();
        let form = textbook_shape(&shape);
        let value = |offset: DVec3| textbook::implicit(&form, on.as_dvec3() + offset);
        const STEP: f64 = 1e-5;
        let gradient = DVec3::from_array([DVec3::X, DVec3::Y, DVec3::Z].map(|axis| {
            (value(axis * STEP) - value(-axis * STEP)) / (2.0 * STEP)
        }));
        // On an edge the gradient is between those of two faces.
        let smooth = (value(normal * 1e-3) - 1e-3).abs() < 1e-5 && (gradient.length() - 1.0).abs() < 1e-3;
        prop_assume!(smooth);
        let error = (gradient.normalize() - normal).length();
        prop_assert!(error < 1e-4, "normal {normal}, gradient {gradient}");
    }

    #[test]
    fn no_number_no_hit(
        shape in prop_oneof![bounded(), Just(CanonicalShape { kind: ShapeKind::Plane, cone_ratio: 0.0 })],
        o in vector(3.0), d in any_direction(), place in 0_usize..6,
    ) {
        let mut numbers = [o.to_array(), d.to_array()].concat();
        numbers[place] = f32::NAN;
        let (o, d) = (Vec3::from_slice(&numbers[..3]), Vec3::from_slice(&numbers[3..]));
        let span = span(&shape, o, d);
        // A plane neither knows nor needs what happens along it.
        let seen = shape.kind != ShapeKind::Plane || place % 3 == 1;
        prop_assert!(!(seen && span.hit), "{span:?}");
    }
}

const SPHERE: CanonicalShape = CanonicalShape { kind: ShapeKind::Sphere, cone_ratio: 0.0 };
const CUBE: CanonicalShape = CanonicalShape { kind: ShapeKind::Cube, cone_ratio: 0.0 };
const CYLINDER: CanonicalShape = CanonicalShape { kind: ShapeKind::Cylinder, cone_ratio: 1.0 };
const CONE: CanonicalShape = CanonicalShape { kind: ShapeKind::Cone, cone_ratio: 0.0 };
const FRUSTUM: CanonicalShape = CanonicalShape { kind: ShapeKind::Cone, cone_ratio: 0.5 };
const PARABOLOID: CanonicalShape = CanonicalShape { kind: ShapeKind::Paraboloid, cone_ratio: 0.0 };
const PLANE: CanonicalShape = CanonicalShape { kind: ShapeKind::Plane, cone_ratio: 0.0 };

#[track_caller]
fn ends(shape: &CanonicalShape, o: [f32; 3], d: [f32; 3]) -> (f32, f32) {
    let span = span(shape, o.into(), d.into());
    assert!(span.hit, "{span:?}");
    (span.enter, span.exit)
}

fn misses(shape: &CanonicalShape, o: [f32; 3], d: [f32; 3]) -> bool {
    !span(shape, o.into(), d.into()).hit
}

#[test]
fn tangents_touch_in_one_point() {
    assert_eq!(ends(&SPHERE, [-2.0, 1.0, 0.0], [1.0, 0.0, 0.0]), (2.0, 2.0));
    assert_eq!(ends(&CYLINDER, [-2.0, 0.5, 1.0], [1.0, 0.0, 0.0]), (2.0, 2.0));
    // The side of the cone at half its height.
    let (enter, exit) = ends(&CONE, [-2.0, 0.5, 0.5], [1.0, 0.0, 0.0]);
    assert_eq!((enter, exit), (2.0, 2.0));
    let above = 1.0 + 2.0 * f32::EPSILON;
    // The vertex.
    assert_eq!(ends(&PARABOLOID, [-2.0, 0.0, 0.0], [1.0, 0.0, 0.0]), (2.0, 2.0));
    assert!(misses(&PARABOLOID, [-2.0, -1e-6, 0.0], [1.0, 0.0, 0.0]));
    assert!(misses(&SPHERE, [-2.0, above, 0.0], [1.0, 0.0, 0.0]));
    assert!(misses(&CYLINDER, [-2.0, 0.5, above], [1.0, 0.0, 0.0]));
}

#[test]
fn rays_along_the_axis_cross_both_ends() {
    assert_eq!(ends(&CYLINDER, [0.0, 3.0, 0.0], [0.0, -1.0, 0.0]), (2.0, 3.0));
    assert_eq!(ends(&CYLINDER, [0.3, -1.0, 0.4], [0.0, 2.0, 0.0]), (0.5, 1.0));
    assert_eq!(ends(&CONE, [0.0, 3.0, 0.0], [0.0, -1.0, 0.0]), (2.0, 3.0));
    assert_eq!(ends(&CONE, [0.25, 3.0, 0.0], [0.0, -1.0, 0.0]), (2.25, 3.0));
    assert_eq!(ends(&FRUSTUM, [0.25, 3.0, 0.0], [0.0, -1.0, 0.0]), (2.0, 3.0));
    assert_eq!(ends(&PARABOLOID, [0.5, 3.0, 0.0], [0.0, -1.0, 0.0]), (2.0, 2.75));
    assert_eq!(ends(&PARABOLOID, [0.0, -1.0, 0.5], [0.0, 2.0, 0.0]), (0.625, 1.0));
    assert!(misses(&PARABOLOID, [0.0, 3.0, 1.001], [0.0, -1.0, 0.0]));
    assert!(misses(&CYLINDER, [0.0, 3.0, 1.001], [0.0, -1.0, 0.0]));
    assert!(misses(&CONE, [0.0, 3.0, 1.001], [0.0, -1.0, 0.0]));
}

#[test]
fn rays_in_a_cap_or_face_run_along_it() {
    for y in [0.0, 1.0] {
        assert_eq!(ends(&CYLINDER, [-3.0, y, 0.0], [1.0, 0.0, 0.0]), (2.0, 4.0));
    }
    assert_eq!(ends(&CONE, [-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]), (2.0, 4.0));
    assert_eq!(ends(&FRUSTUM, [-3.0, 1.0, 0.0], [1.0, 0.0, 0.0]), (2.5, 3.5));
    assert_eq!(ends(&PARABOLOID, [-3.0, 1.0, 0.0], [1.0, 0.0, 0.0]), (2.0, 4.0));
    // Of the planes of two opposite faces one belongs to the cube, so that a stack of cubes has no gap.
    for across in [0.0, -0.0] {
        for axis in 1..3 {
            let hits = [-1.0, 1.0].map(|side| {
                let (mut o, mut d) = (Vec3::X * -3.0, Vec3::X);
                (o[axis], d[axis]) = (side, across);
                span(&CUBE, o, d)
            });
            assert!(hits[0].hit != hits[1].hit);
            let hit = if hits[0].hit { hits[0] } else { hits[1] };
            assert_eq!((hit.enter, hit.exit), (2.0, 4.0));
        }
    }
    for y in [-1e-6, 1.0 + 1e-6] {
        assert!(misses(&CYLINDER, [-3.0, y, 0.0], [1.0, 0.0, 0.0]));
    }
    assert!(misses(&CUBE, [-3.0, 1.0 + 1e-6, 0.0], [1.0, 0.0, 0.0]));
    assert!(misses(&PLANE, [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]));
}

#[test]
fn rays_through_apex_rim_and_corner_hit() {
    // Down the side's own line, and across the apex.
    let (enter, exit) = ends(&CONE, [-1.0, 2.0, 0.0], [1.0, -1.0, 0.0]);
    assert!((enter - 1.0).abs() < 1e-3 && (exit - 2.0).abs() < 1e-3, "{enter} {exit}");
    assert_eq!(ends(&CONE, [-1.0, 1.0, 0.0], [1.0, 0.0, 0.0]), (1.0, 1.0));
    let (enter, exit) = ends(&CONE, [-0.5, 2.0, 0.0], [0.5, -1.0, 0.0]);
    assert!((enter - 1.0).abs() < 1e-6 && (exit - 2.0).abs() < 1e-6, "{enter} {exit}");
    // A rim, from outside only.
    let (enter, exit) = ends(&CYLINDER, [0.0, 2.0, 0.0], [1.0, -1.0, 0.0]);
    assert_eq!((enter, exit), (1.0, 1.0));
    // From corner to corner.
    assert_eq!(ends(&CUBE, [-2.0, -2.0, -2.0], [1.0, 1.0, 1.0]), (1.0, 3.0));
    assert_eq!(ends(&CUBE, [0.0, 2.0, 0.0], [1.0, -1.0, 0.0]), (1.0, 1.0));
}

#[test]
fn faces_have_their_names_and_normals() {
    let down = span(&FRUSTUM, Vec3::Y * 3.0, Vec3::NEG_Y);
    assert_eq!((down.enter_face, down.exit_face), (UPPER_CAP, LOWER_CAP));
    assert_eq!(span(&FRUSTUM, Vec3::new(3.0, 0.5, 0.0), Vec3::NEG_X).enter_face, SIDE);
    let down = span(&PARABOLOID, Vec3::Y * 3.0, Vec3::NEG_Y);
    assert_eq!((down.enter_face, down.exit_face), (UPPER_CAP, SIDE));
    assert_eq!(normal(&PARABOLOID, SIDE, Vec3::ZERO), Vec3::NEG_Y);
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        for out in [axis, -axis] {
            let span = span(&CUBE, out * 3.0, -out);
            assert_eq!(normal(&CUBE, span.enter_face, out), out);
            assert_eq!(normal(&CUBE, span.exit_face, -out), -out);
        }
    }
}

#[test]
fn a_plane_is_the_half_space_below() {
    assert_eq!(ends(&PLANE, [5.0, 2.0, 1.0], [1.0, -1.0, 0.0]), (2.0, f32::INFINITY));
    assert_eq!(ends(&PLANE, [5.0, 2.0, 1.0], [1.0, 1.0, 0.0]), (f32::NEG_INFINITY, -2.0));
    assert_eq!(ends(&PLANE, [5.0, -2.0, 1.0], [0.0, 4.0, 0.0]), (f32::NEG_INFINITY, 0.5));
    assert!(PLANE.contains(Vec3::new(9.0, -1e-3, 4.0).into()) && !PLANE.contains((Vec3::Y * 1e-3).into()));
}

#[test]
fn the_zero_direction_hits_nothing() {
    for shape in [SPHERE, CUBE, CYLINDER, CONE, FRUSTUM, PARABOLOID, PLANE] {
        assert!(misses(&shape, [0.0, 5.0, 0.0], [0.0; 3]), "{shape:?}");
    }
}
