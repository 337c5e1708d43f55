//! Counters of a player, readable from anywhere.

use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering::Relaxed};

/// What a player counts, to be read from anywhere at any time.
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

/// Something counted since the player was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Copies of drives, and waveforms, started.
    Started,
    /// Copies of drives scaled down.
    Limited,
    /// Blocks in which waveforms were scaled down.
    WavesLimited,
    /// Commands whose sample had passed.
    Late,
    /// Starts put off because their block was full of work.
    PutOff,
    /// Commands that were refused.
    Refused,
    /// Reports that found no room on their way to the desk.
    ReportsLost,
    /// Commands that found no room on their way to the player.
    CommandsLost,
    /// Blocks of a wrong size, played as silence.
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

    /// First sample of the next block.
    pub fn clock(&self) -> u64 {
        self.clock.load(Relaxed)
    }

    /// Whether the last block was silent and nothing that the player knows of is to come: no drive sounds, repeats or waits, and waveforms have
    /// rung out.
    pub fn is_silent(&self) -> bool {
        self.silent.load(Relaxed)
    }

    /// Share of the period that the last block took, as told by whoever runs the thread.
    pub fn load(&self) -> f32 {
        f32::from_bits(self.load.load(Relaxed))
    }

    /// Tells the load, a share of the period.
    pub fn set_load(&self, share: f32) {
        self.load.store(share.to_bits(), Relaxed);
    }

    /// The factor on all waveforms at the end of the last block.
    pub fn wave_gain(&self) -> f32 {
        f32::from_bits(self.wave_gain.load(Relaxed))
    }

    /// Largest magnitude that an output, by its index, emitted since this was last asked, in its unit.
    pub fn take_peak(&self, output: usize) -> f32 {
        self.peaks.get(output).map_or(0.0, |peak| f32::from_bits(peak.swap(0, Relaxed)))
    }

    /// Share of its limits on the running rms that an output had used up after the last block; 0 without such limits.
    pub fn heat(&self, output: usize) -> f32 {
        self.heats.get(output).map_or(0.0, |heat| f32::from_bits(heat.load(Relaxed)))
    }

    /// Number of times that something has happened so far.
    pub fn count(&self, what: Count) -> u64 {
        self.counts[what as usize].load(Relaxed)
    }

    /// Counts one event more of a kind.
    pub(crate) fn add(&self, what: Count) {
        self.counts[what as usize].fetch_add(1, Relaxed);
    }

    /// Tells the first sample of the next block.
    pub(crate) fn set_clock(&self, clock: u64) {
        self.clock.store(clock, Relaxed);
    }

    /// Tells whether all is silent and nothing is to come.
    pub(crate) fn set_silent(&self, silent: bool) {
        self.silent.store(silent, Relaxed);
    }

    /// Tells the factor on all waveforms.
    pub(crate) fn set_wave_gain(&self, gain: f32) {
        self.wave_gain.store(gain.to_bits(), Relaxed);
    }

    /// Tells the share of its limits that an output has used up.
    pub(crate) fn set_heat(&self, output: usize, heat: f32) {
        if let Some(held) = self.heats.get(output) {
            held.store(heat.to_bits(), Relaxed);
        }
    }

    /// Magnitudes are not negative, so their bits are ordered as they are.
    pub(crate) fn raise_peak(&self, output: usize, peak: f32) {
        if let Some(held) = self.peaks.get(output) {
            held.fetch_max(peak.to_bits(), Relaxed);
        }
    }
}
