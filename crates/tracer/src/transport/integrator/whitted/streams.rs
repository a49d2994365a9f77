//! Whitted's rays by the thousand.

use super::WhittedIntegrator;
use crate::geometry::bvh::stream::vector_at;
use crate::geometry::membership::{BodyMembership, MembershipSource as _};
use crate::geometry::query::RayQuery;
use crate::geometry::query::candidates::Candidates;
use crate::simd::vector::Vector;
use crate::simd::{Mask as _, Width};
use crate::transport::media::shadow_stream::ShadowStream;
use crate::transport::path::PathState;
use crate::transport::stream::StreamShading;

impl WhittedIntegrator<'_> {
    /// Looks for what the rays of a stream meet.
    pub(crate) fn search<W: Width>(&self, w: W, streams: &mut StreamShading) {
        streams.rays.search(w, &self.shading.scene.geometry, &self.shading.media, &mut streams.memory);
    }

    /// Looks for what their shadow rays meet.
    pub(crate) fn search_shadows<W: Width>(&self, w: W, streams: &mut StreamShading) {
        for shadows in streams.shadows.iter_mut().filter(|shadows| !shadows.is_empty()) {
            shadows.search(
                w,
                self.shading.scene,
                &self.shading.media,
                &mut streams.memory,
                &mut streams.intervals,
            );
        }
    }

    /// What the rays of a stream from number `at` on add to their pixels.
    #[inline(always)]
    pub(crate) fn gather<W: Width>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        streams: &StreamShading,
        at: usize,
    ) -> Vector<W::R> {
        let mut membership = std::mem::take(&mut self.shading.membership);
        self.shading.media.fill::<W>(&mut membership, paths.media, paths.lanes);
        let mut light = vector_at(w, &streams.light.own, at);
        for shadows in streams.shadows.iter().filter(|shadows| !shadows.is_empty()) {
            light = self.lit(w, shadows, at, light, paths.lanes, &membership);
        }
        self.shading.membership = membership;
        vector_at(w, &streams.light.weight, at).times(light)
    }

    #[inline(always)]
    fn lit<W: Width>(
        &self,
        w: W,
        shadows: &ShadowStream,
        at: usize,
        light: Vector<W::R>,
        lanes: W::M,
        membership: &BodyMembership,
    ) -> Vector<W::R> {
        let query = RayQuery::new(
            w,
            &self.shading.scene.geometry,
            &shadows.rays(w, at),
            lanes,
            membership,
            Candidates::All,
        );
        let (lit, more) = shadows.brought(w, at, self.shading.scene, &query);
        if lit.any() { Vector::select(lit, light + more, light).bounded() } else { light }
    }
}
