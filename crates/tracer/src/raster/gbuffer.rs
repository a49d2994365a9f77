//! The geometry buffer: for each pixel the point that it shows, and how it is lit (Saito, Takahashi 1990).

pub(crate) mod depth_pyramid;

use catoptric_picture::{Picture, SizeError};
use glam::{DVec2, UVec2};

use crate::geometry::body::SurfacePoint;
use crate::geometry::ray::{NO_BODY, RayOrigin};
use crate::raster::error::MethodError;
use crate::raster::gbuffer::depth_pyramid::DepthPyramid;
use crate::raster::point_shader::{PointShader, color_at, exact};
use crate::raster::sample_sums::FrameSize;
use crate::simd::vector::Vector;
use crate::transport::camera::{RenderCamera, ScreenDepth};
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::render::FirstHitBuffers;
use crate::transport::sampling::sample_offset;
use crate::transport::scene::RenderScene;

/// The point that a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GBufferTexel {
    /// Body and side; of background no body.
    pub(crate) start: RayOrigin,
    /// Distance along the view, meters; infinite for background.
    pub(crate) depth: f32,
    /// World space, meters.
    pub(crate) position: Vector<f32>,
    /// Unit normal facing the viewer.
    pub(crate) normal: Vector<f32>,
}

const NOTHING: Vector<f32> = Vector { x: 0.0, y: 0.0, z: 0.0 };

impl GBufferTexel {
    pub(crate) const EMPTY: Self =
        Self { start: RayOrigin::FREE, depth: f32::INFINITY, position: NOTHING, normal: NOTHING };

    pub(crate) fn is_empty(&self) -> bool {
        self.start.body == NO_BODY
    }

    /// The point of the body.
    fn point(&self, scene: &RenderScene) -> SurfacePoint<f32> {
        let in_body = scene.geometry.body(self.start.body).point_in_body(self.position);
        SurfacePoint { in_body, in_world: self.position, normal: self.normal }
    }
}

/// What can be looked at of the buffers behind a picture, for [`MethodOutput::layer`](crate::raster::output::MethodOutput::layer).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GBufferLayer {
    /// The least depth of the picture divided by the depth: white is near, black the background.
    Depth,
    /// The normal facing the viewer: red, green and blue are its x, y and z from -1 (black) to 1.
    Normal,
    /// The color C of the body.
    Color,
    /// The coefficients k_d, k_s and k_r as red, green and blue.
    Coefficients,
    /// A color of its own for each body.
    Body,
    /// The local terms: what a reflected ray finds on the screen.
    Lit,
    /// What reflected rays found, before it is multiplied by k_r; black where nothing reflects.
    Reflected,
}

impl GBufferLayer {
    /// All layers.
    pub const ALL: [Self; 7] =
        [Self::Depth, Self::Normal, Self::Color, Self::Coefficients, Self::Body, Self::Lit, Self::Reflected];

    /// The layer's name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::Color => "color",
            Self::Coefficients => "coefficients",
            Self::Body => "body",
            Self::Lit => "lit",
            Self::Reflected => "reflected",
        }
    }
}

/// The buffers of one sample of a picture.
#[derive(Clone, Debug)]
pub(crate) struct GBuffer {
    pub(crate) frame: FrameSize,
    /// Where the sample lies in its pixel.
    pub(crate) offset: DVec2,
    depth: ScreenDepth,
    pub(crate) hits: FirstHitBuffers,
    pub(crate) depths: DepthPyramid,
    /// The local terms.
    pub(crate) lit: Vec<[f32; 3]>,
    /// What reflected rays brought.
    pub(crate) reflected: Vec<[f32; 3]>,
}

impl GBuffer {
    pub(crate) fn new(frame: FrameSize, camera: &RenderCamera) -> Result<Self, SizeError> {
        let hits = FirstHitBuffers {
            positions: frame.touched()?,
            normals: frame.touched()?,
            surfaces: frame.touched()?,
        };
        Ok(Self {
            frame,
            offset: sample_offset(0),
            depth: ScreenDepth::new(camera),
            hits,
            depths: DepthPyramid::new(frame),
            lit: frame.touched()?,
            reflected: frame.zeroed()?,
        })
    }

