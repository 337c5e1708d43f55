//! Playback of the surface: here, or by a device elsewhere that is mirrored.

use crate::ViewError;
use crate::lock::lock;
use rtrb::{Consumer, Producer, RingBuffer};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use unripple::core::{Device, DeviceError, Layout, Point, State, Status};
use unripple_calibrate::Drift;
use unripple_devices::{Feeling, Virtual};
use unripple_live::{Engine, LiveError, PlayStats, Stage};

/// Blocks of drive that may wait between the audio thread and the picture. Half a second and more; what finds no room
/// is lost to the picture alone.
const WAITING: usize = 512;

/// The player of a surface, and the surface that moves.
pub enum Playback {
    /// Both here, at whatever pace is asked for.
    Here(Box<Engine>),
    /// A real device at its own pace; what it does is computed from the drive it gets.
    Away(Box<Away>),
}

/// The state of the play at the moment: fingers, sensations, counts, drift, faults.
#[derive(Clone, Debug, Default)]
pub struct Known {
    /// Fingers, by number.
    pub fingers: Vec<(u64, Point)>,
    /// Sensations of fingers since the last look.
    pub feelings: Vec<Feeling>,
    /// Counts of what was played and what was not.
    pub tally: PlayStats,
    /// State of the tension, where it is followed.
    pub drift: Option<Drift>,
    /// The fault that stops it; nothing while all runs.
    pub wrong: Option<String>,
    /// Blocks that a device lost.
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

/// A real device, played on threads of its own, and the surface that is computed along with it.
pub struct Away {
    shadow: Virtual,
    drive: Consumer<f32>,
    known: Arc<Mutex<Known>>,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
    /// Blocks of the shadow, and what it hears.
    block: Vec<f32>,
    heard: Vec<f32>,
}

impl Away {
    /// A device whose drive is passed on as it plays, and the samples of that, 1 for full scale.
    pub fn listen(device: Box<dyn Device>) -> (Box<dyn Device>, Consumer<f32>) {
        let layout = device.layout();
        let (drive, overheard) = RingBuffer::new(WAITING * layout.block * layout.outputs.len().max(1));
        (Box::new(Overheard { device, drive }), overheard)
    }

    /// Begins to play. `drive` yields the samples that the device was driven with, 1 for full scale.
    ///
    /// # Errors
    /// [`ViewError::Gone`] if no thread can be had.
    pub fn start(mut engine: Engine, shadow: Virtual, drive: Consumer<f32>) -> Result<Self, ViewError> {
        let (known, stop) = (Arc::new(Mutex::new(Known::default())), Arc::new(AtomicBool::new(false)));
        let (told, ended) = (known.clone(), stop.clone());
        let play = move || {
            let result = engine.run(None, |stage, pulse| {
                let mut known = lock(&told);
                known.look(stage);
                known.lost = pulse.lost;
                known.wrong = match &pulse.state {
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
        Ok(Self { shadow, drive, known, stop, thread: Some(thread), block, heard })
    }

    /// Lets the shadow go on by a block of what was driven; `None` if there is none yet.
    pub fn step(&mut self) -> Result<Option<&[f32]>, DeviceError> {
        let Ok(chunk) = self.drive.read_chunk(self.block.len()) else { return Ok(None) };
        self.block.iter_mut().zip(chunk).for_each(|(to, x)| *to = x);
        self.shadow.exchange(&self.block, &mut self.heard)?;
        Ok(Some(&self.block))
    }
}

impl Drop for Away {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // It has said already what went wrong.
            let _ = thread.join();
        }
    }
}

impl Playback {
    /// The state of the play now.
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

    /// Fingers, by number.
    pub fn fingers(&mut self) -> Vec<(u64, Point)> {
        match self {
            Self::Here(engine) => engine.stage().fingers(),
            Self::Away(away) => lock(&away.known).fingers.clone(),
        }
    }
}

/// A block of a surface that is stepped here.
///
/// # Errors
/// Those of [`Engine::step`].
pub fn step(engine: &mut Engine) -> Result<&[f32], LiveError> {
    engine.step()?;
    Ok(engine.heart().drive())
}

/// A device whose drive is passed on as it plays; what finds no room is lost to the picture alone.
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
