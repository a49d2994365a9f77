//! The transparent bodies that rays are inside of.

pub(crate) mod absorption;
pub(crate) mod shadow_crossings;
pub(crate) mod shadow_stream;
pub(crate) mod transmittance;

use std::collections::HashMap;

use catoptric_optics::Dispersion;
use foldhash::fast::FixedState;

use crate::geometry::Accelerator;
use crate::geometry::membership::{BodyMembership, MembershipSource};
use crate::geometry::ray::RayOrigin;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, MOST_LANES, Mask as _, Width, Word as _};
use crate::transport::scene::RenderScene;
use crate::transport::spectrum::SampledWavelengths;
use crate::transport::surface::exponential;

/// From here on numbers of bodies stand for waves: what a ray that is of one color has at the end of its list.
pub(crate) const WAVES: u32 = u32::MAX - 0xff;

/// In no body: in air.
pub(crate) const AIR: u32 = u32::MAX;

/// The lists of transparent bodies that the rays of a picture are inside of, each in the order entered.
///
/// A list is a number: [`AIR`], or the place of its link, the body entered last and the rest of the list. Equal lists are
/// the same number, so that there are only as many as there are ways to stand in the scene, however many rays; and what
/// a surface makes of a list is worked out once.
#[derive(Debug, Default)]
pub(crate) struct MediumStacks {
    /// Each link: a body and the rest of the list.
    links: Vec<(u32, u32)>,
    places: HashMap<(u32, u32), u32, FixedState>,
    crossings: HashMap<(u32, u32), MediumTransition, FixedState>,
}

/// What becomes of a list at the surface of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MediumTransition {
    /// The list beyond it.
    pub beyond: u32,
    /// The index of refraction here divided by that beyond.
    pub ratio: f32,
}

impl MediumStacks {
    /// So many links and crossings are kept; a scene of ordinary bodies has as many as bodies.
    const MOST: usize = 1 << 20;

    /// Forgets all lists if they have become very many, and says so. None may be in use.
    pub(crate) fn trim(&mut self) -> bool {
        let is_full = self.links.len().max(self.crossings.len()) > Self::MOST;
        if is_full {
            *self = Self::default();
        }
        is_full
    }

    /// Adds rays that have the same list.
    fn add_to(&self, membership: &mut BodyMembership, list: u32, rays: u32) {
        self.bodies(list).for_each(|body| membership.add(body, rays));
    }

    /// The bodies of a list, the one entered last first.
    pub(crate) fn bodies(&self, media: u32) -> impl Iterator<Item = u32> {
        let mut at = media;
        std::iter::from_fn(move || {
            let &(body, rest) = self.links.get(at as usize)?;
            at = rest;
            (body < WAVES).then_some(body)
        })
    }

    /// The wave of a ray in these media, if its light is of one color.
    pub(crate) fn wave(&self, media: u32) -> Option<u32> {
        let mut at = media;
        while let Some(&(body, rest)) = self.links.get(at as usize) {
            if body >= WAVES {
                return Some(body - WAVES);
            }
            at = rest;
        }
        None
    }

    /// A list of media for light of one wave, less than 256.
    pub(crate) fn colored(&mut self, media: u32, wave: u32) -> u32 {
        let mut bodies: Vec<u32> = self.bodies(media).collect();
        bodies.push(WAVES + wave.min(u32::MAX - 1 - WAVES));
        bodies.into_iter().rev().fold(AIR, |list, body| self.entered(list, body))
    }

    /// The list after entering `body`.
    fn entered(&mut self, media: u32, body: u32) -> u32 {
        *self.places.entry((body, media)).or_insert_with(|| {
            self.links.push((body, media));
            self.links.len() as u32 - 1
        })
    }

    /// The list after leaving `body`, which it contains.
    fn left(&mut self, media: u32, body: u32) -> u32 {
        let mut later: Vec<u32> = Vec::new();
        let mut at = media;
        while let Some(&(entered, rest)) = self.links.get(at as usize) {
            at = rest;
            if entered == body {
                break;
            }
            later.push(entered);
        }
        later.iter().rev().fold(at, |list, &body| self.entered(list, body))
    }

