//! Cemented bodies: where they touch there is one interface from the medium of the one to that of the other, or none.

mod air;

use catoptric_picture::Picture;
use catoptric_scene::{
    Attenuation, Body, BodyContact, BodyPart, Color, Contact, Dielectric, Falloff, Instance, Material,
    MaterialChoice, Pattern, Phong, Placement, RefractiveIndex, Scene, Shape, SolidTexture, read,
};
use catoptric_tracer::{RayRecord, RenderScene};
use glam::{DVec3, Vec3};
use proptest::prelude::*;

use crate::proof::common::{
    assert_close, assert_same_picture, ball, block, body, camera, cases, chain, chalk, direction, glass,
    glow, light, picture, plane, ray, render_scene, scene, tree, turned, v,
};

/// The scene with cement wherever bodies touch.
fn cemented(mut scene: Scene) -> Scene {
    scene.environment.contact = Contact::Cemented;
    scene
}

fn stage(bodies: Vec<Body>) -> RenderScene {
    render_scene(&cemented(scene(bodies)))
}

fn clear(ior: f64) -> Dielectric {
    Dielectric { index: ior.into(), ..Dielectric::default() }
}

fn stained(ior: f64) -> Dielectric {
    let attenuation = Attenuation { color: Color::new(0.3, 0.8, 0.6), distance: 0.7 };
    Dielectric { attenuation, ..clear(ior) }
}

fn colorful(ior: f64, abbe: f64) -> Dielectric {
    Dielectric { index: RefractiveIndex::Own { ior, abbe }, dispersion: true, ..Dielectric::default() }
}

/// Has all terms of Phong's model, and reflects and lets through under every angle.
fn milky(ior: f64) -> Phong {
    let reflection = Some(0.2);
    Phong { ambient: 0.2, diffuse: 0.3, specular: 0.4, reflection, transmission: 0.7, ..glass(ior) }
}

/// A checkered floor below, a light above and the bodies between.
fn on_show(bodies: impl IntoIterator<Item = Body>) -> Scene {
    let solid = SolidTexture { size: 0.7, ..SolidTexture::default() };
    let pattern = Pattern { solid: Some(solid), ..Color::new(0.9, 0.8, 0.3).into() };
    let floor = plane(v(0.0, -1.3, 0.0), 0.0, Phong { pattern, ambient: 0.3, ..chalk() });
    let mut scene = scene(bodies.into_iter().chain([floor]).collect());
    scene.environment.background = Color::new(0.3, 0.5, 0.9);
    scene.camera = camera(v(1.9, 2.3, 4.1), DVec3::ZERO, 32.0);
    scene.lights = vec![light(v(-3.0, 6.0, 2.5), 1.0, Falloff::None)];
    scene.tracing.generations = 7;
    scene
}

/// Asserts that no more than a share of the pixels differ by more than a few digits of single precision: those at edges,
/// where rounding decides what is met.
#[track_caller]
fn assert_equal_but_for_rounding(one: &Picture, other: &Picture, share: f64) {
    let values = |picture: &Picture| picture.pixels().to_vec();
    let (one, other) = (values(one), values(other));
    let is_off =
        |(a, b): &(&[f32; 3], &[f32; 3])| (Vec3::from(**a) - Vec3::from(**b)).abs().max_element() > 2e-5;
    let off = one.iter().zip(&other).filter(is_off).count();
    assert!(off as f64 <= share * one.len() as f64, "{off} of {} pixels differ", one.len());
}

/// How many pixels of two pictures are more than 1/255 apart, as a share.
fn apart(one: &Picture, other: &Picture) -> f64 {
    let comparison = catoptric_picture::Comparison { clamp: false, ..Default::default() };
    comparison.compare(one, other).unwrap().share_above
}

/// The turn of all slabs, degrees, so that no face is parallel to an axis.
const TURN: DVec3 = DVec3::new(11.0, 27.0, -8.0);

