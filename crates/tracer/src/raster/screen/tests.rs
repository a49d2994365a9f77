use catoptric_scene::{Body, Camera, MaterialChoice, Phong, Placement, Projection, Scene, Shape};
use glam::{DVec3, UVec2};
use proptest::prelude::*;

use super::*;
use crate::geometry::ray::RayOrigin;
use crate::raster::sample_sums::FrameSize;
use crate::simd::SimdKernel;
use crate::simd::wide::SimdLevel;
use crate::transport::camera::ScreenDepth;
use crate::transport::pick::RayIntersection;
use crate::transport::render::RenderSettings;
use crate::transport::sampling::sample_offset;
use crate::transport::scene::RenderScene;
use crate::transport::tile::hits::SurfaceTexel;

/// A march of the rays that are reflected in some pixels, by the instructions of a width.
struct MarchKernel<'a> {
    screen: &'a ScreenMarcher<'a>,
    pixels: &'a [usize],
    directions: &'a [Vector<f32>],
}

impl SimdKernel for MarchKernel<'_> {
    type Output = Vec<MarchOutcome>;

    #[inline(always)]
    fn run<W: Width>(self, w: W) -> Vec<MarchOutcome> {
        let mut outcomes = Vec::new();
        for (pixels, directions) in self.pixels.chunks(W::LANES).zip(self.directions.chunks(W::LANES)) {
            let mut numbers = [[0.0; MOST_LANES]; 6];
            let mut bodies = [0; MOST_LANES];
            for (lane, (&pixel, direction)) in pixels.iter().zip(directions).enumerate() {
                let buffer = self.screen.buffer;
                let texel = buffer.hits.surfaces[pixel];
                let (column, row) = (pixel % buffer.frame.width, pixel / buffer.frame.width);
                let Vector { x, y, z } = *direction;
                for (row, number) in numbers.iter_mut().zip([column as f32, row as f32, texel.depth, x, y, z])
                {
                    row[lane] = number;
                }
                bodies[lane] = texel.start & !INWARDS;
            }
            let [column, row, depth, x, y, z] = numbers.map(|numbers| w.load(&numbers));
            let (body, direction) = (w.load_words(&bodies), Vector::new(x, y, z));
            let rays = MarchRays { pixel: [column, row], depth, body, direction };
            let marched = self.screen.march_all(w, &rays, w.first(pixels.len()));
            outcomes.extend((0..pixels.len()).map(|lane| marched.outcome(lane)));
        }
        outcomes
    }
}

/// The points of a sample, by one ray at a time: so these tests need no code of the other widths.
fn find_first_hits(buffer: &mut GBuffer, scene: &RenderScene, sample: u32) {
    buffer.offset = sample_offset(sample);
    let screen_depth = ScreenDepth::new(scene.camera());
    let FrameSize { width, height } = buffer.frame;
    let size = DVec2::new(width as f64, height as f64);
    for index in 0..width * height {
        let at = DVec2::new((index % width) as f64, (index / width) as f64) + buffer.offset;
        let ray = scene.camera().ray(at, size);
        buffer.hits.surfaces[index] = SurfaceTexel::EMPTY;
        if let Some(RayIntersection { hit, position, normal, .. }) = scene.closest_hit(&ray) {
            let position: Vector<f32> = (position - scene.geometry.space.origin).as_vec3().into();
            let start = RayOrigin { body: hit.body, inwards: hit.leaving }.word();
            buffer.hits.positions[index] = position.into();
            buffer.hits.normals[index] = normal.to_array();
            buffer.hits.surfaces[index] = SurfaceTexel { depth: screen_depth.of_point(position), start };
        }
    }
}

