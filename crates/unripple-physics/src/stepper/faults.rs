//! Faults of a real device on request: drift, noise, lost samples, delay.

use super::surface::VirtualSurface;
use crate::PhysicsError;
use unripple_core::{Random, require};

/// What goes wrong on request, as it does between a computer and a real surface. The default is nothing.
///
/// On the drive's side, in this order: a dropped block is lost whole, both ways; wires are swapped; dead channels are
/// silenced; what is left is clipped. On the sensors' side: dead channels are silent, wires swapped, signals late, and noise
/// is added to all, dead ones too. Probes see what the surface really does.
#[derive(Clone, Debug, PartialEq)]
pub struct InjectedFaults {
    /// Tension as a share of the nominal one against time (s), times ascending: linear between, constant beyond both ends.
    /// Taken at the start of each block.
    pub tension: Vec<(f64, f64)>,
    /// Root mean square of white noise on every sensor, in the sensor's unit.
    pub noise: f64,
    /// Largest magnitude of drive that gets through, in the drive's unit.
    pub clip: Option<f64>,
    /// Channels that neither drive nor sense.
    pub dead: Vec<usize>,
    /// Pairs of channels whose wires are swapped, drive and sensor alike.
    pub swapped: Vec<(usize, usize)>,
    /// Samples by which sensors come late.
    pub latency: usize,
    /// Probability that a block is lost.
    pub dropped: f64,
    /// Seed of noise and losses.
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

/// A virtual surface with injected faults, as a test bench for whatever drives and measures it.
#[derive(Clone, Debug)]
pub struct Misbehaving {
    surface: VirtualSurface,
    faults: InjectedFaults,
    most: usize,
    /// Channels at the end that no wire leads to.
    spare: usize,
    drive: Vec<f64>,
    /// For each channel, the last samples of its sensor, the next to be given first.
    late: Vec<f64>,
    oldest: usize,
    random: Random,
    lost: usize,
}

impl Misbehaving {
    /// A surface with faults, for blocks of at most `most` samples.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for channels that there are not, negative noise, clipping or tension, times that do not
    /// ascend, or a probability that is none.
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

    /// The same, the last `spare` (a number) channels being forces that no wire leads to, taps for example:
    /// nothing happens to their drive, and their sensors are as told.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for more of them than channels, or if a fault is asked for one of them.
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

    /// The surface as it really is.
    pub fn surface(&self) -> &VirtualSurface {
        &self.surface
    }

    /// The surface, for fingers and probes.
    pub fn surface_mut(&mut self) -> &mut VirtualSurface {
        &mut self.surface
    }

    /// Number of blocks lost so far.
    pub fn lost(&self) -> usize {
        self.lost
    }

    /// As [`VirtualSurface::process`], planes of `frames` samples each, with all that goes wrong. Never
    /// allocates.
    ///
    /// # Errors
    /// Those of [`VirtualSurface::process`]; [`PhysicsError::Range`] for a block longer than was said.
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

    /// What of the drive gets through, into the scratch.
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

    /// What of the sensors arrives.
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

/// The tension at a time; `None` without a table.
fn tension(table: &[(f64, f64)], now: f64) -> Option<f64> {
    let after = table.partition_point(|(time, _)| *time <= now);
    match (after.checked_sub(1).and_then(|i| table.get(i)), table.get(after)) {
        (Some((t0, f0)), Some((t1, f1))) => Some(f0 + (f1 - f0) * (now - t0) / (t1 - t0)),
        (Some((_, f)), None) | (None, Some((_, f))) => Some(*f),
        (None, None) => None,
    }
}