/// A slab of two pieces, side by side with `gap` between them, and the same slab in one piece.
fn slabs(material: &Material, scale: f64, gap: f64) -> [Vec<Body>; 2] {
    let piece = |x: f64, width: f64| {
        let at = Placement {
            anchor: turned(Shape::Plane, DVec3::ZERO, TURN, chalk()).placement.anchor,
            scale: DVec3::ONE,
        };
        let at = at.world_from_body().transform_point3(scale * v(x, 0.0, 0.0));
        turned(Shape::Cube { size: scale * v(width, 0.8, 1.1) }, at, TURN, material.clone())
    };
    [vec![piece(-0.5 - 0.5 * gap / scale, 1.0), piece(0.4 + 0.5 * gap / scale, 0.8)], vec![piece(-0.1, 1.8)]]
}

/// Numbers that are off by their rounding, at any scale and place, are no gap and no overlap.
#[test]
fn nearly_touching_is_touching() {
    for scale in [1e-2, 1.0, 30.0] {
        for place in [DVec3::ZERO, v(3.0, -2.0, 7.0)] {
            let take = |gap: f64, is_cemented: bool| {
                let [mut two, mut one] = slabs(&clear(1.5).into(), scale, gap);
                for body in two.iter_mut().chain(&mut one) {
                    body.placement = body.placement.moved_by(scale * place);
                }
                let take = |bodies: Vec<Body>| {
                    let mut scene = scene(bodies);
                    scene.environment.background = Color::new(0.3, 0.5, 0.9);
                    let center = scale * place;
                    scene.camera = camera(center + scale * v(1.9, 2.3, 4.1), center, 32.0);
                    picture(&if is_cemented { cemented(scene) } else { scene }, 60, 45)
                };
                (take(two), take(one))
            };
            for gap in [0.0, 1e-9, -1e-9, 3e-8, -3e-8].map(|gap| gap * scale) {
                let (two, one) = take(gap, true);
                assert_equal_but_for_rounding(&two, &one, 0.004);
            }
            // A hundred times the bound is a gap, whatever the scene says.
            let (two, _) = take(1e-3 * scale, true);
            let (open, _) = take(1e-3 * scale, false);
            assert!(two == open, "at {place}, scale {scale}");
        }
    }
}

/// The choice of the scene and of both bodies, and what it makes of a contact.
#[test]
fn contacts_are_what_bodies_and_scene_say() {
    for of_scene in Contact::ALL {
        for upper in BodyContact::ALL {
            for lower in BodyContact::ALL {
                let slab = |y: f64, ior: f64, contact: BodyContact| Body {
                    contact,
                    ..block(v(9.0, 1.0, 9.0), v(0.0, y, 0.0), glass(ior))
                };
                let mut scene = scene(vec![slab(0.5, 1.5, upper), slab(-0.5, 1.8, lower)]);
                scene.environment.contact = of_scene;
                let path = chain(&render_scene(&scene), ray(v(0.0, 3.0, 0.0), v(0.3, -1.0, 0.1)));
                let is_cemented = of_scene.between(upper, lower) == Contact::Cemented;
                assert_eq!(path.len(), if is_cemented { 4 } else { 5 }, "{of_scene:?} {upper:?} {lower:?}");
            }
        }
    }
}

/// A lens by its keys, standing with its middle at `height`.
fn lens([front, back]: [f64; 2], thickness: f64, height: f64, ior: f64) -> Body {
    let text = format!(
        "format = \"catoptric/1\"\n[[bodies]]\nshape = \"lens\"\nradius = 0.45\nthickness = {thickness:?}\n\
         front_radius = {front:?}\nback_radius = {back:?}\nposition = [0.0, {height:?}, 0.0]\n"
    );
    let scene = read(&text).into_result().expect("the keys are right").value;
    Body { material: MaterialChoice::own(glass(ior)), ..scene.bodies[0].clone() }
}

