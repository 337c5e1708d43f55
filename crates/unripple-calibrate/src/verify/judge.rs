//! The verdict on each probed point, by comparison with the model.

use super::checker::{Match, Projected};
use super::quick::Quick;
use super::sheet::{Sheet, Spot};
use super::verdict::VerifyOptions;
use rayon::prelude::*;
use unripple_core::{Point, Surface};
use unripple_dsp::median;

/// Largest unexplained share, as amplitude, of a response that fits the model: `UNLIKE`, or `TIMES` that of the sensors'
/// responses if that is larger.
const UNLIKE: f64 = 0.4;
const TIMES: f64 = 2.5;

/// Smallest and largest delay that are searched, in s: delays of a probe's electronics, and of recordings
/// that lost samples.
const DELAYS: [f64; 2] = [-2e-3, 12e-3];

/// Smallest delay of a probe that is corrected, in periods of the band's top: 5.4 degrees of phase there, which costs a
/// focus 0.5 % of its height at most; half as much would correct what is noise.
const TURNED: f64 = 0.015;

/// Largest number of points from which the probe's delay is found: more take longer and change it little.
const TELLING: usize = 24;

/// Distance, in shortest wavelengths compared, within which a place counts as that of a point or actuator.
const NEAR: f64 = 0.2;

/// Result of the verification of one probed point: how well its responses fit the model, and at which place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judged {
    /// Agreement of the point's responses with the model at the stated place and the common delay.
    pub own: Match,
    /// The place near the stated one, and the delay, at which the responses fit the model best.
    pub nearby: Spot,
    /// Estimated error of the place in `nearby` along each axis, in metres.
    pub error: f64,
    /// Whether the responses fit the stated place, another place, or none.
    pub kind: Kind,
}

/// Whether a point's responses fit its place, another place, or none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// The responses fit the stated place of the point, or one close by.
    Here,
    /// The responses fit another place of the sheet: that place, and the point or actuator there.
    Elsewhere(Spot, Whose),
    /// The responses fit the stated place, but with a delay that differs from that of the other points by this time, in s.
    Late(f64),
    /// The responses fit no place of the surface.
    Nothing,
}

/// What is at a place of the sheet: a probed point, an actuator, or neither.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Whose {
    /// Another probed point, by its index.
    Point(usize),
    /// An actuator, by its index.
    Actuator(usize),
    /// Neither a probed point nor an actuator.
    Nobody,
}

/// The references with which points are compared: model, places, options.
pub(super) struct Bench<'a> {
    /// The fitted model, and the measured spectra at its frequencies.
    pub quick: &'a Quick,
    /// Places all over the sheet, among which the place that fits a response is searched.
    pub sheet: &'a Sheet<'a>,
    /// The surface as its file describes it.
    pub surface: &'a Surface,
    /// Stated places of the points, in m.
    pub places: &'a [Point],
    /// Options of the check.
    pub options: &'a VerifyOptions,
    /// Shortest wavelength that is compared, in metres.
    pub wave: f64,
}

