//! Rays by the thousand through the hierarchy.
//!
//! Rays that fly every which way do not stay together for long: of a packet, one or two are left in the lower half of the
//! hierarchy. Of a whole stream of rays there are still enough that fill vectors in every node. A node is visited once, with
//! a list of the rays that meet its box (Overbeck, Ramamoorthi, Mark 2008, Large ray packets for real-time Whitted ray
//! tracing, sec. 3.3, and Barringer, Akenine-Möller 2014, Dynamic ray stream traversal); where few are left, each goes on
//! alone.
//!
//! Among very many bodies only rays that run the same way along each axis are taken together. Wherever they start, of two
//! boxes apart all of them reach the same one first, so that one order is good for all, and all enter a box by the same
//! three sides. Among fewer it is better to have more rays in each leaf.

use std::ops::Range;

use bytemuck::Zeroable;

use crate::geometry::bounds::Bounds;
use crate::geometry::bvh::alone::{BoxOrder, SingleRay, SingleRayStackEntry};
use crate::geometry::bvh::packet::inverse_of;
use crate::geometry::bvh::{Bvh, BvhNode, LeafVisitor, WIDEN};
use crate::geometry::ray::RayPacket;
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float8 as _, Float32 as _, MOST_LANES, Mask as _, Width, Word as _};

/// The most rays of a stream.
pub(crate) const STREAM: usize = 16384;

/// Numbers of each ray.
pub(crate) type StreamRow<T> = [T; STREAM];

/// What the search knows of the rays of a stream, in rows of four numbers.
#[derive(Debug, Zeroable)]
pub(crate) struct StreamRayRows {
    /// The origin, and the parameter beyond which nothing is wanted any more.
    origin: StreamRow<[f32; 4]>,
    /// The inverse of the direction, and the word of the start.
    inverse: StreamRow<[f32; 4]>,
    /// The direction, and the media.
    direction: StreamRow<[f32; 4]>,
}

/// What is done with the leaves that the rays of a stream meet.
pub(crate) trait StreamLeafVisitor {
    /// Whether leaves are shown from the rays' starts on: the nearest body ends the search. Else from their ends: rays to a
    /// light come together there, and one body hides it from many.
    const NEAREST_FIRST: bool;

    fn rays(&self) -> &StreamRayRows;
    /// Asks for bodies that will probably be met soon.
    fn fetch(&self, bodies: Range<u32>);
    /// Meets the bodies of a leaf, whose box `count` rays meet: the first ones of `rays`, which holds [`MOST_LANES`] more.
    fn leaf(&mut self, bodies: Range<u32>, rays: &[u32], count: usize);
}

/// Parts of the hierarchy still to be visited: working memory.
#[derive(Debug, Default)]
pub(crate) struct StreamTraversalStack {
    parts: Vec<StreamStackEntry>,
    /// The rays that meet the boxes of the parts, one part behind the other.
    rays: Vec<u32>,
    alone: Vec<SingleRayStackEntry>,
}

/// A part that some rays are to visit.
#[derive(Clone, Copy, Debug, Default)]
struct StreamStackEntry {
    first: u32,
    count: u32,
    /// Where its rays stand, and how many.
    start: usize,
    len: usize,
    /// From where on no list is needed any more.
    free: usize,
}

impl StreamRayRows {
    /// Writes down rays from number `at` on.
    #[inline(always)]
    pub(crate) fn set<W: Width>(&mut self, w: W, at: usize, rays: &RayPacket<W>, media: W::W, t_max: W::R) {
        let RayPacket { origin, direction, start } = *rays;
        let inverse = inverse_of(w, direction);
        w.store_fours([origin.x, origin.y, origin.z, t_max], &mut self.origin[at..]);
        w.store_fours([inverse.x, inverse.y, inverse.z, W::R::of_word(start)], &mut self.inverse[at..]);
        w.store_fours(
            [direction.x, direction.y, direction.z, W::R::of_word(media)],
            &mut self.direction[at..],
        );
    }

    /// The rays from number `at` on, and their reach.
    #[inline(always)]
    pub(crate) fn load<W: Width>(&self, w: W, at: usize) -> (RayPacket<W>, W::R) {
        let [x, y, z, t_max] = w.load_fours(&self.origin[at..]);
        let origin = Vector::new(x, y, z);
        let [.., start] = w.load_fours(&self.inverse[at..]);
        let [x, y, z, _] = w.load_fours(&self.direction[at..]);
        (RayPacket { origin, direction: Vector::new(x, y, z), start: start.to_word() }, t_max)
    }

