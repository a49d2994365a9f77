//! A list whose copies share their elements until one of them changes.

use std::fmt;
use std::iter::{FlatMap, Flatten};
use std::ops::{Index, IndexMut, Range};
use std::sync::Arc;

/// A list of which a copy costs next to nothing, however long it is: a copy shares the elements, and a change copies
/// only the neighbors of what it changes. A document keeps its bodies in it, of which there may be a million.
///
/// Adding and removing elsewhere than at the end goes through the whole list.
pub struct List<T> {
    /// All but the last are full, and none is empty.
    chunks: Vec<Arc<Vec<T>>>,
}

/// The elements of a list in their order.
pub type ListIter<'a, T> = CountedIter<Flatten<ListSlices<'a, T>>>;

/// The elements of a list in their order, to be changed.
pub type ListIterMut<'a, T> =
    FlatMap<std::slice::IterMut<'a, Arc<Vec<T>>>, &'a mut Vec<T>, fn(&'a mut Arc<Vec<T>>) -> &'a mut Vec<T>>;

/// The slices of neighbors that are copied together.
#[derive(Clone, Debug)]
pub struct ListSlices<'a, T>(std::slice::Iter<'a, Arc<Vec<T>>>);

/// An iterator of known length.
#[derive(Clone, Debug)]
pub struct CountedIter<I> {
    rest: I,
    count: usize,
}

/// Elements that are copied together.
const CHUNK: usize = 256;

impl<T> List<T> {
    /// The length of all [`Self::slices`] but the last.
    pub const SLICE: usize = CHUNK;

    /// A list without elements.
    pub const fn new() -> Self {
        Self { chunks: Vec::new() }
    }

    /// How many elements there are.
    pub fn len(&self) -> usize {
        let full = self.chunks.len().saturating_sub(1);
        CHUNK * full + self.chunks.last().map_or(0, |last| last.len())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.chunks.is_empty()
    }

    /// The element at a place.
    pub fn get(&self, index: usize) -> Option<&T> {
        self.chunks.get(index / CHUNK)?.get(index % CHUNK)
    }

    /// The last element.
    pub fn last(&self) -> Option<&T> {
        self.chunks.last()?.last()
    }

    /// All elements in their order.
    pub fn iter(&self) -> ListIter<'_, T> {
        CountedIter { rest: self.slices().flatten(), count: self.len() }
    }

    /// All elements in their order, as slices of [`Self::SLICE`] elements, but for the last.
    pub fn slices(&self) -> ListSlices<'_, T> {
        ListSlices(self.chunks.iter())
    }

    /// The places of this list where another may have other elements or none: those whose elements they do not share.
    pub fn unshared<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = usize> + 'a {
        let is_shared =
            |at: usize, chunk| other.chunks.get(at).is_some_and(|other| Arc::ptr_eq(chunk, other));
        let apart = self.chunks.iter().enumerate().filter(move |(at, chunk)| !is_shared(*at, chunk));
        apart.flat_map(|(at, chunk)| CHUNK * at..CHUNK * at + chunk.len())
    }
}

impl<T: Clone> List<T> {
    /// The element at a place, to be changed.
    pub fn get_mut(&mut self, index: usize) -> Option<&mut T> {
        Arc::make_mut(self.chunks.get_mut(index / CHUNK)?).get_mut(index % CHUNK)
    }

    /// All elements, to be changed. Where only some are, [`Self::get_mut`] leaves the others shared.
    pub fn iter_mut(&mut self) -> ListIterMut<'_, T> {
        self.chunks.iter_mut().flat_map(Arc::make_mut)
    }

    /// Adds an element at the end.
    pub fn push(&mut self, element: T) {
        match self.chunks.last_mut() {
            Some(last) if last.len() < CHUNK => Arc::make_mut(last).push(element),
            _ => self.chunks.push(Arc::new(vec![element])),
        }
    }

    /// Takes away the last element.
    pub fn pop(&mut self) -> Option<T> {
        let last = Arc::make_mut(self.chunks.last_mut()?);
        let element = last.pop();
        if last.is_empty() {
            self.chunks.pop();
        }
        element
    }

    /// Takes away all but the first elements.
    pub fn truncate(&mut self, count: usize) {
        if count < self.len() {
            self.chunks.truncate(count.div_ceil(CHUNK));
            if let Some(last) = self.chunks.last_mut()
                && !count.is_multiple_of(CHUNK)
            {
                Arc::make_mut(last).truncate(count % CHUNK);
            }
        }
    }

    /// Takes away all elements.
    pub fn clear(&mut self) {
        self.chunks.clear();
    }

    /// Exchanges two elements, both of which there are.
    ///
    /// # Panics
    /// When there are not.
    pub fn swap(&mut self, one: usize, other: usize) {
        let element = self[one].clone();
        self[one] = std::mem::replace(&mut self[other], element);
    }

    /// The elements as a vector.
    pub fn to_vec(&self) -> Vec<T> {
        self.iter().cloned().collect()
    }

    /// Changes the list as a vector, for all that goes through the whole of it.
    pub fn change<R>(&mut self, edit: impl FnOnce(&mut Vec<T>) -> R) -> R {
        let mut all: Vec<T> = std::mem::take(self).into_iter().collect();
        let result = edit(&mut all);
        *self = all.into();
        result
    }

    /// Adds an element at a place, and moves those from there on up.
    ///
    /// # Panics
    /// When the place is beyond the end.
    pub fn insert(&mut self, index: usize, element: T) {
        self.change(|all| all.insert(index, element));
    }

    /// Takes away the element at a place, and moves those after it down.
    ///
    /// # Panics
    /// When there is none.
    pub fn remove(&mut self, index: usize) -> T {
        self.change(|all| all.remove(index))
    }

    /// Puts other elements in the place of some.
    ///
    /// # Panics
    /// When the range goes beyond the end.
    pub fn splice(&mut self, range: Range<usize>, elements: impl IntoIterator<Item = T>) {
        self.change(|all| drop(all.splice(range, elements)));
    }

    /// Keeps the elements for which `is_kept` holds.
    pub fn retain(&mut self, is_kept: impl FnMut(&T) -> bool) {
        self.change(|all| all.retain(is_kept));
    }
}

