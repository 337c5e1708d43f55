//! What a model predicts at the probed places, line by line: for any drive, and for any tension.

use super::lines::{Lines, Spectrum};
use crate::{CalibrateError, Warp};
use rayon::prelude::*;
use unripple_core::{ModalResponses, Point, Pole, Responses};
use unripple_dsp::{Complex, resample};
use unripple_linalg::Mat;
use unripple_physics::Medium;

/// A model of a surface, evaluated at some places on the lines of a band.
#[derive(Debug)]
pub struct Model {
    lines: Lines,
    warp: Warp,
    kind: Kind,
    actuators: usize,
    places: usize,
}

#[derive(Debug)]
enum Kind {
    /// Modes, with their readout weights at the places, places x modes.
    Modal(Box<ModalResponses>, Mat<f64>),
    /// Sampled responses, `[place][actuator][sample]`, and the frequency in rad/s at which tension is taken to act.
    Sampled(Vec<Vec<Vec<f64>>>, f64),
}

/// The response of a pole to an impulse, as a function of the unit delay: step matrix and initial state.
struct Ringing {
    step: [[f64; 2]; 2],
    kick: [f64; 2],
}

impl Ringing {
    fn of(pole: &Pole, rate: f64) -> Self {
        Self { step: pole.step(1.0 / rate), kick: pole.kick() }
    }

    /// The z-transform of the velocity, all samples from the impulse on, where `back` is the unit delay z⁻¹: the velocity row of (1 - A
    /// z⁻¹)⁻¹ times the initial state.
    fn velocity(&self, back: Complex<f64>) -> Complex<f64> {
        let [[a, b], [c, d]] = self.step;
        let [u, v] = self.kick;
        let one = Complex::new(1.0, 0.0);
        let whole = (one - back * a) * (one - back * d) - back * back * (b * c);
        (back * (c * u) + (one - back * a) * v) / whole
    }
}

impl Model {
    /// A model at some places (m), from modes or from the stored points nearest to the places; `medium` is the sheet's, from which follows
    /// how frequencies depend on tension.
    ///
    /// # Errors
    /// [`CalibrateError::Count`] for no places, or for responses at no points.
    pub fn new(
        responses: &Responses,
        places: &[Point],
        medium: &Medium,
        lines: Lines,
    ) -> Result<Self, CalibrateError> {
        let none = |what| CalibrateError::Count { what, expected: "at least 1".into(), found: 0 };
        if places.is_empty() {
            return Err(none("probed places"));
        }
        let kind = match responses {
            Responses::Modal(modal) => Kind::Modal(Box::new(modal.clone()), modal.shapes.at_all(places)),
            Responses::Sampled(sampled) => {
                let at = |place: &Point| {
                    let point = sampled.nearest(*place).ok_or_else(|| none("points with responses"))?;
                    let one = |a| sampled.response(a, point).iter().map(|h| f64::from(*h)).collect();
                    Ok((0..sampled.ports.len()).map(one).collect::<Vec<Vec<f64>>>())
                };
                let all = places.iter().map(at).collect::<Result<Vec<_>, CalibrateError>>()?;
                let [low, high] = sampled.conditions.band;
                Kind::Sampled(all, std::f64::consts::PI * (low + high))
            }
        };
        let actuators = responses.ports().len();
        Ok(Self { lines, warp: Warp::new(medium), kind, actuators, places: places.len() })
    }

    /// Lines on which the model is evaluated.
    pub(super) fn lines(&self) -> &Lines {
        &self.lines
    }

    /// Number of actuators.
    pub(super) fn actuators(&self) -> usize {
        self.actuators
    }

    /// Number of places.
    pub(super) fn places(&self) -> usize {
        self.places
    }

    /// Whether the sheet has a tension, which may differ.
    pub(super) fn has_tension(&self) -> bool {
        self.warp.omega(1e3, 1.1) > 1e3
    }

