//! Live play on several threads: what each waits for, and which wakes which.

use crate::heartbeat::Overheard;
use crate::touch_input::{TouchBatch, TouchInput};
use crate::{Engine, FocusWorker, Follower, Heartbeat, LiveError, Priorities, Stage, Timeline, priority};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::TryRecvError;
use std::sync::{Mutex, mpsc};
use std::thread::Thread;
use std::time::Duration;
use unripple_calibrate::Drift;
use unripple_core::clock::Instant;
use unripple_core::{DeviceError, State};

/// Interval at which the conductor runs while anything sounds or waits, in s of the device's clock. Twice as long
/// delays commands by as much, half as long wakes the thread twice as often.
const PACE: f64 = 0.0025;

/// Interval at which the caller gets a report: five times a second, as fast as figures can be read.
const TELL: Duration = Duration::from_millis(200);

/// Cycles ahead that commands are given, and the least time ahead in s: what is due later may still be taken back.
const AHEAD: u64 = 2;
const LEAST_AHEAD: f64 = 0.005;

/// Blocks that may wait between the audio thread and the follower of tension, and how often they are fetched. Further
/// ones are lost to the follower only.
const KEPT: usize = 64;
const FETCH: Duration = Duration::from_millis(20);

/// Duration of the fade at the end, in s, and how long it is waited for, should the device stand still.
const FADE: f64 = 0.02;
const PATIENCE: Duration = Duration::from_secs(1);

/// State of the device and its audio thread, as [`Engine::run`] hands it to its caller while it plays.
#[derive(Clone, Debug, Default)]
pub struct PlayState {
    /// State of the device.
    pub state: State,
    /// Number of blocks that the device has lost so far.
    pub lost: u64,
    /// Real-time priority that the audio thread was granted, or the reason why it was granted none, in
    /// words.
    pub priority: String,
}

/// State that the threads of a play share.
struct Shared<'a> {
    stop: AtomicBool,
    state: Mutex<PlayState>,
    /// Whether a finger is on the sheet.
    touched: AtomicBool,
    timeline: &'a Timeline,
    /// The thread that turns touches into commands, to be woken.
    bell: Thread,
    priorities: Priorities,
}

impl<'a> Shared<'a> {
    /// State at the beginning of play, with this thread to be woken.
    fn new(timeline: &'a Timeline, priorities: Priorities) -> Self {
        Self {
            stop: AtomicBool::new(false),
            state: Mutex::default(),
            touched: AtomicBool::new(false),
            timeline,
            bell: std::thread::current(),
            priorities,
        }
    }

    fn goes_on(&self) -> bool {
        !self.stop.load(Ordering::Relaxed)
    }
}

/// The queues into the thread that turns touches into commands.
struct Mail {
    batches: mpsc::Receiver<TouchBatch>,
    failures: mpsc::Receiver<DeviceError>,
    finds: mpsc::Receiver<Found>,
}

