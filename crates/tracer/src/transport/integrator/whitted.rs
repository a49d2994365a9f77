//! Whitted's tree of rays, walked with rays side by side.
//!
//! Turner Whitted, An improved illumination model for shaded display, Communications of the ACM 23(6), 1980.

pub(crate) mod recorder;
pub(crate) mod rough;
pub(crate) mod scatter;
pub(crate) mod statistics;
pub(crate) mod streams;
pub(crate) mod tile_candidates;

use std::sync::atomic::{AtomicBool, Ordering};

use catoptric_scene::Tracing;
use glam::{DVec2, Vec3A};

use crate::geometry::bvh::packet::TraversalStack;
use crate::geometry::membership::{BodyMembership, MembershipSource as _};
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::{PacketHits, RayQuery};
use crate::geometry::ray::{NO_BODY, Ray, RayPacket};
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width, Word as _};
use crate::transport::camera::{CameraRays, RenderCamera};
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::integrator::whitted::tile_candidates::TileCandidates;
use crate::transport::interaction::SurfaceInteraction;
use crate::transport::light::RenderLight;
use crate::transport::media::absorption::MediumIntervals;
use crate::transport::media::transmittance::{ShadowScratch, Transmittance};
use crate::transport::media::{AIR, MediumStacks};
use crate::transport::path::{PathState, SecondaryRays};
use crate::transport::sampler::{SampleDimension, Sampler};
use crate::transport::scene::RenderScene;
use crate::transport::spectrum::SampledWavelengths;
use crate::transport::stream::StreamShading;
use crate::transport::surface::{MOST_OF_PIXEL, phong_highlight};

/// Walks trees of rays; reusable from pixel to pixel by one thread.
pub struct WhittedIntegrator<'a> {
    pub(crate) scene: &'a RenderScene,
    pub(crate) camera: &'a RenderCamera,
    pub(crate) cancel: &'a AtomicBool,
    /// Rays of this generation are the last.
    generations: u32,
    /// The weight below which rays are not traced.
    threshold: f32,
    /// Working memory of searches.
    stack: TraversalStack,
    intervals: MediumIntervals,
    /// The body that hid each light last.
    last_occluders: Vec<u32>,
    candidates: TileCandidates<'a>,
    pub(crate) media: MediumStacks,
    pub(crate) membership: BodyMembership,
    /// The media at the eye, if all rays start there and the table knows them.
    eye_media: Option<u32>,
    counts: RayCounts,
    sampler: Sampler,
    /// The colors of this sample.
    waves: SampledWavelengths,
}

impl<'a> WhittedIntegrator<'a> {
    /// Rays between two looks at the cancel flag.
    const CANCEL_INTERVAL: u32 = 1024;

    /// A walker over `scene` that stops early, with unfinished pixels, when `cancel` is set.
    pub fn new(scene: &'a RenderScene, cancel: &'a AtomicBool) -> Self {
        Self::through(scene, scene.camera(), cancel)
    }

    /// The same through a camera of [`RenderScene::camera_for`].
    pub fn through(scene: &'a RenderScene, camera: &'a RenderCamera, cancel: &'a AtomicBool) -> Self {
        Self {
            scene,
            camera,
            cancel,
            generations: scene.generations(),
            threshold: scene.threshold(),
            stack: TraversalStack::default(),
            intervals: MediumIntervals::default(),
            last_occluders: vec![NO_BODY; scene.lights.len()],
            candidates: TileCandidates::new(scene, camera),
            media: MediumStacks::default(),
            membership: BodyMembership::default(),
            eye_media: None,
            counts: RayCounts::default(),
            sampler: Sampler::default(),
            waves: if scene.disperses {
                SampledWavelengths::of_sample(0)
            } else {
                SampledWavelengths::default()
            },
        }
    }

    /// The same, stopped by a [`RenderControl`].
    pub fn watched(scene: &'a RenderScene, camera: &'a RenderCamera, control: &'a RenderControl) -> Self {
        Self::through(scene, camera, &control.cancel)
    }

