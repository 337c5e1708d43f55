use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use unripple_player::{Command, Prepared, Report};

/// A drive that began to sound.
#[derive(Clone, Debug)]
pub struct Began {
    /// The drive.
    pub drive: Arc<Prepared>,
    /// The factor on it, after limiting.
    pub gain: f32,
    /// Its first sample, of the player's clock.
    pub sample: u64,
}

/// What each voice plays, and what of it has begun.
#[derive(Debug, Default)]
pub(crate) struct Log {
    playing: BTreeMap<u64, Playing>,
    began: Vec<Began>,
}

/// The drives of a voice: those to be played once, the first to begin first, and the one that is repeated.
#[derive(Debug, Default)]
struct Playing {
    once: VecDeque<Arc<Prepared>>,
    repeated: Option<Arc<Prepared>>,
}

impl Log {
    /// A command that is sent.
    pub fn send(&mut self, command: &Command) {
        match command {
            Command::Start { voice, drive, period: None, .. } => {
                self.playing.entry(voice.0).or_default().once.push_back(drive.clone());
            }
            Command::Start { voice, drive, .. } | Command::Swap { voice, drive, .. } => {
                self.playing.entry(voice.0).or_default().repeated = Some(drive.clone());
            }
            _ => {}
        }
    }

    /// A report that came.
    pub fn hear(&mut self, report: &Report) {
        let (Report::Started { voice, .. } | Report::Refused { voice: Some(voice), .. }) = report else {
            return;
        };
        let Some(playing) = self.playing.get_mut(&voice.0) else { return };
        let drive = playing.once.pop_front().or_else(|| playing.repeated.clone());
        if let (Report::Started { sample, gain, .. }, Some(drive)) = (report, drive) {
            self.began.push(Began { drive, gain: *gain, sample: *sample });
        }
    }

    /// What has begun since this was last asked.
    pub fn take(&mut self) -> Vec<Began> {
        std::mem::take(&mut self.began)
    }
}
