//! Fit of the model to measured responses: Gauss-Newton steps, damped as by Levenberg-Marquardt.

use super::basis::Basis;
use super::fitted::Fitted;
use super::layout::{self, KNOTS, Layout, Values};
use super::limited::Limited;
use super::measured::Measured;
use super::residual::Case;
use super::solve::Found;
use super::spectra::Spectra;
use crate::CalibrateError;
use std::f64::consts::TAU;
use unripple_core::{Decay, Observed, Point, Surface, require};
use unripple_physics::{Medium, Transducer};

/// Options of a fit: band, tension profile, stray masses, window.
#[derive(Clone, Debug, PartialEq)]
pub struct FitOptions {
    /// Lowest and highest frequency that is fitted, in Hz; if `None`, the band of the surface up to 0.97 of
    /// its top.
    pub band: Option<[f64; 2]>,
    /// Largest number of half waves, along x and y together, in a term of the tension's profile; 0 for uniform tension.
    pub profile: usize,
    /// Largest number of stray masses that the fit may find on the sheet.
    pub strays: usize,
    /// Highest frequency of the nominal modes that are computed, as a multiple (1.05 to 4) of the top of the band.
    pub reach: f64,
    /// Duration of the responses that is fitted, from the impulse on, in s.
    pub window: f64,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self { band: None, profile: 3, strays: 3, reach: 1.4, window: 0.25 }
    }
}

/// Decay rates α, in 1/s, of the window e^{-αt}: `COARSE` while the band grows, `FINE` for the whole band. Half as much makes
/// spectral lines narrower, so that frequencies weigh more and a start has to be nearer.
const COARSE: f64 = 60.0;
pub(super) const FINE: f64 = 30.0;

/// Top of the first fitted band, relative to the frequency of the first mode. It holds the first ten or so modes of a membrane;
/// with more a descent may converge to a false minimum, with fewer the data are too few.
const FIRST: f64 = 3.5;

/// Factor from one band's top to the next. A longer step may leave modes more than a line's width off, a shorter one
/// costs more fits.
const WIDER: f64 = 1.6;

/// Number of fits of the whole band before the last one, for responses limited to a band: the part that the
/// limit removed is computed from the model, and so improves with it.
const AGAIN: usize = 1;

/// Largest difference of two descents in any unknown, in standard deviations of its prior, with which both have ended in the same minimum.
/// Those of good models differ by 1e-3 at most; minima in which another mode is taken for a measured one are several deviations of
/// the tension apart.
const SAME: f64 = 0.1;

/// Smallest residual relative to noise at which stray masses are searched, and (`WORTH`) the largest ratio
/// of the residual with a stray mass to that without at which the mass is kept.
const SUSPECT: f64 = 1.5;
const WORTH: f64 = 0.85;

/// Fits the model of a surface to responses and taps that were measured on it.
///
/// The unknowns are the mean tension, bending stiffness, anisotropy and profile of the tension, a damping law, places, masses,
/// damping and gains of the actuators, and a few stray masses anywhere. Each has a normal prior around its nominal value, as wide
/// as such values are uncertain. Spectra are compared from low to high frequencies, so that a mode's frequency is known to within
/// the width of its spectral line before its phase matters (Gauss-Newton steps, damped as by Levenberg-Marquardt). Modes under
/// another tension are combinations of the nominal ones (Rayleigh-Ritz); loads on the sheet are added by Woodbury's identity.
///
/// # Errors
/// [`CalibrateError::Count`] and [`CalibrateError::Range`] for measurements or options out of range, [`CalibrateError::Physics`]
/// for a nominal surface without modes, [`CalibrateError::Unsolvable`] if the equations of a fit have no solution.
///
/// ```
/// use unripple_calibrate::{FitOptions, Measured, Verdict, fit};
/// use unripple_core::{Point, Responses};
/// use unripple_physics::{ResponseOptions, design::papers_surface, responses, sample};
///
/// let mut nominal = papers_surface();
/// nominal.emission.band[1] = 800.0;
/// let mut truth = nominal.clone();
/// truth.sheet.tension = 203.0;
/// let above = ResponseOptions { max_hz: Some(1120.0), ..ResponseOptions::default() };
/// let Responses::Modal(modal) = responses(&truth, &above)? else { unreachable!() };
/// let places: Vec<Point> = truth.actuators.iter().map(|a| a.at).collect();
/// let heard = sample(&modal, &places, 12_000);
/// let signal = |n: usize| heard.response(n / 8, n % 8).iter().map(|v| f64::from(*v)).collect();
/// let measured = Measured::pairs(48e3, (0..64).map(signal).collect(), 1e-3);
/// let fitted = fit(&nominal, &measured, &FitOptions { profile: 0, strays: 0, ..FitOptions::default() })?;
/// assert!((fitted.tension.value - 203.0).abs() < 0.2);
/// assert_eq!(fitted.verdict, Verdict::Good);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn fit(nominal: &Surface, measured: &Measured, options: &FitOptions) -> Result<Fitted, CalibrateError> {
    measured.check(nominal)?;
    let band = options.band.unwrap_or([nominal.emission.band[0], 0.97 * nominal.emission.band[1]]);
    let limited = measured.pairs.as_ref().and_then(|pairs| pairs.limited);
    let band = limited.map_or(band, |l| [band[0].max(l.low[1]), band[1].min(l.high[0])]);
    let (basis, top) = prepared(nominal, options, band)?;
    let first =
        basis.squares.iter().find(|square| **square > 0.0).map_or(band[1], |square| square.sqrt() / TAU);
    let layout = unknowns_of(nominal, &basis, measured.silent(nominal.actuators.len()), top);
    let expected = nominal_values(nominal, &basis, &layout, top);
    let values = expected.clone();
    let mut fit = Fit { nominal, measured, options, basis: &basis, layout, values, expected, top };
    let mut high = (FIRST * first).max(FIRST * band[0]).min(band[1]);
    if fit.begin([band[0], high], high < band[1])? {
        // In these two bands the best start has been fitted.
        high = wider(wider(high, band[1]), band[1]);
    }
    while high < band[1] {
        fit.widen([band[0], high], COARSE, options.reach * high, false)?;
        high = wider(high, band[1]);
    }
    for _ in 0..if limited.is_some() { AGAIN } else { 0 } {
        fit.widen(band, FINE, options.reach * top, false)?;
    }
    let (found, spectra, count) = fit.widen(band, FINE, options.reach * top, true)?;
    Fitted::new(&fit.case(&fit.layout, &spectra, count), &found, &fit.expected, (nominal, limited))
}

