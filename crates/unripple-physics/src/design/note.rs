//! A note on the figures of a design.

/// A statement on what the figures of a design mean for this surface, or what they leave out.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Note {
    /// Subject of the note, such as `thick sheet`.
    pub topic: String,
    /// The statement, in words.
    pub text: String,
}
