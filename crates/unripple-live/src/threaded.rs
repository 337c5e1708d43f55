use crate::{Engine, Follower, Heartbeat, LiveError, Maker, Stage, priority};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, mpsc};
use std::time::{Duration, Instant};
use unripple_calibrate::Drift;
use unripple_core::{DeviceError, State};

/// How often touches are looked for while another thread plays.
const LOOK: Duration = Duration::from_micros(500);

/// How often whoever watches is told.
const TELL: Duration = Duration::from_millis(200);

/// Blocks ahead that commands are given: what is due later may still be taken back.
const AHEAD: u64 = 4;

/// Blocks that may wait between the audio thread and whoever follows what it heard.
const KEPT: usize = 64;

/// What the audio thread says of itself.
#[derive(Clone, Debug, Default)]
pub struct Pulse {
    /// How the device fares.
    pub state: State,
    /// Blocks lost so far.
    pub lost: u64,
    /// What became of the wish for real-time priority.
    pub priority: String,
}

impl Engine {
    /// Plays for so many seconds of the device's clock, or until told to stop, the player and the device on a thread of their own
    /// with real-time priority if that is granted. `tell` is called five times a second; it returns whether to go on.
    ///
    /// Touches are timed by the device's clock and answered in the next block.
    ///
    /// # Errors
    /// Those of the device once it is lost for good; [`LiveError::Gone`] if a thread ended early.
    pub fn run(
        &mut self,
        seconds: Option<f64>,
        mut tell: impl FnMut(&mut Stage, &Pulse) -> bool,
    ) -> Result<(), LiveError> {
        let Self { stage, heart } = self;
        let (stop, pulse) = (AtomicBool::new(false), Mutex::new(Pulse::default()));
        let planes = (heart.drive().len(), heart.heard().len());
        let (blocks, overheard) = rtrb::RingBuffer::new(KEPT * (planes.0 + planes.1).max(1));
        let mut follower = stage.follower.take();
        let blocks = follower.is_some().then_some(blocks);
        let (failed, failures) = mpsc::channel();
        let (found, finds) = mpsc::channel();
        let (block, touched) = (stage.block, AtomicBool::new(false));
        stage.conductor.hurry();
        let result = std::thread::scope(|scope| {
            let audio = std::thread::Builder::new().name("audio".into());
            let spawned = audio.spawn_scoped(scope, || beat(heart, &stop, &pulse, blocks, &failed));
            spawned.map_err(|error| LiveError::Gone { why: error.to_string() })?;
            if let Some(follower) = &mut follower {
                let drift = std::thread::Builder::new().name("drift".into());
                let heard = Overheard { blocks: overheard, planes, block, touched: &touched };
                let spawned = drift.spawn_scoped(scope, || follow(follower, heard, &stop, &found));
                spawned.map_err(|error| LiveError::Gone { why: error.to_string() })?;
            }
            let result = stage.attend(seconds, &failures, &finds, &touched, |stage| {
                let pulse = pulse.lock().map(|pulse| pulse.clone()).unwrap_or_default();
                tell(stage, &pulse)
            });
            stop.store(true, Ordering::Relaxed);
            result
        });
        self.stage.follower = follower;
        self.stage.clock = self.stage.conductor.desk().clock();
        result
    }
}

/// Blocks on their way from the audio thread to whoever follows tension.
struct Overheard<'a> {
    blocks: rtrb::Consumer<f32>,
    /// Samples of drive and of what was heard.
    planes: (usize, usize),
    block: usize,
    /// Whether a finger is on the sheet.
    touched: &'a AtomicBool,
}

/// What following found: how tension fares, and a maker for the surface as it is, if that has changed.
type Found = Result<(Drift, Option<Maker>), LiveError>;

/// The thread that follows tension: what it computes is too long for the one that hears touches.
fn follow(follower: &mut Follower, mut heard: Overheard<'_>, stop: &AtomicBool, found: &mpsc::Sender<Found>) {
    let (drive, inputs) = heard.planes;
    let mut block = Vec::with_capacity(drive + inputs);
    while !stop.load(Ordering::Relaxed) {
        while let Ok(chunk) = heard.blocks.read_chunk(drive + inputs) {
            block.clear();
            block.extend(chunk);
            let (drive, heard_now) = block.split_at(drive);
            follower.take(drive, heard_now, heard.block, heard.touched.load(Ordering::Relaxed));
        }
        let before = follower.observations();
        let maker = follower.observe();
        let news = follower.observations() > before;
        let sent = match (maker, follower.last()) {
            (Ok(maker), Some(drift)) if news => found.send(Ok((*drift, maker))),
            (Err(error), _) => found.send(Err(error)),
            _ => Ok(()),
        };
        if sent.is_err() {
            return;
        }
        std::thread::sleep(LOOK * 10);
    }
}

impl Stage {
    /// This thread's part: touches, cues, drives, drift.
    fn attend(
        &mut self,
        seconds: Option<f64>,
        failures: &mpsc::Receiver<DeviceError>,
        finds: &mpsc::Receiver<Found>,
        touched: &AtomicBool,
        mut tell: impl FnMut(&mut Self) -> bool,
    ) -> Result<(), LiveError> {
        let end = seconds.map(|seconds| self.clock + (seconds * self.rate) as u64);
        let mut told = Instant::now();
        // Touches are worth more than all but the sound itself.
        let _ = priority::beside();
        loop {
            if let Ok(error) = failures.try_recv() {
                return Err(error.into());
            }
            self.clock = self.conductor.desk().clock();
            if end.is_some_and(|end| self.clock >= end) {
                return Ok(());
            }
            self.listen()?;
            touched.store(self.sources.fingers().next().is_some(), Ordering::Relaxed);
            self.conduct(self.clock, self.clock + AHEAD * self.block as u64)?;
            while let Ok(found) = finds.try_recv() {
                let (drift, maker) = found?;
                self.drift = Some(drift);
                if let Some(maker) = maker {
                    self.conductor.renew(maker, self.clock)?;
                }
            }
            if told.elapsed() >= TELL {
                told = Instant::now();
                if !tell(self) {
                    return Ok(());
                }
            }
            std::thread::sleep(LOOK);
        }
    }
}

/// The audio thread.
fn beat(
    heart: &mut Heartbeat,
    stop: &AtomicBool,
    pulse: &Mutex<Pulse>,
    mut blocks: Option<rtrb::Producer<f32>>,
    failed: &mpsc::Sender<DeviceError>,
) {
    let priority = priority::ask();
    if let Ok(mut pulse) = pulse.lock() {
        pulse.priority = priority;
    }
    while !stop.load(Ordering::Relaxed) {
        if let Err(error) = heart.beat() {
            // Whoever hears of it stops.
            let _ = failed.send(error);
            break;
        }
        if let Some(blocks) = &mut blocks {
            // What finds no room is lost to the follower alone.
            let parts = heart.drive().iter().chain(heart.heard());
            if blocks.slots() >= heart.drive().len() + heart.heard().len() {
                parts.for_each(|x| blocks.push(*x).unwrap_or(()));
            }
        }
        // Never waited for: whoever reads holds it for moments only.
        if let Ok(mut pulse) = pulse.try_lock() {
            let status = heart.device().status();
            (pulse.state, pulse.lost) = (status.state, status.lost);
        }
    }
}
