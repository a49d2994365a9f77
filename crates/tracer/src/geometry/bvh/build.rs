//! Building: top-down with the surface area heuristic over bins (Wald 2007, On fast construction of SAH-based bounding
//! volume hierarchies). The entries are parted in place, and the widest parts of a node are parted on until it has
//! eight (Wald, Benthin, Boulos 2008, Getting rid of packets).
//!
//! The outcome is the same for any number of threads: what they find is put together by least, greatest and sum of
//! whole numbers, and long lists are parted in pieces of a fixed length.

use rayon::prelude::*;

use crate::geometry::bvh::entry::{BoundsAccumulator, BuildEntry};
use crate::geometry::bvh::split::{best_split, partition};
use crate::geometry::bvh::{BvhNode, MAX_DEPTH, WIDTH};

/// A leaf holds at most this many bodies.
pub(crate) const LEAF_SIZE: usize = 6;
/// Cost of opening a node in units of one body test.
pub(crate) const NODE_COST: f32 = 8.0;
/// From this depth on the median decides, which halves the number of bodies at every step: with at most 2³⁰ bodies the
/// depth stays within [`MAX_DEPTH`].
const SAH_DEPTH: usize = MAX_DEPTH - 30;
/// A node over fewer bodies is built by one thread.
const PARALLEL_SIZE: usize = 4096;

/// Some of the entries, one after another, and their box.
#[derive(Clone, Copy)]
struct BuildRange {
    start: usize,
    count: usize,
    extent: BoundsAccumulator,
    /// How many partings led to it.
    depth: usize,
    /// It was found that it cannot be parted.
    is_whole: bool,
}

/// Nodes in depth-first order; an inner node's `first` is the way from its parent to it.
type NodeList = Vec<BvhNode>;

/// Builds the nodes, and sorts `entries` into their leaves' order.
pub(crate) fn build(entries: &mut [BuildEntry]) -> Vec<BvhNode> {
    let of = |entries: &[BuildEntry]| entries.iter().fold(BoundsAccumulator::EMPTY, BoundsAccumulator::with);
    let extent = entries
        .par_chunks(PARALLEL_SIZE)
        .map(of)
        .reduce(|| BoundsAccumulator::EMPTY, BoundsAccumulator::union);
    let root = BuildRange { start: 0, count: entries.len(), extent, depth: 0, is_whole: false };
    let pieces = large_node(entries, root);
    let mut nodes: Vec<BvhNode> = bytemuck::zeroed_vec(pieces.iter().map(Vec::len).sum());
    let mut jobs = Vec::with_capacity(pieces.len());
    let mut rest = &mut nodes[..];
    let mut place = 0;
    for piece in pieces {
        let (own, others) = std::mem::take(&mut rest).split_at_mut(piece.len());
        rest = others;
        let start = place;
        place += piece.len() as u32;
        jobs.push((start, piece, own));
    }
    jobs.into_par_iter().for_each(|(start, piece, own)| {
        own.copy_from_slice(&piece);
        for (node, place) in own.iter_mut().zip(start..) {
            node.children_mut().for_each(|child| *child += place);
        }
    });
    nodes
}

/// The nodes of a part, in pieces: its children are built in parallel.
fn large_node(entries: &mut [BuildEntry], part: BuildRange) -> Vec<NodeList> {
    if part.count < PARALLEL_SIZE {
        let mut nodes = Vec::new();
        small_node(entries, part, &mut nodes);
        return vec![nodes];
    }
    let mut parts = [part; WIDTH];
    let parts = open(entries, &mut parts);
    let mut jobs = Vec::with_capacity(WIDTH);
    let mut rest = entries;
    for part in parts {
        let (own, others) = rest.split_at_mut(part.count);
        rest = others;
        jobs.push((*part, own));
    }
    let built: Vec<Vec<NodeList>> = jobs
        .into_par_iter()
        .map(
            |(part, entries)| if stays_leaf(entries, &part) { Vec::new() } else { large_node(entries, part) },
        )
        .collect();
    let mut node = BvhNode::EMPTY;
    let mut way = 1;
    for (slot, (part, pieces)) in parts.iter().zip(&built).enumerate() {
        if pieces.is_empty() {
            node.set(slot, part.extent.bounds(), part.start, part.count);
        } else {
            node.set(slot, part.extent.bounds(), way, 0);
            way += pieces.iter().map(Vec::len).sum::<usize>();
        }
    }
    let mut pieces = vec![vec![node]];
    pieces.extend(built.into_iter().flatten());
    pieces
}

