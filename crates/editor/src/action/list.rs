//! Actions on the lists: duplicates, deletions, order.

use std::collections::HashSet;

use catoptric_scene::{MaterialChoice, Scene};

use super::ActionError;
use super::fragment;
use super::outcome::{ActionOutcome, Result, subject};
use crate::names::UsedNames;
use crate::selection::{Item, Selection};

/// The selected bodies, lights and materials, in the scene's order.
fn things(selection: &Selection) -> Vec<Item> {
    let mut items: Vec<Item> = selection
        .iter()
        .filter(|item| matches!(item, Item::Body(_) | Item::Light(_) | Item::Material(_)))
        .collect();
    items.sort_unstable();
    items
}

pub(super) fn check_duplicate(selection: &Selection) -> Result<Vec<Item>> {
    let items = things(selection);
    if items.is_empty() { Err(ActionError::NothingSelected) } else { Ok(items) }
}

pub(super) fn duplicate(scene: &Scene, selection: &Selection) -> Result {
    let items = check_duplicate(selection)?;
    let mut copies = Scene::default();
    let mut names = UsedNames::of_materials(scene);
    for &item in &items {
        match item {
            Item::Body(index) => copies.bodies.extend(scene.bodies.get(index).cloned()),
            Item::Light(index) => copies.lights.extend(scene.lights.get(index).cloned()),
            Item::Material(index) => {
                let mut copy = scene.materials.get(index).cloned();
                if let Some(copy) = &mut copy {
                    copy.name = names.take(&copy.name);
                }
                copies.materials.extend(copy);
            }
            Item::Camera | Item::Environment | Item::Tracing => {}
        }
    }
    let subject = subject(scene, &items);
    let mut outcome = fragment::add(scene, copies);
    outcome.subject = subject;
    Ok(outcome)
}

pub(super) fn check_delete(scene: &Scene, selection: &Selection) -> Result<Vec<Item>> {
    let mut items = check_duplicate(selection)?;
    items.retain(|item| !item.is_locked(scene));
    if items.is_empty() { Err(ActionError::Locked) } else { Ok(items) }
}

pub(super) fn delete(scene: &Scene, selection: &Selection) -> Result {
    Ok(delete_items(scene, selection, &check_delete(scene, selection)?))
}

/// Deletes these, which are sorted.
pub(super) fn delete_items(scene: &Scene, selection: &Selection, items: &[Item]) -> ActionOutcome {
    let subject = subject(scene, items);
    let gone: HashSet<Item> = items.iter().copied().collect();
    let mut left = scene.clone();
    let lost: HashSet<&str> =
        items.iter().filter(|item| matches!(item, Item::Material(_))).map(|item| item.name(scene)).collect();
    for (index, body) in scene.bodies.iter().enumerate() {
        if body.material.name().is_some_and(|name| lost.contains(name))
            && let Some(left) = left.bodies.get_mut(index)
        {
            left.material = own(scene, &body.material);
        }
    }
    left.materials.retain(stays(&gone, Item::Material));
    left.lights.retain(stays(&gone, Item::Light));
    if items.iter().any(|item| matches!(item, Item::Body(_))) {
        left.bodies.retain(stays(&gone, Item::Body));
    }
    let before = |index: usize, kind: ItemFromIndex| {
        let less = |than: Item| items.partition_point(|item| *item < than);
        less(kind(index)) - less(kind(0))
    };
    let selection = selection.mapped(|item| match item {
        item if gone.contains(&item) => None,
        Item::Material(index) => Some(Item::Material(index - before(index, Item::Material))),
        Item::Light(index) => Some(Item::Light(index - before(index, Item::Light))),
        Item::Body(index) => Some(Item::Body(index - before(index, Item::Body))),
        item => Some(item),
    });
    ActionOutcome { scene: left, selection, subject }
}

