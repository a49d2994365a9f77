//! Rays side by side through the hierarchy.
//!
//! Rays that run the same way are first tested together as a beam against the eight boxes of a node at once, by interval
//! arithmetic (Boulos, Wald, Shirley 2006, Geometric and arithmetic culling methods for entire ray packets); the boxes that
//! are left are tested one by one against all rays at once.

use std::ops::Range;

use super::{Bvh, Node, WIDTH};
use crate::lanes::{MOST_LANES, Mask as _, Real as _, Width};
use crate::vector::Vector;

/// A part of the hierarchy still to be visited.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PacketPart {
    first: u32,
    count: u32,
    /// A bit for each ray that meets its box.
    lanes: u32,
    /// Where the first ray enters, or the beam.
    key: f32,
    /// Where each ray enters.
    enter: [f32; MOST_LANES],
}

/// What is done with the leaves.
pub(crate) trait Visit<W: Width> {
    /// The parameters beyond which nothing is wanted any more.
    fn reach(&self) -> W::R;
    /// Meets the bodies of a leaf, whose box these lanes meet.
    fn leaf(&mut self, bodies: Range<u32>, lanes: W::M);
}

/// Rays prepared for box tests.
pub(crate) struct PacketBoxes<W: Width> {
    origin: Vector<W::R>,
    inverse: Vector<W::R>,
    lanes: W::M,
    /// All of them together, if they run the same way along each axis.
    beam: Option<Beam>,
}

/// Between which numbers the rays of a packet lie, for each axis.
struct Beam([BeamAxis; 3]);

#[derive(Clone, Copy)]
struct BeamAxis {
    /// The side of a node's boxes that they meet first.
    near: usize,
    /// The origin that is nearest to that side, and the one that is farthest from the other.
    near_origin: f32,
    far_origin: f32,
    /// Least and greatest inverse of the direction.
    least: f32,
    greatest: f32,
}

impl Bvh {
    /// Prepares rays.
    #[inline(always)]
    pub(crate) fn packet<W: Width>(
        &self,
        w: W,
        origin: Vector<W::R>,
        direction: Vector<W::R>,
        lanes: W::M,
    ) -> PacketBoxes<W> {
        let (one, tiny) = (w.real(1.0), w.real(super::TINY));
        let inverse = Vector::new(
            one / W::R::select(direction.x.abs().lt(tiny), tiny.copysign(direction.x), direction.x),
            one / W::R::select(direction.y.abs().lt(tiny), tiny.copysign(direction.y), direction.y),
            one / W::R::select(direction.z.abs().lt(tiny), tiny.copysign(direction.z), direction.z),
        );
        PacketBoxes { origin, inverse, lanes, beam: Beam::of(w, origin, inverse, lanes) }
    }

    /// Shows `visitor` the bodies of the leaves whose boxes some of the rays meet, mostly the nearer ones first. `parts`
    /// is working memory, empty before and after.
    #[inline(always)]
    pub(crate) fn traverse_packet<W: Width>(
        &self,
        w: W,
        boxes: &PacketBoxes<W>,
        parts: &mut Vec<PacketPart>,
        visitor: &mut impl Visit<W>,
    ) {
        parts.clear();
        let (mut index, mut lanes) = (0, boxes.lanes);
        loop {
            let node = &self.nodes[index as usize];
            let start = parts.len();
            boxes.push_met(w, node, lanes, visitor.reach(), parts);
            farthest_first(&mut parts[start..]);
            loop {
                let Some(part) = parts.pop() else { return };
                let alive = w.mask(part.lanes) & w.load(&part.enter).le(visitor.reach());
                if !alive.any() {
                    continue;
                }
                if part.count == 0 {
                    (index, lanes) = (part.first, alive);
                    break;
                }
                visitor.leaf(part.first..part.first + part.count, alive);
            }
        }
    }
}

/// Sorts a few parts by insertion.
#[inline(always)]
fn farthest_first(parts: &mut [PacketPart]) {
    for sorted in 1..parts.len() {
        let mut place = sorted;
        while place > 0 && parts[place - 1].key < parts[place].key {
            parts.swap(place - 1, place);
            place -= 1;
        }
    }
}

impl<W: Width> PacketBoxes<W> {
    /// Appends the children of a node that some of the rays meet.
    #[inline(always)]
    fn push_met(&self, w: W, node: &Node, lanes: W::M, reach: W::R, parts: &mut Vec<PacketPart>) {
        let (keys, mut left) = match &self.beam {
            Some(beam) => beam.enter(node, W::R::select(lanes, reach, w.real(0.0)).greatest()),
            None => ([f32::NAN; WIDTH], node.used()),
        };
        while left != 0 {
            let slot = left.trailing_zeros() as usize % WIDTH;
            left &= left - 1;
            let (enter, met) = self.enter(w, node, slot, reach);
            let met = (met & lanes).bits();
            if met != 0 {
                let mut part = PacketPart {
                    first: node.first[slot],
                    count: node.count[slot],
                    lanes: met,
                    key: keys[slot],
                    enter: [0.0; MOST_LANES],
                };
                enter.store(&mut part.enter);
                if self.beam.is_none() {
                    part.key = part.enter[met.trailing_zeros() as usize % MOST_LANES];
                }
                parts.push(part);
            }
        }
    }

