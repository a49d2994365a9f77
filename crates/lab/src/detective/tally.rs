//! The pixels of a picture that disagree with an explanation.

use catoptric_tracer::RenderControl;

use super::edges::{Footprint, PixelStanding};
use super::expected::{BlockLosses, ExpectedCodes};
use super::light_tree::LightTrees;
use super::mistake::Explanation;
use super::observed::ObservedPicture;
use super::places::PixelChoice;
use super::remainder::WorstPixel;
use super::score::Judge;
use super::terms::{PixelTerm, PixelTrees, TermLaws};
use super::trials::Trials;
use super::{DetectiveError, DetectiveSettings};

/// A pixel that disagrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct DifferingPixel {
    pub(super) pixel: WorstPixel,
    pub(super) found: [f32; 3],
    pub(super) expected: [f32; 3],
    /// Whether no edge close by explains it.
    pub(super) is_beyond: bool,
    pub(super) term: PixelTerm,
    /// The number of pixels that it stands for.
    pub(super) weight: f64,
}

/// The pixels that agree, and those that do not.
#[derive(Debug, Default)]
pub(super) struct Tally {
    /// The number of pixels that were held against the explanation.
    pub(super) judged: usize,
    /// The share of them that differ from the ray through the middle, whether edges explain that or not.
    pub(super) differing: f64,
    /// Those that differ, or some of them.
    pub(super) others: Vec<DifferingPixel>,
}

impl Tally {
    /// The share of pixels at edges where rounding may decide: edges through the middles of pixels.
    pub(super) const FLIPPED: f64 = 0.001;

    /// The share of pixels that agree.
    pub(super) fn agreed(&self) -> f64 {
        1.0 - self.share(&self.others)
    }

    /// The share of all pixels that some of those that differ stand for.
    pub(super) fn share<'p>(&self, some: impl IntoIterator<Item = &'p DifferingPixel>) -> f64 {
        let count: f64 = some.into_iter().map(|other| other.weight).sum();
        count / self.judged.max(1) as f64
    }
}

/// A picture to be held against an explanation.
#[derive(Clone, Copy)]
pub(super) struct PictureTrial<'a> {
    pub(super) trials: &'a Trials<'a>,
    pub(super) settings: &'a DetectiveSettings,
    pub(super) picture: &'a ObservedPicture,
    pub(super) explanation: &'a Explanation,
    pub(super) control: &'a RenderControl,
}