    /// The same walker with other limits than the scene's: of generations (at least 1), and the weight below which rays
    /// are not traced.
    pub fn with_limits(self, generations: u32, threshold: f32) -> Self {
        let generations = generations.clamp(1, Tracing::MAX_GENERATIONS);
        Self { generations, threshold: threshold.max(0.0), ..self }
    }

    /// The rays traced so far.
    pub fn counts(&self) -> RayCounts {
        self.counts
    }

    /// The light that reaches the point `at` of a picture of `size` pixels (see [`RenderCamera::ray`]), by one ray at a
    /// time: the reference for all that trace several side by side.
    pub fn trace(&mut self, at: DVec2, size: DVec2) -> Vec3A {
        let mut pending = vec![self.root(&self.camera.ray(at, size))];
        let mut light = Vec3A::ZERO;
        let mut until_look = Self::CANCEL_INTERVAL;
        while let Some(beam) = pending.pop() {
            light += Vec3A::from(
                self.li::<ScalarWidth, true>(ScalarWidth, &beam, PacketSource::Anywhere, &mut pending).light,
            );
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
        self.trim_media();
        let media = self.media.at_point(self.scene, rays.origin);
        self.counts.primary += 1;
        PathState { rays, weight: Vector::new(1.0, 1.0, 1.0), generation: 1, media, pixel: 0, lanes: true }
    }

    /// Forgets what was learned of media if it has become much. No rays may be in flight.
    pub(crate) fn trim_media(&mut self) {
        if self.media.trim() {
            self.eye_media = None;
        }
    }

    /// Whether there may be more than Phong's model in plain colors, point lights and even surroundings.
    pub(crate) fn is_full(&self) -> bool {
        self.scene.is_full
    }

    /// Prepares for a sample; no rays may be in flight.
    pub(crate) fn begin(&mut self, sample: u32, sampler: Sampler) {
        self.sampler = sampler;
        if self.scene.disperses {
            self.waves = SampledWavelengths::of_sample(sample);
            // Indices of refraction are others now.
            self.media = MediumStacks::default();
            self.eye_media = None;
        }
    }

    /// Prepares for rays from the eye within `t_max` pixels of the middle of these.
    pub(crate) fn begin_tile(&mut self, rays: &CameraRays, t_max: DVec2) {
        self.candidates.begin_tile(self.scene, rays, t_max.as_vec2().to_array());
    }

    /// Takes up rays from the eye: the media where they start.
    #[inline(always)]
    pub(crate) fn start_paths<W: Width>(&mut self, w: W, paths: &mut PathState<W>) {
        self.counts.primary += u64::from(paths.lanes.bits().count_ones());
        if self.scene.geometry.has_transparency {
            paths.media = match self.camera.eye() {
                Some(eye) => {
                    let at_eye = || self.media.at_point(self.scene, eye);
                    w.word(*self.eye_media.get_or_insert_with(at_eye))
                }
                None => self.media_at(w, paths.rays.origin, paths.lanes),
            };
        }
    }

    /// The first ray of a tree, as rays side by side have it.
    fn started_path(&mut self, ray: (Vector<f32>, Vector<f32>)) -> PathState<ScalarWidth> {
        let mut paths = PathState { lanes: true, ..PathState::from_eye(ScalarWidth) };
        paths.rays.set(ray);
        self.start_paths(ScalarWidth, &mut paths);
        paths
    }

    /// The media at the rays' starts.
    fn media_at<W: Width>(&mut self, w: W, origin: Vector<W::R>, lanes: W::M) -> W::W {
        let [mut x, mut y, mut z] = [[0.0; MOST_LANES]; 3];
        origin.x.store(&mut x);
        origin.y.store(&mut y);
        origin.z.store(&mut z);
        let mut media = [AIR; MOST_LANES];
        for lane in (0..W::LANES).filter(|lane| lanes.bits() >> lane & 1 == 1) {
            media[lane] = self.media.at_point(self.scene, Vector { x: x[lane], y: y[lane], z: z[lane] });
        }
        w.load_words(&media)
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
        let mut membership = std::mem::take(&mut self.membership);
        self.media.fill::<W>(&mut membership, paths.media, paths.lanes);
        let followed = self.li_inside::<W, FULL>(w, paths, from, &membership, secondary);
        self.membership = membership;
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
        let hits = self.closest_hit(w, paths, &from, membership);
        let hit = hits.hit & paths.lanes;
        let hits = PacketHits { hit, ..hits };
        let mut paths = paths;
        let absorbed;
        if FULL && self.scene.absorbs && !membership.is_empty() {
            let through = self.media.left_after(w, self.scene, paths.media, hits.t, paths.lanes);
            secondary.on_medium(through);
            is_whole = false;
            absorbed = PathState { weight: paths.weight.times(through), ..*paths };
            paths = &absorbed;
        }
        let background = if FULL {
            self.scene.sky.light(w, paths.rays.direction, paths.lanes & !hit)
        } else {
            Vector::splat(w.real(0.0), self.scene.sky.even())
        };
        if !hit.any() {
            if let Some((streams, at)) = from.stream() {
                streams.keep(w, at, background, paths.weight);
            }
            return PacketRadiance { light: weighted(paths, is_whole, background), hits };
        }
        let at = SurfaceInteraction::new::<FULL>(w, self.scene, &paths.rays, &hits);
        secondary.on_hit(&at);
        let light = self.local_light::<W, FULL>(w, paths, &mut from, membership, &at, secondary);
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
        let at_limit = at.transparent & hit & !below;
        if at_limit.any() {
            self.pass_at_limit::<W, FULL>(w, *paths, at, at_limit, secondary);
        }
        PacketRadiance { light, hits }
    }

    #[inline(always)]
    fn closest_hit<W: Width>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        from: &PacketSource<'_>,
        membership: &BodyMembership,
    ) -> PacketHits<W> {
        if let PacketSource::Stream { streams, at } = from {
            let query =
                RayQuery::new(w, &self.scene.geometry, &paths.rays, paths.lanes, membership, Candidates::All);
            return streams.rays.hits(w, *at, &query);
        }
        let are_from_eye = matches!(from, PacketSource::Eye);
        if are_from_eye && self.candidates.through_tile().is_empty() {
            return PacketHits::none(w);
        }
        self.closest_hit_of_packet(w, paths, are_from_eye, membership).resolved(
            w,
            &self.scene.geometry,
            &paths.rays,
            membership,
        )
    }

