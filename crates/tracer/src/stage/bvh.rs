//! A hierarchy of bounding boxes over the bodies, eight boxes to a node, so that one step tests eight boxes with vector
//! instructions, or one box with many rays while the others are near in memory.

mod build;
mod entry;
mod refit;
mod split;
#[cfg(test)]
mod tests;

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec3A, Vec4};

use super::Bounds;
use crate::ray::Ray;
pub(crate) use entry::Entry;
pub(crate) use refit::Path;

/// No path from the root is longer than this.
const MAX_DEPTH: usize = 64;

/// Boxes to a node.
pub(crate) const WIDTH: usize = 8;

/// Eight boxes and what they contain. An unused box is inside out and is never met.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// Least x of the boxes, greatest x, least y, greatest y, least z, greatest z.
    pub sides: [[f32; WIDTH]; 6],
    /// Leaf: its first body. Inner node: its place in the array.
    pub first: [u32; WIDTH],
    /// Leaf: its number of bodies. Inner node: 0.
    pub count: [u32; WIDTH],
}

/// The hierarchy; the root is the first node.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    nodes: Vec<Node>,
    /// What it costs by the surface area heuristic, and what it did when it was built.
    cost: f64,
    built_cost: f64,
}

/// A part of the hierarchy still to be visited; the parameter is where the ray enters it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pending {
    first: u32,
    count: u32,
    enter: f32,
}

impl Bvh {
    /// Builds the hierarchy and sorts `entries` into the order of its leaves, each leaf by the bodies' shapes.
    pub(super) fn build(entries: &mut [Entry]) -> Self {
        let nodes = build::build(entries);
        let cost = refit::cost_of(&nodes);
        Self { nodes, cost, built_cost: cost }
    }

    /// The box of everything.
    pub(super) fn bounds(&self) -> Bounds {
        self.nodes.first().map_or(Bounds::EMPTY, Node::bounds)
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
                let slot = met.trailing_zeros() as usize & (WIDTH - 1);
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

/// Sorts at most eight parts by insertion.
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

    /// The places of the inner nodes below this one. None of them is the root.
    fn children_mut(&mut self) -> impl Iterator<Item = &mut u32> {
        let slots = self.first.iter_mut().zip(&self.count);
        slots.filter(|(first, count)| **first != 0 && **count == 0).map(|(first, _)| first)
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

    /// The parameters at which the ray enters the eight boxes, at least 0, and a bit for each one met before `reach`.
    /// The far sides are moved outwards by the rounding of the three operations (Ize 2013, Robust BVH ray traversal,
    /// eq. 3).
    #[inline]
    fn enter(&self, node: &Node, reach: f32) -> ([f32; WIDTH], u32) {
        const WIDEN: f32 = 1.0 + 4.0 * f32::EPSILON;
        let mut enters = [[0.0; 4]; WIDTH / 4];
        let mut met = 0;
        for (half, enters) in enters.iter_mut().enumerate() {
            let side = |side: usize, axis: usize| {
                let halves: [[f32; 4]; WIDTH / 4] = bytemuck::cast(node.sides[side]);
                (Vec4::from_array(halves[half]) - Vec4::splat(self.origin[axis])) * self.inverse[axis]
            };
            let [near_x, near_y, near_z] = self.near;
            let enter = side(near_x, 0).max(side(near_y, 1)).max(side(near_z, 2)).max(Vec4::ZERO);
            let exit = side(near_x ^ 1, 0).min(side(near_y ^ 1, 1)).min(side(near_z ^ 1, 2));
            *enters = enter.to_array();
            met |= enter.cmple((exit * WIDEN).min(Vec4::splat(reach))).bitmask() << (4 * half);
        }
        (bytemuck::cast(enters), met)
    }
}
