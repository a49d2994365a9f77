//! The place of a new light.

use catoptric_live::Live;
use catoptric_scene::Scene;
use glam::{DVec2, DVec3};

use super::PlacementView;
use crate::panels::viewport::Viewport;
use crate::panels::viewport::gizmo::steps::{decimal_below, rounded};
use crate::state::view::ViewState;

/// Places of the picture that are tried, as parts of its width and height: first where photographers put their key
/// light.
const PLACES: [[f64; 2]; 8] =
    [[0.3, 0.2], [0.7, 0.2], [0.2, 0.35], [0.8, 0.35], [0.5, 0.15], [0.1, 0.2], [0.9, 0.2], [0.5, 0.35]];

/// Depths that are tried, as parts of the subject's.
const DEPTHS: [f64; 5] = [0.7, 0.85, 0.5, 1.0, 0.3];

/// The least cosine under which a light falls on the subject.
const LEAST_COSINE: f64 = 0.3;

/// The best place for a new light: in the picture, with free sight of what the picture's middle shows.
pub(crate) fn place_for_light(scene: &Scene, view: &ViewState, viewport: &Viewport, live: &Live) -> DVec3 {
    let scenery = PlacementView::new(scene, view, viewport, live);
    let grid = decimal_below(0.15 * scenery.reach());
    let mut places =
        DEPTHS.into_iter().flat_map(|depth| PLACES.map(|[x, y]| (scenery.place(DVec2::new(x, y)), depth)));
    let place = places.find_map(|(at, depth)| {
        let place = scenery.point_at(at, depth).map(|part| rounded(part, grid));
        scenery.lights_well(place).then_some(place)
    });
    place.unwrap_or_else(|| {
        (scenery.subject + 0.5 * scenery.reach() * DVec3::Y).map(|part| rounded(part, grid))
    })
}

impl PlacementView<'_> {
    /// Whether a light at a place is seen, apart from the others, and lights the subject.
    fn lights_well(&self, place: DVec3) -> bool {
        let apart = 0.05 * self.reach();
        let is_apart = self.scene.lights.iter().all(|light| light.position.distance(place) > apart);
        place.is_finite() && is_apart && self.is_seen(place) && self.lights_subject(place)
    }

    fn lights_subject(&self, place: DVec3) -> bool {
        let Some(hit) = self.scene_view.body_at(self.place(DVec2::splat(0.5))) else {
            // There is no surface: light from above is as good as any.
            return place.y > self.subject.y;
        };
        let way = place - hit.position;
        let cosine = way.normalize_or_zero().dot(hit.normal.as_dvec3());
        cosine > LEAST_COSINE && self.scene_view.is_clear(place, hit.position)
    }
}
