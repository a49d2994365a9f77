//! The audit of a pixel: every ray behind it, with every number, and the proof that they add up.
//!
//! ```
//! use catoptric_lab::audit::{AuditSettings, audit};
//! use catoptric_scene::Example;
//! use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
//!
//! let scene = Example::find("whitted").unwrap().load()?.scene;
//! let render_scene = RenderScene::build(&scene)?;
//! let picture = RenderSettings { width: 32, height: 18, samples: 1 };
//! let settings = AuditSettings { picture, ..AuditSettings::default() };
//! let control = RenderControl::default();
//! let pixel = glam::UVec2::new(9, 8);
//! let audit = audit(&scene, &render_scene, render_scene.camera(), pixel, &settings, &control)?;
//! let rendering = render(&render_scene, picture, &control)?;
//! assert_eq!(audit.light, rendering.picture.pixels()[8 * 32 + 9]);
//! println!("{}", audit.to_text(None));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod dot;
mod drawing;
mod json;
mod layout;
mod names;
mod numbers;
mod sum;
mod svg;
mod text;
mod tree;

use catoptric_picture::SizeError;
use catoptric_scene::Scene;
use catoptric_tracer::{
    RenderCamera, RenderControl, RenderError, RenderScene, RenderSettings, WhittedIntegrator, render_pixel,
    sample_offset,
};
use glam::{DVec3, UVec2};

pub use names::DisplayNames;
use sum::ExactSum;
pub use tree::{Node, NodeKind, RayTree};

/// The settings of an audit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AuditSettings {
    /// The picture that the pixel belongs to. Default 1280×720 with 1 sample.
    pub picture: RenderSettings,
    /// The most rays that are written down, of all samples together. Default [`AuditSettings::RAYS`].
    pub most_rays: usize,
}

impl AuditSettings {
    /// The default limit of rays that are written down, 2¹⁶: some hundred bytes each.
    pub const RAYS: usize = 1 << 16;
}

impl Default for AuditSettings {
    fn default() -> Self {
        Self { picture: RenderSettings { width: 1280, height: 720, samples: 1 }, most_rays: Self::RAYS }
    }
}

/// A pixel with all its rays.
#[derive(Clone, Debug, PartialEq)]
pub struct Audit {
    /// Column and row, from the upper left.
    pub pixel: UVec2,
    /// The picture's size and samples.
    pub picture: RenderSettings,
    /// The limit of generations.
    pub generations: u32,
    /// The weight below which rays are not traced.
    pub threshold: f32,
    /// The trees of the samples. Samples for which no rays were left have none.
    pub trees: Vec<RayTree>,
    /// The exact sum of the light of all rays, rounded to double precision; of several samples, the mean of their
    /// [light](RayTree::light).
    pub sum: DVec3,
    /// The pixel's linear light, the bits of the rendered picture.
    pub light: [f32; 3],
    /// How it is known that the rays make the pixel.
    pub proof: Proof,
    /// What bodies and lights are called.
    pub names: DisplayNames,
}

/// The proof that the light of the rays adds up to the pixel.
///
/// The renderer adds up the rays of a sample in double precision, in the order in which it meets them, and rounds the
/// sum to single precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proof {
    /// The exact sum has few enough digits that no order of adding rounds, or lies so that all orders are rounded to
    /// the same single-precision number.
    AnyOrder,
    /// The last bit could depend on the order of adding; the pixel was rendered anew to see it. Whether that bit is the
    /// one of the exact sum.
    Rendered {
        /// Whether the exact sum is rounded to the pixel.
        is_same: bool,
    },
    /// Rays were left out, and the pixel was traced once more to see the whole.
    Incomplete,
}

/// The reason why there is no audit.
#[derive(Debug, thiserror::Error)]
pub enum AuditError {
    /// The picture cannot be so large, or so small.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The pixel is not in the picture.
    #[error(
        "there is no pixel {},{} in a picture of {}x{} pixels: columns go from 0 to {}, rows from 0 to {}",
        .pixel.x, .pixel.y, .size.x, .size.y, .size.x.saturating_sub(1), .size.y.saturating_sub(1)
    )]
    NoSuchPixel {
        /// Column and row.
        pixel: UVec2,
        /// Pixels across and down.
        size: UVec2,
    },
    /// The audit was cancelled.
    #[error("the audit was cancelled")]
    Cancelled,
}