/// A material as a body's own.
pub(super) fn own(scene: &Scene, choice: &MaterialChoice) -> MaterialChoice {
    MaterialChoice::Inline(Box::new(scene.material(choice).cloned().unwrap_or_default()))
}

/// Whether the next element of a list is not gone.
fn stays<T>(gone: &HashSet<Item>, kind: ItemFromIndex) -> impl FnMut(&T) -> bool {
    let mut indices = 0..;
    move |_| indices.next().is_some_and(|index| !gone.contains(&kind(index)))
}

/// Turns a place in a list into an item.
type ItemFromIndex = fn(usize) -> Item;

/// A move of items within their list.
#[derive(Clone, Copy)]
pub(super) enum ListMove {
    Up,
    Down,
    To(usize),
}

/// The kind of the primary item, and the order of its list after a move: for each new place the old one.
pub(super) fn check_reorder(
    scene: &Scene,
    selection: &Selection,
    to: ListMove,
) -> Result<(ItemFromIndex, Vec<usize>)> {
    let (kind, count): (ItemFromIndex, usize) = match selection.primary() {
        Some(Item::Material(_)) => (Item::Material, scene.materials.len()),
        Some(Item::Light(_)) => (Item::Light, scene.lights.len()),
        Some(Item::Body(_)) => (Item::Body, scene.bodies.len()),
        _ => return Err(ActionError::NothingSelected),
    };
    let selected: HashSet<Item> = selection.iter().collect();
    let is_moved = |index: usize| selected.contains(&kind(index));
    let order = match to {
        ListMove::Up => shifted((0..count).collect(), is_moved),
        ListMove::Down => {
            let mut order = shifted((0..count).rev().collect(), is_moved);
            order.reverse();
            order
        }
        ListMove::To(place) => {
            let place = place.min(count);
            let before = (0..place).filter(|index| !is_moved(*index));
            let moved = (0..count).filter(|index| is_moved(*index));
            let after = (place..count).filter(|index| !is_moved(*index));
            before.chain(moved).chain(after).collect()
        }
    };
    if order.iter().enumerate().all(|(new, old)| new == *old) {
        return Err(ActionError::NothingToDo);
    }
    Ok((kind, order))
}

/// An order in which each moved element has changed places with the one before it, unless that moves too.
fn shifted(mut order: Vec<usize>, is_moved: impl Fn(usize) -> bool) -> Vec<usize> {
    for place in 1..order.len() {
        let pair = (order.get(place - 1).copied(), order.get(place).copied());
        if let (Some(before), Some(this)) = pair
            && is_moved(this)
            && !is_moved(before)
        {
            order.swap(place - 1, place);
        }
    }
    order
}

pub(super) fn reorder(scene: &Scene, selection: &Selection, to: ListMove) -> Result {
    let (kind, order) = check_reorder(scene, selection, to)?;
    let moved: Vec<Item> = selection
        .iter()
        .filter(|item| std::mem::discriminant(item) == std::mem::discriminant(&kind(0)))
        .collect();
    let subject = subject(scene, &moved);
    let mut scene = scene.clone();
    match kind(0) {
        Item::Material(_) => permute(&mut scene.materials, &order),
        Item::Light(_) => permute(&mut scene.lights, &order),
        _ => scene.bodies.change(|bodies| permute(bodies, &order)),
    }
    let mut new_from_old = vec![0; order.len()];
    for (new, old) in order.into_iter().enumerate() {
        if let Some(entry) = new_from_old.get_mut(old) {
            *entry = new;
        }
    }
    let selection = selection.mapped(|item| match item {
        Item::Material(index) | Item::Light(index) | Item::Body(index) if item == kind(index) => {
            new_from_old.get(index).copied().map(kind)
        }
        item => Some(item),
    });
    Ok(ActionOutcome { scene, selection, subject })
}

fn permute<T: Clone>(list: &mut Vec<T>, order: &[usize]) {
    *list = order.iter().filter_map(|index| list.get(*index).cloned()).collect();
}
