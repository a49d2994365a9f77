//! Surfaces without inside: open cylinders, squares, triangles, pieces of balls.

use catoptric_scene::{
    Anchor, Attenuation, Body, BodyPart, Color, Dielectric, Falloff, MaterialChoice, ParaboloidDepth, Phong,
    Placement, Scene, Shape, VisibleSide,
};
use catoptric_tracer::RenderScene;
use glam::DVec3;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use crate::proof::common::oracle::Oracle;
use crate::proof::common::{
    assert_close, assert_light, assert_same_picture, assert_vec_close, body, camera, cases, chain, chalk,
    direction, glass, glow, light, light_along, mirror, picture, plane, ray, scene, stage_of, v,
};
use crate::proof::random;

fn part(shape: Shape, at: DVec3) -> BodyPart {
    BodyPart { shape, placement: Placement::at(at), ..BodyPart::default() }
}

/// The surface of the first part within the others.
fn surface(parts: Vec<BodyPart>, material: impl Into<catoptric_scene::Material>) -> Body {
    Body { shape: Shape::SURFACE, parts, material: MaterialChoice::own(material), ..Body::default() }
}

/// A cylinder about the Y axis from y = 0 to y = 2.
fn open_cylinder(material: impl Into<catoptric_scene::Material>) -> Body {
    surface(vec![part(Shape::Cylinder { radius: 0.5, height: 2.0 }, DVec3::ZERO)], material)
}

/// A direction in the xz-plane.
fn across(degrees: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    v(sin, 0.0, cos)
}

/// The half-space on this side of a plane that faces along a direction in the xz-plane, at a distance from the Y axis.
fn half_space(degrees: f64, distance: f64) -> BodyPart {
    let anchor =
        Anchor::Frame { position: distance * across(degrees), rotation_degrees: v(90.0, degrees, 0.0) };
    BodyPart {
        shape: Shape::Plane,
        placement: Placement { anchor, scale: DVec3::ONE },
        ..BodyPart::default()
    }
}

/// The parameters at which a ray meets surfaces, one after another.
fn met(scene: &RenderScene, from: DVec3, along: DVec3) -> Vec<f64> {
    let rays = chain(scene, ray(from, along));
    rays.iter().filter_map(|ray| ray.hit.as_ref()).map(|hit| hit.position.distance(from)).collect()
}

#[test]
fn an_open_cylinder_has_no_caps() {
    let scene = stage_of(vec![open_cylinder(glass(1.0))]);
    assert_eq!(met(&scene, v(0.1, 9.0, 0.2), DVec3::NEG_Y), [0.0; 0], "along the axis");
    // Through the upper opening to the far side, and through both sides.
    let through = met(&scene, v(0.0, 4.0, 0.0), v(0.25, -1.5, 0.0));
    assert_eq!(through.len(), 1, "{through:?}");
    assert_close(through[0], v(0.5, -3.0, 0.0).length(), 1e-6);
    let across = met(&scene, v(3.0, 1.0, 0.0), DVec3::NEG_X);
    assert_eq!(across.len(), 2, "{across:?}");
    assert_close(across[0], 2.5, 1e-6);
    assert_close(across[1], 3.5, 1e-6);
}

/// Half a pipe, a square, a triangle: what lies outside of the other parts is not there.
#[test]
fn other_parts_cut_a_surface() {
    let gutter = surface(
        vec![part(Shape::Cylinder { radius: 0.5, height: 2.0 }, DVec3::ZERO), half_space(90.0, 0.0)],
        glass(1.0),
    );
    assert_eq!(met(&stage_of(vec![gutter]), v(3.0, 1.0, 0.1), DVec3::NEG_X).len(), 1);
    let square = surface(
        vec![part(Shape::Plane, DVec3::ZERO), part(Shape::Cube { size: v(2.0, 1.0, 2.0) }, DVec3::ZERO)],
        glass(1.0),
    );
    let square = stage_of(vec![square]);
    let sides = [0.0, 120.0, 240.0].map(|degrees| half_space(degrees, 0.5));
    let triangle = surface([vec![part(Shape::Plane, DVec3::ZERO)], sides.to_vec()].concat(), glass(1.0));
    let triangle = stage_of(vec![triangle]);
    for x in -12..12 {
        for z in -12..12 {
            let at = 0.1 * v(f64::from(x) + 0.5, 0.0, f64::from(z) + 0.5);
            for (from, along) in [(at + 3.0 * DVec3::Y, DVec3::NEG_Y), (at - 3.0 * DVec3::Y, DVec3::Y)] {
                let in_square = at.x.abs() < 1.0 && at.z.abs() < 1.0;
                assert_eq!(met(&square, from, along).len(), usize::from(in_square), "{at}");
                let in_triangle = [0.0, 120.0, 240.0].iter().all(|degrees| at.dot(across(*degrees)) < 0.5);
                assert_eq!(met(&triangle, from, along).len(), usize::from(in_triangle), "{at}");
            }
        }
    }
}

