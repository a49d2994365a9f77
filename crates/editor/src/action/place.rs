//! Actions on the placement of bodies.

use catoptric_scene::{Body, Placement};
use glam::DVec3;

use super::outcome::{Result, edit_bodies, wanting};
use crate::bounds;
use crate::edited_scene::EditedScene;
use crate::selection::Selection;

/// How far a body has to move up to stand on the ground; `None` when it stands there, within rounding, or is a plane.
fn to_ground(body: &Body) -> Option<f64> {
    let bounds = bounds::of_body(body)?;
    let rounding = 1e-12 * bounds.min.abs().max(bounds.max.abs()).max_element();
    (bounds.min.y.abs() > rounding).then_some(-bounds.min.y)
}

pub(super) fn check_drop(scene: &EditedScene, selection: &Selection) -> Result<()> {
    wanting(scene, selection, |body| to_ground(body).is_some()).map(drop)
}

pub(super) fn drop_to_ground(scene: &EditedScene, selection: &Selection) -> Result {
    edit_bodies(
        scene,
        selection,
        |body| to_ground(body).is_some(),
        |body| {
            if let Some(up) = to_ground(body) {
                body.placement = body.placement.moved_by(DVec3::Y * up);
            }
        },
    )
}

/// A body that stands upright, unturned and unscaled where it is; one between two points keeps its length.
fn upright(body: &Body) -> Body {
    let mut body = body.clone();
    body.shape = body.sized_shape();
    body.placement = Placement::at(body.placement.origin());
    body
}

fn is_turned(body: &Body) -> bool {
    body.placement != Placement::at(body.placement.origin())
}

pub(super) fn check_reset(scene: &EditedScene, selection: &Selection) -> Result<()> {
    wanting(scene, selection, is_turned).map(drop)
}

pub(super) fn reset(scene: &EditedScene, selection: &Selection) -> Result {
    edit_bodies(scene, selection, is_turned, |body| *body = upright(body))
}
