//! The audit against the renderer, bit by bit.

use std::panic::AssertUnwindSafe;

use catoptric_lab::audit::{Audit, AuditError, AuditSettings, NodeKind, Proof, audit};
use catoptric_picture::Picture;
use catoptric_scene::{Color, Example, Material, Phong, Scene};
use catoptric_tracer::{BranchOutcome, ReflectionModel, RenderControl, RenderScene, RenderSettings, render};
use glam::{DVec3, UVec2, Vec3};
use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::TestRunner;

use crate::scenes::{any_physical_scene, any_scene, ball, cases};

fn look(scene: &Scene, picture: RenderSettings, pixel: UVec2) -> Audit {
    let render_scene = RenderScene::build(scene).unwrap();
    let settings = AuditSettings { picture, ..AuditSettings::default() };
    audit(scene, &render_scene, render_scene.camera(), pixel, &settings, &RenderControl::default()).unwrap()
}

fn rendered(scene: &Scene, picture: RenderSettings) -> Picture {
    render(&RenderScene::build(scene).unwrap(), picture, &RenderControl::default()).unwrap().picture
}

fn bits(light: [f32; 3]) -> [u32; 3] {
    light.map(f32::to_bits)
}

/// Every claim that an audit makes of itself.
fn assert_sound(audit: &Audit) {
    for tree in &audit.trees {
        for (place, node) in tree.nodes.iter().enumerate() {
            let ray = &node.ray;
            assert_eq!(ray.light, ray.weight * ray.through * ray.local, "ray {place}: what it adds");
            match ray.parent {
                Some(parent) => {
                    let parent = &tree.nodes[parent];
                    assert!(ray.parent.unwrap() < place && parent.children.contains(&place));
                    let weight = parent.ray.weight * parent.ray.through * node.coefficient;
                    assert_eq!(ray.weight, weight, "ray {place}: its weight");
                    assert_eq!(ray.origin, parent.ray.hit.unwrap().position);
                }
                None => assert_eq!((place, ray.weight, node.kind), (0, Vec3::ONE, NodeKind::Primary)),
            }
            let below: DVec3 = node.children.iter().map(|&child| tree.nodes[child].brings).sum();
            let sum = below + ray.light.as_dvec3();
            assert!((node.brings - sum).abs().max_element() <= 1e-15 * (1.0 + sum.max_element()));
            let weighted = node.radiance * ray.weight.as_dvec3();
            assert!((weighted - node.brings).abs().max_element() < 1e-5 * (1e-3 + sum.max_element()));
            let Some(answer) = node.answer() else { continue };
            let mut local = answer.ambient;
            for light in &answer.lights {
                let (Some(shadow), Some(sent)) = (&light.shadow, light.answer) else { continue };
                if answer.law == ReflectionModel::Constant {
                    let diffuse = answer.color * answer.diffuse_coefficient * light.cosine;
                    assert_eq!(sent.diffuse, diffuse);
                }
                let sum = sent.diffuse + sent.highlight + sent.glints;
                assert_eq!(sent.light, sent.power * sum * shadow.passed);
                let filters = shadow.crossings.iter().map(|crossing| crossing.filter.unwrap());
                let passed = filters.product::<Vec3>() * shadow.through;
                assert!((shadow.passed - passed).abs().max_element() < 1e-6, "ray {place}: its shadow");
                local += sent.light;
            }
            assert_eq!(ray.local, local, "ray {place}: its local terms");
            for light in &answer.lights {
                let is_dark = light.shadow.as_ref().is_some_and(|shadow| shadow.passed == Vec3::ZERO);
                assert_eq!(light.answer.is_some(), light.shadow.is_some() && !is_dark);
                let is_frosted = answer.law == ReflectionModel::Dielectric && answer.alpha > 0.0;
                let from_behind = is_frosted && ray.hit.unwrap().hit.leaving;
                let is_faced = if from_behind { light.cosine < 0.0 } else { light.cosine > 0.0 };
                assert_eq!(light.shadow.is_some(), is_faced);
            }
        }
    }
}