/// There is nothing behind a surface but what was before it: glass of any index lets light go straight on, an absorbing
/// one takes nothing, and an eye is never within.
#[test]
fn a_surface_has_no_inside() {
    let absorbing = Dielectric {
        attenuation: Attenuation { color: Color::from([0.2, 0.5, 0.9]), distance: 0.1 },
        ..Dielectric::default()
    };
    let tinted = Phong { tint: Color::from([0.5, 0.25, 1.0]), ..glass(1.5) };
    let cap = |material: Phong| {
        surface(
            vec![part(Shape::Sphere { radius: 1.0 }, DVec3::ZERO), part(Shape::CUBE, v(0.0, 0.9, 0.0))],
            material,
        )
    };
    let scene = |body: Body| stage_of(vec![body, plane(v(0.0, -3.0, 0.0), 0.0, glow(Color::WHITE))]);
    for (from, along) in [
        (v(0.2, 5.0, 0.0), v(0.02, -1.0, 0.01)),
        (v(0.2, 0.0, 0.1), v(0.02, -1.0, 0.01)),
        (v(0.2, -1.0, 0.1), v(0.1, 1.0, 0.01)),
    ] {
        let path = chain(&scene(cap(tinted.clone())), ray(from, along));
        for ray in &path {
            assert_vec_close(direction(ray), along.normalize(), 1e-6);
        }
    }
    let seen = light_along(&scene(cap(tinted)), ray(v(0.2, 5.0, 0.0), v(0.0, -1.0, 0.0)));
    assert_light(seen, [0.5, 0.25, 1.0]);
    let shell = Body { material: MaterialChoice::own(absorbing), ..open_cylinder(chalk()) };
    let seen = light_along(&scene(shell), ray(v(3.0, 1.5, 0.0), v(-1.0, -0.2, 0.0)));
    assert!(seen.min_element() > 0.9, "{seen}");
}

/// Of a pipe of which one side is seen, rays from outside meet the near wall, or pass it and meet the far one.
#[test]
fn one_side_alone_may_be_seen() {
    let pipe = |side| Body { shape: Shape::Surface { side }, ..open_cylinder(glass(1.0)) };
    let square = |side| {
        let parts =
            vec![part(Shape::Plane, DVec3::ZERO), part(Shape::Cube { size: v(2.0, 1.0, 2.0) }, DVec3::ZERO)];
        Body { shape: Shape::Surface { side }, ..surface(parts, glass(1.0)) }
    };
    for (side, through_pipe, on_square) in [
        (VisibleSide::Both, vec![2.5, 3.5], [true, true]),
        (VisibleSide::Outer, vec![2.5], [true, false]),
        (VisibleSide::Inner, vec![3.5], [false, true]),
    ] {
        let scene = stage_of(vec![pipe(side)]);
        let found = met(&scene, v(3.0, 1.0, 0.0), DVec3::NEG_X);
        assert_eq!(found.len(), through_pipe.len(), "{side:?}: {found:?}");
        found.iter().zip(&through_pipe).for_each(|(found, expected)| assert_close(*found, *expected, 1e-6));
        let scene = stage_of(vec![square(side)]);
        let found = [1.0, -1.0].map(|y| met(&scene, v(0.3, 2.0 * y, 0.4), DVec3::NEG_Y * y).len() == 1);
        assert_eq!(found, on_square, "{side:?}");
    }
}

