//! A true surface that differs from its model at random, determined by a seed.

use crate::{DevicesError, Interface};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use unripple_core::{Decay, OutOfRange, Point, Profile, Random, Scatterer, ScattererKind, Surface, require};
use unripple_physics::stepper::{Channel, Plant, StepperOptions, VirtualSurface};
use unripple_physics::{Entry, Medium, Modes, PhysicsError, Transducer, transducers};

/// Nodes of the profile of tension along each side: waves no shorter than a side are drawn by eight steps. More would
/// change the profile little.
const NODES: usize = 9;

/// Duration of an actuator's sweep of the band in s, (`SOME`) number of actuators that sweep, and (`BLOCK`) samples that are simulated
/// at once. More of any takes longer and brings the mean over actuators and places nearer to that of all.
const SWEPT: f64 = 0.5;
const SOME: usize = 6;
const BLOCK: usize = 64;

/// Lowest frequency of a law of damping, as a share of the band's top, and the ratio of a node to the one before where the law is a
/// hyperbola: a straight line between them is off by 0.1 %.
const LOWEST: f64 = 1e-3;
const NODES_APART: f64 = 1.1;

/// Differences of a true surface from its model, which the surface file does not contain. They are drawn at
/// random; equal seeds give equal differences.
///
/// ```
/// use unripple_devices::Perturbation;
/// # use unripple_core::*;
/// # let sheet = Sheet { material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None,
/// #     thickness: 0.125e-3, tension: 200.0, decay: Decay::Time(0.07), air: Air::None,
/// #     uneven: Uneven::default() };
/// # let a1 = Actuator { name: "a1".into(), at: Point::from_mm(12.0, 31.0), kind: ActuatorKind::Force,
/// #     contact_radius: 0.0 };
/// # let surface = Surface { name: "film".into(), outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }),
/// #     sheet, emission: Emission { band: [0.0, 1e3], rate: 48e3, limit: 1.0, rms_limit: None },
/// #     finger: Finger::default(), accuracy: None, actuators: vec![a1] };
///
/// let truth = Perturbation::default().truth(&surface)?;
/// assert_eq!(truth.surface.sheet.uneven.scatterers.len(), 2);
/// let off = truth.surface.actuators[0].at.distance(surface.actuators[0].at);
/// assert!((off - 1e-3).abs() < 1e-9);
/// # Ok::<(), unripple_devices::DevicesError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Perturbation {
    /// Signal-to-noise ratio at the inputs while one actuator sweeps the band at the drive limit, in dB: see [`Truth::noise`].
    pub snr_db: f64,
    /// Root mean square of the error of each drive's and each sensor's gain, as a share.
    pub gain: f64,
    /// Distance of each actuator from its place in the surface file, in m, in a random direction.
    pub misplacement: f64,
    /// Largest deviation of the tension from the nominal one, up or down, as a share: smooth over the sheet, 0 on average.
    pub tension: f64,
    /// The true law of damping, as pairs of a frequency (a share of the band's top, ascending) and a factor
    /// on the nominal decay time; linear between pairs, constant beyond. Empty for the nominal law.
    pub decay: Vec<(f64, f64)>,
    /// Stray point masses, in kg, at random places.
    pub masses: Vec<f64>,
    /// Additional mass on the sheet at each actuator, in kg, which moves with the sheet.
    pub actuator_mass: f64,
    /// Seed of all random numbers.
    pub seed: u64,
}

impl Default for Perturbation {
    /// 50 dB, 0.5 %, 1 mm, 1 %, decay times from 15 % above to 25 % below the nominal ones, two masses of 20 mg.
    fn default() -> Self {
        Self {
            snr_db: 50.0,
            gain: 0.005,
            misplacement: 1e-3,
            tension: 0.01,
            decay: vec![(0.0, 1.15), (0.3, 1.0), (0.7, 0.85), (1.0, 0.75)],
            masses: vec![20e-6, 20e-6],
            actuator_mass: 0.0,
            seed: 1,
        }
    }
}

/// The surface that a virtual device simulates: the nominal one of a surface file with perturbations, and with the gains of its channels
/// and its noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// The true surface, with the true places of actuators and masses.
    pub surface: Surface,
    /// Gain of each actuator, a factor on its drive.
    pub drive_gains: Vec<f64>,
    /// Gain of each sensor, a factor on its signal.
    pub sensor_gains: Vec<f64>,
    /// Signal-to-noise ratio at the inputs, in dB.
    pub snr_db: f64,
    /// Seed of the noise.
    pub seed: u64,
}

