//! The best of successive approximations, and when to give up.

/// The approximation of least error so far.
pub(super) struct Best<T> {
    /// It and its error, if that is one to be accepted.
    found: Option<(T, f64)>,
    /// Least error so far, relative.
    error: f64,
    /// Largest error to be accepted where the accuracy is out of reach, relative.
    most: f64,
    /// Approximations without progress one after the other.
    stalled: usize,
}

impl<T> Best<T> {
    /// None so far; those of errors up to `most` are accepted.
    pub(super) fn up_to(most: f64) -> Self {
        Self { found: None, error: f64::INFINITY, most, stalled: 0 }
    }

    /// Takes another approximation. It counts as progress if its error is below the share `progress` of the least so far, or if none was
    /// finite.
    pub(super) fn take(&mut self, found: T, error: f64, progress: f64) {
        let worse = error > progress * self.error || (self.error.is_finite() && !error.is_finite());
        self.stalled = if worse { self.stalled + 1 } else { 0 };
        if error <= self.most && error < self.error {
            self.found = Some((found, error));
        }
        self.error = self.error.min(error);
    }

    /// Whether `patience` approximations one after the other were no progress.
    pub(super) fn is_stalled(&self, patience: usize) -> bool {
        self.stalled >= patience
    }

    /// Whether any error was finite.
    pub(super) fn is_any(&self) -> bool {
        self.error.is_finite()
    }

    /// The best with its error if that is accepted; else the least error.
    ///
    /// # Errors
    /// The least error.
    pub(super) fn end(self) -> Result<(T, f64), f64> {
        self.found.ok_or(self.error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_error_is_kept_if_it_is_accepted() {
        let of = |most: f64, errors: &[f64]| {
            let mut best = Best::up_to(most);
            errors.iter().enumerate().for_each(|(i, error)| best.take(i, *error, 0.8));
            best.end()
        };
        assert_eq!(of(1e-2, &[f64::INFINITY, 3e-3, 2e-3, 5e-3]), Ok((2, 2e-3)));
        assert_eq!(of(1e-4, &[3e-3, 2e-3]), Err(2e-3));
        assert_eq!(of(1e-4, &[]), Err(f64::INFINITY));
    }

    #[test]
    fn no_progress_is_counted_from_the_last_progress() {
        let mut best = Best::up_to(0.0);
        let stalled = [f64::INFINITY, f64::INFINITY, 1e-2, 0.9e-2, 1e-3, 2e-3, f64::INFINITY].map(|error| {
            best.take((), error, 0.8);
            best.stalled
        });
        assert_eq!(stalled, [0, 0, 0, 1, 0, 1, 2]);
        assert!(best.is_stalled(2) && !best.is_stalled(3) && best.is_any());
    }
}