#[test]
fn audits_of_random_scenes_have_the_bits_of_the_picture() {
    let strategy =
        (any_scene(), prop::array::uniform2(0.3..0.6_f64), prop_oneof![3 => Just(1_u32), 1 => 2..6_u32]);
    let (mut rays, mut certain, mut totals, mut all) = (0, 0, 0, 0);
    let count = AssertUnwindSafe(|audit: &Audit| {
        let nodes = || audit.trees.iter().flat_map(|tree| &tree.nodes);
        (nodes().count(), nodes().filter(|node| node.kind == NodeKind::TotallyReflected).count())
    });
    let mut runner = TestRunner::new(cases(40));
    for _ in 0..40 {
        let (scene, at, samples) = strategy.new_tree(&mut runner).unwrap().current();
        // Two tiles, one of them cut.
        let settings = RenderSettings { width: 41, height: 33, samples };
        let picture = rendered(&scene, settings);
        for step in 0..6 {
            let x = (at[0] * 41.0) as u32 + 3 * step;
            let pixel = UVec2::new(x % 41, ((at[1] * 33.0) as u32 + 2 * step) % 33);
            let audit = look(&scene, settings, pixel);
            let truth = picture.pixels()[(pixel.y * 41 + pixel.x) as usize];
            assert_eq!(bits(audit.light), bits(truth), "pixel {pixel} of {scene:#?}");
            assert_sound(&audit);
            let (more, total) = count(&audit);
            (rays, totals, all) = (rays + more, totals + total, all + 1);
            certain += usize::from(audit.proof == Proof::AnyOrder);
        }
    }
    println!("{rays} rays, {totals} of them totally reflected, {certain} of {all} pixels certain");
    assert!(rays > 1000 && totals > 20 && certain * 20 > all * 19, "{rays} {totals} {certain}");
}

#[test]
fn audits_of_physical_materials_have_the_bits_of_the_picture() {
    let strategy = (any_physical_scene(), prop_oneof![3 => Just(1_u32), 1 => 2..6_u32]);
    let mut runner = TestRunner::new(cases(40));
    let (mut waves, mut glints, mut absorbed) = (0, 0, 0);
    for _ in 0..40 {
        let (scene, samples) = strategy.new_tree(&mut runner).unwrap().current();
        let settings = RenderSettings { width: 41, height: 33, samples };
        let picture = rendered(&scene, settings);
        for step in 0..6 {
            let pixel = UVec2::new(12 + 3 * step, 14 + 2 * step);
            let audit = look(&scene, settings, pixel);
            let truth = picture.pixels()[(pixel.y * 41 + pixel.x) as usize];
            assert_eq!(bits(audit.light), bits(truth), "pixel {pixel} of {scene:#?}");
            assert_sound(&audit);
            for node in audit.trees.iter().flat_map(|tree| &tree.nodes) {
                waves += usize::from(node.ray.wavelength.is_some());
                absorbed += usize::from(node.ray.through != Vec3::ONE);
                let lights = node.answer().into_iter().flat_map(|answer| &answer.lights);
                glints +=
                    lights.filter_map(|light| light.answer).filter(|sent| sent.glints != Vec3::ZERO).count();
            }
        }
    }
    println!("{waves} rays of one color, {glints} glints, {absorbed} rays that lost light on their way");
    assert!(waves > 50 && glints > 50 && absorbed > 50, "{waves} {glints} {absorbed}");
}

#[test]
fn every_pixel_of_the_examples_is_audited_exactly() {
    for name in ["whitted", "mirror-box", "nested-glass"] {
        let scene = Example::find(name).unwrap().load().unwrap().scene;
        let settings = RenderSettings { width: 40, height: 24, samples: 1 };
        let picture = rendered(&scene, settings);
        for number in (0..40 * 24).step_by(7) {
            let audit = look(&scene, settings, UVec2::new(number % 40, number / 40));
            assert_eq!(bits(audit.light), bits(picture.pixels()[number as usize]), "{name}, pixel {number}");
            assert_eq!(audit.proof, Proof::AnyOrder);
            assert_sound(&audit);
        }
    }
}

fn glass_heap() -> Scene {
    let glass = Material::Phong(Phong {
        transmission: 0.9,
        reflection: Some(0.4),
        ambient: 0.0,
        diffuse: 0.0,
        specular: 0.5,
        ior: 1.5,
        ..Phong::default()
    });
    let balls = (0..27).map(|number| {
        let at = [number % 3, number / 3 % 3, number / 9].map(|step| 0.7 * f64::from(step) - 0.7);
        ball(0.4, DVec3::from(at) + DVec3::Y, glass.clone())
    });
    let mut scene = Scene { bodies: balls.collect(), ..Scene::default() };
    scene.tracing.generations = 40;
    scene
}

