//! The tree of rays behind one pixel, ray by ray, with every number on the way.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::{UVec2, Vec3};

use crate::geometry::membership::BodyMembership;
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::coincident::SurfaceCrossing;
use crate::geometry::query::{HitRecord, RayQuery, found_in};
use crate::geometry::ray::{NO_START, Ray, RayOrigin, RayPacket};
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::transport::integrator::whitted::{PacketRadiance, WhittedIntegrator};
use crate::transport::interaction::SurfaceInteraction;
use crate::transport::media::MediumStacks;
use crate::transport::media::shadow_crossings::{ShadowContact, contacts, filter_of};
use crate::transport::media::transmittance::Transmittance;
use crate::transport::path::{InterfaceCrossing, PathObserver, PathState, SecondaryRays};
use crate::transport::pick::RayIntersection;
use crate::transport::record::{
    BranchOutcome, BranchRecord, ContactRecord, InterfaceRecord, LightContribution, LightTerm, RayKind,
    RayRecord, ShadowCrossing, ShadowRecord, SurfaceRecord,
};
use crate::transport::sampler::Sampler;
use crate::transport::scene::RenderScene;
use crate::transport::shading::{PacketSource, ShadingContext};
use crate::transport::surface::bsdf::BsdfValue;
use crate::transport::surface::highlight_cosine;
use crate::transport::texture::solid::{SolidNode, patterned};
use crate::transport::tile_rect::{TILE, TileRect};

/// A ray that waits, and why. The heaviest goes first, of equal ones the one sent first.
struct QueuedPath {
    sent: SentPath,
    parent: Option<usize>,
    number: usize,
}

/// A ray on its way, with what sent it.
struct SentPath {
    beam: PathState<ScalarWidth>,
    kind: RayKind,
    coefficient: Vec3,
    density: Option<f32>,
}

impl QueuedPath {
    fn key(&self) -> (f32, usize) {
        (self.sent.beam.weight.largest(), self.number)
    }
}

impl Ord for QueuedPath {
    fn cmp(&self, other: &Self) -> Ordering {
        let ((weight, number), (other_weight, other_number)) = (self.key(), other.key());
        weight.total_cmp(&other_weight).then(other_number.cmp(&number))
    }
}

impl PartialOrd for QueuedPath {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for QueuedPath {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for QueuedPath {}

/// Writes down what becomes of one ray.
struct PathRecorder<'a> {
    scene: &'a RenderScene,
    to_viewer: Vector<f32>,
    /// The bodies that the ray flies in, the one entered last at the end.
    media: Vec<u32>,
    at: Option<SurfaceInteraction<ScalarWidth>>,
    local: Option<Vector<f32>>,
    lights: Vec<LightTerm>,
    crossing: Option<InterfaceCrossing<ScalarWidth>>,
    /// What the way there leaves of the light.
    through: Vector<f32>,
    /// The coefficients of what was let through last, and of all that was.
    through_last: Vec3,
    through_all: Vec3,
    reflected: Vec3,
    /// The densities of directions let through last and reflected.
    through_pdf: f32,
    reflected_pdf: f32,
    /// Whether a ray has been let through.
    has_refracted: bool,
    /// The rays that go on.
    sent: Vec<SentPath>,
}

impl<'a> PathRecorder<'a> {
    fn new(scene: &'a RenderScene, table: &MediumStacks, path: &PathState<ScalarWidth>) -> Self {
        let mut media: Vec<u32> = table.bodies(path.media).collect();
        media.reverse();
        Self {
            scene,
            to_viewer: -path.rays.direction,
            media,
            at: None,
            local: None,
            lights: Vec::new(),
            crossing: None,
            through: Vector::new(1.0, 1.0, 1.0),
            through_last: Vec3::ZERO,
            through_all: Vec3::ZERO,
            reflected: Vec3::ZERO,
            through_pdf: 0.0,
            reflected_pdf: 0.0,
            has_refracted: false,
            sent: Vec::new(),
        }
    }
}

impl PathRecorder<'_> {
    /// Which crossings of a shadow ray, that are in order, are cemented contacts.
    fn shadow_contacts(
        &self,
        rays: &RayPacket<ScalarWidth>,
        inside: &BodyMembership,
        hits: &[(HitRecord, RayOrigin)],
    ) -> Vec<ShadowContact> {
        let geometry = &self.scene.geometry;
        let may_join = |(hit, whole): &(HitRecord, RayOrigin)| {
            geometry.has_cemented
                && geometry.body(whole.body).is_cementable()
                && !geometry.body(hit.body).stops_light()
        };
        let crossing = |(hit, whole): &(HitRecord, RayOrigin)| SurfaceCrossing {
            t: hit.t,
            face: 0.0,
            body: hit.body,
            leaving: whole.inwards,
        };
        let mut joining: Vec<_> = hits.iter().filter(|hit| may_join(hit)).map(crossing).collect();
        let mut found = contacts(self.scene, rays, inside, &mut joining).into_iter();
        let contact = |hit| if may_join(hit) { found.next() } else { None };
        hits.iter().map(contact).map(Option::unwrap_or_default).collect()
    }

