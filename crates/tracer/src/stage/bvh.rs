//! A hierarchy of bounding boxes over the bodies, four boxes to a node.
//!
//! A binary tree is built first and its nodes are then joined in fours (Wald, Benthin, Boulos 2008, Getting rid of
//! packets), so that one step tests four boxes with vector instructions.

mod build;

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{Vec3A, Vec4};

use super::Bounds;
use crate::ray::Ray;

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

/// A part of the hierarchy still to be visited; the parameter is where the ray enters it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pending {
    first: u32,
    count: u32,
    enter: f32,
}

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

    /// Calls `leaf` with the bodies of the leaves whose boxes the ray meets, nearer boxes first. `leaf` returns the
    /// parameter beyond which nothing is wanted any more. `pending` is working memory, empty before and after.
    #[inline]
    pub(crate) fn traverse(
        &self,
        ray: &Ray,
        mut reach: f32,
        pending: &mut Vec<Pending>,
        mut leaf: impl FnMut(Range<u32>) -> f32,
    ) {
        let boxes = BoxTest::new(ray);
        pending.clear();
        let mut index = 0;
        loop {
            let node = &self.nodes[index as usize];
            let (enter, mut met) = boxes.enter(node, reach);
            let start = pending.len();
            while met != 0 {
                let slot = met.trailing_zeros() as usize & 3;
                met &= met - 1;
                pending.push(Pending {
                    first: node.first[slot],
                    count: node.count[slot],
                    enter: enter[slot],
                });
            }
            farthest_first(&mut pending[start..]);
            index = loop {
                match pending.pop() {
                    None => return,
                    Some(part) if part.enter > reach => {}
                    Some(part) if part.count == 0 => break part.first,
                    Some(part) => reach = leaf(part.first..part.first + part.count),
                }
            };
        }
    }
}

/// Sorts at most four parts by insertion.
#[inline]
fn farthest_first(parts: &mut [Pending]) {
    for sorted in 1..parts.len() {
        let mut place = sorted;
        while place > 0 && parts[place - 1].enter < parts[place].enter {
            parts.swap(place - 1, place);
            place -= 1;
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

/// A ray prepared for box tests.
struct BoxTest {
    origin: Vec3A,
    inverse: Vec3A,
    /// Which of a node's sides the ray meets first along each axis.
    near: [usize; 3],
}

impl BoxTest {
    /// Directions are unit vectors and coordinates at most some 10¹⁸: components below this are as good as 0, and
    /// their inverse times a coordinate stays below 3.4·10³⁸, so that no NaN arises.
    const TINY: f32 = 1e-20;

    fn new(ray: &Ray) -> Self {
        let tiny = Vec3A::splat(Self::TINY).copysign(ray.direction);
        let inverse = Vec3A::select(ray.direction.abs().cmplt(tiny.abs()), tiny, ray.direction).recip();
        let near = |axis: usize| 2 * axis + usize::from(inverse[axis] < 0.0);
        let near = [near(0), near(1), near(2)];
        Self { origin: ray.origin, inverse, near }
    }

    /// The parameters at which the ray enters the four boxes, at least 0, and a bit for each one met before `reach`.
    /// The far sides are moved outwards by the rounding of the three operations (Ize 2013, Robust BVH ray traversal,
    /// eq. 3).
    #[inline]
    fn enter(&self, node: &Node, reach: f32) -> (Vec4, u32) {
        const WIDEN: f32 = 1.0 + 4.0 * f32::EPSILON;
        let side = |side: usize, axis: usize| {
            (Vec4::from_array(node.sides[side]) - Vec4::splat(self.origin[axis])) * self.inverse[axis]
        };
        let [near_x, near_y, near_z] = self.near;
        let enter = side(near_x, 0).max(side(near_y, 1)).max(side(near_z, 2)).max(Vec4::ZERO);
        let exit = side(near_x ^ 1, 0).min(side(near_y ^ 1, 1)).min(side(near_z ^ 1, 2));
        (enter, enter.cmple((exit * WIDEN).min(Vec4::splat(reach))).bitmask())
    }
}
