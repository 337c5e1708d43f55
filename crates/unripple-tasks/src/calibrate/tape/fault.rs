//! Why a recording cannot be used, and what to do about it.

use serde_json::{Value, json};

/// Why a recording cannot be used, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Name of the recording's file, or names of all files concerned.
    pub file: String,
    /// What is wrong with the recording.
    pub why: String,
    /// What to do to get a recording that can be used.
    pub mend: String,
}

impl Fault {
    /// A fault of a recording's file: why it cannot be used, and what to do.
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
