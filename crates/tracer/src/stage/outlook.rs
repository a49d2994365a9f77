//! What rays may meet that go from a handful of bodies to the lights, and those that are inside of one.

use super::{VisibleBodies, RenderScene, RenderLight};
use crate::ray::INWARDS;

/// A handful of bodies as they are seen from the lights, and each from within; of more, nothing is known.
#[derive(Clone, Debug, Default)]
pub(crate) struct ShadowCandidates {
    /// For each light that is a point.
    pub(crate) from_lights: Vec<Option<VisibleBodies>>,
    /// By light and body, what may shade the body.
    before: Vec<Vec<SideOccluders>>,
    /// By body, what rays inside of it may meet, if it is transparent.
    within: Vec<Option<VisibleBodies>>,
}

/// What may shade a body.
#[derive(Clone, Debug)]
struct SideOccluders {
    outer_side: VisibleBodies,
    /// The same and the body itself, if it is transparent.
    inner_side: Option<VisibleBodies>,
}

impl ShadowCandidates {
    /// With more lights and bodies it would take long to find out what may shade what.
    const MOST_BEFORE: usize = 1 << 14;

    pub(super) fn of(stage: &RenderScene) -> Self {
        let bodies = stage.bounded as usize;
        // What lies where is not known well enough in single precision of bodies in double.
        if bodies > RenderScene::FEW || stage.has_doubles() {
            return Self::default();
        }
        let from_light = |light: &RenderLight| match light.radius {
            0.0 => stage.seen_from_light(light.position),
            _ => None,
        };
        let from_lights: Vec<_> = stage.lights.iter().map(from_light).collect();
        let mut before = Vec::new();
        if bodies * bodies * from_lights.len() <= Self::MOST_BEFORE {
            let both_sides = |(outer_side, body): (VisibleBodies, u32)| {
                let is_transparent = stage.body(body).is_transparent();
                SideOccluders { inner_side: is_transparent.then(|| outer_side.and(body)), outer_side }
            };
            let of_light =
                |all: &VisibleBodies| stage.seen_before(all).into_iter().zip(0..).map(both_sides).collect();
            before.extend(from_lights.iter().map(|all| all.as_ref().map(of_light).unwrap_or_default()));
        }
        Self { from_lights, before, within: stage.seen_within() }
    }

    /// What rays may meet that are inside of this bounded body, and of no other.
    pub(crate) fn within(&self, body: u32) -> Option<&VisibleBodies> {
        self.within.get(body as usize)?.as_ref()
    }

    /// What rays may meet on their way to a light, wherever they start.
    pub(crate) fn to_light(&self, light: usize) -> Option<&VisibleBodies> {
        self.from_lights.get(light)?.as_ref()
    }

    /// The same if they start from a bounded body, with [`INWARDS`] from its inner side.
    pub(crate) fn to_light_from(&self, light: usize, start: u32) -> Option<&VisibleBodies> {
        let before = self.before.get(light)?.get((start & !INWARDS) as usize)?;
        match start & INWARDS {
            0 => Some(&before.outer_side),
            _ => before.inner_side.as_ref(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::OnceLock;

    use catoptric_scene::{Anchor, Body, Light, Material, MaterialChoice, Placement, Scene, Shape};
    use glam::DVec3;
    use proptest::collection::vec;
    use proptest::prelude::*;

    use super::super::sight::tests::{body, moved, point};
    use super::*;
    use crate::{RenderControl, RenderSettings, render};

    fn of(body: Body, transmission: f64) -> Body {
        let material =
            Material { diffuse: 0.3, reflection: Some(0.2), transmission, ior: 1.4, ..Material::default() };
        Body { material: MaterialChoice::Inline(Box::new(material)), ..body }
    }

    fn glass(body: Body) -> Body {
        of(body, 0.6)
    }

    fn floor() -> Body {
        Body { shape: Shape::Plane, ..Body::default() }
    }

    /// What rays inside of the first body may meet, by numbers in the scene.
    fn within(bodies: Vec<Body>) -> Vec<usize> {
        let stage = RenderScene::prepare(&Scene { bodies: bodies.into(), ..Scene::default() }).unwrap();
        let own = (0..stage.bounded).find(|&place| stage.scene_index(place) == Some(0)).unwrap();
        let sights = stage.outlook().within(own).unwrap();
        let places = sights.bodies.iter().map(|sight| sight.body).chain(sights.planes.iter().copied());
        let mut numbers: Vec<_> = places.filter_map(|place| stage.scene_index(place)).collect();
        numbers.sort_unstable();
        numbers
    }

    proptest! {
        /// What reaches into a body is known, however it does.
        #[test]
        fn nothing_within_a_body_is_missed((own, inside) in body(), other in body()) {
            let target = own.placement.world_from_body().transform_point3(inside);
            let bodies = vec![glass(own), moved(other, target)];
            let stage = RenderScene::prepare(&Scene { bodies: bodies.clone().into(), ..Scene::default() }).unwrap();
            prop_assume!(!stage.has_doubles());
            prop_assert_eq!(within(bodies), [0, 1]);
        }

        /// It saves time, and that is all.
        #[test]
        fn what_is_known_changes_no_picture(
            bodies in vec((body(), point(1.0), any::<bool>()), 2..6),
            lights in vec(point(8.0), 1..3),
            stands in any::<bool>(),
        ) {
            let placed = |(body, at, is_glass)| of(moved(body, at), if is_glass { 0.6 } else { 0.0 });
            let mut bodies: Vec<_> = bodies.into_iter().map(placed).collect();
            if stands {
                bodies.push(floor());
            }
            let light = |position| Light { position, ..Light::default() };
            let lights = lights.into_iter().map(light).collect();
            let stage = RenderScene::prepare(&Scene { bodies: bodies.into(), lights, ..Scene::default() }).unwrap();
            let blind = RenderScene { outlook: OnceLock::from(ShadowCandidates::default()), ..stage.clone() };
            let settings = RenderSettings { width: 40, height: 24, samples: 1 };
            let [seen, unseen] = [stage, blind].map(|stage| render(&stage, settings, &RenderControl::default()).unwrap());
            prop_assert_eq!(seen.counts, unseen.counts);
            let bits = |picture: &catoptric_picture::Picture| {
                picture.pixels().iter().flatten().map(|part| part.to_bits()).collect::<Vec<_>>()
            };
            prop_assert_eq!(bits(&seen.picture), bits(&unseen.picture));
        }
    }

    /// What is elsewhere, even nearby, is met by no ray within a body.
    #[test]
    fn what_stands_apart_is_not_within() {
        let ball = |x: f64, y: f64| {
            let anchor = Anchor::Frame { position: DVec3::new(x, y, 0.0), rotation_degrees: DVec3::ZERO };
            let placement = Placement { anchor, ..Placement::default() };
            Body { shape: Shape::Sphere { radius: 1.0 }, placement, ..Body::default() }
        };
        let with = |other: Body| within(vec![glass(ball(0.0, 1.0)), other]);
        assert_eq!([1.9, 2.0, 2.1].map(|x| with(ball(x, 1.0)).len()), [2, 2, 1]);
        // It touches the floor, or hovers above it.
        assert_eq!(with(floor()), [0, 1]);
        assert_eq!(within(vec![glass(ball(0.0, 1.1)), floor()]), [0]);
    }
}
