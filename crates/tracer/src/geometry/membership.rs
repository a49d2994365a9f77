//! Which bodies the rays of a packet are inside of.

use crate::simd::Width;

/// Which rays of a packet are inside of which bodies.
#[derive(Debug, Default)]
pub(crate) struct BodyMembership {
    /// Bodies, sorted, and a bit for each ray.
    bodies: Vec<(u32, u32)>,
}

/// What knows the bodies that rays are inside of, by a word that each ray carries.
pub(crate) trait MembershipSource {
    /// Writes down the bodies of the rays `lanes`.
    fn fill<W: Width>(&self, membership: &mut BodyMembership, words: W::W, lanes: W::M);
}

impl BodyMembership {
    /// Whether no ray is inside of any body.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.bodies.clear();
    }

    /// Adds a body, with a bit for each ray that is inside of it.
    pub(crate) fn add(&mut self, body: u32, rays: u32) {
        match self.bodies.binary_search_by_key(&body, |entry| entry.0) {
            Ok(place) => self.bodies[place].1 |= rays,
            Err(place) => self.bodies.insert(place, (body, rays)),
        }
    }

    /// The bodies that one of the rays is inside of, as those of a packet of this ray alone.
    pub(crate) fn of_lane(&self, lane: usize) -> Self {
        let of_lane = |&(body, rays): &(u32, u32)| (rays >> lane & 1 == 1).then_some((body, 1));
        Self { bodies: self.bodies.iter().filter_map(of_lane).collect() }
    }

    /// A bit for each ray that is inside of `body`.
    #[inline(always)]
    pub(crate) fn of(&self, body: u32) -> u32 {
        self.bodies.binary_search_by_key(&body, |entry| entry.0).map_or(0, |place| self.bodies[place].1)
    }
}