/// Appends the nodes of a part.
fn small_node(entries: &mut [BuildEntry], part: BuildRange, nodes: &mut NodeList) {
    let place = nodes.len();
    nodes.push(BvhNode::EMPTY);
    if part.count <= WIDTH {
        entries.sort_unstable_by_key(BuildEntry::leaf_key);
        for (slot, entry) in entries.iter().enumerate() {
            nodes[place].set(slot, entry.bounds(), part.start + slot, 1);
        }
        return;
    }
    let mut parts = [part; WIDTH];
    for (slot, child) in open(entries, &mut parts).iter().enumerate() {
        let start = child.start - part.start;
        let entries = &mut entries[start..start + child.count];
        let bounds = child.extent.bounds();
        if stays_leaf(entries, child) {
            nodes[place].set(slot, bounds, child.start, child.count);
        } else {
            let way = nodes.len() - place;
            nodes[place].set(slot, bounds, way, 0);
            small_node(entries, *child, nodes);
        }
    }
}

/// Parts the first part, which has all the entries, again and again, always the widest one, until there are as many as
/// a node has places; in the entries' order.
fn open<'a>(entries: &mut [BuildEntry], parts: &'a mut [BuildRange; WIDTH]) -> &'a [BuildRange] {
    let first = parts[0].start;
    let mut count = 1;
    while count < WIDTH {
        let area = |at: usize| parts[at].extent.half_area();
        let open = (0..count).filter(|&at| !parts[at].is_whole);
        let is_large = |at: usize| parts[at].count > LEAF_SIZE;
        let rank = |at: usize, other: usize| {
            is_large(at).cmp(&is_large(other)).then_with(|| area(at).total_cmp(&area(other)))
        };
        let Some(widest) = open.max_by(|&a, &b| rank(a, b)) else { break };
        let part = &parts[widest];
        let start = part.start - first;
        match divide(&mut entries[start..start + part.count], part) {
            Some([left, right]) => {
                parts[widest] = left;
                parts[count] = right;
                count += 1;
            }
            None => parts[widest].is_whole = true,
        }
    }
    let parts = &mut parts[..count];
    parts.sort_unstable_by_key(|part| part.start);
    parts
}

/// Parts a part in two; `None` when it stays one leaf, since it has one body or all centers coincide.
fn divide(entries: &mut [BuildEntry], part: &BuildRange) -> Option<[BuildRange; 2]> {
    let extent_of =
        |entries: &[BuildEntry]| entries.iter().fold(BoundsAccumulator::EMPTY, BoundsAccumulator::with);
    let split = if part.depth < SAH_DEPTH && part.count > 2 { best_split(entries) } else { None };
    let (middle, [left, right]) = match split {
        Some(split) => (partition(entries, &split), split.sides),
        None if part.count < 2 || (2 < part.count && part.count <= LEAF_SIZE) => return None,
        None => {
            let axis = part.extent.longest_axis();
            let middle = part.count / 2;
            entries.select_nth_unstable_by(middle, |a, b| a.compare(b, axis));
            let (left, right) = entries.split_at(middle);
            (middle, [extent_of(left), extent_of(right)])
        }
    };
    let depth = part.depth + 1;
    let (start, count) = (part.start, part.count);
    Some([
        BuildRange { start, count: middle, extent: left, depth, is_whole: false },
        BuildRange { start: start + middle, count: count - middle, extent: right, depth, is_whole: false },
    ])
}

/// Whether a part is better a leaf than a node of its own; its entries are then put in a leaf's order.
fn stays_leaf(entries: &mut [BuildEntry], part: &BuildRange) -> bool {
    if part.count > LEAF_SIZE {
        return false;
    }
    let area = part.extent.half_area();
    let apart: f32 = entries.iter().map(|entry| BoundsAccumulator::EMPTY.with(entry).half_area()).sum();
    let is_leaf = part.count == 1 || part.count as f32 * area <= NODE_COST * area + apart;
    if is_leaf {
        entries.sort_unstable_by_key(BuildEntry::leaf_key);
    }
    is_leaf
}
