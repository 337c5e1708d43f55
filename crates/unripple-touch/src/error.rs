//! Errors of sources of touches.

use unripple_core::OutOfRange;

/// What goes wrong when a source of touches is opened, or a touch is pushed. Once open, a source counts what it refuses: see
/// [`Counts`](crate::Counts).
#[derive(Debug, thiserror::Error)]
pub enum TouchError {
    /// The operating system reports an error of a socket, a device or a file.
    #[error("{what}: {error}; {fix}")]
    Io {
        /// The operation that failed, in words.
        what: String,
        /// The error that the system reports.
        error: std::io::Error,
        /// Advice on how to remedy the error.
        fix: &'static str,
    },
    /// A value is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// A line of a recording is invalid.
    #[error("line {line}: {what}")]
    Line {
        /// Number of the line, counted from 1.
        line: usize,
        /// What was expected and what was found.
        what: String,
    },
    /// A touch that a program pushed is refused.
    #[error("{what}: expected {expected}, found {found}")]
    Pushed {
        /// What is refused: `finger`, `at_m`, `force_n`, `time_s`, or the number of `fingers` or `touches`.
        what: &'static str,
        /// The values that are accepted, in words.
        expected: String,
        /// The value that was found.
        found: String,
    },
    /// A device file is not that of a multi-touch screen that can be read.
    #[error("{device}: expected a multi-touch screen, found none: {what}")]
    Screen {
        /// Path of the device.
        device: String,
        /// Why the device cannot be read.
        what: String,
    },
}

impl TouchError {
    pub(crate) fn io(what: impl Into<String>, error: std::io::Error, fix: &'static str) -> Self {
        Self::Io { what: what.into(), error, fix }
    }
}