    fn closest_hit_of_packet<W: Width>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        are_from_eye: bool,
        membership: &BodyMembership,
    ) -> PacketHits<W> {
        w.run(
            #[inline(always)]
            move || {
                let along = if are_from_eye { self.candidates.through_tile() } else { Candidates::All };
                let query =
                    RayQuery::new(w, &self.scene.geometry, &paths.rays, paths.lanes, membership, along);
                query.closest_hit_unresolved(&mut self.stack)
            },
        )
    }

    /// The way to a light, or to a point of a ball.
    #[inline(always)]
    fn sample_li<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        at: &SurfaceInteraction<W>,
        (index, source): (usize, &RenderLight),
    ) -> LightSample<W> {
        let offset = Vector::splat(w.real(0.0), source.position) - at.position;
        let distance = offset.length_squared().sqrt();
        let to_light = offset * (w.real(1.0) / distance);
        if !FULL || source.radius == 0.0 {
            return LightSample { to_light, distance, power: None };
        }
        let sample = self.sampler.sample_2d(w, self.scene, paths, at.body, SampleDimension::Light(index));
        let (to_point, before, share) = source.sample_sphere((to_light, distance), &sample);
        LightSample { to_light: to_point, distance: before, power: Some(source.power_at(distance) * share) }
    }

    /// The ambient, diffuse and highlight terms.
    #[inline(always)]
    fn local_light<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        from: &mut PacketSource<'_>,
        membership: &BodyMembership,
        at: &SurfaceInteraction<W>,
        secondary: &mut impl SecondaryRays<W>,
    ) -> Vector<W::R> {
        let zero = w.real(0.0);
        let mut light = at.ambient;
        if !at.answers.any() {
            return light;
        }
        let mut rays = at.rays_on_this_side(paths.rays.direction);
        for (index, source) in self.scene.lights.iter().enumerate() {
            if !source.shines {
                continue;
            }
            let LightSample { to_light, distance, power } =
                self.sample_li::<W, FULL>(w, paths, at, (index, source));
            let cos = at.normal.dot(to_light);
            secondary.on_light(index, to_light, distance, cos);
            rays.direction = to_light;
            let mut faces = cos.gt(zero);
            if FULL {
                // The body's own surface lies between its inner side and a light; what it lets through from there is seen
                // where the viewer's ray leaves it.
                let within = at.rough_interior();
                faces = (faces & !within) | (within & cos.lt(zero));
                rays.start = W::W::select(within, at.rays_on_far_side(to_light).start, at.start);
            }
            // A light that stands exactly here has no direction.
            let mut lit = at.answers & distance.gt(zero) & faces;
            if !lit.any() {
                continue;
            }
            self.counts.shadow += u64::from(lit.bits().count_ones());
            let streams = from.stream();
            let mut through = Transmittance::all(lit);
            let along = self.candidates.to_light(index);
            if streams.is_none() {
                if !along.is_empty() {
                    let memory = (&mut self.stack, &mut self.intervals, &mut self.last_occluders[index]);
                    let around = (membership, (&self.media, &paths.media));
                    through = transmittance(w, self.scene, (&rays, lit), around, (along, &distance), memory);
                }
                secondary.on_shadow_ray(&rays, distance, membership, &through);
                lit = lit & through.lanes;
                if let Some(share) = &through.share {
                    lit = lit & !share.is_zero();
                }
                if !lit.any() {
                    continue;
                }
            }
            let to_viewer = -paths.rays.direction;
            let mut answer = if FULL { at.eval_diffuse(cos) } else { at.diffuse * cos };
            if at.glossy.any() {
                let highlight = at.specular * phong_highlight(to_viewer, to_light, at.normal, at.shininess);
                secondary.on_highlight(to_viewer, highlight);
                answer = answer.map(|diffuse| diffuse + highlight);
            }
            if FULL && at.rough.any() {
                let glints = self.eval_microfacets(w, paths, at, to_light);
                secondary.on_microfacets(glints);
                answer = answer + glints;
            }
            let power = power.unwrap_or_else(|| source.power_at(distance));
            let answer = power.times(answer);
            if let Some((streams, place)) = streams {
                streams.ask(w, index, place, &rays, (paths.media, distance), answer, lit);
            } else {
                let more = through.share.map_or(answer, |share| answer.times(share));
                secondary.on_light_answer(power, more);
                light = Vector::select(lit, light + more, light);
            }
        }
        light.bounded()
    }
}

