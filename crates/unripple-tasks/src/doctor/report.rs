//! Report of the task `doctor`.

use super::{Check, Verdict};
use serde::Serialize;
use std::fmt::Write;

/// Findings on every stage between a touch and what is felt.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the surface, as its file states it.
    pub surface: String,
    /// Results of all stages, in the order in which a touch passes them.
    pub checks: Vec<Check>,
    /// Likely reasons if nothing is felt: failed checks first, then doubtful ones; empty if there are none.
    pub why_you_may_feel_nothing: Vec<String>,
}

impl Report {
    /// Makes the report from the name of a surface and the results of its checks.
    pub(super) fn of(surface: String, checks: Vec<Check>) -> Self {
        let why_you_may_feel_nothing = reasons(&checks);
        Self { surface, checks, why_you_may_feel_nothing }
    }
}

/// Sentences on the checks that failed, followed by those that are doubtful.
fn reasons(checks: &[Check]) -> Vec<String> {
    let of = |verdict: Verdict| {
        let all = checks.iter().filter(move |check| check.verdict == verdict);
        all.map(|check| format!("{}: {}{}", check.name, check.found, check.advice()))
    };
    of(Verdict::Failed).chain(of(Verdict::Doubtful)).collect()
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = String::new();
        for check in &self.checks {
            let _ = writeln!(text, "{:9} {:<11} {}", check.verdict.word(), check.name, check.found);
        }
        text += "\nwhy you may feel nothing\n";
        if self.why_you_may_feel_nothing.is_empty() {
            text += "  no reason found. Thresholds differ by 6 dB between persons; rest the finger lightly: a hard press damps \
                the sheet under it.\n";
        }
        for (n, why) in self.why_you_may_feel_nothing.iter().enumerate() {
            let _ = writeln!(text, "  {}. {why}", n + 1);
        }
        text
    }

    fn failure(&self) -> Option<String> {
        let failed = self.checks.iter().filter(|check| check.verdict == Verdict::Failed);
        let failed: Vec<&str> = failed.map(|check| check.name).collect();
        let (count, all) = (failed.len(), self.checks.len());
        (count > 0).then(|| format!("{count} of {all} checks failed: {}", failed.join(", ")))
    }
}
