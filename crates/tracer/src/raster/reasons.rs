//! Why a pixel drawn by a method differs from the traced one.

pub(crate) mod reference_pixel;
pub(crate) mod reflection;
pub(crate) mod shading;

use std::collections::BTreeMap;

use catoptric_picture::Picture;
use glam::{UVec2, Vec3};
use rayon::prelude::*;

use crate::geometry::ray::{Ray, RayOrigin};
use crate::raster::cube_map::cache::around;
use crate::raster::error::MethodError;
use crate::raster::method::Method;
use crate::raster::output::{FirstSampleBuffers, MethodOutput};
use crate::raster::reasons::reference_pixel::ReferencePixel;
use crate::raster::sample_sums::FrameSize;
use crate::transport::camera::RenderCamera;
use crate::transport::control::RenderControl;
use crate::transport::render::RenderSettings;
use crate::transport::scene::RenderScene;
use crate::transport::tile_rect::{TILE, TileRect};

/// Why a pixel differs from the traced truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Reason {
    /// `ssr`: what is reflected lies outside the picture, or behind the eye.
    LeftScreen,
    /// `ssr`: what is reflected is hidden from the eye, by another body or by the front of its own.
    Hidden,
    /// `ssr`: the ray passes behind a surface by less than the thickness and was taken to meet it.
    Thickness,
    /// `ssr`: what is reflected can be seen, but the march stepped over it.
    Step,
    /// `ssr`: what is reflected lies farther away than the range.
    OutOfRange,
    /// `cube-map`: the surroundings are seen from the body's center instead of the point that reflects.
    Parallax,
    /// `cube-map`: the body itself, or its shadow, is missing from its own map.
    SelfMissing,
    /// Pixels of the map or of the screen are too coarse for what is reflected.
    Sampling,
    /// `flat`, `gouraud`, `phong`: nothing is reflected.
    ReflectionMissing,
    /// What is reflected does not reflect or refract in its turn.
    SecondReflectionMissing,
    /// Nothing is seen through a transparent body.
    RefractionMissing,
    /// The body is made of flat faces: its outline, its points and its normals are not those of the body.
    Facet,
    /// Intensities were interpolated, not computed.
    Shading,
    /// Bodies do not shade each other.
    ShadowMissing,
    /// A highlight is missing (Lambert's model), or stands where the eye sees it and not the mirror.
    Highlight,
}

impl Reason {
    /// All reasons, in the order in which to show them.
    pub const ALL: [Self; 15] = [
        Self::LeftScreen,
        Self::Hidden,
        Self::Thickness,
        Self::Step,
        Self::OutOfRange,
        Self::Parallax,
        Self::SelfMissing,
        Self::Sampling,
        Self::ReflectionMissing,
        Self::SecondReflectionMissing,
        Self::RefractionMissing,
        Self::Facet,
        Self::Shading,
        Self::ShadowMissing,
        Self::Highlight,
    ];

    /// The reason's name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::LeftScreen => "left-screen",
            Self::Hidden => "hidden",
            Self::Thickness => "thickness",
            Self::Step => "step",
            Self::OutOfRange => "out-of-range",
            Self::Parallax => "parallax",
            Self::SelfMissing => "self-missing",
            Self::Sampling => "sampling",
            Self::ReflectionMissing => "reflection-missing",
            Self::SecondReflectionMissing => "second-reflection-missing",
            Self::RefractionMissing => "refraction-missing",
            Self::Facet => "facet",
            Self::Shading => "shading",
            Self::ShadowMissing => "shadow-missing",
            Self::Highlight => "highlight",
        }
    }
}

/// The reason of each pixel that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReasonMap {
    width: u32,
    height: u32,
    reasons: Vec<Option<Reason>>,
}

impl ReasonMap {
    /// Pixels across.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row from the top; `None` where the pictures agree.
    pub fn reasons(&self) -> &[Option<Reason>] {
        &self.reasons
    }

    /// How many pixels each reason has, those without any left out, in the order of [`Reason::ALL`].
    pub fn counts(&self) -> Vec<(Reason, u64)> {
        let count = |reason| self.reasons.iter().filter(|other| **other == Some(reason)).count() as u64;
        let counts = Reason::ALL.map(|reason| (reason, count(reason)));
        counts.into_iter().filter(|(_, count)| *count > 0).collect()
    }
}

