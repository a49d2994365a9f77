//! Surfaces that reflect by the laws of physics: glass, metal, mirrors, plastic.

use std::sync::atomic::AtomicBool;

use catoptric_optics::{METALS, Metal, fresnel};
use catoptric_scene::{
    Attenuation, Body, Coated, Color, Conductor, Dielectric, Environment, Light, Material, MetalOptics,
    Mirror, Model, ParaboloidDepth, Pattern, Phong, Scene, Shape, SolidTexture, ThinDielectric,
};
use catoptric_tracer::{BranchOutcome, RayKind, RayRecord, WhittedIntegrator};
use glam::{DVec3, UVec2, Vec3};
use proptest::prelude::*;

use crate::proof::common::{
    assert_close, assert_same_picture, assert_vec_close, ball, block, body, camera, cases, center, glow,
    light_along, picture, plane, ray, render_scene, scene, stage_of, tree, turned, v,
};

fn clear(ior: f64) -> Dielectric {
    Dielectric { index: ior.into(), ..Dielectric::default() }
}

fn stained(color: Color, distance: f64) -> Dielectric {
    Dielectric { attenuation: Attenuation { color, distance }, ..clear(1.0) }
}

fn metal(name: &str) -> Material {
    let metal = Metal::named(name).unwrap();
    Material::Conductor(Conductor { metal: MetalOptics::Metal(metal), ..Conductor::default() })
}

fn conductor(n: f64, k: f64) -> Material {
    let conductor = MetalOptics::Index { n: DVec3::splat(n), k: DVec3::splat(k) };
    Material::Conductor(Conductor { metal: conductor, ..Conductor::default() })
}

fn of_model(model: Model, color: Color) -> Material {
    let all = Phong { pattern: color.into(), ambient: 1.0, ..Phong::default() };
    Material::Phong(all).with_model(model)
}

/// White under a coat.
fn coated(ior: f64) -> Coated {
    Coated { pattern: Color::WHITE.into(), ambient: 1.0, ior, roughness: 0.0 }
}

/// The first two generations behind a ray that falls on a floor at this angle of incidence, from above or from below.
fn on_a_floor(material: impl Into<Material>, degrees: f64, from_below: bool) -> Vec<RayRecord> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let d = v(sin, if from_below { cos } else { -cos }, 0.0);
    tree(&stage_of(vec![plane(DVec3::ZERO, 0.0, material)]), ray(-d, d))
}

/// What is reflected there, by channel.
fn reflected(material: impl Into<Material>, degrees: f64, from_below: bool) -> DVec3 {
    let rays = on_a_floor(material, degrees, from_below);
    rays[0].answer.as_ref().unwrap().reflected.coefficient.as_dvec3()
}

#[test]
fn glass_reflects_by_fresnels_formulas() {
    for ior in [0.8, 1.0001, 1.333, 1.5, 2.417] {
        for degrees in [0.0, 1.0, 30.0, 40.0, 41.0, 53.1231, 56.3099, 80.0, 89.0] {
            for (from_below, eta) in [(false, ior), (true, 1.0 / ior)] {
                let first = on_a_floor(clear(ior), degrees, from_below).swap_remove(0);
                // The ray's own angle; where the curve is steep, the rounding of a cosine is seen.
                let cos = f64::from(first.ray.direction.y.abs());
                let curve = |cos| fresnel::dielectric(cos, eta).mean();
                let (exact, slope) = (curve(cos), (curve(cos + 1e-4) - curve(cos - 1e-4)).abs() / 2e-4);
                let answer = first.answer.unwrap();
                assert_close(answer.reflected.coefficient.x.into(), exact, 1e-5 + 2e-6 * slope);
                let sum = answer.reflected.coefficient + answer.refracted.coefficient;
                assert!(exact == 1.0 || (sum - 1.0).abs().max_element() < 1e-6, "{sum}");
            }
        }
    }
    assert_close(reflected(clear(1.5), 41.0, true).x, 0.379_751, 1e-5);
    assert_close(reflected(clear(1.5), 56.309_93, false).x, 0.073_964_5, 1e-5);
}

