//! What an explanation leaves: how much agrees, and where the rest lies.

use std::collections::{BTreeMap, BTreeSet};

use catoptric_tracer::RenderControl;

use super::codes::CodeStage;
use super::faults::{Fault, FaultSet};
use super::light_law::LightLaw;
use super::light_tree::LightTrees;
use super::mistake::{Explanation, Mistake};
use super::observed::ObservedPicture;
use super::places::PixelChoice;
use super::score::Judge;
use super::trials::Trials;
use super::verdict::Verdict;
use super::{DetectiveError, DetectiveSettings};

/// What a difference has to do with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum DifferenceKind {
    /// Light that is there or not, or a shadow.
    Shadow,
    /// A highlight.
    Highlight,
    /// What a body reflects.
    Reflection,
    /// What is seen through a clear body.
    Refraction,
    /// The surface itself: its light, its color or its place.
    Surface,
    /// What lies behind all bodies.
    Background,
}

impl DifferenceKind {
    /// The name in JSON.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Shadow => "shadow",
            Self::Highlight => "highlight",
            Self::Reflection => "reflection",
            Self::Refraction => "refraction",
            Self::Surface => "surface",
            Self::Background => "background",
        }
    }
}

/// A pixel that differs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPixel {
    /// Column and row in the file.
    pub stored: [u32; 2],
    /// Column and row in the upright picture: those of the scene's.
    pub pixel: [u32; 2],
    /// Its codes, 0 to 255.
    pub found: [u8; 3],
    /// Those of the explanation.
    pub expected: [u8; 3],
    /// The place in the scene of the body that is seen there.
    pub body: Option<usize>,
    /// What the difference has to do with.
    pub kind: DifferenceKind,
    /// The largest difference of a channel, as a part of the largest code.
    pub difference: f32,
}

/// Pixels side by side that differ on one body and in one way.
#[derive(Clone, Debug, PartialEq)]
pub struct Cluster {
    /// Its share of the pixels.
    pub share: f64,
    /// The pixel that differs most.
    pub worst: WorstPixel,
}

/// The least share of pixels that must agree for an explanation to be told.
const LEAST_AGREED: f64 = 0.5;
/// A share of pixels by which an explanation may fall behind, since edges count in the one way only.
const ROUNDING: f64 = 0.002;
/// The pixels that are judged at once: their trees are not kept.
const AT_ONCE: usize = 4096;
/// The most clusters that are told.
const MOST_CLUSTERS: usize = 12;
/// Parts of the longer side of the picture within which differences count as neighbors.
const CELLS: u32 = 32;

/// Holds the picture against the explanation, and against a picture without mistakes.
pub(super) fn verdict(
    trials: &Trials<'_>,
    settings: &DetectiveSettings,
    (picture, expected): (&ObservedPicture, Option<[u32; 2]>),
    explanation: &Explanation,
    control: &RenderControl,
) -> Result<Verdict, DetectiveError> {
    let right = Explanation::right(settings.curve);
    let plain = Tally::of(trials, settings, picture, &right, control)?;
    let before = plain.agreed();
    let (explanation, after) = match explanation {
        explanation if *explanation == right => (&right, plain),
        explanation => {
            let after = Tally::of(trials, settings, picture, explanation, control)?;
            let is_worth = after.agreed() >= LEAST_AGREED && after.agreed() + ROUNDING >= before;
            if is_worth { (explanation, after) } else { (&right, plain) }
        }
    };
    let mut mistakes: Vec<Mistake> =
        expected.map(|expected| Mistake::Size { expected, found: picture.size() }).into_iter().collect();
    mistakes.extend(explanation.mistakes(settings.curve));
    let size = explanation.orientation.upright_size(picture.size());
    Ok(Verdict {
        mistakes,
        size: picture.size(),
        scene_size: size,
        agreed_before: before,
        agreed: after.agreed(),
        judged: after.judged,
        clusters: after.clusters(size),
    })
}

