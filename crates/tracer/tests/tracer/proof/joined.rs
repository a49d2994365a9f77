//! Unions, intersections and differences: rays cross their surfaces where membership of points changes, and nowhere else.

use catoptric_scene::{Anchor, Body, BodyPart, Color, Falloff, Form, MaterialChoice, Placement, Shape};
use catoptric_tracer::{Ray, RayIntersection, RayOrigin, RenderScene};
use glam::{DAffine3, DVec3};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use crate::proof::common::oracle::Oracle;
use crate::proof::common::textbook::{crossings, implicit};
use crate::proof::common::*;
use crate::proof::random;

/// A part that is made of what the whole is made of.
fn part(shape: Shape, position: DVec3) -> BodyPart {
    BodyPart { shape, placement: Placement::at(position), ..BodyPart::default() }
}

fn joined(shape: Shape, parts: Vec<BodyPart>, material: MaterialChoice) -> Body {
    Body { shape, parts, material, ..Body::default() }
}

fn difference_of(parts: Vec<BodyPart>) -> BodyPart {
    BodyPart { parts, ..part(Shape::Difference, DVec3::ZERO) }
}

fn glowing(color: Color) -> MaterialChoice {
    MaterialChoice::own(glow(color))
}

/// Whether a point lies in a body, by the definition of its operation.
fn contains(form: &Form<'_>, around: DAffine3, point: DVec3) -> bool {
    let frame = around * form.placement.world_from_body();
    let mut parts = form.parts.iter().map(|part| contains(&part.form(), frame, point));
    match form.shape {
        Shape::Union | Shape::Group => parts.any(|is_in| is_in),
        Shape::Intersection => parts.all(|is_in| is_in),
        Shape::Difference => parts.next().unwrap_or_default() && !parts.any(|is_in| is_in),
        shape => implicit(&shape, frame.inverse().transform_point3(point)) < 0.0,
    }
}

/// Where a line from outside crosses the surface of a body, and whether it enters there: each crossing of a part after
/// which membership is another than before. `None` if two of them are too near to each other to tell their order.
fn expected(body: &Body, origin: DVec3, direction: DVec3) -> Option<Vec<(f64, bool)>> {
    let mut ts = Vec::new();
    body.form().each_simple(DAffine3::IDENTITY, &mut |part| {
        let inverse = part.frame.inverse();
        let (o, d) = (inverse.transform_point3(origin), inverse.transform_vector3(direction));
        ts.extend(crossings(&part.shape, o, d).into_iter().map(|(t, _)| t));
    });
    ts.sort_by(f64::total_cmp);
    ts.retain(|&t| t > 0.0);
    if ts.windows(2).any(|pair| pair[1] - pair[0] < 2e-3) {
        return None;
    }
    let is_in = |t: f64| contains(&body.form(), DAffine3::IDENTITY, origin + t * direction);
    let sides = ts.iter().map(|&t| (t, is_in(t - 1e-3), is_in(t + 1e-3)));
    Some(sides.filter(|(_, before, after)| before != after).map(|(t, _, after)| (t, after)).collect())
}

/// The ray on the other side of a surface that it met.
fn beyond(hit: &RayIntersection, ray: &Ray) -> Ray {
    let start = RayOrigin { body: hit.hit.body, inwards: !hit.hit.leaving };
    Ray { origin: hit.position.as_vec3a(), start, ..*ray }
}

/// Where a ray crosses surfaces one after another, each time as a ray that starts from the last one.
fn crossed(scene: &RenderScene, mut ray: Ray) -> Vec<f64> {
    let start = ray.origin.as_dvec3();
    let mut found = Vec::new();
    while let Some(hit) = scene.closest_hit(&ray) {
        found.push(hit.position.distance(start));
        assert!(found.len() <= 200, "a ray goes on for ever");
        ray = beyond(&hit, &ray);
    }
    found
}

