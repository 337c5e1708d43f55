//! The program's side of a card: blocks exchanged with the threads that play and record, or with a stand-in for them.

use super::crossing::{Events, Shore};
use super::side::Side;
use super::streams::Streams;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;
use unripple_core::{Device, DeviceError, Layout, State, Status};

/// Number of successive blocks that were recorded too late for playback to wait, after which the counter of
/// recording is set to that of playback: a single late callback does not reach it.
const LATE: u32 = 8;

/// Settings for waiting for a card.
#[derive(Clone, Copy, Debug)]
pub(super) struct Manners {
    /// Number of blocks by which the drive is ahead.
    pub(super) lead: u64,
    /// Time after which the card counts as stalled if playback or recording has made no progress.
    pub(super) patience: Duration,
    /// Whether a card counts as lost after an underrun or overrun, or if its sides do not stay in step,
    /// since its latency has changed. If false, playing continues, and does not wait for recordings that
    /// come too late.
    pub(super) strict: bool,
}

/// Exchanges blocks with a card's two threads.
///
/// The answer to frame `i` of drive is the frame that was recorded when the former was handed to the card,
/// so that latency does not change if frames were missed in between: silence that was played since drive was
/// missing, or recorded frames that the program did not read.
pub(super) struct Ferry {
    layout: Layout,
    shore: Shore,
    events: Arc<Events>,
    streams: Box<dyn Streams>,
    manners: Manners,
    /// Number of chunks of each side at the last check, and the time without new ones since then.
    seen: [u32; 2],
    quiet: [Duration; 2],
    driven: u64,
    /// Number of blocks whose answer did not arrive in time.
    owed: u64,
    /// The block that is being recorded: its frames so far, when its next frame was played, and frames missed.
    frames: Vec<f32>,
    next: Option<u32>,
    missed: u64,
    /// Whether some frames were not waited for, and in how many blocks in a row.
    hurried: bool,
    late: u32,
    last: Option<u32>,
    xruns: u64,
    sent: Vec<f32>,
    status: Status,
}

impl Ferry {
    pub(super) fn new(
        layout: Layout,
        (shore, events): (Shore, Arc<Events>),
        streams: Box<dyn Streams>,
        manners: Manners,
    ) -> Self {
        let (block, outputs, inputs) = (layout.block, layout.outputs.len(), layout.inputs.len());
        Self {
            frames: Vec::with_capacity(block * inputs),
            sent: Vec::with_capacity(block * outputs),
            layout,
            shore,
            events,
            streams,
            manners,
            seen: [0; 2],
            quiet: [Duration::ZERO; 2],
            driven: 0,
            owed: 0,
            next: None,
            missed: 0,
            hurried: false,
            late: 0,
            last: None,
            xruns: 0,
            status: Status::default(),
        }
    }

    fn stall(&mut self, why: String) -> DeviceError {
        self.status.state = State::Stalled(why.clone());
        DeviceError::Stalled { device: self.layout.device.clone(), why }
    }

    fn lose(&mut self, why: String) -> DeviceError {
        self.status.state = State::Lost(why.clone());
        DeviceError::Lost { device: self.layout.device.clone(), why }
    }

    fn push(&mut self, drive: &[f32]) -> Result<(), DeviceError> {
        let (block, outputs) = (self.layout.block, self.layout.outputs.len());
        self.sent.clear();
        for frame in 0..block {
            self.sent.extend((0..outputs).map(|output| drive[output * block + frame]));
        }
        match self.shore.drive.write_chunk_uninit(self.sent.len()) {
            Ok(chunk) => {
                chunk.fill_from_iter(self.sent.iter().copied());
                Ok(())
            }
            Err(_) => Err(self.stall("the card takes no drive".into())),
        }
    }

    /// Returns an error if the card is gone, or counts as gone.
    fn alive(&mut self) -> Result<(), DeviceError> {
        let strict = self.manners.strict;
        if let Some(why) = strict.then(|| self.events.counts.apart()).flatten() {
            self.events.lose(why);
        }
        self.events.why_gone().map_or(Ok(()), |why| Err(self.lose(why)))
    }

    /// Waits until a side may have processed a chunk; returns an error if the card is gone or a side has
    /// stalled.
    fn wait(&mut self) -> Result<(), DeviceError> {
        self.alive()?;
        let sides = if self.layout.inputs.is_empty() { 1 } else { 2 };
        let patience = self.manners.patience;
        for side in &[Side::Playback, Side::Capture][..sides] {
            let (n, chunks) = (*side as usize, self.events.counts.chunks(*side));
            if chunks != self.seen[n] {
                (self.seen[n], self.quiet[n]) = (chunks, Duration::ZERO);
            }
            if self.quiet[n] >= patience {
                self.quiet = [Duration::ZERO; 2];
                let (did, time) = (side.did(), patience.as_secs_f64());
                let why = match chunks {
                    0 => format!("it has {did} nothing yet, waited for {time} s"),
                    _ => format!("it has {did} nothing for {time} s"),
                };
                return Err(self.stall(why));
            }
        }
        let left = self.quiet[..sides].iter().map(|quiet| patience - *quiet).min().unwrap_or(patience);
        let waited = self.streams.wait(left);
        self.quiet.iter_mut().for_each(|quiet| *quiet += waited);
        Ok(())
    }

