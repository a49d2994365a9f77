//! What is systematically different in a picture by another ray tracer, found by trying it.
//!
//! Mistakes of the last step (curve, exposure, order of channels) and of the place of pixels are tried on the picture,
//! those of the sum of light on recorded trees of rays, and those of the scene and of rays by tracing anew: of rays by a
//! tracer of its own, whose mistakes are switches. A mistake is named if it explains enough of the
//! difference.

mod codes;
mod edges;
mod expected;
mod facts;
mod faults;
mod focus;
mod groups;
mod light_law;
mod light_tree;
mod mistake;
mod observed;
mod page;
mod places;
mod ray_fault;
mod remainder;
mod scene_change;
mod scene_mistake;
mod scene_words;
mod score;
mod search;
mod simplest;
mod tally;
mod terms;
mod trial_tracer;
mod trials;
mod verdict;

use catoptric_picture::{Development, PictureFormat, ToneCurve};
use catoptric_scene::Scene;
use catoptric_tracer::{RenderControl, RenderError, SceneBuildError};

pub use codes::{CodeCurve, CodeStage};
pub use faults::{ExponentFactor, Fault};
pub use groups::MistakeGroup;
pub use mistake::Mistake;
pub use observed::{ObservedPicture, Orientation};
pub use page::{CheckedPicture, checked_page};
pub use places::{Offset, OffsetKind, Window};
pub use ray_fault::{LeavingRule, NormalLength, RayFault, ShadowBias};
pub use remainder::{Cluster, DifferenceKind, WorstPixel};
pub use scene_mistake::{BodyKind, OtherOrigin, SceneMistake, SizeKind, TurnOrder};
pub use simplest::SimplestDifference;
pub use verdict::Verdict;

use mistake::Explanation;
use score::Judge;
use search::{Hypotheses, Search};
use tally::PictureTrial;
use trials::Trials;

/// How pictures are checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DetectiveSettings {
    /// The curve from light to codes that is expected. Default [`CodeCurve::Linear`], as most programs write.
    pub curve: CodeCurve,
    /// The width and height that are expected, pixels; `None` (the default) for any.
    pub expected_size: Option<[u32; 2]>,
    /// The largest difference of a channel that counts as equal, as a part of the largest code. Default 2/255. With 0
    /// codes must be equal, at edges, too.
    pub tolerance: f64,
    /// The side of the blocks that the format of the picture compressed with loss, pixels: an edge disturbs all pixels of
    /// its block. Default 0, none.
    pub block: u32,
    /// About the most pixels of a picture by which mistakes are looked for; with 0 it is only found out where the picture
    /// differs. Default 4096.
    pub searched_pixels: usize,
    /// About the most pixels that are held against an explanation with mistakes. Against the exact picture all are.
    /// Default 65536.
    pub judged_pixels: usize,
    /// About the most pixels that differ at edges whose surroundings are traced; apart from edges, this is the least
    /// number. Default 512.
    pub probed_pixels: usize,
}

impl Default for DetectiveSettings {
    fn default() -> Self {
        Self {
            curve: CodeCurve::Linear,
            expected_size: None,
            tolerance: 2.0 / 255.0,
            block: 0,
            searched_pixels: 4096,
            judged_pixels: 65_536,
            probed_pixels: 512,
        }
    }
}

impl DetectiveSettings {
    /// The share of pixels that a mistake must explain to be named.
    const PRICE: f64 = 0.001;
    /// The least tolerance of the search: rounding to codes is no mistake that could be found.
    const LEAST_SEARCHED: f64 = 1.0 / 255.0;

    /// The settings for a picture file of this format, if that is known. Of codes, `curve` says how they belong to light:
    /// if it is `None`, those of scenes of other programs are in proportion to it (`is_foreign`), and others have the sRGB
    /// curve. Codes of a JPEG are equal within 8/255, and edges disturb blocks of 16 pixels, since colors have half the
    /// resolution.
    pub fn of_file(format: Option<PictureFormat>, curve: Option<ToneCurve>, is_foreign: bool) -> Self {
        let is_linear = match curve {
            _ if format.is_some_and(PictureFormat::is_of_light) => true,
            Some(curve) => curve == ToneCurve::LinearCodes,
            None => is_foreign,
        };
        let curve = if is_linear { CodeCurve::Linear } else { CodeCurve::Srgb };
        match format {
            Some(PictureFormat::Jpeg) => Self { curve, tolerance: 8.0 / 255.0, block: 16, ..Self::default() },
            _ => Self { curve, ..Self::default() },
        }
    }

    /// How the exact picture is shown beside the codes that are expected.
    pub fn development(&self) -> Development {
        let is_linear = self.curve == CodeCurve::Linear;
        let tone_curve = if is_linear { ToneCurve::LinearCodes } else { ToneCurve::None };
        Development { tone_curve, ..Development::default() }
    }

    fn judge(&self) -> Judge {
        let tolerance = self.tolerance.max(Self::LEAST_SEARCHED) as f32;
        Judge { curve: self.curve, tolerance, price: Self::PRICE }
    }
}

/// Why a picture cannot be checked.
#[derive(Debug, thiserror::Error)]
pub enum DetectiveError {
    /// The scene cannot be prepared.
    #[error(transparent)]
    Scene(#[from] SceneBuildError),
    /// The exact picture cannot be made.
    #[error(transparent)]
    Picture(#[from] RenderError),
    /// The picture has no pixels.
    #[error("the picture has no pixels")]
    Empty,
    /// [`RenderControl::cancel`] was called.
    #[error("the check was cancelled")]
    Cancelled,
}

/// Checks pictures of one scene.
#[derive(Debug)]
pub struct Detective<'a> {
    trials: Trials<'a>,
    hypotheses: Hypotheses,
    settings: DetectiveSettings,
}

impl<'a> Detective<'a> {
    /// Prepares a scene.
    ///
    /// # Errors
    /// When the scene cannot be prepared.
    pub fn new(scene: &'a Scene, settings: DetectiveSettings) -> Result<Self, DetectiveError> {
        let trials = Trials::new(scene, settings.expected_size)?;
        Ok(Self { hypotheses: Hypotheses::of(&trials), trials, settings })
    }

    /// Finds what is systematically different in a picture of the scene, on the threads of the current rayon pool.
    ///
    /// # Errors
    /// When the picture is empty or `control` is cancelled.
    pub fn check(
        &self,
        picture: &ObservedPicture,
        control: &RenderControl,
    ) -> Result<Verdict, DetectiveError> {
        if picture.size().contains(&0) {
            return Err(DetectiveError::Empty);
        }
        let (trials, settings) = (&self.trials, &self.settings);
        let right = Explanation::right(settings.curve);
        let trial = PictureTrial { trials, settings, picture, explanation: &right, control };
        let plain = trial.tally()?;
        let search = Search::new((trials, &self.hypotheses), settings, picture, control);
        // What is left to explain is less than a mistake costs.
        let is_explained = plain.differing <= DetectiveSettings::PRICE;
        let found = if is_explained || settings.searched_pixels == 0 {
            right.clone()
        } else {
            search.run()?.explanation
        };
        let size = search.other_size(found.orientation);
        remainder::verdict(trial, plain, &found, size)
    }
}
