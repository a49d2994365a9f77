//! The same for rays by the thousand.

use std::ops::Range;

use bytemuck::{Zeroable, zeroed_box};

use super::best::{margin, reach_for};
use super::{
    Candidates, ClosestHit, ClosestHits, MediumIntervals, PacketHits, RayQuery, Transmittance, all_of,
};
use crate::lanes::{Float as _, Float32 as _, MOST_LANES, Mask as _, ScalarWidth, Width};
use crate::media::{BodyMembership, MediumStacks};
use crate::ray::{POINT_ROUNDING, RayPacket};
use crate::stage::{
    Accelerator, RenderScene, STREAM, StreamRayRows, StreamRow, StreamTraversalStack, StreamVisitor,
    vector_at,
};
use crate::vector::Vector;

/// Rays that are searched for together, and what they met.
#[derive(Debug, Zeroable)]
pub(crate) struct RayStream {
    rays: StreamRayRows,
    entering: ClosestHitRows,
    leaving: ClosestHitRows,
    count: usize,
}

/// The nearest hits so far of one direction through the surface.
#[derive(Debug, Zeroable)]
struct ClosestHitRows {
    t: StreamRow<f32>,
    body: StreamRow<u32>,
    face: StreamRow<f32>,
    /// The parameters of the hits after them.
    second: StreamRow<f32>,
}

/// Shadow rays of a stream's hits to one light.
#[derive(Debug, Zeroable)]
pub(crate) struct ShadowStream {
    /// Of those that are blocked, the reach is -∞.
    rays: StreamRayRows,
    /// What the bodies between let through.
    share: StreamRow<[f32; 4]>,
    /// What the media leave, planes among them; meaningless where nothing absorbs.
    left: StreamRow<[f32; 4]>,
    /// What the surface sends on if nothing is between.
    answer: StreamRow<[f32; 4]>,
    count: usize,
    is_empty: bool,
}

/// Working memory.
#[derive(Debug, Default)]
pub(crate) struct StreamScratch {
    parts: StreamTraversalStack,
    inside: BodyMembership,
    intervals: MediumIntervals,
}

impl ClosestHitRows {
    #[inline(always)]
    fn load<W: Width>(&self, w: W, at: usize) -> ClosestHit<W> {
        ClosestHit {
            t: w.load(&self.t[at..]),
            body: w.load_words(&self.body[at..]),
            face: w.load(&self.face[at..]),
            second: w.load(&self.second[at..]),
        }
    }
}

impl RayStream {
    /// Forgets all rays.
    pub(crate) fn begin(&mut self) {
        self.count = 0;
    }

    /// Adds rays; all but the last ones of a stream fill the vectors.
    #[inline(always)]
    pub(crate) fn push<W: Width>(&mut self, w: W, rays: &RayPacket<W>, media: W::W, lanes: W::M) {
        let never = w.real(f32::INFINITY);
        self.rays.set(w, self.count, rays, media, never);
        for nearest in [&mut self.entering, &mut self.leaving] {
            never.store(&mut nearest.t[self.count..]);
            never.store(&mut nearest.second[self.count..]);
        }
        self.count += lanes.bits().count_ones() as usize;
    }

    /// The number of rays.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Looks for the nearest of the bounded bodies that each ray meets.
    pub(crate) fn search<W: Width>(
        &mut self,
        w: W,
        stage: &RenderScene,
        table: &MediumStacks,
        memory: &mut StreamScratch,
    ) {
        let Accelerator::Many(bvh) = &stage.hierarchy else { return };
        let StreamScratch { parts, inside, .. } = memory;
        let count = self.count;
        let mut visitor = ClosestHitVisitor { w, stage, table, inside, stream: self };
        w.run(
            #[inline(always)]
            || bvh.traverse_stream(w, parts, count, stage.parts_streams(), &mut visitor),
        );
    }

