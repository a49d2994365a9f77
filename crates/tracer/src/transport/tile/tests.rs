//! Rays side by side and rays by themselves have the same outcome.

use std::path::Path;

use glam::UVec2;

use super::*;
use crate::geometry::AcceleratorChoice;
use crate::simd::scalar::ScalarWidth;
use crate::simd::wide::SimdLevel;

const SIZE: (usize, usize) = (90, 50);

/// The light of a picture's pixels, traced in one width, and the rays that it took.
fn trace<const FULL: bool>(
    render_scene: &RenderScene,
    trace: impl FnMut(TileSampleKernel<'_, '_, '_, FULL>) -> bool,
) -> (Vec<[f32; 3]>, RayCounts) {
    trace_parts(render_scene, TILE, trace)
}

/// The light of a picture's pixels and the rays that it took, each square of the picture traced after the other.
fn trace_parts<const FULL: bool>(
    render_scene: &RenderScene,
    edge: usize,
    mut trace: impl FnMut(TileSampleKernel<'_, '_, '_, FULL>) -> bool,
) -> (Vec<[f32; 3]>, RayCounts) {
    let control = RenderControl::default();
    let mut tracer = TileRenderer::new(render_scene, render_scene.camera(), &control);
    let size = DVec2::new(SIZE.0 as f64, SIZE.1 as f64);
    let mut light = Vec::new();
    for place in TileRect::all(SIZE.0, SIZE.1, edge) {
        let mut written = vec![[0.0; 3]; place.pixels()];
        let mut rows: Vec<_> = written.chunks_mut(place.width).collect();
        assert!(trace(TileSampleKernel { tracer: &mut tracer, place, size, sample: 1, rows: &mut rows }));
        for (y, written) in written.chunks(place.width).enumerate() {
            let mut row = vec![[0.0; 3]; place.width];
            tracer.light.each(y, &mut row, |pixel, light| *pixel = light);
            assert_eq!(row, written, "row {y} of {place:?}");
            light.extend(row);
        }
    }
    (light, tracer.counts())
}

/// Only the order differs in which the light of a pixel's rays is summed, in double precision: the last digit of the sum
/// may be rounded the other way. Widths that round products before they are added, on a processor that need not, may let
/// a ray at an edge meet another body.
#[test]
fn all_widths_trace_the_same_picture() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference");
    let plain = ["whitted", "corridor", "transforms", "coloured-glass", "inside", "parallel", "cloud"];
    let physical =
        ["bubble", "gold", "lacquer", "rough-glass", "rough-metal-03", "soft-shadow", "surroundings"];
    let physical = physical.map(|name| format!("../mitsuba/{name}"));
    let patterned = ["../../crates/scene/examples/textures".to_owned()];
    for name in plain.map(str::to_owned).into_iter().chain(physical).chain(patterned) {
        let scene = catoptric_store::load(folder.join(format!("{name}.toml"))).unwrap().scene;
        let render_scene = RenderScene::build(&scene).unwrap();
        let (alone, rays) = trace::<true>(&render_scene, |sample| sample.run(ScalarWidth));
        for (lanes_name, lanes) in SimdLevel::all() {
            let (wide, wide_rays) = if render_scene.is_full {
                trace::<true>(&render_scene, |sample| lanes.run(sample))
            } else {
                trace::<false>(&render_scene, |sample| lanes.run(sample))
            };
            let same = lanes.rounds_like_widest();
            let tolerance = if same { f32::EPSILON } else { 1.0 / 255.0 };
            let differ = |(a, b): (&f32, &f32)| (a - b).abs() > tolerance * a.abs();
            let off = wide.iter().flatten().zip(alone.iter().flatten()).filter(|&pair| differ(pair)).count();
            let allowed = if same { 0 } else { alone.len() / 100 };
            assert!(off <= allowed, "{name}, {lanes_name}: {off} channels differ");
            assert!(!same || wide_rays == rays, "{name}, {lanes_name}: {wide_rays:?} instead of {rays:?}");
        }
    }
}

#[test]
fn the_hierarchy_leaves_out_nothing_that_is_met() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference/cloud.toml");
    let mut scene = catoptric_store::load(file).unwrap().scene;
    // Some of them glass, so that shadow rays go on behind what they meet.
    let glass = catoptric_scene::Phong { transmission: 0.7, ior: 1.3, ..Default::default() };
    for at in (0..scene.bodies.len()).step_by(3) {
        let body = scene.bodies.get_mut(at).unwrap();
        body.material = catoptric_scene::MaterialChoice::own(glass.clone());
    }
    let taken = |search, lanes: SimdLevel| {
        let render_scene = RenderScene::build_with(&scene, search).unwrap();
        trace::<false>(&render_scene, |sample| lanes.run(sample))
    };
    for (name, lanes) in SimdLevel::all() {
        assert!(
            taken(AcceleratorChoice::Quickest, lanes) == taken(AcceleratorChoice::OneByOne, lanes),
            "{name}"
        );
    }
}

