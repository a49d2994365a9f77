//! Whitted's tree of rays, walked with rays side by side.
//!
//! Turner Whitted, An improved illumination model for shaded display, Communications of the ACM 23(6), 1980.

pub(crate) mod recorder;
pub(crate) mod scatter;
pub(crate) mod statistics;
pub(crate) mod streams;

use std::sync::atomic::{AtomicBool, Ordering};

use catoptric_scene::Tracing;
use glam::{DVec2, Vec3A};

use crate::geometry::membership::{BodyMembership, MembershipSource as _};
use crate::geometry::query::PacketHits;
use crate::geometry::ray::Ray;
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Mask as _, Width};
use crate::transport::camera::RenderCamera;
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::path::{PathState, SecondaryRays};
use crate::transport::scene::RenderScene;
use crate::transport::shading::{PacketSource, ShadingContext};
use crate::transport::surface::MOST_OF_PIXEL;

/// Walks trees of rays; reusable from pixel to pixel by one thread.
pub struct WhittedIntegrator<'a> {
    pub(crate) shading: ShadingContext<'a>,
    pub(crate) cancel: &'a AtomicBool,
    /// Rays of this generation are the last.
    generations: u32,
    /// The weight below which rays are not traced.
    threshold: f32,
}

impl<'a> WhittedIntegrator<'a> {
    /// Rays between two looks at the cancel flag.
    const CANCEL_INTERVAL: u32 = 1024;

    /// A walker over `scene` that stops early, with unfinished pixels, when `cancel` is set.
    pub fn new(scene: &'a RenderScene, cancel: &'a AtomicBool) -> Self {
        Self::through(scene, scene.camera(), cancel)
    }

    /// A walker over `scene` through a camera of [`RenderScene::camera_for`], stopped by `cancel`.
    pub fn through(scene: &'a RenderScene, camera: &'a RenderCamera, cancel: &'a AtomicBool) -> Self {
        Self {
            shading: ShadingContext::new(scene, camera),
            cancel,
            generations: scene.generations(),
            threshold: scene.threshold(),
        }
    }

    /// A walker over `scene` through a camera of [`RenderScene::camera_for`], stopped by a [`RenderControl`].
    pub fn watched(scene: &'a RenderScene, camera: &'a RenderCamera, control: &'a RenderControl) -> Self {
        Self::through(scene, camera, &control.cancel)
    }

    /// This walker with other limits than the scene's: of generations (at least 1), and the weight below which rays
    /// are not traced.
    pub fn with_limits(self, generations: u32, threshold: f32) -> Self {
        let generations = generations.clamp(1, Tracing::MAX_GENERATIONS);
        Self { generations, threshold: threshold.max(0.0), ..self }
    }

    /// The rays traced so far.
    pub fn counts(&self) -> RayCounts {
        self.shading.counts
    }

    /// The light that reaches the point `at` of a picture of `size` pixels (see [`RenderCamera::ray`]), by one ray at a
    /// time: the reference for all that trace several side by side.
    pub fn trace(&mut self, at: DVec2, size: DVec2) -> Vec3A {
        let mut pending = vec![self.root(&self.shading.camera.ray(at, size))];
        let mut light = Vec3A::ZERO;
        let mut until_look = Self::CANCEL_INTERVAL;
        while let Some(beam) = pending.pop() {
            light += self.follow(&beam, &mut pending);
            light = light.clamp(Vec3A::splat(-MOST_OF_PIXEL), Vec3A::splat(MOST_OF_PIXEL));
            until_look -= 1;
            if until_look == 0 {
                if self.cancel.load(Ordering::Relaxed) {
                    break;
                }
                until_look = Self::CANCEL_INTERVAL;
            }
        }
        light
    }

    /// The first ray of a tree.
    fn root(&mut self, primary: &Ray) -> PathState<ScalarWidth> {
        let rays = primary.alone();
        self.shading.trim_media();
        let media = self.shading.media.at_point(self.shading.scene, rays.origin);
        self.shading.counts.primary += 1;
        PathState { rays, weight: Vector::new(1.0, 1.0, 1.0), generation: 1, media, pixel: 0, lanes: true }
    }

    /// Whether there may be more than Phong's model in plain colors, point lights and even surroundings.
    pub(crate) fn is_full(&self) -> bool {
        self.shading.scene.is_full
    }