    /// What the rays from number `at` on, which are in `flight`, met, planes included.
    #[inline(always)]
    pub(crate) fn hits<W: Width>(&self, w: W, at: usize, flight: &RayQuery<'_, W>) -> PacketHits<W> {
        let (_, reach) = self.rays.load(w, at);
        let (leaving, entering) = (self.leaving.load(w, at), self.entering.load(w, at));
        let start_slack = flight.start_slack();
        let margin = margin(flight.stage, start_slack);
        let mut best = ClosestHits { leaving, entering, reach, start_slack, margin };
        for index in flight.stage.planes() {
            flight.test(index, flight.stage.body(index), flight.lanes, &mut best);
        }
        let hits = best.first(w, flight.stage, flight.lanes);
        hits.settled(w, flight.stage, &flight.rays(), flight.inside)
    }
}

impl ShadowStream {
    /// One for at most so many rays.
    #[cold]
    pub(crate) fn of(count: usize) -> Box<Self> {
        let mut shadows: Box<Self> = zeroed_box();
        shadows.begin(count);
        shadows
    }

    /// Forgets all rays; at most the first `count` will be [put](Self::put).
    pub(crate) fn begin(&mut self, count: usize) {
        (self.count, self.is_empty) = (count, true);
        self.rays.block(count);
    }

    /// Whether there are any.
    pub(crate) fn is_empty(&self) -> bool {
        self.is_empty
    }

    /// Adds the rays `lanes` as those from number `at` on, with what they bring if nothing is between.
    #[inline(always)]
    pub(crate) fn put<W: Width>(
        &mut self,
        w: W,
        at: usize,
        rays: &RayPacket<W>,
        (media, distance): (W::W, W::R),
        answer: Vector<W::R>,
        lanes: W::M,
    ) {
        // A body that touches the light does not hide it.
        let reach = distance * (1.0 - POINT_ROUNDING);
        let reach = W::R::select(lanes, reach, w.real(f32::NEG_INFINITY));
        self.rays.set(w, at, rays, media, reach);
        let (zero, one) = (w.real(0.0), w.real(1.0));
        w.store_fours([answer.x, answer.y, answer.z, zero], &mut self.answer[at..]);
        w.store_fours([one, one, one, zero], &mut self.share[at..]);
        self.is_empty = false;
    }

    /// Looks for the bounded bodies between.
    pub(crate) fn search<W: Width>(
        &mut self,
        w: W,
        stage: &RenderScene,
        table: &MediumStacks,
        memory: &mut StreamScratch,
    ) {
        let Accelerator::Many(bvh) = &stage.hierarchy else { return };
        let Self { rays, share, count, .. } = self;
        let StreamScratch { parts, inside, intervals } = memory;
        let mut visitor = TransmittanceVisitor { w, stage, table, inside, intervals, rays, share };
        w.run(
            #[inline(always)]
            || bvh.traverse_stream(w, parts, *count, stage.parts_streams(), &mut visitor),
        );
        if stage.absorbs {
            self.absorb(w, stage, table, memory);
        }
    }

    /// Finds what the media leave of the light of each ray, once it is known which bounded ones it goes through.
    #[cold]
    #[inline(never)]
    fn absorb<W: Width>(
        &mut self,
        w: W,
        stage: &RenderScene,
        table: &MediumStacks,
        memory: &mut StreamScratch,
    ) {
        let StreamScratch { inside, intervals, .. } = memory;
        let Self { rays: stream, left, count, .. } = self;
        left.iter_mut().take(*count).for_each(|left| *left = [1.0; 4]);
        w.run(
            #[inline(always)]
            || {
                for at in (0..*count).step_by(W::LANES) {
                    let (rays, reach) = stream.load(w, at);
                    let lanes = w.first(*count - at) & reach.gt(w.real(f32::NEG_INFINITY));
                    inside.fill::<W>(table, stream.media(w, at), lanes);
                    let first = intervals.len();
                    let flight = RayQuery::new(w, stage, &rays, lanes, inside, Candidates::All);
                    for index in stage.planes() {
                        flight.note_medium(index, stage.body(index), reach, lanes, intervals);
                    }
                    let numbers: [u32; MOST_LANES] = std::array::from_fn(|lane| (at + lane) as u32);
                    intervals.name_rays(first, &numbers);
                }
            },
        );
        intervals.each_left(
            stage,
            table,
            |ray| stream.media(ScalarWidth, ray as usize % STREAM),
            |ray, Vector { x, y, z }| left[ray as usize % STREAM] = [x, y, z, 1.0],
        );
    }

