//! A hierarchy of bounding boxes over the bodies, four boxes to a node.
//!
//! A binary tree is built first and its nodes are then joined in fours (Wald, Benthin, Boulos 2008, Getting rid of
//! packets), so that one step tests four boxes with vector instructions.

mod build;
mod packet;

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{Vec3A, Vec4};

use super::Bounds;
pub(crate) use packet::{PacketPart, Visit};

/// No path from the root is longer than this.
const MAX_DEPTH: usize = 64;

/// Four boxes and what they contain. An unused box is inside out and is never met.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C, align(16))]
pub(crate) struct Node {
    /// Least x of the four boxes, greatest x, least y, greatest y, least z, greatest z.
    pub sides: [[f32; 4]; 6],
    /// Leaf: its first body. Inner node: its place in the array.
    pub first: [u32; 4],
    /// Leaf: its number of bodies. Inner node: 0.
    pub count: [u32; 4],
}

/// The hierarchy; the root is the first node.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    nodes: Vec<Node>,
}

/// One body to be sorted into the hierarchy, and its index.
type Entry = (Bounds, u32);

/// Directions are unit vectors and coordinates at most some 10¹⁸: components below this are as good as 0, and their
/// inverse times a coordinate stays below 3.4·10³⁸, so that no NaN arises.
const TINY: f32 = 1e-20;

impl Bvh {
    /// Builds the hierarchy and sorts `entries` into the order of its leaves, each leaf by `kind`.
    pub(super) fn build(entries: &mut [Entry], kind: impl Fn(u32) -> u32 + Sync + Copy) -> Self {
        let binary = build::build(entries, 0, 0, kind);
        let mut nodes = Vec::with_capacity(binary.len() / 4 + 1);
        nodes.push(Node::EMPTY);
        join(&binary, 0, 0, &mut nodes);
        nodes.shrink_to_fit();
        Self { nodes }
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.nodes)
    }

    /// Calls `leaf` with the bodies of every leaf whose box contains `point`.
    pub(crate) fn visit_at(&self, point: Vec3A, mut leaf: impl FnMut(Range<u32>)) {
        let mut pending = vec![0_u32];
        while let Some(index) = pending.pop() {
            let node = &self.nodes[index as usize];
            let mut inside = 0b1111;
            for axis in 0..3 {
                let at = Vec4::splat(point[axis]);
                let [low, high] = [2 * axis, 2 * axis + 1].map(|side| Vec4::from_array(node.sides[side]));
                inside &= (low.cmple(at) & at.cmple(high)).bitmask();
            }
            for slot in (0..4).filter(|slot| inside >> slot & 1 == 1) {
                match node.count[slot] {
                    0 => pending.push(node.first[slot]),
                    count => leaf(node.first[slot]..node.first[slot] + count),
                }
            }
        }
    }
}

impl Node {
    const EMPTY: Self = Self {
        sides: [
            [f32::INFINITY; 4],
            [f32::NEG_INFINITY; 4],
            [f32::INFINITY; 4],
            [f32::NEG_INFINITY; 4],
            [f32::INFINITY; 4],
            [f32::NEG_INFINITY; 4],
        ],
        first: [0; 4],
        count: [0; 4],
    };

    /// Whether this slot and all after it are unused.
    pub(crate) fn is_unused(&self, slot: usize) -> bool {
        self.sides[0][slot] > self.sides[1][slot]
    }
}

/// Fills `nodes[place]` from the part of the binary tree below `root`, opening the largest inner nodes until there are
/// four parts.
fn join(binary: &[build::Node], root: usize, place: usize, nodes: &mut Vec<Node>) {
    let children = |index: usize| [index + 1, index + binary[index].first_or_skip as usize];
    let mut parts = vec![root];
    while parts.len() < 4 {
        let area = |part: &usize| binary[*part].bounds.half_area();
        let inner = (0..parts.len()).filter(|&part| binary[parts[part]].count == 0);
        let Some(widest) = inner.max_by(|&a, &b| area(&parts[a]).total_cmp(&area(&parts[b]))) else {
            break;
        };
        let [left, right] = children(parts[widest]);
        parts[widest] = left;
        parts.push(right);
    }
    for (slot, &part) in parts.iter().enumerate() {
        let build::Node { bounds, first_or_skip, count } = binary[part];
        let first = if count > 0 {
            first_or_skip
        } else {
            nodes.push(Node::EMPTY);
            let child = nodes.len() - 1;
            join(binary, part, child, nodes);
            child as u32
        };
        let node = &mut nodes[place];
        for axis in 0..3 {
            node.sides[2 * axis][slot] = bounds.min[axis];
            node.sides[2 * axis + 1][slot] = bounds.max[axis];
        }
        node.first[slot] = first;
        node.count[slot] = count;
    }
}
