//! Report of the task `modes`.

use serde::Serialize;
use std::fmt::Write;

/// Modes listed for people; JSON has all.
const LISTED: usize = 40;

/// The modes of a surface, lowest first.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The surface's own name.
    pub surface: String,
    /// Highest frequency looked for, in Hz.
    pub max_hz: f64,
    /// Number of modes.
    pub count: usize,
    /// Natural frequency of each mode, in Hz.
    pub frequencies_hz: Vec<f64>,
    /// Time in which the amplitude of each mode falls to 1/e, in s; `None` where it does not decay.
    pub decay_times_s: Vec<Option<f64>>,
    /// Share of bending in the stiffness of each mode, 0 to 1; the rest is tension.
    pub bending_shares: Vec<f64>,
    /// Largest relative error of the frequencies, estimated.
    pub relative_error: f64,
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = format!("{}: {} modes up to {} Hz\n", self.surface, self.count, self.max_hz);
        text += "  mode   frequency Hz   decay time ms   bending share %\n";
        let rows = self.frequencies_hz.iter().zip(&self.decay_times_s).zip(&self.bending_shares);
        for (i, ((hz, decay), bending)) in rows.enumerate().take(LISTED) {
            let (ms, share) = (1e3 * decay.unwrap_or(f64::INFINITY), 100.0 * bending);
            let _ = writeln!(text, "{:6} {hz:14.4} {ms:15.3} {share:17.3}", i + 1);
        }
        if self.count > LISTED {
            let _ = writeln!(text, "   ... and {} more; --json lists all", self.count - LISTED);
        }
        text
    }
}