    /// The rays from number `at` on.
    #[inline(always)]
    pub(crate) fn rays<W: Width>(&self, w: W, at: usize) -> RayPacket<W> {
        self.rays.load(w, at).0
    }

    /// What the rays from number `at` on, which are in `flight`, bring, and which of them bring any.
    #[inline(always)]
    pub(crate) fn brought<W: Width>(
        &self,
        w: W,
        at: usize,
        flight: &RayQuery<'_, W>,
    ) -> (W::M, Vector<W::R>) {
        let (_, reach) = self.rays.load(w, at);
        let lanes = reach.gt(w.real(f32::NEG_INFINITY)) & flight.lanes;
        let share = Some(vector_at(w, &self.share, at));
        let mut passed: Transmittance<W> = Transmittance { lanes, share, blocker: 0 };
        for index in flight.stage.planes() {
            if !passed.lanes.any() {
                break;
            }
            flight.filter(index, flight.stage.body(index), reach, passed.lanes, (&mut passed, None));
        }
        let mut share = passed.share.unwrap_or_else(|| all_of(w));
        if flight.stage.absorbs {
            share = share.times(vector_at(w, &self.left, at));
        }
        (passed.lanes & !share.is_zero(), vector_at(w, &self.answer, at).times(share))
    }
}

/// Shows `take` each of the rays of a vector that is among `lanes`: its place in the vector, and its number.
#[inline(always)]
fn each(lanes: u32, rays: &[u32], mut take: impl FnMut(usize, u32)) {
    let mut bits = lanes;
    while bits != 0 {
        let lane = bits.trailing_zeros() as usize % MOST_LANES;
        bits &= bits - 1;
        take(lane, rays[lane]);
    }
}

/// Looks for the nearest bodies.
struct ClosestHitVisitor<'s, W> {
    w: W,
    stage: &'s RenderScene,
    table: &'s MediumStacks,
    inside: &'s mut BodyMembership,
    stream: &'s mut RayStream,
}

impl<W: Width> StreamVisitor for ClosestHitVisitor<'_, W> {
    const NEAREST_FIRST: bool = true;

    #[inline(always)]
    fn rays(&self) -> &StreamRayRows {
        &self.stream.rays
    }

    #[inline(always)]
    fn fetch(&self, bodies: Range<u32>) {
        self.stage.fetch(bodies);
    }

    #[inline(always)]
    fn leaf(&mut self, bodies: Range<u32>, rays: &[u32], count: usize) {
        let Self { w, stage, .. } = *self;
        for at in (0..count).step_by(W::LANES) {
            let numbers = &rays[at..];
            let lanes = w.first(count - at);
            let (rays, media, reach) = self.stream.rays.gather(w, numbers);
            if stage.has_transparency {
                self.inside.fill::<W>(self.table, media, lanes);
            }
            let flight = RayQuery::new(w, stage, &rays, lanes, self.inside, Candidates::All);
            for index in bodies.clone() {
                let lanes = lanes & flight.comes_near(index, reach);
                if !lanes.any() {
                    continue;
                }
                let body = stage.body(index);
                let Some(meeting) = flight.meets(index, body, lanes) else { continue };
                let entering = meeting.entering & meeting.enter.le(reach);
                let leaving = meeting.leaving & meeting.exit.le(reach);
                let margin = margin(stage, flight.start_slack());
                if entering.any() {
                    let met = (meeting.enter, meeting.enter_face, margin);
                    self.stream.offer::<W>(index, true, met, entering, numbers);
                }
                if leaving.any() {
                    let met = (meeting.exit, meeting.exit_face, margin);
                    self.stream.offer::<W>(index, false, met, leaving, numbers);
                }
            }
        }
    }
}

