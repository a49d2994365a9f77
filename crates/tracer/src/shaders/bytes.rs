//! The scene as the shaders read it.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::DVec2;
use rayon::prelude::*;

use crate::geometry::Accelerator;
use crate::geometry::body::RenderBody;
use crate::geometry::bvh::BvhNode;
use crate::shaders::constants::{FRAME_PLACES, MOST_MEDIA};
use crate::shaders::features::PhysicalFeatures;
use crate::shaders::joined;
use crate::shaders::materials;
use crate::shaders::pictures::PictureAtlas;
use crate::shaders::specialize::eye_media;
use crate::transport::camera::{CameraRays, RayDifferentials, RenderCamera};
use crate::transport::environment::EnvironmentLight;
use crate::transport::light::{LightFalloff, RenderLight};
use crate::transport::sampling::sample_offset;
use crate::transport::scene::RenderScene;
use crate::transport::scene::log::SceneChanges;
use crate::transport::surface::material::RenderMaterial;
use crate::transport::texture::solid::SolidNode;
use crate::transport::tile_rect::{TILE, TileRect};

/// Bytes to a body of [`SceneArrays::scene_order`].
const ORDER_BYTES: usize = size_of::<[u32; 2]>();

pub(crate) const FALLOFF_NONE: u32 = 0;
pub(crate) const FALLOFF_LINEAR: u32 = 1;
const FALLOFF_INVERSE_SQUARE: u32 = 2;

/// The arrays of a scene, each as the bytes of the shader's array of the same name.
#[derive(Clone, Copy)]
pub struct SceneArrays<'a>(pub &'a RenderScene);

impl<'a> SceneArrays<'a> {
    /// The bodies, as they stand in the scene.
    pub fn bodies(self) -> &'a [u8] {
        bytemuck::cast_slice(&self.0.geometry.bodies)
    }

    /// Nodes of the hierarchy, or bounding spheres, as they stand in the scene.
    pub fn boxes(self) -> &'a [u8] {
        match &self.0.geometry.hierarchy {
            Accelerator::Few => bytemuck::cast_slice(&self.0.geometry.spheres),
            Accelerator::Many(bvh) => bytemuck::cast_slice(bvh.nodes()),
        }
    }

    /// Which bytes of the bodies, of the boxes and of their order in the scene changes concern.
    pub fn parts(self, changes: &SceneChanges) -> [Vec<Range<usize>>; 3] {
        let bodies = |bytes: usize| {
            let range = |range: &Range<u32>| range.start as usize * bytes..range.end as usize * bytes;
            changes.bodies.iter().map(range).collect()
        };
        let node =
            |&node: &u32| node as usize * size_of::<BvhNode>()..(node as usize + 1) * size_of::<BvhNode>();
        [bodies(size_of::<RenderBody>()), changes.nodes.iter().map(node).collect(), bodies(ORDER_BYTES)]
    }

    /// Of each body its number in the scene and, if `ranked`, its place among all bodies in the order of their volumes
    /// (see [`ShaderSpecialization::asks_each_start`](super::ShaderSpecialization::asks_each_start)). Behind them what
    /// members of groups and parts belong to, and how bodies are joined.
    pub fn scene_order(self, ranked: bool) -> Vec<u8> {
        let scene = self.0;
        let mut order: Vec<[u32; 2]> = scene.geometry.numbers.iter().map(|&index| [index, 0]).collect();
        if ranked {
            let places = scene
                .geometry
                .bodies
                .par_iter()
                .zip(&scene.geometry.numbers)
                .zip(0_u32..scene.geometry.bodies.len() as u32);
            let mut volumes: Vec<(f64, u32, u32)> =
                places.map(|((body, &index), place)| (body.volume(), index, place)).collect();
            volumes.par_sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            for (rank, (_, _, place)) in (0..).zip(volumes) {
                if let Some(entry) = order.get_mut(place as usize) {
                    entry[1] = rank;
                }
            }
        }
        joined::add_to(&mut order, &scene.geometry);
        bytemuck::cast_slice(&order).to_vec()
    }

    /// The materials, in the form that the shader of the scene's [`ShaderSpecialization`](super::ShaderSpecialization) reads.
    pub fn materials(self) -> Vec<u8> {
        match PhysicalFeatures::of(self.0) {
            PhysicalFeatures::NOTHING => {
                let pictures = self.pictures();
                bytes(self.0.materials.iter().map(|material| MaterialBytes::of(material, &pictures)))
            }
            _ => bytes(materials::rows(self.0).into_iter()),
        }
    }

    /// The pictures around the bodies and on them.
    pub fn pictures(self) -> PictureAtlas {
        PictureAtlas::of(self.0)
    }

    /// The patterns.
    pub fn solids(self) -> Vec<u8> {
        bytes(self.0.solids.iter().map(SolidNode::rows))
    }

    /// The lights, in the form that the same shader reads.
    pub fn lights(self) -> Vec<u8> {
        match PhysicalFeatures::of(self.0) {
            PhysicalFeatures::NOTHING => bytes(self.0.lights.iter().map(LightBytes::of)),
            _ => bytes(self.0.lights.iter().map(SphereLightBytes::of)),
        }
    }
}

