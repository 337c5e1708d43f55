//! Simulated faults of a real device: drift, noise, clipping, lost blocks, delay.

use super::surface::VirtualSurface;
use crate::PhysicsError;
use unripple_core::{Random, require};

/// Faults that can occur between a computer and a real surface, to be simulated. The default is no fault.
///
/// The drive passes, in this order: swapped wires, dead channels (set to zero), clipping. Sensor signals pass: dead channels (set to
/// zero), swapped wires, delay, and added noise (on dead channels too). A dropped block loses both its drive and its sensor signals.
/// Probes read the true motion of the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct InjectedFaults {
    /// Relative tension against time: pairs (s, multiple of the nominal tension), times ascending; linear
    /// between, constant before the first and after the last. Evaluated at the start of each block.
    pub tension: Vec<(f64, f64)>,
    /// Rms of white noise added to each sensor signal, in the sensor's unit.
    pub noise: f64,
    /// Magnitude at which the drive is clipped, in the drive's unit; `None` for no clipping.
    pub clip: Option<f64>,
    /// Indices of channels that neither drive nor sense.
    pub dead: Vec<usize>,
    /// Pairs of channel indices whose wires are swapped, for drive and sensor alike.
    pub swapped: Vec<(usize, usize)>,
    /// Delay of the sensor signals, in samples.
    pub latency: usize,
    /// Probability that a block is lost, 0 to 1.
    pub dropped: f64,
    /// Seed of the random numbers for noise and lost blocks.
    pub seed: u64,
}

impl Default for InjectedFaults {
    fn default() -> Self {
        Self {
            tension: Vec::new(),
            noise: 0.0,
            clip: None,
            dead: Vec::new(),
            swapped: Vec::new(),
            latency: 0,
            dropped: 0.0,
            seed: 1,
        }
    }
}

/// A simulated surface with simulated faults, for tests of software that drives and measures a surface.
#[derive(Clone, Debug)]
pub struct FaultySurface {
    surface: VirtualSurface,
    faults: InjectedFaults,
    most: usize,
    /// Number of channels at the end that faults do not affect.
    spare: usize,
    drive: Vec<f64>,
    /// Delay lines: the latest sensor samples of each channel, as ring buffers.
    late: Vec<f64>,
    oldest: usize,
    random: Random,
    lost: usize,
}

impl FaultySurface {
    /// Adds faults to a simulated surface, for blocks of at most `most` samples.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for an index of a channel out of range, negative noise, clipping or tension, times that do not
    /// ascend, or a probability outside 0 to 1.
    pub fn new(surface: VirtualSurface, faults: InjectedFaults, most: usize) -> Result<Self, PhysicsError> {
        let channels = surface.channels();
        let known = faults.swapped.iter().flat_map(|(a, b)| [*a, *b]).chain(faults.dead.iter().copied());
        for channel in known {
            let expected = format!("less than {channels}, the number of channels");
            require("channel of a fault", channel < channels, expected, channel as f64)?;
        }
        require("noise of the sensors", faults.noise >= 0.0, "0 or more", faults.noise)?;
        let clip = faults.clip.unwrap_or(0.0);
        require("clipping of the drive", clip >= 0.0, "0 or more", clip)?;
        let dropped = faults.dropped;
        require("probability of losing a block", (0.0..=1.0).contains(&dropped), "between 0 and 1", dropped)?;
        let mut before = f64::NEG_INFINITY;
        for (time, factor) in &faults.tension {
            require("time of a change of tension in s", *time > before, "later than the one before", *time)?;
            require("tension as a share of the nominal one", *factor >= 0.0, "0 or more", *factor)?;
            before = *time;
        }
        let late = vec![0.0; channels * faults.latency];
        let random = Random::seeded(faults.seed);
        Ok(Self {
            surface,
            most,
            spare: 0,
            drive: vec![0.0; channels * most],
            late,
            oldest: 0,
            random,
            lost: 0,
            faults,
        })
    }

    /// Exempts the last `spare` channels from all faults: for forces that reach the surface without wires,
    /// such as taps.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] if `spare` exceeds the number of channels, or if a fault names one of these channels.
    pub fn with_spare(self, spare: usize) -> Result<Self, PhysicsError> {
        let channels = self.surface.channels();
        require("spare channels", spare <= channels, format!("at most {channels}"), spare as f64)?;
        let pairs = self.faults.swapped.iter().flat_map(|(a, b)| [*a, *b]);
        for channel in pairs.chain(self.faults.dead.iter().copied()) {
            let expected = format!("less than {}, the channels with wires", channels - spare);
            require("channel of a fault", channel < channels - spare, expected, channel as f64)?;
        }
        Ok(Self { spare, ..self })
    }

