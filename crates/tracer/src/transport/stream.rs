//! Rays of the tree by the thousand: all are searched for together, then shaded side by side, then all their shadow rays are
//! searched for together.

use bytemuck::{Zeroable, zeroed_box};

use crate::geometry::Accelerator;
use crate::geometry::bvh::stream::{STREAM, StreamRow};
use crate::geometry::query::stream::{RayStream, StreamScratch};
use crate::geometry::ray::RayPacket;
use crate::simd::Width;
use crate::simd::vector::Vector;
use crate::transport::media::absorption::MediumIntervals;
use crate::transport::media::shadow_stream::ShadowStream;
use crate::transport::path::RayQueue;
use crate::transport::scene::RenderScene;

/// A stream of rays with the light that they bring: working memory.
#[derive(Debug)]
pub(crate) struct StreamShading {
    pub(crate) rays: Box<RayStream>,
    pub(crate) light: Box<StreamRadiance>,
    /// By light.
    pub(crate) shadows: Vec<Box<ShadowStream>>,
    pub(crate) memory: StreamScratch,
    pub(crate) intervals: MediumIntervals,
}

/// What the rays of a stream bring.
#[derive(Debug, Zeroable)]
pub(crate) struct StreamRadiance {
    /// The light that each brings without that of the lights.
    pub(crate) own: StreamRow<[f32; 4]>,
    /// What it counts for its pixel.
    pub(crate) weight: StreamRow<[f32; 4]>,
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
    pub(crate) fn keep<W: Width>(&mut self, w: W, at: usize, light: Vector<W::R>, weight: Vector<W::R>) {
        let zero = w.real(0.0);
        w.store_fours([light.x, light.y, light.z, zero], &mut self.light.own[at..]);
        w.store_fours([weight.x, weight.y, weight.z, zero], &mut self.light.weight[at..]);
    }

    /// Takes note of shadow rays to a light.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "each is a vector of its own")]
    pub(crate) fn ask<W: Width>(
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
