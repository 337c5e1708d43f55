//! Responses stored in a library.

use super::array::BLOCK;
use super::{BandQuality, Library, PointState, Quality};
use crate::StoreError;
use std::collections::BTreeMap;

/// The responses of one point, to be stored.
#[derive(Clone, Copy, Debug)]
pub struct Take<'a> {
    /// Index of the point.
    pub point: usize,
    /// Responses of the point, actuators x samples, in m/s per unit of drive and second.
    pub samples: &'a [f32],
    /// Quality of each response, one per actuator.
    pub quality: &'a [Quality],
    /// Quality of each response in the library's frequency bands, `[actuator][band]` ([`Library::hold_bands`]); empty
    /// if it is not known.
    pub bands: &'a [Vec<BandQuality>],
    /// New state of the point: [`PointState::Measured`] or [`PointState::Bad`].
    pub state: PointState,
}

impl Library {
    /// Stores the responses of one point, actuators x samples, in place of any it had. They are on the medium when
    /// this returns. Quality by frequency bands becomes unknown; [`Library::put_all`] can store it.
    ///
    /// # Errors
    /// [`StoreError::Content`] if sizes do not fit or a sample is not finite; [`StoreError::Write`] if the folder cannot be
    /// written to: the point is then as it was; [`StoreError::Occupied`] if another process writes.
    pub fn put(&mut self, point: usize, samples: &[f32], quality: &[Quality]) -> Result<(), StoreError> {
        self.put_all(&[Take { point, samples, quality, bands: &[], state: PointState::Measured }])
    }

    /// Stores responses of one point, `[actuator][sample]` in m/s per unit of drive and second, that are too bad to
    /// be used, so that they can be examined.
    ///
    /// # Errors
    /// As [`Library::put`].
    pub fn put_bad(&mut self, point: usize, samples: &[f32], quality: &[Quality]) -> Result<(), StoreError> {
        self.put_all(&[Take { point, samples, quality, bands: &[], state: PointState::Bad }])
    }

    /// Stores the responses of many points, faster than one by one. None of them is finished before all are on the medium.
    ///
    /// # Errors
    /// As [`Library::put`].
    pub fn put_all(&mut self, takes: &[Take<'_>]) -> Result<(), StoreError> {
        takes.iter().try_for_each(|take| self.fits(take))?;
        self.acquire()?;
        for take in takes {
            let bytes: Vec<u8> = take.samples.iter().flat_map(|x| x.to_le_bytes()).collect();
            self.arrays.responses.write(&self.root, take.point, &bytes)?;
        }
        self.arrays.responses.sync(&self.root)?;
        let mut blocks: BTreeMap<usize, Vec<&Take<'_>>> = BTreeMap::new();
        takes.iter().for_each(|take| blocks.entry(take.point / BLOCK).or_default().push(take));
        for (block, takes) in &blocks {
            self.write_qualities(*block, takes)?;
        }
        self.arrays.quality.sync(&self.root)?;
        self.write_bands(takes)?;
        let before = self.states.clone();
        takes.iter().for_each(|take| self.states[take.point] = take.state);
        let written = self.write_states(&blocks.into_keys().collect::<Vec<_>>());
        if written.is_err() {
            self.states = before;
        }
        written
    }

    /// Makes points missing again, so that they are measured anew, and removes their log entries and doubts.
    ///
    /// # Errors
    /// [`StoreError::Content`] for a point beyond the last; [`StoreError::Write`]; [`StoreError::Occupied`] if another process writes.
    pub fn forget(&mut self, points: &[usize]) -> Result<(), StoreError> {
        points.iter().try_for_each(|point| self.within(*point))?;
        self.acquire()?;
        let before = self.states.clone();
        points.iter().for_each(|point| self.states[*point] = PointState::Missing);
        let mut blocks: Vec<usize> = points.iter().map(|point| point / BLOCK).collect();
        blocks.sort_unstable();
        blocks.dedup();
        let written = self.write_states(&blocks);
        if written.is_err() {
            self.states = before;
            return written;
        }
        self.forget_points(points)
    }

    fn fits(&self, take: &Take<'_>) -> Result<(), StoreError> {
        self.within(take.point)?;
        let name = self.root.display().to_string();
        let require = |legal: bool, expected: String, found: String| {
            if legal { Ok(()) } else { Err(StoreError::content(&name, expected, found)) }
        };
        let (ports, samples) = (self.plan.ports.len(), self.plan.samples);
        require(
            take.samples.len() == self.plan.values(),
            format!("responses of {ports} x {samples} samples"),
            format!("{} samples", take.samples.len()),
        )?;
        require(
            take.quality.len() == ports,
            format!("the quality of {ports} responses"),
            format!("that of {}", take.quality.len()),
        )?;
        self.bands_fit(take)?;
        require(take.state != PointState::Missing, "a point measured or bad".into(), "a missing one".into())?;
        let bad = take.samples.iter().find(|x| !x.is_finite());
        require(bad.is_none(), "finite samples".into(), bad.map_or(String::new(), f32::to_string))
    }

    /// Refuses a point beyond the last.
    pub(crate) fn within(&self, point: usize) -> Result<(), StoreError> {
        let count = self.plan.points.len();
        if point < count {
            return Ok(());
        }
        let expected = format!("a point from 0 to {}", count - 1);
        Err(StoreError::content(&self.root.display().to_string(), expected, point.to_string()))
    }
}
