//! The laws of optics against each other, and the tracer against them.

use std::f64::consts::TAU;

use catoptric_lab::exact::{
    ExactAnswer, Inapplicable, alhazen, answers, answers_for, ball_crossing, ball_focal_length,
    lens_crossing, mirrored, ring_of_images, sphere_image, to_json, to_text,
};
use catoptric_optics::METALS;
use catoptric_scene::{
    Anchor, Attenuation, Body, BodyShape, Camera, Coated, Color, Conductor, Dielectric, Example, Light,
    Material, MetalOptics, Mirror, ParaboloidDepth, Phong, Placement, Projection, RefractiveIndex, Scene,
    Shape, ShapeKind,
};
use glam::DVec3;
use proptest::prelude::*;

use crate::scenes::{any_physical_scene, any_scene, ball, body, cases};

fn example(name: &str) -> Scene {
    Example::find(name).unwrap().load().unwrap().scene
}

#[test]
fn two_mirrors_at_a_whole_part_of_the_circle_have_one_image_less() {
    for parts in 2..=24_u32 {
        let angle = TAU / f64::from(parts);
        let normals =
            [DVec3::Z, DVec3::new(angle.sin(), 0.0, -angle.cos())].map(|normal| (DVec3::ZERO, normal));
        for share in [0.3, 0.5, 0.71] {
            let at = share * angle;
            let object = DVec3::new(at.cos(), 0.4, at.sin());
            let images = ring_of_images(object, normals, 100);
            let is_regular = parts % 2 == 0 || share == 0.5;
            let wanted = if is_regular { parts - 1 } else { parts };
            assert_eq!(images.len() as u32, wanted, "{parts} parts, {share}");
            for (image, _) in &images {
                assert!((image.length() - object.length()).abs() < 1e-12, "they stand in a circle");
            }
        }
    }
    // Face to face there is no end.
    let walls = [(DVec3::NEG_X, DVec3::X), (DVec3::X, DVec3::NEG_X)];
    assert_eq!(ring_of_images(DVec3::ZERO, walls, 50).len(), 50);
}

#[test]
fn the_mirror_equation_in_known_cases() {
    // A far object is imaged in the focus, half a radius from the center; one at the surface where it is.
    assert!((sphere_image(2.0, 1e9) - 1.0).abs() < 1e-8);
    assert_eq!(sphere_image(2.0, 2.0), 2.0);
    // In a hollow mirror the center is its own image, and what stands in the focus has none.
    assert_eq!(sphere_image(2.0, 0.0), 0.0);
    assert!(sphere_image(2.0, 1.0).is_infinite());
    assert_eq!(mirrored(DVec3::new(1.0, 2.0, 3.0), DVec3::Y, DVec3::Y), DVec3::new(1.0, 0.0, 3.0));
}

#[test]
fn a_ball_lens_in_known_cases() {
    assert_eq!(ball_focal_length(1.0, 1.5), 1.5);
    assert_eq!(ball_focal_length(1.0, 2.0), 1.0);
    for ior in [1.2, 1.5, 1.9] {
        assert!((ball_crossing(1.0, ior, 1e-5) - ball_focal_length(1.0, ior)).abs() < 1e-8);
        // Away from the axis rays cross it sooner.
        assert!(ball_crossing(1.0, ior, 0.6) < ball_crossing(1.0, ior, 0.3));
    }
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn alhazens_point_mirrors(
        object in prop::array::uniform3(-5.0..5.0_f64),
        eye in prop::array::uniform3(-5.0..5.0_f64),
        radius in 0.01..2.0_f64,
    ) {
        let (object, eye, center) = (DVec3::from(object), DVec3::from(eye), DVec3::new(0.1, -0.2, 0.3));
        match alhazen(center, radius, object, eye) {
            Some(point) => {
                let normal = (point - center).normalize();
                prop_assert!(((point - center).length() - radius).abs() < 1e-12 * (1.0 + radius));
                let [to_object, to_eye] = [object, eye].map(|end| (end - point).normalize());
                let mirrored = 2.0 * normal.dot(to_object) * normal - to_object;
                prop_assert!((mirrored - to_eye).length() < 1e-7, "{mirrored} {to_eye}");
                prop_assert!(normal.dot(to_object) > 0.0);
            }
            None => {
                let way = eye - object;
                let nearest = (center - object).dot(way) / way.length_squared();
                let distance = (object + nearest.clamp(0.0, 1.0) * way).distance(center);
                prop_assert!(distance <= radius, "nothing hides it");
            }
        }
    }

    #[test]
    fn no_scene_is_too_odd_for_an_answer(scene in prop_oneof![any_scene(), any_physical_scene()]) {
        let found = answers(&scene);
        prop_assert!(!to_text(&found).is_empty());
        prop_assert!(to_json(&found)["answers"].is_array());
        for answer in &found.answers {
            if let ExactAnswer::PlaneImage { image, .. } = answer {
                prop_assert!(image.difference().unwrap() < 2e-3, "{answer:?}");
            }
            if let ExactAnswer::Highlight { off: Some(off), .. } = answer {
                prop_assert!(*off < 1e-4, "{answer:?}");
            }
        }
    }
}

