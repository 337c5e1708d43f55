//! Tension followed while playing, from the drive and the actuators' own signals.

use crate::{FocusWorker, LiveError};
use std::sync::Arc;
use unripple_calibrate::{Drift, Tracker};
use unripple_core::Responses;
use unripple_focus::Options;

/// Change of tension from which on drives are made anew.
const WORTH: f64 = 1e-4;

/// Periods after a finger has left in which the sheet still rings as it did under the finger.
const SETTLING: u32 = 1;

/// Follows tension while the surface is played, from the drive and the actuators' own signals, by a Kalman
/// filter ([`Tracker`]).
///
/// The model knows the sheet without fingers. So stretches in which a finger was on it are passed over, and a ping that
/// nobody feels tells of the tension as soon as all have left.
#[derive(Debug)]
pub struct Follower {
    tracker: Tracker,
    options: Options,
    /// Samples of one observation.
    period: usize,
    /// Lines of drive and inputs, a drive's sample beside the input's that answers it.
    drive: Vec<Vec<f64>>,
    heard: Vec<Vec<f64>>,
    rate: f64,
    /// Tension that the drives are made for.
    made_for: f64,
    last: Option<Drift>,
    observations: u64,
    /// Whether a finger was there in the period under way, and periods until the sheet has settled.
    touched: bool,
    settling: u32,
}

impl Follower {
    /// A tracker at work every `period` s, drives made by some options; inputs come `latency` samples after the drive was sent.
    pub fn new(
        tracker: Tracker,
        options: &Options,
        channels: usize,
        rate: f64,
        period: f64,
        latency: usize,
    ) -> Self {
        Self {
            tracker,
            options: options.clone(),
            period: ((period * rate) as usize).max(1),
            drive: vec![vec![0.0; latency]; channels],
            heard: vec![Vec::new(); channels],
            rate,
            made_for: 1.0,
            last: None,
            observations: 0,
            touched: false,
            settling: 0,
        }
    }

    /// Result of the last observation.
    pub fn last(&self) -> Option<&Drift> {
        self.last.as_ref()
    }

    /// Samples of one observation.
    pub fn period(&self) -> usize {
        self.period
    }

    /// Number of observations so far.
    pub fn observations(&self) -> u64 {
        self.observations
    }

    /// Takes in a block: planes of drive and of the sensors, in the actuators' and sensors' units; and whether a finger was on the
    /// sheet.
    pub fn take(&mut self, drive: &[f32], heard: &[f32], block: usize, touched: bool) {
        self.touched |= touched;
        for (lines, planes) in [(&mut self.drive, drive), (&mut self.heard, heard)] {
            for (line, plane) in lines.iter_mut().zip(planes.chunks_exact(block)) {
                line.extend(plane.iter().map(|x| f64::from(*x)));
            }
        }
    }

    /// Once a period is full: what it says of tension, and a maker for the surface as it is now, if that has changed.
    ///
    /// # Errors
    /// Those of [`Tracker::observe`] and [`FocusWorker::new`].
    pub fn observe(&mut self) -> Result<Option<FocusWorker>, LiveError> {
        if self.heard.iter().map(Vec::len).min().unwrap_or(0) < self.period {
            return Ok(None);
        }
        let part = |lines: &mut Vec<Vec<f64>>| -> Vec<Vec<f64>> {
            lines.iter_mut().map(|line| line.drain(..self.period.min(line.len())).collect()).collect()
        };
        let (drive, heard) = (part(&mut self.drive), part(&mut self.heard));
        if std::mem::take(&mut self.touched) {
            self.settling = SETTLING + 1;
        }
        if self.settling > 0 {
            self.settling -= 1;
            self.tracker.skip(&drive, self.period)?;
            return Ok(None);
        }
        let drift = self.tracker.observe(&drive, &heard)?;
        self.last = Some(drift);
        self.observations += 1;
        // The drives made now are used over the next period: half of it ahead is their middle.
        let ahead = 0.5 * self.period as f64 / self.rate;
        let tension = self.tracker.tension(ahead);
        if drift.asks_for_calibration() || (tension - self.made_for).abs() < WORTH {
            return Ok(None);
        }
        self.made_for = tension;
        let responses = Responses::Modal(self.tracker.responses(ahead));
        Ok(Some(FocusWorker::new(Arc::new(responses), &self.options)?))
    }
}
