//! Rays of the tree side by side, and the queues in which they wait.

use std::ops::Range;

use bytemuck::{Zeroable, zeroed_vec};

use crate::geometry::membership::BodyMembership;
use crate::geometry::ray::{NO_START, RayPacket};
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32, MOST_LANES, Mask as _, Width, Word};
use crate::transport::interaction::SurfaceInteraction;
use crate::transport::media::AIR;
use crate::transport::media::transmittance::Transmittance;
use crate::transport::surface::bsdf::BsdfValue;

/// Rays of trees, with what they carry.
#[derive(Clone, Copy)]
pub(crate) struct PathState<W: Width> {
    pub(crate) rays: RayPacket<W>,
    /// Product of the coefficients on the way from the eye.
    pub(crate) weight: Vector<W::R>,
    pub(crate) generation: W::W,
    /// Lists of a [`MediumStacks`](crate::transport::media::MediumStacks).
    pub(crate) media: W::W,
    /// Whose light they bring.
    pub(crate) pixel: W::W,
    /// Those that fly.
    pub(crate) lanes: W::M,
}

impl<W: Width> PathState<W> {
    /// None that flies.
    #[inline(always)]
    pub(crate) fn none(w: W) -> Self {
        let (zero, none) = (w.real(0.0), w.word(0));
        let nothing = Vector::new(zero, zero, zero);
        Self {
            rays: RayPacket { origin: nothing, direction: nothing, start: none },
            weight: nothing,
            generation: none,
            media: none,
            pixel: none,
            lanes: w.mask(0),
        }
    }

    /// Rays from the eye, none of which flies yet: they start and point anywhere.
    #[inline(always)]
    pub(crate) fn from_eye(w: W) -> Self {
        let (one, none) = (w.real(1.0), Self::none(w));
        Self {
            rays: RayPacket { start: w.word(NO_START), ..none.rays },
            weight: Vector::new(one, one, one),
            generation: w.word(1),
            media: w.word(AIR),
            ..none
        }
    }

    /// The rays of a generation below `limit`.
    #[inline(always)]
    pub(crate) fn below(&self, w: W, limit: u32) -> W::M {
        // Small numbers in the words are small positive subnormal numbers; made normal they keep their order.
        let number = |word: W::W| W::R::of_word(word.or(w.word(0x4b00_0000)));
        number(self.generation).lt(number(w.word(limit)))
    }
}

/// What becomes of rays across a transparent surface.
#[derive(Clone, Copy)]
pub(crate) struct InterfaceCrossing<W: Width> {
    /// The ratio of indices.
    pub(crate) ratio: W::R,
    /// Those that are not totally reflected.
    pub(crate) passes: W::M,
}

/// Who looks on while a packet is shaded.
///
/// Rendering does not look: what is seen is dropped, at no cost. A [tree](crate::WhittedIntegrator::pixel_tree) writes it
/// down.
pub(crate) trait PathObserver<W: Width> {
    /// The points that the rays `hit` met.
    #[inline(always)]
    fn on_hit(&mut self, _w: W, _paths: &PathState<W>, _hit: W::M, _at: &SurfaceInteraction<W>) {}

    /// The direction to a light of the scene, its distance, and the cosine to the normal.
    #[inline(always)]
    fn on_light(&mut self, _light: usize, _to_light: Vector<W::R>, _distance: W::R, _cos: W::R) {}

    /// Shadow rays towards that light, and what they let pass.
    #[inline(always)]
    fn on_shadow_ray(
        &mut self,
        _rays: &RayPacket<W>,
        _distance: W::R,
        _inside: &BodyMembership,
        _through: &Transmittance<W>,
    ) {
    }

    /// What arrives of that light if nothing is in the way, what passes on the way there, what the surface sends on of each
    /// unit of it, and of all of it: at the points `lit`.
    #[inline(always)]
    fn on_light_answer(
        &mut self,
        _lit: W::M,
        _power: Vector<W::R>,
        _through: &Transmittance<W>,
        _sent: (&BsdfValue<W>, Vector<W::R>),
    ) {
    }

    /// The sum of the local terms.
    #[inline(always)]
    fn on_local_light(&mut self, _local: Vector<W::R>) {}

    /// What becomes of rays across a transparent surface.
    #[inline(always)]
    fn on_interface(&mut self, _crossed: InterfaceCrossing<W>) {}

    /// The coefficients of rays that are refracted, before they are, if at all, and the [density](crate::transport::surface::bsdf::Macrosurface::pdf) of their
    /// directions.
    #[inline(always)]
    fn on_refraction(&mut self, _coefficients: Vector<W::R>, _pdf: W::R) {}

    /// The coefficients of rays that are reflected, before they are, if at all, and the [density](crate::transport::surface::bsdf::Macrosurface::pdf) of
    /// their directions.
    #[inline(always)]
    fn on_reflection(&mut self, _coefficients: Vector<W::R>, _pdf: W::R) {}

    /// The share of light that the media leave on the way to what was met.
    #[inline(always)]
    fn on_medium(&mut self, _through: Vector<W::R>) {}
}

