use catoptric_scene::{Body, Camera, MaterialChoice, Phong, Placement, Projection, Scene, Shape};
use glam::{DVec2, UVec2};
use proptest::prelude::*;

use super::*;
use crate::geometry::ray::RayOrigin;
use crate::raster::gbuffer::depth_pyramid::DepthPyramid;
use crate::raster::sample_sums::FrameSize;
use crate::simd::wide::SimdLevel;
use crate::simd::{SimdKernel, Width};
use crate::transport::pick::RayIntersection;
use crate::transport::render::RenderSettings;
use crate::transport::sampling::sample_offset;
use crate::transport::scene::RenderScene;

const RAYS: usize = 16;

/// A march of rays side by side, by the instructions of a width.
struct MarchKernel<'a> {
    screen: &'a ScreenMarcher<'a>,
    texels: [&'a GBufferTexel; RAYS],
    directions: [DVec3; RAYS],
}

impl SimdKernel for MarchKernel<'_> {
    type Output = [MarchOutcome; RAYS];

    #[inline(always)]
    fn run<W: Width>(self, _: W) -> [MarchOutcome; RAYS] {
        self.screen.march_all(self.texels, vector64(self.directions), (1 << RAYS) - 1)
    }
}

/// The points of a sample, by one ray at a time: so these tests need no code of the other widths.
fn find_first_hits(buffer: &mut GBuffer, scene: &RenderScene, sample: u32) {
    buffer.offset = sample_offset(sample);
    let FrameSize { width, height } = buffer.frame;
    let size = DVec2::new(width as f64, height as f64);
    for (index, texel) in buffer.texels.iter_mut().enumerate() {
        let at = DVec2::new((index % width) as f64, (index / width) as f64) + buffer.offset;
        let ray = scene.camera().ray(at, size);
        *texel = match scene.closest_hit(&ray) {
            Some(RayIntersection { hit, position, normal, .. }) => {
                let position = position - scene.geometry.space.origin;
                GBufferTexel {
                    start: RayOrigin { body: hit.body, inwards: hit.leaving },
                    depth: scene.camera().depth(position) as f32,
                    position: position.as_vec3().into(),
                    normal: normal.into(),
                }
            }
            None => GBufferTexel { normal: ray.direction.into(), ..GBufferTexel::EMPTY },
        };
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
        let mut buffer = GBuffer::new(FrameSize::new(settings).unwrap()).unwrap();
        find_first_hits(&mut buffer, &scene, sample);
        let mut unknown = buffer.clone();
        unknown.depths = DepthPyramid::unknown(buffer.frame);
        buffer.depths.find(&buffer.texels);
        let how = SsrSettings { step_pixels, thickness, refinements, ..SsrSettings::default() };
        let screen = ScreenMarcher::new(&buffer, scene.camera(), &how);
        let mark_by_mark = ScreenMarcher::new(&unknown, scene.camera(), &how);
        let seen: Vec<&GBufferTexel> = buffer.texels.iter().filter(|texel| !texel.is_empty()).collect();
        for texels in seen.chunks_exact(RAYS) {
            let texels: [&GBufferTexel; RAYS] = texels.try_into().unwrap();
            let directions = texels.map(|texel| texel.reflected(scene.camera()));
            let alone: [MarchOutcome; RAYS] =
                std::array::from_fn(|lane| mark_by_mark.march(texels[lane], directions[lane]));
            let directions = directions.map(exact);
            for (name, level) in SimdLevel::all() {
                let found = level.run_in_few(MarchKernel { screen: &screen, texels, directions });
                prop_assert_eq!(found, alone, "{}", name);
            }
        }
    }
}