/// Three faces and two glasses.
const DOUBLETS: [([f64; 3], [f64; 2], [f64; 2]); 6] = [
    ([1.2, -1.0, -4.0], [0.35, 0.15], [1.517, 1.62]),
    ([4.0, 1.0, -1.2], [0.15, 0.35], [1.62, 1.517]),
    ([1.5, -1.5, 0.0], [0.3, 0.2], [1.517, 1.617]),
    ([0.0, 0.9, 2.0], [0.2, 0.25], [1.8, 1.4]),
    ([-2.0, 1.1, -1.3], [0.2, 0.4], [1.7, 1.5]),
    ([1.6, -0.9, -1.1], [0.4, 0.2], [1.5, 1.5]),
];

/// Where the axis is met by a ray that comes along it at `height`, and its tangent to the axis, by Snell's law in double
/// precision, in the plane of the axis: from face to face.
fn traced_in_double(
    radii: [f64; 3],
    thicknesses: [f64; 2],
    [one, other]: [f64; 2],
    height: f64,
) -> (f64, f64) {
    let indices = [1.0, one, other, 1.0];
    let (mut x, mut y, mut angle) = (height, -5.0, 0.0_f64);
    let mut vertex = 0.0;
    for (face, radius) in radii.into_iter().enumerate() {
        let (sin, cos) = angle.sin_cos();
        let slope = if radius == 0.0 {
            x += (vertex - y) * sin / cos;
            y = vertex;
            0.0
        } else {
            // The root of |p + t·d − c|² = r² on the side of the vertex.
            let center = vertex + radius;
            let b = x * sin + (y - center) * cos;
            let c = x * x + (y - center) * (y - center) - radius * radius;
            let t = -b - radius.signum() * (b * b - c).sqrt();
            (x, y) = (x + t * sin, y + t * cos);
            (-x / radius).asin()
        };
        // The normal is turned by `slope` from the axis: n·sin of the angle to it stays.
        let incidence = angle - slope;
        angle = slope + (indices[face] / indices[face + 1] * incidence.sin()).asin();
        vertex += thicknesses.get(face).copied().unwrap_or_default();
    }
    (y - x / angle.tan(), -angle.tan())
}

/// A flush doublet has the focus of its three faces: near the axis by the matrices of paraxial optics (Hecht, Optics, 5th
/// ed., sec. 6.2), far from it by Snell's law. Light passes from glass to glass at once.
#[test]
fn a_flush_doublet_has_the_focus_of_its_matrices() {
    for (radii, thicknesses, indices) in DOUBLETS {
        let [first, second] = thicknesses;
        let bodies = vec![
            lens([radii[0], radii[1]], first, 0.5 * first, indices[0]),
            lens([radii[1], radii[2]], second, first + 0.5 * second, indices[1]),
        ];
        let scene = stage(bodies);
        let focus = |height: f64| {
            let path = chain(&scene, ray(v(height, -5.0, 0.0), v(0.0, 1.0, 0.0)));
            assert_eq!(path.len(), 4, "{radii:?}");
            let last = path.last().unwrap();
            let (from, along) = (scene.world_from_render(last.ray.origin), direction(last));
            (from.y - from.x * along.y / along.x, -along.x / along.y)
        };
        // (height, n·angle) after a face: the angle changes by the power times the height; after a way, the height.
        let all = [1.0, indices[0], indices[1], 1.0];
        let (mut x, mut bent) = (1.0, 0.0);
        for (face, radius) in radii.into_iter().enumerate() {
            bent -= if radius == 0.0 { 0.0 } else { (all[face + 1] - all[face]) / radius * x };
            x += thicknesses.get(face).map_or(0.0, |way| bent / all[face + 1] * way);
        }
        let (length, place) = (-1.0 / bent, first + second - x / bent);
        let limit = |of: &dyn Fn(f64) -> f64| (4.0 * of(0.005) - of(0.01)) / 3.0;
        let is_close = |traced: f64, exact: f64| (traced - exact).abs() < 1e-4 * length.abs();
        let traced = limit(&|height| height / focus(height).1);
        assert!(is_close(traced, length), "{radii:?}: {traced}, not {length}");
        let traced = limit(&|height| focus(height).0);
        assert!(is_close(traced, place), "{radii:?}: {traced}, not {place}");
        for height in [0.1, 0.2, 0.3] {
            let ((place, tangent), (exact_place, exact)) =
                (focus(height), traced_in_double(radii, thicknesses, indices, height));
            assert_close(tangent, exact, 3e-6);
            assert_close(place, exact_place, 3e-5 * (1.0 + exact_place.abs()) / exact.abs());
        }
    }
}