/// Random trees of bodies near the origin.
fn tree(depth: u32) -> impl Strategy<Value = BodyPart> {
    let leaf = random::body().prop_map(|body| BodyPart {
        shape: body.shape,
        placement: body.placement.moved_by(-DVec3::Y),
        ..BodyPart::default()
    });
    leaf.prop_recursive(depth, 24, 4, |inner| {
        let shape = prop_oneof![Just(Shape::Union), Just(Shape::Intersection), Just(Shape::Difference)];
        let turn = prop::array::uniform3(-180.0..180.0_f64).prop_map(DVec3::from);
        let scale = prop_oneof![
            2 => (0.6..1.5_f64).prop_map(DVec3::splat),
            1 => prop::array::uniform3(0.6..1.5_f64).prop_map(DVec3::from)
        ];
        (shape, turn, scale, prop::collection::vec(inner, 2..4)).prop_map(
            |(shape, rotation_degrees, scale, parts)| BodyPart {
                shape,
                placement: Placement {
                    anchor: Anchor::Frame { position: DVec3::ZERO, rotation_degrees },
                    scale,
                },
                parts,
                ..BodyPart::default()
            },
        )
    })
}

fn body_of(part: BodyPart) -> Body {
    let BodyPart { shape, placement, parts, .. } = part;
    Body { shape, placement, parts, ..Body::default() }
}

fn rays() -> impl Strategy<Value = Vec<(DVec3, DVec3)>> {
    let on_ball = prop::array::uniform3(-1.0..1.0_f64).prop_map(|at| DVec3::from(at).normalize_or(DVec3::X));
    let aim = prop::array::uniform3(-1.5..1.5_f64).prop_map(DVec3::from);
    let ray = (on_ball, aim).prop_map(|(from, aim)| {
        // A start and a direction that single precision has.
        let start = (12.0 * from).as_vec3();
        (start.as_dvec3(), (aim - start.as_dvec3()).normalize())
    });
    prop::collection::vec(ray, 40)
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn random_trees_are_crossed_where_membership_changes(part in tree(6), rays in rays()) {
        let body = body_of(part);
        let scene = stage_of(vec![body.clone()]);
        for (origin, direction) in rays {
            let Some(expected) = expected(&body, origin, direction) else { continue };
            let found = crossed(&scene, ray(origin, direction));
            let is_near = |(found, (t, _)): (&f64, &(f64, bool))| (found - t).abs() < 1e-3;
            prop_assert!(
                found.len() == expected.len() && found.iter().zip(&expected).all(is_near),
                "{found:?} instead of {expected:?} from {origin} along {direction}"
            );
        }
    }
}

/// Bodies with a face in common, cut out of each other: a hole has no skin.
#[test]
fn what_is_cut_away_to_a_common_face_leaves_no_film() {
    let frames = [
        (DVec3::ZERO, 1.0, DVec3::ZERO),
        (v(17.0, -42.0, 11.0), 0.01, v(0.7, 0.1, 0.3)),
        (v(5.0, 77.0, -9.0), 1000.0, v(-300.0, 9000.0, 1234.5)),
    ];
    for (rotation_degrees, scale, position) in frames {
        let block = part(Shape::Cube { size: v(2.0, 1.0, 2.0) }, v(0.0, 0.5, 0.0));
        let hole = part(Shape::Cylinder { radius: 0.6, height: 1.0 }, DVec3::ZERO);
        let slot = part(Shape::Cube { size: v(0.4, 1.0, 2.0) }, v(0.8, 0.5, 0.0));
        let anchor = Anchor::Frame { position, rotation_degrees };
        let placement = Placement { anchor, scale: DVec3::splat(scale) };
        let body =
            Body { placement, ..joined(Shape::Difference, vec![block, hole, slot], glowing(Color::WHITE)) };
        let frame = placement.world_from_body();
        let scene = stage_of(vec![body]);
        let count = |from: DVec3, to: DVec3| {
            let [from, to] = [from, to].map(|point| frame.transform_point3(point));
            crossed(&scene, ray(from, to - from)).len()
        };
        for step in 0..40 {
            let angle = f64::from(step) * 0.157;
            for radius in [0.0, 0.2, 0.59] {
                let at = v(radius * angle.cos(), 0.0, radius * angle.sin());
                assert_eq!(count(at + v(0.0, 3.0, 0.0), at), 0, "down the hole at {at}, {scale}");
                assert_eq!(count(at - v(0.0, 3.0, 0.0), at), 0, "up the hole at {at}");
            }
            let at = v(0.61 * angle.cos(), 0.0, 0.61 * angle.sin());
            if at.x < 0.59 {
                assert_eq!(count(at + v(0.0, 3.0, 0.0), at), 2, "through the rim at {at}");
            }
            // Along the slot, and across it.
            let height = 0.02 + 0.024 * f64::from(step);
            assert_eq!(count(v(0.8, height, 5.0), v(0.75, height, 0.0)), 0, "along the slot");
            assert_eq!(count(v(5.0, height, 0.95), v(0.0, height, 0.9)), 2, "across the slot");
        }
    }
}

