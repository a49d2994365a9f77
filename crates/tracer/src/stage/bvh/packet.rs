//! Rays side by side through the hierarchy.
//!
//! Rays that run the same way are first tested together as a beam against the eight boxes of a node at once, by interval
//! arithmetic (Boulos, Wald, Shirley 2006, Geometric and arithmetic culling methods for entire ray packets); the boxes that
//! are left are tested one by one against all rays at once. Where few rays are left of a packet, each goes on alone, and
//! is tested against eight boxes at once.

use std::ops::Range;

use super::{Bvh, Node};
use crate::lanes::{Eight as _, MOST_LANES, Mask as _, Real as _, Width};
use crate::vector::Vector;

/// What is done with the leaves.
pub(crate) trait Visit<W: Width> {
    /// Whether the nearer leaves are better shown first.
    const NEAREST_FIRST: bool;

    /// The parameters beyond which nothing is wanted any more.
    fn reach(&self) -> W::R;
    /// Meets the bodies of a leaf, whose box these lanes meet.
    fn leaf(&mut self, bodies: Range<u32>, lanes: W::M);
}

/// Parts of the hierarchy still to be visited: working memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pending {
    /// By several rays.
    shared: Vec<SharedPart>,
    /// By one.
    alone: Vec<LonePart>,
}

/// A part that several rays are to visit.
#[derive(Clone, Copy, Debug, Default)]
struct SharedPart {
    first: u32,
    count: u32,
    /// A bit for each ray that meets its box.
    lanes: u32,
    /// Where each ray enters.
    enter: [f32; MOST_LANES],
}

/// A part that one ray is to visit.
#[derive(Clone, Copy, Debug, Default)]
struct LonePart {
    first: u32,
    count: u32,
    /// Where it enters.
    enter: f32,
}

impl Pending {
    /// No path is longer than [`super::MAX_DEPTH`], and each node on it leaves at most seven parts behind.
    const MOST: usize = 8 * super::MAX_DEPTH;

    /// Places for all parts, so that none has to be moved into place.
    #[inline(always)]
    fn ready(&mut self, is_shared: bool) -> (&mut [SharedPart], &mut [LonePart]) {
        if self.alone.is_empty() {
            self.make(is_shared);
        }
        (&mut self.shared, &mut self.alone)
    }

    #[cold]
    fn make(&mut self, is_shared: bool) {
        self.alone.resize(Self::MOST, LonePart::default());
        if is_shared {
            self.shared.resize(Self::MOST, SharedPart::default());
        }
    }
}

/// Rays prepared for box tests.
pub(crate) struct PacketBoxes<W: Width> {
    origin: Vector<W::R>,
    inverse: Vector<W::R>,
    lanes: W::M,
    /// The same, to take single rays from.
    origins: [[f32; MOST_LANES]; 3],
    inverses: [[f32; MOST_LANES]; 3],
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

/// One ray of a packet, for each axis.
struct Lone<W: Width>([LoneAxis<W>; 3]);

struct LoneAxis<W: Width> {
    /// The side of a node's boxes that it meets first.
    near: usize,
    origin: W::E,
    inverse: W::E,
}

impl Bvh {
    /// Up to so many rays go on alone. (With 16 side by side, where a test of rays against a box takes as long as that of a
    /// ray against eight boxes.)
    const FEW_RAYS: u32 = 4;

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
        let (mut origins, mut inverses) = ([[0.0; MOST_LANES]; 3], [[0.0; MOST_LANES]; 3]);
        store(origin, &mut origins);
        store(inverse, &mut inverses);
        PacketBoxes { origin, inverse, lanes, origins, inverses, beam: Beam::of(w, origin, inverse, lanes) }
    }