/// An observer that sees nothing.
pub(crate) struct Unobserved;

impl<W: Width> PathObserver<W> for Unobserved {}

/// Where the rays go that grow from others.
pub(crate) trait SecondaryRays<W: Width>: PathObserver<W> {
    fn reflected(&mut self, paths: PathState<W>);
    fn refracted(&mut self, paths: PathState<W>);
}

impl PathObserver<ScalarWidth> for Vec<PathState<ScalarWidth>> {}

/// A stack of single rays: the reflected one is taken first.
impl SecondaryRays<ScalarWidth> for Vec<PathState<ScalarWidth>> {
    fn reflected(&mut self, paths: PathState<ScalarWidth>) {
        self.push(paths);
    }

    fn refracted(&mut self, paths: PathState<ScalarWidth>) {
        self.push(paths);
    }
}

/// Rays that wait, each field in a row of its own, so that full vectors of them can be taken whatever vectors they came
/// from.
#[derive(Debug, Default)]
pub(crate) struct RayQueue {
    numbers: [Vec<f32>; 9],
    words: [Vec<u32>; 4],
    len: usize,
    taken: usize,
}

impl RayQueue {
    /// How many wait.
    pub(crate) fn len(&self) -> usize {
        self.len - self.taken
    }

    /// Appends the rays that fly.
    #[inline(always)]
    pub(crate) fn push<W: Width>(&mut self, paths: &PathState<W>) {
        let PathState { rays, weight, generation, media, pixel, lanes } = *paths;
        let end = self.len + MOST_LANES;
        if self.words[0].len() < end {
            self.grow(end);
        }
        self.put(0, rays.origin, lanes);
        self.put(3, rays.direction, lanes);
        self.put(6, weight, lanes);
        self.put_words(0, rays.start, lanes);
        self.put_words(1, generation, lanes);
        self.put_words(2, media, lanes);
        self.put_words(3, pixel, lanes);
        self.len += lanes.bits().count_ones() as usize;
    }

    #[inline(always)]
    fn put<R: Float32>(&mut self, first: usize, vector: Vector<R>, lanes: R::Mask) {
        vector.x.store_some(lanes, &mut self.numbers[first][self.len..]);
        vector.y.store_some(lanes, &mut self.numbers[first + 1][self.len..]);
        vector.z.store_some(lanes, &mut self.numbers[first + 2][self.len..]);
    }

    #[inline(always)]
    fn put_words<W: Word>(&mut self, row: usize, words: W, lanes: W::Mask) {
        words.store_some(lanes, &mut self.words[row][self.len..]);
    }

    #[cold]
    fn grow(&mut self, end: usize) {
        let len = end.next_power_of_two().max(128);
        let waiting = self.taken..self.len;
        self.numbers.iter_mut().for_each(|row| *row = longer(row, waiting.clone(), len));
        self.words.iter_mut().for_each(|row| *row = longer(row, waiting.clone(), len));
    }

    /// Takes the first rays: as many as there are side by side, or the rest.
    #[inline(always)]
    pub(crate) fn take<W: Width>(&mut self, w: W) -> PathState<W> {
        let paths = self.look(w, 0);
        self.skip(W::LANES);
        paths
    }

    /// The rays behind the first `at`: as many as there are side by side, or the rest.
    #[inline(always)]
    pub(crate) fn look<W: Width>(&self, w: W, at: usize) -> PathState<W> {
        let count = self.len().saturating_sub(at);
        let at = self.taken + at;
        PathState {
            rays: RayPacket {
                origin: self.vector(w, 0, at),
                direction: self.vector(w, 3, at),
                start: self.word(w, 0, at),
            },
            weight: self.vector(w, 6, at),
            generation: self.word(w, 1, at),
            media: self.word(w, 2, at),
            pixel: self.word(w, 3, at),
            lanes: w.first(count),
        }
    }

    /// Takes away the first `count` rays, or all.
    #[inline(always)]
    pub(crate) fn skip(&mut self, count: usize) {
        self.taken += count.min(self.len());
        if self.len() == 0 {
            (self.len, self.taken) = (0, 0);
        }
    }

    #[inline(always)]
    fn vector<W: Width>(&self, w: W, first: usize, at: usize) -> Vector<W::R> {
        let [x, y, z] = [first, first + 1, first + 2].map(|row| &self.numbers[row][at..]);
        Vector::new(w.load(x), w.load(y), w.load(z))
    }

    #[inline(always)]
    fn word<W: Width>(&self, w: W, row: usize, at: usize) -> W::W {
        w.load_words(&self.words[row][at..])
    }

    /// Forgets all.
    pub(crate) fn clear(&mut self) {
        (self.len, self.taken) = (0, 0);
    }
}

/// A row of `len` numbers with those that wait in a shorter one. No others are written, so that fresh memory stays
/// untouched until it is needed.
fn longer<T: Copy + Zeroable>(row: &[T], waiting: Range<usize>, len: usize) -> Vec<T> {
    let mut longer = zeroed_vec(len);
    longer[waiting.clone()].copy_from_slice(&row[waiting]);
    longer
}
