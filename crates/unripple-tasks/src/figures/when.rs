//! What figures call the instant at which targets are evaluated.

use unripple::field::TargetFigures;

/// What happens at the instant at which a target is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// The waves meet at the target.
    Focus,
    /// The waves meet at one place of many along a path.
    Stroke,
    /// The waveform that was asked for is largest.
    Waveform,
    /// The velocity of the target is largest.
    Fastest,
    /// Nothing that is known: the instant was asked for.
    Asked,
}

impl When {
    /// The instant of the first of some targets in words, which say so where others have another one.
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
            (Self::Asked, true) => "instant asked for",
            (Self::Asked, false) => "instant asked for at the first target",
        }
    }
}