/// Parts that touch are one body: no ray within notices where one ends and the other begins.
#[test]
fn parts_that_touch_have_no_seam() {
    let halves = [-1.0, 1.0].map(|side| part(Shape::Cube { size: v(2.0, 2.0, 2.0) }, v(side, 0.0, 0.0)));
    let scene = stage_of(vec![joined(Shape::Union, halves.to_vec(), MaterialChoice::own(glass(1.5)))]);
    let whole = stage_of(vec![block(v(4.0, 2.0, 2.0), DVec3::ZERO, glass(1.5))]);
    for step in 0..50 {
        let angle = 0.02 * f64::from(step);
        let primary = ray(v(-6.0, 0.3, 0.1), v(angle.cos(), 0.3 * angle.sin(), 0.2 * angle.sin()));
        let [joined, whole] = [&scene, &whole].map(|scene| chain(scene, primary));
        assert_eq!(joined.len(), whole.len(), "at {angle}");
        for (joined, whole) in joined.iter().zip(&whole) {
            assert_vec_close(direction(joined), direction(whole), 1e-6);
        }
    }
    // From within, across the seam, at any slope.
    for step in 1..200 {
        let angle = 0.0078 * f64::from(step);
        let found = crossed(&scene, ray(v(-0.5, 0.0, 0.0), v(angle.cos(), angle.sin(), 0.0)));
        assert_eq!(found.len(), 1, "{found:?}");
    }
}

/// The laws of De Morgan and the distributive laws, as equal pictures.
#[test]
fn laws_of_sets_give_equal_pictures() {
    let a = || part(Shape::Cube { size: DVec3::splat(1.6) }, DVec3::ZERO);
    let b = || part(Shape::Sphere { radius: 0.8 }, v(0.5, 0.5, 0.4));
    let c = || part(Shape::Cylinder { radius: 0.5, height: 3.0 }, v(0.0, -1.5, 0.1));
    let of = |shape: Shape, parts: Vec<BodyPart>| BodyPart { shape, parts, ..BodyPart::default() };
    use Shape::{Difference, Intersection, Union};
    let laws = [
        // A − (B ∪ C) = (A − B) ∩ (A − C) = (A − B) − C.
        vec![
            of(Difference, vec![a(), of(Union, vec![b(), c()])]),
            of(Intersection, vec![of(Difference, vec![a(), b()]), of(Difference, vec![a(), c()])]),
            of(Difference, vec![of(Difference, vec![a(), b()]), c()]),
            of(Difference, vec![a(), b(), c()]),
        ],
        // A − (B ∩ C) = (A − B) ∪ (A − C).
        vec![
            of(Difference, vec![a(), of(Intersection, vec![b(), c()])]),
            of(Union, vec![of(Difference, vec![a(), b()]), of(Difference, vec![a(), c()])]),
        ],
        // A ∩ (B ∪ C) = (A ∩ B) ∪ (A ∩ C).
        vec![
            of(Intersection, vec![a(), of(Union, vec![b(), c()])]),
            of(Union, vec![of(Intersection, vec![a(), b()]), of(Intersection, vec![a(), c()])]),
        ],
        // A − (A − B) = A ∩ B.
        vec![of(Difference, vec![a(), of(Difference, vec![a(), b()])]), of(Intersection, vec![a(), b()])],
    ];
    for forms in laws {
        for material in
            [MaterialChoice::own(chalk()), MaterialChoice::own(glass(1.4)), MaterialChoice::own(mirror())]
        {
            let pictures = forms.iter().map(|form| {
                let body = Body { material: material.clone(), ..body_of(form.clone()) };
                let mut scene = scene(vec![body, plane(v(0.0, -1.6, 0.0), 0.0, glow(Color::gray(0.4)))]);
                scene.environment.background = Color::from([0.2, 0.4, 0.7]);
                scene.camera = camera(v(2.1, 2.3, 3.7), v(0.0, 0.1, 0.0), 40.0);
                scene.lights = vec![light(v(3.0, 6.0, 4.0), 1.0, Falloff::None)];
                picture(&scene, 160, 120)
            });
            let pictures: Vec<_> = pictures.collect();
            for other in &pictures[1..] {
                assert_same_picture(&pictures[0], other, 0.001);
            }
        }
    }
}