#[test]
fn panes_let_through_what_the_sum_over_all_bounces_says() {
    let pane = |z| block(v(9.0, 9.0, 0.1), v(0.0, 0.0, z), clear(1.5));
    let lamp = block(v(9.0, 9.0, 0.1), v(0.0, 0.0, -9.0), glow(Color::WHITE));
    for (panes, exact) in [(1, 0.923_076_9), (2, 0.857_142_9)] {
        let mut scene =
            scene((0..panes).map(|index| pane(f64::from(-index))).chain([lamp.clone()]).collect());
        scene.tracing.generations = 16;
        scene.camera = camera(v(0.0, 0.0, 5.0), DVec3::ZERO, 10.0);
        assert_close(center(&scene).x.into(), exact, 2e-5);
    }
}

#[test]
fn metals_reflect_their_color() {
    for metal_of in METALS {
        for degrees in [0.0_f64, 30.0, 60.0, 85.0] {
            let exact = metal_of.reflectance(degrees.to_radians().cos(), 1.0);
            let found = reflected(metal(metal_of.name), degrees, false).to_array();
            for (found, exact) in found.into_iter().zip(exact) {
                assert_close(found, exact, 1e-5);
            }
        }
    }
}

#[test]
fn metals_of_one_scene_are_told_apart() {
    let of = |x, name| ball(0.4, v(x, 0.0, 0.0), metal(name));
    let render_scene = stage_of(vec![of(-1.0, "gold"), of(0.0, "silver"), of(1.0, "copper")]);
    let straight = |x| {
        let rays = tree(&render_scene, ray(v(x, 0.0, 5.0), -DVec3::Z));
        rays[0].answer.as_ref().unwrap().reflected.coefficient.as_dvec3().to_array()
    };
    for (x, name) in [(-1.0, "gold"), (0.0, "silver"), (1.0, "copper")] {
        let exact = Metal::named(name).unwrap().reflectance(1.0, 1.0);
        straight(x).into_iter().zip(exact).for_each(|(found, exact)| assert_close(found, exact, 1e-5));
    }
}

#[test]
fn a_checker_brighter_than_white_under_a_coat_gives_no_negative_light() {
    let checker = Some(SolidTexture { color: Color::gray(50.0), size: 0.1, ..SolidTexture::default() });
    let pattern = Pattern { solid: checker, ..Color::WHITE.into() };
    let picture = picture(&furnace(&Coated { pattern, ..coated(1.5) }.into()), 60, 15);
    assert!(picture.pixels().iter().flatten().all(|part| (0.0..1.5).contains(part)));
}

#[test]
fn a_conductor_without_extinction_reflects_like_glass() {
    for degrees in [0.0, 20.0, 56.0, 75.0, 88.0] {
        let (metal, glass) =
            (reflected(conductor(1.5, 0.0), degrees, false), reflected(clear(1.5), degrees, false));
        assert_close(metal.y, glass.y, 1e-5);
    }
    assert_close(reflected(conductor(1.0, 90.0), 10.0, false).x, 1.0, 1e-3);
}

#[test]
fn mirrors_reflect_their_color_under_every_angle() {
    let gray = Color::new(0.25, 0.5, 0.75);
    for degrees in [0.0, 45.0, 89.0] {
        assert_eq!(reflected(of_model(Model::Mirror, gray), degrees, false), v(0.25, 0.5, 0.75));
    }
    let dull = Mirror { pattern: gray.into(), reflection: Some(0.5), roughness: 0.0 };
    assert_eq!(reflected(dull, 45.0, false), v(0.125, 0.25, 0.375));
}

