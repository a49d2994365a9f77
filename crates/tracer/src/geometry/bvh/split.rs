//! Parting a list of entries in two where the surface area heuristic wants it.

use rayon::prelude::*;

use crate::geometry::bvh::entry::{BinGrid, BoundsAccumulator, BuildEntry};

/// Lists are worked on by several threads in pieces of this length. It decides the order of what is parted, so that it
/// must not depend on the number of threads.
const PIECE: usize = 1 << 14;

/// Where to part entries.
pub(crate) struct SahSplit {
    intervals: BinGrid,
    axis: usize,
    /// The first interval of the right side.
    bin: usize,
    /// The boxes of both sides.
    pub(crate) sides: [BoundsAccumulator; 2],
}

impl SahSplit {
    #[inline]
    fn is_left(&self, entry: &BuildEntry) -> bool {
        self.intervals.along(self.axis, entry) < self.bin
    }
}

/// The entries whose centers lie in one interval.
#[derive(Clone, Copy)]
struct SahBin {
    extent: BoundsAccumulator,
    count: u32,
}

impl SahBin {
    const EMPTY: Self = Self { extent: BoundsAccumulator::EMPTY, count: 0 };

    #[inline]
    fn with(self, other: Self) -> Self {
        Self { extent: self.extent.union(other.extent), count: self.count + other.count }
    }

    /// Expected number of body tests times an area.
    fn cost(&self) -> f32 {
        self.extent.half_area() * self.count as f32
    }
}

/// For each axis. Small lists have few, since they are cleared for every split.
type SahBins<const COUNT: usize> = [[SahBin; COUNT]; 3];

/// The cheapest split over all axes; `None` when all centers coincide.
pub(crate) fn best_split(entries: &[BuildEntry]) -> Option<SahSplit> {
    match entries.len() {
        0..32 => best_of::<8>(entries),
        32..1024 => best_of::<16>(entries),
        _ => best_of::<32>(entries),
    }
}

/// The best split among those between so many intervals along each axis.
fn best_of<const COUNT: usize>(entries: &[BuildEntry]) -> Option<SahSplit> {
    let intervals = BinGrid::new(&centers_of(entries), COUNT);
    if !intervals.is_any() {
        return None;
    }
    let bins = fill::<COUNT>(entries, &intervals);
    let mut best: Option<SahSplit> = None;
    let mut best_cost = f32::INFINITY;
    for (axis, bins) in bins.iter().enumerate() {
        if let Some((bin, cost, sides)) = cheapest_boundary(bins)
            && cost < best_cost
        {
            best_cost = cost;
            best = Some(SahSplit { intervals, axis, bin, sides });
        }
    }
    best
}

/// The limits of all entries' centers.
fn centers_of(entries: &[BuildEntry]) -> BoundsAccumulator {
    let of = |entries: &[BuildEntry]| {
        entries.iter().fold(BoundsAccumulator::EMPTY, BoundsAccumulator::with_center)
    };
    if entries.len() <= PIECE {
        return of(entries);
    }
    entries.par_chunks(PIECE).map(of).reduce(|| BoundsAccumulator::EMPTY, BoundsAccumulator::union)
}

fn fill<const COUNT: usize>(entries: &[BuildEntry], intervals: &BinGrid) -> SahBins<COUNT> {
    if entries.len() <= PIECE {
        let mut bins = [[SahBin::EMPTY; COUNT]; 3];
        for entry in entries {
            let one = SahBin { extent: BoundsAccumulator::EMPTY.with(entry), count: 1 };
            for (bins, at) in bins.iter_mut().zip(intervals.of(entry)) {
                bins[at] = bins[at].with(one);
            }
        }
        return bins;
    }
    let join = |mut one: SahBins<COUNT>, other: SahBins<COUNT>| {
        for (bins, others) in one.iter_mut().zip(&other) {
            for (bin, other) in bins.iter_mut().zip(others) {
                *bin = bin.with(*other);
            }
        }
        one
    };
    let none = || [[SahBin::EMPTY; COUNT]; 3];
    entries.par_chunks(PIECE).map(|piece| fill(piece, intervals)).reduce(none, join)
}

