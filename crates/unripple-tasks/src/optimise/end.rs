//! Why a search is over.

use serde::Serialize;

/// Why a search is over.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct End {
    /// Who ended it.
    pub by: EndedBy,
    /// The reason, in words.
    pub why: String,
}

/// Who or what ended a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum EndedBy {
    /// All generations of the plan are computed.
    Generations,
    /// What was found has not improved for as many generations as the request says.
    NoImprovement,
    /// The optimiser, which has nothing more to ask for.
    Optimiser,
}
