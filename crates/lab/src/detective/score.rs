//! How well light explains the codes of a picture, and by which last step.

use super::codes::{CodeCurve, CodeStage};
use super::observed::{ObservedPicture, Orientation};
use super::places::PixelChoice;
use super::trials::PixelLight;

/// The chosen pixels of the picture, put upright.
#[derive(Debug, Default)]
pub(super) struct UprightPixels {
    pub(super) values: Vec<[f32; 3]>,
    /// For how many pixels each stands; 1 where there is none.
    weights: Vec<f32>,
    /// Some of the pixels, by which the last step is found.
    probes: Vec<usize>,
    /// The light of the probes by each curve.
    light_of_probes: Vec<Vec<[f32; 3]>>,
}

/// How far an explanation is from the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Score {
    /// The mean over the pixels of a distance that grows from 0 to 1 with the difference of the codes.
    pub(super) loss: f64,
    /// The last step that explains it best.
    pub(super) stage: CodeStage,
}

impl UprightPixels {
    /// The most probes.
    const PROBES: usize = 300;

    pub(super) fn new(picture: &ObservedPicture, orientation: Orientation, choice: &PixelChoice) -> Self {
        let stored = |pixel: &[u32; 2]| orientation.stored(*pixel, picture.size());
        Self::of_values(choice.pixels.iter().map(|pixel| picture.value(stored(pixel))).collect(), Vec::new())
    }

    /// Some of the pixels, by their places, and for how many each stands.
    pub(super) fn part(&self, places: &[usize], weights: Vec<f32>) -> Self {
        let value = |place: &usize| self.values.get(*place).copied().unwrap_or_default();
        Self::of_values(places.iter().map(value).collect(), weights)
    }

    fn of_values(values: Vec<[f32; 3]>, weights: Vec<f32>) -> Self {
        let count = values.len().min(Self::PROBES);
        // Multiples of the golden ratio spread evenly over all pixels.
        let place = |index: usize| {
            if count == values.len() {
                return index;
            }
            let part = (index as f64 * 0.618_033_988_749_894_9).fract();
            ((part * values.len() as f64) as usize).min(values.len().saturating_sub(1))
        };
        let probes: Vec<usize> = (0..count).map(place).collect();
        let light = |curve: CodeCurve| {
            let values = probes.iter().map(|place| values.get(*place).copied().unwrap_or_default());
            values.map(|value| value.map(|code| curve.light(code))).collect()
        };
        let light_of_probes = CodeCurve::ALL.map(light).into();
        Self { values, weights, probes, light_of_probes }
    }

    fn weight(&self, place: usize) -> f64 {
        self.weights.get(place).map_or(1.0, |weight| f64::from(*weight))
    }

    /// The factor by which most of the probes differ from the light of a curve; 1 where there is none.
    fn factor(&self, curve: CodeCurve, light: &[[f32; 3]], is_blue_first: bool) -> f32 {
        /// Steps of the logarithm of the factor, and their width.
        const STEPS: usize = 400;
        const WIDTH: f32 = 0.02;
        let Some(observed) = self.light_of_probes.get(curve as usize) else { return 1.0 };
        let mut ratios = Vec::new();
        for (place, observed) in self.probes.iter().zip(observed) {
            let Some(light) = light.get(*place) else { continue };
            let Some(codes) = self.values.get(*place) else { continue };
            for channel in 0..3 {
                let own = if is_blue_first { 2 - channel } else { channel };
                // Codes near the ends tell little of the factor.
                if (0.08..0.97).contains(&codes[channel]) && (0.01..1.0).contains(&light[own]) {
                    ratios.push((observed[channel] / light[own]).ln());
                }
            }
        }
        let mut counts = vec![0_u32; STEPS + 2];
        let step = |ratio: f32| (ratio / WIDTH + 0.5 * STEPS as f32).clamp(1.0, STEPS as f32) as usize;
        for ratio in &ratios {
            counts[step(*ratio)] += 1;
        }
        let sums = (1..=STEPS).map(|step| counts[step - 1] + 2 * counts[step] + counts[step + 1]);
        let Some((peak, most)) = sums.enumerate().max_by_key(|(_, sum)| *sum) else { return 1.0 };
        if most == 0 {
            return 1.0;
        }
        let middle = (peak as f32 + 1.5 - 0.5 * STEPS as f32) * WIDTH;
        let mut near: Vec<f32> =
            ratios.into_iter().filter(|ratio| (ratio - middle).abs() < 1.5 * WIDTH).collect();
        near.sort_by(f32::total_cmp);
        near.get(near.len() / 2).map_or(1.0, |ratio| ratio.exp())
    }
}

/// The rules by which pictures are held against each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Judge {
    /// The curve that is expected.
    pub(super) curve: CodeCurve,
    /// The difference of a code that does not count, as a part of the largest.
    pub(super) tolerance: f32,
    /// What a mistake must save of the loss to be named.
    pub(super) price: f64,
}