#[test]
fn a_tree_that_is_too_large_says_what_it_leaves_out() {
    let mut scene = glass_heap();
    scene.tracing.generations = 14;
    let render_scene = RenderScene::build(&scene).unwrap();
    let picture = RenderSettings { width: 33, height: 33, samples: 1 };
    let settings = AuditSettings { picture, most_rays: 100 };
    let pixel = UVec2::new(16, 16);
    let audit =
        audit(&scene, &render_scene, render_scene.camera(), pixel, &settings, &RenderControl::default())
            .unwrap();
    assert_eq!((audit.trees[0].nodes.len(), audit.proof), (100, Proof::Incomplete));
    assert!(audit.trees[0].left_out > 0);
    assert_eq!(bits(audit.light), bits(rendered(&scene, picture).pixels()[16 * 33 + 16]));
    // What is there is the heaviest part.
    assert!(audit.sum.max_element() < audit.light[0].into());
    let weight = |fate_is_left_out: bool| {
        let answers = audit.trees[0].nodes.iter().filter_map(|node| node.answer());
        let branches = answers.flat_map(|answer| [answer.reflected, answer.refracted]);
        let wanted = branches.filter(move |branch| {
            if fate_is_left_out {
                branch.fate == BranchOutcome::LeftOut
            } else {
                matches!(branch.fate, BranchOutcome::Followed(_))
            }
        });
        wanted.map(|branch| branch.weight.max_element())
    };
    let (heaviest_left, lightest_taken) =
        (weight(true).fold(0.0, f32::max), weight(false).fold(1.0, f32::min));
    assert!(heaviest_left <= lightest_taken, "{heaviest_left} {lightest_taken}");
    assert_sound(&audit);
    for text in [audit.to_text(None), audit.to_dot(None), audit.to_svg(None), audit.to_json().to_string()] {
        assert!(text.contains("eft"), "{text}");
    }
}

#[test]
fn ends_of_branches_have_reasons() {
    let mut scene = Example::find("whitted").unwrap().load().unwrap().scene;
    scene.tracing.generations = 3;
    scene.tracing.threshold = 0.05;
    let settings = RenderSettings { width: 64, height: 36, samples: 1 };
    let mut seen = [0; 5];
    for number in 0..64 * 36 {
        let audit = look(&scene, settings, UVec2::new(number % 64, number / 64));
        for answer in audit.trees[0].nodes.iter().filter_map(|node| node.answer()) {
            for branch in [answer.reflected, answer.refracted] {
                let largest = branch.weight.max_element();
                let kind = match branch.fate {
                    BranchOutcome::Followed(_) => 0,
                    BranchOutcome::Nothing => {
                        assert_eq!(largest, 0.0);
                        1
                    }
                    BranchOutcome::TotalReflection => 2,
                    BranchOutcome::GenerationLimit => 3,
                    BranchOutcome::Threshold => {
                        assert!(largest < 0.05 && largest > 0.0);
                        4
                    }
                    BranchOutcome::LeftOut => panic!("nothing is left out here"),
                };
                seen[kind] += 1;
            }
        }
    }
    assert!([0, 1, 3, 4].iter().all(|&kind| seen[kind] > 0), "{seen:?}");
}

#[test]
fn the_part_whose_surface_is_met_is_named() {
    // An empty part keeps its place; the rod goes through the shell, which is a lens around nothing.
    let text = "format = 'catoptric/1'
        [camera]
        position = [0, 0, 9]
        target = [0, 0, 0]
        projection = 'parallel'
        height = 4
        [[lights]]
        position = [0, 0, 50]
        [[bodies]]
        name = 'things'
        shape = 'group'
        [[bodies.parts]]
        shape = 'intersection'
        [[bodies.parts.parts]]
        [[bodies.parts.parts]]
        position = [9, 0, 0]
        [[bodies.parts]]
        name = 'shell'
        shape = 'difference'
        material = { model = 'dielectric', ior = 1.0 }
        [[bodies.parts.parts]]
        name = 'whole'
        [[bodies.parts.parts]]
        radius = 0.5
        [[bodies.parts]]
        shape = 'tube'
        position = [1.5, -1, 0]
        height = 2.0
        [[bodies]]
        name = 'wall'
        shape = 'cube'
        size = [9, 9, 1]
        position = [0, 0, -5]
        [[bodies]]
        instance_of = 'things'
        position = [0, 0, 30]";
    let scene = catoptric_scene::read(text).into_result().unwrap().value;
    let picture = RenderSettings { width: 64, height: 64, samples: 1 };
    let met = |x: u32| {
        let found = look(&scene, picture, UVec2::new(x, 32));
        let hits: Vec<(String, Option<String>)> = found.trees[0]
            .nodes
            .iter()
            .filter(|node| node.kind != NodeKind::Reflected)
            .filter_map(|node| node.ray.hit)
            .map(|hit| (found.names.body(hit.body), found.names.part(hit.body, hit.part).map(str::to_owned)))
            .collect();
        (hits, found)
    };
    let things = |part: &str| ("\"things\"".to_owned(), Some(part.to_owned()));
    let (hits, found) = met(31);
    let wall = ("\"wall\"".to_owned(), None);
    let [whole, hollow] = ["parts.shell.parts.whole", "parts.shell.parts.1"].map(things);
    assert_eq!(hits, [whole.clone(), hollow.clone(), hollow, whole, wall]);
    assert!(found.to_text(None).contains("\"things\", parts.shell.parts.whole after"));
    let shadow = found.trees[0].nodes.last().unwrap().answer().unwrap().lights[0].shadow.clone().unwrap();
    let crossed: Vec<_> =
        shadow.crossings.iter().map(|crossing| found.names.part(crossing.body, crossing.part)).collect();
    let through =
        ["parts.shell.parts.whole", "parts.shell.parts.1", "parts.shell.parts.1", "parts.shell.parts.whole"];
    // First those of the body before the wall, then those of its instance.
    assert_eq!(crossed, [through, through].concat().into_iter().map(Some).collect::<Vec<_>>());
    // Nobody gave the parts of a tube.
    assert_eq!(met(55).0.first(), Some(&things("parts.2")));
}