#[test]
fn the_tracer_agrees_with_the_laws_in_the_examples() {
    let mut seen = [0; 8];
    for name in [
        "ring-of-images",
        "concave-mirror",
        "lens",
        "whitted",
        "hall-of-mirrors",
        "parabolic-mirror",
        "optical-bench",
    ] {
        for answer in &answers(&example(name)).answers {
            let near = |difference: Option<f64>, most: f64| {
                assert!(difference.is_none_or(|difference| difference < most), "{name}: {answer:?}");
            };
            let kind = match answer {
                ExactAnswer::PlaneImage { image, .. } => {
                    near(image.difference(), 1e-4);
                    0
                }
                ExactAnswer::Ring { images, angle, .. } => {
                    images.iter().for_each(|image| near(image.miss, 1e-5));
                    if name == "ring-of-images" {
                        assert!((angle.to_degrees() - 60.0).abs() < 1e-3 && images.len() == 5);
                    }
                    1
                }
                ExactAnswer::SphereImage { image, .. } => {
                    near(image.difference(), 1e-3);
                    2
                }
                ExactAnswer::ReflectionPoint { point, .. } => {
                    near(point.difference(), 1e-5);
                    3
                }
                ExactAnswer::Focus { paraxial, marginal, .. } => {
                    near(paraxial.difference(), 3e-4);
                    near(marginal.and_then(|marginal| marginal.difference()), 1e-5);
                    4
                }
                ExactAnswer::Highlight { off, .. } => {
                    near(*off, 1e-5);
                    5
                }
                ExactAnswer::DishFocus { near: inner, marginal, .. } => {
                    near(inner.difference(), 1e-4);
                    near(marginal.difference(), 1e-5);
                    6
                }
                ExactAnswer::LensFocus { paraxial, marginal, .. } => {
                    near(paraxial.difference(), 1e-3);
                    near(marginal.and_then(|marginal| marginal.difference()), 1e-5);
                    7
                }
            };
            seen[kind] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
}

#[test]
fn one_body_can_be_asked_for() {
    let scene = example("ring-of-images");
    let cone = scene.bodies.iter().position(|body| body.name == "cone").unwrap();
    let found = answers_for(&scene, Some(cone));
    assert!(!found.answers.is_empty());
    for answer in &found.answers {
        match answer {
            ExactAnswer::PlaneImage { body, .. } | ExactAnswer::Ring { body, .. } => assert_eq!(*body, cone),
            other => panic!("{other:?}"),
        }
    }
    assert!(to_text(&found).contains("5 images of \"cone\" between \"left mirror\" and \"right mirror\""));
}

/// A matte ball before a mirror, seen from the side, under a light.
fn before_a_mirror(mirror: Body) -> Scene {
    let camera = Camera { position: DVec3::new(1.0, 3.0, 8.0), target: DVec3::ZERO, ..Camera::default() };
    Scene {
        camera,
        lights: vec![Light { position: DVec3::new(-3.0, 50.0, 6.0), ..Light::default() }],
        bodies: [ball(0.5, DVec3::new(1.5, 1.4, 0.3), Material::default()), mirror].into(),
        ..Scene::default()
    }
}

/// Materials that are mirrors when they are smooth.
fn mirrors(roughness: f64) -> Vec<Material> {
    vec![
        Mirror { pattern: Color::gray(0.9).into(), roughness, ..Mirror::default() }.into(),
        Conductor { metal: MetalOptics::Metal(&METALS[0]), roughness }.into(),
        Coated { ior: 4.0, roughness, ..Coated::default() }.into(),
    ]
}

fn turned(mut body: Body, rotation_degrees: DVec3, scale: DVec3) -> Body {
    let position = body.placement.origin();
    body.placement = Placement { anchor: Anchor::Frame { position, rotation_degrees }, scale };
    body
}

#[test]
fn a_rough_mirror_has_no_image_points_whatever_its_shape_and_model() {
    let slab = Shape::Cube { size: DVec3::new(16.0, 0.2, 16.0) };
    for shape in [Shape::Plane, slab, Shape::Sphere { radius: 0.7 }] {
        for roughness in [0.01, 0.3, 1.0] {
            for material in mirrors(roughness) {
                let scene = before_a_mirror(body(shape, DVec3::new(0.0, -0.1, 0.0), material));
                let found = answers_for(&scene, None);
                assert_eq!(found.answers, [], "{shape:?} {roughness}");
                assert_eq!(found.inapplicable, [Inapplicable::RoughMirror { mirror: 1 }]);
                assert!(to_text(&found).contains("rough: it has no image points"));
                assert_eq!(to_json(&found)["inapplicable"][0]["kind"], "rough-mirror");
                // The mirror itself was asked about, and something else that it has nothing to do with.
                assert_eq!(answers_for(&scene, Some(1)).inapplicable, found.inapplicable);
            }
        }
        for material in mirrors(0.0) {
            let scene = before_a_mirror(body(shape, DVec3::new(0.0, -0.1, 0.0), material));
            let found = answers(&scene);
            assert!(!found.answers.is_empty() && found.inapplicable.is_empty(), "{shape:?}");
        }
    }
}

#[test]
fn a_mirror_that_no_formula_is_for_says_so() {
    let material = mirrors(0.0).remove(0);
    let egg = turned(ball(0.7, DVec3::ZERO, material.clone()), DVec3::ZERO, DVec3::new(1.0, 1.5, 1.0));
    let tube = body(Shape::CYLINDER, DVec3::ZERO, material.clone());
    let [tip, dish] =
        [Shape::CONE, Shape::PARABOLOID].map(|shape| body(shape, DVec3::ZERO, material.clone()));
    for mirror in [egg, tube, tip, dish] {
        let found = answers_for(&before_a_mirror(mirror), None);
        let is_focus = |answer: &ExactAnswer| matches!(answer, ExactAnswer::DishFocus { .. });
        assert!(found.answers.iter().all(is_focus), "{found:?}");
        assert_eq!(found.inapplicable, [Inapplicable::CurvedMirror { mirror: 1 }]);
    }
    // Turned and evenly scaled, a sphere is a ball, and a plane remains one.
    let big =
        turned(ball(0.35, DVec3::ZERO, material.clone()), DVec3::new(30.0, 200.0, 7.0), DVec3::splat(2.0));
    let wide =
        turned(body(Shape::Plane, DVec3::ZERO, material), DVec3::new(0.0, 40.0, 0.0), DVec3::splat(3.0));
    for mirror in [big, wide] {
        let found = answers(&before_a_mirror(mirror));
        assert!(!found.answers.is_empty() && found.inapplicable.is_empty());
    }
}

#[test]
fn a_paraboloid_mirrors_all_light_along_its_axis_to_its_focus() {
    let opaque = mirrors(0.0).remove(0);
    // The cap lets light in unbent, and the side mirrors it from within.
    let open =
        Material::Phong(Phong { ior: 1.0, reflection: Some(0.9), transmission: 1.0, ..Phong::default() });
    for (material, is_outside) in [(opaque, true), (open, false)] {
        for (radius, depth) in [(0.5, 1.0), (2.8, 1.96), (3.0, 0.2)] {
            let shape = Shape::Paraboloid { radius, depth: ParaboloidDepth::Height(depth) };
            let at = DVec3::new(0.3, -1.0, 2.0);
            let dish = body(shape, at, material.clone());
            // Turned, and scaled alike across its axis.
            let scale = DVec3::new(2.0, 0.7, 2.0);
            for (mirror, r, h) in [
                (dish.clone(), radius, depth),
                (turned(dish.clone(), DVec3::new(40.0, 70.0, -20.0), scale), 2.0 * radius, 0.7 * depth),
            ] {
                let axis = mirror.placement.rotation().y_axis;
                let scene = Scene { bodies: [mirror].into(), ..Scene::default() };
                let found = answers(&scene);
                let [ExactAnswer::DishFocus { focal_length, is_virtual, near, marginal, .. }] =
                    found.answers.as_slice()
                else {
                    panic!("{found:?}")
                };
                let f = r * r / (4.0 * h);
                assert!((focal_length - f).abs() < 1e-12 * f && *is_virtual == is_outside);
                assert!(near.exact.distance(at + f * axis) < 1e-12 * (1.0 + f));
                for ray in [near, marginal] {
                    assert!(ray.difference().unwrap() < 1e-4 * f, "{r} {h} {is_outside}: {ray:?}");
                }
                assert!(to_text(&found).contains("of the parabolic mirror"));
                assert_eq!(to_json(&found)["answers"][0]["kind"], "parabolic-focus");
            }
            // Flattened, rough or with a cap that bends light, it has no focus.
            let oval = turned(dish.clone(), DVec3::ZERO, DVec3::new(1.0, 1.0, 1.2));
            let scene = Scene { bodies: [oval].into(), ..Scene::default() };
            assert_eq!(answers(&scene).answers, []);
        }
    }
    for material in mirrors(0.2) {
        let scene =
            Scene { bodies: [body(Shape::PARABOLOID, DVec3::ZERO, material)].into(), ..Scene::default() };
        assert_eq!(answers(&scene).answers, []);
    }
}

#[test]
fn a_dish_gathers_light_in_its_focus() {
    let material = mirrors(0.0).remove(0);
    for (radius, f) in [(0.5, 0.5), (1.2, 4.0), (0.4, 0.15)] {
        let mut dish = turned(
            body(Shape::SPHERE, DVec3::new(0.3, -1.0, 2.0), material.clone()),
            DVec3::new(40.0, 70.0, -20.0),
            DVec3::splat(2.0),
        );
        dish.set_shape(BodyShape::of_size(ShapeKind::MirrorDish, radius, 1.0));
        dish.change_shape(|shape| shape.set_number("focal_length", f));
        let focus = dish.placement.world_from_body().translation + 2.0 * f * dish.placement.rotation().y_axis;
        let answer = |dish: &Body| answers(&Scene { bodies: [dish.clone()].into(), ..Scene::default() });
        for profile in ["parabolic", "spherical"] {
            if profile == "spherical" && radius > 2.0 * f {
                // No sphere is that deep.
                continue;
            }
            dish.change_shape(|shape| shape.set_word("profile", profile));
            let found = answer(&dish);
            let [ExactAnswer::DishFocus { focal_length, is_virtual: false, near, marginal, .. }] =
                found.answers.as_slice()
            else {
                panic!("{found:?}")
            };
            assert!((focal_length - 2.0 * f).abs() < 1e-12);
            for (ray, height) in [(near, 0.1), (marginal, 0.7)] {
                // A sphere has a focus for rays near the axis alone: R/(2 cos θ) from the center others cross it.
                let sin: f64 = if profile == "spherical" { height * radius / (2.0 * f) } else { 0.0 };
                let aberration = 2.0 * f * (1.0 / (1.0 - sin * sin).sqrt() - 1.0);
                assert!((ray.exact.distance(focus) - aberration).abs() < 1e-12, "{profile} {radius} {f}");
                assert!(ray.difference().unwrap() < 1e-4 * f, "{profile} {radius} {f}: {ray:?}");
            }
            assert_eq!(to_json(&found)["answers"][0]["kind"], format!("{profile}-focus"));
        }
    }
}

#[test]
fn lenses_gather_and_spread_light_where_their_equation_says() {
    // Both faces bulge, both are hollow, one is flat, a meniscus; seen from either side.
    for (front, back, thickness) in
        [(1.0, -1.0, 0.3), (-0.9, 0.9, 0.08), (0.0, -0.8, 0.25), (1.1, 0.0, 0.2), (0.7, 1.9, 0.15)]
    {
        for (ior, eye) in [(1.5, -9.0), (1.5, 9.0), (1.8, -9.0)] {
            let glass = Dielectric { index: RefractiveIndex::from(ior), ..Dielectric::default() };
            let mut lens = turned(
                body(Shape::SPHERE, DVec3::new(0.2, 1.0, -0.5), Material::Dielectric(glass)),
                DVec3::new(10.0, 30.0, 75.0),
                DVec3::splat(1.5),
            );
            lens.set_shape(ShapeKind::Lens.body_shape());
            lens.change_shape(|shape| {
                for (key, size) in [
                    ("radius", 0.4),
                    ("thickness", thickness),
                    ("front_radius", front),
                    ("back_radius", back),
                ] {
                    shape.set_number(key, size);
                }
            });
            let middle = lens.placement.world_from_body().translation;
            let axis = lens.placement.rotation().y_axis;
            let mut scene = Scene { bodies: [lens].into(), ..Scene::default() };
            scene.camera.position = middle + eye * axis + DVec3::X * 0.3;
            let found = answers(&scene);
            let [ExactAnswer::LensFocus { focal_length, paraxial, marginal, .. }] = found.answers.as_slice()
            else {
                panic!("{found:?}")
            };
            let curvature = |radius: f64| if radius == 0.0 { 0.0 } else { radius.recip() };
            let (c, d, n) = ([front, back].map(curvature), thickness, ior - 1.0);
            // Hecht 2017, Optics, eq. 6.2, with all lengths half as large again.
            let f = 1.5 / (n * (c[0] - c[1] + n * d * c[0] * c[1] / ior));
            assert!((focal_length - f).abs() < 1e-9 * f.abs(), "{focal_length} {f}");
            let sign = if eye < 0.0 { 1.0 } else { -1.0 };
            let first = if eye < 0.0 { c[0] } else { -c[1] };
            let back_focal_length = f * (1.0 - n * d * first / ior);
            let focus = middle + sign * axis * (0.5 * 1.5 * d + back_focal_length);
            assert!(paraxial.exact.distance(focus) < 1e-9, "{paraxial:?} {focus}");
            assert!(
                paraxial.difference().unwrap() < 3e-3 * f.abs(),
                "{front} {back} {ior} {eye}: {paraxial:?}"
            );
            let marginal = marginal.unwrap();
            assert!(marginal.difference().unwrap() < 1e-4, "{front} {back} {ior} {eye}: {marginal:?}");
            assert_eq!(to_json(&found)["answers"][0]["kind"], "lens-focus");
        }
    }
    // A ball is a lens that is as thick as its diameter.
    for height in [0.01, 0.3, 0.6] {
        let crossing = lens_crossing([1.0, -1.0], 2.0, 1.5, height).unwrap();
        assert!((crossing + 1.0 - ball_crossing(1.0, 1.5, height)).abs() < 1e-12);
    }
    assert_eq!(lens_crossing([0.3, -0.3], 0.1, 1.5, 0.4), None);
    assert_eq!(lens_crossing([0.0, -0.3], 0.3, 2.0, 0.25), None, "reflected wholly");
}

#[test]
fn a_body_in_the_focus_of_a_hollow_mirror_has_no_image() {
    let mirror = ball(4.0, DVec3::ZERO, mirrors(0.0).remove(0));
    for (distance, is_focus) in [(2.0, true), (2.000_001, true), (2.005, true), (2.2, false), (1.0, false)] {
        let mut scene = before_a_mirror(mirror.clone());
        scene.bodies =
            [ball(0.05, DVec3::new(distance, 0.0, 0.0), Material::default()), mirror.clone()].into();
        let found = answers_for(&scene, Some(0));
        let image = found.answers.iter().find_map(|answer| match answer {
            ExactAnswer::SphereImage { image, .. } => Some(*image),
            _ => None,
        });
        assert_eq!(image.is_none(), is_focus, "{distance}");
        assert_eq!(found.inapplicable.is_empty(), !is_focus);
        assert!(image.is_none_or(|image| image.difference().unwrap() < 2e-2), "{image:?}");
    }
}

#[test]
fn only_a_clear_smooth_ball_by_itself_in_air_has_the_focal_point() {
    let glass = |ior: f64| Material::Dielectric(Dielectric { index: ior.into(), ..Dielectric::default() });
    let lens = |material: Material| ball(0.5, DVec3::new(0.0, 1.0, 0.0), material);
    let scene = |bodies: Vec<Body>| Scene { bodies: bodies.into_iter().collect(), ..Scene::default() };
    let alone = |material| answers_for(&scene(vec![lens(material)]), None);
    assert_eq!(alone(glass(1.5)).inapplicable, []);
    let only = |found: &catoptric_lab::exact::ExactAnswers, reason| {
        assert_eq!((found.answers.as_slice(), found.inapplicable.as_slice()), (&[][..], &[reason][..]));
    };
    only(
        &alone(Material::Dielectric(Dielectric {
            index: 1.5.into(),
            roughness: 0.2,
            ..Dielectric::default()
        })),
        Inapplicable::RoughLens { body: 0 },
    );
    only(&alone(glass(1.001)), Inapplicable::WeakLens { body: 0 });
    only(&alone(glass(2.4)), Inapplicable::FocusInside { body: 0 });
    let egg = turned(lens(glass(1.5)), DVec3::ZERO, DVec3::new(1.0, 1.0, 1.2));
    only(&answers_for(&scene(vec![egg]), None), Inapplicable::UnevenLens { body: 0 });
    // A hollow ball, one in water, one that is sunk into the floor, one that a rod goes through.
    let hollow = ball(0.4, DVec3::new(0.0, 1.0, 0.0), glass(1.0));
    let tank = body(Shape::Cube { size: DVec3::splat(3.0) }, DVec3::Y, glass(1.33));
    let deep = body(Shape::Plane, DVec3::new(0.0, 0.9, 0.0), Material::default());
    let rod = body(Shape::CYLINDER, DVec3::new(0.6, 0.8, 0.0), Material::default());
    for other in [hollow, tank, deep, rod] {
        let found = answers_for(&scene(vec![lens(glass(1.5)), other]), Some(0));
        only(&found, Inapplicable::SharedLens { body: 0, other: 1 });
    }
    // On the floor, beside a wall, and beside something hidden, it is by itself.
    let floor = body(Shape::Plane, DVec3::new(0.0, 0.5, 0.0), Material::default());
    let wall = turned(
        body(
            Shape::Cube { size: DVec3::new(0.2, 3.0, 3.0) },
            DVec3::new(0.61, 1.0, 0.0),
            Material::default(),
        ),
        DVec3::ZERO,
        DVec3::ONE,
    );
    let hidden = Body { hidden: true, ..lens(glass(1.2)) };
    for other in [floor, wall, hidden] {
        let found = answers_for(&scene(vec![lens(glass(1.5)), other]), Some(0));
        assert!(found.inapplicable.is_empty() && found.answers.len() == 1);
    }
}

#[test]
fn the_focal_point_is_that_of_yellow_light_and_of_rays_that_have_left_the_ball() {
    for (ior, crosses_outside) in [(1.3, true), (1.5, true), (1.7, true), (1.95, false)] {
        for dispersion in [false, true] {
            let tinted = Material::Dielectric(Dielectric {
                index: RefractiveIndex::Own { ior, abbe: 25.0 },
                dispersion,
                attenuation: Attenuation { color: Color::new(0.3, 0.6, 0.9), ..Attenuation::default() },
                ..Dielectric::default()
            });
            let scene =
                Scene { bodies: [ball(0.5, DVec3::new(0.3, 1.0, 0.0), tinted)].into(), ..Scene::default() };
            let found = answers(&scene).answers;
            let [ExactAnswer::Focus { paraxial, marginal, .. }] = found.as_slice() else {
                panic!("{found:?}")
            };
            assert!(paraxial.difference().unwrap() < 1e-3, "{ior} {dispersion}: {paraxial:?}");
            assert_eq!(marginal.is_some(), crosses_outside, "{ior}");
            assert!(marginal.is_none_or(|marginal| marginal.difference().unwrap() < 1e-4), "{marginal:?}");
        }
    }
}

#[test]
fn a_parallel_camera_sees_along_its_direction() {
    let glossy = Material::Phong(Phong { specular: 0.8, reflection: Some(0.0), ..Phong::default() });
    let mirror = mirrors(0.0).remove(0);
    for distance in [3.0, 8.0, 50.0] {
        let mut scene = before_a_mirror(ball(0.7, DVec3::new(-0.6, 0.2, 0.0), mirror.clone()));
        scene.bodies.push(ball(0.4, DVec3::new(2.0, -0.5, 0.2), glossy.clone()));
        let view = DVec3::new(-0.2, -0.3, -1.0).normalize();
        scene.camera = Camera {
            position: -distance * view,
            target: DVec3::ZERO,
            projection: Projection::Parallel { height: 5.0 },
            ..Camera::default()
        };
        let found = answers_for(&scene, None).answers;
        let mut seen = [0; 2];
        for answer in &found {
            match answer {
                ExactAnswer::ReflectionPoint { object, point, .. } => {
                    let normal = (point.exact - DVec3::new(-0.6, 0.2, 0.0)).normalize();
                    let to_object = (*object - point.exact).normalize();
                    let mirrored = 2.0 * normal.dot(to_object) * normal - to_object;
                    let off = (mirrored + view).length();
                    assert!(off < 1e-7, "{distance}: it goes along the view but for {off:e}");
                    assert!(point.difference().unwrap() < 1e-3, "{distance}: {point:?}");
                    seen[0] += 1;
                }
                ExactAnswer::Highlight { off, .. } => {
                    assert!(off.unwrap() < 1e-3, "{distance}: {off:?}");
                    seen[1] += 1;
                }
                _ => {}
            }
        }
        assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
    }
}

#[test]
fn a_light_with_a_radius_has_its_highlight_about_that_of_its_middle() {
    let glossy = Material::Phong(Phong { specular: 0.8, ..Phong::default() });
    let highlight = |radius| {
        let mut scene = before_a_mirror(ball(0.7, DVec3::ZERO, glossy.clone()));
        scene.lights = vec![Light { position: DVec3::new(2.0, 5.0, 4.0), radius, ..Light::default() }];
        let found = answers(&scene).answers;
        let highlights = found.into_iter().filter(|answer| matches!(answer, ExactAnswer::Highlight { .. }));
        highlights.collect::<Vec<_>>()
    };
    assert_eq!(highlight(1.5), highlight(0.0));
    assert_eq!(highlight(0.0).len(), 1);
}

#[test]
fn mirrors_that_are_turned_away_from_each_other_make_no_ring() {
    let mirror = mirrors(0.0).remove(0);
    let slab = |at: DVec3, size: DVec3| body(Shape::Cube { size }, at, mirror.clone());
    let walls = |x: f64, z: f64| {
        let left = slab(DVec3::new(x, 0.0, 0.0), DVec3::new(0.2, 6.0, 2.0));
        let back = slab(DVec3::new(0.0, 0.0, z), DVec3::new(2.0, 6.0, 0.2));
        let mut scene = before_a_mirror(left);
        scene.bodies = [ball(0.1, DVec3::new(1.0, 0.0, 1.0), Material::default())]
            .into_iter()
            .chain(scene.bodies.get(1).cloned())
            .chain([back])
            .collect();
        let found = answers_for(&scene, Some(0)).answers;
        found.iter().any(|answer| matches!(answer, ExactAnswer::Ring { .. }))
    };
    // In the inner corner, and before the outer one.
    assert!(walls(-1.1, -1.1));
    assert!(!walls(0.8, 0.8));
}

#[test]
fn answers_far_from_the_origin_are_as_good() {
    let material = mirrors(0.0).remove(0);
    for shape in [Shape::Plane, Shape::Sphere { radius: 0.7 }] {
        for offset in [DVec3::ZERO, DVec3::new(3e4, -2e5, 7e6)] {
            let mut scene = before_a_mirror(body(shape, DVec3::ZERO, material.clone()));
            scene.camera.position += offset;
            scene.camera.target += offset;
            scene.bodies.iter_mut().for_each(|body| body.placement = body.placement.moved_by(offset));
            let found = answers(&scene).answers;
            assert!(!found.is_empty());
            for answer in found {
                let difference = match answer {
                    ExactAnswer::PlaneImage { image, .. } | ExactAnswer::SphereImage { image, .. } => {
                        image.difference()
                    }
                    ExactAnswer::ReflectionPoint { point, .. } => point.difference(),
                    _ => None,
                };
                assert!(difference.is_none_or(|difference| difference < 1e-3), "{offset} {difference:?}");
            }
        }
    }
}