/// A glass with water in it that is as wide as the glass is within, and reaches beyond that by `overlap`.
fn glass_of_water(overlap: f64, is_first: bool) -> Vec<Body> {
    let cylinder = |radius: f64, base: f64, height: f64| BodyPart {
        shape: Shape::Cylinder { radius, height },
        placement: Placement::at(v(0.0, base, 0.0)),
        ..BodyPart::default()
    };
    let vessel = Body {
        shape: Shape::Difference,
        parts: vec![cylinder(0.7, -1.0, 1.9), cylinder(0.6, -0.85, 2.0)],
        material: MaterialChoice::own(clear(1.52)),
        ..Body::default()
    };
    let radius = 0.6 + overlap;
    let water = Shape::Cylinder { radius, height: 1.2 + overlap };
    let water = body(water, v(0.0, -0.85 - overlap, 0.0), stained(1.333));
    if is_first { vec![water, vessel] } else { vec![vessel, water] }
}

/// Without lights: shadow rays go straight, and cross two surfaces where bodies overlap.
#[test]
fn water_flush_with_its_glass_looks_as_with_an_overlap() {
    for is_first in [false, true] {
        let take = |overlap: f64| Scene { lights: Vec::new(), ..on_show(glass_of_water(overlap, is_first)) };
        let overlapping = picture(&take(1e-5), 120, 90);
        let flush = take(0.0);
        assert_same_picture(&picture(&cemented(flush.clone()), 120, 90), &overlapping, 0.004);
        assert!(apart(&picture(&flush, 120, 90), &overlapping) > 0.04);
        // Said by the water alone.
        let mut own = flush;
        own.bodies.get_mut(usize::from(!is_first)).unwrap().contact = BodyContact::Cemented;
        assert_same_picture(&picture(&own, 120, 90), &overlapping, 0.004);
    }
}

/// What is opaque is seen and lit through what is cemented to it as if that went on below, in any order of the file.
#[test]
fn water_on_a_painted_floor_has_no_film_below() {
    let floor = || plane(DVec3::ZERO, 0.0, chalk());
    let water = |depth: f64| block(v(40.0, 1.0 + depth, 40.0), v(0.0, 0.5 - 0.5 * depth, 0.0), clear(1.33));
    let table =
        |depth: f64| block(v(3.0, 1.0, 3.0), v(0.0, -0.5 - depth, 0.0), glow(Color::new(0.2, 0.9, 0.4)));
    let disc = |sign: f64| Body {
        shape: Shape::SURFACE,
        parts: vec![
            BodyPart { shape: Shape::Plane, ..BodyPart::default() },
            BodyPart { shape: Shape::Sphere { radius: 1.5 }, ..BodyPart::default() },
        ],
        placement: turned(Shape::Plane, DVec3::ZERO, v(90.0 - 90.0 * sign, 0.0, 0.0), chalk()).placement,
        material: MaterialChoice::own(glow(Color::new(0.9, 0.2, 0.4))),
        ..Body::default()
    };
    for order in [false, true] {
        for below in [floor(), table(0.0), disc(1.0), disc(-1.0)] {
            let take = |bodies: Vec<Body>| {
                let mut scene = on_show(bodies);
                scene.bodies.pop();
                let mut bodies: Vec<Body> = scene.bodies.iter().cloned().collect();
                if order {
                    bodies.reverse();
                }
                scene.bodies = bodies.into();
                scene
            };
            let flush = take(vec![water(0.0), below.clone()]);
            let sunk = take(vec![water(1e-4), below.clone()]);
            let [flush, sunk, open] = [cemented(flush.clone()), sunk, flush];
            // From within the water, under an angle at which a film would reflect everything.
            let from_within = ray(v(-1.2, 0.3, 0.1), v(1.0, -0.3, 0.0));
            let first = |scene: &Scene| tree(&render_scene(scene), from_within)[0].clone();
            let opaque = usize::from(!order);
            assert_eq!(first(&flush).hit.unwrap().body, opaque);
            assert_eq!(first(&flush).media, [usize::from(order)]);
            // Of a surface that is met from its inner side the order decides in any case.
            if below.shape != Shape::SURFACE {
                assert_ne!(first(&open).hit.unwrap().body, opaque);
            }
            assert!(first(&flush).light.abs_diff_eq(first(&sunk).light, 1e-4));
            assert_same_picture(&picture(&flush, 60, 45), &picture(&sunk, 60, 45), 0.004);
        }
    }
}