/// The cut surface is made of what cut it; the rest of what the part is made of, or the whole.
#[test]
fn a_surface_has_the_material_of_the_part_that_made_it() {
    let [red, green] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let cut = BodyPart {
        material: Some(glowing(Color::from(green))),
        ..part(Shape::Sphere { radius: 0.7 }, v(0.0, 0.0, 1.0))
    };
    let parts = vec![part(Shape::Cube { size: DVec3::splat(2.0) }, DVec3::ZERO), cut];
    let scene = stage_of(vec![joined(Shape::Difference, parts, glowing(Color::from(red)))]);
    let light = |x: f64| light_along(&scene, ray(v(x, 0.0, 5.0), DVec3::NEG_Z));
    assert_light(light(0.0), green);
    assert_light(light(0.6), green);
    assert_light(light(0.8), red);
}

/// Where parts have a face in common, it is the first one's that makes the surface, from whichever side it is met.
#[test]
fn of_parts_with_a_face_in_common_the_first_makes_the_surface() {
    let slab = |size: DVec3, z: f64| part(Shape::Cube { size }, v(0.0, 0.0, z));
    let thick = slab(DVec3::splat(1.0), 0.0);
    let wide = slab(v(2.0, 0.5, 1.0), 0.0);
    // The shape, its parts, and the numbers of those that make the faces at the greater and the lesser z.
    let cases: [(Shape, Vec<BodyPart>, [u32; 2]); 6] = [
        (Shape::Intersection, vec![thick.clone(), wide.clone()], [0, 0]),
        (Shape::Intersection, vec![wide.clone(), thick.clone()], [0, 0]),
        (Shape::Union, vec![wide.clone(), thick.clone()], [0, 0]),
        // Two that cut to the same depth from above.
        (
            Shape::Difference,
            vec![thick.clone(), slab(v(0.5, 0.5, 1.0), 0.6), slab(v(0.4, 0.6, 0.8), 0.5)],
            [1, 0],
        ),
        // Those that only touch take nothing away.
        (Shape::Difference, vec![thick.clone(), slab(DVec3::ONE, 1.0), slab(DVec3::ONE, -1.0)], [0, 0]),
        (Shape::Intersection, vec![difference_of(vec![thick, slab(DVec3::ONE, 1.0)]), wide], [0, 0]),
    ];
    for (shape, parts, expected) in cases {
        let scene = stage_of(vec![joined(shape, parts.clone(), glowing(Color::WHITE))]);
        let through = |z: f64| {
            let mut ray = ray(v(0.03, 0.05, z), DVec3::Z * -z);
            [(); 2].map(|()| {
                let hit = scene.closest_hit(&ray).expect("two faces are met");
                ray = beyond(&hit, &ray);
                hit.hit.body
            })
        };
        let [[upper, lower], [lower_too, upper_too]] = [through(4.0), through(-4.0)];
        // In the tracer's list, parts follow the whole.
        assert_eq!([upper, lower], expected.map(|number| number + 1), "{shape:?} {parts:?}");
        assert_eq!([upper_too, lower_too], [upper, lower], "from the other side: {shape:?} {parts:?}");
    }
}

