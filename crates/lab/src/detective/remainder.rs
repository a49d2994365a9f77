//! What an explanation leaves: how much agrees, and where the rest lies.

use std::collections::{BTreeMap, BTreeSet};

use super::DetectiveError;
use super::mistake::{Explanation, Mistake};
use super::simplest::SimplestDifference;
use super::tally::{DifferingPixel, PictureTrial, Tally};
use super::verdict::Verdict;

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

    /// The order in which a program learns them, the simplest first.
    pub(super) const fn rank(self) -> u8 {
        match self {
            Self::Background => 0,
            Self::Surface => 1,
            Self::Shadow => 2,
            Self::Highlight => 3,
            Self::Reflection => 4,
            Self::Refraction => 5,
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
/// The part of the pixels that differ but for edges that mistakes may leave, where edges explain all of them: of an
/// antialiased picture they leave nearly all.
const LEFT_BY_MISTAKES: f64 = 0.25;
/// The most clusters that are told.
const MOST_CLUSTERS: usize = 12;
/// Parts of the longer side of the picture within which differences count as neighbors.
const CELLS: u32 = 32;

/// What is said of a picture that was held against one without mistakes, as `plain` tells, and is now held against the
/// explanation that was found; `expected` is the size that it should have, if it has another one.
pub(super) fn verdict(
    trial: PictureTrial<'_>,
    plain: Tally,
    found: &Explanation,
    expected: Option<[u32; 2]>,
) -> Result<Verdict, DetectiveError> {
    let before = plain.agreed();
    let (explanation, after) = if found == trial.explanation {
        (found, plain)
    } else {
        let after = PictureTrial { explanation: found, ..trial }.tally()?;
        let agrees = after.agreed() >= LEAST_AGREED && after.agreed() + ROUNDING >= before;
        // Edges may explain the picture as well.
        let is_needed = before < 1.0 - ROUNDING || after.differing < LEFT_BY_MISTAKES * plain.differing;
        let is_worth = agrees && is_needed;
        if is_worth { (found, after) } else { (trial.explanation, plain) }
    };
    let size = trial.picture.size();
    let mut mistakes: Vec<Mistake> =
        expected.map(|expected| Mistake::Size { expected, found: size }).into_iter().collect();
    mistakes.extend(explanation.mistakes(trial.settings.curve));
    let scene_size = explanation.orientation.upright_size(size);
    let strays: Vec<&DifferingPixel> = after.others.iter().filter(|other| other.is_beyond).collect();
    Ok(Verdict {
        mistakes,
        size,
        scene_size,
        agreed_before: before,
        agreed: after.agreed(),
        strayed: after.share(strays.iter().copied()),
        has_stray_patch: has_neighbors(strays.iter().map(|other| other.pixel.pixel)),
        judged: after.judged,
        clusters: after.clusters(scene_size),
        simplest: SimplestDifference::of(&after, &explanation.stage),
    })
}

impl Tally {
    /// The differences by body and kind, put together where they are neighbors; the largest first.
    fn clusters(&self, [width, height]: [u32; 2]) -> Vec<Cluster> {
        let side = width.max(height).div_ceil(CELLS).max(1);
        let mut topics: BTreeMap<_, BTreeMap<[u32; 2], Vec<&DifferingPixel>>> = BTreeMap::new();
        for other in &self.others {
            let WorstPixel { pixel, body, kind, .. } = other.pixel;
            let cell = pixel.map(|at| at / side);
            topics.entry((body, kind)).or_default().entry(cell).or_default().push(other);
        }
        let mut clusters = Vec::new();
        for cells in topics.values() {
            let mut left: BTreeSet<[u32; 2]> = cells.keys().copied().collect();
            while let Some(first) = left.pop_first() {
                let members = connected(first, &mut left);
                let pixels = members.iter().filter_map(|cell| cells.get(cell)).flatten();
                let share = self.share(pixels.clone().copied());
                let worst = pixels.map(|other| other.pixel);
                let worst = worst.max_by(|one, other| one.difference.total_cmp(&other.difference));
                clusters.extend(worst.map(|worst| Cluster { share, worst }));
            }
        }
        clusters.sort_by(|one, other| other.share.total_cmp(&one.share));
        clusters.truncate(MOST_CLUSTERS);
        clusters
    }
}

/// Whether two of the pixels touch, if only at a corner.
fn has_neighbors(pixels: impl Iterator<Item = [u32; 2]>) -> bool {
    let all: BTreeSet<[u32; 2]> = pixels.collect();
    let touches = |[x, y]: &[u32; 2]| {
        // Each pair is found from the one of them that stands first.
        let after = [[x + 1, *y], [x + 1, y + 1], [*x, y + 1], [x + 1, y.wrapping_sub(1)]];
        after.iter().any(|other| all.contains(other))
    };
    all.iter().any(touches)
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
