//! Rough surfaces in the tree: one facet of each is looked at in every sample.

use super::beams::PathState;
use super::encounter::SurfaceInteraction;
use super::{SampleDimension, WhittedIntegrator};
use crate::facets::{seen_facet, sent_on, sent_through, unhidden};
use crate::lanes::{Float as _, Mask as _, Width};
use crate::surface::fresnel;
use crate::vector::Vector;

/// The surface that facets make up.
#[derive(Clone, Copy)]
pub(super) struct Macrosurface<W: Width> {
    normal: Vector<W::R>,
    alpha: W::R,
    rough: W::M,
}

impl<W: Width> Macrosurface<W> {
    /// What is left of the weight of rays that a facet sends this way, and which of them fly: none into the surface that
    /// they should leave, or out of the one that they should enter.
    #[inline(always)]
    pub(super) fn let_off(
        &self,
        direction: Vector<W::R>,
        is_beyond: bool,
        weight: Vector<W::R>,
    ) -> (Vector<W::R>, W::M) {
        let cos = self.normal.dot(direction);
        let cos = if is_beyond { -cos } else { cos };
        let flies = cos.gt(cos.like(0.0));
        let seen = W::R::select(self.rough, unhidden(cos, self.alpha), cos.like(1.0));
        (weight * seen, flies | !self.rough)
    }
}

impl WhittedIntegrator<'_> {
    /// The same points, with those on rough surfaces seen as the facets that rays meet there, and what the facets make up.
    #[inline(never)]
    pub(super) fn on_facets<W: Width>(
        &self,
        w: W,
        beams: &PathState<W>,
        at: &SurfaceInteraction<W>,
    ) -> (SurfaceInteraction<W>, Macrosurface<W>) {
        let throw = self.dice.throw(w, self.stage, beams, at.body, SampleDimension::Facet);
        w.run(
            #[inline(always)]
            || {
                let direction = beams.rays.direction;
                let facet = seen_facet(direction, at.normal, at.alpha, &throw);
                let ground = Macrosurface { normal: at.normal, alpha: at.alpha, rough: at.rough };
                let mut on = *at;
                on.normal = Vector::select(at.rough, facet, at.normal);
                on.tilt(w, self.stage, direction);
                (on, ground)
            },
        )
    }

    /// What rough surfaces send on of a light in this direction, for each unit of its power; nothing from smooth ones.
    #[inline(never)]
    pub(super) fn glints<W: Width>(
        &mut self,
        w: W,
        beams: &PathState<W>,
        at: &SurfaceInteraction<W>,
        to_light: Vector<W::R>,
    ) -> Vector<W::R> {
        let clear = at.rough & at.clear;
        let ratio = if clear.any() { self.cross(w, beams.media, at.body, clear).0 } else { w.real(1.0) };
        w.run(
            #[inline(always)]
            || {
                let (zero, one) = (w.real(0.0), w.real(1.0));
                let to_viewer = -beams.rays.direction;
                let half = (to_viewer + to_light).normalize_or(at.normal);
                let mut facets = *at;
                facets.normal = half;
                facets.tilt(w, self.stage, beams.rays.direction);
                let mut reflection = facets.reflection;
                if clear.any() {
                    let cos = half.dot(to_viewer).min(one).max(zero);
                    reflection = W::R::select(clear, fresnel(cos, ratio), reflection);
                }
                let sent = sent_on(to_viewer, to_light, at.normal, half, at.alpha);
                let sent = W::R::select(at.rough, sent, zero);
                let mut glints = facets.reflected(reflection) * sent;
                let within = at.frosted_within();
                if within.any() {
                    let (sent, cos) = sent_through(to_viewer, to_light, at.normal, ratio, at.alpha);
                    let sent = sent * (one - fresnel(cos, ratio));
                    glints = Vector::select(within, Vector::new(sent, sent, sent), glints);
                }
                // With the power of a light, their product is finite.
                glints.bounded()
            },
        )
    }
}
