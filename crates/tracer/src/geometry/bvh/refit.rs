//! Following bodies that move: their boxes and all around them are fitted again.

use std::ops::Range;

use rayon::prelude::*;

use crate::geometry::bounds::Bounds;
use crate::geometry::bvh::build::NODE_COST;
use crate::geometry::bvh::{Bvh, BvhNode, WIDTH};

/// The way from the root to a leaf: in each node on it, the slot.
pub(crate) type NodePath = Vec<(u32, usize)>;

/// The hierarchy may cost so many times what it did when it was built. A single body that crosses a large scene adds
/// some percent.
const MOST_WORN: f64 = 1.5;

impl Bvh {
    /// The way to the leaf for which `is_wanted` holds; a body with these bounds is in it.
    pub(crate) fn path_to(
        &self,
        bounds: &Bounds,
        is_wanted: impl Fn(Range<u32>) -> bool,
    ) -> Option<NodePath> {
        let mut path = vec![(0, 0)];
        while let Some(last) = path.last_mut() {
            let (place, slot) = *last;
            let node = self.nodes.get(place as usize)?;
            if slot == WIDTH {
                path.pop();
                if let Some(last) = path.last_mut() {
                    last.1 += 1;
                }
            } else if node.box_of(slot).union(*bounds) != node.box_of(slot) {
                last.1 += 1;
            } else if node.count[slot] == 0 {
                path.push((node.first[slot], 0));
            } else if is_wanted(node.leaf(slot)) {
                return Some(path);
            } else {
                last.1 += 1;
            }
        }
        None
    }

    /// The bodies of the leaf at the end of a way.
    pub(crate) fn leaf(&self, path: &NodePath) -> Range<u32> {
        let end = path.last().and_then(|&(place, slot)| Some(self.nodes.get(place as usize)?.leaf(slot)));
        end.unwrap_or_default()
    }

    /// Gives the leaf at the end of a way this box, and fits all boxes around it.
    pub(crate) fn refit(&mut self, path: &NodePath, mut bounds: Bounds) {
        for &(place, slot) in path.iter().rev() {
            let Some(node) = self.nodes.get_mut(place as usize) else { return };
            self.cost -= node.cost_of(slot);
            node.set_box(slot, bounds);
            self.cost += node.cost_of(slot);
            bounds = node.bounds();
        }
    }

    /// By how much the hierarchy costs more if the leaf at the end of a way has to have room for this box too.
    pub(crate) fn growth(&self, path: &NodePath, bounds: Bounds) -> f64 {
        let growth = |&(place, slot): &(u32, usize)| {
            let mut node = *self.nodes.get(place as usize)?;
            let before = node.cost_of(slot);
            node.set_box(slot, node.box_of(slot).union(bounds));
            Some(node.cost_of(slot) - before)
        };
        path.iter().filter_map(growth).sum()
    }

    /// What the hierarchy costs: the expected work for a ray, times an area that is the same for all hierarchies.
    pub(crate) fn cost(&self) -> f64 {
        self.cost
    }

    /// Whether the hierarchy is not too bad when it costs this.
    pub(crate) fn allows(&self, cost: f64) -> bool {
        cost <= MOST_WORN * self.built_cost
    }
}

/// The cost of nodes that were just built.
pub(crate) fn cost_of(nodes: &[BvhNode]) -> f64 {
    let of = |node: &BvhNode| (0..WIDTH).map(|slot| node.cost_of(slot)).sum::<f64>();
    // In pieces of fixed length, so that rounding is the same for any number of threads.
    let pieces: Vec<f64> = nodes.par_chunks(1024).map(|nodes| nodes.iter().map(of).sum()).collect();
    pieces.iter().sum()
}

impl BvhNode {
    /// The bodies of a leaf.
    fn leaf(&self, slot: usize) -> Range<u32> {
        self.first[slot]..self.first[slot] + self.count[slot]
    }

    fn box_of(&self, slot: usize) -> Bounds {
        let sides = self.sides.map(|side| side[slot]);
        Bounds { min: [sides[0], sides[2], sides[4]].into(), max: [sides[1], sides[3], sides[5]].into() }
    }

    /// The area of a box times the work of opening it.
    fn cost_of(&self, slot: usize) -> f64 {
        let work = if self.count[slot] == 0 { NODE_COST } else { self.count[slot] as f32 };
        f64::from(self.box_of(slot).half_area()) * f64::from(work)
    }
}