    /// Shows `visitor` the bodies of the leaves whose boxes some of the rays meet, mostly the nearer ones first.
    #[inline(always)]
    pub(crate) fn traverse_packet<W: Width, V: Visit<W>>(
        &self,
        w: W,
        boxes: &PacketBoxes<W>,
        pending: &mut Pending,
        visitor: &mut V,
    ) {
        let (shared, alone) = pending.ready(W::LANES > Self::FEW_RAYS as usize);
        let (mut index, mut lanes) = (0, boxes.lanes);
        let mut waiting = 0;
        let mut farthest = boxes.farthest(w, visitor.reach());
        loop {
            let mut bits = lanes.bits();
            if bits.count_ones() <= Self::FEW_RAYS {
                while bits != 0 {
                    let lane = bits.trailing_zeros() as usize % MOST_LANES;
                    bits &= bits - 1;
                    self.traverse_alone(w, boxes, lane, index, alone, visitor);
                }
                farthest = boxes.farthest(w, visitor.reach());
            } else {
                let node = &self.nodes[index as usize];
                let order = boxes.order(w, node, bits, farthest, V::NEAREST_FIRST);
                let reach = visitor.reach();
                for slot in order {
                    let (enter, met) = boxes.enter(w, node, slot, reach);
                    let met = (met & lanes).bits();
                    if met != 0 {
                        let part = &mut shared[waiting];
                        (part.first, part.count, part.lanes) = (node.first[slot], node.count[slot], met);
                        enter.store(&mut part.enter);
                        waiting += 1;
                    }
                }
            }
            loop {
                if waiting == 0 {
                    return;
                }
                waiting -= 1;
                let part = &shared[waiting];
                let alive = w.mask(part.lanes) & w.load(&part.enter).le(visitor.reach());
                if !alive.any() {
                    continue;
                }
                if part.count == 0 {
                    (index, lanes) = (part.first, alive);
                    break;
                }
                visitor.leaf(part.first..part.first + part.count, alive);
                farthest = boxes.farthest(w, visitor.reach());
            }
        }
    }

    /// The same for one of the rays, from a node on.
    #[inline(always)]
    fn traverse_alone<W: Width, V: Visit<W>>(
        &self,
        w: W,
        boxes: &PacketBoxes<W>,
        lane: usize,
        index: u32,
        parts: &mut [LonePart],
        visitor: &mut V,
    ) {
        let ray = boxes.alone(w, lane);
        let lanes = w.mask(1 << lane);
        let reach_of = |reach: W::R| {
            let mut all = [0.0; MOST_LANES];
            reach.store(&mut all);
            all[lane]
        };
        let mut reach = reach_of(visitor.reach());
        let mut index = index;
        let mut waiting = 0;
        loop {
            let node = &self.nodes[index as usize];
            for (slot, enter) in ray.met(w, node, reach, V::NEAREST_FIRST) {
                parts[waiting] = LonePart { first: node.first[slot], count: node.count[slot], enter };
                waiting += 1;
            }
            loop {
                if waiting == 0 {
                    return;
                }
                waiting -= 1;
                let LonePart { first, count, enter } = parts[waiting];
                if enter > reach {
                    continue;
                }
                if count == 0 {
                    index = first;
                    break;
                }
                visitor.leaf(first..first + count, lanes);
                reach = reach_of(visitor.reach());
            }
        }
    }
}

/// Boxes of a node, perhaps the farthest first.
struct Order {
    /// Where each is entered, as bits of a number of at least 0, with the number of the box in the lowest bits.
    keys: [u32; 8],
    at: usize,
    len: usize,
}

impl Order {
    /// Those of `left`; where they are entered are numbers of at least 0. In any order unless `is_sorted`.
    #[inline(always)]
    fn new(enter: &[u32; 8], left: u32, is_sorted: bool) -> Self {
        let mut order = Self { keys: [0; 8], at: 0, len: 0 };
        let mut left = left;
        while left != 0 {
            let slot = left.trailing_zeros() % 8;
            left &= left - 1;
            let key = enter[slot as usize] & !7 | slot;
            let mut place = order.len % 8;
            while is_sorted && place > 0 && order.keys[place - 1] < key {
                order.keys[place] = order.keys[place - 1];
                place -= 1;
            }
            order.keys[place] = key;
            order.len += 1;
        }
        order
    }
}

impl Iterator for Order {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        if self.at == self.len {
            return None;
        }
        let key = self.keys[self.at % 8];
        self.at += 1;
        Some(key as usize % 8)
    }
}

