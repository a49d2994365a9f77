//! Cemented contacts in shading: one interface between the media of two bodies, or none where light is bent by neither.

use crate::geometry::query::PacketHits;
use crate::geometry::ray::NO_START;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, MOST_LANES, Mask as _, Width, Word as _};
use crate::transport::interaction::SurfaceInteraction;
use crate::transport::path::PathState;
use crate::transport::shading::ShadingContext;
use crate::transport::surface::bsdf::Bsdf;

impl ShadingContext<'_> {
    /// The points that rays met.
    #[inline(always)]
    pub(crate) fn interaction<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        hits: &PacketHits<W>,
    ) -> SurfaceInteraction<W> {
        let at = SurfaceInteraction::new::<FULL>(w, self.scene, &paths.rays, hits);
        if FULL && self.scene.geometry.has_cemented {
            return self.cemented(w, paths.media, at, hits.hit);
        }
        at
    }

    /// These points with what becomes of the surfaces of cemented contacts. Where light goes on as in one body, there is no
    /// surface. Elsewhere it is split into its colors if either body does so.
    #[cold]
    #[inline(never)]
    fn cemented<W: Width>(
        &mut self,
        w: W,
        media: W::W,
        mut at: SurfaceInteraction<W>,
        hit: W::M,
    ) -> SurfaceInteraction<W> {
        w.run(
            #[inline(always)]
            || {
                let contacts = hit & !at.contact.is(NO_START);
                if !contacts.any() {
                    return at;
                }
                let (mut alike, mut splitting) = (w.mask(0), w.mask(0));
                let mut words = InterfaceWords::of(media, &at, contacts);
                while let Some((list, start, contact, same)) = words.next() {
                    let beyond =
                        self.media.across_contact(self.scene, &self.waves, list, [start, contact]).beyond;
                    let splits = |list| self.media.dispersion(self.scene, list).is_some();
                    if self.media.are_alike(self.scene, &self.waves, list, beyond) {
                        alike = alike | same;
                    } else if splits(list) || splits(beyond) {
                        splitting = splitting | same;
                    }
                }
                at.bsdf = at.bsdf.without(w, alike);
                at.bsdf.disperses = at.bsdf.disperses | splitting;
                at
            },
        )
    }

    /// The ratio of indices for rays that cross surfaces, those of cemented contacts among them, and the media beyond.
    #[cold]
    #[inline(never)]
    pub(crate) fn cross_cemented<W: Width>(
        &mut self,
        w: W,
        media: W::W,
        at: SurfaceInteraction<W>,
        lanes: W::M,
    ) -> (W::R, W::W) {
        w.run(
            #[inline(always)]
            || {
                let (mut ratio, mut beyond) = (w.real(1.0), media);
                let mut words = InterfaceWords::of(media, &at, lanes);
                while let Some((list, start, contact, same)) = words.next() {
                    let crossing = match contact {
                        NO_START => self.media.interface(self.scene, &self.waves, list, start),
                        contact => self.media.across_contact(self.scene, &self.waves, list, [start, contact]),
                    };
                    ratio = W::R::select(same, w.real(crossing.ratio), ratio);
                    beyond = W::W::select(same, w.word(crossing.beyond), beyond);
                }
                (ratio, beyond)
            },
        )
    }
}

/// The distinct words of the interfaces that rays side by side met: media, start and contact.
struct InterfaceWords<W: Width> {
    words: [W::W; 3],
    rows: [[u32; MOST_LANES]; 3],
    lanes: W::M,
    left: u32,
}

impl<W: Width> InterfaceWords<W> {
    #[inline(always)]
    fn of(media: W::W, at: &SurfaceInteraction<W>, lanes: W::M) -> Self {
        let words = [media, at.start, at.contact];
        let mut rows = [[0; MOST_LANES]; 3];
        for (row, word) in rows.iter_mut().zip(words) {
            word.store(row);
        }
        Self { words, rows, lanes, left: lanes.bits() }
    }

    /// The next ones, and the rays that have them.
    #[inline(always)]
    fn next(&mut self) -> Option<(u32, u32, u32, W::M)> {
        if self.left == 0 {
            return None;
        }
        let lane = self.left.trailing_zeros() as usize % MOST_LANES;
        let [list, start, contact] = [self.rows[0][lane], self.rows[1][lane], self.rows[2][lane]];
        let same = self.words[0].is(list) & self.words[1].is(start) & self.words[2].is(contact) & self.lanes;
        self.left &= !same.bits();
        Some((list, start, contact, same))
    }
}

impl<W: Width> Bsdf<W> {
    /// These surfaces without those of `lanes`: there light goes straight on, all of it.
    fn without(self, w: W, lanes: W::M) -> Self {
        let (zero, one) = (w.real(0.0), w.real(1.0));
        let vector = |own: Vector<W::R>| Vector::select(lanes, Vector::new(zero, zero, zero), own);
        let number = |own: W::R| W::R::select(lanes, zero, own);
        Self {
            ambient: vector(self.ambient),
            diffuse: vector(self.diffuse),
            specular: number(self.specular),
            reflection: number(self.reflection),
            filter: Vector::select(lanes, Vector::new(one, one, one), self.filter),
            transparent: self.transparent | lanes,
            scatters: self.scatters & !lanes,
            glossy: self.glossy & !lanes,
            weighed: self.weighed & !lanes,
            dielectric: self.dielectric & !lanes,
            disperses: self.disperses & !lanes,
            rough: self.rough & !lanes,
            tinted: self.tinted & !lanes,
            coated: self.coated & !lanes,
            ..self
        }
    }
}
