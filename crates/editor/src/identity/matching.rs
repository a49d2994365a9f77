//! Finds the things of a scene again in another version of it, such as its file changed by another program.

use std::collections::{HashMap, VecDeque};

use catoptric_scene::{Body, Light, NamedMaterial, Scene};
use glam::DVec3;

use super::{IdList, Identities, ItemId, fresh_ids};
use crate::sequence::Sequence;

/// Of things at one point, how many are tried for one of equal value.
const MOST_TRIED: usize = 64;

/// The features by which a thing is found again.
trait Recognizable: PartialEq {
    fn name(&self) -> &str;

    fn position(&self) -> DVec3;
}

impl Recognizable for NamedMaterial {
    fn name(&self) -> &str {
        &self.name
    }

    fn position(&self) -> DVec3 {
        DVec3::ZERO
    }
}

impl Recognizable for Light {
    fn name(&self) -> &str {
        &self.name
    }

    fn position(&self) -> DVec3 {
        self.position
    }
}

impl Recognizable for Body {
    fn name(&self) -> &str {
        &self.name
    }

    fn position(&self) -> DVec3 {
        self.placement.origin()
    }
}

/// The identities of `after`, another version of `before`. Things of one name are the same; of those without a name, the
/// ones that are equal, and then those at one place of the lists. All others are new.
pub(crate) fn matched(before: &Scene, identities: &Identities, after: &Scene) -> Identities {
    Identities {
        materials: matched_list(&before.materials, &identities.materials, &after.materials),
        lights: matched_list(&before.lights, &identities.lights, &after.lights),
        bodies: matched_list(&before.bodies, &identities.bodies, &after.bodies),
    }
}

fn matched_list<T: Recognizable, L: Sequence<T>>(before: &L, ids: &IdList, after: &L) -> IdList {
    if before.count() == after.count() && before.apart(after).all(|place| is_in_place(before, after, place)) {
        return ids.clone();
    }
    let mut named = HashMap::new();
    let mut unnamed = HashMap::new();
    for (place, id) in ids.ids().iter().enumerate() {
        match before.at(place).map(T::name) {
            Some("") => _ = unnamed.insert(place, *id),
            Some(name) => _ = named.insert(name, *id),
            None => {}
        }
    }
    let mut found: Vec<Option<ItemId>> = (0..after.count())
        .map(|place| match after.at(place)?.name() {
            "" if before.at(place) == after.at(place) => unnamed.remove(&place),
            "" => None,
            name => named.remove(name),
        })
        .collect();
    let mut standing: HashMap<[u64; 3], VecDeque<usize>> = HashMap::new();
    for place in (0..before.count()).filter(|place| unnamed.contains_key(place)) {
        standing.entry(point_key(before.at(place))).or_default().push_back(place);
    }
    let is_open = |place: usize| after.at(place).is_some_and(|thing| thing.name().is_empty());
    for (place, id) in found.iter_mut().enumerate().filter(|(place, id)| id.is_none() && is_open(*place)) {
        let thing = after.at(place);
        let Some(candidates) = standing.get_mut(&point_key(thing)) else { continue };
        let equal = candidates.iter().take(MOST_TRIED).position(|old| before.at(*old) == thing);
        *id = equal.and_then(|equal| unnamed.remove(&candidates.remove(equal)?));
    }
    for (place, id) in found.iter_mut().enumerate().filter(|(place, id)| id.is_none() && is_open(*place)) {
        *id = unnamed.remove(&place);
    }
    let mut fresh = fresh_ids(found.iter().filter(|id| id.is_none()).count());
    found.into_iter().filter_map(|id| id.or_else(|| fresh.next())).collect()
}

/// Whether the thing at a place is found there again, and cannot be another.
fn is_in_place<T: Recognizable, L: Sequence<T>>(before: &L, after: &L, place: usize) -> bool {
    let (old, new) = (before.at(place), after.at(place));
    let name = old.map_or("", T::name);
    old == new || !name.is_empty() && new.is_some_and(|new| new.name() == name)
}

/// The position of a thing as a key; −0 and 0 are one position.
fn point_key<T: Recognizable>(thing: Option<&T>) -> [u64; 3] {
    thing.map_or(DVec3::ZERO, T::position).to_array().map(|number| (number + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use catoptric_scene::Placement;

    use super::*;

    fn body(name: &str, x: f64) -> Body {
        Body { name: name.to_owned(), placement: Placement::at(DVec3::X * x), ..Body::default() }
    }

    /// For each thing of `after` its place in `before`.
    fn origins(before: &[Body], after: &[Body]) -> Vec<Option<usize>> {
        let ids = IdList::fresh(before.len());
        let found = matched_list(&before.to_vec(), &ids, &after.to_vec());
        assert_eq!(found.ids().len(), after.len());
        found.ids().iter().map(|id| ids.place(*id)).collect()
    }

    #[test]
    fn things_are_matched_by_name_then_value_then_place() {
        let before = [body("a", 0.0), body("", 1.0), body("b", 2.0), body("", 3.0), body("", 4.0)];
        assert_eq!(origins(&before, &before), [0, 1, 2, 3, 4].map(Some));
        let [a, one, b, three, four] = before.clone();
        let moved_a = body("a", 9.0);
        assert_eq!(origins(&before, &[b.clone(), moved_a, four.clone()]), [Some(2), Some(0), Some(4)]);
        // Two that are equal stay two; the third is new.
        let twins = [one.clone(), one.clone()];
        assert_eq!(origins(&twins, &[one.clone(), one.clone(), one.clone()]), [Some(0), Some(1), None]);
        // The one at x = 3 was changed, and the two around it have changed places.
        let changed = [a.clone(), four, b.clone(), body("", 3.5), one];
        assert_eq!(origins(&before, &changed), [0, 4, 2, 3, 1].map(Some));
        // One with another name is another.
        assert_eq!(origins(&[a, b.clone()], &[body("c", 0.0), b]), [None, Some(1)]);
        assert_eq!(origins(&[three], &[body("c", 3.0)]), [None]);
    }

    #[test]
    fn equal_values_at_one_point_are_found_in_any_number() {
        let before: Vec<Body> = (0..1000).map(|_| body("", 0.0)).collect();
        let mut after = before.clone();
        after.insert(0, body("new", 0.0));
        let found = origins(&before, &after);
        let distinct: HashSet<_> = found.iter().flatten().collect();
        assert_eq!((found[0], distinct.len()), (None, 1000));
    }
}