impl Engine {
    /// Plays for `seconds` of the device's clock, or without end if `None`, until `tell` returns false. `tell` is
    /// called five times a second. Finally everything fades out, and the engine plays nothing more.
    ///
    /// The player runs on the device's own thread if the device [calls](unripple_core::Device::install_work), or else on a
    /// thread that exchanges blocks with it. Another thread receives touches and records when they come. The calling
    /// thread turns them into commands. All threads sleep until there is something for them to do.
    ///
    /// # Errors
    /// Those of the device once it is lost for good; [`LiveError::Gone`] if a thread ended early. Unless the device
    /// is lost, everything fades out before.
    ///
    /// # Panics
    /// If `tell` or a source of touches panics; everything fades out before.
    pub fn run(
        &mut self,
        seconds: Option<f64>,
        mut tell: impl FnMut(&mut Stage, &PlayState) -> bool,
    ) -> Result<(), LiveError> {
        let Self { stage, heart, touch_input, .. } = self;
        let layout = heart.device().layout();
        let (channels, block) = ([layout.outputs.len(), layout.inputs.len()], stage.block);
        let priorities = Priorities::of(heart.device());
        let timeline = heart.timeline().clone();
        let shared = Shared::new(&timeline, priorities);
        let samples = channels.iter().sum::<usize>() * block;
        let (blocks, fetched) = rtrb::RingBuffer::new(KEPT * samples.max(1));
        let mut follower = stage.follower.take();
        let overheard = follower.is_some().then(|| Overheard::new(blocks, channels, block));
        let ((failed, failures), (found, finds), (told, batches)) =
            (mpsc::channel(), mpsc::channel(), mpsc::channel());
        let mail = Mail { batches, failures, finds };
        stage.conductor.request_realtime(priorities.beside);
        stage.conductor.count_by(timeline.clone());
        let (lent, overheard) = heart.lend(shared.bell.clone(), overheard);
        let scope = || {
            std::thread::scope(|scope| {
                let shared = &shared;
                let spawn = |name: &str| std::thread::Builder::new().name(name.into());
                let gone = |error: std::io::Error| LiveError::Gone { why: error.to_string() };
                let audio = spawn("audio").spawn_scoped(scope, move || match lent {
                    true => mind(heart, shared, &failed),
                    false => beat(heart, shared, overheard, &failed),
                });
                let audio = audio.map_err(gone)?;
                let listen = spawn("touch").spawn_scoped(scope, move || listen(touch_input, shared, &told));
                let followed = follower.as_mut().map(|follower| {
                    let heard = Fetched { blocks: fetched, drive: channels[0] * block, samples, block };
                    spawn("drift").spawn_scoped(scope, move || follow(follower, heard, shared, &found))
                });
                let result = match listen.and(followed.transpose()) {
                    Ok(_) => stage.attend_and_fade(shared, |stage| {
                        stage.attend(seconds, shared, &mail, |stage| {
                            let state = shared.state.lock().map(|state| state.clone()).unwrap_or_default();
                            tell(stage, &state)
                        })
                    }),
                    Err(error) => Ok(Err(gone(error))),
                };
                shared.stop.store(true, Ordering::Relaxed);
                audio.thread().unpark();
                // The other threads are waited for before this one unwinds.
                result.unwrap_or_else(|panic| resume_unwind(panic))
            })
        };
        let result = catch_unwind(AssertUnwindSafe(scope));
        self.heart.regain();
        self.stage.follower = follower;
        self.stage.clock = self.stage.conductor.desk().clock();
        self.stage.counts = self.touch_input.counts();
        result.unwrap_or_else(|panic| resume_unwind(panic))
    }
}

/// Blocks on their way from the audio thread to the follower of tension.
struct Fetched {
    blocks: rtrb::Consumer<f32>,
    /// Samples in a block: of drive, of drive and inputs, and per channel.
    drive: usize,
    samples: usize,
    block: usize,
}

/// The result of an observation: the drift of tension, and a maker of drives for the sheet as it is, if it has
/// changed.
type Found = Result<(Drift, Option<FocusWorker>), LiveError>;