    /// What a ray in `media` comes to beyond the surface of a body; `start` is the [word](RayOrigin::word) of one that is
    /// reflected there. To leave a body that was never entered, as may be where surfaces coincide, changes nothing; nor does what
    /// is a surface only.
    pub(crate) fn interface(
        &mut self,
        scene: &RenderScene,
        waves: &SampledWavelengths,
        media: u32,
        start: u32,
    ) -> MediumTransition {
        if let Some(known) = self.crossings.get(&(media, start)) {
            return *known;
        }
        // A joined body is one medium, whatever its parts.
        let RayOrigin { body, inwards } = RayOrigin::of_word(start);
        let RayOrigin { body, inwards } = scene.geometry.joined.whole_of(body, inwards);
        let is_inside = self.bodies(media).any(|other| other == body);
        let beyond = match (inwards, is_inside) {
            (true, true) => self.left(media, body),
            (false, false) => self.entered(media, body),
            (true, false) | (false, true) => media,
        };
        let beyond = if scene.geometry.is_surface(body) { media } else { beyond };
        let ratio = self.ior(scene, waves, media) / self.ior(scene, waves, beyond);
        let crossing = MediumTransition { beyond, ratio };
        self.crossings.insert((media, start), crossing);
        crossing
    }

    /// What a ray in `media` comes to beyond a cemented contact of two surfaces, given by the starts of rays that are reflected
    /// at each: the one body is left, and the other entered.
    pub(crate) fn across_contact(
        &mut self,
        scene: &RenderScene,
        waves: &SampledWavelengths,
        media: u32,
        [one, other]: [u32; 2],
    ) -> MediumTransition {
        let RayOrigin { body, inwards } = RayOrigin::of_word(one);
        let is_left = scene.geometry.joined.whole_of(body, inwards).inwards;
        let [left, entered] = if is_left { [one, other] } else { [other, one] };
        let between = self.interface(scene, waves, media, left).beyond;
        let beyond = self.interface(scene, waves, between, entered).beyond;
        let ratio = self.ior(scene, waves, media) / self.ior(scene, waves, beyond);
        MediumTransition { beyond, ratio }
    }

    /// Whether light is bent nowhere between two lists of media, whatever its color.
    pub(crate) fn are_alike(
        &self,
        scene: &RenderScene,
        waves: &SampledWavelengths,
        one: u32,
        other: u32,
    ) -> bool {
        let is_white = self.wave(one).is_none();
        self.ior(scene, waves, one) == self.ior(scene, waves, other)
            && (!is_white || self.dispersion(scene, one) == self.dispersion(scene, other))
    }

    /// The indices by wavelength in these media, if they differ.
    pub(crate) fn dispersion<'s>(&self, scene: &'s RenderScene, media: u32) -> Option<&'s Dispersion> {
        let body = self.bodies(media).next()?;
        scene.material(scene.geometry.body(body)).dispersion.as_ref()
    }

    /// The index of refraction in these media: that of the body entered last, or of air.
    pub(crate) fn ior(&self, scene: &RenderScene, waves: &SampledWavelengths, media: u32) -> f32 {
        let Some(index) = self.bodies(media).next() else { return 1.0 };
        let material = scene.material(scene.geometry.body(index));
        let wavelength = || waves.nanometers(self.wave(media)?);
        match material.dispersion.zip(wavelength()) {
            Some((dispersion, nanometers)) => dispersion.index(nanometers) as f32,
            None => material.ior,
        }
    }

    /// The share of light that is left after ways of these lengths in the body entered last: for each way 1 if that is
    /// clear, or none.
    #[inline(never)]
    pub(crate) fn left_after<W: Width>(
        &self,
        w: W,
        scene: &RenderScene,
        media: W::W,
        lengths: W::R,
        lanes: W::M,
    ) -> Vector<W::R> {
        let mut lists = [AIR; MOST_LANES];
        media.store(&mut lists);
        let [mut red, mut green, mut blue] = [[0.0; MOST_LANES]; 3];
        for lane in (0..W::LANES).filter(|lane| lanes.bits() >> lane & 1 == 1) {
            if let Some(body) = self.bodies(lists[lane]).next() {
                [red[lane], green[lane], blue[lane]] = scene.material(scene.geometry.body(body)).absorption;
            }
        }
        w.run(
            #[inline(always)]
            || {
                Vector::new(w.load(&red), w.load(&green), w.load(&blue)).map(
                    #[inline(always)]
                    |loss: W::R| {
                        // A way without end through a clear body loses nothing.
                        let is_clear = loss.eq(w.real(0.0));
                        W::R::select(is_clear, w.real(1.0), exponential(-(loss * lengths)))
                    },
                )
            },
        )
    }

    /// The media at a point of space, such as the eye: every transparent body that contains it, the largest outermost.
    pub(crate) fn at_point(&mut self, scene: &RenderScene, point: Vector<f32>) -> u32 {
        if !scene.geometry.has_transparency {
            return AIR;
        }
        let mut around = Vec::new();
        let mut test = |index: u32| {
            let body = scene.geometry.body(index);
            if body.is_transparent() && scene.geometry.contains(index, point) {
                around.push(index);
            }
        };
        match &scene.geometry.hierarchy {
            Accelerator::Few => (0..scene.geometry.bounded).for_each(&mut test),
            Accelerator::Many(bvh) => bvh.visit_at(point.into(), |leaf| leaf.for_each(&mut test)),
        }
        scene.geometry.planes().for_each(&mut test);
        let volume = |index: u32| scene.geometry.body(index).volume();
        around
            .sort_by(|&a, &b| volume(b).total_cmp(&volume(a)).then_with(|| scene.geometry.scene_order(a, b)));
        around.into_iter().fold(AIR, |media, body| self.entered(media, body))
    }
}

