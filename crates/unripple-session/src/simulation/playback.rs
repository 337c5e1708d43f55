//! Playing of the surface: simulated here, or by a real device whose surface is simulated along with it.

use super::real_device::Player;
use crate::ViewError;
use crate::lock::lock;
use rtrb::{Consumer, Producer, RingBuffer};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use unripple::core::{Device, DeviceError, Layout, Point, State, Status};
use unripple_calibrate::Drift;
use unripple_devices::{Feeling, Virtual};
use unripple_live::{Engine, LiveError, PlayStats, Stage};

/// Blocks of drive that may wait between the audio thread and the picture. Half a second and more; what finds no room
/// is lost to the picture alone.
const WAITING: usize = 512;

/// The engine of a surface, with the simulated surface or the real device that it plays.
pub enum Playback {
    /// A simulated surface, at any pace.
    Here(Box<Engine>),
    /// A real device at its own pace; the surface's motion is computed from the drive that it is sent.
    Away(Box<Away>),
}

/// State of playing at the moment: fingers, sensations, counts, drift, faults.
#[derive(Clone, Debug, Default)]
pub struct Known {
    /// Fingers on the surface: their numbers and places (m).
    pub fingers: Vec<(u64, Point)>,
    /// Sensations of fingers since the state was last read.
    pub feelings: Vec<Feeling>,
    /// Counts of what was played and what was not.
    pub tally: PlayStats,
    /// Estimate of the tension, where it is followed.
    pub drift: Option<Drift>,
    /// The fault that stops playing; `None` while all runs.
    pub wrong: Option<String>,
    /// Number of blocks that the device lost.
    pub lost: u64,
}

impl Known {
    fn look(&mut self, stage: &mut Stage) {
        self.fingers = stage.fingers();
        self.feelings = stage.feelings();
        self.tally = stage.conductor().tally().clone();
        self.drift = stage.drift().copied();
    }
}

/// A real device, played on a thread of its own, and the simulated surface that is stepped along with it.
pub struct Away {
    shadow: Virtual,
    drive: Consumer<f32>,
    known: Arc<Mutex<Known>>,
    /// The thread that plays the device, which is ended when the next instrument takes the device over.
    pub player: Arc<Player>,
    /// Blocks of drive and of sensor signals of the simulated surface.
    block: Vec<f32>,
    heard: Vec<f32>,
}

impl Away {
    /// Wraps a device so that its drive is copied while it plays, and returns the receiver of the copied samples, 1 for
    /// full scale.
    pub fn listen(device: Box<dyn Device>) -> (Box<dyn Device>, Consumer<f32>) {
        let layout = device.layout();
        let (drive, overheard) = RingBuffer::new(WAITING * layout.block * layout.outputs.len().max(1));
        (Box::new(Overheard { device, drive }), overheard)
    }

    /// Starts playing on a thread of its own. `drive` yields the samples that the device was driven with, 1 for full
    /// scale.
    ///
    /// # Errors
    /// [`ViewError::Gone`] if no thread can be started.
    pub fn start(mut engine: Engine, shadow: Virtual, drive: Consumer<f32>) -> Result<Self, ViewError> {
        let (known, stop) = (Arc::new(Mutex::new(Known::default())), Arc::new(AtomicBool::new(false)));
        let (told, ended) = (known.clone(), stop.clone());
        let play = move || {
            let result = engine.run(None, |stage, play_state| {
                let mut known = lock(&told);
                known.look(stage);
                known.lost = play_state.lost;
                known.wrong = match &play_state.state {
                    State::Running => None,
                    state => Some(format!("{state:?}")),
                };
                !ended.load(Ordering::Relaxed)
            });
            if let Err(error) = result {
                lock(&told).wrong = Some(error.to_string());
            }
        };
        let thread = std::thread::Builder::new().name("play".into()).spawn(play);
        let thread = thread.map_err(|error| ViewError::Gone { why: error.to_string() })?;
        let layout = shadow.layout();
        let block = vec![0.0; layout.block * layout.outputs.len()];
        let heard = vec![0.0; layout.block * layout.inputs.len()];
        let player = Arc::new(Player::new(stop, thread));
        Ok(Self { shadow, drive, known, player, block, heard })
    }

    /// Steps the simulated surface by a block of the device's drive, and returns that block; `None` if no
    /// new block has arrived.
    pub fn step(&mut self) -> Result<Option<&[f32]>, DeviceError> {
        let Ok(chunk) = self.drive.read_chunk(self.block.len()) else { return Ok(None) };
        self.block.iter_mut().zip(chunk).for_each(|(to, x)| *to = x);
        self.shadow.exchange(&self.block, &mut self.heard)?;
        Ok(Some(&self.block))
    }
}

impl Drop for Away {
    fn drop(&mut self) {
        self.player.end();
    }
}

impl Playback {
    /// Reads the present state of playing.
    pub fn look(&mut self) -> Known {
        match self {
            Self::Here(engine) => {
                let mut known = Known::default();
                known.look(engine.stage());
                known
            }
            Self::Away(away) => {
                let mut known = lock(&away.known);
                let now = known.clone();
                known.feelings.clear();
                now
            }
        }
    }

    /// Fingers on the surface: their numbers and places (m).
    pub fn fingers(&mut self) -> Vec<(u64, Point)> {
        match self {
            Self::Here(engine) => engine.stage().fingers(),
            Self::Away(away) => lock(&away.known).fingers.clone(),
        }
    }
}

/// Plays a block on a simulated surface, and returns its drive, `[actuator][sample]` one after the other.
///
/// # Errors
/// Those of [`Engine::step`].
pub fn step(engine: &mut Engine) -> Result<&[f32], LiveError> {
    engine.step()?;
    Ok(engine.heart().drive())
}

/// A device whose drive is copied while it plays; samples that find no room are lost to the picture alone.
struct Overheard {
    device: Box<dyn Device>,
    drive: Producer<f32>,
}

impl Device for Overheard {
    fn layout(&self) -> &Layout {
        self.device.layout()
    }

    fn status(&self) -> Status {
        self.device.status()
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        if let Ok(chunk) = self.drive.write_chunk_uninit(drive.len()) {
            chunk.fill_from_iter(drive.iter().copied());
        }
        self.device.exchange(drive, heard)
    }
}
