//! What a sound goes back to: its voice, and the command that began it.

use crate::Voice;

/// Name of a voice, and the number of the command that began it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Whose {
    /// Name of the voice.
    pub(crate) voice: Voice,
    /// Number of the command.
    pub(crate) id: u64,
}