/// 216 cubes side by side are one: among so many, rays go through a hierarchy and by streams.
#[test]
fn many_cubes_are_one_cube() {
    let cubes = (0..216).map(|number| {
        let at = v(f64::from(number % 6), f64::from(number / 6 % 6), f64::from(number / 36)) - 2.5;
        block(DVec3::splat(0.3), 0.3 * at, stained(1.5))
    });
    let many = cemented(on_show(cubes));
    let one = on_show([block(DVec3::splat(1.8), DVec3::ZERO, stained(1.5))]);
    assert_equal_but_for_rounding(&picture(&many, 80, 60), &picture(&one, 80, 60), 0.01);
}

/// Members of a group, instances, parts of joined bodies: their contacts are those of bodies.
#[test]
fn members_instances_and_joined_bodies_are_cemented_too() {
    let half = |x: f64| BodyPart {
        shape: Shape::Cube { size: v(0.8, 0.9, 1.0) },
        placement: Placement::at(v(x, 0.0, 0.0)),
        ..BodyPart::default()
    };
    let whole = picture(&on_show([block(v(1.6, 0.9, 1.0), DVec3::ZERO, clear(1.5))]), 80, 60);
    let of_parts = |shape: Shape, at: f64, parts: Vec<BodyPart>| Body {
        name: "first".to_owned(),
        shape,
        parts,
        placement: Placement::at(v(at, 0.0, 0.0)),
        material: MaterialChoice::own(clear(1.5)),
        ..Body::default()
    };
    let group = of_parts(Shape::Group, 0.0, vec![half(-0.4), half(0.4)]);
    let quarter = |x: f64| BodyPart { shape: Shape::Cube { size: v(0.5, 0.9, 1.0) }, ..half(x) };
    let joined = |at: f64| of_parts(Shape::Union, at, vec![quarter(-0.15), quarter(0.15)]);
    let instance = Body {
        name: String::new(),
        placement: Placement::at(v(0.4, 0.0, 0.0)),
        instance: Some(Instance::new("first".to_owned(), false)),
        ..joined(0.4)
    };
    for bodies in [vec![group], vec![joined(-0.4), instance]] {
        let mut scene = on_show(bodies);
        scene.follow_instances();
        assert_equal_but_for_rounding(&picture(&cemented(scene.clone()), 80, 60), &whole, 0.003);
        assert!(apart(&picture(&scene, 80, 60), &whole) > 0.02);
        scene.bodies.get_mut(0).unwrap().contact = BodyContact::Cemented;
        assert_equal_but_for_rounding(&picture(&scene, 80, 60), &whole, 0.003);
    }
}