impl PictureTrial<'_> {
    /// The pixels that are judged at once: their trees are not kept.
    const AT_ONCE: usize = 4096;
    /// Of the pixels that differ apart from edges, all are probed up to this part of the picture: of right pictures there
    /// are fewer, and among those a few wrong ones must not be overlooked.
    const PROBED_PART: usize = 64;
    /// The most pixels that are probed.
    const MOST_PROBED: usize = 4096;
    /// What rounding in single precision makes of equal codes: three operations on numbers up to 1.
    const ROUNDING: f32 = 3.0 * f32::EPSILON;
    /// The most that right pixels at edges, but for a few, scatter about the mean of very many rays, compared with a
    /// single ray: that of two or three rays.
    const MOST_SCATTER: f64 = 0.4;

    /// Holds every pixel against the exact picture, or some of them against one with mistakes.
    pub(super) fn tally(&self) -> Result<Tally, DetectiveError> {
        let mut codes = ExpectedCodes::new(self.picture.size());
        let (judged, pixels) = if *self.explanation == Explanation::right(self.settings.curve) {
            self.differing_from_exact(&mut codes)?
        } else {
            self.differing_from_trees(&mut codes)?
        };
        // Without tolerance nothing is explained away.
        let block = if self.tolerance() > 0.0 { self.settings.block } else { 0 };
        let mut losses = BlockLosses::new(block, self.tolerance(), self.picture, &codes);
        let differing = pixels.len() as f64 / judged.max(1) as f64;
        let (mut enclosed, mut outside) = (Vec::new(), Vec::new());
        for pixel in pixels {
            let stored = self.explanation.orientation.stored(pixel, self.picture.size());
            let found = self.picture.value(stored);
            let is_lost = losses.explain(stored);
            if is_lost && losses.at(stored).is_kept {
                continue;
            }
            let is_enclosed = is_lost || codes.enclose(stored, found, self.tolerance());
            if is_enclosed { enclosed.push(pixel) } else { outside.push(pixel) }
        }
        let most_at_edges = self.settings.probed_pixels;
        let most_apart = most_at_edges.max(judged / Self::PROBED_PART).min(Self::MOST_PROBED);
        let mut others = self.examined(some_of(enclosed, most_at_edges), false)?;
        others.extend(self.examined(some_of(outside, most_apart), true)?);
        let others = self.without_edges(others, Tally::FLIPPED * judged as f64)?;
        Ok(Tally { judged, differing, others })
    }

    fn tolerance(&self) -> f32 {
        self.settings.tolerance.max(0.0) as f32
    }

    fn differs(&self, found: [f32; 3], expected: [f32; 3]) -> bool {
        Judge::distance(found, self.picture.rounded(expected)) > self.tolerance() + Self::ROUNDING
    }

    /// The number of all pixels, and those that differ from the exact picture.
    fn differing_from_exact(
        &self,
        codes: &mut ExpectedCodes,
    ) -> Result<(usize, Vec<[u32; 2]>), DetectiveError> {
        let [width, height] = self.picture.size();
        let exact = self.trials.exact([width, height], self.control)?;
        let mut differing = Vec::new();
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        for (pixel, light) in pixels.zip(exact.pixels()) {
            let expected = self.explanation.stage.exact(*light);
            codes.set(pixel, expected);
            if self.differs(self.picture.value(pixel), expected) {
                differing.push(pixel);
            }
        }
        Ok((exact.pixels().len(), differing))
    }

    /// The number of chosen pixels, and those of them that differ from a picture with mistakes.
    fn differing_from_trees(
        &self,
        codes: &mut ExpectedCodes,
    ) -> Result<(usize, Vec<[u32; 2]>), DetectiveError> {
        let size = self.explanation.orientation.upright_size(self.picture.size());
        let pixels = PixelChoice::new(size, self.settings.judged_pixels).pixels;
        let laws = TermLaws::new(self.trials, self.explanation)?;
        let (mut differing, mut sums) = (Vec::new(), Vec::new());
        for part in pixels.chunks(Self::AT_ONCE) {
            let trees = self.traced(part)?;
            for (place, pixel) in part.iter().enumerate() {
                let stored = self.explanation.orientation.stored(*pixel, self.picture.size());
                let trees = PixelTrees { trees: &trees, place };
                let expected = laws.expected(trees, &mut sums);
                codes.set(stored, expected);
                let differs = |expected| self.differs(self.picture.value(stored), expected);
                if differs(expected) && !laws.agrees_in_own_shadow(trees, differs, &mut sums) {
                    differing.push(*pixel);
                }
            }
        }
        Ok((pixels.len(), differing))
    }

    /// The trees of pixels, one for each ray.
    fn traced(&self, pixels: &[[u32; 2]]) -> Result<Vec<LightTrees>, DetectiveError> {
        let size = self.explanation.orientation.upright_size(self.picture.size());
        let choice = PixelChoice { size, pixels: pixels.to_vec(), pairs: Vec::new() };
        let rays = self.explanation.offset.rays().into_iter();
        rays.map(|offset| self.trials.traced_once(&choice, self.explanation, offset, self.control)).collect()
    }

    /// What the differences of pixels have to do with, each of which stands for `weight` of them.
    fn examined(
        &self,
        (pixels, weight): (Vec<[u32; 2]>, f64),
        is_beyond: bool,
    ) -> Result<Vec<DifferingPixel>, DetectiveError> {
        let laws = TermLaws::new(self.trials, self.explanation)?;
        let (mut others, mut sums) = (Vec::new(), Vec::new());
        for part in pixels.chunks(Self::AT_ONCE) {
            let trees = self.traced(part)?;
            for (place, pixel) in part.iter().enumerate() {
                let stored = self.explanation.orientation.stored(*pixel, self.picture.size());
                let trees = PixelTrees { trees: &trees, place };
                let found = self.picture.value(stored);
                let expected = laws.expected(trees, &mut sums);
                // Lights with a size and rough surfaces have other samples here than in the exact picture.
                if !self.differs(found, expected) {
                    continue;
                }
                let pixel = WorstPixel {
                    stored,
                    pixel: *pixel,
                    found: codes(found),
                    expected: codes(expected),
                    body: trees.body(),
                    kind: laws.kind(trees, (found, expected), &mut sums),
                    difference: Judge::distance(found, expected),
                };
                let term = laws.term(trees, &mut sums);
                others.push(DifferingPixel { pixel, found, expected, is_beyond, term, weight });
            }
        }
        Ok(others)
    }

    /// The pixels that no edge within them explains; `most_flipped` of them may lie on either side of one.
    fn without_edges(
        &self,
        others: Vec<DifferingPixel>,
        most_flipped: f64,
    ) -> Result<Vec<DifferingPixel>, DetectiveError> {
        let size = self.explanation.orientation.upright_size(self.picture.size());
        let pixels: Vec<[u32; 2]> = others.iter().map(|other| other.pixel.pixel).collect();
        let footprints = Footprint::of_pixels(self.trials, self.explanation, (&pixels, size), self.control)?;
        let standing = |(other, footprint): (&DifferingPixel, &Footprint)| {
            footprint.standing(other.found, other.expected, &self.explanation.stage, self.tolerance())
        };
        let standings: Vec<PixelStanding> = others.iter().zip(&footprints).map(standing).collect();
        let (mut count, mut scatter, mut most) = (0.0, 0.0, 0.0);
        for (other, standing) in others.iter().zip(&standings) {
            if let PixelStanding::Filtered { excess, variance } = standing {
                count += other.weight;
                scatter += other.weight * f64::from(*excess);
                most += other.weight * Self::MOST_SCATTER * f64::from(*variance);
            }
        }
        let is_plausible = count <= most_flipped || scatter <= most;
        let is_lenient = self.settings.tolerance > 0.0 && is_plausible;
        let left = |(other, standing)| match standing {
            PixelStanding::Filtered { .. } if is_lenient => None,
            PixelStanding::Beyond => Some(other),
            _ => Some(DifferingPixel { is_beyond: false, ..other }),
        };
        Ok(others.into_iter().zip(standings).filter_map(left).collect())
    }
}

/// At most so many, spread evenly, and the number that each of them stands for.
fn some_of<T>(all: Vec<T>, most: usize) -> (Vec<T>, f64) {
    let step = all.len().div_ceil(most.max(1)).max(1);
    let count = all.len();
    let some: Vec<T> = all.into_iter().step_by(step).collect();
    let weight = count as f64 / some.len().max(1) as f64;
    (some, weight)
}

fn codes(values: [f32; 3]) -> [u8; 3] {
    values.map(|value| (value * 255.0).round() as u8)
}
