//! What passes cemented contacts on the way to a light.
//!
//! A surface takes its share of the light whatever else is on the way, but for a contact: there two surfaces are one.
//! Shadow rays come to the bodies on their way in any order: what they cross is noted, and put in order afterwards.

use crate::geometry::membership::BodyMembership;
use crate::geometry::query::RayQuery;
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::coincident::SurfaceCrossing;
use crate::geometry::ray::{RayOrigin, RayPacket};
use crate::simd::scalar::ScalarWidth;
use crate::simd::{Float32 as _, MOST_LANES, Mask as _, Width};
use crate::transport::scene::RenderScene;
use crate::transport::surface::model::MaterialModel;

/// What shadow rays side by side cross of the surfaces of clear bodies that may be cemented: working memory of one light
/// after the other.
#[derive(Debug, Default)]
pub(crate) struct ShadowCrossings {
    list: Vec<(u32, SurfaceCrossing)>,
    /// Those of one ray.
    of_ray: Vec<SurfaceCrossing>,
}

impl ShadowCrossings {
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Notes that rays cross the surface of a body.
    #[cold]
    #[inline(never)]
    pub(crate) fn note<W: Width>(&mut self, body: u32, t: W::R, leaving: bool, lanes: W::M) {
        let mut ts = [0.0; MOST_LANES];
        t.store(&mut ts);
        let lanes = lanes.bits();
        for lane in (0..W::LANES).filter(|lane| lanes >> lane & 1 == 1) {
            self.note_one(lane, SurfaceCrossing { t: ts[lane], face: 0.0, body, leaving });
        }
    }

    /// Notes that a ray crosses a surface.
    pub(crate) fn note_one(&mut self, lane: usize, crossing: SurfaceCrossing) {
        self.list.push((lane as u32, crossing));
    }

    /// What all that was noted lets through of the light, of each ray. Forgets it.
    pub(crate) fn filters(
        &mut self,
        scene: &RenderScene,
        membership: &BodyMembership,
        ray: impl Fn(usize) -> RayPacket<ScalarWidth>,
    ) -> [[f32; MOST_LANES]; 3] {
        let Self { list, of_ray } = self;
        let mut shares = [[1.0; MOST_LANES]; 3];
        list.sort_unstable_by_key(|noted| noted.0);
        for noted in list.chunk_by(|a, b| a.0 == b.0) {
            let lane = noted.first().map_or(0, |noted| noted.0) as usize % MOST_LANES;
            of_ray.clear();
            of_ray.extend(noted.iter().map(|noted| noted.1));
            let contacts = contacts(scene, &ray(lane), &membership.of_lane(lane), of_ray);
            for (crossing, contact) in of_ray.iter().zip(contacts) {
                let filter = filter_of(scene, crossing.body, contact);
                for (shares, filter) in shares.iter_mut().zip(filter) {
                    shares[lane] *= filter;
                }
            }
        }
        list.clear();
        shares
    }
}

/// What a crossing of a shadow ray has to do with a cemented contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum ShadowContact {
    /// Nothing.
    #[default]
    None,
    /// The body is left for this part of another.
    Into(u32),
    /// The body is entered where another was left, which took its share.
    Behind,
}

/// Puts the crossings of a shadow ray in order, and finds those that are cemented contacts. The ray has come through the
/// surface that it starts from if it leaves a body that it is in.
pub(crate) fn contacts(
    scene: &RenderScene,
    ray: &RayPacket<ScalarWidth>,
    membership: &BodyMembership,
    crossings: &mut [SurfaceCrossing],
) -> Vec<ShadowContact> {
    let geometry = &scene.geometry;
    crossings.sort_unstable_by(|a, b| {
        let order = || geometry.scene_order(a.body, b.body);
        a.t.total_cmp(&b.t).then(b.leaving.cmp(&a.leaving)).then_with(order)
    });
    let query = RayQuery::new(ScalarWidth, geometry, ray, true, membership, Candidates::All);
    let mut contacts = vec![ShadowContact::None; crossings.len()];
    let mut find = |left: &SurfaceCrossing| {
        let cosine = query.cosine(left);
        let window = query.most_apart(left.t);
        let first = crossings.partition_point(|crossing| crossing.t < left.t - window);
        let near = (first..).zip(crossings.iter().skip(first));
        let touches = |place: usize, other: &SurfaceCrossing| {
            contacts.get(place) == Some(&ShadowContact::None)
                && !other.leaving
                && geometry.are_cemented(left.body, other.body)
                && query.coincide((left, cosine), other)
        };
        let (place, entered) = near
            .take_while(|(_, other)| other.t <= left.t + window)
            .filter(|&(place, other)| touches(place, other))
            .min_by(|(_, one), (_, other)| geometry.scene_order(one.body, other.body))?;
        *contacts.get_mut(place)? = ShadowContact::Behind;
        Some(entered.body)
    };
    let RayOrigin { body, inwards } = RayOrigin::of_word(ray.start);
    let start = geometry.joined.whole_of(body, inwards);
    if !start.inwards && membership.of(start.body) & 1 == 1 {
        find(&SurfaceCrossing { t: 0.0, face: 0.0, body, leaving: true });
    }
    let into: Vec<Option<u32>> =
        crossings.iter().map(|crossing| if crossing.leaving { find(crossing) } else { None }).collect();
    for (contact, into) in contacts.iter_mut().zip(into) {
        if let Some(into) = into {
            *contact = ShadowContact::Into(into);
        }
    }
    contacts
}

/// What the surface of a body lets through of the light of a shadow ray where it crosses that.
pub(crate) fn filter_of(scene: &RenderScene, crossed: u32, contact: ShadowContact) -> [f32; 3] {
    let material = |body: u32| scene.material(scene.geometry.body(body));
    let other = match contact {
        ShadowContact::None => return material(crossed).filter,
        ShadowContact::Behind => return [1.0; 3],
        ShadowContact::Into(other) => other,
    };
    let [left, entered] =
        [crossed, other].map(|body| material(scene.geometry.joined.whole_of(body, false).body));
    if left.ior == entered.ior && left.dispersion == entered.dispersion {
        return [1.0; 3];
    }
    let is_other = scene.geometry.scene_order(other, crossed).is_lt();
    let surface = material(if is_other { other } else { crossed });
    if !matches!(surface.law, MaterialModel::Dielectric) {
        return surface.filter;
    }
    // What is not reflected of light that falls in straight.
    let root = (left.ior - entered.ior) / (left.ior + entered.ior);
    [1.0 - root * root; 3]
}