impl<T> Default for List<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> Clone for List<T> {
    fn clone(&self) -> Self {
        Self { chunks: self.chunks.clone() }
    }
}

impl<T: fmt::Debug> fmt::Debug for List<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self).finish()
    }
}

impl<T: PartialEq> PartialEq for List<T> {
    fn eq(&self, other: &Self) -> bool {
        let mut pairs = self.chunks.iter().zip(&other.chunks);
        self.len() == other.len() && pairs.all(|(one, other)| Arc::ptr_eq(one, other) || one == other)
    }
}

impl<T: PartialEq, const N: usize> PartialEq<[T; N]> for List<T> {
    fn eq(&self, other: &[T; N]) -> bool {
        self.iter().eq(other)
    }
}

impl<T> Index<usize> for List<T> {
    type Output = T;

    fn index(&self, index: usize) -> &T {
        &self.chunks[index / CHUNK][index % CHUNK]
    }
}

impl<T: Clone> IndexMut<usize> for List<T> {
    fn index_mut(&mut self, index: usize) -> &mut T {
        &mut Arc::make_mut(&mut self.chunks[index / CHUNK])[index % CHUNK]
    }
}

impl<T> From<Vec<T>> for List<T> {
    fn from(elements: Vec<T>) -> Self {
        elements.into_iter().collect()
    }
}

impl<T, const N: usize> From<[T; N]> for List<T> {
    fn from(elements: [T; N]) -> Self {
        elements.into_iter().collect()
    }
}

impl<T> FromIterator<T> for List<T> {
    fn from_iter<I: IntoIterator<Item = T>>(elements: I) -> Self {
        let mut elements = elements.into_iter();
        let chunks = std::iter::from_fn(|| {
            let chunk: Vec<T> = elements.by_ref().take(CHUNK).collect();
            (!chunk.is_empty()).then(|| Arc::new(chunk))
        });
        Self { chunks: chunks.collect() }
    }
}

impl<T: Clone> Extend<T> for List<T> {
    fn extend<I: IntoIterator<Item = T>>(&mut self, elements: I) {
        elements.into_iter().for_each(|element| self.push(element));
    }
}

impl<'a, T> IntoIterator for &'a List<T> {
    type Item = &'a T;
    type IntoIter = ListIter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<'a, T: Clone> IntoIterator for &'a mut List<T> {
    type Item = &'a mut T;
    type IntoIter = ListIterMut<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter_mut()
    }
}

impl<T: Clone> IntoIterator for List<T> {
    type Item = T;
    type IntoIter = FlatMap<std::vec::IntoIter<Arc<Vec<T>>>, Vec<T>, fn(Arc<Vec<T>>) -> Vec<T>>;

    /// The elements themselves where they are not shared, copies where they are.
    fn into_iter(self) -> Self::IntoIter {
        self.chunks.into_iter().flat_map(Arc::unwrap_or_clone)
    }
}

impl<'a, T> Iterator for ListSlices<'a, T> {
    type Item = &'a [T];

    fn next(&mut self) -> Option<Self::Item> {
        self.0.next().map(|chunk| chunk.as_slice())
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.0.size_hint()
    }
}

impl<T> DoubleEndedIterator for ListSlices<'_, T> {
    fn next_back(&mut self) -> Option<Self::Item> {
        self.0.next_back().map(|chunk| chunk.as_slice())
    }
}

impl<T> ExactSizeIterator for ListSlices<'_, T> {}

impl<I: Iterator> Iterator for CountedIter<I> {
    type Item = I::Item;