    /// The media of the rays from number `at` on.
    #[inline(always)]
    pub(crate) fn media<W: Width>(&self, w: W, at: usize) -> W::W {
        let [.., media] = w.load_fours(&self.direction[at..]);
        media.to_word()
    }

    /// These rays, their media and their reach.
    #[inline(always)]
    pub(crate) fn gather<W: Width>(&self, w: W, rays: &[u32]) -> (RayPacket<W>, W::W, W::R) {
        let [x, y, z, t_max] = w.gather(&self.origin, rays);
        let origin = Vector::new(x, y, z);
        let [.., start] = w.gather(&self.inverse, rays);
        let [x, y, z, media] = w.gather(&self.direction, rays);
        (
            RayPacket { origin, direction: Vector::new(x, y, z), start: start.to_word() },
            media.to_word(),
            t_max,
        )
    }

    /// How far a ray reaches.
    #[inline(always)]
    pub(crate) fn t_max(&self, ray: u32) -> f32 {
        self.origin[ray as usize % STREAM][3]
    }

    /// Nothing beyond `t_max` is wanted any more of a ray.
    #[inline(always)]
    pub(crate) fn shorten(&mut self, ray: u32, t_max: f32) {
        let old = &mut self.origin[ray as usize % STREAM][3];
        *old = old.min(t_max);
    }

    /// Writes the numbers of the first `count` rays of which anything is wanted to lists, each of which has `room`: one for
    /// each [octant](Octant) if they are to be taken apart, or else one for all. How many each list has.
    #[inline(always)]
    fn part<W: Width>(
        &self,
        w: W,
        count: usize,
        is_apart: bool,
        (lists, room): (&mut [u32], usize),
    ) -> [usize; 8] {
        let mut lens = [0; 8];
        let mut numbers = [0; MOST_LANES];
        numbers.iter_mut().zip(0..).for_each(|(number, at)| *number = at);
        let numbers = w.load_words(&numbers);
        let (told_apart, used) = if is_apart { (7, 8) } else { (0, 1) };
        for at in (0..count).step_by(W::LANES) {
            let [.., t_max] = w.load_fours(&self.origin[at..]);
            let lanes = w.first(count - at) & t_max.gt(w.real(f32::NEG_INFINITY));
            let [x, y, z, _] = w.load_fours(&self.inverse[at..]);
            let sign = |inverse: W::R, by: u32| inverse.to_word().shifted_right(31).shifted_left(by);
            let octants = sign(x, 0).or(sign(y, 1)).or(sign(z, 2)).and(told_apart);
            let numbers = numbers.plus(w.word(at as u32));
            for (octant, len) in lens.iter_mut().take(used).enumerate() {
                let these = octants.is(octant as u32) & lanes;
                numbers.store_some(these, &mut lists[octant * room + *len..]);
                *len += these.bits().count_ones() as usize;
            }
        }
        lens
    }

    /// The octant that a ray runs into.
    #[inline(always)]
    fn octant(&self, ray: u32) -> Octant {
        let [x, y, z, _] = self.inverse[ray as usize % STREAM];
        Octant([x, y, z].map(|inverse| inverse < 0.0))
    }

    /// Nothing is wanted any more of the first `count` rays.
    pub(crate) fn block(&mut self, count: usize) {
        self.origin.iter_mut().take(count).for_each(|[.., t_max]| *t_max = f32::NEG_INFINITY);
    }

    #[inline(always)]
    fn alone<W: Width>(&self, w: W, ray: u32) -> SingleRay<W> {
        let of = |row: &StreamRow<[f32; 4]>| {
            let [x, y, z, _] = row[ray as usize % STREAM];
            [x, y, z]
        };
        SingleRay::new(w, of(&self.origin), of(&self.inverse))
    }
}

/// Vectors that stand in a row from number `at` on; the fourth numbers are left out.
#[inline(always)]
pub(crate) fn vector_at<W: Width>(w: W, row: &StreamRow<[f32; 4]>, at: usize) -> Vector<W::R> {
    let [x, y, z, _] = w.load_fours(&row[at..]);
    Vector::new(x, y, z)
}

impl StreamTraversalStack {
    /// So many numbers of rays have been enough for a thousand bodies and for a million.
    const USUAL_ROOM: usize = 64 * STREAM;

