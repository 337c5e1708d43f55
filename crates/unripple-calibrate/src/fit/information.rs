//! What a measurement at a place would tell of a surface: the Fisher information of the unknowns of a fit.

use super::basis::Basis;
use super::coil::lag;
use super::gathered::{Gathered, Line};
use super::layout::{KNOTS, Layout, Unknown, Values};
use super::readings::{Reading, Stiffening};
use super::residual::Nuisance;
use super::run::{FINE, FitOptions, nominal_values, prepared, unknowns_of};
use super::sensing::Sensing;
use super::spectra::Lines;
use super::system::System;
use crate::CalibrateError;
use rayon::prelude::*;
use std::f64::consts::TAU;
use unripple_core::{Memory, Observed, Point, Surface, require};
use unripple_linalg::{Mat, c64};

/// Number of frequencies whose responses at all places are held at a time. More share the set-up of their sums, and take more memory.
const AT_ONCE: usize = 4;

/// Least information, in inverse squared standard deviations of the prior, that measurements at all places together must have of an unknown.
/// With this much, they lower its standard deviation by a twentieth of a per cent.
const TOLD: f64 = 1e-3;

/// Options of [`information`].
#[derive(Clone, Debug, PartialEq)]
pub struct InformationOptions {
    /// What is measured at each place.
    pub sensing: Sensing,
    /// Ratio of the rms of the spectra over all places, lines and channels to the rms of their noise, in dB.
    pub snr_db: f64,
    /// Options of the fit: its band, the terms of the tension's profile, its window. No stray masses are searched.
    pub fit: FitOptions,
}

impl Default for InformationOptions {
    /// Sweeps with a signal-to-noise ratio of 50 dB.
    fn default() -> Self {
        Self { sensing: Sensing::Sweeps, snr_db: 50.0, fit: FitOptions::default() }
    }
}

/// An unknown of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name of the unknown, in words.
    pub name: String,
    /// Unit of its deviations; empty for a ratio: the deviation of a logarithm, or of a share.
    pub unit: &'static str,
    /// Standard deviation of its prior, before anything is measured, in this unit.
    pub prior: f64,
}

/// What measurements at some places would tell of the unknowns of a fit.
///
/// Unknowns are counted in standard deviations of their priors, so that the information of the priors is the identity, and that of a fit to
/// measurements at several places the identity plus the sum of theirs. Its inverse is the covariance of what the fit finds.
#[derive(Clone, Debug)]
pub struct Information {
    /// The unknowns, in the order of rows and columns.
    pub unknowns: Vec<Parameter>,
    /// Names of unknowns of the fit of which no place tells anything; they are in no matrix.
    pub untold: Vec<String>,
    /// Fisher information of a measurement at each place, unknowns x unknowns, dimensionless.
    pub at: Vec<Mat<f64>>,
    /// Rms of the noise on each sample, taken as white up to half the rate: in units of a response (of a signal per unit impulse of drive, or
    /// of a tap by a unit impulse of force).
    pub noise: f64,
    /// The frequencies that are fitted, in Hz.
    pub frequencies_hz: Vec<f64>,
}

/// The Fisher information that a measurement at each of some places (m) would have of the unknowns that [`fit`](super::fit()) finds for a
/// surface, by the Jacobian of the fit's own model at the values of the surface file. What a fit finds at each place anew is eliminated (as a
/// Schur complement): gain and delay of the sensor, or the force of the tap; and so is what modes far above the band add to responses.
/// As in the fit, derivatives neglect that the residual flexibility, of the modes that are left out, changes with the stiffness: under loads
/// far heavier than usual actuators that would count.
///
/// # Errors
/// [`CalibrateError::Count`] for a surface without actuators (for taps, with fewer than two), without modes in the band or in the basis, or
/// without places; [`CalibrateError::Outside`] for a place beyond its edge; [`CalibrateError::Range`] for options out of range, and for more
/// places than memory holds; [`CalibrateError::Physics`] for a surface whose modes cannot be computed.
///
/// ```
/// use unripple_calibrate::{FitOptions, InformationOptions, information};
/// use unripple_core::Point;
/// use unripple_physics::design::papers_surface;
///
/// let mut film = papers_surface();
/// film.emission.band[1] = 400.0;
/// let options = InformationOptions {
///     fit: FitOptions { profile: 0, ..FitOptions::default() },
///     ..InformationOptions::default()
/// };
/// let places = [Point::from_mm(61.0, 47.0), Point::from_mm(1.0, 1.0)];
/// let found = information(&film, &places, &options)?;
/// let tension = found.unknowns.iter().position(|unknown| unknown.name == "tension").expect("it is told");
/// // In a corner hardly anything moves.
/// assert!(found.at[0][(tension, tension)] > 100.0 * found.at[1][(tension, tension)]);
/// // Nothing here depends on the gains of sensors at the actuators.
/// assert!(found.untold.contains(&"sensor gain of a1".to_owned()));
/// # Ok::<(), unripple_calibrate::CalibrateError>(())
/// ```
pub fn information(
    surface: &Surface,
    places: &[Point],
    options: &InformationOptions,
) -> Result<Information, CalibrateError> {
    check(surface, places, options)?;
    let band = options.fit.band.unwrap_or([surface.emission.band[0], 0.97 * surface.emission.band[1]]);
    let (basis, top) = prepared(surface, &options.fit, band)?;
    let layout = unknowns_of(surface, &basis, Vec::new(), top);
    let values = nominal_values(surface, &basis, &layout, top);
    let count = basis.below(options.fit.reach * top);
    some("modes of the fit", count)?;
    let rate = surface.emission.rate;
    let samples = (options.fit.window * rate).ceil() as usize;
    let lines = Lines::new((rate, samples), band, (FINE, options.fit.window));
    some("frequencies of the fitted band", lines.frequencies.len())?;
    let system = System::new(&basis, &layout, &values, &[], (count, top))?;
    let sensing = options.sensing;
    let study = Study { basis: &basis, layout: &layout, values: &values, lines: &lines, sensing };
    let gathered = study.gathered(&system, places)?;
    Ok(study.information((surface, top), gathered, options.snr_db))
}

