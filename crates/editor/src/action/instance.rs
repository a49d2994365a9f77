//! Instances of bodies: made, and made bodies of their own.

use catoptric_scene::{Anchor, Body, Instance, Placement, Scene, ScenePart, rotation_degrees};
use glam::{DMat3, DQuat};

use super::ActionError;
use super::fragment;
use super::outcome::{Result, edit_bodies, selected_bodies, subject, wanting};
use crate::edited_scene::EditedScene;
use crate::names::UsedNames;
use crate::selection::Selection;

/// The selected bodies, in the scene's order.
pub(super) fn check_duplicate(scene: &EditedScene, selection: &Selection) -> Result<Vec<usize>> {
    let mut indices = selected_bodies(scene, selection);
    indices.sort_unstable();
    if indices.is_empty() { Err(ActionError::NothingSelected) } else { Ok(indices) }
}

/// Bodies without a name get one, by which instances know them.
pub(super) fn duplicate(edited: &EditedScene, selection: &Selection) -> Result {
    let indices = check_duplicate(edited, selection)?;
    let parts: Vec<ScenePart> = indices.iter().copied().map(ScenePart::Body).collect();
    let mut names = UsedNames::of(edited.scene().bodies.iter().map(|body| body.name.as_str()));
    let mut named = edited.clone();
    let mut instances = Scene::default();
    named.edit(|scene| {
        for index in indices {
            let Some(body) = scene.bodies.get(index) else { continue };
            let name = match (&body.instance, body.name.is_empty()) {
                (Some(instance), _) => instance.of.clone(),
                (None, false) => body.name.clone(),
                (None, true) => names.take(body.body_shape().key()),
            };
            let instance = match &body.instance {
                Some(_) => body.clone(),
                None => instance_of(body, &name),
            };
            instances.bodies.push(Body { locked: false, ..instance });
            if body.instance.is_none()
                && body.name.is_empty()
                && let Some(body) = scene.bodies.get_mut(index)
            {
                body.name = name;
            }
        }
    });
    let mut outcome = fragment::add(&named, instances);
    outcome.subject = subject(named.scene(), &parts);
    Ok(outcome)
}

/// An instance that looks the same.
fn instance_of(body: &Body, name: &str) -> Body {
    let position = body.placement.origin();
    let turn = body.placement.world_from_body().matrix3 * DMat3::from_diagonal(body.placement.scale.recip());
    let anchor = match body.placement.anchor {
        anchor @ Anchor::Frame { .. } => anchor,
        Anchor::Axis { .. } => {
            Anchor::Frame { position, rotation_degrees: rotation_degrees(DQuat::from_mat3(&turn)) }
        }
    };
    Body {
        placement: Placement { anchor, ..body.placement },
        instance: Some(Instance::new(name.to_owned(), false)),
        ..Body::default()
    }
}

pub(super) fn check_make_own(scene: &EditedScene, selection: &Selection) -> Result<Vec<usize>> {
    wanting(scene, selection, |body| body.instance.is_some())
}

pub(super) fn make_own(scene: &EditedScene, selection: &Selection) -> Result {
    edit_bodies(scene, selection, |body| body.instance.is_some(), Body::make_own)
}