/// Tells for each pixel of `drawing` of which a channel differs from `truth` by more than `bound` why it does. Light is
/// linear and not clamped. The method is that of the drawing; `truth` is the traced picture of the same scene and size. Of
/// a traced drawing, nothing is told.
///
/// Nothing is guessed: the tree of rays behind the pixel's center is traced, the light of its parts is held against what
/// the method has for each, and of the part that differs most it is traced why.
///
/// # Errors
/// When the sizes differ from those of `settings`, memory is short, or the work is cancelled.
pub fn reasons(
    scene: &RenderScene,
    method: &Method,
    settings: RenderSettings,
    truth: &Picture,
    drawing: &MethodOutput,
    bound: f64,
    control: &RenderControl,
) -> Result<ReasonMap, MethodError> {
    let frame = FrameSize::new(settings)?;
    for picture in [truth, &drawing.picture] {
        let (RenderSettings { width, height, .. }, of_picture) =
            (settings, [picture.width(), picture.height()]);
        if of_picture != [width, height] {
            return Err(MethodError::SizeMismatch { width, height, of_picture });
        }
    }
    let mut reasons: Vec<Option<Reason>> = frame.buffer(None)?;
    let groups = wrong_pixels(method, truth, drawing, bound);
    control.expect(groups.values().map(|pixels| pixels.len() as u64).sum());
    for (body, pixels) in groups {
        let others = body.map(|body| around(scene, body));
        let case =
            ReasonInput { scene, camera: scene.camera(), method, drawing, frame, others: others.as_ref() };
        let found = pixels.par_iter().map_init(
            || ReferencePixel::new(&case, control),
            |witness, &pixel| {
                if control.is_cancelled() {
                    return (pixel, None);
                }
                control.add_pixels(1);
                (pixel, case.reason(witness, pixel))
            },
        );
        let found: Vec<(usize, Option<Reason>)> = found.collect();
        for (pixel, reason) in found {
            reasons.get_mut(pixel).into_iter().for_each(|slot| *slot = reason);
        }
    }
    if control.is_cancelled() {
        return Err(MethodError::Cancelled);
    }
    Ok(ReasonMap { width: settings.width, height: settings.height, reasons })
}

/// The pixels that differ: those that a cube map served by the body that reflects, all others together.
fn wrong_pixels(
    method: &Method,
    truth: &Picture,
    drawing: &MethodOutput,
    bound: f64,
) -> BTreeMap<Option<u32>, Vec<usize>> {
    let mut groups: BTreeMap<Option<u32>, Vec<usize>> = BTreeMap::new();
    let pairs = truth.pixels().iter().zip(drawing.picture.pixels());
    for (index, (a, b)) in pairs.enumerate() {
        let within = a.iter().zip(b).all(|(a, b)| f64::from((a - b).abs()) <= bound || a == b);
        if within {
            continue;
        }
        let group = match (method, &drawing.evidence) {
            (Method::CubeMap(_), FirstSampleBuffers::Buffers(buffer, _)) => {
                buffer.texel(index).filter(|texel| !texel.is_empty()).map(|texel| texel.start.body)
            }
            _ => None,
        };
        groups.entry(group).or_default().push(index);
    }
    groups
}

/// What is to be explained.
pub(crate) struct ReasonInput<'a> {
    scene: &'a RenderScene,
    camera: &'a RenderCamera,
    method: &'a Method,
    drawing: &'a MethodOutput,
    frame: FrameSize,
    /// What the cube map of the pixels' body shows.
    others: Option<&'a RenderScene>,
}

impl ReasonInput<'_> {
    fn reason(&self, witness: &mut ReferencePixel<'_>, pixel: usize) -> Option<Reason> {
        let (x, y) = (pixel % self.frame.width, pixel / self.frame.width);
        let (at, size) = (UVec2::new(x as u32, y as u32), self.frame.size().as_uvec2());
        let (origin, direction) = TileRect::around(at, size, TILE).ray(self.camera, (at, size), 0);
        let ray = Ray { origin: origin.into(), direction: direction.into(), start: RayOrigin::FREE };
        let drawn = Vec3::from(*self.drawing.picture.pixels().get(pixel)?);
        match (self.method, &self.drawing.evidence) {
            (
                Method::Flat(how) | Method::Gouraud(how) | Method::Phong(how),
                FirstSampleBuffers::Bodies(bodies),
            ) => self.of_shading(witness, how, ray, *bodies.get(pixel)?, drawn),
            (Method::Ssr(how), FirstSampleBuffers::Buffers(buffer, maps)) => {
                self.of_screen(witness, how, ray, (buffer, maps), pixel)
            }
            (Method::CubeMap(_), FirstSampleBuffers::Buffers(buffer, maps)) => {
                self.of_map(witness, ray, (buffer, maps), pixel)
            }
            _ => None,
        }
    }
}

/// The reason with the largest error of a channel.
fn largest<const N: usize>(errors: [(Reason, Vec3); N]) -> Option<Reason> {
    let size = |error: Vec3| if error.is_nan() { f32::INFINITY } else { error.abs().max_element() };
    let errors = errors.into_iter().map(|(reason, error)| (reason, size(error)));
    // Of equal ones the first.
    let larger = |best: (Reason, f32), next: (Reason, f32)| if next.1 > best.1 { next } else { best };
    errors.reduce(larger).map(|(reason, _)| reason)
}
