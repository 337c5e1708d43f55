/// Why a signal could not be made.
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
}