    /// The first ray of a tree, as rays side by side have it.
    fn started_path(&mut self, ray: (Vector<f32>, Vector<f32>)) -> PathState<ScalarWidth> {
        let mut paths = PathState { lanes: true, ..PathState::from_eye(ScalarWidth) };
        paths.rays.set(ray);
        self.shading.start_paths(ScalarWidth, &mut paths);
        paths
    }

    /// The light that one ray brings; those that it sends join `pending`. In a function of its own, so that its code is
    /// there once.
    #[inline(never)]
    pub(crate) fn follow(
        &mut self,
        path: &PathState<ScalarWidth>,
        pending: &mut Vec<PathState<ScalarWidth>>,
    ) -> Vec3A {
        self.li::<ScalarWidth, true>(ScalarWidth, path, PacketSource::Anywhere, pending).light.into()
    }

    /// Traces rays side by side: what each adds to its pixel, and what it meets. The rays that grow from them go to
    /// `secondary`.
    ///
    /// `FULL` stands where [`RenderScene::is_full`] may be true: what other surfaces, lights and surroundings need would cost
    /// plain scenes a tenth of their time.
    #[inline(always)]
    pub(crate) fn li<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        from: PacketSource<'_>,
        secondary: &mut impl SecondaryRays<W>,
    ) -> PacketRadiance<W> {
        let mut membership = std::mem::take(&mut self.shading.membership);
        self.shading.media.fill::<W>(&mut membership, paths.media, paths.lanes);
        let followed = self.li_inside::<W, FULL>(w, paths, from, &membership, secondary);
        self.shading.membership = membership;
        followed
    }

    #[inline(always)]
    fn li_inside<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        mut from: PacketSource<'_>,
        membership: &BodyMembership,
        secondary: &mut impl SecondaryRays<W>,
    ) -> PacketRadiance<W> {
        let mut is_whole = matches!(from, PacketSource::Eye);
        let hits = self.shading.closest_hit(w, paths, &from, membership);
        let hit = hits.hit & paths.lanes;
        let hits = PacketHits { hit, ..hits };
        let mut paths = paths;
        let absorbed;
        if FULL && self.shading.scene.absorbs && !membership.is_empty() {
            let through =
                self.shading.media.left_after(w, self.shading.scene, paths.media, hits.t, paths.lanes);
            secondary.on_medium(through);
            is_whole = false;
            absorbed = PathState { weight: paths.weight.times(through), ..*paths };
            paths = &absorbed;
        }
        let background = if FULL {
            self.shading.scene.sky.light(w, paths.rays.direction, paths.lanes & !hit)
        } else {
            Vector::splat(w.real(0.0), self.shading.scene.sky.even())
        };
        if !hit.any() {
            if let Some((streams, at)) = from.stream() {
                streams.keep(w, at, background, paths.weight);
            }
            return PacketRadiance { light: weighted(paths, is_whole, background), hits };
        }
        let at = self.shading.interaction::<W, FULL>(w, paths, &hits);
        secondary.on_hit(w, paths, hit, &at);
        let light = self.shading.direct_light::<W, FULL>(w, paths, &mut from, membership, &at, secondary);
        secondary.on_local_light(light);
        let light = Vector::select(hit, light, background);
        if let Some((streams, at)) = from.stream() {
            streams.keep(w, at, light, paths.weight);
        }
        let light = weighted(paths, is_whole, light);
        let below = paths.below(w, self.generations);
        let goes_on = hit & below;
        if goes_on.any() {
            self.scatter::<W, FULL>(w, paths, &at, goes_on, secondary);
        }
        let at_limit = at.bsdf.transparent & hit & !below;
        if at_limit.any() {
            self.pass_at_limit::<W, FULL>(w, *paths, at, at_limit, secondary);
        }
        PacketRadiance { light, hits }
    }
}

/// What light adds to pixels; all of it, where the weights are known to be 1.
#[inline(always)]
fn weighted<W: Width>(paths: &PathState<W>, is_whole: bool, light: Vector<W::R>) -> Vector<W::R> {
    if is_whole { light } else { paths.weight.times(light) }
}

/// What became of rays side by side.
pub(crate) struct PacketRadiance<W: Width> {
    /// What each adds to its pixel; of rays that do not fly, anything.
    pub light: Vector<W::R>,
    pub hits: PacketHits<W>,
}
