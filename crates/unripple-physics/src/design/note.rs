//! A note on the figures of a design.

/// A statement on what the figures of a design mean on this surface, or leave out.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Note {
    /// What the note concerns.
    pub topic: String,
    /// The statement, in words.
    pub text: String,
}
