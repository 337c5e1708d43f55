//! Mean square felt displacement of the surface, as a quadratic form in the drive's spline coefficients.

use super::lines::Lines;
use unripple_dsp::Complex;
use unripple_linalg::{Accum, Mat, MatRef, all_threads, multiply};

/// Number of values in memory at once while frequency lines are summed, 32 MiB of them. With twice this
/// value, twice the memory and half the blocks, whose sums differ by rounding.
const VALUES_AT_ONCE: usize = 1 << 22;

/// Spectra of the motion of modes that actuators drive with spline signals.
#[derive(Clone, Debug)]
pub(crate) struct Actuation<'a> {
    /// The frequency lines at which the spectra are given.
    pub lines: &'a Lines,
    /// Spectrum of every spline at the frequency lines.
    pub splines: Vec<Vec<Complex<f64>>>,
    /// Displacement per drive of every mode, at the frequency lines.
    pub modes: Vec<Vec<Complex<f64>>>,
    /// Input weights, actuators x modes.
    pub input: Mat<f64>,
}

impl Actuation<'_> {
    /// Real parts of the splines' spectra, above their imaginary parts: 2 lines x splines.
    fn parts(&self) -> Mat<f64> {
        let lines = self.lines.count();
        Mat::from_fn(2 * lines, self.splines.len(), |i, k| {
            if i < lines { self.splines[k][i].re } else { self.splines[k][i - lines].im }
        })
    }

    /// Squared threshold-weighted displacement, integrated over all time (in s) and averaged over the
    /// surface, as a quadratic form in the spline coefficients (`[actuator][spline]`): by Parseval's theorem
    /// a sum over lines.
    ///
    /// `products` are the means over the surface of the products of any two shapes.
    pub fn background(&self, products: MatRef<'_, f64>) -> Mat<f64> {
        let (ports, splines, lines) = (self.input.nrows(), self.splines.len(), self.lines.count());
        let powers = self.powers(products);
        let parts = self.parts();
        let mut form = Mat::zeros(ports * splines, ports * splines);
        for a in 0..ports {
            for b in a..ports {
                let power = |line: usize| powers[line * ports * ports + a * ports + b];
                let turned = Mat::from_fn(2 * lines, splines, |i, k| {
                    let line = i % lines;
                    let turned = self.splines[k][line] * power(line);
                    if i < lines { turned.re } else { turned.im }
                });
                let block = form.as_mut().submatrix_mut(a * splines, b * splines, splines, splines);
                multiply(block, Accum::Replace, parts.transpose(), turned.as_ref(), 1.0, all_threads());
            }
        }
        // Exactly symmetric, whatever was rounded.
        for j in 0..form.ncols() {
            for i in 0..j {
                form[(j, i)] = form[(i, j)];
            }
        }
        form
    }

    /// At each line, the mean over the surface of conj(motion by one actuator) · motion by another, times
    /// the squared threshold weight: `[line][actuator][actuator]`.
    fn powers(&self, products: MatRef<'_, f64>) -> Vec<Complex<f64>> {
        let (ports, modes, lines) = (self.input.nrows(), self.modes.len(), self.lines.count());
        let mut powers = Vec::with_capacity(lines * ports * ports);
        let at_once = (VALUES_AT_ONCE / (ports * modes).max(1)).max(1);
        for first in (0..lines).step_by(at_once) {
            let count = at_once.min(lines - first);
            // Columns are [line][actuator], real parts before imaginary ones.
            let motion = Mat::from_fn(modes, 2 * count * ports, |m, column| {
                let (imaginary, at) = (column / (count * ports), column % (count * ports));
                let mode = self.modes[m][first + at / ports];
                self.input[(at % ports, m)] * if imaginary == 0 { mode.re } else { mode.im }
            });
            let mut spread = Mat::zeros(modes, motion.ncols());
            multiply(spread.as_mut(), Accum::Replace, products, motion.as_ref(), 1.0, all_threads());
            let dot = |i: usize, j: usize| dot(motion.col_as_slice(i), spread.col_as_slice(j));
            for at in 0..count {
                let (line, share) = (first + at, self.lines.share(first + at) / self.lines.rate);
                let weight = share * self.lines.gains[line].powi(2);
                for a in 0..ports {
                    for b in 0..ports {
                        let (a, b) = (at * ports + a, at * ports + b);
                        let [ai, bi] = [a, b].map(|x| count * ports + x);
                        let power = Complex::new(dot(a, b) + dot(ai, bi), dot(a, bi) - dot(ai, b));
                        powers.push(power * weight);
                    }
                }
            }
        }
        powers
    }

    /// Cosines and negative sines of the phase of each frequency line at some samples of the drive, for
    /// [`Actuation::motion`]: samples x 2 lines.
    pub fn phases(&self, samples: &[i64]) -> Mat<f64> {
        let lines = self.lines.count();
        Mat::from_fn(samples.len(), 2 * lines, |t, i| {
            let phase = self.lines.phase(i % lines, samples[t]);
            if i < lines { phase.cos() } else { -phase.sin() }
        })
    }

    /// Threshold-weighted displacement of one mode for each spline as the modal force, at the samples of
    /// `phases`: samples x splines.
    pub fn motion(&self, mode: usize, phases: &Mat<f64>) -> Mat<f64> {
        let lines = self.lines.count();
        let turned = Mat::from_fn(2 * lines, self.splines.len(), |i, k| {
            let line = i % lines;
            let value = self.splines[k][line] * self.modes[mode][line];
            let weight = self.lines.share(line) * self.lines.gains[line];
            weight * if i < lines { value.re } else { value.im }
        });
        let mut motion = Mat::zeros(phases.nrows(), self.splines.len());
        multiply(motion.as_mut(), Accum::Replace, phases.as_ref(), turned.as_ref(), 1.0, all_threads());
        motion
    }
}

/// The sum Σ a·b over the length of the shorter slice.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Eight sums side by side, which a compiler may keep in one register.
    let mut sums = [0.0; 8];
    let (a8, b8) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a8.remainder().iter().zip(b8.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a8.zip(b8) {
        sums.iter_mut().zip(x.iter().zip(y)).for_each(|(s, (x, y))| *s += x * y);
    }
    sums.iter().sum::<f64>() + rest
}