    /// The parameters at which the rays enter a box, at least 0, and those which meet it before `reach`. The far sides
    /// are moved outwards by the rounding of the three operations (Ize 2013, Robust BVH ray traversal, eq. 3).
    #[inline(always)]
    fn enter(&self, w: W, node: &Node, slot: usize, reach: W::R) -> (W::R, W::M) {
        let x = self.along(w, 0, node, slot, self.origin.x, self.inverse.x);
        let y = self.along(w, 1, node, slot, self.origin.y, self.inverse.y);
        let z = self.along(w, 2, node, slot, self.origin.z, self.inverse.z);
        let enter = x.0.max(y.0).max(z.0).max(w.real(0.0));
        let exit = x.1.min(y.1).min(z.1);
        (enter, enter.le((exit * WIDEN).min(reach)))
    }

    /// Where the rays cross the two sides across one axis.
    #[inline(always)]
    fn along(
        &self,
        w: W,
        axis: usize,
        node: &Node,
        slot: usize,
        origin: W::R,
        inverse: W::R,
    ) -> (W::R, W::R) {
        if let Some(beam) = &self.beam {
            let near = beam.0[axis].near;
            let at_near = (w.real(node.sides[near][slot]) - origin) * inverse;
            let at_far = (w.real(node.sides[near ^ 1][slot]) - origin) * inverse;
            return (at_near, at_far);
        }
        let at_low = (w.real(node.sides[2 * axis][slot]) - origin) * inverse;
        let at_high = (w.real(node.sides[2 * axis + 1][slot]) - origin) * inverse;
        (at_low.min(at_high), at_low.max(at_high))
    }
}

/// Moves far sides outwards by rounding.
pub(crate) const WIDEN: f32 = 1.0 + 4.0 * f32::EPSILON;

impl Beam {
    #[inline(always)]
    fn of<W: Width>(w: W, origin: Vector<W::R>, inverse: Vector<W::R>, lanes: W::M) -> Option<Self> {
        Some(Self([
            BeamAxis::of(w, 0, origin.x, inverse.x, lanes)?,
            BeamAxis::of(w, 1, origin.y, inverse.y, lanes)?,
            BeamAxis::of(w, 2, origin.z, inverse.z, lanes)?,
        ]))
    }

    /// Bounds from below for where the rays enter the boxes of a node, and a bit for each box that any may meet before
    /// `reach`. Rounding is monotonic: what holds for the ends of an interval holds for the rays in it.
    #[inline(always)]
    fn enter(&self, node: &Node, reach: f32) -> ([f32; WIDTH], u32) {
        let (mut enter, mut exit) = ([0.0_f32; WIDTH], [reach; WIDTH]);
        for axis in &self.0 {
            let (near, far) = (&node.sides[axis.near], &node.sides[axis.near ^ 1]);
            let BeamAxis { near_origin, far_origin, least, greatest, .. } = *axis;
            for slot in 0..WIDTH {
                let (to_near, to_far) = (near[slot] - near_origin, far[slot] - far_origin);
                let first = smaller(to_near * least, to_near * greatest);
                let last = larger(to_far * least, to_far * greatest) * WIDEN;
                enter[slot] = larger(first, enter[slot]);
                exit[slot] = smaller(last, exit[slot]);
            }
        }
        let met = (0..WIDTH).fold(0, |met, slot| met | u32::from(enter[slot] <= exit[slot]) << slot);
        (enter, met)
    }
}

impl BeamAxis {
    /// `None` if the rays do not run the same way along the axis.
    #[inline(always)]
    fn of<W: Width>(w: W, axis: usize, origin: W::R, inverse: W::R, lanes: W::M) -> Option<Self> {
        let back = (inverse.lt(w.real(0.0)) & lanes).bits();
        let is_back = back != 0;
        if is_back && back != lanes.bits() {
            return None;
        }
        let (above, below) = (w.real(f32::INFINITY), w.real(f32::NEG_INFINITY));
        let first = W::R::select(lanes, origin, above).least();
        let last = W::R::select(lanes, origin, below).greatest();
        let (near_origin, far_origin) = if is_back { (first, last) } else { (last, first) };
        Some(Self {
            near: 2 * axis + usize::from(is_back),
            near_origin,
            far_origin,
            least: W::R::select(lanes, inverse, above).least(),
            greatest: W::R::select(lanes, inverse, below).greatest(),
        })
    }
}

#[inline(always)]
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
