//! The points that rays met, with all that shading needs.

use crate::geometry::body::RenderBody;
use crate::geometry::query::PacketHits;
use crate::geometry::ray::{INWARDS, NO_START, RayPacket};
use crate::simd::vector::Vector;
use crate::simd::{MOST_LANES, Mask as _, Width, Word as _};
use crate::transport::scene::RenderScene;
use crate::transport::surface::bsdf::{Bsdf, SurfaceColors};
use crate::transport::texture::solid::patterned;

/// The points that rays side by side met. Of rays that met nothing, the numbers mean nothing.
#[derive(Clone, Copy)]
pub(crate) struct SurfaceInteraction<W: Width> {
    pub(crate) t: W::R,
    /// The body, and [`INWARDS`] where the ray came from within: the start of rays on this side.
    pub(crate) start: W::W,
    pub(crate) position: Vector<W::R>,
    /// Of cemented contacts, the start of a ray that is reflected at the other surface; else
    /// [`NO_START`].
    pub(crate) contact: W::W,
    /// What the surfaces do with light.
    pub(crate) bsdf: Bsdf<W>,
}

impl<W: Width> SurfaceInteraction<W> {
    /// Points on surfaces, seen along `direction`; `start` is the body of each, with [`INWARDS`] on its inner side, and
    /// `color_of` tells the colors of a body at some of the points.
    #[inline(always)]
    pub(crate) fn at_points<const FULL: bool>(
        w: W,
        scene: &RenderScene,
        start: W::W,
        (position, normal): (Vector<W::R>, Vector<W::R>),
        direction: Vector<W::R>,
        lanes: W::M,
        color_of: impl Fn(&RenderBody, W::M) -> Vector<W::R>,
    ) -> Self {
        let body = start.and(!INWARDS);
        let within = scene.geometry.joined.turned(w, body, start.has(INWARDS));
        let mut bsdf = Bsdf { normal, ..Bsdf::black(w, body, within) };
        each_word::<W>(body, lanes, |index, same| {
            let body = scene.geometry.body(index);
            let material = scene.material(body);
            let ground = Vector::splat(w.real(0.0), material.color);
            let colors = SurfaceColors { color: color_of(body, same), ground };
            bsdf.set_material::<FULL, false>(w, (material, scene.ambient), colors, direction, same);
        });
        Self { t: w.real(0.0), start, position, contact: w.word(NO_START), bsdf }
    }

    /// Looks at the bodies one after the other: rays side by side mostly meet the same.
    #[inline(always)]
    pub(crate) fn new<const FULL: bool>(
        w: W,
        scene: &RenderScene,
        rays: &RayPacket<W>,
        hits: &PacketHits<W>,
    ) -> Self {
        let leaving = W::W::select(hits.leaving, w.word(INWARDS), w.word(0));
        let zero = w.real(0.0);
        let mut all = Self {
            t: hits.t,
            start: hits.body.or(leaving),
            position: Vector::new(zero, zero, zero),
            contact: hits.contact,
            bsdf: Bsdf::black(w, hits.body, scene.geometry.joined.turned(w, hits.body, hits.leaving)),
        };
        let mut bodies = [0; MOST_LANES];
        hits.body.store(&mut bodies);
        let mut left = hits.hit.bits();
        let next = |left: &mut u32| {
            let index = bodies[left.trailing_zeros() as usize % MOST_LANES];
            let same = hits.body.is(index) & hits.hit;
            *left &= !same.bits();
            (index, same)
        };
        if left != 0 {
            let (index, same) = next(&mut left);
            all.look_at::<FULL, true>(w, scene, index, rays, hits, same);
        }
        while left != 0 {
            let (index, same) = next(&mut left);
            all.look_at::<FULL, false>(w, scene, index, rays, hits, same);
        }
        all
    }

    /// Takes up what rays `lanes` find on a body. The `FIRST` one may write the numbers of all rays; others write theirs even
    /// where they are 0.
    #[inline(always)]
    fn look_at<const FULL: bool, const FIRST: bool>(
        &mut self,
        w: W,
        scene: &RenderScene,
        index: u32,
        rays: &RayPacket<W>,
        hits: &PacketHits<W>,
        lanes: W::M,
    ) {
        let body = scene.geometry.body(index);
        let material = scene.material(body);
        let zero = w.real(0.0);
        let line = (rays.origin, rays.direction);
        let point = scene.geometry.point_on_face(w, (index, body), line, hits.t, hits.leaving, hits.face);
        let mut color = Vector::splat(zero, material.color);
        if FULL {
            color = material.color_at(w, body, point.in_body, lanes);
        }
        color = patterned(w, &scene.solids, body.solid, color, point.on_solid(body));
        let select = |own: Vector<W::R>, old| if FIRST { own } else { Vector::select(lanes, own, old) };
        self.position = select(point.in_world, self.position);
        self.bsdf.normal = select(point.normal, self.bsdf.normal);
        let colors = SurfaceColors { color, ground: color };
        let lit = (material, scene.ambient);
        self.bsdf.set_material::<FULL, FIRST>(w, lit, colors, rays.direction, lanes);
    }

    /// Rays from here to the side that the incoming rays came from.
    #[inline(always)]
    pub(crate) fn rays_on_this_side(&self, direction: Vector<W::R>) -> RayPacket<W> {
        RayPacket { origin: self.position, direction, start: self.start }
    }

    /// Rays from here to the other side of the surface.
    #[inline(always)]
    pub(crate) fn rays_on_far_side(&self, direction: Vector<W::R>) -> RayPacket<W> {
        let other = self.start.plus(self.start.like(INWARDS));
        RayPacket { origin: self.position, direction, start: other }
    }
}

/// Calls `take` for each of the words that some of `lanes` have, with those: side by side, most have the same.
#[inline(always)]
pub(crate) fn each_word<W: Width>(words: W::W, lanes: W::M, mut take: impl FnMut(u32, W::M)) {
    let mut numbers = [0; MOST_LANES];
    words.store(&mut numbers);
    let mut left = lanes.bits();
    while left != 0 {
        let number = numbers[left.trailing_zeros() as usize % MOST_LANES];
        let same = words.is(number) & lanes;
        left &= !same.bits();
        take(number, same);
    }
}