/// Shadow rays come from what is lit: a square that is seen from above alone lets them pass from below.
#[test]
fn what_is_not_seen_casts_no_shadow() {
    for (side, lit) in [(VisibleSide::Outer, 1.0), (VisibleSide::Both, 0.0), (VisibleSide::Inner, 0.0)] {
        let parts = vec![
            part(Shape::Plane, v(0.0, 1.0, 0.0)),
            part(Shape::Cube { size: v(2.0, 1.0, 2.0) }, v(0.0, 1.0, 0.0)),
        ];
        let square = Body { shape: Shape::Surface { side }, ..surface(parts, chalk()) };
        let mut scene = scene(vec![plane(DVec3::ZERO, 0.0, chalk()), square]);
        scene.lights = vec![light(v(0.0, 3.0, 0.0), 1.0, Falloff::None)];
        let scene = RenderScene::build(&scene).unwrap();
        assert_light(light_along(&scene, ray(v(0.0, 0.5, 0.0), DVec3::NEG_Y)), [lit; 3]);
    }
}

/// A tube of mirror, open at both ends: rays are reflected on its inner side as often as geometry has it.
#[test]
fn the_inner_side_reflects() {
    let scene = stage_of(vec![open_cylinder(mirror())]);
    // The slope lets the ray cross the tube four times.
    let path = chain(&scene, ray(v(-0.5, 2.1, 0.0), v(1.0, -0.44, 0.0)));
    let ys: Vec<f64> = path.iter().filter_map(|ray| ray.hit.as_ref()).map(|hit| hit.position.y).collect();
    assert_eq!(ys.len(), 4, "{ys:?}");
    for (y, turn) in ys.iter().zip(1..) {
        assert_close(*y, 2.1 - 0.44 * f64::from(turn), 1e-6);
    }
}

/// What light falls on is lit on the side that it falls on, the inner one too, and not through the surface.
#[test]
fn both_sides_are_lit_each_by_its_own_light() {
    let square = || {
        surface(
            vec![part(Shape::Plane, DVec3::ZERO), part(Shape::Cube { size: v(2.0, 1.0, 2.0) }, DVec3::ZERO)],
            chalk(),
        )
    };
    for (lamp, eye, is_lit) in [(2.0, 3.0, true), (2.0, -3.0, false), (-2.0, -3.0, true), (-2.0, 3.0, false)]
    {
        let mut scene = scene(vec![square()]);
        scene.lights = vec![light(v(0.0, lamp, 0.0), 1.0, Falloff::None)];
        let seen =
            light_along(&RenderScene::build(&scene).unwrap(), ray(v(0.0, eye, 0.0), v(0.0, -eye, 0.0)));
        assert_light(seen, [f64::from(u8::from(is_lit)); 3]);
    }
}

/// A square that lies on a floor does not shade it, and is not shaded by it; what stands on a square is seen whole.
#[test]
fn surfaces_may_touch_bodies() {
    let square = |y: f64, material: Phong| {
        surface(
            vec![
                part(Shape::Plane, v(0.0, y, 0.0)),
                part(Shape::Cube { size: v(2.0, 1.0, 2.0) }, v(0.0, y, 0.0)),
            ],
            material,
        )
    };
    let floor = plane(DVec3::ZERO, 0.0, chalk());
    let red = || glow(Color::from([1.0, 0.0, 0.0]));
    let seen = |bodies: Vec<Body>| {
        let mut scene = scene(bodies);
        scene.lights = vec![light(v(1.0, 4.0, 1.0), 1.0, Falloff::None)];
        scene.camera = camera(v(0.0, 4.0, 3.0), DVec3::ZERO, 12.0);
        picture(&scene, 40, 30)
    };
    let bare = seen(vec![floor.clone()]);
    let below = seen(vec![floor.clone(), square(0.0, red())]);
    // The floor comes first in the scene.
    assert_same_picture(&bare, &below, 0.0);
    let above = seen(vec![square(0.0, red()), floor]);
    assert!(above.pixels().iter().all(|pixel| pixel[0] == 1.0 && pixel[1] == 0.0), "the square comes first");
    // A block of glass on it lets it be seen.
    let block = body(Shape::Cube { size: v(9.0, 1.0, 9.0) }, v(0.0, 0.5, 0.0), glass(1.5));
    let through = seen(vec![block, square(0.0, red())]);
    assert!(through.pixels().iter().all(|pixel| pixel[0] == 1.0), "seen through glass");
}

