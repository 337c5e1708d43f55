//! The origin of a sound: its voice, and the command that began it.

use crate::Voice;

/// Number of a voice, and the number of the command that began it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Whose {
    /// Number of the voice.
    pub(crate) voice: Voice,
    /// Number of the command.
    pub(crate) id: u64,
}
