//! Shared data on the audio thread: their uses are counted there, and data without uses are sent away to be freed.

use crate::hold::Held;
use crate::{PreparedDrive, PreparedFilters};
use std::sync::Arc;

/// Data that are sent back to the desk to be freed there.
#[derive(Debug)]
#[expect(dead_code, reason = "held to be dropped")]
pub(crate) enum Garbage {
    /// A drive that no longer sounds.
    Drive(Arc<PreparedDrive>),
    /// Filters through which nothing goes any more.
    Filters(Arc<PreparedFilters>),
    /// A waveform that is over.
    Samples(Arc<[f32]>),
    /// The hold of a drive or waveform that has ended.
    Held(Arc<Held>),
}

/// Places for shared data; an index stays with its data until the last use ends.
pub(crate) struct Shelf<T: ?Sized> {
    places: Vec<Option<(Arc<T>, u32)>>,
    free: Vec<usize>,
}

impl<T: ?Sized> Shelf<T> {
    /// Room for a number of data.
    pub(crate) fn new(places: usize) -> Self {
        Self { places: (0..places).map(|_| None).collect(), free: (0..places).rev().collect() }
    }

    /// Stores data with one use, and returns their index; returns the data if there is no place.
    pub(crate) fn put(&mut self, data: Arc<T>) -> Result<usize, Arc<T>> {
        match self.free.pop() {
            Some(place) => {
                self.places[place] = Some((data, 1));
                Ok(place)
            }
            None => Err(data),
        }
    }

    /// The data at a place, given by its index.
    pub(crate) fn get(&self, place: usize) -> Option<&T> {
        self.places.get(place)?.as_ref().map(|(data, _)| &**data)
    }

    /// Counts one use more of the data at an index.
    pub(crate) fn hold(&mut self, place: usize) {
        if let Some(Some((_, uses))) = self.places.get_mut(place) {
            *uses += 1;
        }
    }

    /// Counts one use less of the data at an index; after the last, returns the data itself.
    pub(crate) fn release(&mut self, place: usize) -> Option<Arc<T>> {
        let held = self.places.get_mut(place)?;
        let (_, uses) = held.as_mut()?;
        *uses -= 1;
        if *uses > 0 {
            return None;
        }
        self.free.push(place);
        held.take().map(|(data, _)| data)
    }
}
