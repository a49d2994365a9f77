//! Rays by the thousand through the hierarchy.
//!
//! Rays that fly every which way do not stay together for long: of a packet, one or two are left in the lower half of the
//! hierarchy. Of a whole stream of rays there are still enough that fill vectors in every node. A node is visited once, with
//! a list of the rays that meet its box (Overbeck, Ramamoorthi, Mark 2008, Large ray packets for real-time Whitted ray
//! tracing, sec. 3.3, and Barringer, Akenine-Möller 2014, Dynamic ray stream traversal); where few are left, each goes on
//! alone.

use std::ops::Range;

use bytemuck::Zeroable;

use super::alone::{Lone, LonePart, Order, VisitAlone};
use super::packet::{cross, inverse_of};
use super::{Bvh, Node, WIDEN};
use crate::lanes::{Eight as _, MOST_LANES, Mask as _, Real as _, Width, Word as _};
use crate::ray::Rays;
use crate::vector::Vector;

/// The most rays of a stream.
pub(crate) const STREAM: usize = 16384;

/// Numbers of each ray.
pub(crate) type Row<T> = [T; STREAM];

/// What the search knows of the rays of a stream, in rows of four numbers.
#[derive(Debug, Zeroable)]
pub(crate) struct StreamRays {
    /// The origin, and the parameter beyond which nothing is wanted any more.
    origin: Row<[f32; 4]>,
    /// The inverse of the direction, and the word of the start.
    inverse: Row<[f32; 4]>,
    /// The direction, and the media.
    direction: Row<[f32; 4]>,
}

/// What is done with the leaves.
pub(crate) trait VisitStream {
    /// Whether the nearer leaves are better shown first.
    const NEAREST_FIRST: bool;

    fn rays(&self) -> &StreamRays;
    /// Asks for bodies that will probably be met soon.
    fn fetch(&self, bodies: Range<u32>);
    /// Meets the bodies of a leaf, whose box `count` rays meet: the first ones of `rays`, which holds [`MOST_LANES`] more.
    fn leaf(&mut self, bodies: Range<u32>, rays: &[u32], count: usize);
}

/// Parts of the hierarchy still to be visited: working memory.
#[derive(Debug, Default)]
pub(crate) struct StreamParts {
    parts: Vec<StreamPart>,
    /// The rays that meet the boxes of the parts, one part behind the other.
    rays: Vec<u32>,
    alone: Vec<LonePart>,
}

/// A part that some rays are to visit.
#[derive(Clone, Copy, Debug, Default)]
struct StreamPart {
    first: u32,
    count: u32,
    /// Where its rays stand, and how many.
    start: usize,
    len: usize,
}

impl StreamRays {
    /// Writes down rays from number `at` on.
    #[inline(always)]
    pub(crate) fn set<W: Width>(&mut self, w: W, at: usize, rays: &Rays<W>, media: W::W, reach: W::R) {
        let Rays { origin, direction, start } = *rays;
        let inverse = inverse_of(w, direction);
        w.store_fours([origin.x, origin.y, origin.z, reach], &mut self.origin[at..]);
        w.store_fours([inverse.x, inverse.y, inverse.z, W::R::of_word(start)], &mut self.inverse[at..]);
        w.store_fours(
            [direction.x, direction.y, direction.z, W::R::of_word(media)],
            &mut self.direction[at..],
        );
    }

    /// The rays from number `at` on, and their reach.
    #[inline(always)]
    pub(crate) fn load<W: Width>(&self, w: W, at: usize) -> (Rays<W>, W::R) {
        let [x, y, z, reach] = w.load_fours(&self.origin[at..]);
        let origin = Vector::new(x, y, z);
        let [.., start] = w.load_fours(&self.inverse[at..]);
        let [x, y, z, _] = w.load_fours(&self.direction[at..]);
        (Rays { origin, direction: Vector::new(x, y, z), start: start.to_word() }, reach)
    }

    /// These rays, their media and their reach.
    #[inline(always)]
    pub(crate) fn gather<W: Width>(&self, w: W, rays: &[u32]) -> (Rays<W>, W::W, W::R) {
        let [x, y, z, reach] = w.gather(&self.origin, rays);
        let origin = Vector::new(x, y, z);
        let [.., start] = w.gather(&self.inverse, rays);
        let [x, y, z, media] = w.gather(&self.direction, rays);
        (Rays { origin, direction: Vector::new(x, y, z), start: start.to_word() }, media.to_word(), reach)
    }

    /// How far a ray reaches.
    #[inline(always)]
    pub(crate) fn reach(&self, ray: u32) -> f32 {
        self.origin[ray as usize % STREAM][3]
    }

    /// Nothing beyond `reach` is wanted any more of a ray.
    #[inline(always)]
    pub(crate) fn shorten(&mut self, ray: u32, reach: f32) {
        let old = &mut self.origin[ray as usize % STREAM][3];
        *old = old.min(reach);
    }

    /// Nothing is wanted any more of the first `count` rays.
    pub(crate) fn block(&mut self, count: usize) {
        self.origin.iter_mut().take(count).for_each(|[.., reach]| *reach = f32::NEG_INFINITY);
    }

    #[inline(always)]
    fn alone<W: Width>(&self, w: W, ray: u32) -> Lone<W> {
        let of = |row: &Row<[f32; 4]>| {
            let [x, y, z, _] = row[ray as usize % STREAM];
            [x, y, z]
        };
        Lone::new(w, of(&self.origin), of(&self.inverse))
    }
}

/// Vectors that stand in a row from number `at` on; the fourth numbers are left out.
#[inline(always)]
pub(crate) fn vector_at<W: Width>(w: W, row: &Row<[f32; 4]>, at: usize) -> Vector<W::R> {
    let [x, y, z, _] = w.load_fours(&row[at..]);
    Vector::new(x, y, z)
}

