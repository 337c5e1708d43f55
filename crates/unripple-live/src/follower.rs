//! Follows the tension of a sheet while it is played, from the drive and the sensor signals of the actuators.

use crate::{FocusWorker, LiveError};
use std::sync::Arc;
use unripple_calibrate::{Drift, Tracker};
use unripple_core::Responses;
use unripple_focus::Options;

/// Relative change of tension from which drives are computed again. At 3 kHz it moves the modes of the paper's film
/// by less than a tenth of their linewidth.
const WORTH: f64 = 1e-4;

/// Periods after a finger has left in which the sheet still rings as it did under the finger.
const SETTLING: u32 = 1;

/// Follows the tension of a sheet while it is played, from the drive and the sensor signals of the actuators, by a
/// Kalman filter ([`Tracker`]).
///
/// The model is that of the sheet without fingers. So periods in which a finger was on it are skipped. A ping, a test
/// signal too weak to be felt, measures the tension as soon as all fingers have left.
#[derive(Debug)]
pub struct Follower {
    tracker: Tracker,
    options: Options,
    /// Number of samples of one observation.
    period: usize,
    /// Samples of drive and of inputs by channel, so aligned that an input is beside the drive that causes it.
    drive: Vec<Vec<f64>>,
    heard: Vec<Vec<f64>>,
    rate: f64,
    /// Tension that the drives are computed for, relative to that at calibration.
    made_for: f64,
    last: Option<Drift>,
    observations: u64,
    /// Whether a finger was there in the period under way, and periods until the sheet has settled.
    touched: bool,
    settling: u32,
}

impl Follower {
    /// A follower that runs `tracker` every `period` s and computes drives with `options`. There are `channels`
    /// actuators and `rate` samples per second; inputs arrive `latency` samples after the drive that causes them.
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

    /// Result of the last observation; `None` before the first.
    pub fn last(&self) -> Option<&Drift> {
        self.last.as_ref()
    }

    /// Number of samples of one observation.
    pub fn period(&self) -> usize {
        self.period
    }

    /// Number of observations so far.
    pub fn observations(&self) -> u64 {
        self.observations
    }

    /// Adds a block of `block` samples per channel, channel after channel: drive in the actuators' unit and sensor
    /// signals in the sensors' unit. `touched` tells whether a finger was on the sheet.
    pub fn take(&mut self, drive: &[f32], heard: &[f32], block: usize, touched: bool) {
        self.touched |= touched;
        for (lines, planes) in [(&mut self.drive, drive), (&mut self.heard, heard)] {
            for (line, plane) in lines.iter_mut().zip(planes.chunks_exact(block)) {
                line.extend(plane.iter().map(|x| f64::from(*x)));
            }
        }
    }

    /// Updates the tension ([`Follower::last`]) when a period is complete. Returns a worker for the sheet as it is
    /// now if its tension has changed by 1e-4 or more since drives were last computed.
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
        if drift.needs_calibration() || (tension - self.made_for).abs() < WORTH {
            return Ok(None);
        }
        self.made_for = tension;
        let responses = Responses::Modal(self.tracker.responses(ahead));
        Ok(Some(FocusWorker::new(Arc::new(responses), &self.options)?))
    }
}
