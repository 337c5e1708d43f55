//! A log of the drives that began, for callers that want to know what was played.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use unripple_player::{At, Command, PreparedDrive, Report};

/// Drives that are kept until somebody asks, and voices that are remembered; the oldest go first.
const MOST: usize = 1 << 14;

/// A drive that the player has begun to play.
#[derive(Clone, Debug)]
pub struct Began {
    /// The drive that began.
    pub drive: Arc<PreparedDrive>,
    /// Factor on the drive, after limiting.
    pub gain: f32,
    /// Sample of the player's clock at which the drive began.
    pub sample: u64,
}

/// Drives by the player's voice numbers, and those that have begun.
#[derive(Debug, Default)]
pub(crate) struct Log {
    playing: BTreeMap<u64, Playing>,
    began: VecDeque<Began>,
}

/// Drives of a voice, each with the sample from which on it is begun.
#[derive(Debug)]
struct Playing {
    drives: VecDeque<(u64, Arc<PreparedDrive>)>,
    repeats: bool,
}

impl Log {
    /// Records a command that was sent when the player's next block began at `now`.
    pub fn send(&mut self, command: &Command, now: u64) {
        let from = match command.at() {
            At::Now => now,
            At::Sample(sample) => sample,
        };
        match command {
            Command::Start { voice, drive, period, .. } => {
                let drives = VecDeque::from([(from, drive.clone())]);
                self.playing.insert(voice.0, Playing { drives, repeats: period.is_some() });
            }
            Command::Swap { voice, drive, .. } => {
                if let Some(playing) = self.playing.get_mut(&voice.0) {
                    playing.drives.push_back((from, drive.clone()));
                }
            }
            _ => {}
        }
        if self.playing.len() > MOST {
            self.playing.pop_first();
        }
    }

    /// Records a report of the player.
    pub fn hear(&mut self, report: &Report) {
        match report {
            Report::Started { voice, sample, gain } => self.start(voice.0, *sample, *gain),
            Report::Ended { voice, .. } => self.forget(voice.0),
            // For a repeated drive it may be a change that was refused.
            Report::Refused { voice: Some(voice), .. }
                if self.playing.get(&voice.0).is_some_and(|playing| !playing.repeats) =>
            {
                self.forget(voice.0);
            }
            _ => {}
        }
    }

    fn start(&mut self, voice: u64, sample: u64, gain: f32) {
        let Some(playing) = self.playing.get_mut(&voice) else { return };
        while playing.drives.get(1).is_some_and(|(from, _)| *from <= sample) {
            playing.drives.pop_front();
        }
        let drive = playing.drives.front().map(|(_, drive)| drive.clone());
        if !playing.repeats {
            self.forget(voice);
        }
        self.began.extend(drive.map(|drive| Began { drive, gain, sample }));
        if self.began.len() > MOST {
            self.began.pop_front();
        }
    }

    /// Removes a voice on which no more reports are expected.
    pub fn forget(&mut self, voice: u64) {
        self.playing.remove(&voice);
    }

    /// Accounts for lost reports: removes all drives that do not repeat, since it is unknown whether they began.
    pub fn miss(&mut self) {
        self.playing.retain(|_, playing| playing.repeats);
    }

    /// Drives that have begun since this was last called.
    pub fn take(&mut self) -> Vec<Began> {
        std::mem::take(&mut self.began).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_player::Voice;

    /// Voices and drives beyond the bound.
    const MORE: u64 = 5;

    /// Sends the start of a drive under a voice number, once or repeated.
    fn send(log: &mut Log, voice: u64, period: Option<f64>) {
        let drive = Arc::new(PreparedDrive::new(1, vec![0.5]).unwrap());
        log.send(&Command::Start { voice: Voice(voice), drive, at: At::Now, gain: 1.0, period }, 0);
    }

    /// Samples at which drives began since this was last asked.
    fn began(log: &mut Log) -> Vec<u64> {
        log.take().iter().map(|began| began.sample).collect()
    }

    fn start(log: &mut Log, voice: u64) {
        log.hear(&Report::Started { voice: Voice(voice), sample: voice, gain: 1.0 });
    }

    #[test]
    fn the_newest_drives_are_kept() {
        let (mut log, last) = (Log::default(), MOST as u64 + MORE);
        for voice in 0..last {
            send(&mut log, voice, None);
            start(&mut log, voice);
        }
        assert_eq!(log.playing.len(), 0, "what is played once is over for the log when it begins");
        assert_eq!(began(&mut log), (MORE..last).collect::<Vec<_>>());
        assert!(began(&mut log).is_empty());
    }

    #[test]
    fn the_newest_voices_are_kept() {
        let (mut log, last) = (Log::default(), MOST as u64 + MORE);
        (0..last).for_each(|voice| send(&mut log, voice, Some(64.0)));
        assert_eq!(log.playing.len(), MOST);
        (0..last).for_each(|voice| start(&mut log, voice));
        assert_eq!(began(&mut log), (MORE..last).collect::<Vec<_>>());
        // Only what is repeated may begin again, and a voice that has ended may not.
        log.hear(&Report::Ended { voice: Voice(MORE), sample: last });
        (0..last).for_each(|voice| start(&mut log, voice));
        assert_eq!(began(&mut log), (MORE + 1..last).collect::<Vec<_>>());
    }

    #[test]
    fn what_is_repeated_outlives_lost_reports() {
        let mut log = Log::default();
        send(&mut log, 1, None);
        send(&mut log, 2, Some(64.0));
        log.miss();
        [1, 2].into_iter().for_each(|voice| start(&mut log, voice));
        assert_eq!(began(&mut log), [2]);
        log.forget(2);
        start(&mut log, 2);
        assert!(began(&mut log).is_empty());
    }
}