impl Perturbation {
    /// Draws the perturbations of a nominal surface at random, and returns the true surface with them.
    ///
    /// # Errors
    /// [`DevicesError::Range`] for shares, distances, masses or factors out of range.
    pub fn truth(&self, surface: &Surface) -> Result<Truth, DevicesError> {
        require("share by which tension varies", (0.0..1.0).contains(&self.tension), "0 to 1", self.tension)?;
        require("error of gains", self.gain >= 0.0, "0 or more", self.gain)?;
        require("misplacement of actuators in m", self.misplacement >= 0.0, "0 or more", self.misplacement)?;
        require("signal-to-noise in dB", true, "a finite number", self.snr_db)?;
        for mass in self.masses.iter().chain([&self.actuator_mass]) {
            require("unknown point mass in kg", *mass >= 0.0, "0 or more", *mass)?;
        }
        let mut random = Random::seeded(self.seed);
        let mut truth = surface.clone();
        self.misplace(&mut truth, &mut random);
        if self.tension > 0.0 {
            truth.sheet.uneven.tension = Some(self.vary(surface, &mut random)?);
        }
        if !self.decay.is_empty() {
            truth.sheet.decay = Decay::Table(self.damp(surface)?);
        }
        self.load(&mut truth, &mut random);
        let mut gains = || surface.actuators.iter().map(|_| 1.0 + self.gain * random.normal()).collect();
        let (drive_gains, sensor_gains) = (gains(), gains());
        Ok(Truth { surface: truth, drive_gains, sensor_gains, snr_db: self.snr_db, seed: self.seed })
    }

    fn misplace(&self, surface: &mut Surface, random: &mut Random) {
        let outline = &surface.outline;
        for actuator in &mut surface.actuators {
            let (sin, cos) = (TAU * random.uniform()).sin_cos();
            let off = |way: f64| {
                let step = way * self.misplacement;
                Point::new(actuator.at.x + step * cos, actuator.at.y + step * sin)
            };
            if let Some(at) = [off(1.0), off(-1.0)].into_iter().find(|at| outline.contains(*at)) {
                actuator.at = at;
            }
        }
    }

    /// The profile of tension: that of the surface file, times a smooth random field whose waves are no
    /// shorter than a side.
    fn vary(&self, surface: &Surface, random: &mut Random) -> Result<Profile, DevicesError> {
        let (width, height) = surface.outline.extent();
        let waves: Vec<[f64; 4]> = [(0, 1), (1, 0), (1, 1), (2, 0), (0, 2), (2, 1), (1, 2)]
            .into_iter()
            .map(|(i, j)| [f64::from(i), f64::from(j), random.normal(), random.between(0.0, PI)])
            .collect();
        let share = |k: usize| k as f64 / (NODES - 1) as f64;
        let wave = |x: f64, y: f64| {
            let one = |[i, j, a, p]: &[f64; 4]| a * (PI * (i * x + j * y) + p).cos();
            waves.iter().map(one).sum::<f64>()
        };
        let nodes: Vec<(f64, f64)> =
            (0..NODES * NODES).map(|n| (share(n % NODES), share(n / NODES))).collect();
        let mut values: Vec<f64> = nodes.iter().map(|(x, y)| wave(*x, *y)).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter_mut().for_each(|value| *value -= mean);
        let largest = values.iter().fold(f64::MIN_POSITIVE, |most, value| value.abs().max(most));
        let known = surface.sheet.uneven.tension.as_ref();
        for (value, (x, y)) in values.iter_mut().zip(&nodes) {
            let at = Point::new(x * width, y * height);
            let known = known.map_or(1.0, |profile| profile.at(at, (width, height)));
            *value = known * (1.0 + self.tension * *value / largest);
        }
        let rows: Vec<Vec<f64>> = values.chunks(NODES).map(<[f64]>::to_vec).collect();
        Profile::new(&rows).ok_or(DevicesError::Range(OutOfRange::new(
            "tension over the surface",
            "finite numbers",
            f64::NAN,
        )))
    }

    /// The true decay times: the nominal law times the factor, at enough frequencies for straight lines between them.
    fn damp(&self, surface: &Surface) -> Result<Vec<(f64, f64)>, DevicesError> {
        let top = surface.emission.band[1];
        let mut nodes = Vec::new();
        let mut before = -1.0;
        for (share, factor) in &self.decay {
            require("share of the band in a law of damping", *share > before, "ascending, from 0", *share)?;
            require("factor of a decay time", *factor > 0.0, "a positive number", *factor)?;
            before = *share;
            nodes.push(share * top);
        }
        match &surface.sheet.decay {
            Decay::Time(_) => {}
            Decay::Table(table) => nodes.extend(table.iter().map(|(hz, _)| *hz)),
            Decay::LossFactor(_) => {
                let mut hz = LOWEST * top;
                while hz < before.max(1.0) * top {
                    nodes.push(hz);
                    hz *= NODES_APART;
                }
            }
        }
        nodes.sort_unstable_by(f64::total_cmp);
        nodes.dedup();
        let time = |hz: f64| (hz, self.factor(hz / top) * nominal_decay(surface, hz.max(LOWEST * top)));
        Ok(nodes.into_iter().map(time).collect())
    }

