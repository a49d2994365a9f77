//! Named materials and bodies' own.

use catoptric_scene::{Body, MaterialChoice, NamedMaterial, Scene};

use super::ActionError;
use super::list::{delete_items, own};
use super::outcome::{ActionOutcome, Result, edit_bodies, free_bodies, wanting};
use crate::names::{UsedNames, used_materials};
use crate::selection::{Item, Selection};

fn check_defined(scene: &Scene, choice: &MaterialChoice) -> Result<()> {
    scene.material(choice).map(drop).ok_or(ActionError::NoSuchItem)
}

pub(super) fn check_assign(scene: &Scene, selection: &Selection, choice: &MaterialChoice) -> Result<()> {
    check_defined(scene, choice)?;
    wanting(scene, selection, |body| body.material != *choice).map(drop)
}

pub(super) fn assign(scene: &Scene, selection: &Selection, choice: &MaterialChoice) -> Result {
    check_defined(scene, choice)?;
    edit_bodies(scene, selection, |body| body.material != *choice, |body| body.material = choice.clone())
}

/// The selected body chosen last, whose material is shared.
pub(super) fn check_share<'a>(scene: &'a Scene, selection: &Selection) -> Result<&'a Body> {
    let indices = free_bodies(scene, selection)?;
    let primary = selection.bodies().next_back().and_then(|index| scene.bodies.get(index));
    let primary = primary.ok_or(ActionError::NothingSelected)?;
    let has_it_already = |index: &usize| {
        scene
            .bodies
            .get(*index)
            .is_some_and(|body| primary.material.name().is_some() && body.material == primary.material)
    };
    if indices.iter().all(has_it_already) { Err(ActionError::NothingToDo) } else { Ok(primary) }
}

pub(super) fn share(scene: &Scene, selection: &Selection) -> Result {
    let primary = check_share(scene, selection)?;
    let MaterialChoice::Inline(material) = &primary.material else {
        return assign(scene, selection, &primary.material);
    };
    let mut names = UsedNames::of_materials(scene);
    let name = names.take(if primary.name.is_empty() { "material" } else { &primary.name });
    let choice = MaterialChoice::Named(name.clone());
    let mut with = scene.clone();
    with.materials.push(NamedMaterial { name, material: (**material).clone() });
    assign(&with, selection, &choice)
}

fn is_named(body: &Body) -> bool {
    body.material.name().is_some()
}

pub(super) fn check_make_unique(scene: &Scene, selection: &Selection) -> Result<()> {
    wanting(scene, selection, is_named).map(drop)
}

pub(super) fn make_unique(scene: &Scene, selection: &Selection) -> Result {
    edit_bodies(scene, selection, is_named, |body| body.material = own(scene, &body.material))
}

/// The places of the materials that no body uses.
pub(super) fn check_unused(scene: &Scene) -> Result<Vec<Item>> {
    let used = used_materials(&scene.bodies);
    let unused = scene.materials.iter().enumerate().filter(|(_, named)| !used.contains(named.name.as_str()));
    let unused: Vec<Item> = unused.map(|(index, _)| Item::Material(index)).collect();
    if unused.is_empty() { Err(ActionError::NothingToDo) } else { Ok(unused) }
}

pub(super) fn remove_unused(scene: &Scene, selection: &Selection) -> Result {
    Ok(delete_items(scene, selection, &check_unused(scene)?))
}

/// The name that an item would get.
pub(super) fn check_rename(scene: &Scene, item: Item, name: &str) -> Result<String> {
    let (is_material, names): (bool, Vec<&str>) = match item {
        Item::Material(_) => (true, scene.materials.iter().map(|named| named.name.as_str()).collect()),
        Item::Light(_) => (false, scene.lights.iter().map(|light| light.name.as_str()).collect()),
        Item::Body(_) => (false, scene.bodies.iter().map(|body| body.name.as_str()).collect()),
        Item::Camera | Item::Environment | Item::Tracing => return Err(ActionError::NoSuchItem),
    };
    if !item.is_in(scene) {
        return Err(ActionError::NoSuchItem);
    }
    let (name, old) = (name.trim(), item.name(scene));
    if is_material && name.is_empty() {
        return Err(ActionError::EmptyName);
    }
    let name = UsedNames::of(names.into_iter().filter(|other| *other != old)).take(name);
    if name == old { Err(ActionError::NothingToDo) } else { Ok(name) }
}

pub(super) fn rename(scene: &Scene, selection: &Selection, item: Item, name: &str) -> Result {
    let name = check_rename(scene, item, name)?;
    let old = item.name(scene);
    let mut outcome = ActionOutcome::edited(scene, selection, &[item], |scene| match item {
        Item::Material(index) => {
            let old = MaterialChoice::Named(old.to_owned());
            for body in scene.bodies.iter_mut().filter(|body| body.material == old) {
                body.material = MaterialChoice::Named(name.clone());
            }
            if let Some(named) = scene.materials.get_mut(index) {
                named.name.clone_from(&name);
            }
        }
        Item::Light(index) => {
            if let Some(light) = scene.lights.get_mut(index) {
                light.name.clone_from(&name);
            }
        }
        Item::Body(index) => {
            if let Some(body) = scene.bodies.get_mut(index) {
                body.name.clone_from(&name);
            }
        }
        Item::Camera | Item::Environment | Item::Tracing => {}
    });
    outcome.subject = name;
    Ok(outcome)
}
