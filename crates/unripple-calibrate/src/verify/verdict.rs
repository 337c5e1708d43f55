//! The result of a check of probed points.

use unripple_core::Point;

/// Options of the check of probed points.
#[derive(Clone, Debug, PartialEq)]
pub struct VerifyOptions {
    /// Whether the points are compared with a model; otherwise only checks without a model are made.
    pub model: bool,
    /// Delay of the probe relative to the sensors, in s, that was specified and removed from the responses;
    /// `None` if none was.
    pub probe_delay: Option<f64>,
    /// Delay that was already removed from the responses of each point, in s; empty for none.
    pub removed: Vec<f64>,
    /// Indices of dead actuators, which are left out.
    pub dead: Vec<usize>,
    /// Whether the points were measured by a probe, which has one gain and one delay for all points; taps
    /// have not.
    pub probe: bool,
    /// Numbers of the points in messages, from 1; if empty, the points are numbered in their order.
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
    /// The model with which the points were compared, or the reason why there was none.
    pub model: Checked,
    /// Verdict on each probed point, in their order; empty without a model.
    pub points: Vec<PointVerdict>,
    /// Delay of the probe relative to the sensors, in s, including any delay that was removed before; `None`
    /// if it is too small to matter, or not found.
    pub probe_delay: Option<f64>,
    /// Gain of the probe relative to the sensors, on which most points agree; `None` if they do not.
    pub gain: Option<f64>,
    /// Findings that are reported but are no reason for doubt.
    pub notes: Vec<String>,
    /// Points whose responses are copies of another point's, which are found without a model.
    pub copies: Vec<Doubted>,
    /// All reasons to doubt points or the whole calibration; those of `copies` come first.
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

/// Whether there was a model with which probed points were compared.
#[derive(Clone, Debug, PartialEq)]
pub enum Checked {
    /// The points were compared with a model that was fitted to the sensors' responses.
    Against {
        /// Lowest and highest frequency that were compared, in Hz.
        band: [f64; 2],
        /// Share of the sensors' responses in this band, as amplitude, that the model leaves unexplained.
        unexplained: f64,
    },
    /// The points were not compared, since there was no model.
    Not {
        /// The reason why there was no model.
        why: String,
    },
}

/// A reason to doubt some points, or the whole calibration.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubted {
    /// The finding, and what to do about it, in words.
    pub what: String,
    /// Indices of the probed points concerned, ascending; empty if the whole calibration is doubted.
    pub points: Vec<usize>,
}

/// The result of a check of one probed point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointVerdict {
    /// Stated place of the point, in m.
    pub at: Point,
    /// Share of the point's responses, as amplitude, that the model at the stated place does not explain,
    /// whatever the gain.
    pub unexplained: f64,
    /// Gain of the point's responses relative to the gain on which most points agree, or to the median gain
    /// if there is none; negative if reversed.
    pub gain: f64,
    /// Delay of the point's responses relative to the delay common to all points, in s.
    pub late: f64,
    /// The place nearby that fits best, and the share of the responses that is unexplained there, as
    /// amplitude; `None` if it is too near the stated place to matter, or does not fit clearly better.
    pub fits: Option<(Point, f64)>,
    /// The reason to doubt the point, in words; `None` if there is none.
    pub doubt: Option<String>,
    /// Factor that corrects the point's responses; `None` unless only their gain or sign differs from that
    /// of the other points.
    pub correction: Option<f64>,
}