    /// Makes room for so many numbers of rays, and for one that goes on alone.
    #[inline(always)]
    fn make_room(&mut self, len: usize) {
        if self.rays.len() < len {
            self.grow(len);
        }
    }

    #[cold]
    fn grow(&mut self, len: usize) {
        let len = len.next_power_of_two().max(Self::USUAL_ROOM);
        if self.rays.is_empty() {
            // The system gives memory when it is touched: what is not needed costs nothing, but growing does.
            self.rays = vec![0; len];
        } else {
            self.rays.resize(len, 0);
        }
        self.alone.resize(8 * crate::geometry::bvh::MAX_DEPTH, SingleRayStackEntry::default());
    }
}

/// Along which axes rays run backwards.
#[derive(Clone, Copy)]
struct Octant([bool; 3]);

impl Octant {
    /// That of a bit for each axis.
    fn of_bits(bits: usize) -> Self {
        Self([0, 1, 2].map(|axis| bits >> axis & 1 == 1))
    }

    /// That of rays that run the other way.
    fn opposite(self) -> Self {
        Self(self.0.map(|is_back| !is_back))
    }

    /// How far along the octant's diagonal a node's boxes begin, from where `all` begin.
    #[inline(always)]
    fn along<W: Width>(self, w: W, node: &BvhNode, all: &Bounds) -> W::E {
        let along = |axis: usize| {
            if self.0[axis] {
                w.eight_like(all.max[axis]) - w.eight(&node.sides[2 * axis + 1])
            } else {
                w.eight(&node.sides[2 * axis]) - w.eight_like(all.min[axis])
            }
        };
        along(0) + along(1) + along(2)
    }

    /// The sides of a node's boxes by which rays enter, then those by which they leave, across x, y and z.
    #[inline(always)]
    fn sides(self, node: &BvhNode) -> [[f32; 8]; 6] {
        let [x, y, z] = self.0.map(usize::from);
        let near = [x, 2 + y, 4 + z];
        let side = |at: usize| node.sides[if at < 3 { near[at] } else { near[at - 3] ^ 1 } % 6];
        [side(0), side(1), side(2), side(3), side(4), side(5)]
    }
}

impl Bvh {
    /// Up to so many rays go on alone.
    const FEW_OF_STREAM: usize = 3;

    /// Shows `visitor` the bodies of the leaves whose boxes its first `count` rays meet; those of different octants one after
    /// the other if they are to be taken apart.
    #[inline(always)]
    pub(crate) fn traverse_stream<W: Width, V: StreamLeafVisitor>(
        &self,
        w: W,
        pending: &mut StreamTraversalStack,
        count: usize,
        is_apart: bool,
        visitor: &mut V,
    ) {
        let room = count + MOST_LANES;
        pending.make_room(8 * room);
        let lens = visitor.rays().part(w, count, is_apart, (&mut pending.rays, room));
        for (octant, &len) in lens.iter().enumerate().filter(|(_, len)| **len > 0) {
            let all = StreamStackEntry { first: 0, count: 0, start: octant * room, len, free: 8 * room };
            self.traverse_list(w, pending, all, is_apart.then(|| Octant::of_bits(octant)), visitor);
        }
    }

    /// Shows `visitor` the leaves that a list of rays meets, perhaps all of one octant.
    #[inline(always)]
    fn traverse_list<W: Width, V: StreamLeafVisitor>(
        &self,
        w: W,
        pending: &mut StreamTraversalStack,
        all: StreamStackEntry,
        octant: Option<Octant>,
        visitor: &mut V,
    ) {
        let bounds = self.bounds();
        pending.parts.clear();
        pending.parts.push(all);
        while let Some(part) = pending.parts.pop() {
            let StreamStackEntry { first, count, start, len, free } = part;
            if count > 0 {
                visitor.leaf(first..first + count, &pending.rays[start..], len);
                continue;
            }
            if len <= Self::FEW_OF_STREAM {
                for &number in &pending.rays[start..start + len] {
                    let mut ray = [0; MOST_LANES + 1];
                    ray[0] = number;
                    let lone = visitor.rays().alone(w, ray[0]);
                    let alone = &mut StreamLane { ray, visitor: &mut *visitor };
                    self.traverse_alone(w, &lone, first, &mut pending.alone, alone);
                }
                continue;
            }
            let node = &self.nodes[first as usize];
            // Behind each list there is room for as many as are written at once.
            let room = len + MOST_LANES;
            let end = free + 8 * room;
            pending.make_room(end);
            let (own, lists) = pending.rays.split_at_mut(free);
            let own = &own[start..];
            let used = node.used(w);
            let lens = match octant {
                Some(octant) => {
                    let sides = octant.sides(node);
                    sort::<W, true>(w, visitor.rays(), (&sides, used), (own, len), (lists, room))
                }
                None => sort::<W, false>(w, visitor.rays(), (&node.sides, used), (own, len), (lists, room)),
            };
            // Where they run every which way, the first one stands for all.
            let octant = octant.unwrap_or_else(|| visitor.rays().octant(own[0]));
            let towards = if V::NEAREST_FIRST { octant } else { octant.opposite() };
            let met = lens.iter().zip(0..).fold(0, |met, (&len, slot)| met | u32::from(len > 0) << slot);
            for slot in BoxOrder::new(&towards.along(w, node, &bounds).to_words(), met & used, true) {
                let (first, count, start) = (node.first[slot], node.count[slot], free + slot * room);
                visitor.fetch(self.fetch(first, count));
                pending.parts.push(StreamStackEntry { first, count, start, len: lens[slot], free: end });
            }
        }
    }
}