/// What information is computed from.
pub(super) struct Study<'a> {
    /// The nominal modes.
    pub basis: &'a Basis,
    /// The unknowns of the fit.
    pub layout: &'a Layout,
    /// Their values, at which derivatives are taken.
    pub values: &'a Values,
    /// The frequencies, and the window.
    pub lines: &'a Lines,
    /// What is measured.
    pub sensing: Sensing,
}

impl Study<'_> {
    /// The sums over all frequencies at each place (m).
    pub fn gathered(&self, system: &System, places: &[Point]) -> Result<Vec<Gathered>, CalibrateError> {
        let stiffening = Stiffening::of(system, self.basis);
        let unknowns = self.layout.unknowns();
        let actuators = self.layout.actuators;
        let far = Nuisance::new(&self.lines.far());
        let width = Reading::columns(actuators, 3 + self.layout.waves.len());
        let held = AT_ONCE * 2 * width + Gathered::numbers(unknowns.len(), actuators, far.0.len());
        let (bytes, memory) = ((8 * places.len() * held) as f64, Memory::here());
        let most = format!("at most {:.2}, which fewer places need", memory.bytes() / Memory::GIB);
        require(
            "memory of the information of all places in GiB",
            memory.holds(bytes),
            most,
            bytes / Memory::GIB,
        )?;
        let shapes = system.shapes_at(self.basis, places);
        let none = Gathered::none(self.sensing, &unknowns, actuators, far.0.len());
        let mut all = vec![none; places.len()];
        let observed = Observed::here();
        for (n, chunk) in self.lines.frequencies.chunks(AT_ONCE).enumerate() {
            let line = |(i, s): (usize, &c64)| Line {
                reading: system.reading(&stiffening, &shapes, *s),
                gains: self.gains(*s),
                delay: *s,
                far: self.far(&far.0, n * AT_ONCE + i),
            };
            let read: Vec<Line> = chunk.par_iter().enumerate().map(line).collect();
            all.par_iter_mut()
                .enumerate()
                .for_each(|(place, gathered)| gathered.add(place, &read, &unknowns));
            observed.done((n * AT_ONCE + chunk.len()) as f64 / self.lines.frequencies.len() as f64);
        }
        Ok(all)
    }

    /// Gain of each channel at a complex frequency (1/s): of the drives, or of the sensors that hear a tap.
    fn gains(&self, s: c64) -> Vec<c64> {
        let gains = match self.sensing {
            Sensing::Sweeps => &self.values.drive,
            Sensing::Taps => &self.values.sense,
        };
        let gain = |(a, gain): (usize, &f64)| lag(self.basis.coil(a), s) * gain.exp();
        gains.iter().enumerate().map(gain).collect()
    }

    /// The rows of the columns of modes far above the band at a frequency, real part and imaginary part of each.
    fn far(&self, columns: &[Vec<f64>], line: usize) -> Vec<[f64; 2]> {
        let lines = self.lines.frequencies.len();
        match self.sensing {
            Sensing::Sweeps => columns.iter().map(|column| [column[line], column[lines + line]]).collect(),
            // The unknown force of a tap is free at every frequency, and takes all of this.
            Sensing::Taps => Vec::new(),
        }
    }

    /// The information at each place, from the sums over all frequencies.
    fn information(
        &self,
        (surface, top): (&Surface, f64),
        gathered: Vec<Gathered>,
        snr_db: f64,
    ) -> Information {
        let power: f64 = gathered.iter().map(|one| one.power).sum();
        let lines = (gathered.len() * self.layout.actuators * self.lines.frequencies.len()) as f64;
        // Real and imaginary part of a line have half of its power each.
        let variance = (0.5 * power / lines * 10f64.powf(-snr_db / 10.0)).max(f64::MIN_POSITIVE);
        let all = self.layout.unknowns();
        let spreads: Vec<f64> = all.iter().map(|unknown| self.layout.spread(*unknown)).collect();
        let scale = 1.0 / (variance * self.lines.overlap);
        let whole: Vec<Mat<f64>> =
            gathered.into_par_iter().map(|one| scaled(&one.eliminated(), &spreads, scale)).collect();
        let told = |u: &usize| whole.iter().map(|matrix| matrix[(*u, *u)]).sum::<f64>() >= TOLD;
        let (kept, lost): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(told);
        let part =
            |matrix: &Mat<f64>| Mat::from_fn(kept.len(), kept.len(), |i, j| matrix[(kept[i], kept[j])]);
        let parameter = |u: &usize| named(all[*u], surface, self.layout, top);
        Information {
            unknowns: kept.iter().map(|u| Parameter { prior: spreads[*u], ..parameter(u) }).collect(),
            untold: lost.iter().map(|u| parameter(u).name).collect(),
            at: whole.iter().map(part).collect(),
            noise: variance.sqrt() / self.lines.spread,
            frequencies_hz: self.lines.frequencies.iter().map(|s| s.im / TAU).collect(),
        }
    }
}