    /// Whether waiting any longer would leave playback without drive, if playing has priority over recording
    /// (not strict).
    fn starves(&self) -> bool {
        let waiting = self.shore.drive.buffer().capacity() - self.shore.drive.slots();
        let next = self.events.counts.largest(Side::Playback) * self.layout.outputs.len();
        !self.manners.strict && waiting < next
    }

    /// Waits for one recorded block and reads it. If that takes too long, the frames that have arrived are
    /// stored for the next call.
    fn pop(&mut self, heard: &mut [f32]) -> Result<(), DeviceError> {
        let (block, inputs) = (self.layout.block, self.layout.inputs.len());
        while self.frames.len() < block * inputs.max(1) {
            let Some(played) = self.next.or_else(|| self.shore.when.pop().ok()) else {
                self.wait()?;
                continue;
            };
            if self.next.is_none() {
                let gap = self.last.map_or(0, |last| played.wrapping_sub(last).wrapping_sub(1));
                self.missed += u64::from(gap);
                (self.next, self.last) = (Some(played), Some(played));
            }
            while !self.frame(played) {
                if self.starves() {
                    self.frames.extend(std::iter::repeat_n(0.0, inputs));
                    self.missed += 1;
                    self.hurried = true;
                    break;
                }
                self.wait()?;
            }
            self.next = None;
        }
        for (input, plane) in heard.chunks_exact_mut(block).enumerate() {
            let samples = self.frames.iter().skip(input).step_by(inputs);
            plane.iter_mut().zip(samples).for_each(|(to, x)| *to = *x);
        }
        self.frames.clear();
        self.status.lost += self.missed.div_ceil(block as u64);
        self.missed = 0;
        self.late = if std::mem::take(&mut self.hurried) { self.late + 1 } else { 0 };
        if self.late == LATE {
            self.events.counts.catch_up();
            self.late = 0;
        }
        Ok(())
    }

    /// Reads the frame recorded at some time, if it has arrived; returns `false` if it has to be waited for.
    fn frame(&mut self, played: u32) -> bool {
        let inputs = self.layout.inputs.len();
        if inputs == 0 {
            self.frames.push(0.0);
            return true;
        }
        loop {
            let Ok(chunk) = self.shore.heard.read_chunk(inputs + 1) else { return false };
            let (first, second) = chunk.as_slices();
            let bits = || first.iter().chain(second).copied();
            let ahead = bits().next_back().unwrap_or_default().wrapping_sub(played) as i32;
            if ahead > 0 {
                // It was dropped; this one is for a later frame.
                self.frames.extend(std::iter::repeat_n(0.0, inputs));
                self.missed += 1;
                return true;
            }
            if ahead == 0 {
                self.frames.extend(bits().take(inputs).map(f32::from_bits));
            }
            chunk.commit_all();
            if ahead == 0 {
                return true;
            }
        }
    }
}

impl Device for Ferry {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn status(&self) -> Status {
        let mut status = self.status.clone();
        if let Some(why) = self.events.why_gone() {
            status.state = State::Lost(why);
        }
        // Samples ahead in the ring buffer, and then in the card.
        let period = self.events.counts.largest(Side::Playback);
        status.waiting = self.manners.lead * self.layout.block as u64 + period as u64;
        status
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        self.layout.fits(drive.len(), heard.len())?;
        let xruns = self.events.xruns.load(Ordering::Relaxed);
        let more = xruns - self.xruns;
        (self.xruns, self.status.lost) = (xruns, self.status.lost + more);
        if more > 0 && self.manners.strict && self.driven > 0 {
            let why = "the card ran out of samples, and its latency is no longer what it was; open it again, with \
                       larger blocks if that happens often";
            self.events.lose(why.into());
        }
        self.alive()?;
        // Answers that came too late once are discarded, so that latency does not change.
        while self.owed > 0 {
            self.pop(heard)?;
            self.owed -= 1;
        }
        self.push(drive)?;
        self.driven += 1;
        if self.driven <= self.manners.lead {
            heard.fill(0.0);
        } else if let Err(error) = self.pop(heard) {
            self.owed += 1;
            return Err(error);
        }
        self.status.blocks += 1;
        self.status.state = State::Running;
        Ok(())
    }
}
