//! The selection.

use crate::identity::Item;
use crate::part_path::PartPath;

/// Selected things, in the order in which they were chosen, none twice. The last one is the primary one: the one that
/// an inspector shows.
///
/// Of a joined body that is selected alone, a part may be meant: the body stays what is selected, and
/// [`Self::part`] tells the part.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    items: Vec<Item>,
    part: Option<PartPath>,
}

impl Selection {
    /// Nothing.
    pub const fn none() -> Self {
        Self { items: Vec::new(), part: None }
    }

    /// A selection of one thing.
    pub fn one(item: Item) -> Self {
        Self { items: vec![item], part: None }
    }

    /// A part of a joined body; the body itself for the way to the whole.
    pub fn of_part(whole: Item, part: PartPath) -> Self {
        Self { items: vec![whole], part: Some(part).filter(|part| !part.is_whole()) }
    }

    /// The part of the selected body that is meant.
    pub fn part(&self) -> Option<PartPath> {
        self.part
    }

    /// Means the whole body again.
    pub(crate) fn forget_part(&mut self) {
        self.part = None;
    }

    /// Selects this one thing instead of what was selected.
    pub fn set(&mut self, item: Item) {
        *self = Self::one(item);
    }

    /// Adds a thing, and makes it the primary one.
    pub fn add(&mut self, item: Item) {
        self.remove(item);
        self.items.push(item);
    }

    /// Takes a thing out.
    pub fn remove(&mut self, item: Item) {
        self.part = None;
        self.items.retain(|other| *other != item);
    }

    /// Takes a thing out if it is selected, and adds it otherwise.
    pub fn toggle(&mut self, item: Item) {
        if self.contains(item) {
            self.remove(item);
        } else {
            self.add(item);
        }
    }

    /// Selects nothing.
    pub fn clear(&mut self) {
        *self = Self::none();
    }

    /// Whether a thing is selected.
    pub fn contains(&self, item: Item) -> bool {
        self.items.contains(&item)
    }

    /// Whether nothing is selected.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// How many things are selected.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// The thing chosen last.
    pub fn primary(&self) -> Option<Item> {
        self.items.last().copied()
    }

    /// The selected things, the primary one last.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = Item> + '_ {
        self.items.iter().copied()
    }

    /// Drops what `is_kept` does not hold for.
    pub(crate) fn retain(&mut self, is_kept: impl Fn(Item) -> bool) {
        self.items.retain(|item| is_kept(*item));
        self.part = self.part.filter(|_| !self.items.is_empty());
    }
}

impl FromIterator<Item> for Selection {
    /// Of equal items the first counts.
    fn from_iter<T: IntoIterator<Item = Item>>(items: T) -> Self {
        let mut seen = std::collections::HashSet::new();
        Self { items: items.into_iter().filter(|item| seen.insert(*item)).collect(), part: None }
    }
}

impl From<Item> for Selection {
    fn from(item: Item) -> Self {
        Self::one(item)
    }
}
