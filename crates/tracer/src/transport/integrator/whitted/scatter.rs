//! The rays that grow from the points that others met.

use crate::geometry::ray::RayPacket;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, MOST_LANES, Mask as _, Width, Word as _};
use crate::transport::integrator::whitted::WhittedIntegrator;
use crate::transport::interaction::SurfaceInteraction;
use crate::transport::media::AIR;
use crate::transport::path::{InterfaceCrossing, PathState, SecondaryRays};
use crate::transport::surface::bsdf::{Bsdf, BsdfDirac, Macrosurface};

/// What is needed to send rays on.
struct ScatterContext<'e, W: Width> {
    at: &'e SurfaceInteraction<W>,
    /// What sends them on: rough surfaces turned to the facet that is seen.
    bsdf: &'e Bsdf<W>,
    /// The surface that the facets make up.
    macrosurface: Option<Macrosurface<W>>,
    /// Their generation.
    next: W::W,
    /// Whether only those go on that are the same ray still.
    is_last: bool,
}

/// What becomes of rays at the surfaces of transparent bodies.
struct DielectricInterface<W: Width> {
    /// The index on the rays' side divided by that on the other.
    ratio: W::R,
    /// The media on the other side.
    beyond: W::W,
    dirac: BsdfDirac<W>,
}

impl WhittedIntegrator<'_> {
    /// Sends the reflected and refracted rays, each if it carries anything.
    #[inline(always)]
    pub(crate) fn scatter<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        at: &SurfaceInteraction<W>,
        goes_on: W::M,
        secondary: &mut impl SecondaryRays<W>,
    ) {
        let next = paths.generation.plus(w.word(1));
        let facets;
        let direction = paths.rays.direction;
        let mut context = ScatterContext { at, bsdf: &at.bsdf, macrosurface: None, next, is_last: false };
        if FULL && at.bsdf.rough.any() {
            let sample = self.shading.facet_sample(w, paths, at);
            let (turned, macrosurface) =
                at.bsdf.sample_facet(w, self.shading.scene.body_materials(), direction, &sample);
            facets = turned;
            (context.bsdf, context.macrosurface) = (&facets, Some(macrosurface));
        }
        let mut reflection = context.reflectance::<FULL>(context.bsdf.reflection);
        let transparent = goes_on & at.bsdf.transparent;
        if transparent.any() {
            reflection = self.refracted::<W, FULL>(w, paths, &context, transparent, secondary);
        }
        let mut lanes = goes_on;
        if FULL {
            let mirrored = context.bsdf.mirrored(direction);
            (reflection, lanes) = context.masking(mirrored, false, reflection, goes_on);
        }
        secondary
            .on_reflection(reflection, context.pdf(w, -direction, context.bsdf.mirrored(direction), None));
        let weight = paths.weight.times(reflection).bounded();
        let lanes = lanes & self.is_above_threshold(w, weight);
        if lanes.any() {
            self.shading.counts.reflected += u64::from(lanes.bits().count_ones());
            let rays = at.rays_on_this_side(context.bsdf.mirrored(direction));
            secondary.reflected(context.paths(paths, rays, weight, (paths.media, lanes)));
        }
    }

    /// Sends on the rays of the last generation that go straight through the surfaces of transparent bodies: they are the
    /// same rays still. They are rare: copies leave those of all others where they are.
    #[cold]
    #[inline(never)]
    pub(crate) fn pass_at_limit<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: PathState<W>,
        at: SurfaceInteraction<W>,
        at_limit: W::M,
        secondary: &mut impl SecondaryRays<W>,
    ) {
        w.run(
            #[inline(always)]
            || {
                let (ratio, _) = self.shading.cross_interface::<W, FULL>(w, paths.media, &at, at_limit);
                // Between equal indices there is no surface that could be rough.
                let straight = at_limit & ratio.eq(w.real(1.0));
                if straight.any() {
                    let next = paths.generation.plus(w.word(1));
                    let bsdf = &at.bsdf;
                    let context = ScatterContext { at: &at, bsdf, macrosurface: None, next, is_last: true };
                    self.refracted::<W, FULL>(w, &paths, &context, straight, secondary);
                }
            },
        );
    }

    /// Sends rays through clear surfaces. What is reflected from them and all others.
    #[inline(always)]
    fn refracted<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        context: &ScatterContext<'_, W>,
        transparent: W::M,
        secondary: &mut impl SecondaryRays<W>,
    ) -> Vector<W::R> {
        let mut white = transparent;
        let mut split = None;
        if FULL && self.shading.scene.disperses {
            let lanes = transparent & context.bsdf.disperses & self.are_white(w, paths.media);
            if lanes.any() {
                split = Some((lanes, self.disperse(w, paths, context, lanes, secondary)));
                white = white & !lanes;
            }
        }
        let crossing = self.interface::<W, FULL>(w, paths, paths.media, context, transparent);
        let DielectricInterface { ratio, dirac: BsdfDirac { passes, filter, .. }, .. } = crossing;
        secondary.on_interface(InterfaceCrossing { ratio, passes });
        if white.any() {
            self.send_through::<W, FULL>(w, paths, context, &crossing, filter, white, secondary);
        }
        let reflection = context.reflectance::<FULL>(crossing.dirac.reflection);
        match split {
            Some((lanes, colored)) => Vector::select(lanes, colored, reflection),
            None => reflection,
        }
    }

    /// Sends each wave of white light by itself. What is reflected of all together.
    #[inline(never)]
    fn disperse<W: Width>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        context: &ScatterContext<'_, W>,
        lanes: W::M,
        secondary: &mut impl SecondaryRays<W>,
    ) -> Vector<W::R> {
        w.run(
            #[inline(always)]
            || {
                let nothing = w.real(0.0);
                let mut reflection = Vector::new(nothing, nothing, nothing);
                for number in 0..self.shading.waves.len() {
                    let color = self.shading.waves.color(number);
                    let media = self.colored(w, paths.media, number, lanes);
                    let crossing = self.interface::<W, true>(w, paths, media, context, lanes);
                    reflection = reflection + Vector::splat(nothing, color) * crossing.dirac.reflection;
                    let filter = crossing.dirac.filter.times_all(color);
                    self.send_through::<W, true>(w, paths, context, &crossing, filter, lanes, secondary);
                }
                reflection
            },
        )
    }

    /// What becomes of rays in these media across the surfaces that they met.
    #[inline(always)]
    fn interface<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        media: W::W,
        context: &ScatterContext<'_, W>,
        transparent: W::M,
    ) -> DielectricInterface<W> {
        let (ratio, beyond) = self.shading.cross_interface::<W, FULL>(w, media, context.at, transparent);
        let dirac = context.bsdf.dirac::<FULL>(w, paths.rays.direction, ratio, transparent);
        DielectricInterface { ratio, beyond, dirac }
    }

    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "each is a vector of its own")]
    fn send_through<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        context: &ScatterContext<'_, W>,
        crossing: &DielectricInterface<W>,
        filter: Vector<W::R>,
        lanes: W::M,
        secondary: &mut impl SecondaryRays<W>,
    ) {
        let DielectricInterface { ratio, beyond, dirac: BsdfDirac { refracted, passes, .. } } = *crossing;
        let straight = ratio.eq(w.real(1.0));
        let (mut filter, mut lanes) = (filter, lanes & passes);
        if FULL {
            let (left, flies) = context.masking(refracted, true, filter, lanes);
            // Between equal indices there is no surface, and nothing that could be rough.
            filter = Vector::select(straight, filter, left);
            lanes = flies | (lanes & straight);
        }
        let pdf = context.pdf(w, -paths.rays.direction, refracted, Some(ratio));
        secondary.on_refraction(filter, pdf);
        let weight = paths.weight.times(filter).bounded();
        // A ray that goes straight on is the same ray still, unless it stands still: between bodies thinner than rounding
        // it could go on for ever.
        let same = straight & context.at.t.gt(paths.rays.error_bound());
        if context.is_last {
            lanes = lanes & same;
        }
        let lanes = lanes & self.is_above_threshold(w, weight);
        if lanes.any() {
            self.shading.counts.refracted += u64::from(lanes.bits().count_ones());
            let mut through =
                context.paths(paths, context.at.rays_on_far_side(refracted), weight, (beyond, lanes));
            through.generation = W::W::select(same, paths.generation, context.next);
            secondary.refracted(through);
        }
    }

    /// Whether rays of this weight are traced.
    #[inline(always)]
    pub(crate) fn is_above_threshold<W: Width>(&self, w: W, weight: Vector<W::R>) -> W::M {
        let strongest = weight.largest();
        strongest.gt(w.real(0.0)) & strongest.ge(w.real(self.threshold))
    }

    /// The rays whose light has not been split yet.
    fn are_white<W: Width>(&self, w: W, media: W::W) -> W::M {
        let mut lists = [AIR; MOST_LANES];
        media.store(&mut lists);
        let white = |lane: usize| u32::from(self.shading.media.wave(lists[lane]).is_none()) << lane;
        w.mask((0..W::LANES).map(white).fold(0, |bits, bit| bits | bit))
    }

    /// These media for light of one wave.
    fn colored<W: Width>(&mut self, w: W, media: W::W, wave: usize, lanes: W::M) -> W::W {
        let mut lists = [AIR; MOST_LANES];
        media.store(&mut lists);
        for lane in (0..W::LANES).filter(|lane| lanes.bits() >> lane & 1 == 1) {
            lists[lane] = self.shading.media.colored(lists[lane], wave as u32);
        }
        w.load_words(&lists)
    }
}