    /// The simulated surface to which the faults were added.
    pub fn surface(&self) -> &VirtualSurface {
        &self.surface
    }

    /// The simulated surface to which the faults were added, mutable, to set fingers and probes.
    pub fn surface_mut(&mut self) -> &mut VirtualSurface {
        &mut self.surface
    }

    /// Number of blocks lost so far.
    pub fn lost(&self) -> usize {
        self.lost
    }

    /// Processes a block of `frames` samples as [`VirtualSurface::process`] does, and applies all faults.
    /// Never allocates.
    ///
    /// # Errors
    /// Those of [`VirtualSurface::process`]; [`PhysicsError::Range`] for a block longer than the limit
    /// passed to [`FaultySurface::new`].
    pub fn process(
        &mut self,
        frames: usize,
        drive: &[f64],
        sensors: &mut [f64],
        probes: &mut [f64],
    ) -> Result<(), PhysicsError> {
        let channels = self.surface.channels();
        super::surface::size("drive", drive.len(), channels * frames, false)?;
        super::surface::size("sensors", sensors.len(), channels * frames, true)?;
        if frames > self.most {
            let expected = format!("at most {}", self.most);
            require("samples of a block", false, expected, frames as f64)?;
        }
        let lost = self.random.uniform() < self.faults.dropped;
        self.lost += usize::from(lost);
        self.distort(drive, frames, lost);
        let now = self.surface.samples() as f64 / self.surface.rate();
        if let Some(tension) = tension(&self.faults.tension, now) {
            self.surface.set_tension(tension)?;
        }
        self.surface.process(frames, &self.drive[..channels * frames], sensors, probes)?;
        if !sensors.is_empty() {
            let wired = (channels - self.spare) * frames;
            self.mislead(&mut sensors[..wired], frames, lost);
        }
        Ok(())
    }

    /// Writes the drive, with its faults applied, into the scratch buffer.
    fn distort(&mut self, drive: &[f64], frames: usize, lost: bool) {
        self.drive[..drive.len()].copy_from_slice(drive);
        let scratch = &mut self.drive[..drive.len() - self.spare * frames];
        for (a, b) in &self.faults.swapped {
            swap(scratch, frames, *a, *b);
        }
        for dead in &self.faults.dead {
            scratch[dead * frames..(dead + 1) * frames].fill(0.0);
        }
        if let Some(clip) = self.faults.clip {
            scratch.iter_mut().for_each(|d| *d = d.clamp(-clip, clip));
        }
        if lost {
            scratch.fill(0.0);
        }
    }

    /// Applies faults to the sensor signals.
    fn mislead(&mut self, sensors: &mut [f64], frames: usize, lost: bool) {
        for dead in &self.faults.dead {
            sensors[dead * frames..(dead + 1) * frames].fill(0.0);
        }
        for (a, b) in &self.faults.swapped {
            swap(sensors, frames, *a, *b);
        }
        let latency = self.faults.latency;
        if latency > 0 {
            for i in 0..frames {
                let slot = (self.oldest + i) % latency;
                for (channel, line) in sensors.chunks_exact_mut(frames).enumerate() {
                    std::mem::swap(&mut line[i], &mut self.late[channel * latency + slot]);
                }
            }
            self.oldest = (self.oldest + frames) % latency;
        }
        if self.faults.noise > 0.0 {
            for value in sensors.iter_mut() {
                *value += self.faults.noise * self.random.normal();
            }
        }
        if lost {
            sensors.fill(0.0);
        }
    }
}

fn swap(planes: &mut [f64], frames: usize, a: usize, b: usize) {
    for i in 0..frames {
        planes.swap(a * frames + i, b * frames + i);
    }
}

/// The tension at a time (s), as a multiple of the nominal one; `None` for an empty table.
fn tension(table: &[(f64, f64)], now: f64) -> Option<f64> {
    let after = table.partition_point(|(time, _)| *time <= now);
    match (after.checked_sub(1).and_then(|i| table.get(i)), table.get(after)) {
        (Some((t0, f0)), Some((t1, f1))) => Some(f0 + (f1 - f0) * (now - t0) / (t1 - t0)),
        (Some((_, f)), None) | (None, Some((_, f))) => Some(*f),
        (None, None) => None,
    }
}
