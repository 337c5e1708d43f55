//! Drives that began to sound, for whoever asks what was played.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use unripple_player::{At, Command, Prepared, Report};

/// Drives that are kept until somebody asks, and names that are remembered; the oldest go first.
const MOST: usize = 1 << 14;

/// A drive that began to sound.
#[derive(Clone, Debug)]
pub struct Began {
    /// The drive that began.
    pub drive: Arc<Prepared>,
    /// The factor on it, after limiting.
    pub gain: f32,
    /// First sample of the drive, of the player's clock.
    pub sample: u64,
}

/// Drives under each of the player's names, and those that have begun.
#[derive(Debug, Default)]
pub(crate) struct Log {
    playing: BTreeMap<u64, Playing>,
    began: VecDeque<Began>,
}

/// Drives of a name, and from when on each is begun.
#[derive(Debug)]
struct Playing {
    drives: VecDeque<(u64, Arc<Prepared>)>,
    repeats: bool,
}

impl Log {
    /// A command that was sent when the player's next block began at `now`.
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

    /// A report that came.
    pub fn hear(&mut self, report: &Report) {
        match report {
            Report::Started { voice, sample, gain } => self.start(voice.0, *sample, *gain),
            Report::Ended { voice, .. } => self.forget(voice.0),
            // Of what repeats a change may have been refused.
            Report::Refused { voice: Some(voice), .. }
                if self.playing.get(&voice.0).is_some_and(|playing| !playing.repeats) =>
            {
                self.forget(voice.0);
            }
            _ => {}
        }
    }

    fn start(&mut self, name: u64, sample: u64, gain: f32) {
        let Some(playing) = self.playing.get_mut(&name) else { return };
        while playing.drives.get(1).is_some_and(|(from, _)| *from <= sample) {
            playing.drives.pop_front();
        }
        let drive = playing.drives.front().map(|(_, drive)| drive.clone());
        if !playing.repeats {
            self.forget(name);
        }
        self.began.extend(drive.map(|drive| Began { drive, gain, sample }));
        if self.began.len() > MOST {
            self.began.pop_front();
        }
    }

    /// Forgets the player's name of a drive: nothing more is reported of it.
    pub fn forget(&mut self, name: u64) {
        self.playing.remove(&name);
    }

    /// Reports were lost: of what is played once nobody knows any more whether it began.
    pub fn miss(&mut self) {
        self.playing.retain(|_, playing| playing.repeats);
    }

    /// Drives that have begun since this was last called.
    pub fn take(&mut self) -> Vec<Began> {
        std::mem::take(&mut self.began).into()
    }
}