    fn send(&mut self, kind: RayKind, (coefficient, density): (Vec3, f32), beam: PathState<ScalarWidth>) {
        let is_rough = self.at.is_some_and(|at| at.bsdf.rough);
        self.sent.push(SentPath { beam, kind, coefficient, density: is_rough.then_some(density) });
    }
}

impl SecondaryRays<ScalarWidth> for PathRecorder<'_> {
    fn reflected(&mut self, beam: PathState<ScalarWidth>) {
        self.send(RayKind::Reflected, (self.reflected, self.reflected_pdf), beam);
    }

    fn refracted(&mut self, beam: PathState<ScalarWidth>) {
        self.has_refracted = true;
        self.send(RayKind::Refracted, (self.through_last, self.through_pdf), beam);
    }
}

impl PathObserver<ScalarWidth> for PathRecorder<'_> {
    fn on_hit(
        &mut self,
        _: ScalarWidth,
        _: &PathState<ScalarWidth>,
        _: bool,
        at: &SurfaceInteraction<ScalarWidth>,
    ) {
        self.at = Some(*at);
    }

    fn on_light(&mut self, light: usize, to_light: Vector<f32>, distance: f32, cosine: f32) {
        let direction = to_light.into();
        self.lights.push(LightTerm { light, direction, distance, cosine, shadow: None, answer: None });
    }

    fn on_shadow_ray(
        &mut self,
        rays: &RayPacket<ScalarWidth>,
        distance: f32,
        inside: &BodyMembership,
        through: &Transmittance<ScalarWidth>,
    ) {
        let geometry = &self.scene.geometry;
        // With the whole that a part belongs to, and whether that is left.
        let mut hits: Vec<(HitRecord, RayOrigin)> = Vec::new();
        RayQuery::new(ScalarWidth, &self.scene.geometry, rays, true, inside, Candidates::All)
            .crossings(distance, |hit| hits.push((hit, geometry.joined.whole_of(hit.body, hit.leaving))));
        hits.sort_by(|(a, of_a), (b, of_b)| {
            let order = || geometry.scene_order(a.body, b.body);
            a.t.total_cmp(&b.t).then(of_b.inwards.cmp(&of_a.inwards)).then_with(order)
        });
        let mut media = self.media.clone();
        // Rays that start outwards have left the body that they start from.
        let RayOrigin { body, inwards } = RayOrigin::of_word(rays.start);
        let start = geometry.joined.whole_of(body, inwards);
        media.retain(|&body| start.inwards || start.body != body);
        let mut from = 0.0;
        let mut left_until = |until: f32, media: &[u32]| {
            let way = (until - std::mem::replace(&mut from, until)).max(0.0);
            let material = media.last().map(|&body| self.scene.material(self.scene.geometry.body(body)));
            material.map_or(Vec3::ONE, |material| material.left_after(way).into())
        };
        let contacts = self.shadow_contacts(rays, inside, &hits);
        let mut crossings = Vec::new();
        for ((hit, RayOrigin { body: whole, inwards: leaving }), contact) in hits.into_iter().zip(contacts) {
            let mut filter = None;
            if !self.scene.geometry.body(hit.body).stops_light() {
                let own = Vec3::from(filter_of(self.scene, hit.body, contact));
                filter = Some(own * left_until(hit.t, &media));
                media.retain(|&other| other != whole);
                if !leaving {
                    media.push(whole);
                }
            }
            let into = match contact {
                ShadowContact::None => None,
                ShadowContact::Into(other) => self.scene.scene_index(other),
                ShadowContact::Behind => continue,
            };
            let part = self.scene.geometry.part(hit.body);
            let Some(body) = self.scene.scene_index(hit.body) else { continue };
            crossings.push(ShadowCrossing { body, part, distance: hit.t, leaving, filter, into });
        }
        let through_last = left_until(distance, &media);
        if let Some(term) = self.lights.last_mut() {
            term.shadow = Some(ShadowRecord {
                passed: through.shares(ScalarWidth).into(),
                crossings,
                through: through_last,
            });
        }
    }

    fn on_light_answer(
        &mut self,
        _lit: bool,
        power: Vector<f32>,
        _through: &Transmittance<ScalarWidth>,
        (value, light): (&BsdfValue<ScalarWidth>, Vector<f32>),
    ) {
        let Some((at, term)) = self.at.zip(self.lights.last_mut()) else { return };
        let highlight_cosine = match at.bsdf.glossy {
            true => highlight_cosine(self.to_viewer, term.direction.into(), at.bsdf.normal),
            false => f32::NAN,
        };
        term.answer = Some(LightContribution {
            power: power.into(),
            diffuse: value.diffuse.into(),
            highlight_cosine,
            highlight: value.highlight,
            glints: value.microfacets.into(),
            light: light.into(),
        });
    }

    fn on_local_light(&mut self, local: Vector<f32>) {
        self.local = Some(local);
    }

    fn on_interface(&mut self, crossed: InterfaceCrossing<ScalarWidth>) {
        self.crossing = Some(crossed);
    }

    fn on_refraction(&mut self, coefficients: Vector<f32>, pdf: f32) {
        self.through_pdf = pdf;
        self.through_last = coefficients.into();
        self.through_all += self.through_last;
    }

    fn on_reflection(&mut self, coefficients: Vector<f32>, pdf: f32) {
        self.reflected_pdf = pdf;
        self.reflected = coefficients.into();
    }

    fn on_medium(&mut self, through: Vector<f32>) {
        self.through = through;
    }
}

