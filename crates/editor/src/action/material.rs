//! Named materials and bodies' own.

use std::collections::HashMap;

use catoptric_scene::{Body, MaterialChoice, NamedMaterial, Scene, ScenePart};

use super::ActionError;
use super::list::{delete_parts, own};
use super::outcome::{ActionOutcome, Result, edit_bodies, free_bodies, selected_bodies, wanting};
use crate::edited_scene::EditedScene;
use crate::identity::Item;
use crate::names::{UsedNames, used_materials};
use crate::selection::Selection;

fn check_defined(scene: &Scene, choice: &MaterialChoice) -> Result<()> {
    scene.material(choice).map(drop).ok_or(ActionError::NoSuchItem)
}

pub(super) fn check_assign(
    scene: &EditedScene,
    selection: &Selection,
    choice: &MaterialChoice,
) -> Result<()> {
    check_defined(scene.scene(), choice)?;
    wanting(scene, selection, |body| body.material != *choice).map(drop)
}

pub(super) fn assign(scene: &EditedScene, selection: &Selection, choice: &MaterialChoice) -> Result {
    check_defined(scene.scene(), choice)?;
    edit_bodies(scene, selection, |body| body.material != *choice, |body| body.material = choice.clone())
}

/// The selected body chosen last, whose material is shared.
pub(super) fn check_share<'a>(scene: &'a EditedScene, selection: &Selection) -> Result<&'a Body> {
    let indices = free_bodies(scene, selection)?;
    let bodies = &scene.scene().bodies;
    let primary = selected_bodies(scene, selection).last().and_then(|index| bodies.get(*index));
    let primary = primary.ok_or(ActionError::NothingSelected)?;
    let has_it_already = |index: &usize| {
        bodies
            .get(*index)
            .is_some_and(|body| primary.material.name().is_some() && body.material == primary.material)
    };
    if indices.iter().all(has_it_already) { Err(ActionError::NothingToDo) } else { Ok(primary) }
}

pub(super) fn share(scene: &EditedScene, selection: &Selection) -> Result {
    let primary = check_share(scene, selection)?;
    let MaterialChoice::Inline(material) = &primary.material else {
        return assign(scene, selection, &primary.material);
    };
    let mut names = UsedNames::of_materials(scene.scene());
    let name = names.take(if primary.name.is_empty() { "material" } else { &primary.name });
    let choice = MaterialChoice::Named(name.clone());
    let mut with = scene.clone();
    with.append([NamedMaterial { name, material: (**material).clone() }], [], []);
    assign(&with, selection, &choice)
}

fn is_named(body: &Body) -> bool {
    body.materials().any(|choice| choice.name().is_some())
}

pub(super) fn check_make_unique(scene: &EditedScene, selection: &Selection) -> Result<()> {
    wanting(scene, selection, is_named).map(drop)
}

pub(super) fn make_unique(scene: &EditedScene, selection: &Selection) -> Result {
    edit_bodies(scene, selection, is_named, |body| {
        body.each_material_mut(&mut |choice| *choice = own(scene.scene(), choice));
    })
}

/// The places of the materials that no body uses.
pub(super) fn check_unused(scene: &Scene) -> Result<Vec<ScenePart>> {
    let used = used_materials(&scene.bodies);
    let unused = scene.materials.iter().enumerate().filter(|(_, named)| !used.contains(named.name.as_str()));
    let unused: Vec<ScenePart> = unused.map(|(index, _)| ScenePart::Material(index)).collect();
    if unused.is_empty() { Err(ActionError::NothingToDo) } else { Ok(unused) }
}

pub(super) fn remove_unused(scene: &EditedScene, selection: &Selection) -> Result {
    Ok(delete_parts(scene, selection, &check_unused(scene.scene())?))
}

/// The place of an item and the name that it would get.
pub(super) fn check_rename(edited: &EditedScene, item: Item, name: &str) -> Result<(ScenePart, String)> {
    let part = edited.part(item).ok_or(ActionError::NoSuchItem)?;
    let scene = edited.scene();
    let names: Vec<&str> = match part {
        ScenePart::Material(_) => scene.materials.iter().map(|named| named.name.as_str()).collect(),
        ScenePart::Light(_) => scene.lights.iter().map(|light| light.name.as_str()).collect(),
        ScenePart::Body(_) => scene.bodies.iter().map(|body| body.name.as_str()).collect(),
        ScenePart::Camera | ScenePart::Environment | ScenePart::Tracing => {
            return Err(ActionError::NoSuchItem);
        }
    };
    let (name, old) = (name.trim(), part.name(scene));
    if matches!(part, ScenePart::Material(_)) && name.is_empty() {
        return Err(ActionError::EmptyName);
    }
    let name = UsedNames::of(names.into_iter().filter(|other| *other != old)).take(name);
    if name == old { Err(ActionError::NothingToDo) } else { Ok((part, name)) }
}

pub(super) fn rename(scene: &EditedScene, selection: &Selection, item: Item, name: &str) -> Result {
    let (part, name) = check_rename(scene, item, name)?;
    let old = part.name(scene.scene());
    let mut outcome = ActionOutcome::edited(scene, selection, &[part], |scene| match part {
        ScenePart::Material(index) => {
            let places: Vec<usize> = (0..scene.bodies.len())
                .filter(|place| scene.bodies.get(*place).is_some_and(|body| body.uses_material(old)))
                .collect();
            for place in places {
                if let Some(body) = scene.bodies.get_mut(place) {
                    body.each_material_mut(&mut |choice| {
                        if choice.name() == Some(old) {
                            *choice = MaterialChoice::Named(name.clone());
                        }
                    });
                }
            }
            if let Some(named) = scene.materials.get_mut(index) {
                named.name.clone_from(&name);
            }
        }
        ScenePart::Light(index) => {
            if let Some(light) = scene.lights.get_mut(index) {
                light.name.clone_from(&name);
            }
        }
        ScenePart::Body(index) => {
            if let Some(body) = scene.bodies.get_mut(index) {
                let old = std::mem::replace(&mut body.name, name.clone());
                if !old.is_empty() {
                    scene.rename_instances(&HashMap::from([(old, name.clone())]));
                }
            }
        }
        ScenePart::Camera | ScenePart::Environment | ScenePart::Tracing => {}
    });
    outcome.subject = name;
    Ok(outcome)
}
