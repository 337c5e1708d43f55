//! Counters and meters of a player, readable from any thread.

use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering::Relaxed};

/// Counters and meters of a player, which any thread can read at any time.
#[derive(Debug)]
pub struct Meters {
    clock: AtomicU64,
    silent: AtomicBool,
    load: AtomicU32,
    wave_gain: AtomicU32,
    peaks: Vec<AtomicU32>,
    heats: Vec<AtomicU32>,
    counts: [AtomicU64; COUNTS],
}

/// Number of things counted: one per variant of [`Count`].
const COUNTS: usize = 9;

/// Kinds of events that are counted from the start of the player.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Copies of drives and waveforms that were started.
    Started,
    /// Copies of drives that were scaled down to stay within a limit.
    Limited,
    /// Blocks in which the gain of waveforms was reduced by a limit.
    WavesLimited,
    /// Commands and starts that acted later than requested.
    Late,
    /// Starts that were postponed to a later block because the work allowed in their block was used up.
    PutOff,
    /// Commands that were refused.
    Refused,
    /// Reports that were lost because the ring to the desk was full.
    ReportsLost,
    /// Commands that were not sent because the ring to the player was full.
    CommandsLost,
    /// Calls of [`Player::process`](crate::Player::process) with a slice of a wrong size.
    Misfits,
}

impl Meters {
    /// Nothing counted yet, of a number of outputs.
    pub(crate) fn new(outputs: usize) -> Self {
        Self {
            clock: AtomicU64::new(0),
            silent: AtomicBool::new(true),
            load: AtomicU32::new(0),
            wave_gain: AtomicU32::new(1f32.to_bits()),
            peaks: (0..outputs).map(|_| AtomicU32::new(0)).collect(),
            heats: (0..outputs).map(|_| AtomicU32::new(0)).collect(),
            counts: Default::default(),
        }
    }

    /// Index of the first sample of the next block, on the player's clock.
    pub fn clock(&self) -> u64 {
        self.clock.load(Relaxed)
    }

    /// Whether the last block was silent and no sound is due: no drive is playing, repeating or waiting, and
    /// the responses to waveforms have ended.
    pub fn is_silent(&self) -> bool {
        self.silent.load(Relaxed)
    }

    /// Time that the last block took to compute over the duration of a block, a ratio, as set with
    /// [`Meters::set_load`].
    pub fn load(&self) -> f32 {
        f32::from_bits(self.load.load(Relaxed))
    }

    /// Sets the load: the time that a block took to compute over its duration, a ratio. Called by the thread that runs
    /// the player.
    pub fn set_load(&self, share: f32) {
        self.load.store(share.to_bits(), Relaxed);
    }

    /// The common gain of all waveforms at the end of the last block, a factor from 0 to 1.
    pub fn wave_gain(&self) -> f32 {
        f32::from_bits(self.wave_gain.load(Relaxed))
    }

    /// Largest magnitude of a sample that the output of this index has emitted since the last call of this
    /// function, in the actuator's unit.
    pub fn take_peak(&self, output: usize) -> f32 {
        self.peaks.get(output).map_or(0.0, |peak| f32::from_bits(peak.swap(0, Relaxed)))
    }

    /// Running rms of the output of this index after the last block, as a share of its limit; with a
    /// short-term and a thermal limit, the larger share. 0 without such limits.
    pub fn heat(&self, output: usize) -> f32 {
        self.heats.get(output).map_or(0.0, |heat| f32::from_bits(heat.load(Relaxed)))
    }

    /// Number of events of a kind since the player was made.
    pub fn count(&self, what: Count) -> u64 {
        self.counts[what as usize].load(Relaxed)
    }

    /// Counts one event more of a kind.
    pub(crate) fn add(&self, what: Count) {
        self.counts[what as usize].fetch_add(1, Relaxed);
    }

    /// Sets the first sample of the next block.
    pub(crate) fn set_clock(&self, clock: u64) {
        self.clock.store(clock, Relaxed);
    }

    /// Sets whether all is silent and nothing is to come.
    pub(crate) fn set_silent(&self, silent: bool) {
        self.silent.store(silent, Relaxed);
    }

    /// Sets the common gain of all waveforms.
    pub(crate) fn set_wave_gain(&self, gain: f32) {
        self.wave_gain.store(gain.to_bits(), Relaxed);
    }

    /// Sets the share of its limits that an output has used up.
    pub(crate) fn set_heat(&self, output: usize, heat: f32) {
        if let Some(held) = self.heats.get(output) {
            held.store(heat.to_bits(), Relaxed);
        }
    }

    /// Raises the peak of an output to a magnitude. Magnitudes are not negative, so their bits are ordered as they are.
    pub(crate) fn raise_peak(&self, output: usize, peak: f32) {
        if let Some(held) = self.peaks.get(output) {
            held.fetch_max(peak.to_bits(), Relaxed);
        }
    }
}