/// The thread that follows tension: its computations are too long for the thread that receives touches.
fn follow(follower: &mut Follower, mut heard: Fetched, shared: &Shared, found: &mpsc::Sender<Found>) {
    let mut block = Vec::with_capacity(heard.samples);
    while shared.goes_on() {
        while let Ok(chunk) = heard.blocks.read_chunk(heard.samples) {
            block.clear();
            block.extend(chunk);
            let (drive, inputs) = block.split_at(heard.drive);
            follower.take(drive, inputs, heard.block, shared.touched.load(Ordering::Relaxed));
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
        if news {
            shared.bell.unpark();
        }
        std::thread::sleep(FETCH);
    }
}

/// The thread that receives touches: their times are recorded when they come, whatever is computed meanwhile.
fn listen(touch_input: &mut TouchInput, shared: &Shared, told: &mpsc::Sender<TouchBatch>) {
    // Touches have priority over everything but the audio thread.
    let _ = priority::at(shared.priorities.touch);
    let mut now = 0.0f64;
    while shared.goes_on() {
        let at = Instant::now();
        // A device that stood still goes on from an earlier sample than touches were timed by meanwhile; time does not go back for them.
        now = shared.timeline.at(at).max(now);
        let batch = touch_input.poll(now);
        if batch.any() {
            shared.timeline.note(now, at);
            if told.send(batch).is_err() {
                return;
            }
            shared.bell.unpark();
        }
        touch_input.wait(now);
    }
}

impl Stage {
    /// The calling thread's loop: cues, drives and drift, as touches require.
    fn attend(
        &mut self,
        seconds: Option<f64>,
        shared: &Shared,
        mail: &Mail,
        mut tell: impl FnMut(&mut Self) -> bool,
    ) -> Result<(), LiveError> {
        let end = seconds.map(|seconds| self.clock + (seconds * self.rate) as u64);
        let mut told = Instant::now();
        let _ = priority::at(shared.priorities.beside);
        loop {
            match mail.failures.try_recv() {
                Ok(error) => return Err(error.into()),
                Err(TryRecvError::Disconnected) => return Err(early("audio")),
                Err(TryRecvError::Empty) => {}
            }
            self.clock = self.conductor.desk().clock();
            if end.is_some_and(|end| self.clock >= end) {
                return Ok(());
            }
            loop {
                match mail.batches.try_recv() {
                    Ok(batch) => self.take(batch)?,
                    Err(TryRecvError::Disconnected) => return Err(early("touch")),
                    Err(TryRecvError::Empty) => break,
                }
            }
            shared.touched.store(!self.fingers.is_empty(), Ordering::Relaxed);
            self.conduct(self.clock, self.until(shared.timeline))?;
            while let Ok(found) = mail.finds.try_recv() {
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
            let due = self.due(shared.timeline).min(end.unwrap_or(u64::MAX));
            shared.timeline.wake_at(due);
            if self.conductor.desk().clock() < due {
                std::thread::park_timeout(TELL.saturating_sub(told.elapsed()));
            }
        }
    }

    /// Runs `attend` until it ends, well or badly, and fades everything out, so that no sound goes on without
    /// control.
    fn attend_and_fade(
        &mut self,
        shared: &Shared,
        attend: impl FnOnce(&mut Self) -> Result<(), LiveError>,
    ) -> std::thread::Result<Result<(), LiveError>> {
        let ended = catch_unwind(AssertUnwindSafe(|| attend(self)));
        if matches!(ended, Ok(Err(LiveError::Device(_)))) {
            // A device that is lost plays nothing more.
            return ended;
        }
        self.fade_out(shared);
        match ended {
            // The player's last reports are read.
            Ok(Ok(())) => catch_unwind(AssertUnwindSafe(|| self.conduct(self.clock, self.clock))),
            ended => ended,
        }
    }

    /// Ends playing, and waits until the last samples have left the device.
    fn fade_out(&mut self, shared: &Shared) {
        self.conductor.end(FADE);
        let start = Instant::now();
        while !self.conductor.is_over() && start.elapsed() < PATIENCE {
            shared.timeline.wake_at(self.conductor.desk().clock() + 1);
            std::thread::park_timeout(PATIENCE.saturating_sub(start.elapsed()));
        }
        let leaves = shared.timeline.leaves(self.conductor.desk().clock());
        std::thread::sleep(leaves.saturating_duration_since(Instant::now()).min(PATIENCE));
    }

    /// The sample up to which commands are given now.
    fn until(&self, timeline: &Timeline) -> u64 {
        let cycles = AHEAD * timeline.period() as u64 + (PACE * self.rate) as u64;
        self.clock + cycles.max((LEAST_AHEAD * self.rate) as u64)
    }

    /// The sample at which there will be something to do if no touch comes before.
    fn due(&self, timeline: &Timeline) -> u64 {
        // What there was no time for is continued at once.
        if self.conductor.is_behind(self.until(timeline)) {
            return self.clock;
        }
        if self.feeler.is_some() || !self.conductor.rests() {
            return self.clock + (PACE * self.rate) as u64;
        }
        self.pinging.as_ref().map_or(u64::MAX, |pinging| pinging.due(self.clock))
    }
}

fn early(thread: &str) -> LiveError {
    LiveError::Gone { why: format!("the thread `{thread}` ended early") }
}

/// The audio thread for a device that calls the player by itself: it looks after the device.
fn mind(heart: &mut Heartbeat, shared: &Shared, failed: &mpsc::Sender<DeviceError>) {
    if let Ok(mut play_state) = shared.state.lock() {
        play_state.priority = shared.priorities.called();
    }
    while shared.goes_on() {
        match heart.device_mut().check() {
            Ok(wait) => {
                tell(heart, shared);
                std::thread::park_timeout(wait);
            }
            Err(error) => return fail(error, shared, failed),
        }
    }
}

/// The audio thread for a device that does not call the player: it exchanges blocks.
fn beat(
    heart: &mut Heartbeat,
    shared: &Shared,
    mut overheard: Option<Overheard>,
    failed: &mpsc::Sender<DeviceError>,
) {
    let priority = priority::at(shared.priorities.audio).unwrap_or_else(|refused| refused);
    if let Ok(mut play_state) = shared.state.lock() {
        play_state.priority = priority;
    }
    while shared.goes_on() {
        if let Err(error) = heart.beat() {
            return fail(error, shared, failed);
        }
        if let Some(overheard) = &mut overheard {
            overheard.put(heart.drive(), heart.heard());
        }
        tell(heart, shared);
    }
}

fn tell(heart: &Heartbeat, shared: &Shared) {
    // Never waited for: whoever reads holds it for moments only.
    if let Ok(mut play_state) = shared.state.try_lock() {
        let status = heart.device().status();
        (play_state.state, play_state.lost) = (status.state, status.lost);
    }
}

fn fail(error: DeviceError, shared: &Shared, failed: &mpsc::Sender<DeviceError>) {
    // The thread that receives it stops play.
    let _ = failed.send(error);
    shared.bell.unpark();
}
