//! The points that rays met, with all that shading needs.

use crate::lanes::{MOST_LANES, Mask as _, Real as _, Width, Word as _};
use crate::ray::{INWARDS, Rays};
use crate::search::Hits;
use crate::stage::{Stage, StageBody};
use crate::vector::Vector;

/// The points that rays side by side met. Of rays that met nothing, the numbers mean nothing.
#[derive(Clone, Copy)]
pub(crate) struct Encounter<W: Width> {
    pub(super) t: W::R,
    pub(super) body: W::W,
    /// The body, and [`INWARDS`] where the ray came from within: the start of rays on this side.
    start: W::W,
    pub(super) position: Vector<W::R>,
    /// Unit normal facing the ray.
    pub(super) normal: Vector<W::R>,
    /// k_a·C·I_a.
    pub(super) ambient: Vector<W::R>,
    /// k_d·C.
    pub(super) diffuse: Vector<W::R>,
    /// k_s.
    pub(super) specular: W::R,
    /// Exponent n.
    pub(super) shininess: W::R,
    /// k_r.
    pub(super) reflection: W::R,
    /// k_t·τ.
    pub(super) filter: Vector<W::R>,
    /// Rays that met something transparent.
    pub(super) transparent: W::M,
    /// Those that met something that answers a light.
    pub(super) answers: W::M,
    /// Those that met something with a highlight.
    pub(super) glossy: W::M,
}

impl<W: Width> Encounter<W> {
    /// Looks at the bodies one after the other: rays side by side mostly meet the same.
    #[inline(always)]
    pub(super) fn new(w: W, stage: &Stage, rays: &Rays<W>, hits: &Hits<W>) -> Self {
        let (zero, none) = (w.real(0.0), w.mask(0));
        let nowhere = Vector::new(zero, zero, zero);
        let leaving = W::W::select(hits.leaving, w.word(INWARDS), w.word(0));
        let mut all = Self {
            t: hits.t,
            body: hits.body,
            start: hits.body.or(leaving),
            position: nowhere,
            normal: nowhere,
            ambient: nowhere,
            diffuse: nowhere,
            specular: zero,
            shininess: zero,
            reflection: zero,
            filter: nowhere,
            transparent: none,
            answers: none,
            glossy: none,
        };
        let mut bodies = [0; MOST_LANES];
        hits.body.store(&mut bodies);
        let mut left = hits.hit.bits();
        while left != 0 {
            let index = bodies[left.trailing_zeros() as usize % MOST_LANES];
            let same = hits.body.is(index) & hits.hit;
            left &= !same.bits();
            all.look_at(w, stage, stage.body(index), rays, hits, same);
        }
        all
    }

    /// Takes up what rays `lanes` find on a body.
    #[inline(always)]
    fn look_at(
        &mut self,
        w: W,
        stage: &Stage,
        body: &StageBody,
        rays: &Rays<W>,
        hits: &Hits<W>,
        lanes: W::M,
    ) {
        let material = stage.material(body);
        let zero = w.real(0.0);
        let point = body.surface_point(rays.origin, rays.direction, hits.t, hits.leaving);
        let mut color = Vector::splat(zero, material.color);
        if let Some(checker) = stage.checkers.get(body.checker as usize) {
            color = Vector::select(checker.is_odd(point.in_body), Vector::splat(zero, checker.color), color);
        }
        let real = |own: f32, old: W::R| W::R::select(lanes, w.real(own), old);
        self.position = Vector::select(lanes, point.in_world, self.position);
        self.normal = Vector::select(lanes, point.normal, self.normal);
        if material.ambient != 0.0 {
            let ambient = stage.ambient.map(|light| light * material.ambient);
            self.ambient = Vector::select(lanes, color.times_all(ambient), self.ambient);
        }
        let mut answers = material.specular != 0.0;
        if material.diffuse != 0.0 {
            self.diffuse = Vector::select(lanes, color * w.real(material.diffuse), self.diffuse);
            answers = true;
        }
        if material.specular != 0.0 {
            self.specular = real(material.specular, self.specular);
            self.shininess = real(material.shininess, self.shininess);
            self.glossy = self.glossy | lanes;
        }
        if answers {
            self.answers = self.answers | lanes;
        }
        self.reflection = real(material.reflection, self.reflection);
        if body.is_transparent() {
            self.transparent = self.transparent | lanes;
            self.filter = Vector::select(lanes, Vector::splat(zero, material.filter), self.filter);
        }
    }

    /// Rays that met the surface from within.
    #[inline(always)]
    pub(super) fn leaves(&self) -> W::M {
        self.start.has(INWARDS)
    }

    /// Rays from here to the side that the incoming rays came from.
    #[inline(always)]
    pub(super) fn rays_on_this_side(&self, direction: Vector<W::R>) -> Rays<W> {
        Rays { origin: self.position, direction, start: self.start }
    }

    /// Rays from here to the other side of the surface.
    #[inline(always)]
    pub(super) fn rays_on_far_side(&self, direction: Vector<W::R>) -> Rays<W> {
        let other = self.start.plus(self.start.like(INWARDS));
        Rays { origin: self.position, direction, start: other }
    }
}
