//! What leaves the audio thread besides samples: reports, and memory to be freed.

use crate::shelf::Garbage;
use crate::{Count, Meters, Report, Voice, Which, Why};
use rtrb::Producer;
use std::sync::Arc;

/// All that leaves the audio thread besides samples.
pub(crate) struct Outlet {
    reports: Producer<Report>,
    garbage: Producer<Garbage>,
    /// Data for which the ring had no room yet. Never more than twice what the player can hold at once.
    trash: Vec<Garbage>,
    most: usize,
    /// Where losses are counted.
    pub(crate) meters: Arc<Meters>,
}

impl Outlet {
    /// An outlet for a player that holds at most `held` (a number) shared data at once.
    pub(crate) fn new(
        reports: Producer<Report>,
        garbage: Producer<Garbage>,
        held: usize,
        meters: Arc<Meters>,
    ) -> Self {
        Self { reports, garbage, trash: Vec::with_capacity(2 * held + 2), most: held, meters }
    }

    /// Whether another command can be accepted: everything that it may have to send back will still find
    /// room.
    pub(crate) fn is_open(&mut self) -> bool {
        while let Some(garbage) = self.trash.pop() {
            if let Err(rtrb::PushError::Full(garbage)) = self.garbage.push(garbage) {
                self.trash.push(garbage);
                break;
            }
        }
        self.trash.len() <= self.most
    }

    /// Sends data away to be freed.
    pub(crate) fn discard(&mut self, garbage: Garbage) {
        if let Err(rtrb::PushError::Full(garbage)) = self.garbage.push(garbage) {
            self.trash.push(garbage);
        }
    }

    /// Sends a report, or counts that it found no room.
    pub(crate) fn report(&mut self, report: Report) {
        match report {
            Report::Started { .. } => self.meters.add(Count::Started),
            Report::Limited { .. } => self.meters.add(Count::Limited),
            Report::Late { .. } => self.meters.add(Count::Late),
            Report::Refused { .. } => self.meters.add(Count::Refused),
            Report::Ended { .. } | Report::WavesLimited { .. } => {}
        }
        if self.reports.push(report).is_err() {
            self.meters.add(Count::ReportsLost);
        }
    }

    /// Reports that nothing was done, and why.
    pub(crate) fn refuse(&mut self, voice: Option<Voice>, why: Why) {
        self.report(Report::Refused { voice, why });
    }

    /// Reports the gain (a factor) that a copy got, and whether that is less than it asked for by more than
    /// rounding.
    pub(crate) fn started(
        &mut self,
        voice: Voice,
        sample: u64,
        [asked, gain]: [f32; 2],
        by: Option<(Which, usize)>,
    ) {
        self.report(Report::Started { voice, sample, gain });
        if let Some((which, output)) = by {
            let scale = gain / asked;
            if scale < 1.0 - 1e-5 {
                self.report(Report::Limited { voice, scale, which, output });
            }
        }
    }
}