/// A bowl of mirrors: a ray reflected within the cavity meets its far side, as often as geometry has it.
#[test]
fn a_cavity_reflects_within_itself() {
    let cavity = part(Shape::Sphere { radius: 1.0 }, DVec3::ZERO);
    let block = part(Shape::Cube { size: v(4.0, 2.0, 4.0) }, v(0.0, -1.0, 0.0));
    let scene = stage_of(vec![joined(Shape::Difference, vec![block, cavity], MaterialChoice::own(mirror()))]);
    // Down along a chord that is a side of a regular polygon with 2k sides: it meets k points of the half circle.
    for sides in [3, 4, 6, 9] {
        let half = std::f64::consts::PI / (2.0 * f64::from(sides));
        let x = half.cos() + 1e-4 - 1e-4;
        let path = chain(&scene, ray(v(x, 3.0, 0.0), DVec3::NEG_Y));
        assert_eq!(path.len(), sides as usize + 1, "{sides}");
        let last = direction(&path[sides as usize]);
        assert_vec_close(last, DVec3::Y, 2e-5 * f64::from(sides));
    }
}

/// A ball with a bubble in it, as one body, and as two of nested media.
#[test]
fn a_shell_is_the_same_joined_or_nested() {
    let ball = |radius: f64| part(Shape::Sphere { radius }, v(0.1, 0.2, 0.0));
    let shell = joined(Shape::Difference, vec![ball(1.0), ball(0.8)], MaterialChoice::own(glass(1.5)));
    let outer = body(Shape::Sphere { radius: 1.0 }, v(0.1, 0.2, 0.0), glass(1.5));
    let inner = body(Shape::Sphere { radius: 0.8 }, v(0.1, 0.2, 0.0), glass(1.0));
    let [one, two] = [vec![shell], vec![outer, inner]].map(|bodies| {
        let mut scene = scene(bodies);
        scene.bodies.push(plane(v(0.0, -1.6, 0.0), 0.0, chalk()));
        scene.environment.background = Color::from([0.2, 0.4, 0.7]);
        scene.camera = camera(v(0.0, 1.0, 5.0), DVec3::ZERO, 40.0);
        scene.lights = vec![light(v(3.0, 6.0, 4.0), 1.0, Falloff::None)];
        picture(&scene, 200, 150)
    });
    assert_same_picture(&one, &two, 0.0005);
}

/// Groups are their members, wherever they stand.
#[test]
fn a_group_is_its_members() {
    let members = || {
        vec![
            part(Shape::Sphere { radius: 0.5 }, v(-0.6, 0.0, 0.0)),
            part(Shape::Cube { size: DVec3::ONE }, v(0.6, 0.0, 0.0)),
        ]
    };
    let anchor = Anchor::Frame { position: v(0.2, 0.3, -0.4), rotation_degrees: v(0.0, 30.0, 0.0) };
    let placement = Placement { anchor, scale: DVec3::splat(1.3) };
    let group = Body { placement, ..joined(Shape::Group, members(), MaterialChoice::own(chalk())) };
    let apart = members().into_iter().map(|member| {
        let at = placement.world_from_body().transform_point3(member.placement.origin());
        let anchor = Anchor::Frame { position: at, rotation_degrees: v(0.0, 30.0, 0.0) };
        placed(member.shape, Placement { anchor, scale: DVec3::splat(1.3) }, chalk())
    });
    let [one, two] = [vec![group], apart.collect()].map(|bodies| {
        let mut scene = scene(bodies);
        scene.camera = camera(v(0.0, 1.0, 5.0), DVec3::ZERO, 40.0);
        scene.lights = vec![light(v(3.0, 6.0, 4.0), 1.0, Falloff::None)];
        picture(&scene, 120, 90)
    });
    assert_same_picture(&one, &two, 0.0005);
}