impl Bench<'_> {
    /// Largest share of a good point's responses, as amplitude, that the model may leave unexplained.
    pub fn limit(&self) -> f64 {
        UNLIKE.max(TIMES * self.quick.fitted.unexplained()).min(0.8)
    }

    fn removed(&self, point: usize) -> f64 {
        self.options.removed.get(point).copied().unwrap_or(0.0)
    }

    /// The delay (s) at which most points fit some place of the sheet.
    pub fn common(&self, heard: &[Projected]) -> f64 {
        let none = self.quick.fitted.late.value;
        let here = |late: f64| {
            let good = |p: &usize| {
                let late = late - self.removed(*p);
                self.sheet.checker.at(&heard[*p], self.places[*p], late).unexplained() < self.limit()
            };
            (0..heard.len()).filter(good).count()
        };
        let delays = self.sheet.delays(DELAYS[0], DELAYS[1]);
        let step = heard.len().div_ceil(TELLING).max(1);
        let tables: Vec<Vec<f64>> = (0..heard.len())
            .step_by(step)
            .collect::<Vec<_>>()
            .into_par_iter()
            .map(|p| {
                let own: Vec<f64> = delays.iter().map(|late| late - self.removed(p)).collect();
                self.sheet.largest_correlations(&heard[p], &own)
            })
            .collect();
        let sum = |d: usize| tables.iter().map(|t| t[d]).sum::<f64>();
        let best = (0..delays.len()).max_by(|a, b| sum(*a).total_cmp(&sum(*b))).map_or(none, |d| delays[d]);
        let start = if 2 * here(none) > heard.len() && here(none) >= here(best) { none } else { best };
        // Then finely, by the median over the points that fit there.
        let mut all: Vec<f64> = (0..heard.len())
            .into_par_iter()
            .filter_map(|p| {
                let late = start - self.removed(p);
                let own = self.sheet.nearby(&heard[p], self.places[p], late, 0.1 * self.wave);
                (own.found.unexplained() < self.limit()).then_some(own.late + self.removed(p))
            })
            .collect();
        all.sort_unstable_by(f64::total_cmp);
        match all.len() {
            0 => start,
            n => 0.5 * (all[(n - 1) / 2] + all[n / 2]),
        }
    }

    /// Judges one point, given the delay (s) common to all points.
    pub fn judge(&self, point: usize, heard: &Projected, common: f64) -> Judged {
        let (at, late) = (self.places[point], common - self.removed(point));
        let own = self.sheet.checker.at(heard, at, late);
        let nearby = self.sheet.nearby(heard, at, late, 0.1 * self.wave);
        let judged = |kind| Judged { own, nearby, error: self.error(&nearby), kind };
        if nearby.found.unexplained() < self.limit() && nearby.at.distance(at) < 0.5 * self.wave {
            return judged(Kind::Here);
        }
        if let Some(spot) = self.sheet.anywhere(heard, late).filter(|s| s.found.unexplained() < self.limit())
        {
            return judged(Kind::Elsewhere(spot, self.whose(point, spot.at)));
        }
        let delays = self.sheet.delays(DELAYS[0] - 0.02, DELAYS[1] + 0.02);
        let best = self.sheet.best_delay(heard, at, &delays);
        if let Some(spot) = best.filter(|s| s.found.unexplained() < self.limit()) {
            let spot = self.sheet.nearby(heard, at, spot.late, 0.02 * self.wave);
            return judged(Kind::Late(spot.late - late));
        }
        judged(Kind::Nothing)
    }

    /// Smallest delay (s) of a probe that is corrected: it exceeds the error of the fit, and shifts the
    /// phase at the top of the band by some degrees.
    pub fn worth(&self, judged: &[Judged]) -> f64 {
        let left = median(judged.iter().map(|j| j.nearby.found.unexplained())).unwrap_or(1.0);
        let turn = std::f64::consts::TAU * self.quick.band[1];
        let told = 5.0 * left / turn * self.told();
        told.max(TURNED / self.surface.emission.band[1])
    }

    /// Factor by which the number of modes reduces the error of a delay found by a fit.
    fn told(&self) -> f64 {
        (8.0 / self.quick.fitted.all_modes().poles.len().max(4) as f64).sqrt()
    }

    /// Error (m) of a place along each axis: the displacement that leaves as much unexplained as the model does. Along one axis the mean
    /// square of the wavenumber is a quarter of its square at the band's top.
    fn error(&self, spot: &Spot) -> f64 {
        let k = std::f64::consts::TAU / self.wave;
        2.0 * spot.found.unexplained() / k
    }

    fn whose(&self, point: usize, at: Point) -> Whose {
        let near = NEAR * self.wave;
        let closest = |places: &mut dyn Iterator<Item = (usize, Point)>| {
            places
                .map(|(n, p)| (n, p.distance(at)))
                .filter(|(_, d)| *d < near)
                .min_by(|a, b| a.1.total_cmp(&b.1))
        };
        let others = &mut self.places.iter().copied().enumerate().filter(|(n, _)| *n != point);
        let actuators = &mut self.surface.actuators.iter().map(|a| a.at).enumerate();
        match (closest(others), closest(actuators)) {
            (Some((n, d)), other) if other.is_none_or(|(_, e)| d <= e) => Whose::Point(n),
            (_, Some((a, _))) => Whose::Actuator(a),
            _ => Whose::Nobody,
        }
    }
}