    /// Factor of the decay time at a share of the band.
    fn factor(&self, share: f64) -> f64 {
        let after = self.decay.partition_point(|(s, _)| *s <= share);
        match (after.checked_sub(1).and_then(|i| self.decay.get(i)), self.decay.get(after)) {
            (Some((s0, f0)), Some((s1, f1))) => f0 + (f1 - f0) * (share - s0) / (s1 - s0),
            (Some((_, factor)), None) | (None, Some((_, factor))) => *factor,
            (None, None) => 1.0,
        }
    }

    /// Stray masses, away from the rim and the actuators if there is room.
    fn load(&self, surface: &mut Surface, random: &mut Random) {
        let (width, height) = surface.outline.extent();
        let room = 0.1 * width.min(height);
        for mass in &self.masses {
            let mut at = Point::new(width / 2.0, height / 2.0);
            for _ in 0..1000 {
                at = Point::new(random.uniform() * width, random.uniform() * height);
                let around = (0..8).map(|k| (TAU * f64::from(k) / 8.0).sin_cos());
                let mut rim = around.map(|(s, c)| Point::new(at.x + room * c, at.y + room * s));
                let taken = |p: Point| p.distance(at) < room;
                if rim.all(|p| surface.outline.contains(p))
                    && !surface.actuators.iter().any(|a| taken(a.at))
                    && !surface.sheet.uneven.scatterers.iter().any(|s| taken(s.at))
                {
                    break;
                }
            }
            surface.sheet.uneven.scatterers.push(Scatterer { at, kind: ScattererKind::Mass(*mass) });
        }
        if self.actuator_mass > 0.0 {
            let kind = ScattererKind::Mass(self.actuator_mass);
            let riding = surface.actuators.iter().map(|actuator| Scatterer { at: actuator.at, kind });
            surface.sheet.uneven.scatterers.extend(riding);
        }
    }
}

impl Truth {
    /// Relative accuracy of the frequencies of [`Truth::modes`]. Point masses make finite elements converge
    /// slowly: a value a hundred times smaller would take ten to thirty times as long, and make the
    /// simulation no more realistic.
    pub const ACCURACY: f64 = 1e-4;

    /// Computes the modes of the true surface up to a frequency (Hz), or up to the one that a virtual device
    /// needs. That takes seconds, so compute them once and share them.
    ///
    /// # Errors
    /// Those of [`Modes::solve`].
    pub fn modes(&self, max_hz: Option<f64>) -> Result<Arc<Modes>, DevicesError> {
        let top = crate::bandwidth::top(&self.surface, max_hz)?;
        Ok(Arc::new(Modes::solve(&self.surface, top, Self::ACCURACY)?))
    }

    /// Root mean square of the noise on each sensor, in the sensors' unit, and on the probe, in m/s.
    ///
    /// The signal, of which `snr_db` gives the ratio, is that of one actuator that sweeps the band at the drive limit L: white of
    /// variance L²/2 over the band B, of which a mode passes L²/(2B) · (w_a w_i)²/(8σ), by Parseval's theorem and ∫h² = w²/(4σ). It is
    /// averaged over actuators and sensors; for the probe over places, where the mean of φ² is one over the sheet's mass. Modes that
    /// overlap count as if they did not. With coils driven by a voltage, which damp the sheet, or exciters, whose housings follow it below
    /// their resonance, sweeps of single actuators are simulated instead.
    pub fn noise(&self, modes: &Arc<Modes>) -> (f64, f64) {
        let surface = &self.surface;
        let Ok(actuators) = transducers(surface) else { return (0.0, 0.0) };
        let housed = |t: &Transducer| t.load.as_ref().is_some_and(|load| load.housing.is_some());
        if actuators.iter().any(|t| t.entry == Entry::Voltage || housed(t)) {
            return self.swept(modes).unwrap_or_default();
        }
        let weights: Vec<Vec<f64>> = actuators
            .iter()
            .map(|t| t.footprint.weights(modes.as_ref()).into_iter().map(|w| w * t.gain).collect())
            .collect();
        let count = weights.len().max(1) as f64;
        let sheet = &surface.sheet;
        let mass = sheet.density * sheet.thickness * surface.outline.area();
        let [low, high] = surface.emission.band;
        let density = surface.emission.limit.powi(2) / (2.0 * (high - low));
        let (mut sensors, mut probe) = (0.0, 0.0);
        for (m, pole) in modes.poles().iter().enumerate().filter(|(_, pole)| pole.omega <= TAU * high) {
            let square = weights.iter().map(|w| w[m] * w[m]).sum::<f64>() / count;
            let ring = density / (8.0 * pole.sigma.max(1e-3));
            sensors += ring * square * square;
            probe += ring * square / mass;
        }
        let down = 10f64.powf(-self.snr_db / 20.0);
        (down * sensors.sqrt(), down * probe.sqrt())
    }