/// One light straight above a point that is seen straight.
fn lit(material: impl Into<Material>) -> DVec3 {
    let mut scene = scene(vec![plane(DVec3::ZERO, 0.0, material)]);
    scene.environment.ambient = Color::BLACK;
    scene.lights = vec![Light { position: v(0.0, 4.0, 0.0), ..Light::default() }];
    light_along(&catoptric_tracer::RenderScene::build(&scene).unwrap(), ray(v(0.0, 2.0, 0.0), -DVec3::Y))
        .as_dvec3()
}

#[test]
fn matte_and_coated_grounds_scatter_the_light_of_a_lamp() {
    let color = Color::new(0.2, 0.5, 0.8);
    let matte = lit(of_model(Model::Matte, color));
    assert_close(matte.y, 0.5, 1e-6);
    // The coat by double precision: what goes in and out, and to and fro in between.
    let coated = lit(of_model(Model::Coated, color));
    let r = 0.04;
    let outer = (0..100_000).map(|step| (f64::from(step) + 0.5) / 1e5);
    let outer: f64 = outer.map(|cos| 2e-5 * cos * fresnel::dielectric(cos, 1.5).mean()).sum();
    assert_close(outer, 0.091_77, 1e-4);
    let inner = 1.0 - (1.0 - outer) / 2.25;
    for (found, c) in coated.to_array().into_iter().zip([0.2, 0.5, 0.8]) {
        assert_close(found, (1.0 - r) * (1.0 - r) * c / (2.25 * (1.0 - c * inner)), 1e-5);
    }
}

/// Bodies of all shapes in light that comes evenly from all sides.
fn furnace(material: &Material) -> Scene {
    let shapes = [
        (Shape::SPHERE, -3.0),
        (Shape::CUBE, -0.9),
        (Shape::Paraboloid { radius: 0.18, depth: ParaboloidDepth::Height(0.5) }, -1.8),
        (Shape::Cylinder { radius: 0.5, height: 1.4 }, 0.9),
        (Shape::Cone { radius: 0.7, top_radius: 0.2, height: 1.3 }, 2.6),
    ];
    let bodies =
        shapes.map(|(shape, x)| turned(shape, v(x, 0.0, 0.0), v(20.0, 30.0, 10.0), material.clone()));
    let mut scene = scene(bodies.to_vec());
    scene.environment =
        Environment { background: Color::WHITE, ambient: Color::WHITE, ..Environment::default() };
    scene.camera = camera(v(0.0, 0.5, 12.0), DVec3::ZERO, 22.0);
    scene
}

#[test]
fn bodies_that_lose_nothing_are_invisible_in_a_furnace() {
    let materials = [
        of_model(Model::Mirror, Color::WHITE),
        of_model(Model::Matte, Color::WHITE),
        of_model(Model::Coated, Color::WHITE),
        coated(2.2).into(),
        clear(1.5).into(),
        clear(1.1).into(),
        clear(0.8).into(),
        conductor(0.001, 50.0),
        Model::ThinDielectric.into(),
        ThinDielectric { ior: 2.4, ..ThinDielectric::default() }.into(),
    ];
    for material in materials {
        let size = UVec2::new(120, 30);
        let scene = furnace(&material);
        let picture = picture(&scene, size.x, size.y);
        for (place, pixel) in (0..).zip(picture.pixels()) {
            // Between a cylinder's caps some light goes to and fro more often than rays are followed.
            let mut lost = Vec3::ZERO;
            if pixel.iter().any(|part| (part - 1.0).abs() >= 1e-3) {
                lost = cut_off(&scene, UVec2::new(place % size.x, place / size.x), size);
                assert!(lost.max_element() < 1e-2, "{lost} at {place}");
            }
            for (part, lost) in pixel.iter().zip(lost.to_array()) {
                assert!((part + lost - 1.0).abs() < 1e-3, "{:?} at {place}: {pixel:?}", material.model());
            }
        }
    }
}

