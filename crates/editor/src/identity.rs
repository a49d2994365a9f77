//! The identities of a scene's things.

mod matching;

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use catoptric_scene::List;

pub(crate) use matching::matched;

/// The identity of a material, light or body in open documents; no two things of a process share one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ItemId(u64);

/// A thing of an open document that can be selected and inspected. It stays the same whatever is done to the thing and
/// to others: [`crate::EditedScene::part`] tells its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Item {
    /// The camera.
    Camera,
    /// The background and the ambient light.
    Environment,
    /// The limits of tracing.
    Tracing,
    /// A named material.
    Material(ItemId),
    /// A light.
    Light(ItemId),
    /// A body.
    Body(ItemId),
}

/// The identities of all things in a scene's lists.
#[derive(Clone, Debug, Default)]
pub(crate) struct Identities {
    pub(crate) materials: IdList,
    pub(crate) lights: IdList,
    pub(crate) bodies: IdList,
}

/// The identities of a list's things in their order.
#[derive(Clone, Debug, Default)]
pub(crate) struct IdList {
    ids: List<ItemId>,
    /// The places in the order of the identities, found when first needed; `None` if the list is in that order.
    places: OnceLock<Option<Vec<u32>>>,
}

/// New identities, in ascending order and greater than all before.
fn fresh_ids(count: usize) -> impl Iterator<Item = ItemId> {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let first = NEXT.fetch_add(count as u64, Ordering::Relaxed);
    (0..count as u64).map(move |offset| ItemId(first + offset))
}

impl IdList {
    /// New identities for a list of this length.
    pub(crate) fn fresh(count: usize) -> Self {
        fresh_ids(count).collect()
    }

    /// Adds new identities until the list has this length.
    pub(crate) fn grow(&mut self, count: usize) {
        let added = count.saturating_sub(self.ids.len());
        self.edit().extend(fresh_ids(added));
    }

    pub(crate) fn ids(&self) -> &List<ItemId> {
        &self.ids
    }

    /// The identities, to be changed.
    pub(crate) fn edit(&mut self) -> &mut List<ItemId> {
        self.places = OnceLock::new();
        &mut self.ids
    }

    /// The place of an identity. Takes logarithmic time, and constant time where identities are consecutive, as in a
    /// document that has just been opened.
    pub(crate) fn place(&self, id: ItemId) -> Option<usize> {
        let places = self.places.get_or_init(|| self.sorted_places()).as_deref();
        let place_at = |rank: usize| match places {
            Some(places) => places.get(rank).map(|place| *place as usize),
            None => Some(rank),
        };
        let id_at = |rank: usize| self.ids.get(place_at(rank)?).copied();
        let most = self.ids.len().checked_sub(1)?;
        // Identities ascend by at least one from rank to rank, which bounds the rank from both sides.
        let after_first = id.0.checked_sub(id_at(0)?.0)?;
        let before_last = id_at(most)?.0.checked_sub(id.0)?;
        let mut low = most - usize::try_from(before_last).unwrap_or(most).min(most);
        let mut high = usize::try_from(after_first).unwrap_or(most).min(most);
        while low < high {
            let middle = low + (high - low) / 2;
            if id_at(middle)? < id {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        if id_at(low)? == id { place_at(low) } else { None }
    }

    fn sorted_places(&self) -> Option<Vec<u32>> {
        if self.ids.iter().is_sorted() {
            return None;
        }
        let ids = self.ids.iter().copied();
        let mut ranked: Vec<(ItemId, u32)> = ids.zip(0..).collect();
        ranked.sort_unstable();
        Some(ranked.into_iter().map(|(_, place)| place).collect())
    }
}

impl FromIterator<ItemId> for IdList {
    fn from_iter<I: IntoIterator<Item = ItemId>>(ids: I) -> Self {
        Self { ids: ids.into_iter().collect(), places: OnceLock::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_identity_is_found_at_its_place_in_any_order() {
        let mut list = IdList::fresh(600);
        let stranger = IdList::fresh(1).ids()[0];
        list.grow(1000);
        let check = |list: &IdList| {
            for (place, id) in list.ids().iter().enumerate() {
                assert_eq!(list.place(*id), Some(place));
            }
            assert_eq!(list.place(stranger), None);
        };
        check(&list);
        let removed = list.ids()[17];
        list.edit().retain(|id| id.0 % 7 != removed.0 % 7);
        check(&list);
        assert_eq!(list.place(removed), None);
        list.edit().change(|ids| ids.rotate_left(300));
        check(&list);
        assert_eq!(list.place(removed), None);
        list.edit().clear();
        assert_eq!((list.place(stranger), list.place(removed)), (None, None));
    }
}