impl StreamParts {
    /// The rays that are to be traversed next: so many of the first places are taken.
    #[inline(always)]
    pub(crate) fn begin(&mut self) -> &mut [u32] {
        if self.rays.len() < STREAM + MOST_LANES {
            self.rays.resize(STREAM + MOST_LANES, 0);
            self.alone.resize(8 * super::MAX_DEPTH, LonePart::default());
        }
        &mut self.rays
    }
}

impl Bvh {
    /// Up to so many rays go on alone.
    const FEW_OF_STREAM: usize = 3;

    /// Shows `visitor` the bodies of the leaves whose boxes the first `count` rays of [`StreamParts::begin`] meet.
    #[inline(always)]
    pub(crate) fn traverse_stream<W: Width, V: VisitStream>(
        &self,
        w: W,
        pending: &mut StreamParts,
        count: usize,
        visitor: &mut V,
    ) {
        let StreamParts { parts, rays, alone } = pending;
        parts.clear();
        parts.push(StreamPart { first: 0, count: 0, start: 0, len: count });
        while let Some(part) = parts.pop() {
            let StreamPart { first, count, start, len } = part;
            if count > 0 {
                visitor.leaf(first..first + count, &rays[start..], len);
                continue;
            }
            if len <= Self::FEW_OF_STREAM {
                for &number in &rays[start..start + len] {
                    let mut ray = [0; MOST_LANES + 1];
                    ray[0] = number;
                    let lone = visitor.rays().alone(w, ray[0]);
                    self.traverse_alone(
                        w,
                        &lone,
                        first,
                        alone,
                        &mut OneOfStream { ray, visitor: &mut *visitor },
                    );
                }
                continue;
            }
            let node = &self.nodes[first as usize];
            let order = if V::NEAREST_FIRST {
                // The first ray stands for all.
                let (enter, _) = visitor.rays().alone(w, rays[start]).enter(w, node);
                Order::new(&enter.to_words(), node.used(w), true)
            } else {
                Order::new(&[0; 8], node.used(w), false)
            };
            // Behind each list there is room for as many as are written at once.
            let room = len + MOST_LANES;
            let end = start + room;
            if rays.len() < end + 8 * room {
                grow(rays, end + 8 * room);
            }
            let (own, lists) = rays.split_at_mut(end);
            let (slots, used) = order.slots();
            let slots = &slots[..used];
            let lens = sort(w, visitor.rays(), (node, slots), (&own[start..], len), (lists, room));
            for ((&slot, &len), start) in slots.iter().zip(&lens).zip((end..).step_by(room)) {
                if len > 0 {
                    let (first, count) = (node.first[slot], node.count[slot]);
                    visitor.fetch(self.fetch(first, count));
                    parts.push(StreamPart { first, count, start, len });
                }
            }
        }
    }
}

/// Writes the first `len` of `numbers` to the lists of those boxes that these rays meet, each of which has `room`. How many
/// each list has.
#[inline(always)]
fn sort<W: Width>(
    w: W,
    rays: &StreamRays,
    (node, slots): (&Node, &[usize]),
    (numbers, len): (&[u32], usize),
    (lists, room): (&mut [u32], usize),
) -> [usize; 8] {
    let mut lens = [0; 8];
    for at in (0..len).step_by(W::LANES) {
        let numbers = &numbers[at..];
        let lanes = w.first(len - at);
        let [x, y, z, reach] = w.gather(&rays.origin, numbers);
        let origin = Vector::new(x, y, z);
        let [x, y, z, _] = w.gather(&rays.inverse, numbers);
        let inverse = Vector::new(x, y, z);
        let words = w.load_words(numbers);
        for ((&slot, len), start) in slots.iter().zip(&mut lens).zip((0..).step_by(room)) {
            let met = lanes & meets(w, node, slot, (origin, inverse), reach);
            words.compress(met).store(&mut lists[start + *len..]);
            *len += met.bits().count_ones() as usize;
        }
    }
    lens
}

#[cold]
fn grow(rays: &mut Vec<u32>, len: usize) {
    rays.resize(len.next_power_of_two(), 0);
}

/// The rays that meet a box before `reach`.
#[inline(always)]
fn meets<W: Width>(
    w: W,
    node: &Node,
    slot: usize,
    (origin, inverse): (Vector<W::R>, Vector<W::R>),
    reach: W::R,
) -> W::M {
    let x = cross(w, node, (0, slot), origin.x, inverse.x);
    let y = cross(w, node, (1, slot), origin.y, inverse.y);
    let z = cross(w, node, (2, slot), origin.z, inverse.z);
    let enter = x.0.max(y.0).max(z.0).max(w.real(0.0));
    let exit = x.1.min(y.1).min(z.1);
    enter.le((exit * WIDEN).min(reach))
}

/// One ray of a stream on its own way.
struct OneOfStream<'v, V> {
    ray: [u32; MOST_LANES + 1],
    visitor: &'v mut V,
}

impl<V: VisitStream> VisitAlone for OneOfStream<'_, V> {
    const NEAREST_FIRST: bool = V::NEAREST_FIRST;

    #[inline(always)]
    fn reach(&self) -> f32 {
        self.visitor.rays().reach(self.ray[0])
    }

    #[inline(always)]
    fn fetch(&self, bodies: Range<u32>) {
        self.visitor.fetch(bodies);
    }

    #[inline(always)]
    fn leaf(&mut self, bodies: Range<u32>) {
        self.visitor.leaf(bodies, &self.ray, 1);
    }
}
