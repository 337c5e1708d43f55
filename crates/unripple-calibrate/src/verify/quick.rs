//! The model that probed points are held against: fitted to what sensors heard, in a band of few modes, where that is quick.

use super::checker::Checker;
use super::verdict::VerifyOptions;
use crate::fit::{FitOptions, Fitted, Measured, Spectra, fit};
use faer::c64;
use std::f64::consts::{PI, TAU};
use unripple_core::{Point, SampledResponses, Surface};
use unripple_physics::Medium;

/// Actuators that are enough: more make the fit slow, and tell no more of a point.
const ENOUGH: usize = 10;

/// Fewest actuators, and lines of a spectrum, by which places are told apart.
const FEWEST: usize = 3;
const LINES: usize = 12;

/// Share of what sensors heard that a model may leave unexplained and still tell good points from bad ones.
const NO_MODEL: f64 = 0.35;

/// An actuator that is heard with less than this share of the median power is silent.
const SILENT: f64 = 1e-4;

/// Most half waves of the tension's profile.
const PROFILE: usize = 2;

/// Modes that are worked with, over those of the band: what is near an actuator is felt by many.
const REACH: f64 = 1.6;

/// A model, and what was heard at the points in its frequencies.
pub(super) struct Quick {
    pub fitted: Fitted,
    pub band: [f64; 2],
    /// Indices of the actuators that are looked at.
    pub actuators: Vec<usize>,
    pub frequencies: Vec<c64>,
    /// What sensors heard: of each, `[driven][frequency]`.
    pub sensed: Vec<Vec<Vec<c64>>>,
    /// What the probe heard at each point, `[driven][frequency]`.
    pub probed: Vec<Vec<Vec<c64>>>,
}

impl Quick {
    /// Fits the model; what speaks against one, in words, where there is none.
    pub fn new(
        surface: &Surface,
        measured: &Measured,
        probed: &SampledResponses,
        options: &VerifyOptions,
    ) -> Result<Self, String> {
        let Some(pairs) = &measured.pairs else { return Err("nothing was heard by actuators".into()) };
        let actuators = chosen(surface, measured, options);
        if actuators.len() < FEWEST {
            let (count, least) = (actuators.len(), FEWEST);
            return Err(format!("only {count} actuators hear each other, {least} are needed"));
        }
        let mut part = surface.clone();
        part.actuators = actuators.iter().map(|a| surface.actuators[*a].clone()).collect();
        let all = surface.actuators.len();
        let pair = |n: usize| {
            let (driven, heard) = (actuators[n / actuators.len()], actuators[n % actuators.len()]);
            pairs.responses[driven * all + heard].clone()
        };
        let mut heard = measured.clone();
        if let Some(own) = &mut heard.pairs {
            own.responses = (0..actuators.len().pow(2)).map(pair).collect();
        }
        let band = band(surface, measured, options.modes)?;
        part.emission.band = band;
        let plan = FitOptions {
            band: Some(band),
            profile: PROFILE,
            strays: 0,
            reach: REACH,
            ..FitOptions::default()
        };
        let fitted = fit(&part, &heard, &plan).map_err(|error| error.to_string())?;
        if fitted.unexplained() > NO_MODEL {
            return Err(format!(
                "{:.0} % of what actuators heard of each other between {:.0} and {:.0} Hz is left unexplained by the \
                 best there is",
                100.0 * fitted.unexplained(),
                band[0],
                band[1]
            ));
        }
        Self::of(fitted, &heard, probed, actuators, band)
    }

    /// Of a model that was fitted to all actuators before.
    pub fn known(
        fitted: &Fitted,
        surface: &Surface,
        measured: &Measured,
        probed: &SampledResponses,
        options: &VerifyOptions,
    ) -> Result<Self, String> {
        let band = band(surface, measured, options.modes)?;
        Self::of(fitted.clone(), measured, probed, (0..surface.actuators.len()).collect(), band)
    }

    fn of(
        fitted: Fitted,
        heard: &Measured,
        probed: &SampledResponses,
        actuators: Vec<usize>,
        band: [f64; 2],
    ) -> Result<Self, String> {
        let window = FitOptions::default().window;
        let (frequencies, sensed, probed) = spectra(heard, probed, &actuators, (band, window));
        if frequencies.len() < LINES {
            return Err(format!("responses are too short to tell modes apart: {} lines", frequencies.len()));
        }
        Ok(Self { fitted, band, actuators, frequencies, sensed, probed })
    }

    /// The model as it is compared.
    pub fn checker(&self) -> Checker<'_> {
        Checker::new(self.fitted.beyond(), &self.frequencies)
    }
}

/// Some actuators that drive and hear, far from each other.
fn chosen(surface: &Surface, measured: &Measured, options: &VerifyOptions) -> Vec<usize> {
    let all = surface.actuators.len();
    let pairs = measured.pairs.iter().flat_map(|p| &p.responses);
    let powers: Vec<f64> = pairs.map(|h| h.iter().map(|x| x * x).sum()).collect();
    let mut sorted: Vec<f64> = powers.iter().copied().filter(|p| *p > 0.0).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let least = SILENT * sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
    let best = |n: &dyn Fn(usize) -> usize| (0..all).map(n).map(|n| powers[n]).fold(0.0, f64::max);
    let works = |a: &usize| {
        best(&|b| a * all + b) > least && best(&|b| b * all + a) > least && !options.dead.contains(a)
    };
    let mut left: Vec<usize> = (0..all).filter(works).collect();
    if left.len() <= ENOUGH {
        return left;
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
    taken
}

/// The lowest frequencies that were measured whole, up to so many modes.
fn band(surface: &Surface, measured: &Measured, modes: usize) -> Result<[f64; 2], String> {
    let medium = Medium::of(&surface.sheet);
    let (area, rim) = (surface.outline.area(), surface.outline.perimeter());
    // Weyl's law, the rim held.
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

/// Frequencies, what sensors heard and what the probe heard.
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