    /// The noise of [`Truth::noise`], from simulated sweeps of some of the actuators.
    fn swept(&self, modes: &Arc<Modes>) -> Result<(f64, f64), PhysicsError> {
        let surface = &self.surface;
        let (sheet, rate, [low, high]) = (&surface.sheet, surface.emission.rate, surface.emission.band);
        let mass = sheet.density * sheet.thickness * surface.outline.area();
        let plant = Plant::with_residual_compliance(surface, modes.clone(), rate)?;
        let channels = Channel::all(surface)?;
        let count = channels.len();
        let (blocks, frames) = ((SWEPT * rate / BLOCK as f64) as usize, BLOCK);
        let (mut sensors, mut probe) = (0.0, 0.0);
        let some = count.min(SOME);
        for actuator in (0..some).map(|i| i * count / some) {
            let mut stepped = VirtualSurface::new(&plant, &channels, rate, &StepperOptions::default())?;
            let (mut drive, mut heard) = (vec![0.0; count * frames], vec![0.0; count * frames]);
            for block in 0..blocks {
                for (i, x) in drive[actuator * frames..][..frames].iter_mut().enumerate() {
                    let t = (block * frames + i) as f64 / rate;
                    let turns = low * t + 0.5 * (high - low) * t * t / SWEPT;
                    *x = surface.emission.limit * (TAU * turns).sin();
                }
                stepped.process(frames, &drive, &mut heard, &mut [])?;
                sensors += heard.iter().map(|x| x * x).sum::<f64>() / (count * frames) as f64;
                probe += stepped.state().1.iter().map(|v| v * v).sum::<f64>() / mass;
            }
        }
        let down = 10f64.powf(-self.snr_db / 20.0);
        let mean = |sum: f64| down * (sum / (some * blocks).max(1) as f64).sqrt();
        Ok((mean(sensors), mean(probe)))
    }

    /// The gains and the noise of the true surface, combined with those of the interface `besides`.
    pub(crate) fn interface(&self, modes: &Arc<Modes>, besides: &Interface) -> Interface {
        let (sensors, probe) = self.noise(modes);
        let or = |list: &[f64], at: usize, default: f64| list.get(at).copied().unwrap_or(default);
        let count = self.surface.actuators.len();
        // A list whose length is not the number of channels is left for the device to refuse.
        let scaled = |own: &[f64], other: &[f64]| -> Vec<f64> {
            let length = if other.is_empty() { own.len() } else { other.len() };
            (0..length).map(|i| or(own, i, 1.0) * or(other, i, 1.0)).collect()
        };
        let heard: Vec<f64> = self.sensor_gains.iter().copied().chain([1.0]).collect();
        let length = if besides.noise.is_empty() { count + 1 } else { besides.noise.len() };
        let level = |i: usize| if i < count { sensors } else { probe };
        Interface {
            drive_gains: scaled(&self.drive_gains, &besides.drive_gains),
            heard_gains: scaled(&heard, &besides.heard_gains),
            noise: (0..length).map(|i| level(i).hypot(or(&besides.noise, i, 0.0))).collect(),
            seed: self.seed ^ besides.seed.rotate_left(32),
            ..besides.clone()
        }
    }
}

/// The amplitude decay time in the surface file at a frequency (Hz), in s.
pub(crate) fn nominal_decay(surface: &Surface, hz: f64) -> f64 {
    match &surface.sheet.decay {
        Decay::Time(time) => *time,
        Decay::Table(table) => {
            let after = table.partition_point(|(f, _)| *f <= hz);
            match (after.checked_sub(1).and_then(|i| table.get(i)), table.get(after)) {
                (Some((f0, t0)), Some((f1, t1))) => t0 + (t1 - t0) * (hz - f0) / (f1 - f0),
                (Some((_, t)), None) | (None, Some((_, t))) => *t,
                (None, None) => f64::INFINITY,
            }
        }
        Decay::LossFactor(loss) => {
            let medium = Medium::of(&surface.sheet);
            let omega = TAU * hz;
            2.0 / (loss * medium.bending_share(medium.wavenumber(omega)) * omega)
        }
    }
}
