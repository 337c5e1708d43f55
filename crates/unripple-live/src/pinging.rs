//! When test signals for following the tension are sent.

use crate::Conductor;
use std::sync::Arc;
use unripple_player::PreparedDrive;

/// Sends a ping at the beginning of each period of observation in which no finger is there, so that it is over at its end.
#[derive(Debug)]
pub(crate) struct Pinging {
    ping: Arc<PreparedDrive>,
    /// Samples of a period, and which one was last begun.
    period: u64,
    begun: Option<u64>,
}

impl Pinging {
    /// A ping to be sent once in each period of `period` samples.
    pub fn new(ping: Arc<PreparedDrive>, period: u64) -> Self {
        Self { ping, period: period.max(1), begun: None }
    }

    /// Sample at which the next ping is due.
    pub fn due(&self, now: u64) -> u64 {
        (now / self.period + 1) * self.period
    }

    /// Sends a ping if one is due and no finger is down.
    pub fn step(&mut self, now: u64, touched: bool, conductor: &mut Conductor) {
        let period = now / self.period;
        if self.begun.replace(period) != Some(period) && !touched {
            conductor.ping(self.ping.clone());
        }
    }
}
