//! Moves a light so that its highlight or its shadow follows the pointer. Knows nothing of egui.

use glam::{DVec2, DVec3};

use super::gizmo::steps::{decimal_below, rounded};
use super::scene_view::SceneView;

/// How much of the way to an obstacle a light keeps.
const CLEARANCE: f64 = 0.9;

/// The drag of a light by its highlight or a shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LightAim {
    /// How far it stays from the point that it is turned about, meters.
    distance: f64,
    anchor: AimAnchor,
}

/// The feature of the light that follows the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
enum AimAnchor {
    /// The highlight: the light stands where the ray of the pointer goes when it is mirrored.
    Highlight,
    /// The shadow of this point of a body.
    Shadow(DVec3),
}

impl LightAim {
    /// Takes the light at `place`, meters, by what it does at a place of the picture: by the shadow that lies there, if `by_shadow` allows
    /// that, otherwise by its highlight. `None` where no body is seen.
    pub(crate) fn begin(scene_view: &SceneView, place: DVec3, at: DVec2, by_shadow: bool) -> Option<Self> {
        let surface = scene_view.body_at(at)?.position;
        let (anchor, center) = match scene_view.between(place, surface).filter(|_| by_shadow) {
            Some(occluder) => (AimAnchor::Shadow(occluder.position), occluder.position),
            None => (AimAnchor::Highlight, surface),
        };
        let distance = place.distance(center);
        (distance > 0.0 && distance.is_finite()).then_some(Self { distance, anchor })
    }

    /// Whether a shadow follows the pointer.
    pub(crate) fn is_by_shadow(&self) -> bool {
        matches!(self.anchor, AimAnchor::Shadow(_))
    }

    /// Where the light must stand for a pointer at this place; `None` when there is no such place, or something would
    /// hide it from there.
    pub(crate) fn to(&self, scene_view: &SceneView, at: DVec2) -> Option<DVec3> {
        let hit = scene_view.body_at(at)?;
        let place = match self.anchor {
            AimAnchor::Highlight => {
                let incoming = scene_view.projector.ray(at).direction;
                let mirrored = incoming.reflect(hit.normal.as_dvec3()).normalize_or_zero();
                let free = scene_view.free_way(&hit, mirrored).map_or(f64::INFINITY, |way| CLEARANCE * way);
                hit.position + self.distance.min(free) * mirrored
            }
            AimAnchor::Shadow(occluder) => {
                let direction = (occluder - hit.position).normalize_or_zero();
                occluder + self.distance * direction
            }
        };
        let grid = decimal_below(0.1 * scene_view.projector.meters_per_point(hit.position));
        let place = place.map(|part| rounded(part, grid));
        let is_clear = match self.anchor {
            AimAnchor::Highlight => true,
            AimAnchor::Shadow(occluder) => scene_view.is_clear(place, occluder),
        };
        (place.is_finite() && is_clear).then_some(place)
    }
}
