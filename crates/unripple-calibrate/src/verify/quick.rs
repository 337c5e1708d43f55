//! The model with which probed points are compared: fitted to the sensors' recordings, in a band of few
//! modes so that the fit is quick.

use super::checker::Checker;
use super::verdict::VerifyOptions;
use crate::fit::{FitOptions, Fitted, Measured, Spectra, fit, lag};
use std::f64::consts::{PI, TAU};
use unripple_core::{Point, SampledResponses, Surface};
use unripple_dsp::median;
use unripple_linalg::c64;
use unripple_physics::Medium;

/// Largest number of actuators that are used: more make the fit slow, and locate a point no better.
const ENOUGH: usize = 10;

/// Fewest actuators, and (`LINES`) fewest spectral lines, by which places can be distinguished.
const FEWEST: usize = 3;
const LINES: usize = 12;

/// Largest share of the sensors' responses, as amplitude, that a model may leave unexplained and still separate good points from bad
/// ones. With more, points that are right could be called wrong; with less, sheets that differ a little from any model would have no
/// check.
const NO_MODEL: f64 = 0.35;

/// Unexplained share below which a model is good; one sensor in `MOST_ODD` may be left out to reach that.
pub(super) const SPOILT: f64 = 0.1;
const MOST_ODD: usize = 3;

/// Power of an actuator's responses, relative to the median, below which it counts as silent.
const SILENT: f64 = 1e-4;

/// Largest number of half waves in the tension's profile: 2 give five terms. More take longer, and the lowest modes do not determine
/// them.
const PROFILE: usize = 2;

/// Number of stray masses that are searched if the bare sheet does not explain the sensors' responses. More
/// take longer, and the lowest modes do not show them.
const STRAYS: usize = 2;

/// Highest frequency of the modes used, relative to the top of the band: the field near an actuator consists of many modes.
const REACH: f64 = 1.6;

/// A fitted model, and the measured spectra at the frequencies compared.
pub(super) struct Quick {
    /// The fitted model.
    pub fitted: Fitted,
    /// The band in which the model was fitted, in Hz.
    pub band: [f64; 2],
    /// Indices of the actuators that are used.
    pub actuators: Vec<usize>,
    /// Complex frequencies that are compared, in 1/s.
    pub frequencies: Vec<c64>,
    /// Spectra of the responses at the sensors, `[sensor][driven][frequency]`.
    pub sensed: Vec<Vec<Vec<c64>>>,
    /// Spectra of the responses at the probe, `[point][driven][frequency]`.
    pub probed: Vec<Vec<Vec<c64>>>,
}

impl Quick {
    /// Fits the model to the sensors' responses; the error is the reason, in words, why there is no model.
    pub fn new(
        surface: &Surface,
        measured: &Measured,
        probed: &SampledResponses,
        options: &VerifyOptions,
    ) -> Result<Self, String> {
        let Part { actuators, surface: part, heard, band } = Part::of(surface, measured, options)?;
        let plan = FitOptions {
            band: Some(band),
            profile: PROFILE,
            strays: 0,
            reach: REACH,
            ..FitOptions::default()
        };
        let fitted = fit(&part, &heard, &plan).map_err(|error| error.to_string())?;
        let quick = Self::of(fitted, &heard, probed, actuators, band)?;
        let quick = match quick.fitted.unexplained() > SPOILT {
            true => quick.with_strays(&part, &heard, &plan).without_odd_sensors(&part, &heard, &plan),
            false => quick,
        };
        if quick.fitted.unexplained() > NO_MODEL {
            return Err(format!(
                "{:.0} % of the responses between actuators from {:.0} to {:.0} Hz, by amplitude, is not explained by the best model",
                100.0 * quick.fitted.unexplained(),
                band[0],
                band[1]
            ));
        }
        Ok(quick)
    }

    /// This model with stray masses on the sheet, if they improve it.
    fn with_strays(self, part: &Surface, heard: &Measured, plan: &FitOptions) -> Self {
        match fit(part, heard, &FitOptions { strays: STRAYS, ..plan.clone() }) {
            Ok(fitted) if fitted.unexplained() < self.fitted.unexplained() => Self { fitted, ..self },
            _ => self,
        }
    }