impl Judge {
    /// The largest difference of a channel.
    pub(super) fn distance(one: [f32; 3], other: [f32; 3]) -> f32 {
        one.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f32::max)
    }

    /// From 0 for what does not count to 1.
    fn loss_of(&self, distance: f32) -> f64 {
        const WIDTH: f32 = 3.0 / 255.0;
        let beyond = (distance - self.tolerance).max(0.0);
        f64::from(beyond * beyond / (beyond * beyond + WIDTH * WIDTH))
    }

    /// The code of a place by light that may be the mean of several rays.
    pub(super) fn code(stage: &CodeStage, lights: &[PixelLight], place: usize) -> [f32; 3] {
        let code = |light: &PixelLight| stage.apply(light.get(place).copied().unwrap_or_default());
        if let [light] = lights {
            return code(light);
        }
        let mut sum = [0.0; 3];
        for own in lights.iter().map(code) {
            sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += own / lights.len() as f32);
        }
        sum
    }

    /// The loss over all places.
    pub(super) fn loss(&self, pixels: &UprightPixels, lights: &[PixelLight], stage: &CodeStage) -> f64 {
        self.loss_over(pixels, lights, stage, 0..pixels.values.len())
    }

    fn loss_over(
        &self,
        pixels: &UprightPixels,
        lights: &[PixelLight],
        stage: &CodeStage,
        places: impl Iterator<Item = usize>,
    ) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for place in places {
            let observed = pixels.values.get(place).copied().unwrap_or_default();
            let weight = pixels.weight(place);
            sum += weight * self.loss_at(observed, Self::code(stage, lights, place));
            count += weight;
        }
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// The loss of a pixel by its codes and those of an explanation.
    pub(super) fn loss_at(&self, observed: [f32; 3], code: [f32; 3]) -> f64 {
        self.loss_of(Self::distance(observed, code))
    }

    /// The loss where each place may lie in the shadow of its own body, if that is so one here, one there; `None` if it
    /// is not.
    pub(super) fn loss_with_acne(
        &self,
        (pixels, choice): (&UprightPixels, &PixelChoice),
        (lights, dark): (&[PixelLight], &[PixelLight]),
        stage: &CodeStage,
    ) -> Option<f64> {
        /// The least share of dark and of lit places among those that light reaches.
        const LEAST: f64 = 0.004;
        /// The least share of unlike neighbors, compared with that of a random pattern.
        const LEAST_MIXED: f64 = 0.3;
        let mut total = 0.0;
        let count = pixels.values.len();
        // None where no light is lost, else whether the place is dark.
        let mut is_dark: Vec<Option<bool>> = Vec::with_capacity(count);
        for (place, observed) in pixels.values.iter().enumerate() {
            let [lit, dark] = [lights, dark].map(|lights| Self::code(stage, lights, place));
            let [from_lit, from_dark] = [lit, dark].map(|code| Self::distance(*observed, code));
            total += self.loss_of(from_lit.min(from_dark));
            let is_plain = Self::distance(lit, dark) > 4.0 * self.tolerance
                && from_lit.min(from_dark) <= 2.0 * self.tolerance;
            is_dark.push(is_plain.then_some(from_dark < from_lit));
        }
        let known = is_dark.iter().flatten().count().max(1) as f64;
        let dark = is_dark.iter().flatten().filter(|is_dark| **is_dark).count() as f64 / known;
        let pairs = choice.pairs.iter().filter_map(|[a, b]| {
            Some((is_dark.get(*a as usize).copied()??, is_dark.get(*b as usize).copied()??))
        });
        let (mut all, mut mixed) = (0.0, 0.0);
        for (a, b) in pairs {
            all += 1.0;
            mixed += f64::from(a != b);
        }
        let random = 2.0 * dark * (1.0 - dark);
        let is_acne =
            (LEAST..=1.0 - LEAST).contains(&dark) && all > 0.0 && mixed / all >= LEAST_MIXED * random;
        is_acne.then_some(total / count.max(1) as f64)
    }

    /// The last step that explains the picture best, and its loss. Without `is_free`, the curve and the order of
    /// channels are those of `near`.
    pub(super) fn fit(
        &self,
        pixels: &UprightPixels,
        lights: &[PixelLight],
        near: &CodeStage,
        is_free: bool,
    ) -> Score {
        let Some(light) = lights.first() else {
            return Score { loss: 1.0, stage: *near };
        };
        let mut stages = vec![*near];
        let curves: &[CodeCurve] = if is_free { &CodeCurve::ALL } else { std::slice::from_ref(&near.curve) };
        let orders: &[bool] =
            if is_free { &[false, true] } else { std::slice::from_ref(&near.is_blue_first) };
        let is_bright = light.iter().any(|light| light.iter().any(|channel| *channel > 1.02));
        for &curve in curves {
            for &is_blue_first in orders {
                let plain = CodeStage { is_blue_first, ..CodeStage::plain(curve) };
                stages.push(plain);
                stages.extend(is_bright.then_some(CodeStage { overflows: true, ..plain }));
                let factor = pixels.factor(curve, light, is_blue_first);
                if (factor - 1.0).abs() > 0.02 {
                    let factored = CodeStage { factor, ..plain };
                    stages.push(factored);
                    stages.extend(is_bright.then_some(CodeStage { is_clamped_first: true, ..factored }));
                }
            }
        }
        let price = |stage: &CodeStage| self.price * stage.deviations(self.curve) as f64;
        let mut rough: Vec<(f64, CodeStage)> = stages
            .into_iter()
            .map(|stage| {
                let loss = self.loss_over(pixels, lights, &stage, pixels.probes.iter().copied());
                (loss + price(&stage), stage)
            })
            .collect();
        rough.sort_by(|one, other| one.0.total_cmp(&other.0));
        rough.dedup_by(|one, other| one.1 == other.1);
        if pixels.probes.len() == pixels.values.len() {
            // All pixels were probes.
            let best =
                rough.first().map(|(total, stage)| Score { loss: total - price(stage), stage: *stage });
            return best.unwrap_or(Score { loss: 1.0, stage: *near });
        }
        let tried = if is_free { 4 } else { 2 };
        let exact = rough
            .into_iter()
            .take(tried)
            .map(|(_, stage)| Score { loss: self.loss(pixels, lights, &stage), stage });
        let total = |score: &Score| score.loss + price(&score.stage);
        exact
            .min_by(|one, other| total(one).total_cmp(&total(other)))
            .unwrap_or(Score { loss: 1.0, stage: *near })
    }
}