/// The nominal modes that a fit of a band (Hz) uses, after a check of its options, and the top (Hz) of the band that the damping law covers.
pub(super) fn prepared(
    nominal: &Surface,
    options: &FitOptions,
    band: [f64; 2],
) -> Result<(Basis, f64), CalibrateError> {
    let top = nominal.emission.band[1].max(band[1]);
    require(
        "reach of the modes",
        (1.05..=4.0).contains(&options.reach),
        "between 1.05 and 4",
        options.reach,
    )?;
    require("window of the fit in s", options.window > 0.0, "a positive number", options.window)?;
    require("top of the fitted band in Hz", band[1] > band[0], "above its bottom", band[1])?;
    Ok((Basis::new(nominal, options.reach * top, options.profile)?, top))
}

/// The unknowns of a fit, without stray masses; `silent` are the actuators without measured responses.
pub(super) fn unknowns_of(surface: &Surface, basis: &Basis, silent: Vec<usize>, top: f64) -> Layout {
    Layout {
        actuators: surface.actuators.len(),
        silent,
        waves: basis.waves.clone(),
        strays: 0,
        damping: layout::damping(&Medium::of(&surface.sheet), top),
    }
}

/// Top of the band that is fitted after the one up to `high` (Hz); `top` is that of the last.
fn wider(high: f64, top: f64) -> f64 {
    if high * WIDER * 1.2 > top { top } else { high * WIDER }
}

/// State of a fit in progress.
#[derive(Clone)]
struct Fit<'a> {
    nominal: &'a Surface,
    measured: &'a Measured,
    options: &'a FitOptions,
    basis: &'a Basis,
    layout: Layout,
    values: Values,
    expected: Values,
    top: f64,
}