/// Mirrors of several shapes in front of a camera.
fn scene(bodies: Vec<(u8, DVec3, f64)>, height: f64, is_parallel: bool) -> RenderScene {
    let body = |(kind, position, size): (u8, DVec3, f64)| {
        let shape = match kind {
            0 => Shape::SPHERE,
            1 => Shape::Cube { size: DVec3::new(size, 1.0, 0.3) },
            _ => Shape::Plane,
        };
        let position = if kind > 1 { DVec3::ZERO } else { position };
        let material = Phong { reflection: Some(0.5), ..Phong::default() }.into();
        let material = MaterialChoice::Inline(Box::new(material));
        Body { shape, placement: Placement::at(position), material, ..Body::default() }
    };
    let projection = match is_parallel {
        true => Projection::Parallel { height: 6.0 },
        false => Projection::Perspective { fov_degrees: 50.0 },
    };
    let position = DVec3::new(0.3, height, 7.0);
    let camera = Camera { position, target: DVec3::Y, projection, ..Camera::default() };
    let bodies = bodies.into_iter().map(body).collect::<Vec<_>>();
    RenderScene::build(&Scene { bodies: bodies.into(), camera, ..Scene::default() }).unwrap()
}

fn bodies() -> impl Strategy<Value = Vec<(u8, DVec3, f64)>> {
    let place = (-3.0..3.0, 0.2..2.5, -4.0..2.0).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    prop::collection::vec((0_u8..3, place, 0.2..4.0), 1..7)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Squares of pixels save time, and rays side by side do; neither changes what a ray meets.
    #[test]
    fn every_width_hits_what_one_ray_does_mark_by_mark(
        bodies in bodies(),
        height in 0.4..4.0,
        is_parallel in any::<bool>(),
        step_pixels in prop_oneof![Just(1.0), 0.25..9.0],
        thickness in prop_oneof![Just(0.1), 1e-3..3.0],
        refinements in 0_u32..9,
        sample in 0_u32..3,
    ) {
        let scene = scene(bodies, height, is_parallel);
        let size = UVec2::new(72, 50);
        let settings = RenderSettings { width: size.x, height: size.y, samples: 1 };
        let mut buffer = GBuffer::new(FrameSize::new(settings).unwrap(), scene.camera()).unwrap();
        find_first_hits(&mut buffer, &scene, sample);
        let mut unknown = buffer.clone();
        unknown.depths = DepthPyramid::unknown(buffer.frame);
        buffer.depths.find(SimdLevel::widest(), &buffer.hits.surfaces);
        let how = SsrSettings { step_pixels, thickness, refinements, ..SsrSettings::default() };
        let screen = ScreenMarcher::new(&buffer, scene.camera(), &how);
        let mark_by_mark = ScreenMarcher::new(&unknown, scene.camera(), &how);
        let pixels: Vec<usize> =
            (0..buffer.frame.pixels()).filter(|&pixel| !buffer.hits.surfaces[pixel].is_empty()).collect();
        let reflected = |pixel: &usize| {
            let texel = buffer.texel(*pixel).unwrap();
            screen.view.reflected(texel.position, texel.normal)
        };
        let directions: Vec<Vector<f32>> = pixels.iter().map(reflected).collect();
        prop_assert_eq!(difference(&screen, &mark_by_mark, &pixels, &directions), None);
    }

    /// Depths of no scene: bodies of any shape in front of each other, with steps from pixel to pixel.
    #[test]
    fn squares_pass_over_nothing_that_random_depths_have(
        patches in prop::collection::vec(patch(), 1..12),
        is_parallel in any::<bool>(),
        step_pixels in prop_oneof![Just(1.0), 0.25..9.0],
        thickness in prop_oneof![Just(0.1), 1e-3..3.0],
        seed in any::<u32>(),
    ) {
        let scene = scene(vec![(0, DVec3::Y, 1.0)], 1.0, is_parallel);
        let settings = RenderSettings { width: 300, height: 90, samples: 1 };
        let mut buffer = GBuffer::new(FrameSize::new(settings).unwrap(), scene.camera()).unwrap();
        buffer.hits.surfaces.fill(SurfaceTexel::EMPTY);
        // A linear congruential generator (Knuth 1997, vol. 2, sec. 3.3.4, table 1, line 25).
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32
        };
        for (body, Patch { corner, size, depth, slopes, noise }) in (0..).zip(patches) {
            for (row, column) in (corner[1]..corner[1] + size[1]).flat_map(|row| {
                (corner[0]..corner[0] + size[0]).map(move |column| (row, column))
            }) {
                let pixel = row % 90 * 300 + column % 300;
                let meters = depth + slopes[0] * column as f32 + slopes[1] * row as f32 + noise * random();
                let meters = meters.max(0.1);
                let depth = if is_parallel { meters } else { -1.0 / meters };
                buffer.hits.surfaces[pixel] = SurfaceTexel { depth, start: body };
                buffer.hits.normals[pixel] = [0.0, 0.0, 1.0];
            }
        }
        let mut unknown = buffer.clone();
        unknown.depths = DepthPyramid::unknown(buffer.frame);
        buffer.depths.find(SimdLevel::widest(), &buffer.hits.surfaces);
        let how = SsrSettings { step_pixels, thickness, ..SsrSettings::default() };
        let screen = ScreenMarcher::new(&buffer, scene.camera(), &how);
        let mark_by_mark = ScreenMarcher::new(&unknown, scene.camera(), &how);
        let is_shown = |pixel: &usize| !buffer.hits.surfaces[*pixel].is_empty();
        let pixels: Vec<usize> = (0..buffer.frame.pixels()).step_by(97).filter(is_shown).collect();
        let mut direction = |_: &usize| {
            let any = glam::Vec3::from_array([(); 3].map(|()| 2.0 * random() - 1.0));
            any.normalize_or(glam::Vec3::X).into()
        };
        let directions: Vec<Vector<f32>> = pixels.iter().map(&mut direction).collect();
        prop_assert_eq!(difference(&screen, &mark_by_mark, &pixels, &directions), None);
    }
}

