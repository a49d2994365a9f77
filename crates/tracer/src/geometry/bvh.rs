//! A hierarchy of bounding boxes over the bodies, eight boxes to a node, so that one step tests eight boxes with vector
//! instructions, or one box with many rays while the others are near in memory.

pub(crate) mod alone;
pub(crate) mod build;
pub(crate) mod entry;
pub(crate) mod packet;
pub(crate) mod refit;
pub(crate) mod split;
pub(crate) mod stream;

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec3A};

use crate::geometry::bounds::Bounds;
use crate::geometry::bvh::entry::BuildEntry;
use crate::simd::{Float8 as _, Width};

/// No path from the root is longer than this.
const MAX_DEPTH: usize = 64;

/// Boxes to a node.
pub(crate) const WIDTH: usize = 8;

/// Eight boxes and what they contain. An unused box is inside out and is never met.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct BvhNode {
    /// Least x of the boxes, greatest x, least y, greatest y, least z, greatest z.
    pub sides: [[f32; WIDTH]; 6],
    /// Leaf: its first body. Inner node: its place in the array.
    pub first: [u32; WIDTH],
    /// Leaf: its number of bodies. Inner node: 0.
    pub count: [u32; WIDTH],
}

/// What is done with the leaves that one ray or a packet meets.
pub(crate) trait LeafVisitor<W: Width> {
    /// Whether the nearer leaves are better shown first.
    const NEAREST_FIRST: bool;

    /// The parameters beyond which nothing is wanted any more.
    fn t_max(&self) -> W::R;
    /// Asks for bodies that will probably be met soon.
    #[inline(always)]
    fn fetch(&self, _bodies: Range<u32>) {}
    /// Meets the bodies of a leaf, whose box these lanes meet.
    fn leaf(&mut self, bodies: Range<u32>, lanes: W::M);
}

/// The hierarchy; the root is the first node.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    nodes: Vec<BvhNode>,
    /// What it costs by the surface area heuristic, and what it did when it was built.
    cost: f64,
    built_cost: f64,
}

/// Moves far sides outwards by the rounding of the three operations (Ize 2013, Robust BVH ray traversal, eq. 3).
pub(crate) const WIDEN: f32 = 1.0 + 4.0 * f32::EPSILON;

/// Directions are unit vectors and coordinates at most some 10¹⁸: components below this are as good as 0, and their
/// inverse times a coordinate stays below 3.4·10³⁸, so that no NaN arises.
pub(crate) const TINY: f32 = 1e-20;

impl Bvh {
    /// Builds the hierarchy and sorts `entries` into the order of its leaves, each leaf by the bodies' shapes.
    pub(crate) fn build(entries: &mut [BuildEntry]) -> Self {
        let nodes = build::build(entries);
        let cost = refit::cost_of(&nodes);
        Self { nodes, cost, built_cost: cost }
    }

    /// The box of everything.
    pub(crate) fn bounds(&self) -> Bounds {
        self.nodes.first().map_or(Bounds::EMPTY, BvhNode::bounds)
    }

    /// The nodes, the root first and each before those below it.
    pub(crate) fn nodes(&self) -> &[BvhNode] {
        &self.nodes
    }

    /// Asks for the node in a box that will probably be opened soon. The bodies, if it is a leaf, are yet to be asked for.
    #[inline(always)]
    fn fetch(&self, first: u32, count: u32) -> Range<u32> {
        if count == 0 {
            crate::geometry::prefetch::fetch(&self.nodes, first);
        }
        first..first + count
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
            for slot in (0..WIDTH).filter(|&slot| node.contains(slot, point)) {
                match node.count[slot] {
                    0 => pending.push(node.first[slot]),
                    count => leaf(node.first[slot]..node.first[slot] + count),
                }
            }
        }
    }
}

impl BvhNode {
    const EMPTY: Self = Self {
        sides: [
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        first: [0; WIDTH],
        count: [0; WIDTH],
    };

    fn set(&mut self, slot: usize, bounds: Bounds, first: usize, count: usize) {
        self.set_box(slot, bounds);
        self.first[slot] = first as u32;
        self.count[slot] = count as u32;
    }

    fn set_box(&mut self, slot: usize, bounds: Bounds) {
        for axis in 0..3 {
            self.sides[2 * axis][slot] = bounds.min[axis];
            self.sides[2 * axis + 1][slot] = bounds.max[axis];
        }
    }

    /// The places of the inner nodes below this one.
    pub(crate) fn children(&self) -> impl Iterator<Item = u32> {
        let slots = self.first.iter().zip(&self.count);
        slots.filter(|(first, count)| **first != 0 && **count == 0).map(|(first, _)| *first)
    }

    /// The places of the inner nodes below this one, to be changed. None of them is the root.
    fn children_mut(&mut self) -> impl Iterator<Item = &mut u32> {
        let slots = self.first.iter_mut().zip(&self.count);
        slots.filter(|(first, count)| **first != 0 && **count == 0).map(|(first, _)| first)
    }

    /// A bit for each slot that has a box.
    #[inline(always)]
    fn used<W: Width>(&self, w: W) -> u32 {
        w.eight(&self.sides[0]).le(w.eight(&self.sides[1]))
    }

    /// Whether a box contains a point.
    fn contains(&self, slot: usize, point: Vec3A) -> bool {
        let within = |axis: usize| {
            self.sides[2 * axis][slot] <= point[axis] && point[axis] <= self.sides[2 * axis + 1][slot]
        };
        within(0) && within(1) && within(2)
    }

    /// The box of all eight boxes.
    fn bounds(&self) -> Bounds {
        let least = |side: usize| self.sides[side].iter().copied().fold(f32::INFINITY, f32::min);
        let greatest = |side: usize| self.sides[side].iter().copied().fold(f32::NEG_INFINITY, f32::max);
        Bounds {
            min: Vec3::new(least(0), least(2), least(4)),
            max: Vec3::new(greatest(1), greatest(3), greatest(5)),
        }
    }
}

#[cfg(test)]
mod tests;
