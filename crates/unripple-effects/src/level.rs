//! How strong an effect is: a gain, or dB above threshold.

/// How strong something is: a share of full level, or a level above threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Level {
    /// Share of the full level, 0 to 1: of what whoever plays takes for full.
    Share(f64),
    /// Above the threshold of the fingertip, in dB.
    Felt(f64),
}

impl Level {
    /// The level whose amplitude is `gain` (a factor) times this one's; nothing at all for a gain of 0.
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