    /// Spectra of the velocity at each place, weighted, for the spectra of a drive, under tension `ratio` times as large.
    pub(super) fn predict(&self, drive: &[Spectrum], ratio: f64) -> Vec<Spectrum> {
        match &self.kind {
            Kind::Modal(modal, readout) => {
                let ringing = self.ringing(modal, ratio);
                self.by_line(self.places, |line, out| {
                    let back = Complex::cis(-self.lines.turn(line));
                    for (m, ringing) in ringing.iter().enumerate() {
                        let force: Complex<f64> =
                            modal.input.col(m).iter().zip(drive).map(|(w, d)| d[line] * w).sum();
                        let moved = ringing.velocity(back) * force;
                        out.iter_mut().zip(readout.col(m).iter()).for_each(|(to, w)| *to += moved * w);
                    }
                })
            }
            Kind::Sampled(..) => self.sums(&self.responses(ratio), drive),
        }
    }

    /// Spectra of the responses under tension `ratio` times as large, weighted: that of an actuator at a place has the index
    /// place · actuators + actuator.
    pub(super) fn responses(&self, ratio: f64) -> Vec<Spectrum> {
        match &self.kind {
            Kind::Modal(modal, readout) => {
                let (ringing, actuators) = (self.ringing(modal, ratio), self.actuators);
                self.by_line(self.places * actuators, |line, out| {
                    let back = Complex::cis(-self.lines.turn(line));
                    for (m, ringing) in ringing.iter().enumerate() {
                        let velocity = ringing.velocity(back);
                        for (row, w) in out.chunks_exact_mut(actuators).zip(readout.col(m).iter()) {
                            let moved = velocity * w;
                            row.iter_mut()
                                .zip(modal.input.col(m).iter())
                                .for_each(|(to, w)| *to += moved * w);
                        }
                    }
                })
            }
            Kind::Sampled(all, omega) => {
                let step = self.warp.omega(*omega, ratio) / omega;
                let one = |response: &Vec<f64>| match ratio == 1.0 {
                    true => self.lines.weighted(response),
                    false => self.lines.weighted(&resample(response, step)),
                };
                let rate = self.lines.rate();
                let scaled = |spectrum: Spectrum| spectrum.iter().map(|x| x / rate).collect();
                all.par_iter()
                    .flat_map_iter(|place| place.iter().map(|response| scaled(one(response))))
                    .collect()
            }
        }
    }

    /// Sums over actuators of their responses times their drives, at each place.
    pub(super) fn sums(&self, responses: &[Spectrum], drive: &[Spectrum]) -> Vec<Spectrum> {
        let one = |own: &[Spectrum]| {
            let mut sum = vec![Complex::default(); self.lines.count()];
            for (h, d) in own.iter().zip(drive) {
                sum.iter_mut().zip(h).zip(d).for_each(|((to, h), d)| *to += h * d);
            }
            sum
        };
        responses.chunks_exact(self.actuators).map(one).collect()
    }

    fn ringing(&self, modal: &ModalResponses, ratio: f64) -> Vec<Ringing> {
        let rate = self.lines.rate();
        self.warp.modal(modal, ratio).poles.iter().map(|pole| Ringing::of(pole, rate)).collect()
    }

    /// `count` spectra, computed line by line: `fill` adds up the values of a line, which are then weighted.
    fn by_line(&self, count: usize, fill: impl Fn(usize, &mut [Complex<f64>]) + Sync) -> Vec<Spectrum> {
        let one = |line: usize| {
            let mut values = vec![Complex::default(); count];
            fill(line, &mut values);
            let factor = self.lines.weight(line) / self.lines.rate();
            values.iter_mut().for_each(|x| *x *= factor);
            values
        };
        let all: Vec<Vec<Complex<f64>>> = (0..self.lines.count()).into_par_iter().map(one).collect();
        (0..count).map(|n| all.iter().map(|values| values[n]).collect()).collect()
    }
}