/// Writes the first `len` of `numbers` to the lists of those of a node's boxes that these rays meet, each of which has
/// `room`. How many each list has; of boxes that are not `used`, anything. If all are of one octant, `sides` are those of it.
#[inline(always)]
fn sort<W: Width, const APART: bool>(
    w: W,
    rays: &StreamRayRows,
    (sides, used): (&[[f32; 8]; 6], u32),
    (numbers, len): (&[u32], usize),
    (lists, room): (&mut [u32], usize),
) -> [usize; 8] {
    let slots = (u32::BITS - used.leading_zeros()) as usize;
    let mut lens = [0; 8];
    for at in (0..len).step_by(W::LANES) {
        let numbers = &numbers[at..];
        let lanes = w.first(len - at);
        let [x, y, z, t_max] = w.gather(&rays.origin, numbers);
        let origin = Vector::new(x, y, z);
        let [x, y, z, _] = w.gather(&rays.inverse, numbers);
        let minus_inverse = -Vector::new(x, y, z);
        let words = w.load_words(numbers);
        for (slot, len) in lens.iter_mut().take(slots).enumerate() {
            let met = lanes & meets::<W, APART>(w, sides, slot, (origin, minus_inverse), t_max);
            words.store_some(met, &mut lists[slot * room + *len..]);
            *len += met.bits().count_ones() as usize;
        }
    }
    lens
}

/// The rays that meet a box before `t_max`; see [`PacketBoxTest::enter`](super::packet::PacketBoxTest::enter).
#[inline(always)]
fn meets<W: Width, const APART: bool>(
    w: W,
    sides: &[[f32; 8]; 6],
    slot: usize,
    (origin, minus_inverse): (Vector<W::R>, Vector<W::R>),
    t_max: W::R,
) -> W::M {
    let cross = |(one, other): (usize, usize), origin: W::R, minus_inverse: W::R| {
        let one = (origin - sides[one][slot]) * minus_inverse;
        let other = (origin - sides[other][slot]) * minus_inverse;
        if APART { (one, other) } else { (one.min(other), one.max(other)) }
    };
    let pairs = if APART { [(0, 3), (1, 4), (2, 5)] } else { [(0, 1), (2, 3), (4, 5)] };
    let x = cross(pairs[0], origin.x, minus_inverse.x);
    let y = cross(pairs[1], origin.y, minus_inverse.y);
    let z = cross(pairs[2], origin.z, minus_inverse.z);
    let enter = x.0.max(y.0).max(z.0).max(w.real(0.0));
    let exit = x.1.min(y.1).min(z.1);
    enter.le((exit * WIDEN).min(t_max))
}

/// One ray of a stream on its own way.
struct StreamLane<'v, V> {
    ray: [u32; MOST_LANES + 1],
    visitor: &'v mut V,
}

impl<V: StreamLeafVisitor> LeafVisitor<ScalarWidth> for StreamLane<'_, V> {
    const NEAREST_FIRST: bool = V::NEAREST_FIRST;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.visitor.rays().t_max(self.ray[0])
    }

    #[inline(always)]
    fn fetch(&self, bodies: Range<u32>) {
        self.visitor.fetch(bodies);
    }

    #[inline(always)]
    fn leaf(&mut self, bodies: Range<u32>, _is_met: bool) {
        self.visitor.leaf(bodies, &self.ray, 1);
    }
}