impl From<RenderError> for AuditError {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Size(error) => Self::Size(error),
            RenderError::Cancelled => Self::Cancelled,
        }
    }
}

/// Writes down every ray behind a pixel (column, row from the upper left) of the picture of `render_scene` through `camera`.
///
/// `render_scene` must be prepared from `scene`, which gives the names.
///
/// # Errors
/// When the picture or the pixel cannot be, or `control` is cancelled.
pub fn audit(
    scene: &Scene,
    render_scene: &RenderScene,
    camera: &RenderCamera,
    pixel: UVec2,
    settings: &AuditSettings,
    control: &RenderControl,
) -> Result<Audit, AuditError> {
    let picture = settings.picture;
    let size = UVec2::new(picture.width, picture.height);
    catoptric_picture::Picture::check_size(size.x, size.y)?;
    if pixel.x >= size.x || pixel.y >= size.y {
        return Err(AuditError::NoSuchPixel { pixel, size });
    }
    let samples = picture.samples.max(1);
    let mut whitted = WhittedIntegrator::watched(render_scene, camera, control);
    let mut left = settings.most_rays.max(1);
    let mut trees = Vec::new();
    let mut certain = true;
    for sample in 0..samples {
        if left == 0 {
            break;
        }
        let rays = whitted.pixel_tree(pixel, size, sample, left);
        if control.is_cancelled() {
            return Err(AuditError::Cancelled);
        }
        left -= rays.len().min(left);
        let (tree, is_certain) = RayTree::new(sample, sample_offset(sample), rays);
        trees.push(tree);
        certain &= is_certain;
    }
    let is_complete = trees.len() == samples as usize && trees.iter().all(|tree| tree.left_out == 0);
    // A sample's light is rounded to single precision, the samples are added up in double.
    let sum = match trees.as_slice() {
        [tree] if samples == 1 => tree.sum(),
        trees => trees.iter().map(|tree| tree.light.as_dvec3()).sum::<DVec3>() / f64::from(samples),
    };
    let own = sum.as_vec3().to_array();
    let known = match (is_complete, certain) {
        (true, true) => Some(own),
        (true, false) => None,
        (false, _) => whole_light(&mut whitted, pixel, size, samples),
    };
    if control.is_cancelled() {
        return Err(AuditError::Cancelled);
    }
    let light = match known {
        Some(light) => light,
        None => {
            let light = render_pixel(render_scene, camera, picture, pixel, control)?;
            light.ok_or(AuditError::NoSuchPixel { pixel, size })?
        }
    };
    let proof = match (is_complete, certain) {
        (false, _) => Proof::Incomplete,
        (true, true) => Proof::AnyOrder,
        (true, false) => Proof::Rendered { is_same: light == own },
    };
    let mut names = DisplayNames::of_lights(scene);
    for node in trees.iter().flat_map(|tree| &tree.nodes) {
        node.bodies().for_each(|(body, part)| names.meet(scene, body, part));
    }
    Ok(Audit {
        pixel,
        picture: RenderSettings { samples, ..picture },
        generations: render_scene.generations(),
        threshold: render_scene.threshold(),
        trees,
        sum,
        light,
        proof,
        names,
    })
}

/// The light of a pixel by all its rays, none of which is kept; `None` if its last bit depends on the order of adding.
fn whole_light(
    whitted: &mut WhittedIntegrator<'_>,
    pixel: UVec2,
    size: UVec2,
    samples: u32,
) -> Option<[f32; 3]> {
    let mut mean = DVec3::ZERO;
    for sample in 0..samples {
        let mut sums = <[ExactSum; 3]>::default();
        let is_whole = whitted.pixel_rays(pixel, size, sample, usize::MAX, |_, light| {
            let channels = sums.iter_mut().zip(light.to_array());
            channels.for_each(|(sum, light)| sum.absorb(&ExactSum::of(light)));
        });
        if !is_whole || !sums.iter().all(ExactSum::is_certain) {
            return None;
        }
        mean += DVec3::from(sums.each_ref().map(|sum| f64::from(sum.value() as f32)));
    }
    Some((mean / f64::from(samples)).as_vec3().to_array())
}