#[inline(always)]
fn store<R: crate::lanes::Real>(vector: Vector<R>, to: &mut [[f32; MOST_LANES]; 3]) {
    let [x, y, z] = to;
    vector.x.store(x);
    vector.y.store(y);
    vector.z.store(z);
}

impl<W: Width> PacketBoxes<W> {
    /// How far any of the rays reaches.
    #[inline(always)]
    fn farthest(&self, w: W, reach: W::R) -> f32 {
        match &self.beam {
            Some(_) => W::R::select(self.lanes, reach, w.real(0.0)).greatest(),
            None => f32::INFINITY,
        }
    }

    /// The boxes that may be met by some of the rays of `lanes`.
    #[inline(always)]
    fn order(&self, w: W, node: &Node, lanes: u32, farthest: f32, is_sorted: bool) -> Order {
        let (enter, left) = match &self.beam {
            Some(beam) => beam.enter(w, node, farthest),
            None if is_sorted => {
                // The first ray stands for all.
                let lane = lanes.trailing_zeros() as usize % MOST_LANES;
                (self.alone(w, lane).enter(w, node).0, node.used(w))
            }
            None => (w.eight_like(0.0), node.used(w)),
        };
        Order::new(&enter.to_words(), left, is_sorted)
    }

    /// One of the rays.
    #[inline(always)]
    fn alone(&self, w: W, lane: usize) -> Lone<W> {
        let axis = |axis: usize| {
            let inverse = self.inverses[axis][lane];
            LoneAxis {
                near: 2 * axis + usize::from(inverse < 0.0),
                origin: w.eight_like(self.origins[axis][lane]),
                inverse: w.eight_like(inverse),
            }
        };
        Lone([axis(0), axis(1), axis(2)])
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

impl<W: Width> Lone<W> {
    /// Where the ray enters the boxes of a node, at least 0, and leaves them; see [`PacketBoxes::enter`].
    #[inline(always)]
    fn enter(&self, w: W, node: &Node) -> (W::E, W::E) {
        let [x, y, z] = &self.0;
        let to_near = |a: &LoneAxis<W>| (w.eight(&node.sides[a.near % 6]) - a.origin) * a.inverse;
        let to_far = |a: &LoneAxis<W>| (w.eight(&node.sides[(a.near ^ 1) % 6]) - a.origin) * a.inverse;
        let enter = to_near(x).max(to_near(y)).max(to_near(z)).max(w.eight_like(0.0));
        let exit = to_far(x).min(to_far(y)).min(to_far(z));
        (enter, exit * w.eight_like(WIDEN))
    }

    /// The boxes that it meets before `reach` and where it enters them, see [`Order::new`].
    #[inline(always)]
    fn met(&self, w: W, node: &Node, reach: f32, is_sorted: bool) -> impl Iterator<Item = (usize, f32)> {
        let (enter, exit) = self.enter(w, node);
        let met = enter.le(exit.min(w.eight_like(reach)));
        let words = enter.to_words();
        Order::new(&words, met, is_sorted).map(move |slot| (slot, f32::from_bits(words[slot])))
    }
}

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
    fn enter<W: Width>(&self, w: W, node: &Node, reach: f32) -> (W::E, u32) {
        let (mut enter, mut exit) = (w.eight_like(0.0), w.eight_like(f32::INFINITY));
        for axis in &self.0 {
            let BeamAxis { near, near_origin, far_origin, least, greatest } = *axis;
            let to_near = w.eight(&node.sides[near % 6]) - w.eight_like(near_origin);
            let to_far = w.eight(&node.sides[(near ^ 1) % 6]) - w.eight_like(far_origin);
            let (least, greatest) = (w.eight_like(least), w.eight_like(greatest));
            enter = enter.max((to_near * least).min(to_near * greatest));
            exit = exit.min((to_far * least).max(to_far * greatest));
        }
        let exit = (exit * w.eight_like(WIDEN)).min(w.eight_like(reach));
        (enter, enter.le(exit))
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
