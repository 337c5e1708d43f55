//! Comparison of a model's responses at any place with measured ones, frequency by frequency.

use unripple_core::{ModalResponses, Point, Pole};
use unripple_linalg::{Mat, c64, product};

/// Responses of a model between its actuators and any place, prepared for comparison with measured
/// responses.
///
/// With w the actuators' weights, φ the shapes and μ the modes' mobilities, the model at x is Y_a(s) = Σ_m φ_m(x) w_am μ_m(s): linear
/// in φ(x). So is its inner product with a measured response, and its own power is a quadratic form of φ(x). Comparing a response
/// with all places of a sheet (matched-field processing) thus costs two products of matrices.
#[derive(Debug)]
pub(super) struct Checker<'a> {
    model: &'a ModalResponses,
    frequencies: &'a [c64],
    /// Mobility of each mode, modes x frequencies.
    mobilities: Mat<c64>,
    /// Matrix of the quadratic form of the shapes that is the model's power, modes x modes.
    gram: Mat<f64>,
}

/// Agreement of a measured response with the model's at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Match {
    /// Correlation of the measured response with the model's, from -1 to 1: 1 for responses that differ by a
    /// gain only.
    pub likeness: f64,
    /// Gain of the measured response, relative to the model's.
    pub gain: f64,
}

impl Match {
    /// Share of the measured response, as amplitude, that the model does not explain.
    pub fn unexplained(self) -> f64 {
        (1.0 - self.likeness.powi(2)).max(0.0).sqrt()
    }
}

/// Products of the measured responses at a point with the model's modes, modes x frequencies, and the power of the responses.
#[derive(Debug)]
pub(super) struct Projected {
    crossed: Mat<c64>,
    power: f64,
}

impl<'a> Checker<'a> {
    /// Prepares a model for comparison at complex frequencies (1/s) that all have the same real part.
    pub fn new(model: &'a ModalResponses, frequencies: &'a [c64]) -> Self {
        let mobilities = mobilities(&model.poles, frequencies);
        let modes = model.poles.len();
        let mut both = Mat::<f64>::zeros(modes, 2 * frequencies.len());
        for m in 0..modes {
            for n in 0..frequencies.len() {
                (both[(m, 2 * n)], both[(m, 2 * n + 1)]) = (mobilities[(m, n)].re, mobilities[(m, n)].im);
            }
        }
        let mut gram = product(both.as_ref(), both.transpose());
        let driven = product(model.input.transpose(), model.input.as_ref());
        for m in 0..modes {
            for n in 0..modes {
                gram[(m, n)] *= driven[(m, n)];
            }
        }
        Self { model, frequencies, mobilities, gram }
    }

    /// Projects spectra measured at a point, `[actuator][frequency]`, onto the model's modes.
    pub fn project(&self, spectra: &[Vec<c64>]) -> Projected {
        let (modes, count) = (self.mobilities.nrows(), self.frequencies.len());
        let mut crossed = Mat::<c64>::zeros(modes, count);
        for (a, spectrum) in spectra.iter().enumerate() {
            for n in 0..count {
                for m in 0..modes {
                    crossed[(m, n)] += spectrum[n] * self.model.input[(a, m)];
                }
            }
        }
        for n in 0..count {
            for m in 0..modes {
                crossed[(m, n)] *= self.mobilities[(m, n)].conj();
            }
        }
        Projected { crossed, power: spectra.iter().flatten().map(|y| y.norm_sqr()).sum() }
    }

    /// Inner products of the measured responses with the model's modes, for each assumed delay of the
    /// responses in `delays` (s): modes x delays.
    pub fn products(&self, heard: &Projected, delays: &[f64]) -> Mat<f64> {
        let turned = Mat::from_fn(self.frequencies.len(), delays.len(), |n, d| {
            c64::new(0.0, self.frequencies[n].im * delays[d]).exp()
        });
        let all = product(heard.crossed.as_ref(), turned.as_ref());
        Mat::from_fn(all.nrows(), all.ncols(), |m, d| all[(m, d)].re)
    }

    /// Power of the model's responses at some places, from the mode shapes there (places x modes).
    pub fn powers(&self, shapes: &Mat<f64>) -> Vec<f64> {
        let all = product(shapes.as_ref(), self.gram.as_ref());
        (0..shapes.nrows()).map(|p| (0..shapes.ncols()).map(|m| all[(p, m)] * shapes[(p, m)]).sum()).collect()
    }

    /// The model's mode shapes at some places, places x modes.
    pub fn shapes(&self, places: &[Point]) -> Mat<f64> {
        self.model.shapes.at_all(places)
    }

    /// Agreement of measured responses with the model at one place, for one assumed delay (s).
    pub fn at(&self, heard: &Projected, place: Point, delay: f64) -> Match {
        self.late(heard, place, &[delay]).first().copied().unwrap_or(Match { likeness: 0.0, gain: 0.0 })
    }

    /// Agreement of measured responses with the model at one place, for each of several assumed delays (s).
    pub fn late(&self, heard: &Projected, place: Point, delays: &[f64]) -> Vec<Match> {
        let shapes = self.shapes(&[place]);
        let power = self.powers(&shapes)[0];
        let products = shapes * self.products(heard, delays);
        let one = |(d, delay): (usize, &f64)| self.matched(products[(0, d)], power, heard, *delay);
        delays.iter().enumerate().map(one).collect()
    }

    /// Agreement with the model at a place, from an inner `product` of the measured and the modelled
    /// responses there and the model's `power`; `delay` (s) is that assumed for the product.
    pub fn matched(&self, product: f64, power: f64, heard: &Projected, delay: f64) -> Match {
        let alpha = self.frequencies.first().map_or(0.0, |s| s.re);
        let both = (power * heard.power).sqrt();
        match both > 0.0 && both.is_finite() {
            true => Match { likeness: product / both, gain: product / power * (alpha * delay).exp() },
            false => Match { likeness: 0.0, gain: 0.0 },
        }
    }
}

/// Velocity per force of each mode, modes x frequencies.
fn mobilities(poles: &[Pole], frequencies: &[c64]) -> Mat<c64> {
    Mat::from_fn(poles.len(), frequencies.len(), |m, n| {
        let (pole, s) = (&poles[m], frequencies[n]);
        s / (s * s + s * (2.0 * pole.sigma) + pole.omega * pole.omega)
    })
}