/// Cemented bodies are told by name, with the indices on both sides, and the picture is the sum of the audit's numbers.
#[test]
fn cemented_bodies_are_told() {
    let text = "format = 'catoptric/1'
        [environment]
        contact = 'cemented'
        [camera]
        position = [0.3, 2.6, 0.5]
        target = [0, 0, 0]
        [[lights]]
        name = 'lamp'
        position = [2, 8, 1]
        [[bodies]]
        name = 'crown'
        shape = 'cube'
        position = [0, 1, 0]
        material = { model = 'dielectric', ior = 1.52 }
        [[bodies]]
        name = 'flint'
        shape = 'cube'
        material = { model = 'dielectric', ior = 1.62 }
        [[bodies]]
        name = 'foot'
        shape = 'cube'
        position = [0, -1, 0]
        material = { model = 'dielectric', ior = 1.62 }
        [[bodies]]
        name = 'floor'
        shape = 'plane'
        position = [0, -1.5, 0]";
    let scene = catoptric_scene::read(text).into_result().unwrap().value;
    let picture = RenderSettings { width: 32, height: 32, samples: 1 };
    let found = look(&scene, picture, UVec2::splat(16));
    assert_sound(&found);
    assert_eq!(bits(found.light), bits(rendered(&scene, picture).pixel(16, 16).unwrap()));
    let words = found.to_text(None);
    for told in [
        "(cemented: from \"crown\", index 1.52, to \"flint\", index 1.62)",
        "(cemented: from \"flint\", index 1.62, to \"foot\", index 1.62)",
        "no surface: light goes on as in one body",
        "leaves \"foot\" into \"flint\" at",
    ] {
        assert!(words.contains(told), "{told} in\n{words}");
    }
    let json = found.to_json().to_string();
    assert!(json.contains("\"seamless\":true") && json.contains("\"seamless\":false"));
}

#[test]
fn pixels_beyond_the_picture_are_refused() {
    let scene = Scene::default();
    let render_scene = RenderScene::build(&scene).unwrap();
    let try_at = |pixel: UVec2, width: u32| {
        let picture = RenderSettings { width, height: 4, samples: 1 };
        let settings = AuditSettings { picture, ..AuditSettings::default() };
        audit(&scene, &render_scene, render_scene.camera(), pixel, &settings, &RenderControl::default())
    };
    for pixel in [UVec2::new(4, 0), UVec2::new(0, 4), UVec2::MAX] {
        let error = try_at(pixel, 4).unwrap_err();
        assert!(matches!(error, AuditError::NoSuchPixel { .. }), "{error}");
    }
    assert!(matches!(try_at(UVec2::ZERO, 0), Err(AuditError::Size(_))));
    assert_eq!(
        try_at(UVec2::new(3, 3), 4).unwrap().light,
        scene.environment.background.to_array().map(|c| c as f32)
    );
}

#[test]
fn a_cancelled_audit_has_no_result() {
    let scene = glass_heap();
    let render_scene = RenderScene::build(&scene).unwrap();
    let picture = RenderSettings { width: 9, height: 9, samples: 1 };
    let settings = AuditSettings { picture, most_rays: usize::MAX };
    let control = RenderControl::default();
    control.cancel();
    let outcome = audit(&scene, &render_scene, render_scene.camera(), UVec2::new(4, 4), &settings, &control);
    assert!(matches!(outcome, Err(AuditError::Cancelled)));
}

#[test]
fn names_are_harmless_in_every_format() {
    let mut scene = glass_heap();
    scene.environment.background = Color::WHITE;
    scene.tracing.generations = 2;
    for index in 0..27 {
        if let Some(body) = scene.bodies.get_mut(index) {
            body.name = format!("<b\"&\\{index}>");
        }
    }
    let audit = look(&scene, RenderSettings { width: 9, height: 9, samples: 1 }, UVec2::new(4, 4));
    let svg = audit.to_svg(None);
    assert!(svg.contains("&lt;b&quot;&amp;") && !svg.contains("<b"), "{svg}");
    assert!(audit.to_dot(None).contains("<b\\\"&amp;\\\\"));
}
