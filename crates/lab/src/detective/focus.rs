//! The few pixels by which explanations are screened.

use super::codes::CodeStage;
use super::score::{Judge, UprightPixels};
use super::trials::PixelLight;

/// Pixels that an explanation leaves, and some that it does not, with the shares that they stand for.
///
/// The loss over all pixels is estimated by strata: of what differs, where others may do better, more is looked at.
#[derive(Debug, Default)]
pub(super) struct Focus {
    /// Their places among the chosen pixels.
    pub(super) places: Vec<usize>,
    pub(super) pixels: UprightPixels,
}

impl Focus {
    /// The most pixels that differ and that agree, where all explanations are tried.
    pub(super) const ROUGH: [usize; 2] = [24, 12];
    /// The most pixels that differ and that agree, where the likelier ones are tried.
    pub(super) const FINE: [usize; 2] = [88, 48];

    /// At most so many pixels that differ and that agree.
    pub(super) fn new(
        judge: Judge,
        pixels: &UprightPixels,
        lights: &[PixelLight],
        stage: &CodeStage,
        [most_differing, most_agreeing]: [usize; 2],
    ) -> Self {
        let differs = |place: &usize| {
            let observed = pixels.values.get(*place).copied().unwrap_or_default();
            judge.loss_at(observed, Judge::code(stage, lights, *place)) > 0.1
        };
        let (differing, agreeing): (Vec<usize>, Vec<usize>) = (0..pixels.values.len()).partition(differs);
        let (mut places, mut weights) = (Vec::new(), Vec::new());
        for (stratum, most) in [(differing, most_differing), (agreeing, most_agreeing)] {
            let count = stratum.len().min(most);
            // Multiples of the golden ratio spread evenly.
            let spread = (0..count).filter_map(|index| {
                let part = (index as f64 * 0.618_033_988_749_894_9).fract();
                let place =
                    if count == stratum.len() { index } else { (part * stratum.len() as f64) as usize };
                stratum.get(place).copied()
            });
            places.extend(spread);
            weights.resize(places.len(), stratum.len() as f32 / count.max(1) as f32);
        }
        let pixels = pixels.part(&places, weights);
        Self { places, pixels }
    }
}
