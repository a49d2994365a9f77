//! Moving a light by what it does: its highlight or its shadow goes where the pointer is. Knows nothing of egui.

use catoptric_scene::Scene;
use glam::{DVec2, DVec3};

use super::gizmo::steps::{decimal_below, rounded};
use super::visible_picture::VisiblePicture;

/// How much of the way to an obstacle a light keeps.
const CLEARANCE: f64 = 0.9;

/// The drag of a light by its highlight or a shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LightAim {
    /// The light's place in [`Scene::lights`].
    pub(crate) light: usize,
    /// How far it stays from the point that it is turned about, meters.
    distance: f64,
    by: AimAnchor,
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
    /// Takes a light by what it does at a place of the picture: by the shadow that lies there, if `by_shadow` allows
    /// that, otherwise by its highlight. `None` where no body is seen.
    pub(crate) fn begin(
        sight: &VisiblePicture,
        scene: &Scene,
        light: usize,
        at: DVec2,
        by_shadow: bool,
    ) -> Option<Self> {
        let place = scene.lights.get(light)?.position;
        let surface = sight.body_at(at)?.position;
        let (by, center) = match sight.between(place, surface).filter(|_| by_shadow) {
            Some(occluder) => (AimAnchor::Shadow(occluder.position), occluder.position),
            None => (AimAnchor::Highlight, surface),
        };
        let distance = place.distance(center);
        (distance > 0.0 && distance.is_finite()).then_some(Self { light, distance, by })
    }

    /// Whether a shadow follows the pointer.
    pub(crate) fn is_by_shadow(&self) -> bool {
        matches!(self.by, AimAnchor::Shadow(_))
    }

    /// Where the light must stand for a pointer at this place; `None` when there is no such place, or something would
    /// hide it from there.
    pub(crate) fn to(&self, sight: &VisiblePicture, at: DVec2) -> Option<DVec3> {
        let hit = sight.body_at(at)?;
        let place = match self.by {
            AimAnchor::Highlight => {
                let incoming = sight.lens.ray(at).direction;
                let mirrored = incoming.reflect(hit.normal.as_dvec3()).normalize_or_zero();
                let free = sight.free_way(&hit, mirrored).map_or(f64::INFINITY, |way| CLEARANCE * way);
                hit.position + self.distance.min(free) * mirrored
            }
            AimAnchor::Shadow(occluder) => {
                let direction = (occluder - hit.position).normalize_or_zero();
                occluder + self.distance * direction
            }
        };
        let grid = decimal_below(0.1 * sight.lens.meters_per_point(hit.position));
        let place = place.map(|part| rounded(part, grid));
        let is_clear = match self.by {
            AimAnchor::Highlight => true,
            AimAnchor::Shadow(occluder) => sight.is_clear(place, occluder),
        };
        (place.is_finite() && is_clear).then_some(place)
    }
}