/// A group of tiles shows what its tiles show one by one.
#[test]
fn groups_show_what_tiles_show() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference");
    // With rays that wait in many levels, and with chance.
    for name in ["cloud", "coloured-glass", "../mitsuba/soft-shadow"] {
        let scene = catoptric_store::load(folder.join(format!("{name}.toml"))).unwrap().scene;
        let render_scene = RenderScene::build(&scene).unwrap();
        for (lanes_name, lanes) in SimdLevel::all() {
            let taken = |edge| trace_parts::<true>(&render_scene, edge, |sample| lanes.run(sample));
            let ((tiles, rays), (group, group_rays)) = (taken(TILE), taken(GROUP * TILE));
            assert_eq!(group_rays, rays, "{name}, {lanes_name}");
            // The group is one square, row by row; the tiles stand one after the other.
            let place = |x: usize, y: usize| {
                if x < TILE { y * TILE + x } else { TILE * SIZE.1 + y * (SIZE.0 - TILE) + x - TILE }
            };
            for (at, light) in group.iter().enumerate() {
                let tile = glam::Vec3::from(tiles[place(at % SIZE.0, at / SIZE.0)]);
                let off = (tile - glam::Vec3::from(*light)).abs();
                assert!(
                    off.cmple(f32::EPSILON * tile.abs()).all(),
                    "{name}, {lanes_name}: {light:?} for {tile}"
                );
            }
        }
    }
}

/// Among very many bodies rays from the eye go by streams, too.
#[test]
fn streams_from_the_eye_see_what_single_rays_see() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference/cloud.toml");
    let mut scene = catoptric_store::load(file).unwrap().scene;
    let cloud = std::mem::take(&mut scene.bodies);
    for number in 0..128 {
        let offset = -4.0 * glam::UVec3::new(number % 4, number / 4 % 4, number / 16).as_dvec3();
        scene.bodies.extend(cloud.iter().map(|body| {
            let mut body = body.clone();
            body.placement = body.placement.moved_by(offset);
            body
        }));
    }
    let render_scene = RenderScene::build(&scene).unwrap();
    let (light, _) = trace::<false>(&render_scene, |sample| SimdLevel::widest().run(sample));
    let cancel = std::sync::atomic::AtomicBool::new(false);
    let mut alone = WhittedIntegrator::new(&render_scene, &cancel);
    assert!(render_scene.eye_goes_by_streams());
    let size = UVec2::new(SIZE.0 as u32, SIZE.1 as u32);
    let pixels = TileRect::all(SIZE.0, SIZE.1, TILE).flat_map(|place| {
        let pixel = move |at| UVec2::new(at % place.width as u32, at / place.width as u32);
        (0..place.pixels() as u32).map(move |at| UVec2::new(place.x as u32, place.y as u32) + pixel(at))
    });
    for (pixel, light) in pixels.zip(light).step_by(7) {
        let mut sum = glam::DVec3::ZERO;
        assert!(alone.pixel_rays(pixel, size, 1, usize::MAX, |_, light| sum += light.as_dvec3()));
        let (alone, off) = (sum.as_vec3(), (sum.as_vec3() - glam::Vec3::from(light)).abs());
        assert!(off.cmple(f32::EPSILON * alone.abs()).all(), "{pixel}: {light:?} instead of {alone}");
    }
}

#[test]
fn a_block_at_the_border_has_no_pixels_beyond_it() {
    let place = TileRect { x: 64, y: 0, width: 3, height: 2 };
    assert_eq!(PixelBlock::<ScalarWidth>::lanes(place, 2, 1), 1);
    assert_eq!(PixelBlock::<ScalarWidth>::lanes(place, 3, 1), 0);
}

/// Pixels are numbered by blocks and handed out by rows, whatever the size of the tile.
#[test]
fn light_comes_back_row_by_row() {
    let place = TileRect { x: 0, y: 0, width: 7, height: 6 };
    let mut light = TileRadiance::default();
    light.begin(place, [4, 4]);
    for block in 0..4 {
        let (left, top) = (4 * (block % 2), 4 * (block / 2));
        for lane in 0..16 {
            let at = [left + lane % 4, top + lane / 4, 1].map(|number| number as f32);
            light.set::<ScalarWidth>(16 * block + lane, Vector::from(glam::Vec3::from(at)));
        }
    }
    for y in 0..place.height {
        let mut row = vec![[0.0; 3]; place.width];
        light.each(y, &mut row, |pixel, light| *pixel = light);
        let wanted: Vec<[f32; 3]> = (0..place.width).map(|x| [x as f32, y as f32, 1.0]).collect();
        assert_eq!(row, wanted);
    }
}
