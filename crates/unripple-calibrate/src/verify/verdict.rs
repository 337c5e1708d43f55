//! The result of a check of probed points.

use unripple_core::Point;

/// Options of the check of probed points.
#[derive(Clone, Debug, PartialEq)]
pub struct VerifyOptions {
    /// Whether they are compared with a model; without one only the checks that need none are made.
    pub model: bool,
    /// The probe's own delay in s, if it was taken out of the responses because it is known.
    pub probe_delay: Option<f64>,
    /// Seconds that were taken out of each point's responses before; empty for none.
    pub removed: Vec<f64>,
    /// Actuators that are dead, by their index: left out.
    pub dead: Vec<usize>,
    /// Whether a probe heard them, of one gain and one delay; taps have neither in common.
    pub probe: bool,
    /// Numbers of the points for people, from 1; empty for their order.
    pub numbers: Vec<usize>,
    /// Modes of the band that is looked at, about.
    pub modes: usize,
}

impl VerifyOptions {
    /// Number of the point in messages.
    pub(super) fn number(&self, point: usize) -> usize {
        self.numbers.get(point).copied().unwrap_or(point + 1)
    }
}

impl Default for VerifyOptions {
    fn default() -> Self {
        Self {
            model: true,
            probe_delay: None,
            removed: Vec::new(),
            dead: Vec::new(),
            probe: true,
            numbers: Vec::new(),
            modes: 60,
        }
    }
}

/// The result of a check of probed points.
#[derive(Clone, Debug, PartialEq)]
pub struct Verified {
    /// The model that they were compared with, or why there was none.
    pub model: Checked,
    /// One for each probed point, in their order; empty without a model.
    pub points: Vec<PointVerdict>,
    /// Seconds by which the probe's signals come later than the sensors', what was taken out before included.
    pub probe_delay: Option<f64>,
    /// Gain of the probe over the model, which has the sensors' scale: what most points agree on.
    pub gain: Option<f64>,
    /// Findings that are worth mentioning and cast no doubt.
    pub notes: Vec<String>,
    /// Doubts that need no model: points whose responses are those of another.
    pub copies: Vec<Doubted>,
    /// Reasons to doubt points, or all of the calibration, copies first.
    pub doubts: Vec<Doubted>,
}

impl Verified {
    /// Where there is no model.
    pub(super) fn without(why: String, copies: Vec<Doubted>) -> Self {
        Self {
            model: Checked::Not { why },
            points: Vec::new(),
            probe_delay: None,
            gain: None,
            notes: Vec::new(),
            doubts: copies.clone(),
            copies,
        }
    }
}

/// Whether there was a model to hold probed points against.
#[derive(Clone, Debug, PartialEq)]
pub enum Checked {
    /// One that was fitted to what sensors heard.
    Against {
        /// Frequencies that were compared, in Hz.
        band: [f64; 2],
        /// Share of what sensors heard there that it leaves unexplained.
        unexplained: f64,
    },
    /// There was no model.
    Not {
        /// Why there was none.
        why: String,
    },
}

/// A reason to doubt some points, or all of the calibration.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubted {
    /// The finding, and what to do.
    pub what: String,
    /// The probed points concerned, ascending from 0; empty for all of the calibration.
    pub points: Vec<usize>,
}

/// The result of a check of one probed point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointVerdict {
    /// Place where the point is said to be, in m.
    pub at: Point,
    /// Share of what was heard there (as amplitude) that the model does not explain at that place, gain and delay free.
    pub unexplained: f64,
    /// Gain over the median of the points, negative if reversed.
    pub gain: f64,
    /// Seconds by which it comes later than the points' common delay.
    pub late: f64,
    /// The place nearby that fits best, where it differs from the stated one by more than its error, and what is left
    /// unexplained there.
    pub fits: Option<(Point, f64)>,
    /// Reason to doubt the point, if there is one.
    pub doubt: Option<String>,
    /// Factor that corrects its responses, if its gain or sign is not that of the others and the rest of it is good.
    pub correction: Option<f64>,
}
