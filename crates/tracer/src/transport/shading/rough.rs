//! Rough surfaces in the tree: one facet of each is looked at in every sample.

use crate::simd::vector::Vector;
use crate::simd::{Float as _, Mask as _, Width};
use crate::transport::interaction::SurfaceInteraction;
use crate::transport::path::PathState;
use crate::transport::sampler::SampleDimension;
use crate::transport::shading::ShadingContext;
use crate::transport::surface::fresnel;
use crate::transport::surface::microfacet::{
    reflected_density, sample_visible_normal, smith_g1, transmitted_density,
};

/// The surface that facets make up.
#[derive(Clone, Copy)]
pub(crate) struct Macrosurface<W: Width> {
    normal: Vector<W::R>,
    alpha: W::R,
    rough: W::M,
}

impl<W: Width> Macrosurface<W> {
    /// What is left of the weight of rays that a facet sends this way, and which of them fly: none into the surface that
    /// they should leave, or out of the one that they should enter.
    #[inline(always)]
    pub(crate) fn masking(
        &self,
        direction: Vector<W::R>,
        is_beyond: bool,
        weight: Vector<W::R>,
    ) -> (Vector<W::R>, W::M) {
        let cos = self.normal.dot(direction);
        let cos = if is_beyond { -cos } else { cos };
        let flies = cos.gt(cos.like(0.0));
        let seen = W::R::select(self.rough, smith_g1(cos, self.alpha), cos.like(1.0));
        (weight * seen, flies | !self.rough)
    }
}

impl ShadingContext<'_> {
    /// These points, with those on rough surfaces seen as the facets that rays meet there, and what the facets make up.
    #[inline(never)]
    pub(crate) fn sample_microfacet<W: Width>(
        &self,
        w: W,
        paths: &PathState<W>,
        at: &SurfaceInteraction<W>,
    ) -> (SurfaceInteraction<W>, Macrosurface<W>) {
        let sample = self.sampler.sample_2d(w, self.scene, paths, at.body, SampleDimension::Facet);
        w.run(
            #[inline(always)]
            || {
                let direction = paths.rays.direction;
                let facet = sample_visible_normal(direction, at.normal, at.alpha, &sample);
                let macrosurface = Macrosurface { normal: at.normal, alpha: at.alpha, rough: at.rough };
                let mut on = *at;
                on.normal = Vector::select(at.rough, facet, at.normal);
                on.set_microfacet_normal(w, self.scene, direction);
                (on, macrosurface)
            },
        )
    }

    /// What rough surfaces send on of a light in this direction, for each unit of its power; nothing from smooth ones.
    #[inline(never)]
    pub(crate) fn eval_microfacets<W: Width>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        at: &SurfaceInteraction<W>,
        to_light: Vector<W::R>,
    ) -> Vector<W::R> {
        let clear = at.rough & at.clear;
        let ratio =
            if clear.any() { self.cross_interface(w, paths.media, at.body, clear).0 } else { w.real(1.0) };
        w.run(
            #[inline(always)]
            || {
                let (zero, one) = (w.real(0.0), w.real(1.0));
                let to_viewer = -paths.rays.direction;
                let half = (to_viewer + to_light).normalize_or(at.normal);
                let mut facets = *at;
                facets.normal = half;
                facets.set_microfacet_normal(w, self.scene, paths.rays.direction);
                let mut reflection = facets.reflection;
                if clear.any() {
                    let cos = half.dot(to_viewer).min(one).max(zero);
                    reflection = W::R::select(clear, fresnel(cos, ratio), reflection);
                }
                let sent = reflected_density(to_viewer, to_light, at.normal, half, at.alpha);
                let sent = W::R::select(at.rough, sent, zero);
                let mut glints = facets.reflected(reflection) * sent;
                let within = at.rough_interior();
                if within.any() {
                    let (sent, cos) = transmitted_density(to_viewer, to_light, at.normal, ratio, at.alpha);
                    let sent = sent * (one - fresnel(cos, ratio));
                    glints = Vector::select(within, Vector::new(sent, sent, sent), glints);
                }
                // With the power of a light, their product is finite.
                glints.bounded()
            },
        )
    }
}
