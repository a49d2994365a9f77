//! What is systematically different in a picture by another ray tracer, found by trying it.
//!
//! Mistakes of the last step (curve, exposure, order of channels) and of the place of pixels are tried on the picture,
//! those of the sum of light on recorded trees of rays, and those of the scene and of rays by tracing anew: of rays by a
//! [tracer](trial_tracer) of its own, whose mistakes are switches. A mistake is named if it explains enough of the
//! difference.

mod codes;
mod facts;
mod faults;
mod focus;
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
mod trial_tracer;
mod trials;
mod verdict;

use catoptric_scene::Scene;
use catoptric_tracer::{RenderControl, SceneBuildError};

pub use codes::{CodeCurve, CodeStage};
pub use faults::{ExponentFactor, Fault};
pub use mistake::Mistake;
pub use observed::{ObservedPicture, Orientation};
pub use page::{CheckedPicture, checked_page};
pub use places::{Offset, OffsetKind, Window};
pub use ray_fault::{LeavingRule, NormalLength, RayFault, ShadowBias};
pub use remainder::{Cluster, DifferenceKind, WorstPixel};
pub use scene_mistake::{BodyKind, OtherOrigin, SceneMistake, SizeKind, TurnOrder};
pub use verdict::Verdict;

use score::Judge;
use search::{Hypotheses, Search};
use trials::Trials;

/// How pictures are checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DetectiveSettings {
    /// The curve from light to codes that is expected. Default [`CodeCurve::Linear`], as most programs write.
    pub curve: CodeCurve,
    /// The width and height that are expected, pixels; `None` (the default) for any.
    pub expected_size: Option<[u32; 2]>,
    /// The largest difference of a channel that counts as equal, as a part of the largest code. Default 2/255.
    pub tolerance: f64,
    /// About the most pixels of a picture by which mistakes are looked for. Default 4096.
    pub searched_pixels: usize,
    /// About the most pixels that are held against the explanation in the end. Default 65536.
    pub judged_pixels: usize,
}

impl Default for DetectiveSettings {
    fn default() -> Self {
        Self {
            curve: CodeCurve::Linear,
            expected_size: None,
            tolerance: 2.0 / 255.0,
            searched_pixels: 4096,
            judged_pixels: 65_536,
        }
    }
}

impl DetectiveSettings {
    /// The share of pixels that a mistake must explain to be named.
    const PRICE: f64 = 0.001;

    fn judge(&self) -> Judge {
        Judge { curve: self.curve, tolerance: self.tolerance.max(0.0) as f32, price: Self::PRICE }
    }
}

/// Why a picture cannot be checked.
#[derive(Debug, thiserror::Error)]
pub enum DetectiveError {
    /// The scene cannot be prepared.
    #[error(transparent)]
    Scene(#[from] SceneBuildError),
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
        let search = Search::new((&self.trials, &self.hypotheses), &self.settings, picture, control);
        let found = search.run()?;
        let size = search.other_size(found.explanation.orientation);
        remainder::verdict(&self.trials, &self.settings, (picture, size), &found.explanation, control)
    }
}
