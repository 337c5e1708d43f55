//! Why something could not be read or written.

use crate::FileFaults;
use miette::Diagnostic;
use std::io;
use std::path::{Path, PathBuf};

/// Why something could not be read or written.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum StoreError {
    /// A file or folder cannot be read.
    #[error("cannot read {}: {reason}", path.display())]
    Read {
        /// The file or folder that cannot be read.
        path: PathBuf,
        /// The error that the system reports.
        reason: io::Error,
    },
    /// A file or folder cannot be written.
    #[error("cannot write to {}: {reason}", path.display())]
    Write {
        /// The file or folder that cannot be written.
        path: PathBuf,
        /// The error that the system reports.
        reason: io::Error,
    },
    /// No built-in surface and no file has that name.
    #[error("no surface `{name}`: expected a file, or one of {builtins}{}", did_you_mean(nearest))]
    UnknownSurface {
        /// The name that was requested.
        name: String,
        /// Names of the built-in surfaces.
        builtins: String,
        /// The built-in name nearest to the requested one; `None` if none is near.
        nearest: Option<String>,
    },
    /// A file of a surface or of effects has faults.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Surface(#[from] FileFaults),
    /// A file is not in TOML.
    #[error("{file}: {fault}")]
    Toml {
        /// Name of the file in the message.
        file: String,
        /// Description of the fault, with its line and column.
        fault: String,
    },
    /// The content of a file is not as expected.
    #[error("{file}: expected {expected}, found {found}")]
    Content {
        /// Name of the file in the message.
        file: String,
        /// Description of the content that was expected.
        expected: String,
        /// Description of the content that was found.
        found: String,
    },
    /// An output would overwrite something that it must not, such as files that this program did not write.
    #[error("will not write to {}: expected {expected}, found {found}", path.display())]
    Occupied {
        /// Path at which the output was to be written.
        path: PathBuf,
        /// Description of what an output may replace at that path.
        expected: &'static str,
        /// What is there.
        found: String,
    },
    /// An output would replace a file or folder that the same command reads.
    #[error("will not write to {}: expected no file that this command reads, found {}; name another output", path.display(), read.display())]
    Reads {
        /// Path at which the output was to be written.
        path: PathBuf,
        /// The file or folder that the command reads.
        read: PathBuf,
    },
}

fn did_you_mean(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |name| format!(" (nearest: {name})"))
}

impl StoreError {
    /// Whether the input is at fault, rather than the destination of an output.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Read { .. }
            | Self::UnknownSurface { .. }
            | Self::Surface(_)
            | Self::Toml { .. }
            | Self::Content { .. }
            | Self::Reads { .. } => true,
            Self::Write { .. } | Self::Occupied { .. } => false,
        }
    }

    /// Turns an error of the system into one that says what could not be read.
    pub(crate) fn read(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |reason| Self::Read { path: path.into(), reason }
    }

    /// Turns an error of the system into one that says where could not be written.
    pub(crate) fn write(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |reason| Self::Write { path: path.into(), reason }
    }

    pub(crate) fn content(file: &str, expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self::Content { file: file.into(), expected: expected.into(), found: found.into() }
    }
}
