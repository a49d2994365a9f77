//! What every integrator asks of a scene: which bodies a packet meets, and what light their surfaces send on directly.

use glam::DVec2;

use crate::geometry::bvh::packet::TraversalStack;
use crate::geometry::membership::BodyMembership;
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::{PacketHits, RayQuery};
use crate::geometry::ray::RayPacket;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width, Word as _};
use crate::transport::camera::{CameraRays, RenderCamera};
use crate::transport::counts::RayCounts;
use crate::transport::interaction::SurfaceInteraction;
use crate::transport::light::RenderLight;
use crate::transport::media::absorption::MediumIntervals;
use crate::transport::media::transmittance::Transmittance;
use crate::transport::media::{AIR, MediumStacks};
use crate::transport::path::{PathObserver, PathState};
use crate::transport::sampler::{SampleDimension, Sampler};
use crate::transport::sampling::Sample2D;
use crate::transport::scene::RenderScene;
use crate::transport::spectrum::SampledWavelengths;
use crate::transport::stream::StreamShading;
use crate::transport::tile_candidates::TileCandidates;

/// One thread's means of shading packets; reusable from tile to tile.
pub(crate) struct ShadingContext<'a> {
    pub(crate) scene: &'a RenderScene,
    pub(crate) camera: &'a RenderCamera,
    /// Working memory of searches.
    pub(crate) stack: TraversalStack,
    pub(crate) intervals: MediumIntervals,
    pub(crate) candidates: TileCandidates<'a>,
    pub(crate) media: MediumStacks,
    pub(crate) membership: BodyMembership,
    /// The media at the eye, if all rays start there and the table knows them.
    pub(crate) eye_media: Option<u32>,
    pub(crate) counts: RayCounts,
    pub(crate) sampler: Sampler,
    /// The colors of this sample.
    pub(crate) waves: SampledWavelengths,
}

impl<'a> ShadingContext<'a> {
    pub(crate) fn new(scene: &'a RenderScene, camera: &'a RenderCamera) -> Self {
        Self {
            scene,
            camera,
            stack: TraversalStack::default(),
            intervals: MediumIntervals::default(),
            candidates: TileCandidates::new(scene, camera),
            media: MediumStacks::default(),
            membership: BodyMembership::default(),
            eye_media: None,
            counts: RayCounts::default(),
            sampler: Sampler::default(),
            waves: match scene.disperses {
                true => SampledWavelengths::of_sample(0),
                false => SampledWavelengths::default(),
            },
        }
    }

    /// Forgets what was learned of media if it has become much. No rays may be in flight.
    pub(crate) fn trim_media(&mut self) {
        if self.media.trim() {
            self.eye_media = None;
        }
    }

    /// Prepares for a sample; no rays may be in flight.
    pub(crate) fn begin_sample(&mut self, sample: u32, sampler: Sampler) {
        self.sampler = sampler;
        if self.scene.disperses {
            self.waves = SampledWavelengths::of_sample(sample);
            // Indices of refraction are others now.
            self.media = MediumStacks::default();
            self.eye_media = None;
        }
    }

    /// Prepares for rays from the eye within `reach` pixels of the middle of these.
    pub(crate) fn begin_tile(&mut self, rays: &CameraRays, reach: DVec2) {
        self.candidates.begin_tile(self.scene, rays, reach.as_vec2().to_array());
    }

    /// Takes up rays from the eye: the media where they start.
    #[inline(always)]
    pub(crate) fn start_paths<W: Width>(&mut self, w: W, paths: &mut PathState<W>) {
        self.counts.primary += u64::from(paths.lanes.bits().count_ones());
        self.enter_media_at_eye(w, paths);
    }