/// Both faces of a sheet reflect, from either side; the rest goes on as it came.
#[test]
fn thin_sheets_reflect_twice_and_bend_nothing() {
    let tint = Color::new(1.0, 0.5, 0.25);
    for (ior, degrees) in [(1.5, 0.0), (1.5, 45.0), (1.5, 56.31), (1.5, 85.0), (2.4, 30.0), (1.33, 70.0)] {
        for from_below in [false, true] {
            let rays = on_a_floor(ThinDielectric { ior, tint }, degrees, from_below);
            let answer = rays[0].answer.as_ref().unwrap();
            let share = fresnel::sheet(degrees.to_radians().cos(), ior).mean();
            assert_vec_close(answer.reflected.coefficient.as_dvec3(), DVec3::splat(share), 1e-5);
            let passed = (1.0 - share) * DVec3::from_array(tint.to_array());
            assert_vec_close(answer.refracted.coefficient.as_dvec3(), passed, 1e-5);
            let through = rays.iter().find(|ray| ray.kind == RayKind::Refracted).unwrap();
            assert_eq!(through.ray.direction, rays[0].ray.direction, "{degrees}° into {ior}");
            assert_eq!(through.generation, rays[0].generation, "it is the same ray");
        }
    }
    // 4 % at each face of glass, 1/13 of the sheet.
    assert_close(fresnel::sheet(1.0, 1.5).mean(), 1.0 / 13.0, 1e-12);
}

/// What a coat lets in and out of even light is the same at every index: a white ground under it is invisible, too.
#[test]
fn white_coats_are_invisible_in_a_furnace_at_every_index() {
    for ior in [0.01, 0.0101, 0.012, 0.015, 0.1, 0.7, 0.99, 1.0, 1.01, 3.0, 20.0, 100.0] {
        let picture = picture(&furnace(&coated(ior).into()), 60, 15);
        for pixel in picture.pixels() {
            assert!(pixel.iter().all(|part| (part - 1.0).abs() < 1e-3), "{ior}: {pixel:?}");
        }
    }
}

/// The weight of the rays behind a pixel that are not followed any more.
fn cut_off(scene: &Scene, pixel: UVec2, size: UVec2) -> Vec3 {
    let (render_scene, cancel) = (render_scene(scene), AtomicBool::new(false));
    let rays = WhittedIntegrator::new(&render_scene, &cancel).pixel_tree(pixel, size, 0, 100_000);
    let branches = rays.iter().filter_map(|ray| ray.answer.as_ref());
    let branches = branches.flat_map(|answer| [answer.reflected, answer.refracted]);
    branches.filter(|branch| branch.fate == BranchOutcome::GenerationLimit).map(|branch| branch.weight).sum()
}

#[test]
fn glass_of_equal_index_changes_nothing() {
    let behind = || [ball(0.6, v(0.3, 0.1, -3.0), glow(Color::new(0.2, 0.7, 0.4)))];
    let clear = [
        ball(1.0, DVec3::ZERO, clear(1.0)),
        turned(Shape::CUBE, v(1.5, 0.0, 0.0), v(20.0, 30.0, 40.0), clear(1.0)),
        turned(Shape::CONE, v(-1.5, 0.0, 0.0), v(20.0, 30.0, 40.0), clear(1.0)),
        ball(0.4, v(0.0, 0.8, 0.0), Dielectric { roughness: 0.8, ..clear(1.0) }),
    ];
    let look = |bodies: Vec<Body>| {
        let mut scene = scene(bodies);
        scene.camera = camera(v(0.0, 0.0, 8.0), DVec3::ZERO, 30.0);
        picture(&scene, 90, 60)
    };
    assert_same_picture(&look(behind().to_vec()), &look(clear.into_iter().chain(behind()).collect()), 0.0);
}

