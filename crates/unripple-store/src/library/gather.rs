//! Responses read from a library.

use super::{Damage, Library, PointState};
use crate::StoreError;
use std::io;
use unripple_core::SampledResponses;

impl Library {
    /// The responses of one point, measured or bad, as actuators x samples in m/s per unit of drive and second.
    ///
    /// # Errors
    /// [`StoreError::Content`] if the point is missing or beyond the last, or its chunk is damaged; [`StoreError::Read`].
    pub fn get(&self, point: usize) -> Result<Vec<f32>, StoreError> {
        self.within(point)?;
        if self.states[point] == PointState::Missing {
            let file = self.arrays.responses.chunk(&self.root, point).display().to_string();
            return Err(StoreError::content(&file, "the responses of a finished point", "none yet"));
        }
        let mut samples = Vec::new();
        self.append(point, 0, &mut samples)?;
        Ok(samples)
    }

    /// The responses of all finished points, from the impulse on: the samples before [`crate::LibraryPlan::onset`],
    /// rounded to whole samples, are left out.
    ///
    /// # Errors
    /// As [`Library::get`], at the first damaged chunk.
    pub fn responses(&self) -> Result<SampledResponses, StoreError> {
        let done = self.done();
        let mut data = self.room(done.len())?;
        done.iter().try_for_each(|point| self.append(*point, self.onset(), &mut data))?;
        self.sampled(&done, data)
    }

    /// The responses of all finished points that can be read, as [`Library::responses`], and the damage to the others.
    ///
    /// # Errors
    /// [`StoreError::Read`] if there is no memory for them.
    pub fn intact(&self) -> Result<(SampledResponses, Vec<Damage>), StoreError> {
        let (mut kept, mut damage) = (Vec::new(), self.damaged.clone());
        let mut data = self.room(self.done().len())?;
        for point in self.done() {
            match self.append(point, self.onset(), &mut data) {
                Ok(()) => kept.push(point),
                Err(error) => {
                    let file = self.arrays.responses.chunk(&self.root, point);
                    damage.push(Damage::of(&error, &file, Some(point)));
                }
            }
        }
        Ok((self.sampled(&kept, data)?, damage))
    }

    fn sampled(&self, points: &[usize], data: Vec<f32>) -> Result<SampledResponses, StoreError> {
        let places = points.iter().map(|point| self.plan.points[*point]).collect();
        let (ports, conditions) = (self.plan.ports.clone(), self.plan.conditions.clone());
        let samples = self.plan.samples - self.onset();
        SampledResponses::new(ports, places, conditions, samples, data).map_err(|error| {
            StoreError::content(&self.root.display().to_string(), "responses of one size", error.to_string())
        })
    }

    /// Room for the values of some points, no more than their files hold.
    fn room(&self, points: usize) -> Result<Vec<f32>, StoreError> {
        let size = |point: &usize| {
            self.arrays.responses.chunk(&self.root, *point).metadata().map_or(0, |m| m.len() / 4)
        };
        let stored: u64 = self.done().iter().map(size).fold(0, u64::saturating_add);
        let wanted = (points as u64).saturating_mul(self.plan.values() as u64).min(stored);
        let mut data = Vec::new();
        match usize::try_from(wanted).map(|wanted| data.try_reserve_exact(wanted)) {
            Ok(Ok(())) => Ok(data),
            _ => Err(StoreError::read(&self.root)(io::ErrorKind::OutOfMemory.into())),
        }
    }

    /// Samples before the impulse.
    fn onset(&self) -> usize {
        let samples = unripple_core::window_samples(self.plan.onset, self.plan.conditions.rate);
        samples.min(self.plan.samples - 1)
    }

    /// The responses of a point without their first samples.
    fn append(&self, point: usize, first: usize, data: &mut Vec<f32>) -> Result<(), StoreError> {
        let bytes = self.arrays.responses.read(&self.root, point)?;
        for row in bytes.as_chunks::<4>().0.chunks_exact(self.plan.samples) {
            data.extend(row[first..].iter().map(|bytes| f32::from_le_bytes(*bytes)));
        }
        Ok(())
    }
}