    /// What a pixel shows, if it is one.
    pub(crate) fn texel(&self, pixel: usize) -> Option<GBufferTexel> {
        let surface = self.hits.surfaces.get(pixel)?;
        let [position, normal] = [&self.hits.positions, &self.hits.normals]
            .map(|plane| plane.get(pixel).map_or(NOTHING, |&[x, y, z]| Vector::new(x, y, z)));
        Some(if surface.is_empty() {
            GBufferTexel::EMPTY
        } else {
            let depth = self.depth.meters(surface.depth);
            GBufferTexel { start: RayOrigin::of_word(surface.start), depth, position, normal }
        })
    }

    /// Finds the points of a sample and their local light.
    pub(crate) fn find_first_hits(
        &mut self,
        scene: &RenderScene,
        camera: &RenderCamera,
        sample: u32,
        control: &RenderControl,
    ) -> Result<RayCounts, MethodError> {
        self.offset = sample_offset(sample);
        let size = UVec2::new(self.frame.width as u32, self.frame.height as u32);
        Ok(self.hits.find(&mut self.lit, (scene, camera), size, sample, control)?)
    }

    /// A layer as a picture.
    pub(crate) fn picture(&self, scene: &RenderScene, layer: GBufferLayer) -> Result<Picture, SizeError> {
        let depths = self.hits.surfaces.iter().map(|texel| texel.depth);
        let nearest = self.depth.meters(depths.fold(ScreenDepth::NOTHING, f32::min));
        let color = |index: usize| -> Option<Vector<f32>> {
            match layer {
                GBufferLayer::Lit => return self.lit.get(index).map(|&[x, y, z]| Vector::new(x, y, z)),
                GBufferLayer::Reflected => {
                    return self.reflected.get(index).map(|&[x, y, z]| Vector::new(x, y, z));
                }
                _ => {}
            }
            let texel = self.texel(index).filter(|texel| !texel.is_empty())?;
            let material = scene.material(scene.geometry.body(texel.start.body));
            Some(match layer {
                GBufferLayer::Depth => Vector::splat(0.0, [nearest / texel.depth; 3]),
                GBufferLayer::Normal => texel.normal.map(|part| 0.5 * part + 0.5),
                GBufferLayer::Coefficients => {
                    Vector::new(material.diffuse, material.specular, material.reflection)
                }
                GBufferLayer::Body => color_at_number(scene.scene_index(texel.start.body)?),
                _ => color_at(scene, texel.start.body, &texel.point(scene)),
            })
        };
        let width = self.frame.width;
        Picture::from_fn(width as u32, self.frame.height as u32, |x, y| {
            let Vector { x, y, z } = color(y as usize * width + x as usize).unwrap_or(NOTHING);
            [x, y, z]
        })
    }
}

/// The point that the ray through a place of the picture meets.
pub(crate) fn seen(
    scene: &RenderScene,
    camera: &RenderCamera,
    probe: &mut PointShader<'_>,
    at: DVec2,
    size: DVec2,
) -> GBufferTexel {
    let ray = camera.ray(at, size);
    let rays = ray.alone();
    let Some(hit) = probe.primary(&ray) else {
        return GBufferTexel::EMPTY;
    };
    let point = scene.geometry.surface_point(hit.body, (rays.origin, rays.direction), hit.t, hit.leaving);
    GBufferTexel {
        start: RayOrigin { body: hit.body, inwards: hit.leaving },
        depth: camera.depth(exact(point.in_world)) as f32,
        position: point.in_world,
        normal: point.normal,
    }
}

/// Colors that are far apart for neighboring numbers: hues a golden section of the circle apart.
fn color_at_number(number: usize) -> Vector<f32> {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let hue = (number as f64 * GOLDEN).fract() as f32 * 6.0;
    // The ramps of red, green and blue around the circle of hues.
    let ramp = |middle: f32| (2.0 - ((hue - middle + 9.0) % 6.0 - 3.0).abs()).clamp(0.0, 1.0);
    Vector::new(ramp(0.0), ramp(2.0), ramp(4.0)).map(|part| 0.15 + 0.7 * part)
}
