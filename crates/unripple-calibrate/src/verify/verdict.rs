//! The result of a check of probed points.

use unripple_core::Point;

/// Options of the check of probed points.
#[derive(Clone, Debug, PartialEq)]
pub struct VerifyOptions {
    /// Whether the points are compared with a model; without one only the checks that need none are made.
    pub model: bool,
    /// Known delay of the probe relative to the sensors, in s, if it was removed from the responses.
    pub probe_delay: Option<f64>,
    /// Delay that was already removed from the responses of each point, in s; empty for none.
    pub removed: Vec<f64>,
    /// Indices of dead actuators, which are left out.
    pub dead: Vec<usize>,
    /// Whether the points were measured by a probe, which has one gain and one delay; taps have neither in common.
    pub probe: bool,
    /// Numbers of the points in messages, from 1; empty to number them in their order.
    pub numbers: Vec<usize>,
    /// Approximate number of modes in the band that is compared.
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
    /// The model that the points were compared with, or why there was none.
    pub model: Checked,
    /// Verdict on each probed point, in their order; empty without a model.
    pub points: Vec<PointVerdict>,
    /// Delay of the probe relative to the sensors, in s, including what was removed before; `None` if it is too small
    /// to matter, or not found.
    pub probe_delay: Option<f64>,
    /// Gain of the probe relative to the sensors, on which most points agree; `None` if they do not.
    pub gain: Option<f64>,
    /// Findings that are reported but cast no doubt.
    pub notes: Vec<String>,
    /// Doubts that need no model: points whose responses are copies of another point's.
    pub copies: Vec<Doubted>,
    /// Reasons to doubt points, or all of the calibration, copies first.
    pub doubts: Vec<Doubted>,
}

impl Verified {
    /// The result without a model, and why there is none.
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

/// Whether there was a model to compare probed points with.
#[derive(Clone, Debug, PartialEq)]
pub enum Checked {
    /// The points were compared with a model that was fitted to the sensors' responses.
    Against {
        /// Frequencies that were compared, in Hz.
        band: [f64; 2],
        /// Share of the sensors' responses there, as amplitude, that the model leaves unexplained.
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
    /// Stated place of the point, in m.
    pub at: Point,
    /// Share of the point's responses, as amplitude, that the model does not explain at that place, with gain and delay
    /// free.
    pub unexplained: f64,
    /// Gain relative to that of most points (to the median of all if they disagree), negative if reversed.
    pub gain: f64,
    /// Delay relative to the points' common delay, in s.
    pub late: f64,
    /// The place nearby that fits best, and the share that is unexplained there, as amplitude; `None` if it is less
    /// than three standard errors from the stated place, or too near to matter.
    pub fits: Option<(Point, f64)>,
    /// Reason to doubt the point, if there is one.
    pub doubt: Option<String>,
    /// Factor that corrects the point's responses, if only their gain or sign differs from that of the other points.
    pub correction: Option<f64>,
}