/// A large group is prepared by several threads: each part has its number, its place and its material.
#[test]
fn all_members_of_a_large_group_are_met() {
    let grid = |count: usize| (0..count).map(|at| v((at % 70) as f64, 0.0, (at / 70) as f64));
    let balls = |at: DVec3| part(Shape::Sphere { radius: 0.1 }, at);
    let pairs = |at: DVec3| BodyPart {
        parts: vec![balls(v(-0.2, 0.0, 0.0)), balls(v(0.2, 0.0, 0.0))],
        ..part(Shape::Union, at)
    };
    let group = |x: f64, parts: Vec<BodyPart>| BodyPart { parts, ..part(Shape::Group, v(x, 0.0, 0.0)) };
    let own =
        BodyPart { material: Some(MaterialChoice::own(glow(Color::WHITE))), ..balls(v(-1.0, 0.0, 0.0)) };
    let large = group(100.0, grid(3000).map(pairs).chain([own]).collect());
    let members = vec![
        balls(v(-5.0, 0.0, 0.0)),
        group(0.0, grid(5000).map(balls).collect()),
        group(0.0, vec![large, balls(v(-6.0, 0.0, 0.0))]),
        pairs(v(-7.0, 0.0, 0.0)),
    ];
    let whole = joined(Shape::Group, members, MaterialChoice::own(chalk()));
    let scene = scene(vec![body(Shape::Sphere { radius: 0.1 }, v(-9.0, 0.0, 0.0), chalk()), whole]);
    let render_scene = RenderScene::build(&scene).unwrap();
    let mut number = 0;
    scene.bodies[1].form().each_simple(DAffine3::IDENTITY, &mut |simple| {
        let ray = ray(simple.frame.translation + DVec3::Y, DVec3::NEG_Y);
        let found = render_scene.closest_hit(&ray).unwrap();
        assert_eq!((found.body, found.part), (1, Some(number)));
        assert!((found.position.y - 0.1).abs() < 1e-4);
        number += 1;
    });
    assert_eq!(number, 1 + 5000 + 6001 + 1 + 2);
}

/// What is empty is not there, and does not harm.
#[test]
fn empty_bodies_are_not_seen() {
    let ball = |x: f64| part(Shape::Sphere { radius: 1.0 }, v(x, 0.0, 0.0));
    let big = part(Shape::Sphere { radius: 3.0 }, DVec3::ZERO);
    let cases = [
        joined(Shape::Intersection, vec![ball(-3.0), ball(3.0)], glowing(Color::WHITE)),
        joined(Shape::Difference, vec![ball(0.0), big], glowing(Color::WHITE)),
        joined(Shape::Difference, vec![ball(0.0), ball(0.0)], glowing(Color::WHITE)),
        joined(Shape::Union, Vec::new(), glowing(Color::WHITE)),
        joined(Shape::Group, Vec::new(), glowing(Color::WHITE)),
    ];
    for body in cases {
        let scene = stage_of(vec![body.clone()]);
        for step in 0..60 {
            let at = v(0.0, 1.2, 0.0) - v(0.0, 0.04, 0.0) * f64::from(step);
            assert_eq!(
                crossed(&scene, ray(v(0.0, 0.0, 8.0), at - v(0.0, 0.0, 8.0))),
                [0.0; 0],
                "{:?}",
                body.shape
            );
        }
    }
}

/// A half-space is a part like others.
#[test]
fn planes_cut_what_they_are_joined_with() {
    let ball = part(Shape::Sphere { radius: 1.0 }, DVec3::ZERO);
    let below = part(Shape::Plane, v(0.0, 0.25, 0.0));
    let dome =
        stage_of(vec![joined(Shape::Difference, vec![ball.clone(), below.clone()], glowing(Color::WHITE))]);
    let bowl = stage_of(vec![joined(Shape::Intersection, vec![ball, below], glowing(Color::WHITE))]);
    let down = |scene: &RenderScene| crossed(scene, ray(v(0.0, 5.0, 0.0), DVec3::NEG_Y));
    let [dome, bowl] = [down(&dome), down(&bowl)];
    for (found, expected) in [(dome, [4.0, 4.75]), (bowl, [4.75, 6.0])] {
        assert_eq!(found.len(), 2);
        assert_close(found[0], expected[0], 1e-6);
        assert_close(found[1], expected[1], 1e-6);
    }
    // Along its surface a line lies within a half-space, or outside of it.
    let slab = part(Shape::Cube { size: v(2.0, 2.0, 2.0) }, DVec3::ZERO);
    let lower = stage_of(vec![joined(
        Shape::Intersection,
        vec![slab, part(Shape::Plane, v(0.0, 0.25, 0.0))],
        glowing(Color::WHITE),
    )]);
    for (y, count) in [(-0.5, 2), (0.0, 2), (0.2, 2), (0.3, 0), (0.9, 0)] {
        assert_eq!(crossed(&lower, ray(v(5.0, y, 0.1), DVec3::NEG_X)).len(), count, "at {y}");
    }
    // A plane with a round hole has no end.
    let sheet = stage_of(vec![joined(
        Shape::Difference,
        vec![part(Shape::Plane, DVec3::ZERO), part(Shape::Sphere { radius: 1.0 }, DVec3::ZERO)],
        glowing(Color::WHITE),
    )]);
    let at = |x: f64| crossed(&sheet, ray(v(x, 5.0, 0.0), DVec3::NEG_Y));
    assert_close(at(0.0)[0], 6.0, 1e-6);
    assert_close(at(3000.0)[0], 5.0, 1e-4);
}

