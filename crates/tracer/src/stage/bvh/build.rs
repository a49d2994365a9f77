//! The binary tree behind the hierarchy: top-down with the surface area heuristic over bins (Wald 2007, On fast
//! construction of SAH-based bounding volume hierarchies), both halves in parallel.

use super::{Entry, MAX_DEPTH};
use crate::stage::Bounds;

/// A node of the binary tree, in depth-first order: an inner node's left child follows it at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) bounds: Bounds,
    /// Leaf: its first body. Inner node: the distance in the array from this node to its right child.
    pub(super) first_or_skip: u32,
    /// Leaf: its number of bodies. Inner node: 0.
    pub(super) count: u32,
}

const BINS: usize = 16;
const LEAF_SIZE: usize = 4;
/// Cost of opening a node in units of one body test.
const NODE_COST: f32 = 0.4;
/// Below this depth the median decides, which halves the number of bodies at every step: with at most 2³⁰ bodies the
/// depth stays within [`MAX_DEPTH`].
const SAH_DEPTH: usize = MAX_DEPTH - 30;
/// A part with fewer bodies is built by one thread.
const PARALLEL_SIZE: usize = 4096;

/// Builds the tree over `entries`, whose first is body `first` of the stage, and sorts them into its leaves' order.
pub(super) fn build(
    entries: &mut [Entry],
    first: u32,
    depth: usize,
    kind: impl Fn(u32) -> u32 + Sync + Copy,
) -> Vec<Node> {
    let bounds = entries.iter().fold(Bounds::EMPTY, |all, entry| all.union(entry.0));
    let node = |first_or_skip, count| Node { bounds, first_or_skip, count };
    let Some(middle) = split(entries, &bounds, depth) else {
        entries.sort_unstable_by_key(|&(_, index)| (kind(index), index));
        return vec![node(first, entries.len() as u32)];
    };
    let (left, right) = entries.split_at_mut(middle);
    let right_first = first + middle as u32;
    let large = left.len() + right.len() >= PARALLEL_SIZE;
    let mut build_left = || build(left, first, depth + 1, kind);
    let mut build_right = || build(right, right_first, depth + 1, kind);
    let (left, right) =
        if large { rayon::join(build_left, build_right) } else { (build_left(), build_right()) };
    let mut nodes = Vec::with_capacity(1 + left.len() + right.len());
    nodes.push(node(1 + left.len() as u32, 0));
    nodes.extend(left);
    nodes.extend(right);
    nodes
}

/// Partitions `entries` and says where, or `None` when they should stay one leaf.
fn split(entries: &mut [Entry], bounds: &Bounds, depth: usize) -> Option<usize> {
    if entries.len() <= 1 {
        return None;
    }
    if depth < SAH_DEPTH
        && let Some(choice) = best_split(entries, bounds)
    {
        let leaf_cost = entries.len() as f32 * bounds.half_area();
        if entries.len() <= LEAF_SIZE && choice.cost >= leaf_cost {
            return None;
        }
        return Some(partition(entries, |entry| choice.bins.index(&entry.0) < choice.bin));
    }
    if entries.len() <= LEAF_SIZE {
        return None;
    }
    let size = bounds.max - bounds.min;
    let axis = size.max_position();
    let middle = entries.len() / 2;
    entries.select_nth_unstable_by(middle, |a, b| {
        a.0.doubled_center()[axis].total_cmp(&b.0.doubled_center()[axis]).then(a.1.cmp(&b.1))
    });
    Some(middle)
}

/// Moves the entries for which `left` holds to the front and returns their number.
fn partition(entries: &mut [Entry], left: impl Fn(&Entry) -> bool) -> usize {
    let mut middle = 0;
    for index in 0..entries.len() {
        if left(&entries[index]) {
            entries.swap(index, middle);
            middle += 1;
        }
    }
    middle
}

/// Equal intervals of the box centers along one axis.
#[derive(Clone, Copy)]
struct Bins {
    axis: usize,
    low: f32,
    per_unit: f32,
}

impl Bins {
    fn index(&self, bounds: &Bounds) -> usize {
        (((bounds.doubled_center()[self.axis] - self.low) * self.per_unit) as usize).min(BINS - 1)
    }
}

struct Choice {
    bins: Bins,
    /// First bin of the right part.
    bin: usize,
    /// Expected number of body tests times the area.
    cost: f32,
}

/// The cheapest split over all axes; `None` when all centers coincide.
fn best_split(entries: &[Entry], bounds: &Bounds) -> Option<Choice> {
    let centers = entries.iter().fold(Bounds::EMPTY, |all, entry| {
        let center = entry.0.doubled_center();
        all.union(Bounds { min: center, max: center })
    });
    let mut best: Option<Choice> = None;
    for axis in 0..3 {
        let (low, high) = (centers.min[axis], centers.max[axis]);
        let per_unit = BINS as f32 / (high - low);
        if !(high > low && per_unit.is_finite()) {
            continue;
        }
        let bins = Bins { axis, low, per_unit };
        let mut filled = [(Bounds::EMPTY, 0_u32); BINS];
        for entry in entries {
            let bin = &mut filled[bins.index(&entry.0)];
            *bin = (bin.0.union(entry.0), bin.1 + 1);
        }
        let (bin, cost) = cheapest_boundary(&filled);
        let cost = cost + NODE_COST * bounds.half_area();
        if best.as_ref().is_none_or(|choice| cost < choice.cost) {
            best = Some(Choice { bins, bin, cost });
        }
    }
    best
}

/// The boundary (index of the first bin to its right) with the least sum of area × count over both sides.
fn cheapest_boundary(filled: &[(Bounds, u32); BINS]) -> (usize, f32) {
    let mut right_cost = [0.0_f32; BINS];
    let mut right = (Bounds::EMPTY, 0_u32);
    for bin in (1..BINS).rev() {
        right = (right.0.union(filled[bin].0), right.1 + filled[bin].1);
        right_cost[bin] = if right.1 == 0 { f32::INFINITY } else { right.0.half_area() * right.1 as f32 };
    }
    let mut best = (1, f32::INFINITY);
    let mut left = (Bounds::EMPTY, 0_u32);
    for bin in 1..BINS {
        left = (left.0.union(filled[bin - 1].0), left.1 + filled[bin - 1].1);
        let cost = left.0.half_area() * left.1 as f32 + right_cost[bin];
        if left.1 > 0 && cost < best.1 {
            best = (bin, cost);
        }
    }
    best
}