impl<W: Width> ScatterContext<'_, W> {
    /// What is reflected, of each channel.
    #[inline(always)]
    fn reflectance<const FULL: bool>(&self, reflection: W::R) -> Vector<W::R> {
        if FULL { self.bsdf.reflectance(reflection) } else { Vector::new(reflection, reflection, reflection) }
    }

    /// The density with which facets lead to rays in `direction`, see [`Macrosurface::pdf`].
    #[inline(always)]
    fn pdf(&self, w: W, to_viewer: Vector<W::R>, direction: Vector<W::R>, beyond: Option<W::R>) -> W::R {
        match &self.macrosurface {
            None => w.real(0.0),
            Some(macrosurface) => macrosurface.pdf(to_viewer, direction, beyond),
        }
    }

    /// The coefficients and rays that are left where facets let them off.
    #[inline(always)]
    fn masking(
        &self,
        direction: Vector<W::R>,
        is_beyond: bool,
        coefficients: Vector<W::R>,
        lanes: W::M,
    ) -> (Vector<W::R>, W::M) {
        match &self.macrosurface {
            None => (coefficients, lanes),
            Some(macrosurface) => {
                let (coefficients, flies) = macrosurface.masking(direction, is_beyond, coefficients);
                (coefficients, lanes & flies)
            }
        }
    }

    #[inline(always)]
    fn paths(
        &self,
        of: &PathState<W>,
        rays: RayPacket<W>,
        weight: Vector<W::R>,
        (media, lanes): (W::W, W::M),
    ) -> PathState<W> {
        PathState { rays, weight, generation: self.next, media, pixel: of.pixel, lanes }
    }
}
