//! Rays side by side, in every width that the processor has, and rays by themselves have the same outcome.

use std::path::Path;

use catoptric_scene::{
    Body, BodyContact, Dielectric, MaterialChoice, Phong, Placement, RefractiveIndex, Scene, Shape,
};
use catoptric_tracer::{
    AcceleratorChoice, Film, RenderControl, RenderOutput, RenderScene, RenderSettings, SimdLevel,
    WhittedIntegrator, render,
};
use glam::{DVec3, UVec2, UVec3};

const SMALL: RenderSettings = RenderSettings { width: 90, height: 50, samples: 2 };

/// A scene of `tests/reference`, or another one beside it.
fn scene(name: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference");
    catoptric_store::load(folder.join(format!("{name}.toml"))).unwrap().scene
}

/// Many balls, some of them glass: rays wait in many levels, and shadow rays go on behind what they meet.
fn cloud_with_glass() -> Scene {
    let mut scene = scene("cloud");
    let glass = Phong { transmission: 0.7, ior: 1.3, ..Default::default() };
    for at in (0..scene.bodies.len()).step_by(3) {
        let body = scene.bodies.get_mut(at).unwrap();
        body.material = MaterialChoice::own(glass.clone());
    }
    scene
}

/// A cube of so many blocks to a side, of two kinds of glass by turns that are cemented, on a floor.
fn cemented_blocks(side: u32) -> Scene {
    let mut scene = scene("whitted");
    let glass =
        [1.5, 1.7].map(|ior| Dielectric { index: RefractiveIndex::from(ior), ..Dielectric::default() });
    let size = 2.0 / f64::from(side);
    let block = |number: u32| {
        let place = [number % side, number / side % side, number / side / side];
        let at = DVec3::from(place.map(f64::from)) * size + DVec3::new(-1.0, 0.0, -1.0) + 0.5 * size;
        let glass = glass[place.iter().sum::<u32>() as usize % 2].clone();
        Body {
            shape: Shape::Cube { size: DVec3::splat(size) },
            placement: Placement::at(at),
            material: MaterialChoice::own(glass),
            contact: BodyContact::Cemented,
            ..Body::default()
        }
    };
    scene.bodies =
        (0..side.pow(3)).map(block).chain([Body { shape: Shape::Plane, ..Body::default() }]).collect();
    scene.tracing.generations = 5;
    scene
}

fn drawn(render_scene: &RenderScene, settings: RenderSettings) -> RenderOutput {
    render(render_scene, settings, &RenderControl::default()).unwrap()
}

/// A pixel by one ray at a time.
fn alone(tracer: &mut WhittedIntegrator<'_>, pixel: UVec2, settings: RenderSettings) -> [f32; 3] {
    let size = UVec2::new(settings.width, settings.height);
    let sum: DVec3 = (0..settings.samples)
        .map(|sample| {
            let mut sum = DVec3::ZERO;
            assert!(tracer.pixel_rays(pixel, size, sample, usize::MAX, |_, light| sum += light.as_dvec3()));
            sum.as_vec3().as_dvec3()
        })
        .sum();
    (sum / f64::from(settings.samples)).as_vec3().to_array()
}

/// How many channels of two pictures' pixels are not as close as a share of the first one's.
fn off(one: &[[f32; 3]], other: &[[f32; 3]], share: f32) -> usize {
    assert_eq!(one.len(), other.len());
    let is_close = |(a, b): &(&f32, &f32)| (*a - *b).abs() <= share * a.abs();
    one.iter().flatten().zip(other.iter().flatten()).filter(|pair| !is_close(pair)).count()
}

