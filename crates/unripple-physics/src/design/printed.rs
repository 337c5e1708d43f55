//! What the paper (Hudin et al. 2012) prints about its own film, for comparison in a design of that film,
//! and remarks on its text.

use super::{ByRate, Touch};

/// What the paper (Hudin et al. 2012) prints about its film or advises for it, computed here for that film,
/// with remarks on the paper's text.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct PaperFigures {
    /// Phase velocity at a wavelength of 15 mm, in m/s.
    pub celerity_at_15mm_m_s: f64,
    /// Time-reversal window by the paper's formula (2S k_max + P)/(2 N c_min), in seconds: area S,
    /// perimeter P, N actuators, lowest phase velocity c_min and k_max = 2π/15 mm.
    pub window_s: f64,
    /// The decay time T/N that section 3.2 of the paper recommends, in seconds.
    pub decay_time_s: f64,
    /// Predicted contrast of a single focus if the decay time is `decay_time_s`.
    pub contrast_at_decay_time: f64,
    /// Table of predicted contrast against the rate at which the focus is repeated, if the decay time is
    /// `decay_time_s`; rates as in [`Design::contrast_by_rate`](super::Design).
    pub contrast_by_rate: Vec<ByRate>,
    /// Power needed to move a finger by 10 µm, for the strips of the paper's table 1.
    pub table1: Vec<Touch>,
    /// Remarks on the paper's text, misprints first.
    pub remarks: Vec<Remark>,
}

/// The kind of a remark on the paper: whether it corrects a misprint or concerns a different model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Nature {
    /// A misprint or a slip of arithmetic, which can be shown from the paper alone.
    Misprint,
    /// A difference of model, assumption or convention between the paper and these figures.
    Model,
}

impl Nature {
    /// The nature of a remark in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Misprint => "misprint or arithmetic",
            Self::Model => "model or assumption",
        }
    }
}

/// A remark on a statement of the paper.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Remark {
    /// Subject of the paper's statement.
    pub topic: String,
    /// The kind of the remark: about a misprint, or about a difference of model.
    pub nature: Nature,
    /// The statement of the paper.
    pub printed: String,
    /// The remark on it: what is correct, and why.
    pub remark: String,
}