impl MembershipSource for MediumStacks {
    #[inline(always)]
    fn fill<W: Width>(&self, membership: &mut BodyMembership, media: W::W, lanes: W::M) {
        membership.clear();
        let mut wet = (lanes & !media.is(AIR)).bits();
        if wet == 0 {
            return;
        }
        let mut lists = [AIR; MOST_LANES];
        media.store(&mut lists);
        while wet != 0 {
            let list = lists[wet.trailing_zeros() as usize % MOST_LANES];
            let same = media.is(list).bits() & wet;
            wet &= !same;
            self.add_to(membership, list, same);
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Body, Material, MaterialChoice, Phong, Scene};

    use super::*;

    fn list(table: &MediumStacks, media: u32) -> Vec<u32> {
        table.bodies(media).collect()
    }

    #[test]
    fn leaving_the_innermost_returns_to_the_one_around() {
        let mut table = MediumStacks::default();
        let outer = table.entered(AIR, 7);
        let inner = table.entered(outer, 3);
        assert_eq!(list(&table, inner), [3, 7]);
        assert_eq!(table.left(inner, 3), outer);
    }

    #[test]
    fn leaving_an_outer_body_keeps_the_inner_ones_in_order() {
        let mut table = MediumStacks::default();
        let media = [1, 2, 3].into_iter().fold(AIR, |media, body| table.entered(media, body));
        let media = table.left(media, 1);
        assert_eq!(list(&table, media), [3, 2]);
        let media = table.left(media, 3);
        assert_eq!(list(&table, media), [2]);
        assert_eq!(table.left(media, 2), AIR);
    }

    /// Where surfaces coincide a ray can start within a body without having entered it.
    #[test]
    fn a_body_that_was_never_entered_is_left_without_a_trace() {
        let glass = Material::Phong(Phong { transmission: 1.0, ior: 1.5, ..Phong::default() });
        let ball = Body { material: MaterialChoice::Inline(Box::new(glass)), ..Body::default() };
        let scene = Scene { bodies: [ball].into_iter().collect(), ..Scene::default() };
        let scene = RenderScene::build(&scene).unwrap();
        let (mut table, waves) = (MediumStacks::default(), SampledWavelengths::default());
        let mut cross = |media, start: RayOrigin| table.interface(&scene, &waves, media, start.word());
        let (outside, inside) = (RayOrigin { body: 0, inwards: false }, RayOrigin { body: 0, inwards: true });
        assert_eq!(cross(AIR, inside), MediumTransition { beyond: AIR, ratio: 1.0 });
        let glass = cross(AIR, outside);
        assert_eq!(glass.ratio, 1.0 / 1.5);
        assert_eq!(cross(glass.beyond, outside), MediumTransition { beyond: glass.beyond, ratio: 1.0 });
        assert_eq!(cross(glass.beyond, inside), MediumTransition { beyond: AIR, ratio: 1.5 });
    }

    #[test]
    fn equal_lists_are_one() {
        let mut table = MediumStacks::default();
        let once = table.entered(AIR, 1);
        let deeper = table.entered(once, 2);
        assert_eq!(table.entered(AIR, 1), once);
        assert_eq!(table.left(deeper, 2), once);
        assert_eq!(table.links.len(), 2);
    }

    #[test]
    fn rays_side_by_side_know_their_own_bodies() {
        let mut table = MediumStacks::default();
        let one = table.entered(AIR, 5);
        let both = table.entered(one, 2);
        let mut inside = BodyMembership::default();
        table.add_to(&mut inside, one, 0b1_0000);
        table.add_to(&mut inside, both, 0b10_0000_1000);
        assert_eq!((inside.of(5), inside.of(2), inside.of(3)), (0b10_0001_1000, 0b10_0000_1000, 0));
    }
}