    /// Tells rays from the eye the media where they start.
    #[inline(always)]
    pub(crate) fn enter_media_at_eye<W: Width>(&mut self, w: W, paths: &mut PathState<W>) {
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

    /// The media at the rays' starts.
    pub(crate) fn media_at<W: Width>(&mut self, w: W, origin: Vector<W::R>, lanes: W::M) -> W::W {
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

    #[inline(always)]
    pub(crate) fn closest_hit<W: Width>(
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
        let sample =
            self.sampler.sample_2d(w, self.scene, paths, at.bsdf.body, SampleDimension::Light(index));
        let (to_point, before, share) = source.sample_sphere((to_light, distance), &sample);
        LightSample { to_light: to_point, distance: before, power: Some(source.power_at(distance) * share) }
    }

    /// The ambient, diffuse and highlight terms, in units in which a matte surface sends on k_d·C·(n̂·L̂) of a light.
    #[inline(always)]
    pub(crate) fn direct_light<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        from: &mut PacketSource<'_>,
        membership: &BodyMembership,
        at: &SurfaceInteraction<W>,
        observer: &mut impl PathObserver<W>,
    ) -> Vector<W::R> {
        let zero = w.real(0.0);
        let bsdf = &at.bsdf;
        let mut light = bsdf.ambient;
        if !bsdf.scatters.any() {
            return light;
        }
        let ratio = if FULL { self.facet_ratio(w, paths, at) } else { w.real(1.0) };
        let is_unshadowed = matches!(from, PacketSource::Unshadowed);
        let mut rays = at.rays_on_this_side(paths.rays.direction);
        for (index, source) in self.scene.lights.iter().enumerate() {
            if !source.shines {
                continue;
            }
            let LightSample { to_light, distance, power } =
                self.sample_li::<W, FULL>(w, paths, at, (index, source));
            let cos = bsdf.normal.dot(to_light);
            observer.on_light(index, to_light, distance, cos);
            rays.direction = to_light;
            let mut faces = cos.gt(zero);
            if FULL {
                // The body's own surface lies between its inner side and a light; what it lets through from there is seen
                // where the viewer's ray leaves it.
                let within = bsdf.rough_interior();
                faces = (faces & !within) | (within & cos.lt(zero));
                rays.start = W::W::select(within, at.rays_on_far_side(to_light).start, at.start);
            }
            // A light that stands exactly here has no direction.
            let mut lit = bsdf.scatters & distance.gt(zero) & faces;
            if !lit.any() {
                continue;
            }
            if !is_unshadowed {
                self.counts.shadow += u64::from(lit.bits().count_ones());
            }
            // What passes cemented contacts is found out by packets alone.
            let is_cemented = FULL && self.scene.geometry.has_cemented;
            let streams = if is_cemented { None } else { from.stream() };
            let mut through = Transmittance::all(lit);
            let along = self.candidates.to_light(index);
            if streams.is_none() && !is_unshadowed {
                if !along.is_empty() {
                    let memory = (&mut self.stack, &mut self.intervals);
                    let around = (membership, (&self.media, &paths.media));
                    through = transmittance(w, self.scene, (&rays, lit), around, (along, &distance), memory);
                }
                observer.on_shadow_ray(&rays, distance, membership, &through);
                lit = lit & through.lanes;
                if let Some(share) = &through.share {
                    lit = lit & !share.is_zero();
                }
                if !lit.any() {
                    continue;
                }
            }
            let to_viewer = -paths.rays.direction;
            let value = bsdf.eval::<FULL>(w, self.scene.body_materials(), to_viewer, (to_light, cos), ratio);
            let power = power.unwrap_or_else(|| source.power_at(distance));
            let answer = power.times(value.sum);
            if let Some((streams, place)) = streams {
                streams.ask(w, index, place, &rays, (paths.media, distance), answer, lit);
            } else {
                let more = through.share.map_or(answer, |share| answer.times(share));
                observer.on_light_answer(lit, power, &through, (&value, more));
                light = Vector::select(lit, light + more, light);
            }
        }
        light.bounded()
    }

    /// The numbers that choose a facet of rough surfaces.
    #[inline(always)]
    pub(crate) fn facet_sample<W: Width>(
        &self,
        w: W,
        paths: &PathState<W>,
        at: &SurfaceInteraction<W>,
    ) -> Sample2D<W> {
        self.sampler.sample_2d(w, self.scene, paths, at.bsdf.body, SampleDimension::Facet)
    }

    /// The ratio of indices at facets of clear bodies, 1 elsewhere.
    #[inline(always)]
    fn facet_ratio<W: Width>(&mut self, w: W, paths: &PathState<W>, at: &SurfaceInteraction<W>) -> W::R {
        let lanes = at.bsdf.rough_dielectric();
        if lanes.any() { self.cross_interface::<W, true>(w, paths.media, at, lanes).0 } else { w.real(1.0) }
    }

    /// The ratio of indices for rays that cross surfaces, and the media beyond.
    #[inline(always)]
    pub(crate) fn cross_interface<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        media: W::W,
        at: &SurfaceInteraction<W>,
        lanes: W::M,
    ) -> (W::R, W::W) {
        if FULL && self.scene.geometry.has_cemented {
            return self.cross_cemented(w, media, *at, lanes);
        }
        let (mut lists, mut words) = ([AIR; MOST_LANES], [0; MOST_LANES]);
        media.store(&mut lists);
        at.start.store(&mut words);
        let (mut ratio, mut beyond) = (w.real(1.0), media);
        let mut left = lanes.bits();
        while left != 0 {
            let lane = left.trailing_zeros() as usize % MOST_LANES;
            let same = media.is(lists[lane]) & at.start.is(words[lane]);
            left &= !same.bits();
            let same = same & lanes;
            let crossing = self.media.interface(self.scene, &self.waves, lists[lane], words[lane]);
            ratio = W::R::select(same, w.real(crossing.ratio), ratio);
            beyond = W::W::select(same, w.word(crossing.beyond), beyond);
        }
        (ratio, beyond)
    }
}

/// Where rays come from.
pub(crate) enum PacketSource<'s> {
    /// The eye; they were [prepared for](ShadingContext::begin_tile).
    Eye,
    Anywhere,
    /// Surfaces on which all lights shine, whatever is in the way.
    Unshadowed,
    /// They are those of a stream from number `at` on; shadow rays are traced later.
    Stream {
        streams: &'s mut StreamShading,
        at: usize,
    },
}

impl PacketSource<'_> {
    /// The stream, and the number of the first ray.
    #[inline(always)]
    pub(crate) fn stream(&mut self) -> Option<(&mut StreamShading, usize)> {
        match self {
            Self::Stream { streams, at } => Some((streams, *at)),
            Self::Eye | Self::Anywhere | Self::Unshadowed => None,
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

/// What bodies let through on the way to a light, and the media in which the rays start. Never inlined: its
/// code would be compiled in each codegen unit that calls it.
#[inline(never)]
fn transmittance<W: Width>(
    w: W,
    scene: &RenderScene,
    (rays, lanes): (&RayPacket<W>, W::M),
    (membership, (table, media)): (&BodyMembership, (&MediumStacks, &W::W)),
    (along, distance): (Candidates<'_>, &W::R),
    memory: (&mut TraversalStack, &mut MediumIntervals),
) -> Transmittance<W> {
    w.run(
        #[inline(always)]
        move || {
            let query = RayQuery::new(w, &scene.geometry, rays, lanes, membership, along);
            query.transmittance(scene, *distance, (table, *media), memory)
        },
    )
}
