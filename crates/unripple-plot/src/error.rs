//! Why a figure could not be drawn.

/// Why a figure could not be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlotError {
    /// There is nothing to draw: no panel, no value, or no finite value.
    #[error("{what}: expected at least one finite value, found {found}")]
    Empty {
        /// Name of what has nothing to draw.
        what: String,
        /// Description of what was found instead, as in "3 values, none finite".
        found: String,
    },
    /// Two sequences that go together differ in length.
    #[error("{what}: expected {expected} values, found {found}")]
    Length {
        /// Name of what was counted.
        what: String,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A number is outside the values it may take, such as zero on a logarithmic axis.
    #[error("{what}: expected {expected}, found {found}")]
    Range {
        /// Name of the number.
        what: String,
        /// Description of the values that are allowed.
        expected: &'static str,
        /// The number that was given.
        found: f64,
    },
    /// The drawing could not be turned into an image.
    #[error("{what}: expected an image, found {found}")]
    Image {
        /// Which step failed.
        what: &'static str,
        /// What the step reported.
        found: String,
    },
}

/// An error of [`PlotError::Length`] unless the two counts agree.
pub(crate) fn same_length(what: &str, expected: usize, found: usize) -> Result<(), PlotError> {
    if expected == found {
        return Ok(());
    }
    Err(PlotError::Length { what: what.to_owned(), expected, found })
}

/// An error of [`PlotError::Empty`] unless one of the values is finite.
pub(crate) fn some_finite(what: &str, values: &[f64]) -> Result<(), PlotError> {
    if values.iter().any(|value| value.is_finite()) {
        return Ok(());
    }
    let found = match values.len() {
        0 => "none".to_owned(),
        count => format!("{count} values, none finite"),
    };
    Err(PlotError::Empty { what: what.to_owned(), found })
}