/// The pixels that agree, and those that do not.
#[derive(Debug, Default)]
struct Tally {
    judged: usize,
    others: Vec<WorstPixel>,
}

impl Tally {
    fn of(
        trials: &Trials<'_>,
        settings: &DetectiveSettings,
        picture: &ObservedPicture,
        explanation: &Explanation,
        control: &RenderControl,
    ) -> Result<Self, DetectiveError> {
        let size = explanation.orientation.upright_size(picture.size());
        let choice = PixelChoice::new(size, settings.judged_pixels);
        let mut tally = Self { judged: choice.pixels.len(), others: Vec::new() };
        for pixels in choice.pixels.chunks(AT_ONCE) {
            let part = PixelChoice { size, pixels: pixels.to_vec(), pairs: Vec::new() };
            let rays = explanation.offset.rays().into_iter();
            let trees = rays.map(|offset| trials.traced_once(&part, explanation, offset, control));
            let trees: Vec<LightTrees> = trees.collect::<Result<_, _>>()?;
            let laws = Laws::new(trials, explanation)?;
            let mut sums = Vec::new();
            for (place, pixel) in pixels.iter().enumerate() {
                let stored = explanation.orientation.stored(*pixel, picture.size());
                let seen =
                    ObservedPixel { found: picture.value(stored), range: picture.range_around(stored) };
                tally.others.extend(
                    laws.difference(&trees, place, &seen, settings.tolerance as f32, &mut sums).map(
                        |(expected, kind)| WorstPixel {
                            stored,
                            pixel: *pixel,
                            found: codes(seen.found),
                            expected: codes(expected),
                            body: trees.first().and_then(|trees| trees.body(place)),
                            kind,
                            difference: Judge::distance(seen.found, expected),
                        },
                    ),
                );
            }
        }
        Ok(tally)
    }

    fn agreed(&self) -> f64 {
        1.0 - self.others.len() as f64 / self.judged.max(1) as f64
    }

    /// The differences by body and kind, put together where they are neighbors; the largest first.
    fn clusters(&self, [width, height]: [u32; 2]) -> Vec<Cluster> {
        let side = width.max(height).div_ceil(CELLS).max(1);
        let mut topics: BTreeMap<_, BTreeMap<[u32; 2], Vec<&WorstPixel>>> = BTreeMap::new();
        for other in &self.others {
            let cell = other.pixel.map(|at| at / side);
            topics.entry((other.body, other.kind)).or_default().entry(cell).or_default().push(other);
        }
        let mut clusters = Vec::new();
        for cells in topics.values() {
            let mut left: BTreeSet<[u32; 2]> = cells.keys().copied().collect();
            while let Some(first) = left.pop_first() {
                let members = connected(first, &mut left);
                let pixels = members.iter().filter_map(|cell| cells.get(cell)).flatten();
                let count = pixels.clone().count();
                let Some(worst) = pixels.max_by(|one, other| one.difference.total_cmp(&other.difference))
                else {
                    continue;
                };
                clusters.push(Cluster { share: count as f64 / self.judged.max(1) as f64, worst: **worst });
            }
        }
        clusters.sort_by(|one, other| other.share.total_cmp(&one.share));
        clusters.truncate(MOST_CLUSTERS);
        clusters
    }
}

/// The cells that are connected with the first, taken out of those that are left.
fn connected(first: [u32; 2], left: &mut BTreeSet<[u32; 2]>) -> Vec<[u32; 2]> {
    let mut members = vec![first];
    let mut next = 0;
    while let Some(&[x, y]) = members.get(next) {
        next += 1;
        for column in x.saturating_sub(1)..=x + 1 {
            for row in y.saturating_sub(1)..=y + 1 {
                if left.remove(&[column, row]) {
                    members.push([column, row]);
                }
            }
        }
    }
    members
}

fn codes(values: [f32; 3]) -> [u8; 3] {
    values.map(|value| (value * 255.0).round() as u8)
}

