//! Cemented contacts: where a ray leaves one body and enters another, with nothing between them, there is one interface.

use rayon::prelude::*;

use crate::geometry::Geometry;
use crate::geometry::body::RenderBody;
use crate::geometry::bvh::packet::TraversalStack;
use crate::geometry::query::closest::ClosestHits;
use crate::geometry::query::coincident::SurfaceCrossing;
use crate::geometry::query::{PacketHits, RayQuery};
use crate::geometry::ray::{INWARDS, NO_START};
use crate::simd::scalar::ScalarWidth;

impl Geometry {
    /// Whether nothing lies between two bodies, or the wholes that they are parts of, where they touch.
    pub(crate) fn are_cemented(&self, one: u32, other: u32) -> bool {
        let [one, other] = [one, other].map(|index| self.joined.whole_of(index, false).body);
        one != other && self.body(one).is_cemented_to(self.body(other))
    }

    /// Whether some bodies are cemented to what they touch, and light passes any.
    pub(crate) fn has_cemented(bodies: &[RenderBody]) -> bool {
        let any = |test: fn(&RenderBody) -> bool| bodies.par_iter().any(test);
        any(RenderBody::cements) && any(RenderBody::is_transparent)
    }
}

impl RayQuery<'_, ScalarWidth> {
    /// The first hit of the ray if it is a cemented contact: it leaves a clear body, and what it enters there within rounding
    /// is cemented to that. Of several bodies that it enters, the first in the scene counts.
    ///
    /// What is opaque is met as if the clear body went on. Of two clear bodies the surface is that of the first in the scene;
    /// [`PacketHits::contact`] names the other one.
    pub(crate) fn cemented_hit(
        &self,
        best: &ClosestHits<ScalarWidth>,
        stack: &mut TraversalStack,
    ) -> Option<PacketHits<ScalarWidth>> {
        let left = SurfaceCrossing::of(&best.leaving, true)?;
        let whole = self.geometry.joined.whole_of(left.body, true).body;
        if !self.geometry.body(left.body).is_transparent() || self.membership.of(whole) & 1 == 0 {
            return None;
        }
        let own_cosine = self.cosine(&left);
        let touches = |other: &SurfaceCrossing| {
            self.geometry.are_cemented(left.body, other.body)
                && self.leads_on(other)
                && self.coincide((&left, own_cosine), other)
        };
        // By more than rounding along the ray another body may come before, and yet touch this one across the surfaces.
        let first = SurfaceCrossing::of(&best.entering, false);
        let comes_first = best.first(ScalarWidth, self.geometry, false);
        if comes_first.body != left.body && !first.is_some_and(|first| touches(&first)) {
            return None;
        }
        let others = self.crossings_near(left.t, stack).into_iter().filter(touches);
        let other = others.min_by(|one, other| self.geometry.scene_order(one.body, other.body))?;
        let is_clear = self.geometry.body(other.body).is_transparent();
        let is_other = !is_clear || self.geometry.scene_order(other.body, left.body).is_lt();
        let (surface, beyond) = if is_other { (other, left) } else { (left, other) };
        let contact = if is_clear { self.start_word(&beyond) } else { NO_START };
        let SurfaceCrossing { t, face, body, .. } = surface;
        let leaving = self.start_word(&surface) & INWARDS != 0;
        Some(PacketHits { t, body, leaving, face, hit: true, contested: false, contact })
    }

    /// Whether a ray that comes out of a clear body meets something there: a body that it enters, or a surface, which is
    /// opaque if it is cemented.
    fn leads_on(&self, crossing: &SurfaceCrossing) -> bool {
        let whole = self.geometry.joined.whole_of(crossing.body, false).body;
        !crossing.leaving || self.geometry.is_surface(whole)
    }

    /// The word of a ray that is reflected at a crossing.
    fn start_word(&self, crossing: &SurfaceCrossing) -> u32 {
        // Of what is cut away, leaving is entering.
        let leaving = self.geometry.joined.turned(ScalarWidth, crossing.body, crossing.leaving);
        crossing.body | if leaving { INWARDS } else { 0 }
    }
}
