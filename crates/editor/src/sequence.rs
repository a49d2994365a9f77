//! The two kinds of lists that a scene has, alike for what compares them.

use std::ops::Range;

use catoptric_scene::List;

/// A list of a scene.
pub(crate) trait Sequence<T> {
    /// The number of elements.
    fn count(&self) -> usize;

    /// The element at a place.
    fn at(&self, index: usize) -> Option<&T>;

    /// The element at a place, for changes.
    fn at_mut(&mut self, index: usize) -> Option<&mut T>;

    /// The places of all elements that another list of the same length may have otherwise.
    fn apart<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = usize> + 'a
    where
        T: 'a;

    /// Puts other elements in the place of some.
    fn replace(&mut self, range: Range<usize>, elements: &[T]);
}

impl<T: Clone> Sequence<T> for Vec<T> {
    fn count(&self) -> usize {
        self.len()
    }

    fn at(&self, index: usize) -> Option<&T> {
        self.get(index)
    }

    fn at_mut(&mut self, index: usize) -> Option<&mut T> {
        self.get_mut(index)
    }

    fn apart<'a>(&'a self, _other: &'a Self) -> impl Iterator<Item = usize> + 'a
    where
        T: 'a,
    {
        0..self.len()
    }

    fn replace(&mut self, range: Range<usize>, elements: &[T]) {
        self.splice(range, elements.iter().cloned());
    }
}

impl<T: Clone> Sequence<T> for List<T> {
    fn count(&self) -> usize {
        self.len()
    }

    fn at(&self, index: usize) -> Option<&T> {
        self.get(index)
    }

    fn at_mut(&mut self, index: usize) -> Option<&mut T> {
        self.get_mut(index)
    }

    fn apart<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = usize> + 'a
    where
        T: 'a,
    {
        self.unshared(other)
    }

    fn replace(&mut self, range: Range<usize>, elements: &[T]) {
        if range.start == self.len() {
            self.extend(elements.iter().cloned());
        } else if range.end == self.len() && elements.is_empty() {
            self.truncate(range.start);
        } else {
            self.splice(range, elements.iter().cloned());
        }
    }
}