/// A rectangle of pixels with one body.
#[derive(Clone, Debug)]
struct Patch {
    corner: [usize; 2],
    size: [usize; 2],
    /// Meters; and how it changes from pixel to pixel.
    depth: f32,
    slopes: [f32; 2],
    noise: f32,
}

fn patch() -> impl Strategy<Value = Patch> {
    let noise = prop_oneof![Just(0.0_f32), 0.0_f32..1.0];
    let place = ([0_usize..300, 0_usize..90], [1_usize..300, 1_usize..90]);
    (place, 2.0_f32..9.0, [-0.02_f32..0.02, -0.02_f32..0.02], noise)
        .prop_map(|((corner, size), depth, slopes, noise)| Patch { corner, size, depth, slopes, noise })
}

/// The first ray that has another outcome over squares in some width than mark by mark and alone.
fn difference(
    screen: &ScreenMarcher<'_>,
    mark_by_mark: &ScreenMarcher<'_>,
    pixels: &[usize],
    directions: &[Vector<f32>],
) -> Option<String> {
    let rays = pixels.iter().zip(directions);
    let alone: Vec<MarchOutcome> =
        rays.map(|(&pixel, &direction)| mark_by_mark.march(pixel, direction)).collect();
    SimdLevel::all().into_iter().find_map(|(name, level)| {
        let march = |screen| level.run_in_few(MarchKernel { screen, pixels, directions });
        let (found, one_by_one) = (march(screen), march(mark_by_mark));
        // Others round products, and have other last digits.
        let expected = if level.rounds_like_widest() { &alone } else { &one_by_one };
        if found.len() != pixels.len() || one_by_one.len() != pixels.len() {
            return Some(format!("{name}: {} rays", found.len()));
        }
        let mut pairs = found.iter().zip(expected).zip(pixels);
        let (pair, pixel) = pairs.find(|((found, expected), _)| found != expected)?;
        Some(format!("{name}, pixel {pixel}: {:?}, not {:?}", pair.0, pair.1))
    })
}