impl Fit<'_> {
    /// Searches starting values with the lowest modes: each of the likeliest starts is fitted in a small
    /// band, those that end in different minima in a wider one, and the best is used. Returns whether there were several.
    fn begin(&mut self, band: [f64; 2], more: bool) -> Result<bool, CalibrateError> {
        let modes_hz = self.options.reach * band[1];
        let spectra = self.spectra(band, COARSE)?;
        let starts = self.case(&self.layout, &spectra, self.basis.below(modes_hz)).starts(&self.expected)?;
        let mut best: Option<(f64, Self)> = None;
        let mut followed: Vec<Self> = Vec::new();
        for start in &starts {
            let mut fit = self.clone();
            // From here on the priors of the gains are centred on those of the start, no longer on the
            // surface file's.
            (fit.expected.level, fit.expected.drive) = (start.level, start.drive.clone());
            (fit.expected.sense, fit.values) = (start.sense.clone(), start.clone());
            let mut left = f64::INFINITY;
            if starts.len() > 1 {
                fit.widen(band, COARSE, modes_hz, false)?;
                if followed.iter().any(|other| fit.agrees(other, &spectra)) {
                    continue;
                }
                followed.push(fit.clone());
                let factor = if more { WIDER } else { 1.0 };
                let modes_hz = factor * modes_hz;
                let (found, ..) = fit.widen([band[0], factor * band[1]], COARSE, modes_hz, false)?;
                left = found.share;
            }
            if best.as_ref().is_none_or(|(least, _)| left < *least) {
                best = Some((left, fit));
            }
        }
        if let Some((_, fit)) = best {
            *self = fit;
        }
        Ok(starts.len() > 1)
    }

    /// Whether two descents have ended in the same minimum.
    fn agrees(&self, other: &Self, spectra: &Spectra) -> bool {
        let case = self.case(&self.layout, spectra, 0);
        self.layout.strays == other.layout.strays
            && case.offsets(&self.values, &other.values).iter().all(|offset| offset.abs() < SAME)
    }

    /// The measured spectra in a band (Hz) under the window e^{-αt}.
    fn spectra(&self, band: [f64; 2], alpha: f64) -> Result<Spectra, CalibrateError> {
        let limited = self.limited()?;
        let spectra = Spectra::of(self.measured, limited.as_ref(), band, (alpha, self.options.window));
        match spectra.frequencies.is_empty() {
            true => Err(CalibrateError::Count {
                what: "frequencies of the fitted band",
                expected: "at least 1".into(),
                found: 0,
            }),
            false => Ok(spectra),
        }
    }

    /// Fits a band (Hz) under the window e^{-αt}, with the nominal modes up to `modes_hz`, and searches stray masses.
    fn widen(
        &mut self,
        band: [f64; 2],
        alpha: f64,
        modes_hz: f64,
        last: bool,
    ) -> Result<(Found, Spectra, usize), CalibrateError> {
        let [low, high] = band;
        Observed::here()
            .part(|| format!("{low:.0} to {high:.0} Hz{}", if last { ", for the last time" } else { "" }));
        let spectra = self.spectra(band, alpha)?;
        let count = self.basis.below(modes_hz);
        let mut layout = self.layout.clone();
        let mut found = self.case(&layout, &spectra, count).descend(&self.values, &self.expected, last)?;
        while found.excess > SUSPECT && layout.strays < self.options.strays {
            let Some((at, mass)) =
                self.case(&layout, &spectra, count).stray(&found, &self.nominal.outline)?
            else {
                break;
            };
            let mut more = layout.clone();
            more.strays += 1;
            Observed::here().part(|| format!("{low:.0} to {high:.0} Hz with {} stray masses", more.strays));
            let (start, expected) = (with(&found.values, at, mass), with(&self.expected, at, 0.0));
            let next = self.case(&more, &spectra, count).descend(&start, &expected, last)?;
            if next.excess > WORTH * found.excess {
                break;
            }
            (layout, found, self.expected) = (more, next, expected);
        }
        (self.layout, self.values) = (layout, found.values.clone());
        Ok((found, spectra, count))
    }
}

impl Fit<'_> {
    /// Modelled responses for the values found so far, limited to the measurement's band; `None` if the
    /// measurement is not limited.
    fn limited(&self) -> Result<Option<Limited>, CalibrateError> {
        let Some(band) = self.measured.pairs.as_ref().and_then(|pairs| pairs.limited) else {
            return Ok(None);
        };
        let modes = (self.basis.squares.len(), self.top);
        let signals = (band, self.measured.rate, self.measured.samples());
        Limited::new(self.basis, &self.layout, &self.values, modes, signals).map(Some)
    }

    fn case<'b>(&'b self, layout: &'b Layout, spectra: &'b Spectra, count: usize) -> Case<'b> {
        Case { basis: self.basis, layout, spectra, count, top: self.top }
    }
}

/// These values with one more stray mass (kg) at a place.
fn with(values: &Values, at: Point, mass: f64) -> Values {
    let mut more = values.clone();
    more.places.push(at);
    more.masses.push(mass);
    more.resistances.push(0.0);
    more
}

/// The values of the unknowns that the surface file says.
pub(super) fn nominal_values(surface: &Surface, basis: &Basis, layout: &Layout, top: f64) -> Values {
    let medium = Medium::of(&surface.sheet);
    let rate = |hz: f64| match &surface.sheet.decay {
        Decay::Time(time) => 1.0 / time,
        Decay::Table(table) => {
            let nearest = table.iter().min_by(|a, b| (a.0 - hz).abs().total_cmp(&(b.0 - hz).abs()));
            1.0 / nearest.map_or(0.1, |(_, time)| *time)
        }
        Decay::LossFactor(eta) => {
            let omega = TAU * hz;
            eta * medium.bending_share(medium.wavenumber(omega)) * omega / 2.0
        }
    };
    // The damping by the coil of an exciter is part of the impedance of its housing.
    let coil =
        |t: &Transducer| t.load.as_ref().filter(|load| load.housing.is_none()).and_then(|load| load.circuit);
    let gains = basis.gains();
    let mass = |(t, _): &(Transducer, Point)| t.load.as_ref().map_or(0.0, |load| load.mass);
    let resistance = |(t, _): &(Transducer, Point)| {
        coil(t).map_or(0.0, |coil| coil.force_constant.powi(2) / coil.resistance)
    };
    let none = vec![0.0; layout.strays];
    let loads = |of: &dyn Fn(&(Transducer, Point)) -> f64| {
        basis.transducers.iter().map(of).chain(none.iter().copied()).collect()
    };
    Values {
        tension: 0.0,
        bending: 0.0,
        skew: 0.0,
        profile: vec![0.0; layout.waves.len()],
        knots: KNOTS.iter().map(|share| rate(share * top).ln()).collect(),
        places: surface.actuators.iter().map(|a| a.at).collect(),
        masses: loads(&mass),
        resistances: loads(&resistance),
        drive: gains.clone(),
        sense: gains,
        level: 0.0,
        late: 0.0,
    }
}
