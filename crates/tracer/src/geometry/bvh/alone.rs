//! One ray through the hierarchy, against eight boxes at once.

use crate::geometry::bvh::{Bvh, BvhNode, LeafVisitor};
use crate::simd::scalar::ScalarWidth;
use crate::simd::{Float8 as _, Width};

/// A part of the hierarchy that a ray is still to visit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SingleRayStackEntry {
    first: u32,
    count: u32,
    /// Where it enters.
    enter: f32,
}

/// A ray, for each axis.
pub(crate) struct SingleRay<W: Width>([SingleRayAxis<W>; 3]);

struct SingleRayAxis<W: Width> {
    /// The side of a node's boxes that it meets first.
    near: usize,
    origin: W::E,
    inverse: W::E,
}

impl Bvh {
    /// Shows `visitor` the leaves below a node that a ray meets, mostly the nearer ones first.
    #[inline(always)]
    pub(crate) fn traverse_alone<W: Width, V: LeafVisitor<ScalarWidth>>(
        &self,
        w: W,
        ray: &SingleRay<W>,
        index: u32,
        parts: &mut [SingleRayStackEntry],
        visitor: &mut V,
    ) {
        let mut t_max = visitor.t_max();
        let mut index = index;
        let mut waiting = 0;
        loop {
            let node = &self.nodes[index as usize];
            for (slot, enter) in ray.met(w, node, t_max, V::NEAREST_FIRST) {
                let (first, count) = (node.first[slot], node.count[slot]);
                visitor.fetch(self.fetch(first, count));
                parts[waiting] = SingleRayStackEntry { first, count, enter };
                waiting += 1;
            }
            loop {
                if waiting == 0 {
                    return;
                }
                waiting -= 1;
                let SingleRayStackEntry { first, count, enter } = parts[waiting];
                if enter > t_max {
                    continue;
                }
                if count == 0 {
                    index = first;
                    break;
                }
                visitor.leaf(first..first + count, true);
                t_max = visitor.t_max();
            }
        }
    }
}

impl<W: Width> SingleRay<W> {
    #[inline(always)]
    pub(crate) fn new(w: W, origin: [f32; 3], inverse: [f32; 3]) -> Self {
        let axis = |axis: usize| SingleRayAxis {
            near: 2 * axis + usize::from(inverse[axis] < 0.0),
            origin: w.eight_like(origin[axis]),
            inverse: w.eight_like(inverse[axis]),
        };
        Self([axis(0), axis(1), axis(2)])
    }

    /// Where the ray enters the boxes of a node, at least 0, and leaves them; see [`PacketBoxTest::enter`].
    ///
    /// [`PacketBoxTest::enter`]: super::packet::PacketBoxTest::enter
    #[inline(always)]
    pub(crate) fn enter(&self, w: W, node: &BvhNode) -> (W::E, W::E) {
        let [x, y, z] = &self.0;
        let to_near = |a: &SingleRayAxis<W>| (w.eight(&node.sides[a.near % 6]) - a.origin) * a.inverse;
        let to_far = |a: &SingleRayAxis<W>| (w.eight(&node.sides[(a.near ^ 1) % 6]) - a.origin) * a.inverse;
        let enter = to_near(x).max(to_near(y)).max(to_near(z)).max(w.eight_like(0.0));
        let exit = to_far(x).min(to_far(y)).min(to_far(z));
        (enter, exit * w.eight_like(crate::geometry::bvh::WIDEN))
    }

    /// The boxes that it meets before `t_max` and where it enters them, see [`BoxOrder::new`].
    #[inline(always)]
    fn met(&self, w: W, node: &BvhNode, t_max: f32, is_sorted: bool) -> impl Iterator<Item = (usize, f32)> {
        let (enter, exit) = self.enter(w, node);
        let met = enter.le(exit.min(w.eight_like(t_max)));
        let words = enter.to_words();
        BoxOrder::new(&words, met, is_sorted).map(move |slot| (slot, f32::from_bits(words[slot])))
    }
}

/// Boxes of a node, perhaps the farthest first.
pub(crate) struct BoxOrder {
    /// Where each is entered, as bits of a number of at least 0, with the number of the box in the lowest bits.
    keys: [u32; 8],
    at: usize,
    len: usize,
}

impl BoxOrder {
    /// Those of `left`; where they are entered are numbers of at least 0. In any order unless `is_sorted`.
    #[inline(always)]
    pub(crate) fn new(enter: &[u32; 8], left: u32, is_sorted: bool) -> Self {
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

impl Iterator for BoxOrder {
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
