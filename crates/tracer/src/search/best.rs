//! The nearest hits so far.

use super::{Hits, Meeting};
use crate::lanes::{Float as _, MOST_LANES, Mask as _, Width, Word as _};
use crate::ray::POINT_ROUNDING;
use crate::stage::Stage;

/// Hits that coincide may lie so many times the bound of rounding apart along a ray: it is a bound across the surface, which
/// the ray may graze. Rounding is far less than its bound, so that more than a thousandfold is allowed for.
pub(crate) const GRAZING: f32 = 64.0;

/// The nearest hits so far of one direction through the surface.
#[derive(Clone, Copy)]
pub(super) struct Nearest<W: Width> {
    pub(super) t: W::R,
    pub(super) body: W::W,
    pub(super) face: W::R,
    /// [`GRAZING`] times its slack before the nearest hit.
    pub(super) own: W::R,
    /// The least parameter that is so much before any other hit.
    pub(super) others: W::R,
}

/// The nearest hits so far: those that lead out of a body and those that lead in, each by themselves, so that the
/// outcome does not depend on the order in which bodies are tested.
pub(super) struct Best<W: Width> {
    pub(super) leaving: Nearest<W>,
    pub(super) entering: Nearest<W>,
    /// No body beyond this parameter can change the outcome any more; finite.
    pub(super) reach: W::R,
    pub(super) start_slack: W::R,
}

impl<W: Width> Best<W> {
    #[inline(always)]
    pub(super) fn new(w: W, start_slack: W::R) -> Self {
        let (infinity, zero) = (w.real(f32::INFINITY), w.real(0.0));
        let none = || Nearest { t: infinity, body: w.word(0), face: zero, own: infinity, others: infinity };
        Self { leaving: none(), entering: none(), reach: w.real(f32::MAX), start_slack }
    }

    /// Takes note of hits that lead into a body.
    #[inline(always)]
    pub(super) fn enter(&mut self, w: W, stage: &Stage, index: u32, meeting: &Meeting<W>) {
        self.entering.offer(w, stage, index, (meeting.enter, meeting.enter_face), meeting.entering);
        self.shorten(w, stage, self.entering.t);
    }

    /// Takes note of hits that lead out of a body.
    #[inline(always)]
    pub(super) fn leave(&mut self, w: W, stage: &Stage, index: u32, meeting: &Meeting<W>) {
        self.leaving.offer(w, stage, index, (meeting.exit, meeting.exit_face), meeting.leaving);
        self.shorten(w, stage, self.leaving.t);
    }

    /// Bodies that may coincide with a hit at `t` have to be seen, those behind need not.
    #[inline(always)]
    fn shorten(&mut self, w: W, stage: &Stage, t: W::R) {
        self.reach = self.reach.min(t + self.slack_at(t, w.real(stage.largest_slack)) * GRAZING);
    }

    /// The rays whose nearest hit in one direction through the surface may coincide with another.
    #[inline(always)]
    pub(super) fn contested(&self, w: W, nearest: &Nearest<W>) -> W::M {
        let t = nearest.t;
        let until = t + (t - nearest.own) + self.slack_at(t, w.real(0.0)) * GRAZING;
        nearest.others.le(until) & t.lt(w.real(f32::INFINITY))
    }

    /// How far apart by rounding two hits at about `t` can lie that should coincide, of bodies whose larger slack is
    /// this: each slack is twice its bound, so the larger one covers both.
    #[inline(always)]
    fn slack_at(&self, t: W::R, larger: W::R) -> W::R {
        t.times_plus(t.like(POINT_ROUNDING), self.start_slack + larger)
    }

    /// The first hits. Of hits that coincide within rounding, the one that leads out comes before the one that leads in:
    /// bodies that touch have a film of air between them.
    #[inline(always)]
    pub(super) fn first(&self, w: W, stage: &Stage) -> Hits<W> {
        let infinity = w.real(f32::INFINITY);
        let Nearest { t, body, face, .. } = self.entering;
        let leaves = self.leaving.t.lt(infinity);
        let mut hits: Hits<W> =
            Hits { t, body, leaving: leaves & !leaves, face, hit: t.lt(infinity) | leaves };
        if leaves.any() {
            let out = self.leaving.t;
            let surely = leaves & out.le(t + self.slack_at(t, w.real(0.0)));
            let perhaps = leaves & out.le(t + self.slack_at(t, w.real(stage.largest_slack)));
            hits.leaving = surely;
            if (perhaps & !surely).any() {
                let larger = larger_slack(w, stage, body, self.leaving.body);
                hits.leaving = leaves & out.le(t + self.slack_at(t, larger));
            }
            hits.t = W::R::select(hits.leaving, self.leaving.t, t);
            hits.face = W::R::select(hits.leaving, self.leaving.face, face);
            hits.body = W::W::select(hits.leaving, self.leaving.body, body);
        }
        hits
    }
}

impl<W: Width> Nearest<W> {
    /// Takes note of hits; of equal ones the body that comes first in the scene counts.
    #[inline(always)]
    fn offer(&mut self, w: W, stage: &Stage, index: u32, (t, face): (W::R, W::R), lanes: W::M) {
        let mut closer = lanes & t.lt(self.t);
        let equal = lanes & t.eq(self.t) & t.lt(w.real(f32::INFINITY));
        if equal.any() {
            closer = closer | w.mask(equal.bits() & later_than::<W>(stage, index, self.body));
        }
        let own = t - GRAZING * stage.body(index).slack;
        let loser = W::R::select(closer, self.own, W::R::select(lanes, own, self.others));
        self.others = self.others.min(loser);
        self.own = W::R::select(closer, own, self.own);
        self.t = W::R::select(closer, t, self.t);
        self.body = W::W::select(closer, w.word(index), self.body);
        self.face = W::R::select(closer, face, self.face);
    }
}

/// The larger slack of two bodies.
#[cold]
#[inline(never)]
fn larger_slack<W: Width>(w: W, stage: &Stage, one: W::W, other: W::W) -> W::R {
    let (mut ones, mut others) = ([0; MOST_LANES], [0; MOST_LANES]);
    one.store(&mut ones);
    other.store(&mut others);
    let mut slacks = [0.0; MOST_LANES];
    for (slack, (&one, &other)) in slacks.iter_mut().zip(ones.iter().zip(&others)) {
        *slack = stage.body(one).slack.max(stage.body(other).slack);
    }
    w.load(&slacks)
}

/// Where a body of the scene behind body `index` has been met.
#[cold]
#[inline(never)]
fn later_than<W: Width>(stage: &Stage, index: u32, met: W::W) -> u32 {
    let mut bodies = [0; MOST_LANES];
    met.store(&mut bodies);
    let lanes = bodies.iter().take(W::LANES).enumerate();
    lanes.fold(0, |later, (lane, &old)| later | u32::from(stage.scene_order(index, old).is_lt()) << lane)
}