/// Where rays come from.
pub(crate) enum PacketSource<'s> {
    /// The eye; they were [prepared for](WhittedIntegrator::begin_tile).
    Eye,
    Anywhere,
    /// They are those of a stream from number `at` on; shadow rays are traced later.
    Stream {
        streams: &'s mut StreamShading,
        at: usize,
    },
}

impl PacketSource<'_> {
    /// The stream, and the number of the first ray.
    #[inline(always)]
    fn stream(&mut self) -> Option<(&mut StreamShading, usize)> {
        match self {
            Self::Stream { streams, at } => Some((streams, *at)),
            Self::Eye | Self::Anywhere => None,
        }
    }
}

/// The way from points to a light.
struct LightSample<W: Width> {
    /// The directions, of length 1.
    to_light: Vector<W::R>,
    distance: W::R,
    /// What arrives if nothing is in the way, where that is not the light's own power at this distance.
    power: Option<Vector<W::R>>,
}

/// What bodies let through on the way to a light, and the media in which the rays start.
fn transmittance<W: Width>(
    w: W,
    scene: &RenderScene,
    (rays, lanes): (&RayPacket<W>, W::M),
    (membership, (table, media)): (&BodyMembership, (&MediumStacks, &W::W)),
    (along, distance): (Candidates<'_>, &W::R),
    (stack, intervals, occluder): (&mut TraversalStack, &mut MediumIntervals, &mut u32),
) -> Transmittance<W> {
    w.run(
        #[inline(always)]
        move || {
            let query = RayQuery::new(w, &scene.geometry, rays, lanes, membership, along);
            let memory = ShadowScratch { stack, intervals, occluder };
            query.transmittance(scene, *distance, (table, *media), memory)
        },
    )
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