/// From within one half of a slab the other is seen as from within the whole.
#[test]
fn an_eye_in_a_slab_sees_no_joint() {
    let take = |bodies: Vec<Body>| {
        let mut scene = on_show(bodies);
        scene.camera = camera(v(-0.8, 0.1, 0.3), v(0.5, -0.2, 0.0), 60.0);
        picture(&cemented(scene), 80, 60)
    };
    let piece = |x: f64, width: f64| block(v(width, 1.0, 1.4), v(x, 0.0, 0.0), stained(1.5));
    let (two, one) = (take(vec![piece(-0.5, 1.0), piece(0.5, 1.0)]), take(vec![piece(0.0, 2.0)]));
    assert_equal_but_for_rounding(&two, &one, 0.01);
}

/// Three kinds of glass around one edge, and a coating thinner than rounding between two of them.
#[test]
fn three_bodies_are_joined_two_by_two() {
    let quarter = |x: f64, y: f64, ior: f64| block(v(4.0, 4.0, 8.0), v(x, y, 0.0), glass(ior));
    let scene = stage(vec![
        block(v(8.0, 4.0, 8.0), v(0.0, -2.0, 0.0), glass(1.5)),
        quarter(-2.0, 2.0, 1.7),
        quarter(2.0, 2.0, 1.33),
    ]);
    // Down through the third, the second by its side, and the first below.
    let path = chain(&scene, ray(v(3.0, 6.0, 0.0), v(-1.0, -0.9, 0.0)));
    let media: Vec<&[usize]> = path.iter().map(|ray| ray.media.as_slice()).collect();
    assert_eq!(media, [&[][..], &[2], &[1], &[0], &[]]);
    let contact = |ray: &RayRecord| {
        ray.answer.as_ref().unwrap().interface.unwrap().contact.map(|contact| contact.bodies)
    };
    assert_eq!(
        path.iter().take(4).map(contact).collect::<Vec<_>>(),
        [None, Some([2, 1]), Some([1, 0]), None]
    );
}

/// Shadow rays lose at a contact what its two sides make together: nothing between equal media.
#[test]
fn shadow_rays_cross_one_interface() {
    let reflectance = |one: f64, other: f64| ((one - other) / (one + other)).powi(2);
    let at_floor = |upper: Material, lower: Material| {
        let slab = |y: f64, material: Material| block(v(9.0, 1.0, 9.0), v(0.0, y, 0.0), material);
        let floor = plane(v(0.0, -0.5, 0.0), 0.0, chalk());
        let mut scene = cemented(scene(vec![slab(2.0, upper), slab(1.0, lower), floor]));
        scene.lights = vec![light(v(1.0, 9.0, 0.5), 1.0, Falloff::None)];
        let rays = tree(&render_scene(&scene), ray(v(0.0, 0.3, 0.0), v(0.0, -1.0, 0.0)));
        let shadow = rays[0].answer.as_ref().unwrap().lights[0].shadow.clone().unwrap();
        let product: Vec3 =
            shadow.crossings.iter().filter_map(|crossing| crossing.filter).product::<Vec3>() * shadow.through;
        assert!(product.abs_diff_eq(shadow.passed, 1e-6), "{product} {}", shadow.passed);
        (shadow.passed, shadow.crossings.len())
    };
    let two = [1.5, 1.8];
    let expected =
        (1.0 - reflectance(1.0, 1.5)) * (1.0 - reflectance(1.5, 1.8)) * (1.0 - reflectance(1.8, 1.0));
    for [upper, lower] in [two, [two[1], two[0]]] {
        let (passed, count) = at_floor(clear(upper).into(), clear(lower).into());
        assert_close(passed.x.into(), expected, 1e-6);
        assert_eq!(count, 3);
    }
    let (passed, _) = at_floor(clear(1.5).into(), clear(1.5).into());
    assert_close(passed.x.into(), (1.0 - reflectance(1.0, 1.5)).powi(2), 1e-6);
    let (passed, _) = at_floor(milky(1.5).into(), milky(1.5).into());
    assert_close(passed.x.into(), 0.49, 1e-6);
    // Of other indices the first of the file takes its share: the upper one.
    let (passed, _) = at_floor(Phong { transmission: 0.5, ..glass(1.5) }.into(), glass(1.3).into());
    assert_close(passed.x.into(), 0.25, 1e-6);
}

