//! Samples and events between a program and the two threads of a card, one that plays and one that records.

use super::bell::Bell;
use super::counts::Counts;
use super::side::Side;
use rtrb::{Consumer, Producer, RingBuffer};
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, Mutex};

/// Events of a card, as its two threads report them.
#[derive(Debug, Default)]
pub(super) struct Events {
    /// Frame counters of the two sides, which begin when the card begins to play.
    pub(super) counts: Counts,
    /// Wakes the program whenever a side has processed a chunk, or the card is gone.
    pub(super) bell: Bell,
    /// Number of underruns and overruns that the card reported.
    pub(super) xruns: AtomicU64,
    /// The reason why the card is gone; `None` while it is there.
    pub(super) gone: Mutex<Option<String>>,
}

impl Events {
    /// The reason why the card is gone; `None` while it is there.
    pub(super) fn why_gone(&self) -> Option<String> {
        self.gone.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).clone()
    }

    /// Marks the card as gone; the first reason stays.
    pub(super) fn lose(&self, why: String) {
        self.gone.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).get_or_insert(why);
        self.bell.ring();
    }
}

/// The end of the ring buffers in the thread that plays. It neither waits nor allocates: if drive is late,
/// it plays silence.
pub(super) struct Player {
    outputs: usize,
    drive: Consumer<f32>,
    /// When each frame of drive was played, in frames since the card began, modulo 2^32.
    when: Producer<u32>,
    at: u32,
    events: Arc<Events>,
}

/// The end of the ring buffers in the thread that records. It neither waits nor allocates: samples that the
/// program does not read are dropped.
pub(super) struct Recorder {
    inputs: usize,
    heard: Producer<u32>,
    at: u32,
    events: Arc<Events>,
}

/// The end of the ring buffers in the program: drive, the times at which it was played, and recorded frames.
pub(super) struct Shore {
    pub(super) drive: Producer<f32>,
    pub(super) when: Consumer<u32>,
    /// Recorded frames, as bits: a sample of each input, and the frame's number since the card began.
    pub(super) heard: Consumer<u32>,
}

/// The ends of player, recorder and program, with rings for `frames` frames.
pub(super) fn crossing(
    outputs: usize,
    inputs: usize,
    frames: usize,
    events: &Arc<Events>,
) -> (Player, Recorder, Shore) {
    let (drive, take) = RingBuffer::new(frames * outputs);
    let (tell, when) = RingBuffer::new(frames);
    let (give, heard) = RingBuffer::new(frames * (inputs + 1));
    let player = Player { outputs, drive: take, when: tell, at: 0, events: events.clone() };
    let recorder = Recorder { inputs, heard: give, at: 0, events: events.clone() };
    (player, recorder, Shore { drive, when, heard })
}

impl Player {
    /// Sets the frame counter to another number, as after a long time.
    #[cfg(test)]
    pub(super) fn begin_at(&mut self, at: u32) {
        self.at = at;
    }

    /// Plays `frames` frames: `put` is called with each frame's number in the chunk, an output and its
    /// sample.
    pub(super) fn play(&mut self, frames: usize, mut put: impl FnMut(usize, usize, f32)) {
        self.at = self.events.counts.next(Side::Playback, self.at, frames);
        let outputs = self.outputs.max(1);
        let ready = (self.drive.slots() / outputs).min(self.when.slots()).min(frames);
        let chunks = (self.drive.read_chunk(ready * outputs), self.when.write_chunk_uninit(ready));
        let mut played = 0;
        if let (Ok(drive), Ok(when)) = chunks {
            drive.into_iter().enumerate().for_each(|(i, x)| put(i / outputs, i % outputs, x));
            when.fill_from_iter((0..ready as u32).map(|i| self.at.wrapping_add(i)));
            played = ready;
        }
        (played..frames).for_each(|frame| (0..outputs).for_each(|output| put(frame, output, 0.0)));
        self.at = self.at.wrapping_add(frames as u32);
        self.events.counts.passed(Side::Playback, self.at);
        self.events.bell.ring();
    }
}

impl Recorder {
    /// Sets the frame counter to another number, as [`Player::begin_at`] does.
    #[cfg(test)]
    pub(super) fn begin_at(&mut self, at: u32) {
        self.at = at;
    }

    /// Records `frames` frames: `get` returns the sample of a frame and an input. Frames before the first
    /// played one are ignored.
    pub(super) fn hear(&mut self, frames: usize, get: impl Fn(usize, usize) -> f32) {
        if self.events.counts.chunks(Side::Playback) == 0 {
            return;
        }
        self.at = self.events.counts.next(Side::Capture, self.at, frames);
        let (inputs, width) = (self.inputs, self.inputs + 1);
        let room = (self.heard.slots() / width).min(frames);
        if let Ok(chunk) = self.heard.write_chunk_uninit(room * width) {
            let at = self.at;
            chunk.fill_from_iter((0..room * width).map(|i| match (i / width, i % width) {
                (frame, input) if input == inputs => at.wrapping_add(frame as u32),
                (frame, input) => get(frame, input).to_bits(),
            }));
        }
        self.at = self.at.wrapping_add(frames as u32);
        self.events.counts.passed(Side::Capture, self.at);
        self.events.bell.ring();
    }
}
