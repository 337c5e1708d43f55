//! A natural frequency as it was measured.

/// A natural frequency that was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heard {
    /// Frequency in Hz.
    pub hz: f64,
    /// Decay time in s, in which the amplitude falls to 1/e, if it was measured.
    pub decay_time: Option<f64>,
}

impl Heard {
    /// A frequency (Hz) without a decay time.
    pub fn at(hz: f64) -> Self {
        Self { hz, decay_time: None }
    }
}
