//! Rays side by side through the hierarchy.
//!
//! Rays that run the same way are first tested together as a beam against the eight boxes of a node at once, by interval
//! arithmetic (Boulos, Wald, Shirley 2006, Geometric and arithmetic culling methods for entire ray packets); the boxes that
//! are left are tested one by one against all rays at once. Where few rays are left of a packet, each goes on alone, and
//! is tested against eight boxes at once.

use std::ops::Range;

use crate::geometry::bvh::alone::{BoxOrder, SingleRay, SingleRayStackEntry};
use crate::geometry::bvh::{Bvh, BvhNode, LeafVisitor, WIDEN};
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float8 as _, Float32 as _, MOST_LANES, Mask as _, Width};

/// Parts of the hierarchy still to be visited: working memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct TraversalStack {
    /// By several rays.
    shared: Vec<PacketStackEntry>,
    /// By one.
    alone: Vec<SingleRayStackEntry>,
}

/// A part that several rays are to visit.
#[derive(Clone, Copy, Debug, Default)]
struct PacketStackEntry {
    first: u32,
    count: u32,
    /// A bit for each ray that meets its box.
    lanes: u32,
    /// Where each ray enters.
    enter: [f32; MOST_LANES],
}

impl TraversalStack {
    /// No path is longer than [`super::MAX_DEPTH`], and each node on it leaves at most seven parts behind.
    const MOST: usize = 8 * crate::geometry::bvh::MAX_DEPTH;

    /// Places for all parts, so that none has to be moved into place.
    #[inline(always)]
    fn ready(&mut self, is_shared: bool) -> (&mut [PacketStackEntry], &mut [SingleRayStackEntry]) {
        if self.alone.is_empty() {
            self.make(is_shared);
        }
        (&mut self.shared, &mut self.alone)
    }

    #[cold]
    fn make(&mut self, is_shared: bool) {
        self.alone.resize(Self::MOST, SingleRayStackEntry::default());
        if is_shared {
            self.shared.resize(Self::MOST, PacketStackEntry::default());
        }
    }
}

/// Rays prepared for box tests.
pub(crate) struct PacketBoxTest<W: Width> {
    origin: Vector<W::R>,
    inverse: Vector<W::R>,
    lanes: W::M,
    /// `origin` and `inverse` as numbers, to take single rays from.
    origins: [[f32; MOST_LANES]; 3],
    inverses: [[f32; MOST_LANES]; 3],
    /// All of them together, if they run the same way along each axis.
    beam: Option<PacketInterval>,
}

/// Between which numbers the rays of a packet lie, for each axis.
struct PacketInterval([PacketIntervalAxis; 3]);

#[derive(Clone, Copy)]
struct PacketIntervalAxis {
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
    ) -> PacketBoxTest<W> {
        let inverse = inverse_of(w, direction);
        let (mut origins, mut inverses) = ([[0.0; MOST_LANES]; 3], [[0.0; MOST_LANES]; 3]);
        store(origin, &mut origins);
        store(inverse, &mut inverses);
        PacketBoxTest {
            origin,
            inverse,
            lanes,
            origins,
            inverses,
            beam: PacketInterval::of(w, origin, inverse, lanes),
        }
    }

    /// Shows `visitor` the bodies of the leaves whose boxes some of the rays meet, mostly the nearer ones first.
    #[inline(always)]
    pub(crate) fn traverse_packet<W: Width, V: LeafVisitor<W>>(
        &self,
        w: W,
        boxes: &PacketBoxTest<W>,
        pending: &mut TraversalStack,
        visitor: &mut V,
    ) {
        let (shared, alone) = pending.ready(W::LANES > Self::FEW_RAYS as usize);
        let (mut index, mut lanes) = (0, boxes.lanes);
        let mut waiting = 0;
        let mut farthest = boxes.farthest(w, visitor.t_max());
        loop {
            let mut bits = lanes.bits();
            if bits.count_ones() <= Self::FEW_RAYS {
                while bits != 0 {
                    let lane = bits.trailing_zeros() as usize % MOST_LANES;
                    bits &= bits - 1;
                    let mut alone_visits = PacketLane { w, lane, visitor: &mut *visitor };
                    self.traverse_alone(w, &boxes.alone(w, lane), index, alone, &mut alone_visits);
                }
                farthest = boxes.farthest(w, visitor.t_max());
            } else {
                let node = &self.nodes[index as usize];
                let order = boxes.order(w, node, bits, farthest, V::NEAREST_FIRST);
                let t_max = visitor.t_max();
                for slot in order {
                    let (enter, met) = boxes.enter(w, node, slot, t_max);
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
                let alive = w.mask(part.lanes) & w.load(&part.enter).le(visitor.t_max());
                if !alive.any() {
                    continue;
                }
                if part.count == 0 {
                    (index, lanes) = (part.first, alive);
                    break;
                }
                visitor.leaf(part.first..part.first + part.count, alive);
                farthest = boxes.farthest(w, visitor.t_max());
            }
        }
    }
}

/// One ray of a packet on its own way.
struct PacketLane<'v, W, V> {
    w: W,
    lane: usize,
    visitor: &'v mut V,
}

impl<W: Width, V: LeafVisitor<W>> LeafVisitor<ScalarWidth> for PacketLane<'_, W, V> {
    const NEAREST_FIRST: bool = V::NEAREST_FIRST;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        let mut all = [0.0; MOST_LANES];
        self.visitor.t_max().store(&mut all);
        all[self.lane]
    }

    #[inline(always)]
    fn leaf(&mut self, bodies: Range<u32>, _is_met: bool) {
        self.visitor.leaf(bodies, self.w.mask(1 << self.lane));
    }
}

