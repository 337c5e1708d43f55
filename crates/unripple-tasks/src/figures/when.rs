//! What happens at the instant at which targets are evaluated, for the labels of figures.

use unripple::field::TargetFigures;

/// What happens at the instant at which a target is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// The waves meet at the target.
    Focus,
    /// The waves of one pulse of a stroke meet at its place along the path.
    Stroke,
    /// The waveform that the target is to follow has its peak.
    Waveform,
    /// The velocity of the target is largest.
    Fastest,
    /// The request specified the instant; what happens at it is not known.
    Requested,
}

impl When {
    /// Label for the instant of the first of some targets; it says so if others are evaluated at another
    /// instant.
    pub(super) fn words(self, targets: &[TargetFigures]) -> &'static str {
        let first = targets.first().map(|target| target.instant_s);
        let shared = targets.iter().all(|target| Some(target.instant_s) == first);
        match (self, shared) {
            (Self::Focus, true) => "focal instant",
            (Self::Focus, false) => "focal instant of the first target",
            (Self::Stroke, _) => "focal instant of this pulse",
            (Self::Waveform, true) => "peak of the waveform",
            (Self::Waveform, false) => "peak of the first waveform",
            (Self::Fastest, true) => "instant of largest velocity",
            (Self::Fastest, false) => "instant of the first target's largest velocity",
            (Self::Requested, true) => "requested instant",
            (Self::Requested, false) => "requested instant at the first target",
        }
    }
}