/// The boundary (index of the first bin to its right) with the least sum of area × count over both sides, that sum,
/// and the boxes of the sides.
fn cheapest_boundary<const COUNT: usize>(
    bins: &[SahBin; COUNT],
) -> Option<(usize, f32, [BoundsAccumulator; 2])> {
    let mut right_sides = [SahBin::EMPTY; COUNT];
    let mut right = SahBin::EMPTY;
    for (at, bin) in bins.iter().enumerate().rev() {
        right = right.with(*bin);
        right_sides[at] = right;
    }
    let mut best = None;
    let mut best_cost = f32::INFINITY;
    let mut left = SahBin::EMPTY;
    for (at, (bin, right)) in bins.iter().zip(&right_sides[1..]).enumerate() {
        left = left.with(*bin);
        if left.count == 0 || right.count == 0 {
            continue;
        }
        let cost = left.cost() + right.cost();
        if cost < best_cost {
            best_cost = cost;
            best = Some((at + 1, cost, [left.extent, right.extent]));
        }
    }
    best
}

/// Moves the entries of the left side to the front and returns their number.
pub(crate) fn partition(entries: &mut [BuildEntry], split: &SahSplit) -> usize {
    if entries.len() <= 2 * PIECE {
        return partition_piece(entries, split);
    }
    let lefts: Vec<usize> =
        entries.par_chunks_mut(PIECE).map(|piece| partition_piece(piece, split)).collect();
    let (count, middle) = (entries.len(), lefts.iter().sum::<usize>());
    let (front, back) = entries.split_at_mut(middle);
    // What stands on the wrong side of the middle, piece by piece, is as long on one side as on the other.
    let starts = || lefts.iter().zip((0..count).step_by(PIECE));
    let rights = starts().map(|(left, start)| start + left..(start + PIECE).min(middle));
    let lefts = starts().map(|(left, start)| start.max(middle) - middle..(start + left).max(middle) - middle);
    let pairs = pair_up(runs(front, rights), runs(back, lefts));
    pairs.into_par_iter().for_each(|(one, other)| one.swap_with_slice(other));
    middle
}

/// Without branches: which side an entry is on cannot be foretold.
fn partition_piece(entries: &mut [BuildEntry], split: &SahSplit) -> usize {
    let mut middle = 0;
    for at in 0..entries.len() {
        let is_left = split.is_left(&entries[at]);
        entries.swap(at, middle);
        middle += usize::from(is_left);
    }
    middle
}

/// The ranges of a list that are not empty; they are in order and apart.
fn runs<T>(mut list: &mut [T], ranges: impl Iterator<Item = std::ops::Range<usize>>) -> Vec<&mut [T]> {
    let mut runs = Vec::new();
    let mut done = 0;
    for range in ranges.filter(|range| !range.is_empty()) {
        let (run, rest) = std::mem::take(&mut list).split_at_mut(range.end - done);
        runs.push(&mut run[range.start - done..]);
        (list, done) = (rest, range.end);
    }
    runs
}

/// Cuts two lists of runs so that each run of one has one of the other of its length.
fn pair_up<'a, T>(ones: Vec<&'a mut [T]>, others: Vec<&'a mut [T]>) -> Vec<(&'a mut [T], &'a mut [T])> {
    let mut pairs = Vec::new();
    let mut others = others.into_iter();
    let mut other: &mut [T] = &mut [];
    for mut one in ones {
        while !one.is_empty() {
            if other.is_empty() {
                match others.next() {
                    Some(next) => other = next,
                    None => return pairs,
                }
            }
            let length = one.len().min(other.len());
            let (this, rest) = one.split_at_mut(length);
            let (that, other_rest) = other.split_at_mut(length);
            pairs.push((this, that));
            (one, other) = (rest, other_rest);
        }
    }
    pairs
}
