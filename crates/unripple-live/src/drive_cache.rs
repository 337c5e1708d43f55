//! A cache of drives, found by the points they focus on.

use crate::{FocusDrive, FocusWorker, LiveError, Percentiles};
use std::collections::HashMap;
use std::sync::Arc;
use unripple_core::Point;
use unripple_core::clock::Instant;
use unripple_dsp::{Convolver, Threshold, Weighting, convolve};
use unripple_effects::{Level, Wave};
use unripple_player::PreparedDrive;

/// Places whose drives are remembered; the one used longest ago goes first. A drive of eight channels and 70 ms takes
/// 0.1 MB in float32, and twice that in float64.
const REMEMBERED: usize = 256;

/// Length of the loudest part of a waveform that its level is taken from, in s. Shorter, and single peaks decide;
/// longer, and pauses within a waveform lower its level.
const LOUDEST: f64 = 0.25;

/// Cache of drives by the points they focus on, for one state of the surface. It keeps 256 drives; the one used
/// longest ago is removed first.
#[derive(Debug)]
pub struct DriveCache {
    maker: FocusWorker,
    /// The real-time priority that was requested for makers.
    hurried: Option<u8>,
    /// The limit that drives are made for, in the drive's unit.
    limit: f64,
    full: Option<Full>,
    /// Factors on the drive for a level share of 1, where `full` is given: for pulses, and for waveforms by the
    /// address of their samples.
    pulse: Option<f64>,
    waves: Vec<(Wave, f64)>,
    plan: Option<Convolver>,
    known: HashMap<Place, Known>,
    asked: u64,
    making: Percentiles,
}

/// The full level, which a share of 1 stands for ([`Level::Share`]), given as a sensation level at one
/// place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Full {
    /// Place where the full level is defined, in m. At other places the same fraction of the drive's limit
    /// is used.
    pub place: Point,
    /// Sensation level at this place without the load of a finger, in dB above the threshold of vibrotactile
    /// detection.
    pub felt_db: f64,
}

/// Waveforms whose factors are remembered: an effect set has a few, and each is quickly computed again.
const WAVES: usize = 64;

/// Points to the last bit.
type Place = Vec<(u64, u64)>;

fn key(points: &[Point]) -> Place {
    points.iter().map(|p| (p.x.to_bits(), p.y.to_bits())).collect()
}

#[derive(Debug)]
struct Known {
    drive: CachedDrive,
    /// When it was last asked for.
    asked: u64,
}

/// The drive that focuses at a place, in float64 and in float32.
#[derive(Clone, Debug)]
pub struct CachedDrive {
    /// The drive at the limit, in float64, and its focal instant.
    pub made: FocusDrive,
    /// The drive in float32, prepared for the player.
    pub prepared: Arc<PreparedDrive>,
    /// Displacement at the focus, in m, once it has been computed.
    trace: Option<Arc<Vec<f64>>>,
}

impl DriveCache {
    /// An empty cache of drives computed by `maker`. `limit` is their peak, in the actuators' unit. A level share of
    /// 1 is `full`, or the largest level within the limit if that is `None`.
    pub fn new(maker: FocusWorker, limit: f64, full: Option<Full>) -> Self {
        Self {
            maker,
            hurried: None,
            limit,
            full,
            pulse: None,
            waves: Vec::new(),
            plan: None,
            known: HashMap::new(),
            asked: 0,
            making: Percentiles::default(),
        }
    }

    /// Requests real-time priority, 1 to 99, for the thread of this maker and of later ones; `None` requests nothing.
    /// Also computes the drive of the full level.
    pub fn request_realtime(&mut self, priority: Option<u8>) {
        self.maker.request_realtime(priority);
        self.hurried = priority;
        // Otherwise the first touch would wait for it. An error occurs again when the level is used, and is reported
        // then.
        let _ = self.full_pulse();
    }

    /// Discards all drives, and continues with another worker that computes them, after the surface has
    /// changed.
    pub fn replace(&mut self, maker: FocusWorker) {
        maker.request_realtime(self.hurried);
        self.maker = maker;
        self.known.clear();
        self.pulse = None;
        self.waves.clear();
    }