impl<'a> WhittedIntegrator<'a> {
    /// The tree of rays that grows from `primary`, at most `limit` of them: each ray after its parent, the reflected
    /// branch of a hit before the refracted one. The sum of all [`RayRecord::light`] is what reaches the start.
    ///
    /// A tree of glass bodies doubles with every generation, hence the limit: the heaviest rays are followed first, and
    /// what was not followed is marked [`BranchOutcome::LeftOut`]. The tree ends early, too, when it is cancelled.
    pub fn tree(&mut self, primary: Ray, limit: usize) -> Vec<RayRecord> {
        let root = self.root(&primary);
        self.grow(root, limit)
    }

    /// The [`tree`](Self::tree) of a ray with the random numbers of one sample of a pixel (column, row): for points of soft
    /// lights, facets of rough surfaces, and wavelengths.
    pub fn tree_of_sample(
        &mut self,
        primary: Ray,
        pixel: UVec2,
        sample: u32,
        limit: usize,
    ) -> Vec<RayRecord> {
        self.shading.trim_media();
        self.shading.begin_sample(sample, Sampler::of_pixel(sample, pixel));
        self.tree(primary, limit)
    }

    /// The tree of rays of one sample of a pixel (column, row) of a picture of `size` pixels, as [`tree`](Self::tree).
    /// It is the tree that [`render`](crate::render()) has there, bit by bit: its rays are the same, as are the numbers on
    /// each. Only the order is another in which light is added up.
    ///
    /// A pixel that is not in the picture has no rays.
    pub fn pixel_tree(&mut self, pixel: UVec2, size: UVec2, sample: u32, limit: usize) -> Vec<RayRecord> {
        if pixel.x >= size.x || pixel.y >= size.y {
            return Vec::new();
        }
        self.shading.trim_media();
        self.shading.begin_sample(sample, Sampler::of_pixel(sample, pixel));
        let ray = TileRect::around(pixel, size, TILE).ray(self.shading.camera, (pixel, size), sample);
        let root = self.started_path(ray);
        let mut tree = self.grow(root, limit);
        if let Some(primary) = tree.first_mut() {
            let Ray { origin, direction, .. } = primary.ray;
            let from_eye = origin.as_dvec3() - self.shading.camera.position();
            primary.start_distance = from_eye.dot(direction.as_dvec3()).max(0.0);
        }
        tree
    }