/// Rough glass of the same index beyond a contact is not rough there; of another index it is.
#[test]
fn a_joint_of_equal_media_is_not_rough() {
    let slab = |y: f64, ior: f64| {
        block(v(9.0, 1.0, 9.0), v(0.0, y, 0.0), Dielectric { roughness: 0.4, ..clear(ior) })
    };
    for (ior, is_rough) in [(1.5, false), (1.6, true)] {
        let scene = stage(vec![slab(0.5, 1.5), slab(-0.5, ior)]);
        let first = &tree(&scene, ray(v(0.0, 0.4, 0.0), v(0.3, -1.0, 0.0)))[0];
        let answer = first.answer.as_ref().unwrap();
        assert_eq!(answer.alpha > 0.0, is_rough);
        assert_eq!(answer.interface.unwrap().contact.unwrap().is_seamless, !is_rough);
        assert_eq!(answer.reflected.coefficient == Vec3::ZERO, !is_rough);
    }
}

/// Thin sheets keep their two faces, and what says air keeps its film.
#[test]
fn sheets_are_not_cemented() {
    let sheet = catoptric_scene::ThinDielectric::default();
    let bodies = vec![
        block(v(9.0, 1.0, 9.0), v(0.0, 0.5, 0.0), glass(1.5)),
        block(v(9.0, 1.0, 9.0), v(0.0, -0.5, 0.0), sheet),
    ];
    let down = ray(v(0.0, 0.4, 0.0), v(0.3, -1.0, 0.0));
    let open = tree(&render_scene(&scene(bodies.clone())), down);
    assert_eq!(tree(&stage(bodies), down), open);
}

/// White light is split at a contact where it first comes to a body that does so: an eye in the one sees the other.
#[test]
fn contacts_split_light_if_either_body_does() {
    for order in [false, true] {
        let block = |y: f64, glass: Dielectric| block(v(9.0, 1.0, 9.0), v(0.0, y, 0.0), glass);
        let mut bodies = vec![block(0.5, clear(1.5)), block(-0.5, colorful(1.5, 25.0))];
        if order {
            bodies.reverse();
        }
        let rays = tree(&stage(bodies), ray(v(0.0, 0.4, 0.0), v(0.8, -1.0, 0.0)));
        let split = rays.iter().filter(|ray| ray.parent == Some(0) && ray.wavelength.is_some()).count();
        assert_eq!(split, 8, "the index of yellow light is the same, those of others are not");
    }
}

/// A ray through layers by Snell's law alone, in double precision: n·sin θ is the same in all. What it comes to: where it
/// leaves the stack, on which side, its generation, and how often it was at a contact without air.
struct LayeredPath {
    /// Along the layers, from where the stack was met.
    offset: f64,
    goes_through: bool,
    generation: u32,
    contacts: usize,
}

