/// Why a signal or a plan could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DspError {
    /// Two sizes that must agree do not.
    #[error("{what}: expected {expected}, found {found}")]
    Size {
        /// What was counted.
        what: &'static str,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A number is out of its range.
    #[error("{what}: expected {expected}, found {found}")]
    Range {
        /// What the number is, with its unit.
        what: &'static str,
        /// The legal values.
        expected: String,
        /// The value.
        found: f64,
    },
}