    fn next(&mut self) -> Option<Self::Item> {
        let next = self.rest.next();
        self.count -= usize::from(next.is_some());
        next
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.count, Some(self.count))
    }

    fn fold<B, F: FnMut(B, Self::Item) -> B>(self, init: B, f: F) -> B {
        self.rest.fold(init, f)
    }
}

impl<I: DoubleEndedIterator> DoubleEndedIterator for CountedIter<I> {
    fn next_back(&mut self) -> Option<Self::Item> {
        let next = self.rest.next_back();
        self.count -= usize::from(next.is_some());
        next
    }
}

impl<I: Iterator> ExactSizeIterator for CountedIter<I> {}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks what every list keeps to.
    fn checked(list: &List<usize>) -> Vec<usize> {
        let full = list.chunks.len().saturating_sub(1);
        assert!(list.chunks.iter().take(full).all(|chunk| chunk.len() == CHUNK));
        assert!(list.chunks.last().is_none_or(|last| (1..=CHUNK).contains(&last.len())));
        let all = list.to_vec();
        assert_eq!((list.len(), list.is_empty(), list.last()), (all.len(), all.is_empty(), all.last()));
        assert!(list.iter().eq(&all) && list.iter().rev().eq(all.iter().rev()));
        assert_eq!((list.iter().len(), list.get(all.len())), (all.len(), None));
        assert!(all.iter().enumerate().all(|(at, element)| list.get(at) == Some(element)));
        assert!(list.slices().flatten().eq(&all));
        all
    }

    /// What has just been done to a list and to a vector.
    type Edit<'a> = (&'a dyn Fn(&mut List<usize>), &'a dyn Fn(&mut Vec<usize>));

    #[test]
    fn it_does_as_a_vector_does() {
        for count in [0, 1, 5, CHUNK - 1, CHUNK, CHUNK + 1, 3 * CHUNK, 3 * CHUNK + 7] {
            let edits: [Edit<'_>; 12] = [
                (&|list| list.push(9), &|all| all.push(9)),
                (&|list| _ = list.pop(), &|all| _ = all.pop()),
                (&|list| list.truncate(CHUNK), &|all| all.truncate(CHUNK)),
                (&|list| list.truncate(2), &|all| all.truncate(2)),
                (&List::clear, &Vec::clear),
                (&|list| list.extend(0..CHUNK + 3), &|all| all.extend(0..CHUNK + 3)),
                (&|list| list.insert(0, 9), &|all| all.insert(0, 9)),
                (&|list| list.retain(|element| element % 3 == 0), &|all| {
                    all.retain(|element| element % 3 == 0);
                }),
                (&|list| list.splice(0..0, [7, 8]), &|all| drop(all.splice(0..0, [7, 8]))),
                (&|list| list.iter_mut().for_each(|element| *element += 1), &|all| {
                    all.iter_mut().for_each(|element| *element += 1);
                }),
                (&|list| list.get_mut(4).into_iter().for_each(|element| *element = 99), &|all| {
                    all.get_mut(4).into_iter().for_each(|element| *element = 99);
                }),
                (&|list| list.change(|all| all.reverse()), &|all| all.reverse()),
            ];
            for (number, (edit, same)) in edits.into_iter().enumerate() {
                let (mut list, mut all): (List<usize>, Vec<usize>) =
                    ((0..count).collect(), (0..count).collect());
                let copy = list.clone();
                edit(&mut list);
                same(&mut all);
                assert_eq!(checked(&list), all, "edit {number} of {count}");
                assert!(checked(&copy).into_iter().eq(0..count), "a copy stays as it is");
            }
        }
    }

    #[test]
    fn a_copy_shares_all_but_the_neighbors_of_a_change() {
        let list: List<usize> = (0..10 * CHUNK + 3).collect();
        let mut edited = list.clone();
        assert_eq!(list.unshared(&edited).count(), 0);
        edited[3 * CHUNK + 5] = 0;
        assert!(list.unshared(&edited).eq(3 * CHUNK..4 * CHUNK));
        edited.swap(0, 10 * CHUNK);
        assert_eq!((edited[0], edited[10 * CHUNK]), (10 * CHUNK, 0));
        let last = 10 * CHUNK..10 * CHUNK + 3;
        assert!(list.unshared(&edited).eq((0..CHUNK).chain(3 * CHUNK..4 * CHUNK).chain(last)));
        assert_ne!(list, edited);
        edited.swap(0, 10 * CHUNK);
        edited[3 * CHUNK + 5] = 3 * CHUNK + 5;
        assert_eq!(list, edited, "alike, if not shared");
        let mut longer = list.clone();
        longer.extend(0..CHUNK);
        assert!(longer.unshared(&list).eq(10 * CHUNK..11 * CHUNK + 3), "the last slice has grown");
        assert!(list.unshared(&longer).eq(10 * CHUNK..10 * CHUNK + 3));
    }
}