/// `layers` have a thickness and an index each, from above; `contacts` lie between them.
fn path_through(layers: &[(f64, f64)], contacts: &[Contact], sine: f64) -> LayeredPath {
    let count = layers.len() as i64;
    let index = |layer: i64| if (0..count).contains(&layer) { layers[layer as usize].1 } else { 1.0 };
    let mut path = LayeredPath { offset: 0.0, goes_through: true, generation: 1, contacts: 0 };
    let (mut layer, mut step) = (-1_i64, 1_i64);
    loop {
        let next = layer + step;
        let upper = layer.min(next);
        let is_inner = (0..count - 1).contains(&upper);
        let is_joint = is_inner && contacts[upper as usize] == Contact::Cemented;
        path.contacts += usize::from(is_joint);
        // With air between them there are two interfaces: into it, and out of it after no way at all, which always is a new
        // generation.
        let is_reflected = sine > index(next);
        if is_inner && !is_joint {
            path.generation += if is_reflected { 3 } else { 2 };
        } else {
            path.generation += u32::from(is_reflected || index(layer) != index(next));
        }
        if is_reflected {
            step = -step;
        } else {
            layer = next;
        }
        if !(0..count).contains(&layer) {
            path.goes_through = layer >= count;
            return path;
        }
        let (thickness, index) = layers[layer as usize];
        let sin = sine / index;
        path.offset += thickness * sin / (1.0 - sin * sin).sqrt();
    }
}

fn layer() -> impl Strategy<Value = (f64, f64)> {
    (0.01..0.5_f64, prop::sample::select(vec![1.01, 1.33, 1.5, 1.5, 1.62, 1.9, 0.8]))
}

proptest! {
    #![proptest_config(cases(300))]

    /// Any stack of slabs, some cemented and some not, is what Snell's law says of its layers.
    #[test]
    fn stacks_of_slabs_bend_light_as_their_layers(
        layers in prop::collection::vec(layer(), 1..7),
        own in prop::collection::vec(prop::sample::select(BodyContact::ALL.to_vec()), 7),
        of_scene in prop::sample::select(Contact::ALL.to_vec()),
        degrees in 0.0..80.0_f64,
        turn in prop::array::uniform3(-180.0..180.0_f64).prop_map(DVec3::from),
        (scale, reversed) in (prop::sample::select(vec![0.01, 1.0, 50.0]), any::<bool>()),
    ) {
        let sine = degrees.to_radians().sin();
        // At the critical angle rounding decides.
        prop_assume!(layers.iter().all(|(_, index)| (sine - index).abs() > 1e-3));
        let to_world = turned(Shape::Plane, DVec3::ZERO, turn, chalk()).placement.world_from_body();
        let mut top = 0.0;
        let mut bodies = Vec::new();
        for (&(thickness, index), &contact) in layers.iter().zip(&own) {
            let at = to_world.transform_point3(scale * v(0.0, top - 0.5 * thickness, 0.0));
            let size = scale * v(400.0, thickness, 400.0);
            bodies.push(Body { contact, ..turned(Shape::Cube { size }, at, turn, glass(index)) });
            top -= thickness;
        }
        let contacts: Vec<Contact> = own.windows(2).map(|two| of_scene.between(two[0], two[1])).collect();
        if reversed {
            bodies.reverse();
        }
        let mut scene = scene(bodies);
        scene.environment.contact = of_scene;
        let scene = render_scene(&scene);
        let along = v(sine, -(1.0 - sine * sine).sqrt(), 0.0);
        let from = to_world.transform_point3(-0.5 * scale * along);
        let path = chain(&scene, ray(from, to_world.transform_vector3(along)));
        let expected = path_through(&layers, &contacts, sine);
        let last = path.last().unwrap();
        let back = to_world.inverse();
        let end = back.transform_point3(scene.world_from_render(last.ray.origin)) / scale;
        let out = back.transform_vector3(direction(last));
        prop_assert!((end.x - expected.offset).abs() < 2e-4 * (1.0 + expected.offset), "{} {}", end.x, expected.offset);
        prop_assert!((out.x - sine).abs() < 1e-5);
        prop_assert_eq!(out.y < 0.0, expected.goes_through);
        prop_assert_eq!(last.generation, expected.generation);
        let is_joint = |ray: &&RayRecord| {
            ray.answer.as_ref().is_some_and(|answer| answer.interface.is_some_and(|found| found.contact.is_some()))
        };
        prop_assert_eq!(path.iter().filter(is_joint).count(), expected.contacts);
    }
}