#[test]
fn light_is_lost_by_the_way_in_a_body() {
    let color = Color::new(0.5, 0.1, 1.0);
    let lamp = block(v(9.0, 9.0, 0.1), v(0.0, 0.0, -9.0), glow(Color::WHITE));
    for (thickness, distance) in [(1.0, 1.0), (0.25, 1.0), (3.0, 2.0)] {
        let pane = block(v(9.0, 9.0, thickness), DVec3::ZERO, stained(color, distance));
        let mut seen = scene(vec![pane.clone(), lamp.clone()]);
        seen.camera = camera(v(0.0, 0.0, 5.0), DVec3::ZERO, 10.0);
        // The same for a lamp's light on its way to a wall behind the pane.
        let wall = block(v(9.0, 9.0, 0.1), v(0.0, 0.0, -9.0), of_model(Model::Matte, Color::WHITE));
        let mut shone = scene(vec![pane, wall]);
        shone.camera = camera(v(0.0, 0.0, -5.0), v(0.0, 0.0, -9.0), 10.0);
        shone.environment.ambient = Color::BLACK;
        shone.lights = vec![Light { position: v(0.0, 0.0, 5.0), ..Light::default() }];
        for found in [center(&seen), center(&shone)] {
            for (found, left) in found.to_array().into_iter().zip(color.to_array()) {
                assert_close(found.into(), left.powf(thickness / distance), 1e-5);
            }
        }
    }
}

#[test]
fn a_color_that_is_used_up_leaves_nothing_and_no_nan() {
    let black = Color::new(0.0, 1.0, 0.5);
    let mut scene = scene(vec![
        body(Shape::SPHERE, DVec3::ZERO, Dielectric { index: 1.5.into(), ..stained(black, 1e-9) }),
        block(v(9.0, 9.0, 0.1), v(0.0, 0.0, -9.0), of_model(Model::Matte, Color::WHITE)),
    ]);
    scene.lights = vec![Light { position: v(0.3, 0.2, 5.0), ..Light::default() }];
    scene.camera = camera(v(0.0, 0.0, 5.0), DVec3::ZERO, 20.0);
    let picture = picture(&scene, 40, 30);
    assert!(picture.pixels().iter().flatten().all(|part| part.is_finite()));
}

proptest! {
    #![proptest_config(cases(60))]

    /// What goes through a pane one way goes through it the other way (H. von Helmholtz 1856).
    #[test]
    fn light_goes_to_and_fro_alike(degrees in 0.0..85.0_f64, ior in 1.05..2.5_f64) {
        let rays = on_a_floor(clear(ior), degrees, false);
        let there = rays[0].answer.as_ref().unwrap().refracted.coefficient.x;
        let sin = degrees.to_radians().sin() / ior;
        let back = on_a_floor(clear(ior), sin.asin().to_degrees(), true);
        let back = back[0].answer.as_ref().unwrap().refracted.coefficient.x;
        prop_assert!((there - back).abs() < 1e-4, "{there}, {back}");
    }
}

/// Light is lost on the way to an eye within the glass, too, whether it comes from a body or from around all of them.
#[test]
fn an_eye_within_stained_glass_sees_through_it() {
    let color = Color::new(0.5, 0.25, 1.0);
    let around = body(Shape::Sphere { radius: 2.0 }, DVec3::ZERO, stained(color, 2.0));
    let within = Scene {
        environment: Environment {
            background: Color::WHITE,
            ambient: Color::WHITE,
            ..Environment::default()
        },
        camera: camera(DVec3::ZERO, DVec3::NEG_Z, 40.0),
        ..scene(vec![around, ball(0.5, v(0.0, 0.0, -1.5), glow(Color::WHITE))])
    };
    let picture = picture(&within, 33, 33);
    for (pixel, way) in [(0, 1.0), (16 * 33 + 16, 0.5)] {
        for (seen, part) in picture.pixels()[pixel].into_iter().zip([0.5_f64, 0.25, 1.0]) {
            assert_close(f64::from(seen), part.powf(way), 2e-3);
        }
    }
}
