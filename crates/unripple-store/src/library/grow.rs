//! A library that gets more points than it was planned for.

use super::{Library, PointState, Take, make};
use crate::StoreError;
use crate::building::{Building, sweep};
use crate::listing::{MARKER, UNFINISHED};
use crate::swap::swap;
use std::fs;
use std::path::Path;

/// Points copied at once: a few tens of megabytes.
const AT_ONCE: usize = 64;

impl Library {
    /// Replaces the library in a folder by one of another plan, which takes over its measurements: `known[i]` is the old number of the
    /// new point `i`, if it had one. Old points that `known` does not name are dropped. If the program is killed meanwhile, the old
    /// library or the new one remains, complete.
    ///
    /// # Errors
    /// [`StoreError::Content`] if no library can hold the plan, or if its responses have other sizes than the old
    /// ones; [`StoreError::Occupied`] if another process writes; [`StoreError::Write`]; and those of
    /// [`Library::open`] and [`Library::get`].
    pub fn grow(
        folder: impl AsRef<Path>,
        plan: &super::LibraryPlan,
        known: &[Option<usize>],
    ) -> Result<Self, StoreError> {
        let folder = folder.as_ref();
        let mut old = Self::open(folder)?;
        old.acquire()?;
        plan.check(&folder.display().to_string())?;
        sweep(folder);
        let building = Building::beside(folder)?;
        make(&building, plan)?;
        let mut new = Self::open(building.path())?;
        old.copy(&mut new, known)?;
        drop(new);
        // If the program is killed from here on, the next run recognises the folder that is left.
        let marked = fs::write(folder.join(MARKER), UNFINISHED);
        marked.map_err(StoreError::write(folder))?;
        building.held(|_| swap(building.path(), folder)).map_err(StoreError::write(folder))?;
        drop(building);
        drop(old);
        let mut library = Self::open(folder)?;
        library.acquire()?;
        Ok(library)
    }

    /// Gives another library all that this one knows of its points.
    fn copy(&self, to: &mut Self, known: &[Option<usize>]) -> Result<(), StoreError> {
        let pairs: Vec<(usize, usize)> =
            known.iter().enumerate().filter_map(|(new, old)| old.map(|old| (new, old))).collect();
        let stored: Vec<&(usize, usize)> = pairs
            .iter()
            .filter(|(_, old)| self.state(*old).is_some_and(|state| state != PointState::Missing))
            .collect();
        if let Some(middles) = self.bands() {
            to.hold_bands(middles)?;
        }
        for some in stored.chunks(AT_ONCE) {
            let responses = some.iter().map(|(_, old)| self.get(*old)).collect::<Result<Vec<_>, _>>()?;
            let quality = some.iter().map(|(_, old)| self.quality(*old)).collect::<Result<Vec<_>, _>>()?;
            let bands = some.iter().map(|(_, old)| self.band_quality(*old)).collect::<Result<Vec<_>, _>>()?;
            let takes: Vec<Take<'_>> = some
                .iter()
                .zip(responses.iter().zip(quality.iter().zip(&bands)))
                .map(|((new, old), (samples, (quality, bands)))| Take {
                    point: *new,
                    samples,
                    quality,
                    bands: bands.as_deref().unwrap_or_default(),
                    state: self.state(*old).unwrap_or_default(),
                })
                .collect();
            to.put_all(&takes)?;
        }
        if let Some(error) = self.reciprocity_error()? {
            to.set_reciprocity_error(error)?;
        }
        to.write_record(self.record.renumbered(&pairs))
    }
}