/// A pixel of the picture with its surroundings.
struct ObservedPixel {
    found: [f32; 3],
    range: [[f32; 3]; 2],
}

impl ObservedPixel {
    /// Whether a code is the pixel's, or lies between those of an edge that goes through it: programs differ there in
    /// rounding and in the number of samples.
    fn agrees(&self, code: [f32; 3], tolerance: f32) -> bool {
        if Judge::distance(self.found, code) <= tolerance {
            return true;
        }
        let [low, high] = self.range;
        let is_edge = Judge::distance(low, high) > 4.0 * tolerance;
        let is_between = low
            .iter()
            .zip(high)
            .zip(code)
            .all(|((low, high), code)| (low - tolerance..=high + tolerance).contains(&code));
        is_edge && is_between
    }
}

/// The law of an explanation, and others that show what a difference has to do with.
struct Laws<'a> {
    stage: CodeStage,
    own: LightLaw<'a>,
    /// The law of points in their own shadow, if there are such.
    acne: Option<LightLaw<'a>>,
    others: Vec<(DifferenceKind, LightLaw<'a>)>,
}

impl<'a> Laws<'a> {
    fn new(trials: &'a Trials<'_>, explanation: &Explanation) -> Result<Self, DetectiveError> {
        let scene = trials.scene();
        let law = |faults: &FaultSet| LightLaw::new(scene, faults);
        let with = |fault| explanation.faults.with(fault).map(|faults| law(&faults));
        let others = [
            (DifferenceKind::Shadow, with(Fault::NoShadows)),
            (DifferenceKind::Shadow, Some(law(&explanation.faults).darkened())),
            (DifferenceKind::Highlight, with(Fault::NoHighlight)),
            (DifferenceKind::Reflection, with(Fault::NoReflection)),
            (DifferenceKind::Refraction, with(Fault::NoRefraction)),
        ];
        Ok(Self {
            stage: explanation.stage,
            own: law(&explanation.faults),
            acne: explanation.has_acne.then(|| law(&explanation.faults).darkened()),
            others: others.into_iter().filter_map(|(kind, law)| Some((kind, law?))).collect(),
        })
    }

    /// The code of a place by a law: the mean of its rays.
    fn code(
        &self,
        trees: &[LightTrees],
        place: usize,
        law: &LightLaw<'_>,
        sums: &mut Vec<glam::Vec3>,
    ) -> [f32; 3] {
        let mut code = [0.0; 3];
        for own in trees {
            let of_ray = self.stage.apply(own.light(place, law, sums));
            code.iter_mut().zip(of_ray).for_each(|(code, own)| *code += own / trees.len() as f32);
        }
        code
    }

    /// The code that is expected of a pixel, and what its difference has to do with; `None` if it agrees.
    fn difference(
        &self,
        trees: &[LightTrees],
        place: usize,
        seen: &ObservedPixel,
        tolerance: f32,
        sums: &mut Vec<glam::Vec3>,
    ) -> Option<([f32; 3], DifferenceKind)> {
        let expected = self.code(trees, place, &self.own, sums);
        if seen.agrees(expected, tolerance) {
            return None;
        }
        if let Some(acne) = &self.acne
            && seen.agrees(self.code(trees, place, acne, sums), tolerance)
        {
            return None;
        }
        let distance = Judge::distance(seen.found, expected);
        let mut nearest = None;
        for (kind, law) in &self.others {
            let other = Judge::distance(seen.found, self.code(trees, place, law, sums));
            if other < 0.5 * distance && nearest.is_none_or(|(_, least)| other < least) {
                nearest = Some((*kind, other));
            }
        }
        let is_seen = trees.first().is_some_and(|trees| trees.body(place).is_some());
        let plain = if is_seen { DifferenceKind::Surface } else { DifferenceKind::Background };
        Some((expected, nearest.map_or(plain, |(kind, _)| kind)))
    }
}