fn bytes<T: Pod>(records: impl Iterator<Item = T>) -> Vec<u8> {
    let records: Vec<T> = records.collect();
    bytemuck::cast_slice(&records).to_vec()
}

/// Twin of the shader's `Material` for scenes without physical materials.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct MaterialBytes {
    color: [f32; 3],
    ambient: f32,
    filter: [f32; 3],
    ior: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    reflection: f32,
}

impl MaterialBytes {
    fn of(material: &RenderMaterial, pictures: &PictureAtlas) -> Self {
        // All fields by name: what the shaders do not know must not be left out unnoticed.
        // Where the last ones mean anything, `laws.rs` packs them.
        let RenderMaterial {
            color,
            ambient,
            diffuse,
            specular,
            shininess,
            reflection,
            filter,
            ior,
            ref texture,
            law: _,
            dispersion: _,
            alpha: _,
            absorption: _,
        } = *material;
        let color = texture.as_ref().map_or(color, |texture| pictures.in_place_of_color(texture));
        Self { color, ambient, filter, ior, diffuse, specular, shininess, reflection }
    }
}

/// Twin of the shader's `Light`, and its beginning where lights may be balls.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct LightBytes {
    position: [f32; 3],
    falloff: u32,
    power: [f32; 3],
    constant: f32,
}

impl LightBytes {
    pub(crate) fn of(light: &RenderLight) -> Self {
        let RenderLight { position, power, falloff, radius: _, shines: _ } = *light;
        let (falloff, constant) = match falloff {
            LightFalloff::None => (FALLOFF_NONE, 0.0),
            LightFalloff::Linear(constant) => (FALLOFF_LINEAR, constant),
            LightFalloff::InverseSquare => (FALLOFF_INVERSE_SQUARE, 0.0),
        };
        Self { position, falloff, power, constant }
    }
}

/// What changes from picture to picture and from dispatch to dispatch: twin of the shader's `FrameUniforms`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct FrameUniforms {
    background: [f32; 3],
    generations: u32,
    ambient: [f32; 3],
    threshold: f32,
    horizon: [f32; 3],
    turn: f32,
    nadir: [f32; 3],
    scene_bodies: u32,
    size: [u32; 2],
    tiles_across: u32,
    first_tile: u32,
    bounded: u32,
    bodies: u32,
    lights: u32,
    largest_error_bound: f32,
    samples_done: u32,
    samples: u32,
    eye_media_count: u32,
    members: u32,
    eye_media: [u32; MOST_MEDIA],
    places: [[f32; 4]; FRAME_PLACES],
}