/// A surface of a random shape, cut by others.
fn any_surface() -> impl Strategy<Value = Body> {
    let simple = || {
        random::body().prop_map(|body| BodyPart {
            shape: body.shape,
            placement: body.placement,
            ..BodyPart::default()
        })
    };
    let cut = (simple(), 1.2..2.5_f64).prop_map(|(part, scale)| {
        let placement = Placement { scale: scale * part.placement.scale, ..part.placement };
        BodyPart { placement, ..part }
    });
    let side = (prop::sample::select(VisibleSide::ALL.to_vec()), random::shadow());
    (simple(), prop::collection::vec(cut, 0..2), random::material(), any::<[bool; 2]>(), side).prop_map(
        |(first, mut cuts, material, [is_flat, is_near], (side, shadow))| {
            let place = first.placement;
            let first = match is_flat {
                true => BodyPart { shape: Shape::Plane, ..first },
                false => first,
            };
            if is_flat {
                let size = v(1.6, 0.5, 1.2);
                cuts.push(BodyPart { shape: Shape::Cube { size }, placement: place, ..BodyPart::default() });
            }
            if is_near {
                // Cuts that surely meet it.
                for cut in &mut cuts {
                    if let (Anchor::Frame { position, .. }, at) = (&mut cut.placement.anchor, place.origin())
                    {
                        *position = at;
                    }
                }
            }
            let parts = [vec![first], cuts].concat();
            let shape = Shape::Surface { side };
            Body { shape, parts, material: MaterialChoice::own(material), shadow, ..Body::default() }
        },
    )
}

fn any_scene() -> impl Strategy<Value = Scene> {
    let bodies = (prop::collection::vec(any_surface(), 1..8), prop::collection::vec(random::body(), 0..3));
    let lamps = prop::collection::vec(prop::array::uniform3(-5.0..5.0_f64), 1..3);
    (bodies, lamps, any::<bool>()).prop_map(|((surfaces, bodies), lamps, is_mirror)| {
        // Patterns would be finer than the picture far away.
        let floor = plane(DVec3::ZERO, 0.0, if is_mirror { mirror() } else { chalk() });
        let mut scene = scene(surfaces.into_iter().chain(bodies).chain([floor]).collect());
        scene.environment.background = Color::from([0.2, 0.4, 0.7]);
        scene.lights =
            lamps.into_iter().map(|[x, y, z]| light(v(x, 1.0 + y.abs(), z), 0.8, Falloff::None)).collect();
        scene.camera = camera(v(0.4, 2.2, 6.0), v(0.0, 0.9, 0.0), 42.0);
        scene.tracing.generations = 5;
        scene
    })
}

/// Whole pictures against the tracer that was written from the model alone.
#[test]
fn random_surfaces_are_those_of_the_oracle() {
    let mut runner = TestRunner::new(cases(1));
    for number in 0..24 {
        let scene = any_scene().new_tree(&mut runner).unwrap().current();
        let found = picture(&scene, 64, 48);
        let expected = Oracle::new(&scene, 8.0).picture(64, 48);
        let difference = catoptric_picture::Comparison { clamp: false, ..Default::default() }
            .compare(&found, &expected)
            .unwrap();
        assert!(difference.share_above <= 0.01, "scene {number}: {difference:?}\n{scene:#?}");
    }
}

/// A dish of parabolic mirror without a lid sends rays along its axis through its focus, whichever side they come from.
#[test]
fn an_open_paraboloid_has_its_focus_on_both_sides() {
    let shape = Shape::Paraboloid { radius: 1.0, depth: ParaboloidDepth::FocalLength(0.5) };
    let scene = stage_of(vec![surface(vec![part(shape, DVec3::ZERO)], mirror())]);
    let focus = v(0.0, 0.5, 0.0);
    for x in [0.2, 0.5, 0.8] {
        for from in [v(x, 4.0, 0.0), v(x, -4.0, 0.0)] {
            let path = chain(&scene, ray(from, DVec3::Y * -from.y));
            let at = path[0].hit.as_ref().unwrap().position;
            assert_close(direction(&path[1]).cross((focus - at).normalize()).length(), 0.0, 1e-5);
        }
    }
}