fn check(surface: &Surface, places: &[Point], options: &InformationOptions) -> Result<(), CalibrateError> {
    let least = if options.sensing == Sensing::Taps { 2 } else { 1 };
    if surface.actuators.len() < least {
        let (expected, found) = (format!("at least {least}"), surface.actuators.len());
        return Err(CalibrateError::Count { what: "actuators of the surface", expected, found });
    }
    some("places", places.len())?;
    let outside = |at: &&Point| !surface.outline.contains(**at);
    if let Some((place, at)) = places.iter().enumerate().find(|(_, at)| outside(at)) {
        return Err(CalibrateError::Outside { place, at: *at, nearest: surface.outline.nearest(*at) });
    }
    let legal = (-200.0..=200.0).contains(&options.snr_db);
    Ok(require("signal-to-noise ratio in dB", legal, "-200 to 200", options.snr_db)?)
}

fn some(what: &'static str, found: usize) -> Result<(), CalibrateError> {
    match found {
        0 => Err(CalibrateError::Count { what, expected: "at least 1".into(), found }),
        _ => Ok(()),
    }
}

/// The whole of a symmetric matrix of which the lower triangle is given, with each unknown in some unit.
fn scaled(lower: &Mat<f64>, units: &[f64], scale: f64) -> Mat<f64> {
    let count = units.len();
    Mat::from_fn(count, count, |i, j| scale * units[i] * units[j] * lower[(i.max(j), i.min(j))])
}

/// Name and unit of an unknown; `top` is the frequency (Hz) of the last knot of the damping law.
fn named(unknown: Unknown, surface: &Surface, layout: &Layout, top: f64) -> Parameter {
    let of = |what: &str, a: usize| match surface.actuators.get(a) {
        Some(actuator) => format!("{what} of {}", actuator.name),
        None => format!("{what} of stray {}", a + 1 - layout.actuators),
    };
    let (name, unit) = match unknown {
        Unknown::Tension => ("tension".into(), ""),
        Unknown::Bending => ("bending stiffness".into(), ""),
        Unknown::Skew => ("anisotropy".into(), ""),
        Unknown::Term(t) => {
            let [along, up] = layout.waves[t];
            (format!("tension profile {along},{up}"), "")
        }
        Unknown::Knot(k) => (format!("decay at {:.0} Hz", KNOTS[k] * top), ""),
        Unknown::Place(p, 0) => (of("x", p), "m"),
        Unknown::Place(p, _) => (of("y", p), "m"),
        Unknown::Mass(p) => (of("mass", p), "kg"),
        Unknown::Resistance(p) => (of("damping", p), "N·s/m"),
        Unknown::Drive(a) => (of("drive gain", a), ""),
        Unknown::Sense(a) => (of("sensor gain", a), ""),
        Unknown::Level => ("gain of all sensors".into(), ""),
        Unknown::Late => ("latency".into(), "s"),
    };
    Parameter { name, unit, prior: 1.0 }
}
