//! Why a file of another program is refused.

use std::fmt;

/// Why a file of another program cannot be read, or written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExchangeError {
    /// The content of a file is not as expected.
    #[error("{file}{at}: expected {expected}, found {found}")]
    Content {
        /// Name of the file in the message.
        file: String,
        /// Where in the file it is.
        at: Place,
        /// Description of the content that was expected.
        expected: String,
        /// Description of the content that was found.
        found: String,
    },
    /// A format cannot hold what was to be written.
    #[error("{format}: expected {expected}, found {found}")]
    Unwritable {
        /// Name of the format.
        format: &'static str,
        /// Description of what the format can hold.
        expected: String,
        /// Description of what was to be written.
        found: String,
    },
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    Whole,
    /// A line, counted from 1.
    Line(usize),
    /// A byte, counted from 0.
    Byte(usize),
    /// A line of a dataset; both are counted from 1, the line from the beginning of the file.
    Dataset {
        /// The dataset that the line is in.
        dataset: usize,
        /// The line of the file.
        line: usize,
    },
    /// A named part of the file, such as an array.
    Named(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => Ok(()),
            Self::Line(line) => write!(f, ": line {line}"),
            Self::Byte(byte) => write!(f, ": byte {byte}"),
            Self::Dataset { dataset, line } => write!(f, ": dataset {dataset}, line {line}"),
            Self::Named(name) => write!(f, ": `{name}`"),
        }
    }
}

impl ExchangeError {
    /// The error of a file's content, at a place in it.
    pub(crate) fn content(
        file: &str,
        at: Place,
        expected: impl Into<String>,
        found: impl fmt::Display,
    ) -> Self {
        Self::Content { file: file.into(), at, expected: expected.into(), found: found.to_string() }
    }
}

/// The beginning of a text from a file, for messages.
pub(crate) fn shown(text: &[u8]) -> String {
    /// Characters of a text that a message holds: about half a line.
    const MOST: usize = 40;
    let text = String::from_utf8_lossy(text);
    let mut shown: String = text.trim().chars().filter(|c| !c.is_control()).take(MOST).collect();
    if shown.chars().count() < text.trim().chars().count() {
        shown.push('…');
    }
    format!("`{shown}`")
}
