//! Rays of the tree by the thousand: all are searched for together, then shaded side by side, then all their shadow rays are
//! searched for together.

use bytemuck::{Zeroable, zeroed_box};

use super::{PathState, RayQueue, WhittedIntegrator};
use crate::geometry::Accelerator;
use crate::lanes::{Mask as _, Width};
use crate::membership::{BodyMembership, MembershipSource as _};
use crate::ray::RayPacket;
use crate::search::{Candidates, MediumIntervals, RayQuery, RayStream, ShadowStream, StreamScratch};
use crate::stage::{RenderScene, STREAM, StreamRow, vector_at};
use crate::vector::Vector;

/// A stream of rays with the light that they bring: working memory.
#[derive(Debug)]
pub(crate) struct StreamShading {
    pub(super) rays: Box<RayStream>,
    light: Box<StreamRadiance>,
    /// By light.
    shadows: Vec<Box<ShadowStream>>,
    memory: StreamScratch,
    intervals: MediumIntervals,
}

/// What the rays of a stream bring.
#[derive(Debug, Zeroable)]
struct StreamRadiance {
    /// The light that each brings without that of the lights.
    own: StreamRow<[f32; 4]>,
    /// What it counts for its pixel.
    weight: StreamRow<[f32; 4]>,
}

impl Default for StreamShading {
    fn default() -> Self {
        Self {
            rays: zeroed_box(),
            light: zeroed_box(),
            shadows: Vec::new(),
            memory: StreamScratch::default(),
            intervals: MediumIntervals::default(),
        }
    }
}

impl StreamShading {
    /// Makes a stream of the first rays of a queue. Their number.
    #[inline(always)]
    pub(crate) fn begin<W: Width>(&mut self, w: W, queue: &RayQueue) -> usize {
        self.rays.begin();
        let count = queue.len().min(STREAM);
        self.shadows.iter_mut().for_each(|shadows| shadows.begin(count));
        for at in (0..count).step_by(W::LANES) {
            let paths = queue.look(w, at);
            self.rays.push(w, &paths.rays, paths.media, paths.lanes);
        }
        count
    }

    /// Keeps light until that of the lights is known.
    #[inline(always)]
    pub(super) fn keep<W: Width>(&mut self, w: W, at: usize, light: Vector<W::R>, weight: Vector<W::R>) {
        let zero = w.real(0.0);
        w.store_fours([light.x, light.y, light.z, zero], &mut self.light.own[at..]);
        w.store_fours([weight.x, weight.y, weight.z, zero], &mut self.light.weight[at..]);
    }

    /// Takes note of shadow rays to a light.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "each is a vector of its own")]
    pub(super) fn ask<W: Width>(
        &mut self,
        w: W,
        light: usize,
        at: usize,
        rays: &RayPacket<W>,
        to: (W::W, W::R),
        answer: Vector<W::R>,
        lanes: W::M,
    ) {
        if self.shadows.len() <= light {
            let count = self.rays.len();
            self.shadows.resize_with(light + 1, || ShadowStream::of(count));
        }
        self.shadows[light].put(w, at, rays, to, answer, lanes);
    }
}

impl RenderScene {
    /// A stream keeps 1.3 MB for each light; with more lights than these all rays go by packets.
    const MOST_LIGHTS: usize = 16;

    /// Whether rays that do not come from the eye are better traced by streams.
    pub(crate) fn goes_by_streams(&self) -> bool {
        matches!(self.geometry.hierarchy, Accelerator::Many(_)) && self.lights.len() <= Self::MOST_LIGHTS
    }

    /// Whether rays from the eye are, too.
    pub(crate) fn eye_goes_by_streams(&self) -> bool {
        self.goes_by_streams() && self.geometry.parts_streams()
    }
}

impl WhittedIntegrator<'_> {
    /// Looks for what the rays of a stream meet.
    pub(crate) fn search<W: Width>(&self, w: W, streams: &mut StreamShading) {
        streams.rays.search(w, &self.stage.geometry, &self.media, &mut streams.memory);
    }

    /// Looks for what their shadow rays meet.
    pub(crate) fn search_shadows<W: Width>(&self, w: W, streams: &mut StreamShading) {
        for shadows in streams.shadows.iter_mut().filter(|shadows| !shadows.is_empty()) {
            shadows.search(w, self.stage, &self.media, &mut streams.memory, &mut streams.intervals);
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
        let mut inside = std::mem::take(&mut self.inside);
        self.media.fill::<W>(&mut inside, paths.media, paths.lanes);
        let mut light = vector_at(w, &streams.light.own, at);
        for shadows in streams.shadows.iter().filter(|shadows| !shadows.is_empty()) {
            light = self.lit(w, shadows, at, light, paths.lanes, &inside);
        }
        self.inside = inside;
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
        inside: &BodyMembership,
    ) -> Vector<W::R> {
        let flight =
            RayQuery::new(w, &self.stage.geometry, &shadows.rays(w, at), lanes, inside, Candidates::All);
        let (lit, more) = shadows.brought(w, at, self.stage, &flight);
        if lit.any() { Vector::select(lit, light + more, light).bounded() } else { light }
    }
}
