//! What is wrong with a recording, and what to do.

use serde_json::{Value, json};

/// A recording that cannot be used, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Name of the recording's file, or of all files that are concerned.
    pub file: String,
    /// What is wrong with it.
    pub why: String,
    /// What to do about it.
    pub mend: String,
}

impl Fault {
    /// A fault of a file: what is wrong, and what to do.
    pub fn new(file: &str, why: impl Into<String>, mend: &str) -> Self {
        Self { file: file.into(), why: why.into(), mend: mend.into() }
    }

    /// The fault as an entry of the report.
    pub fn json(&self) -> Value {
        json!({ "file": self.file, "why": self.why, "mend": self.mend })
    }
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}; {}", self.file, self.why, self.mend)
    }
}