    fn grow(&mut self, root: PathState<ScalarWidth>, limit: usize) -> Vec<RayRecord> {
        let mut waiting = BinaryHeap::new();
        let sent = SentPath { beam: root, kind: RayKind::Primary, coefficient: Vec3::ONE, density: None };
        waiting.push(QueuedPath { sent, parent: None, number: 0 });
        let mut tree: Vec<RayRecord> = Vec::new();
        let mut number = 1;
        while tree.len() < limit
            && let Some(QueuedPath { sent, parent, .. }) = waiting.pop()
        {
            if self.is_cancelled_at(tree.len()) {
                break;
            }
            let place = tree.len();
            let mut scribe = PathRecorder::new(self.shading.scene, &self.shading.media, &sent.beam);
            let followed =
                self.li::<ScalarWidth, true>(ScalarWidth, &sent.beam, PacketSource::Anywhere, &mut scribe);
            for sent in scribe.sent.drain(..) {
                waiting.push(QueuedPath { sent, parent: Some(place), number });
                number += 1;
            }
            tree.push(self.write_down(&sent, parent, &followed, scribe));
        }
        in_depth_first_order(tree)
    }

    /// Whether a look at the cancel flag is due, and it is set.
    pub(crate) fn is_cancelled_at(&self, done: usize) -> bool {
        done > 0
            && done.is_multiple_of(Self::CANCEL_INTERVAL as usize)
            && self.cancel.load(std::sync::atomic::Ordering::Relaxed)
    }

    fn write_down(
        &mut self,
        sent: &SentPath,
        parent: Option<usize>,
        followed: &PacketRadiance<ScalarWidth>,
        scribe: PathRecorder<'_>,
    ) -> RayRecord {
        let SentPath { ref beam, kind, coefficient, density } = *sent;
        let ray = beam.rays.ray();
        let bodies = self.shading.media.bodies(beam.media);
        let media = bodies.filter_map(|body| self.shading.scene.scene_index(body)).collect();
        RayRecord {
            ray,
            origin: self.shading.scene.world_from_render(ray.origin),
            kind,
            parent,
            generation: beam.generation,
            wavelength: self
                .shading
                .media
                .wave(beam.media)
                .and_then(|wave| self.shading.waves.nanometers(wave)),
            coefficient,
            density,
            start_distance: 0.0,
            weight: beam.weight.into(),
            through: scribe.through.into(),
            light: followed.light.into(),
            local: scribe.local.unwrap_or_else(|| self.shading.scene.sky.along(beam.rays.direction)).into(),
            media,
            ior: self.shading.media.ior(self.shading.scene, &self.shading.waves, beam.media),
            hit: found_in(&followed.hits).and_then(|hit| RayIntersection::new(self.shading.scene, &ray, hit)),
            answer: scribe.at.map(|at| self.answer(beam, &at, scribe)),
        }
    }

    fn answer(
        &mut self,
        beam: &PathState<ScalarWidth>,
        at: &SurfaceInteraction<ScalarWidth>,
        scribe: PathRecorder<'_>,
    ) -> SurfaceRecord {
        let is_last = beam.generation >= self.generations;
        let beyond = if is_last { Some(self.growth_beyond(beam, at)) } else { None };
        let grown = beyond.as_ref().unwrap_or(&scribe);
        let interface = grown.crossing.map(|InterfaceCrossing { ratio, passes }| {
            let (_, beyond) =
                self.shading.cross_interface::<ScalarWidth, true>(ScalarWidth, beam.media, at, true);
            let ior_beyond = self.shading.media.ior(self.shading.scene, &self.shading.waves, beyond);
            InterfaceRecord {
                ior_beyond,
                ratio,
                is_total: !passes,
                contact: self.contact(beam.media, at, beyond),
            }
        });
        let is_seamless =
            interface.and_then(|interface| interface.contact).is_some_and(|contact| contact.is_seamless);
        let unless_seamless = |coefficient: f32| if is_seamless { 0.0 } else { coefficient };
        let is_total = interface.is_some_and(|interface| interface.is_total);
        let weight = beam.weight.times(scribe.through);
        let reflected = self.branch(weight, grown.reflected, is_last);
        // What goes straight on does so at the limit, too.
        let mut refracted = self.branch(weight, grown.through_all, is_last && !scribe.has_refracted);
        if is_total {
            refracted.fate = BranchOutcome::TotalReflection;
        }
        let body = self.shading.scene.geometry.body(at.bsdf.body);
        let material = self.shading.scene.material(body);
        let line = (beam.rays.origin, beam.rays.direction);
        let point = self.shading.scene.geometry.surface_point(at.bsdf.body, line, at.t, at.bsdf.inside);
        let solids = SolidNode::row_at(&self.shading.scene.solids, body.solid);
        let point_of_solid = point.on_solid(body);
        let own = material.color_at(ScalarWidth, body, point.in_body, true);
        let color = patterned(ScalarWidth, solids, 0, own, point_of_solid);
        SurfaceRecord {
            color: color.into(),
            second_share: solids.first().map(|solid| solid.share(point_of_solid)),
            law: material.law.name(),
            alpha: unless_seamless(material.alpha),
            ambient_coefficient: unless_seamless(material.ambient),
            ambient_light: self.shading.scene.ambient.into(),
            ambient: at.bsdf.ambient.into(),
            diffuse_coefficient: unless_seamless(material.diffuse),
            specular_coefficient: unless_seamless(material.specular),
            shininess: material.shininess,
            lights: scribe.lights,
            interface,
            reflected,
            refracted,
        }
    }