    /// The model fitted without the sensors that agree with it least, if leaving out a few of them gives a
    /// good one: a single wrong channel spoils the model for all others.
    fn without_odd_sensors(self, part: &Surface, heard: &Measured, plan: &FitOptions) -> Self {
        if self.fitted.unexplained() < SPOILT {
            return self;
        }
        let count = self.actuators.len();
        let (mut heard, mut fitted) = (heard.clone(), self.fitted.clone());
        let mut left: Vec<usize> = (0..count).collect();
        for _ in 0..count / MOST_ODD {
            let Some(worst) = self.worst(&fitted, part, &left) else { break };
            left.retain(|sensor: &usize| *sensor != worst);
            if let Some(pairs) = &mut heard.pairs {
                (0..count).for_each(|driven| pairs.responses[driven * count + worst].clear());
            }
            match fit(part, &heard, plan) {
                Ok(better) => fitted = better,
                Err(_) => break,
            }
            if fitted.unexplained() < SPOILT {
                return Self { fitted, ..self };
            }
        }
        self
    }

    /// The sensor that is least like the model at its place.
    fn worst(&self, fitted: &Fitted, part: &Surface, left: &[usize]) -> Option<usize> {
        let checker = Checker::new(fitted.all_modes(), &self.frequencies);
        let like = |sensor: &usize| {
            let row = checker.project(&self.sensed[*sensor]);
            checker.at(&row, part.actuators[*sensor].at, fitted.late.value).likeness
        };
        left.iter().map(|sensor| (*sensor, like(sensor))).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(s, _)| s)
    }

    /// Uses a model that has already been fitted to all actuators, restricted to some of them, instead of
    /// fitting one as [`Quick::new`] does; the error is the reason, in words, why there is no comparison.
    pub fn known(
        fitted: &Fitted,
        surface: &Surface,
        measured: &Measured,
        probed: &SampledResponses,
        options: &VerifyOptions,
    ) -> Result<Self, String> {
        let Part { actuators, heard, band, .. } = Part::of(surface, measured, options)?;
        Self::of(fitted.among(&actuators), &heard, probed, actuators, band)
    }

    fn of(
        fitted: Fitted,
        heard: &Measured,
        probed: &SampledResponses,
        actuators: Vec<usize>,
        band: [f64; 2],
    ) -> Result<Self, String> {
        let window = FitOptions::default().window;
        let (frequencies, mut sensed, mut probed) = spectra(heard, probed, &actuators, (band, window));
        if frequencies.len() < LINES {
            return Err(format!("responses are too short to tell modes apart: {} lines", frequencies.len()));
        }
        // The model has coils without inductance, and exciters whose housings stand still: the effect of circuits and housings on drives
        // and sensors is removed from the spectra.
        let through = |n: usize, row: &mut Vec<c64>| {
            row.iter_mut().zip(&frequencies).for_each(|(y, s)| *y /= lag(fitted.coil(n), *s));
        };
        sensed.iter_mut().chain(&mut probed).for_each(|rows| {
            rows.iter_mut().enumerate().for_each(|(driven, row)| through(driven, row));
        });
        for (hears, rows) in sensed.iter_mut().enumerate() {
            rows.iter_mut().for_each(|row| through(hears, row));
        }
        Ok(Self { fitted, band, actuators, frequencies, sensed, probed })
    }

    /// The fitted model, prepared for comparisons with measured responses.
    pub fn checker(&self) -> Checker<'_> {
        Checker::new(self.fitted.all_modes(), &self.frequencies)
    }
}

/// Data for a quick fit of the model: some of the actuators, in the band of the lowest modes.
pub(super) struct Part {
    /// Indices, among all actuators of the surface, of those used.
    pub actuators: Vec<usize>,
    /// The surface with only the actuators used, and with `band` as its band.
    pub surface: Surface,
    /// The measured responses between the actuators used.
    pub heard: Measured,
    /// Lowest and highest frequency of the fit, in Hz.
    pub band: [f64; 2],
}

impl Part {
    /// Selects about [`VerifyOptions::modes`] modes, and actuators that are not dead; the error is the
    /// reason, in words, why there is nothing to fit.
    pub fn of(surface: &Surface, measured: &Measured, options: &VerifyOptions) -> Result<Self, String> {
        let actuators = chosen(surface, measured, options)?;
        let heard = among(measured, &actuators, surface.actuators.len());
        let band = band(surface, measured, options.modes)?;
        let mut part = surface.clone();
        part.actuators = actuators.iter().map(|a| surface.actuators[*a].clone()).collect();
        part.emission.band = band;
        Ok(Self { actuators, surface: part, heard, band })
    }
}

