//! The level of an effect: a share of full scale, or dB above the detection threshold.

/// The level of a pulse or waveform: relative to full level, or to the detection threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Level {
    /// Amplitude as a share of the full level, 0 to 1; the player defines what the full level is.
    Share(f64),
    /// Displacement above the vibrotactile detection threshold of the fingertip, in dB.
    Felt(f64),
}

impl Level {
    /// The level whose amplitude is `gain` (a factor) times that of this one; a share of 0 if the gain is not positive.
    ///
    /// ```
    /// use unripple_effects::Level;
    ///
    /// assert_eq!(Level::Share(0.5).scaled(0.5), Level::Share(0.25));
    /// assert_eq!(Level::Felt(20.0).scaled(0.1), Level::Felt(0.0));
    /// assert_eq!(Level::Felt(20.0).scaled(0.0), Level::Share(0.0));
    /// ```
    pub fn scaled(self, gain: f64) -> Self {
        if gain.is_nan() || gain <= 0.0 {
            return Self::Share(0.0);
        }
        match self {
            Self::Share(share) => Self::Share(share * gain),
            Self::Felt(db) => Self::Felt(db + 20.0 * gain.log10()),
        }
    }
}