    /// Times taken to compute the drives so far, in s.
    pub fn making(&self) -> &Percentiles {
        &self.making
    }

    /// The drive that focuses at these points, in m, all at the same instant; computed if it is not in the cache.
    ///
    /// # Errors
    /// Those of [`FocusWorker::focus`].
    pub fn at(&mut self, points: &[Point]) -> Result<CachedDrive, LiveError> {
        self.asked += 1;
        let place = key(points);
        if let Some(known) = self.known.get_mut(&place) {
            known.asked = self.asked;
            return Ok(known.drive.clone());
        }
        let began = Instant::now();
        let made = self.maker.focus(points)?;
        let prepared = Arc::new(PreparedDrive::from_drive(&made.drive)?);
        self.making.add(began.elapsed().as_secs_f64());
        if self.known.len() >= REMEMBERED {
            let oldest =
                self.known.iter().min_by_key(|(_, known)| known.asked).map(|(place, _)| place.clone());
            oldest.map(|place| self.known.remove(&place));
        }
        let drive = CachedDrive { made, prepared, trace: None };
        self.known.insert(place, Known { drive: drive.clone(), asked: self.asked });
        Ok(drive)
    }

    /// Factor, at most 1, on the drive that focuses at these points, with which a pulse has the given level;
    /// and whether that level would need a factor above 1, beyond the limit.
    ///
    /// # Errors
    /// Those of [`DriveCache::at`] and [`FocusWorker::trace`].
    pub fn pulse_gain(&mut self, points: &[Point], level: Level) -> Result<(f64, bool), LiveError> {
        match level {
            Level::Share(share) => {
                let gain = share.max(0.0) * self.full_pulse()?;
                Ok((gain.min(1.0), gain > 1.0))
            }
            Level::Felt(db) => self.felt_pulse(points, db),
        }
    }

    /// Factor on the drive that focuses at a place, used as filters for a waveform, with which the waveform
    /// has the given level; and whether that level is beyond the limit, so that the factor was reduced.
    /// Without a [`Full`], a share of 1 is a waveform whose full scale, as a steady sine of any frequency,
    /// would just reach the drive's limit at some actuator. A sensation level is that of the waveform's
    /// loudest quarter of a second.
    ///
    /// # Errors
    /// As [`DriveCache::pulse_gain`].
    pub fn wave_gain(&mut self, place: Point, wave: &Wave, level: Level) -> Result<(f64, bool), LiveError> {
        match level {
            Level::Share(share) => {
                let made = self.at(&[place])?.made;
                let most = self.limit / steadiest(&made, &mut self.plan);
                let gain = share.max(0.0) * self.full_wave(wave)?.unwrap_or(most);
                Ok((gain.min(most), gain > most))
            }
            Level::Felt(db) => self.felt_wave(place, wave, db),
        }
    }

    /// Largest factor with which copies of a drive that start every `period` samples, and may overlap, stay
    /// within the limit together, so that the player scales down none of them.
    pub fn even(&self, drive: &PreparedDrive, period: f64) -> f32 {
        let most = (0..drive.outputs()).map(|output| drive.comb_peak(output, period)).fold(0.0, f32::max);
        if most > 0.0 { self.limit as f32 / most } else { 1.0 }
    }

    /// The factor on the drive of a pulse whose share is 1.
    fn full_pulse(&mut self) -> Result<f64, LiveError> {
        let Some(full) = self.full else { return Ok(1.0) };
        if let Some(gain) = self.pulse {
            return Ok(gain);
        }
        let (gain, _) = self.felt_pulse(&[full.place], full.felt_db)?;
        self.pulse = Some(gain);
        Ok(gain)
    }

