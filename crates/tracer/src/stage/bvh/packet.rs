//! Rays side by side through the hierarchy: a box is tested against all of them at once.

use std::ops::Range;

use super::Bvh;
use crate::lanes::{MOST_LANES, Mask as _, Real as _, Width};
use crate::vector::Vector;

/// A part of the hierarchy still to be visited.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PacketPart {
    first: u32,
    count: u32,
    /// A bit for each ray that meets its box, and where it enters.
    lanes: u32,
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
    /// Where all rays run the same way along an axis, the side of a box that they meet first.
    near: [Option<usize>; 3],
}

impl Bvh {
    /// Prepares rays.
    #[inline(always)]
    pub(crate) fn packet<W: Width>(
        &self,
        w: W,
        origin: Vector<W::R>,
        direction: Vector<W::R>,
    ) -> PacketBoxes<W> {
        let (zero, one, tiny) = (w.real(0.0), w.real(1.0), w.real(super::TINY));
        let inverse =
            direction.map(|part| one / W::R::select(part.abs().lt(tiny), tiny.copysign(part), part));
        let near = |axis: usize, part: W::R| {
            let negative = part.lt(zero).bits();
            let all = ((1_u64 << W::LANES) - 1) as u32;
            let low = 2 * axis;
            (negative == 0).then_some(low).or((negative == all).then_some(low + 1))
        };
        let near = [near(0, inverse.x), near(1, inverse.y), near(2, inverse.z)];
        PacketBoxes { origin, inverse, near }
    }

    /// Shows `visitor` the bodies of the leaves whose boxes some of `lanes` meet; boxes nearer to the first of them come
    /// first. `parts` is working memory, empty before and after.
    #[inline(always)]
    pub(crate) fn traverse_packet<W: Width>(
        &self,
        w: W,
        boxes: &PacketBoxes<W>,
        lanes: W::M,
        parts: &mut Vec<PacketPart>,
        visitor: &mut impl Visit<W>,
    ) {
        parts.clear();
        let mut index = 0;
        let mut lanes = lanes;
        loop {
            let node = &self.nodes[index as usize];
            let start = parts.len();
            let far = visitor.reach();
            for slot in 0..node.first.len() {
                if node.is_unused(slot) {
                    continue;
                }
                let (enter, met) = boxes.enter(w, &node.sides, slot, far);
                let met = (met & lanes).bits();
                if met != 0 {
                    let mut part = PacketPart {
                        first: node.first[slot],
                        count: node.count[slot],
                        lanes: met,
                        enter: [0.0; MOST_LANES],
                    };
                    enter.store(&mut part.enter);
                    parts.push(part);
                }
            }
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

impl PacketPart {
    /// Where the first of its rays enters.
    fn key(&self) -> f32 {
        self.enter[self.lanes.trailing_zeros() as usize % MOST_LANES]
    }
}

/// Sorts a few parts by insertion.
#[inline(always)]
fn farthest_first(parts: &mut [PacketPart]) {
    for sorted in 1..parts.len() {
        let mut place = sorted;
        while place > 0 && parts[place - 1].key() < parts[place].key() {
            parts.swap(place - 1, place);
            place -= 1;
        }
    }
}

impl<W: Width> PacketBoxes<W> {
    /// The parameters at which the rays enter a box, at least 0, and those which meet it before `reach`. The far sides
    /// are moved outwards by the rounding of the three operations (Ize 2013, Robust BVH ray traversal, eq. 3).
    #[inline(always)]
    fn enter<const N: usize>(&self, w: W, sides: &[[f32; N]; 6], slot: usize, reach: W::R) -> (W::R, W::M) {
        const WIDEN: f32 = 1.0 + 4.0 * f32::EPSILON;
        let x = self.along(w, 0, sides, slot, self.origin.x, self.inverse.x);
        let y = self.along(w, 1, sides, slot, self.origin.y, self.inverse.y);
        let z = self.along(w, 2, sides, slot, self.origin.z, self.inverse.z);
        let enter = x.0.max(y.0).max(z.0).max(w.real(0.0));
        let exit = x.1.min(y.1).min(z.1);
        (enter, enter.le((exit * WIDEN).min(reach)))
    }

    /// Where the rays cross the two sides across one axis.
    #[inline(always)]
    fn along<const N: usize>(
        &self,
        w: W,
        axis: usize,
        sides: &[[f32; N]; 6],
        slot: usize,
        origin: W::R,
        inverse: W::R,
    ) -> (W::R, W::R) {
        if let Some(near) = self.near[axis] {
            let at_near = (w.real(sides[near][slot]) - origin) * inverse;
            let at_far = (w.real(sides[near ^ 1][slot]) - origin) * inverse;
            return (at_near, at_far);
        }
        let at_low = (w.real(sides[2 * axis][slot]) - origin) * inverse;
        let at_high = (w.real(sides[2 * axis + 1][slot]) - origin) * inverse;
        (at_low.min(at_high), at_low.max(at_high))
    }
}