/// Actuators that work as drives and as sensors, [`ENOUGH`] at most, far from each other.
fn chosen(surface: &Surface, measured: &Measured, options: &VerifyOptions) -> Result<Vec<usize>, String> {
    let all = surface.actuators.len();
    let pairs = measured.pairs.iter().flat_map(|p| &p.responses);
    let powers: Vec<f64> = pairs.map(|h| h.iter().map(|x| x * x).sum()).collect();
    let least = SILENT * median(powers.iter().copied().filter(|p| *p > 0.0)).unwrap_or(0.0);
    let best = |n: &dyn Fn(usize) -> usize| (0..all).map(n).map(|n| powers[n]).fold(0.0, f64::max);
    let works = |a: &usize| {
        best(&|b| a * all + b) > least && best(&|b| b * all + a) > least && !options.dead.contains(a)
    };
    let mut left: Vec<usize> = (0..all).filter(works).collect();
    if left.len() < FEWEST {
        return Err(format!("{} actuators work as drive and sensor, {FEWEST} are needed", left.len()));
    }
    if left.len() <= ENOUGH {
        return Ok(left);
    }
    let at = |a: usize| surface.actuators[a].at;
    let mut taken = vec![left.remove(0)];
    while taken.len() < ENOUGH {
        let far = |a: usize| taken.iter().map(|b| at(a).distance(at(*b))).fold(f64::INFINITY, f64::min);
        let Some(next) = (0..left.len()).max_by(|a, b| far(left[*a]).total_cmp(&far(left[*b]))) else {
            break;
        };
        taken.push(left.remove(next));
    }
    taken.sort_unstable();
    Ok(taken)
}

/// The measurement with some of the actuators only.
fn among(measured: &Measured, actuators: &[usize], all: usize) -> Measured {
    let mut part = measured.clone();
    let count = actuators.len();
    if let (Some(part), Some(pairs)) = (&mut part.pairs, &measured.pairs) {
        let pair = |n: usize| pairs.responses[actuators[n / count] * all + actuators[n % count]].clone();
        part.responses = (0..count * count).map(pair).collect();
    }
    part
}

/// The lowest frequencies (Hz) that the measurement does not attenuate, up to about `modes` modes.
fn band(surface: &Surface, measured: &Measured, modes: usize) -> Result<[f64; 2], String> {
    let medium = Medium::of(&surface.sheet);
    let (area, rim) = (surface.outline.area(), surface.outline.perimeter());
    // Weyl's law for a fixed rim.
    let below = |hz: f64| {
        let k = medium.wavenumber(TAU * hz);
        (area * k * k / (4.0 * PI) - rim * k / (4.0 * PI)).max(0.0)
    };
    let limited = measured.pairs.as_ref().and_then(|p| p.limited);
    let low = limited.map_or(0.0, |l| 1.2 * l.low[1]).max(surface.emission.band[0]);
    let most = (0.9 * surface.emission.band[1]).min(limited.map_or(f64::INFINITY, |l| l.high[0]));
    if most <= low {
        return Err(format!("nothing was measured between {low:.0} and {most:.0} Hz"));
    }
    let wanted = below(low) + modes as f64;
    let (mut from, mut to) = (low, most);
    if below(most) > wanted {
        for _ in 0..60 {
            let middle = 0.5 * (from + to);
            if below(middle) > wanted { to = middle } else { from = middle }
        }
    }
    Ok([low, to])
}

/// Complex frequencies, spectra at the sensors and spectra at the probe.
type Heard = (Vec<c64>, Vec<Vec<Vec<c64>>>, Vec<Vec<Vec<c64>>>);

fn spectra(
    measured: &Measured,
    probed: &SampledResponses,
    actuators: &[usize],
    (band, window): ([f64; 2], f64),
) -> Heard {
    let count = actuators.len();
    let tap = |at: Point, heard: Vec<Vec<f64>>| crate::fit::Tap { at, heard, noise: 1.0 };
    let at_point = |p: usize| {
        let one = |a: &usize| probed.response(*a, p).iter().map(|h| f64::from(*h)).collect();
        tap(probed.points[p], actuators.iter().map(one).collect())
    };
    let pairs = measured.pairs.iter().flat_map(|p| &p.responses).cloned().collect::<Vec<_>>();
    let own = |heard: usize| {
        let row = (0..count).map(|driven| pairs[driven * count + heard].clone()).collect();
        tap(Point::new(0.0, 0.0), row)
    };
    let taps = (0..count).map(own).chain((0..probed.points.len()).map(at_point)).collect();
    let all = Measured { rate: measured.rate, pairs: None, taps };
    let found = Spectra::of(&all, None, band, (0.0, window));
    let mut taps = found.taps;
    let others = taps.split_off(count);
    (found.frequencies, taps, others)
}