impl RayStream {
    /// Takes note of hits with a body; see [`ClosestHits`].
    #[inline(always)]
    fn offer<W: Width>(
        &mut self,
        index: u32,
        is_entering: bool,
        (t, face, margin): (W::R, W::R, W::R),
        lanes: W::M,
        numbers: &[u32],
    ) {
        let Self { rays, entering, leaving, .. } = self;
        let nearest = if is_entering { entering } else { leaving };
        let [mut ts, mut faces, mut reaches] = [[0.0; MOST_LANES]; 3];
        t.store(&mut ts);
        face.store(&mut faces);
        reach_for(t, margin).store(&mut reaches);
        each(
            lanes.bits(),
            numbers,
            #[inline(always)]
            |lane, ray| {
                let place = ray as usize % STREAM;
                let (t, old) = (ts[lane], nearest.t[place]);
                if t < old {
                    (nearest.t[place], nearest.body[place]) = (t, index);
                    nearest.face[place] = faces[lane];
                    nearest.second[place] = old;
                    rays.shorten(ray, reaches[lane]);
                } else {
                    nearest.second[place] = nearest.second[place].min(t);
                }
            },
        );
    }
}

/// Looks for what shades.
struct TransmittanceVisitor<'s, W> {
    w: W,
    stage: &'s RenderScene,
    table: &'s MediumStacks,
    inside: &'s mut BodyMembership,
    intervals: &'s mut MediumIntervals,
    rays: &'s mut StreamRayRows,
    share: &'s mut StreamRow<[f32; 4]>,
}

impl<W: Width> StreamVisitor for TransmittanceVisitor<'_, W> {
    const NEAREST_FIRST: bool = false;

    #[inline(always)]
    fn rays(&self) -> &StreamRayRows {
        self.rays
    }

    #[inline(always)]
    fn fetch(&self, bodies: Range<u32>) {
        self.stage.fetch(bodies);
    }

    #[inline(always)]
    fn leaf(&mut self, bodies: Range<u32>, rays: &[u32], count: usize) {
        let Self { w, stage, .. } = *self;
        for at in (0..count).step_by(W::LANES) {
            let numbers = &rays[at..];
            let (rays, media, reach) = self.rays.gather(w, numbers);
            let lanes = w.first(count - at) & reach.gt(w.real(f32::NEG_INFINITY));
            if !lanes.any() {
                continue;
            }
            let mut share = None;
            if stage.has_transparency {
                self.inside.fill::<W>(self.table, media, lanes);
                let [x, y, z, _] = w.gather(self.share, numbers);
                share = Some(Vector::new(x, y, z));
            }
            let flight = RayQuery::new(w, stage, &rays, lanes, self.inside, Candidates::All);
            let mut passed: Transmittance<W> = Transmittance { lanes, share, blocker: 0 };
            let first = self.intervals.len();
            for index in bodies.clone() {
                let lanes = passed.lanes & flight.comes_near(index, reach);
                if lanes.any() {
                    let noted = (&mut passed, Some(&mut *self.intervals));
                    flight.filter(index, stage.body(index), reach, lanes, noted);
                }
            }
            self.intervals.name_rays(first, numbers);
            each(
                (lanes & !passed.lanes).bits(),
                numbers,
                #[inline(always)]
                |_, ray| self.rays.shorten(ray, f32::NEG_INFINITY),
            );
            if let Some(Vector { x, y, z }) = passed.share {
                let mut shares = [[0.0; 4]; MOST_LANES];
                w.store_fours([x, y, z, w.real(0.0)], &mut shares);
                each(passed.lanes.bits(), numbers, |lane, ray| {
                    self.share[ray as usize % STREAM] = shares[lane];
                });
            }
        }
    }
}
