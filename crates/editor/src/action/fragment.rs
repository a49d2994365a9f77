//! Parts of a scene as text: what a clipboard carries.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::path::Path;

use catoptric_scene::{
    HasImages as _, ImageSource, List, MaterialChoice, Scene, ScenePart, Shape, read, write_fragment,
};
use glam::DVec3;

use super::nest::body_as_seen;
use super::part::focused;
use super::{ActionError, ActionOutcome, subject};
use crate::bounds;
use crate::document::mover;
use crate::edited_scene::EditedScene;
use crate::names::{UsedNames, base, used_materials};
use crate::selection::Selection;

/// How far copies are moved aside that are only lights or planes, meters.
const ASIDE: f64 = 0.5;

/// The most places that are tried for copies before they are left where something else stands.
const MOST_STEPS: u32 = 1000;

/// The selected bodies and lights or the part that is meant, and the materials they name or that are selected, as a scene
/// file's text. Paths of
/// pictures become whole where there is a `folder` at which they begin.
pub(crate) fn copy(edited: &EditedScene, selection: &Selection, folder: Option<&Path>) -> Option<String> {
    let scene = edited.scene();
    let chosen: BTreeSet<ScenePart> = edited.parts_of(selection).collect();
    let body = |part: &ScenePart| if let ScenePart::Body(at) = *part { scene.bodies.get(at) } else { None };
    let light = |part: &ScenePart| if let ScenePart::Light(at) = *part { scene.lights.get(at) } else { None };
    let mut bodies: List<_> = chosen.iter().filter_map(body).cloned().collect();
    if let Some(focus) = focused(edited, selection) {
        let name = if focus.part.name.is_empty() { &focus.body.name } else { &focus.part.name };
        // One that no body can be where it stands is copied as it is within its whole.
        let part = body_as_seen(&focus, name.clone()).ok().or_else(|| focus.path.as_body(focus.body));
        bodies = part.into_iter().collect();
    }
    let mut copied = Scene { bodies, ..Scene::default() };
    copied.free_lost_instances();
    let Scene { bodies, .. } = copied;
    let lights: Vec<_> = chosen.iter().filter_map(light).cloned().collect();
    let used = used_materials(&bodies);
    let materials = scene.materials.iter().enumerate();
    let materials: Vec<_> = materials
        .filter(|(index, named)| {
            chosen.contains(&ScenePart::Material(*index)) || used.contains(named.name.as_str())
        })
        .map(|(_, named)| named.clone())
        .collect();
    if bodies.is_empty() && lights.is_empty() && materials.is_empty() {
        return None;
    }
    let mut copied = Scene { materials, lights, bodies, ..Scene::default() };
    if folder.is_some() {
        copied.edit_images(&mut mover(folder, None));
    }
    Some(write_fragment(&copied))
}

/// Adds what a scene file's text says to a scene whose paths of pictures begin at `folder`.
pub(crate) fn paste(
    edited: &EditedScene,
    text: &str,
    folder: Option<&Path>,
) -> Result<ActionOutcome, ActionError> {
    if text.trim().is_empty() {
        return Err(ActionError::NothingToPaste);
    }
    let scene = edited.scene();
    let mut pasted = read(text).into_result().map_err(ActionError::BadText)?.value;
    let mut rename = mover(folder, folder);
    pasted.edit_images(&mut |image| {
        let known = |source: &ImageSource| scene.images().find(|known| known.source() == source);
        let mut found = known(image.source());
        if found.is_none() && folder.is_some() {
            // A whole path, as copies have it, becomes what the document would call it.
            rename(image);
            found = known(image.source());
        }
        // Else materials with the same picture would not be found to be the same.
        if let Some(found) = found {
            image.clone_from(found);
        }
    });
    let mut names = UsedNames::of_materials(scene);
    let mut renamed: HashMap<String, String> = HashMap::new();
    let mut added = Vec::new();
    for mut named in std::mem::take(&mut pasted.materials) {
        // Pasting the same again finds what the first time added under another name.
        let same = scene.materials.iter().filter(|other| other.material == named.material);
        let same = same.min_by_key(|other| other.name != named.name);
        let same =
            same.filter(|other| other.name == named.name || is_copy_name(&other.name, &named.name, scene));
        let name = match same {
            Some(same) => same.name.clone(),
            None => names.take(&named.name),
        };
        let is_new = same.is_none();
        renamed.insert(std::mem::replace(&mut named.name, name.clone()), name);
        if is_new {
            added.push(named);
        }
    }
    for body in &mut pasted.bodies {
        body.each_material_mut(&mut |choice| {
            if let Some(to) = choice.name().and_then(|name| renamed.get(name)) {
                *choice = MaterialChoice::Named(to.clone());
            }
        });
    }
    pasted.materials = added;
    if pasted.bodies.is_empty() && pasted.lights.is_empty() && pasted.materials.is_empty() {
        return Err(ActionError::NothingToPaste);
    }
    Ok(add(edited, pasted))
}