    /// The factor on the drive of a waveform whose share is 1, if the full level is a sensation level.
    fn full_wave(&mut self, wave: &Wave) -> Result<Option<f64>, LiveError> {
        let Some(full) = self.full else { return Ok(None) };
        let same = |known: &&(Wave, f64)| Arc::ptr_eq(&known.0.samples, &wave.samples);
        if let Some((_, gain)) = self.waves.iter().find(same) {
            return Ok(Some(*gain));
        }
        let (gain, _) = self.felt_wave(full.place, wave, full.felt_db)?;
        if self.waves.len() >= WAVES {
            self.waves.remove(0);
        }
        self.waves.push((wave.clone(), gain));
        Ok(Some(gain))
    }

    fn felt_pulse(&mut self, points: &[Point], db: f64) -> Result<(f64, bool), LiveError> {
        let (trace, cached) = self.trace(points)?;
        Ok(reaching(db, pulse_felt(&cached.made, &trace)))
    }

    fn felt_wave(&mut self, place: Point, wave: &Wave, db: f64) -> Result<(f64, bool), LiveError> {
        let (trace, cached) = self.trace(&[place])?;
        let rate = cached.made.drive.rate();
        let part = loudest(&wave.samples, (LOUDEST * rate) as usize);
        let moved = convolve(&part, &trace);
        let most = self.limit / steadiest(&cached.made, &mut self.plan);
        let (gain, beyond) = reaching(db - 20.0 * most.log10(), felt(&moved, rate, moved.len()));
        Ok((gain * most, beyond))
    }

    fn trace(&mut self, points: &[Point]) -> Result<(Arc<Vec<f64>>, CachedDrive), LiveError> {
        let cached = self.at(points)?;
        if let Some(trace) = &cached.trace {
            return Ok((trace.clone(), cached));
        }
        let trace = Arc::new(self.maker.trace(&cached.made)?);
        if let Some(known) = self.known.get_mut(&key(points)) {
            known.drive.trace = Some(trace.clone());
        }
        Ok((trace, cached))
    }
}

/// Sensation of a pulse at its focus, as a multiple of the threshold of touch: its largest weighted displacement (of
/// a [`FocusWorker::trace`]) from its beginning until as long after the focal instant.
pub(crate) fn pulse_felt(made: &FocusDrive, trace: &[f64]) -> f64 {
    felt(trace, made.drive.rate(), 2 * made.instant + 1)
}

/// Largest displacement within the first `span` samples, weighted by the threshold of touch.
fn felt(displacement: &[f64], rate: f64, span: usize) -> f64 {
    let weighting =
        Weighting::padded(&Threshold::default(), rate, displacement.len(), displacement.len() / 3);
    weighting.weigh(displacement).iter().take(span).fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// The factor, at most 1, that brings a sensation, a multiple of the threshold, to a level in dB, and whether more
/// would be needed.
fn reaching(db: f64, felt: f64) -> (f64, bool) {
    if felt <= 0.0 {
        return (1.0, true);
    }
    let gain = 10f64.powf(db / 20.0) / felt;
    (gain.min(1.0), gain > 1.0 + 1e-9)
}

/// Largest magnitude of the frequency response of any channel of a drive, used as a filter: the amplitude of a steady
/// sine of amplitude 1 after it.
fn steadiest(made: &FocusDrive, plan: &mut Option<Convolver>) -> f64 {
    let size = 2 * made.drive.samples();
    if plan.as_ref().is_none_or(|plan| plan.size() < size) {
        *plan = Some(Convolver::new(size));
    }
    let Some(plan) = plan else { return f64::MIN_POSITIVE };
    let most = made.drive.channels().iter().flat_map(|channel| plan.spectrum(channel.iter().copied()));
    most.map(|line| line.norm()).fold(f64::MIN_POSITIVE, f64::max)
}

/// The part of a waveform around its largest sample.
fn loudest(samples: &[f32], length: usize) -> Vec<f64> {
    let magnitude = |i: &usize| samples[*i].abs();
    let top = (0..samples.len()).max_by(|a, b| magnitude(a).total_cmp(&magnitude(b))).unwrap_or(0);
    let first = top.saturating_sub(length / 2).min(samples.len().saturating_sub(length));
    samples[first..samples.len().min(first + length)].iter().map(|x| f64::from(*x)).collect()
}