/// Only the order differs in which the light of a pixel's rays is summed, in double precision: the last digit of the sum
/// may be rounded the other way. Widths that round products before they are added, on a processor that need not, may let
/// a ray at an edge meet another body.
#[test]
fn all_widths_trace_the_same_picture() {
    let plain = ["whitted", "corridor", "transforms", "coloured-glass", "inside", "parallel", "cloud"];
    let physical =
        ["bubble", "gold", "lacquer", "rough-glass", "rough-metal-03", "soft-shadow", "surroundings"];
    let physical = physical.map(|name| format!("../mitsuba/{name}"));
    let patterned = ["../../crates/scene/examples/textures".to_owned()];
    let names = plain.map(str::to_owned).into_iter().chain(physical).chain(patterned);
    let cemented = [2, 4].map(|side| (format!("{side} cemented blocks to a side"), cemented_blocks(side)));
    for (name, scene) in names.map(|name| (name.clone(), scene(&name))).chain(cemented) {
        let render_scene = RenderScene::build(&scene).unwrap();
        let cancel = std::sync::atomic::AtomicBool::new(false);
        let mut tracer = WhittedIntegrator::new(&render_scene, &cancel);
        let pixels = (0..SMALL.height).flat_map(|y| (0..SMALL.width).map(move |x| UVec2::new(x, y)));
        let singly: Vec<[f32; 3]> = pixels.map(|pixel| alone(&mut tracer, pixel, SMALL)).collect();
        for (level_name, level) in SimdLevel::all() {
            let wide = drawn(&render_scene.clone().at_level(level), SMALL);
            let same = level.rounds_like_widest();
            let tolerance = if same { f32::EPSILON } else { 1.0 / 255.0 };
            let off = off(wide.picture.pixels(), &singly, tolerance);
            let allowed = if same { 0 } else { singly.len() / 100 };
            assert!(off <= allowed, "{name}, {level_name}: {off} channels differ");
            let rays = tracer.counts();
            assert!(
                !same || wide.counts == rays,
                "{name}, {level_name}: {:?} instead of {rays:?}",
                wide.counts
            );
        }
    }
}

#[test]
fn the_hierarchy_leaves_out_nothing_that_is_met() {
    let scene = cloud_with_glass();
    for (name, level) in SimdLevel::all() {
        let taken = |choice| drawn(&RenderScene::build_with(&scene, choice).unwrap().at_level(level), SMALL);
        let (quickest, one_by_one) = (taken(AcceleratorChoice::Quickest), taken(AcceleratorChoice::OneByOne));
        assert!(quickest.picture == one_by_one.picture, "{name}");
        assert_eq!(quickest.counts, one_by_one.counts, "{name}");
    }
}

/// Large pictures of scenes with a hierarchy are drawn by groups of tiles, a film tile by tile: both show the same.
#[test]
fn groups_show_what_tiles_show() {
    const LARGE: RenderSettings = RenderSettings { width: 1000, height: 600, samples: 1 };
    let plain = cloud_with_glass();
    let mut by_chance = plain.clone();
    by_chance.lights.iter_mut().for_each(|light| light.radius = 0.5);
    let scenes = [plain, by_chance].map(|scene| RenderScene::build(&scene).unwrap());
    assert!(scenes[1].is_noisy());
    let levels = || SimdLevel::all().into_iter();
    for (render_scene, (name, level)) in scenes.iter().flat_map(|scene| levels().map(move |at| (scene, at))) {
        let render_scene = render_scene.clone().at_level(level);
        let whole = drawn(&render_scene, LARGE);
        let mut film = Film::new(LARGE.width, LARGE.height).unwrap();
        let counts =
            film.add_sample(&render_scene, render_scene.camera(), &RenderControl::default()).unwrap();
        assert_eq!(counts, whole.counts, "{name}");
        let tiles = film.picture().unwrap();
        assert_eq!(off(tiles.pixels(), whole.picture.pixels(), f32::EPSILON), 0, "{name}");
    }
}

/// Among very many bodies rays from the eye go by streams, too.
#[test]
fn streams_from_the_eye_see_what_single_rays_see() {
    let mut scene = scene("cloud");
    let cloud = std::mem::take(&mut scene.bodies);
    for number in 0..128 {
        let offset = -4.0 * UVec3::new(number % 4, number / 4 % 4, number / 16).as_dvec3();
        scene.bodies.extend(cloud.iter().map(|body| {
            let mut body = body.clone();
            body.placement = body.placement.moved_by(offset);
            body
        }));
    }
    let render_scene = RenderScene::build(&scene).unwrap();
    assert!(render_scene.body_count() >= RenderScene::VERY_MANY);
    let picture = drawn(&render_scene, SMALL).picture;
    let cancel = std::sync::atomic::AtomicBool::new(false);
    let mut tracer = WhittedIntegrator::new(&render_scene, &cancel);
    for (at, light) in picture.pixels().iter().enumerate().step_by(7) {
        let pixel = UVec2::new(at as u32 % SMALL.width, at as u32 / SMALL.width);
        let singly = alone(&mut tracer, pixel, SMALL);
        assert_eq!(off(&[singly], &[*light], f32::EPSILON), 0, "{pixel}: {light:?} instead of {singly:?}");
    }
}
