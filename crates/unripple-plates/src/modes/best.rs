//! The best of successive approximations, and when to give up.

/// Keeps the approximation with the least error so far.
pub(super) struct Best<T> {
    /// The approximation and its error, if the error is small enough to be accepted.
    found: Option<(T, f64)>,
    /// Least relative error so far.
    error: f64,
    /// Largest relative error that is accepted if the accuracy cannot be reached.
    most: f64,
    /// Number of approximations in succession that made no progress.
    stalled: usize,
}

impl<T> Best<T> {
    /// No approximation yet; those with errors up to `most` will be accepted.
    pub(super) fn up_to(most: f64) -> Self {
        Self { found: None, error: f64::INFINITY, most, stalled: 0 }
    }

    /// Adds another approximation. It counts as progress if its error is at most the share `progress` of
    /// the least error so far, or if no error was finite so far.
    pub(super) fn take(&mut self, found: T, error: f64, progress: f64) {
        let worse = error > progress * self.error || (self.error.is_finite() && !error.is_finite());
        self.stalled = if worse { self.stalled + 1 } else { 0 };
        if error <= self.most && error < self.error {
            self.found = Some((found, error));
        }
        self.error = self.error.min(error);
    }

    /// Whether the last `patience` approximations made no progress.
    pub(super) fn is_stalled(&self, patience: usize) -> bool {
        self.stalled >= patience
    }

    /// Whether any approximation had a finite error.
    pub(super) fn is_any(&self) -> bool {
        self.error.is_finite()
    }

    /// The best approximation with its error, if the error is accepted; else the least error.
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
