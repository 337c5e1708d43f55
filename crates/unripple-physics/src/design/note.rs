//! An error in the paper (Hudin et al. 2012), beside the right value.

/// An error in the paper (Hudin et al. 2012), and the right value.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Note {
    /// What the error concerns.
    pub topic: String,
    /// The statement of the paper.
    pub paper: String,
    /// The right value, for this surface.
    pub here: String,
}
