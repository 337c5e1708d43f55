//! Result of checking one stage between a touch and what is felt.

use serde::Serialize;

/// Result of checking one stage between a touch and what is felt.
#[derive(Clone, Debug, Serialize)]
pub struct Check {
    /// Name of the stage.
    pub name: &'static str,
    /// Verdict on the stage.
    pub verdict: Verdict,
    /// What the check found, in a sentence.
    pub found: String,
    /// How to correct what was found; `None` if nothing is to be done or no remedy is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fix: Option<String>,
}

/// Verdict on a stage between a touch and what is felt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The stage works as it should.
    Good,
    /// The stage works, but may be the reason why little is felt.
    Doubtful,
    /// The stage does not work.
    Failed,
    /// The stage could not be checked.
    Skipped,
}

impl Verdict {
    /// The verdict as a word for people.
    pub fn word(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Doubtful => "doubtful",
            Self::Failed => "FAILED",
            Self::Skipped => "skipped",
        }
    }
}

impl Check {
    pub(super) fn good(name: &'static str, found: impl Into<String>) -> Self {
        Self { name, verdict: Verdict::Good, found: found.into(), fix: None }
    }

    pub(super) fn doubtful(name: &'static str, found: impl Into<String>, fix: impl Into<String>) -> Self {
        Self { name, verdict: Verdict::Doubtful, found: found.into(), fix: Some(fix.into()) }
    }

    pub(super) fn failed(name: &'static str, found: impl Into<String>, fix: impl Into<String>) -> Self {
        Self { name, verdict: Verdict::Failed, found: found.into(), fix: Some(fix.into()) }
    }

    pub(super) fn skipped(name: &'static str, why: impl Into<String>) -> Self {
        Self { name, verdict: Verdict::Skipped, found: why.into(), fix: None }
    }

    /// The remedy as text to be added to a sentence; empty if there is none.
    pub(super) fn advice(&self) -> String {
        self.fix.as_ref().map_or_else(String::new, |fix| format!(" → {fix}"))
    }
}