impl FrameUniforms {
    /// For a picture of `size` pixels.
    pub fn new(scene: &RenderScene, camera: &RenderCamera, size: [u32; 2]) -> Self {
        let media = eye_media(scene, camera);
        let nothing = [0.0; 3];
        let (background, horizon, nadir, turn) = match scene.sky {
            EnvironmentLight::Even(color) => (color, nothing, nothing, 0.0),
            EnvironmentLight::Gradient { zenith, horizon, nadir } => (zenith, horizon, nadir, 0.0),
            EnvironmentLight::Picture { image: _, turn, strength } => ([strength; 3], nothing, nothing, turn),
        };
        let mut frame = Self {
            background,
            horizon,
            nadir,
            turn,
            generations: scene.generations(),
            ambient: scene.ambient,
            threshold: scene.threshold(),
            size,
            tiles_across: tiles_across(size[0]),
            bounded: scene.geometry.bounded,
            bodies: scene.geometry.joined.first_part,
            lights: scene.lights.len() as u32,
            largest_error_bound: scene.geometry.largest_error_bound,
            eye_media_count: media.len().min(MOST_MEDIA) as u32,
            scene_bodies: scene.geometry.members.first,
            members: joined::members_of(&scene.geometry),
            ..Self::zeroed()
        };
        for (place, body) in frame.eye_media.iter_mut().zip(media) {
            *place = body;
        }
        frame
    }

    /// This frame for the tiles from `first_tile` on and `samples` further samples (at most [`FRAME_PLACES`]) of pixels
    /// that have `samples_done`.
    pub fn dispatch(&self, first_tile: u32, samples_done: u32, samples: u32) -> Self {
        let mut frame = Self { first_tile, samples_done, samples: samples.min(FRAME_PLACES as u32), ..*self };
        for (place, sample) in frame.places.iter_mut().zip(samples_done..) {
            let DVec2 { x, y } = sample_offset(sample);
            *place = [x as f32, y as f32, 0.0, 0.0];
        }
        frame
    }
}

fn tiles_across(width: u32) -> u32 {
    width.div_ceil(TILE as u32)
}

/// The primary rays of a tile: twin of the shader's `CameraRays`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct CameraRaysBytes {
    pub(crate) start: [f32; 3],
    pub(crate) way: f32,
    pub(crate) start_rest: [f32; 3],
    pub(crate) is_parallel: u32,
    pub(crate) direction: [f32; 3],
    pub(crate) unused_1: u32,
    pub(crate) direction_rest: [f32; 3],
    pub(crate) unused_2: u32,
    pub(crate) across: [f32; 3],
    pub(crate) unused_3: u32,
    pub(crate) down: [f32; 3],
    pub(crate) unused_4: u32,
}

impl CameraRaysBytes {
    /// The primary rays of a tile.
    fn new(rays: &CameraRays) -> Self {
        let (RayDifferentials::OfDirection([across, down]) | RayDifferentials::OfOrigin([across, down])) =
            rays.steps;
        Self {
            start: rays.start.near,
            way: rays.way,
            start_rest: rays.start.rest,
            is_parallel: u32::from(matches!(rays.steps, RayDifferentials::OfOrigin(_))),
            direction: rays.direction.near,
            direction_rest: rays.direction.rest,
            across,
            down,
            ..Self::zeroed()
        }
    }
}

/// The rays of all tiles of a picture of `size` pixels, row by row, computed in double precision by the threads of the
/// current rayon pool. All samples share them.
pub fn tile_rays(camera: &RenderCamera, size: [u32; 2]) -> Vec<CameraRaysBytes> {
    let [width, height] = size.map(|side| side as usize);
    let places: Vec<TileRect> = TileRect::all(width, height, TILE).collect();
    let size = DVec2::new(f64::from(size[0]), f64::from(size[1]));
    places.par_iter().map(|place| CameraRaysBytes::new(&place.rays_near(camera, size))).collect()
}

/// Twin of the shader's `Light` for scenes with physical materials.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct SphereLightBytes {
    light: LightBytes,
    radius: f32,
    unused: [f32; 3],
}

impl SphereLightBytes {
    pub(crate) fn of(light: &RenderLight) -> Self {
        Self { light: LightBytes::of(light), radius: light.radius, unused: [0.0; 3] }
    }
}