#[inline(always)]
fn store<R: crate::simd::Float32>(vector: Vector<R>, to: &mut [[f32; MOST_LANES]; 3]) {
    let [x, y, z] = to;
    vector.x.store(x);
    vector.y.store(y);
    vector.z.store(z);
}

impl<W: Width> PacketBoxTest<W> {
    /// How far any of the rays reaches.
    #[inline(always)]
    fn farthest(&self, w: W, t_max: W::R) -> f32 {
        match &self.beam {
            Some(_) => W::R::select(self.lanes, t_max, w.real(0.0)).greatest(),
            None => f32::INFINITY,
        }
    }

    /// The boxes that may be met by some of the rays of `lanes`.
    #[inline(always)]
    fn order(&self, w: W, node: &BvhNode, lanes: u32, farthest: f32, is_sorted: bool) -> BoxOrder {
        let (enter, left) = match &self.beam {
            Some(beam) => beam.enter(w, node, farthest),
            None if is_sorted => {
                // The first ray stands for all.
                let lane = lanes.trailing_zeros() as usize % MOST_LANES;
                (self.alone(w, lane).enter(w, node).0, node.used(w))
            }
            None => (w.eight_like(0.0), node.used(w)),
        };
        BoxOrder::new(&enter.to_words(), left, is_sorted)
    }

    /// One of the rays.
    #[inline(always)]
    fn alone(&self, w: W, lane: usize) -> SingleRay<W> {
        SingleRay::new(w, self.origins.map(|axis| axis[lane]), self.inverses.map(|axis| axis[lane]))
    }

    /// The parameters at which the rays enter a box, at least 0, and those which meet it before `t_max`. The far sides
    /// are moved outwards by the rounding of the three operations (Ize 2013, Robust BVH ray traversal, eq. 3).
    #[inline(always)]
    fn enter(&self, w: W, node: &BvhNode, slot: usize, t_max: W::R) -> (W::R, W::M) {
        let x = self.along(w, 0, node, slot, self.origin.x, self.inverse.x);
        let y = self.along(w, 1, node, slot, self.origin.y, self.inverse.y);
        let z = self.along(w, 2, node, slot, self.origin.z, self.inverse.z);
        let enter = x.0.max(y.0).max(z.0).max(w.real(0.0));
        let exit = x.1.min(y.1).min(z.1);
        (enter, enter.le((exit * WIDEN).min(t_max)))
    }

    /// Where the rays cross the two sides across one axis.
    #[inline(always)]
    fn along(
        &self,
        w: W,
        axis: usize,
        node: &BvhNode,
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
        cross(w, node, (axis, slot), origin, inverse)
    }
}

/// The inverses of the components of directions, none of them infinite.
#[inline(always)]
pub(crate) fn inverse_of<W: Width>(w: W, direction: Vector<W::R>) -> Vector<W::R> {
    let (one, tiny) = (w.real(1.0), w.real(crate::geometry::bvh::TINY));
    direction.map(
        #[inline(always)]
        |part: W::R| one / W::R::select(part.abs().lt(tiny), tiny.copysign(part), part),
    )
}

/// Where rays cross the two sides of a box across one axis, the nearer first.
#[inline(always)]
fn cross<W: Width>(
    w: W,
    node: &BvhNode,
    (axis, slot): (usize, usize),
    origin: W::R,
    inverse: W::R,
) -> (W::R, W::R) {
    let at_low = (w.real(node.sides[2 * axis][slot]) - origin) * inverse;
    let at_high = (w.real(node.sides[2 * axis + 1][slot]) - origin) * inverse;
    (at_low.min(at_high), at_low.max(at_high))
}

impl PacketInterval {
    #[inline(always)]
    fn of<W: Width>(w: W, origin: Vector<W::R>, inverse: Vector<W::R>, lanes: W::M) -> Option<Self> {
        Some(Self([
            PacketIntervalAxis::of(w, 0, origin.x, inverse.x, lanes)?,
            PacketIntervalAxis::of(w, 1, origin.y, inverse.y, lanes)?,
            PacketIntervalAxis::of(w, 2, origin.z, inverse.z, lanes)?,
        ]))
    }

    /// Bounds from below for where the rays enter the boxes of a node, and a bit for each box that any may meet before
    /// `t_max`. Rounding is monotonic: what holds for the ends of an interval holds for the rays in it.
    #[inline(always)]
    fn enter<W: Width>(&self, w: W, node: &BvhNode, t_max: f32) -> (W::E, u32) {
        let (mut enter, mut exit) = (w.eight_like(0.0), w.eight_like(f32::INFINITY));
        for axis in &self.0 {
            let PacketIntervalAxis { near, near_origin, far_origin, least, greatest } = *axis;
            let to_near = w.eight(&node.sides[near % 6]) - w.eight_like(near_origin);
            let to_far = w.eight(&node.sides[(near ^ 1) % 6]) - w.eight_like(far_origin);
            let (least, greatest) = (w.eight_like(least), w.eight_like(greatest));
            enter = enter.max((to_near * least).min(to_near * greatest));
            exit = exit.min((to_far * least).max(to_far * greatest));
        }
        let exit = (exit * w.eight_like(WIDEN)).min(w.eight_like(t_max));
        (enter, enter.le(exit))
    }
}

impl PacketIntervalAxis {
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