    /// The cemented contact of a ray in `media`, if it has come to one.
    fn contact(
        &self,
        media: u32,
        at: &SurfaceInteraction<ScalarWidth>,
        beyond: u32,
    ) -> Option<ContactRecord> {
        let ShadingContext { scene, media: table, waves, .. } = &self.shading;
        if at.contact == NO_START {
            return None;
        }
        let place = |start: u32| scene.scene_index(RayOrigin::of_word(start).body);
        let (own, other) = (place(at.start)?, place(at.contact)?);
        let bodies = if at.bsdf.inside { [own, other] } else { [other, own] };
        Some(ContactRecord { bodies, is_seamless: table.are_alike(scene, waves, media, beyond) })
    }

    /// What would grow from a surface from which no ray goes on any more.
    fn growth_beyond(
        &mut self,
        beam: &PathState<ScalarWidth>,
        at: &SurfaceInteraction<ScalarWidth>,
    ) -> PathRecorder<'a> {
        let counts = self.shading.counts;
        let mut scribe = PathRecorder::new(self.shading.scene, &self.shading.media, beam);
        self.scatter::<ScalarWidth, true>(ScalarWidth, beam, at, true, &mut scribe);
        self.shading.counts = counts;
        scribe
    }

    /// A branch before it is known which ray it is: one that is followed counts as left out.
    fn branch(&self, weight: Vector<f32>, coefficient: Vec3, is_last: bool) -> BranchRecord {
        let weight = weight.times(coefficient.into()).bounded();
        let fate = match self.is_above_threshold(ScalarWidth, weight) {
            true if is_last => BranchOutcome::GenerationLimit,
            true => BranchOutcome::LeftOut,
            false if weight.largest() > 0.0 => BranchOutcome::Threshold,
            false => BranchOutcome::Nothing,
        };
        BranchRecord { coefficient, weight: weight.into(), fate }
    }
}

fn fate_of(answer: &mut SurfaceRecord, kind: RayKind) -> &mut BranchOutcome {
    match kind {
        RayKind::Refracted => &mut answer.refracted.fate,
        _ => &mut answer.reflected.fate,
    }
}

/// Puts a tree in order: each ray after its parent, the whole reflected branch of a hit before the refracted ones; tells
/// parents which rays follow them.
fn in_depth_first_order(tree: Vec<RayRecord>) -> Vec<RayRecord> {
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); tree.len()];
    for (place, ray) in tree.iter().enumerate() {
        if let Some(siblings) = ray.parent.and_then(|parent| children.get_mut(parent)) {
            siblings.push(place);
        }
    }
    let mut rays: Vec<Option<RayRecord>> = tree.into_iter().map(Some).collect();
    let mut ordered: Vec<RayRecord> = Vec::with_capacity(rays.len());
    let mut pending = vec![(0, None::<usize>)];
    while let Some((old, parent)) = pending.pop() {
        let Some(mut ray) = rays.get_mut(old).and_then(Option::take) else { continue };
        let place = ordered.len();
        ray.parent = parent;
        if let Some(answer) = parent.and_then(|parent| ordered.get_mut(parent)?.answer.as_mut()) {
            // Of the waves of split light the first one stands for all.
            let fate = fate_of(answer, ray.kind);
            if !matches!(fate, BranchOutcome::Followed(_)) {
                *fate = BranchOutcome::Followed(place);
            }
        }
        let mut own = children.get_mut(old).map(std::mem::take).unwrap_or_default();
        // The last one is taken first.
        own.sort_by(|&a, &b| {
            let key = |place: usize| {
                let ray = rays.get(place).and_then(Option::as_ref);
                ray.map_or((false, 0.0), |ray| {
                    (ray.kind == RayKind::Refracted, ray.wavelength.unwrap_or(0.0))
                })
            };
            key(b).0.cmp(&key(a).0).then(key(b).1.total_cmp(&key(a).1))
        });
        pending.extend(own.into_iter().map(|child| (child, Some(place))));
        ordered.push(ray);
    }
    ordered
}
