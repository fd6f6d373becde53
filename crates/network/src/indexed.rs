//! A list whose items are found by the processors that they name, so that large networks cost no more per item than small ones.

use std::collections::HashMap;

use crate::link::Link;
use crate::network::{Connection, Processor};

/// What names one processor or two.
pub(crate) trait Named {
    /// The ids; the same one twice where there is only one.
    fn names(&self) -> [&str; 2];
}

impl Named for Processor {
    fn names(&self) -> [&str; 2] {
        [&self.id; 2]
    }
}

impl Named for Connection {
    fn names(&self) -> [&str; 2] {
        [&self.from.processor, &self.to.processor]
    }
}

impl Named for Link {
    fn names(&self) -> [&str; 2] {
        [&self.a.processor, &self.b.processor]
    }
}

/// Items in the order in which they were added.
#[derive(Clone)]
pub(crate) struct Indexed<T> {
    items: Vec<T>,
    /// By id of a processor: the positions of the items that name it, rising.
    places: HashMap<String, Vec<usize>>,
}

impl<T> Default for Indexed<T> {
    fn default() -> Self {
        Self { items: Vec::new(), places: HashMap::new() }
    }
}

impl<T: Named> Indexed<T> {
    pub fn as_slice(&self) -> &[T] {
        &self.items
    }

    pub fn push(&mut self, item: T) {
        let place = self.items.len();
        for name in item.names() {
            let places = self.places.entry(name.to_owned()).or_default();
            if places.last() != Some(&place) {
                places.push(place);
            }
        }
        self.items.push(item);
    }

    /// The items that name this processor, in order.
    pub fn naming<'a>(&'a self, name: &str) -> impl Iterator<Item = &'a T> + Clone + use<'a, T> {
        self.places.get(name).into_iter().flatten().map(|&place| &self.items[place])
    }

    /// Items among which are all that name both processors: those of the one that fewer name.
    pub fn naming_both<'a>(&'a self, a: &str, b: &str) -> impl Iterator<Item = &'a T> + Clone + use<'a, T> {
        let count = |name: &str| self.places.get(name).map_or(0, Vec::len);
        self.naming(if count(a) < count(b) { a } else { b })
    }

    /// The first item that names this processor; what it names must stay.
    pub fn first_mut(&mut self, name: &str) -> Option<&mut T> {
        self.items.get_mut(*self.places.get(name)?.first()?)
    }

    /// Keeps the items that satisfy a condition; returns whether any is gone.
    pub fn retain(&mut self, keep: impl FnMut(&T) -> bool) -> bool {
        let before = self.items.len();
        self.items.retain(keep);
        let gone = self.items.len() < before;
        if gone {
            *self = std::mem::take(&mut self.items).into_iter().collect();
        }
        gone
    }

    /// Changes every item; it may name others then.
    pub fn change(&mut self, change: impl FnMut(&mut T)) {
        self.items.iter_mut().for_each(change);
        *self = std::mem::take(&mut self.items).into_iter().collect();
    }
}

impl<T: Named> FromIterator<T> for Indexed<T> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        let mut indexed = Self::default();
        items.into_iter().for_each(|item| indexed.push(item));
        indexed
    }
}
