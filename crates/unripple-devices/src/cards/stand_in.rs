//! A simulated card for tests, with a separate clock for each side. Time passes only while the program waits
//! for the card.

use super::crossing::{Events, Player, Recorder, crossing};
use super::device::blocks_ahead;
use super::ferry::{Ferry, Manners};
use super::streams::Streams;
use std::sync::{Arc, Mutex};
use std::time::Duration;
use unripple_core::Layout;

/// Samples per block that the program exchanges.
pub(super) const BLOCK: usize = 64;
/// Frames from an output of the card to its input, on the way through the air. An odd number, so that no multiple of
/// a block hides an error of counting.
pub(super) const AIR: usize = 77;
/// Samples per second at the nominal rate.
pub(super) const RATE: f64 = 48e3;

/// Clock and chunk sizes of one side. Times are in frames at the nominal rate since the card was opened.
#[derive(Clone, Debug)]
pub(super) struct Clock {
    /// Rate of the clock over the nominal rate.
    pub(super) pace: f64,
    /// Time at which the converter starts.
    pub(super) begins: f64,
    /// Start and end of the time in which the clock stands still.
    pub(super) stop: [f64; 2],
    /// Numbers of frames in successive callbacks of this side, taken in turn.
    pub(super) chunks: Vec<usize>,
}

impl Clock {
    pub(super) fn nominal(chunks: &[usize]) -> Self {
        Self { pace: 1.0, begins: 0.0, stop: [f64::INFINITY; 2], chunks: chunks.to_vec() }
    }

    pub(super) fn largest(&self) -> usize {
        self.chunks.iter().copied().max().unwrap()
    }

    /// The time at which `frames` frames have passed the converter.
    fn when(&self, frames: f64) -> f64 {
        let time = self.begins + frames / self.pace;
        if time > self.stop[0] { time + (self.stop[1] - self.stop[0]) } else { time }
    }

    /// Number of frames that have passed the converter at a time.
    fn frames(&self, time: f64) -> f64 {
        let stood = (time.min(self.stop[1]) - self.stop[0]).max(0.0);
        (time - self.begins - stood) * self.pace
    }
}

/// The simulated card: it records what it plays, [`AIR`] frames later.
pub(super) struct StandIn {
    player: Player,
    recorder: Recorder,
    pub(super) plays: Clock,
    pub(super) records: Clock,
    pub(super) now: f64,
    /// Every frame that the card was given to play.
    pub(super) played: Vec<[f32; 2]>,
    recorded: usize,
    calls: [usize; 2],
}

/// The program's handle on the simulated card.
#[derive(Clone)]
pub(super) struct Held(pub(super) Arc<Mutex<StandIn>>);

impl Held {
    /// Opens a simulated card, with drive `ahead` blocks ahead, or as many as a card of its periods needs.
    pub(super) fn open(plays: Clock, records: Clock, strict: bool, ahead: Option<usize>) -> (Self, Ferry) {
        let events = Arc::new(Events::default());
        let (player, recorder, shore) = crossing(2, 2, 65_536, &events);
        let names = || vec!["a".to_owned(), "b".to_owned()];
        let layout = Layout {
            device: "stand-in".into(),
            rate: RATE,
            block: BLOCK,
            outputs: names(),
            inputs: names(),
            full_scale: 1.0,
        };
        let period = plays.largest().max(records.largest());
        let ahead = ahead.unwrap_or_else(|| blocks_ahead(1, BLOCK, period, 65_536));
        let manners = Manners { lead: ahead as u64, patience: Duration::from_secs(3), strict };
        let (played, recorded, calls) = (Vec::new(), 0, [0; 2]);
        let card = StandIn { player, recorder, plays, records, now: 0.0, played, recorded, calls };
        let held = Self(Arc::new(Mutex::new(card)));
        let ferry = Ferry::new(layout, (shore, events), Box::new(held.clone()), manners);
        (held, ferry)
    }
}

impl StandIn {
    /// When each side is called next: to play once there is room in a buffer of two chunks, to record once a chunk is full.
    fn due(&self) -> [f64; 2] {
        let next = |clock: &Clock, calls: usize| clock.chunks[calls % clock.chunks.len()];
        let given = self.played.len() + next(&self.plays, self.calls[0]);
        let room = 2 * self.plays.largest();
        let play = if given <= room { self.now } else { self.plays.when((given - room) as f64) };
        let full = self.recorded + next(&self.records, self.calls[1]);
        [play, self.records.when(full as f64)]
    }

    fn play(&mut self) {
        let chunk = self.plays.chunks[self.calls[0] % self.plays.chunks.len()];
        let start = self.played.len();
        self.played.resize(start + chunk, [9.0; 2]);
        let played = &mut self.played;
        self.player.play(chunk, |frame, output, x| played[start + frame][output] = x);
        self.calls[0] += 1;
    }

    fn record(&mut self) {
        let chunk = self.records.chunks[self.calls[1] % self.records.chunks.len()];
        let (start, records, plays, played) = (self.recorded, &self.records, &self.plays, &self.played);
        self.recorder.hear(chunk, |frame, input| {
            // The middle of the sample, so that no rounding decides which one it is.
            let left = plays.frames(records.when((start + frame) as f64) + 0.5).floor() - AIR as f64;
            if left < 0.0 { 0.0 } else { played.get(left as usize).map_or(0.0, |frame| frame[input]) }
        });
        self.recorded += chunk;
        self.calls[1] += 1;
    }
}

impl Streams for Held {
    fn wait(&mut self, at_most: Duration) -> Duration {
        let mut card = self.0.lock().unwrap();
        let limit = card.now + at_most.as_secs_f64() * RATE;
        let [play, record] = card.due();
        let next = play.min(record);
        if next > limit {
            card.now = limit;
            return at_most;
        }
        let passed = (next - card.now).max(0.0);
        card.now += passed;
        if play <= record {
            card.play()
        } else {
            card.record()
        }
        Duration::from_secs_f64(passed / RATE)
    }
}