/// Many bodies go by the hierarchy and by streams, and give what few give.
#[test]
fn many_joined_bodies_are_each_seen_as_one_alone() {
    let lens = |at: DVec3| {
        let side = |z: f64| part(Shape::Sphere { radius: 1.0 }, v(0.0, 0.0, z));
        Body {
            placement: Placement::at(at),
            ..joined(Shape::Intersection, vec![side(-0.8), side(0.8)], MaterialChoice::own(glass(1.5)))
        }
    };
    let all: Vec<Body> =
        (0..200).map(|i| lens(v(f64::from(i % 20) * 1.5, f64::from(i / 20) * 1.5, 0.0))).collect();
    let few = all[105..106].to_vec();
    let [many, one] = [all, few].map(|bodies| {
        let mut scene = scene(bodies);
        scene.environment.surroundings = catoptric_scene::Surroundings::Sky(catoptric_scene::Sky::default());
        scene.camera = camera(v(7.5, 7.5, 6.0), v(7.5, 7.5, 0.0), 8.0);
        scene
    });
    assert_same_picture(&picture(&many, 96, 96), &picture(&one, 96, 96), 0.0);
}

/// Joined bodies of every material among others, with shadows, media and reflections, against the oracle.
#[test]
fn random_joined_scenes_agree_with_the_oracle() {
    let body = (tree(2), random::material(), prop::array::uniform3(-1.5..1.5_f64)).prop_map(
        |(part, material, at)| {
            let mut body = body_of(part);
            body.placement = body.placement.moved_by(DVec3::from(at) + DVec3::Y);
            Body { material: MaterialChoice::own(material), ..body }
        },
    );
    let bodies = (prop::collection::vec(body, 1..5), prop::collection::vec(random::body(), 0..4));
    let config = cases(40);
    let count = config.cases;
    let mut runner = TestRunner::new(config);
    let (mut off, mut total) = (0, 0);
    for number in 0..count {
        let (mut joined, others) = bodies.new_tree(&mut runner).unwrap().current();
        joined.extend(others);
        joined.push(plane(v(0.0, -1.0, 0.0), 0.0, chalk()));
        let mut scene = scene(joined);
        scene.lights =
            vec![light(v(3.0, 6.0, 4.0), 0.8, Falloff::None), light(v(-5.0, 4.0, 1.0), 0.4, Falloff::None)];
        scene.camera = camera(v(1.5, 2.0, 6.5), v(0.0, 0.8, 0.0), 35.0);
        scene.environment.background = Color::from([0.2, 0.4, 0.7]);
        scene.tracing.generations = 5;
        let (ours, truth) = (picture(&scene, 64, 48), Oracle::new(&scene, 10.0).picture(64, 48));
        let comparison = catoptric_picture::Comparison { clamp: false, ..Default::default() };
        let difference = comparison.compare(&ours, &truth).unwrap();
        assert!(
            difference.above <= 9,
            "scene {number}: {} pixels are off, the worst at {:?} by {}\n{scene:#?}",
            difference.above,
            difference.worst,
            difference.max,
        );
        off += difference.above;
        total += ours.pixels().len();
    }
    let share = off as f64 / total as f64;
    println!("{off} of {total} pixels are off ({:.4} %)", 100.0 * share);
    assert!(share < 0.001, "{off} of {total} pixels are off");
}