/// Whether `other` is what a material `name` was called when it was pasted beside another of its name.
fn is_copy_name(other: &str, name: &str, scene: &Scene) -> bool {
    base(other) == base(name) && scene.materials.iter().any(|named| named.name == name)
}

/// Adds bodies, lights and materials at the end of a scene's lists and selects them. The materials' names are taken to
/// be free; the other names are made so. What would stand exactly where something else does is moved a little.
pub(crate) fn add(edited: &EditedScene, mut parts: Scene) -> ActionOutcome {
    let scene = edited.scene();
    let mut names = UsedNames::of(scene.bodies.iter().map(|body| body.name.as_str()));
    let mut renamed = HashMap::new();
    for body in &mut parts.bodies {
        let name = names.take(&body.name);
        renamed.insert(std::mem::replace(&mut body.name, name.clone()), name);
        body.locked = false;
    }
    parts.rename_instances(&renamed);
    let mut names = UsedNames::of(scene.lights.iter().map(|light| light.name.as_str()));
    for light in &mut parts.lights {
        light.name = names.take(&light.name);
        light.locked = false;
    }
    move_aside(scene, &mut parts);
    let lights = (scene.lights.len()..).take(parts.lights.len()).map(ScenePart::Light);
    let bodies = (scene.bodies.len()..).take(parts.bodies.len()).map(ScenePart::Body);
    let mut added: Vec<ScenePart> = lights.chain(bodies).collect();
    if added.is_empty() {
        added = (scene.materials.len()..).take(parts.materials.len()).map(ScenePart::Material).collect();
    }
    let mut edited = edited.clone();
    edited.append(parts.materials, parts.lights, parts.bodies);
    let subject = subject(edited.scene(), &added);
    let selection = added.into_iter().filter_map(|part| edited.item(part)).collect();
    ActionOutcome { scene: edited, selection, subject }
}

/// A place as something that can be looked up.
fn key(place: DVec3) -> [u64; 3] {
    // −0 and 0 are one place.
    place.to_array().map(|number| (number + 0.0).to_bits())
}

/// Moves the parts together, by as many small steps as it takes, until none stands exactly where something of the
/// scene does.
fn move_aside(scene: &Scene, parts: &mut Scene) {
    let bodies: HashSet<[u64; 3]> = scene.bodies.iter().map(|body| key(body.placement.origin())).collect();
    let lights: HashSet<[u64; 3]> = scene.lights.iter().map(|light| key(light.position)).collect();
    let are_planes = parts.bodies.iter().all(|body| body.shape == Shape::Plane);
    let all: Vec<ScenePart> = (0..parts.bodies.len()).map(ScenePart::Body).collect();
    let step = match bounds::ball_of_parts(parts, &all) {
        Some(ball) => DVec3::new(0.5 * ball.radius, 0.0, 0.5 * ball.radius),
        // A plane that is moved along itself stays where it is.
        None if are_planes && !parts.bodies.is_empty() => DVec3::Y * ASIDE,
        None => DVec3::new(ASIDE, 0.0, ASIDE),
    };
    let is_free = |offset: &DVec3| {
        !parts.bodies.iter().any(|body| bodies.contains(&key(body.placement.origin() + *offset)))
            && !parts.lights.iter().any(|light| lights.contains(&key(light.position + *offset)))
    };
    let Some(offset) = (0..MOST_STEPS).map(|count| f64::from(count) * step).find(is_free) else { return };
    if offset == DVec3::ZERO {
        return;
    }
    for body in &mut parts.bodies {
        body.placement = body.placement.moved_by(offset);
    }
    for light in &mut parts.lights {
        light.position += offset;
    }
}
