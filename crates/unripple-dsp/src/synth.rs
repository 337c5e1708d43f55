//! Modal synthesis: impulse responses from poles and weights.

use crate::DspError;
use crate::interpolate::{Rows, Sample};
use crate::kernel::Kernel;
use pulp::Arch;
use rayon::prelude::*;
use std::f64::consts::PI;
use unripple_core::Pole;
use unripple_linalg::{Accum, Mat, MatMut, MatRef, Par, multiply};

/// Rows that one thread works on at once: so many share what is read of the velocities. Doubled, there are
/// half as many tasks for the threads, and each holds twice the samples.
const ROWS: usize = 128;

/// From this many rows on, interpolation runs across rows, as a matrix product, rather than along time: fewer
/// rows do not fill the product. Doubled, 24 to 47 rows go the other way; the sums stay the same but for
/// rounding.
const MANY: usize = 24;

/// Reduced samples to a strip where it runs across rows: the product is taken with a band matrix of which
/// `taps` of `taps + 5` rows are filled. Doubled, fewer products are made, of which more is multiplication by
/// zero.
const STRIP: usize = 6;

/// The lowest reduced rate tried is this part of the full one. Doubled, plans take twice as long and gain
/// only where all modes lie below a 64th of half the sample rate.
const MOST: usize = 64;

/// Turns modal weights into sampled velocity responses: h = W · g, with g the velocity of each mode after an impulse.
///
/// Modes ring far below the sample rate, so the product is taken at a fraction of it and interpolated band-limitedly.
/// Damped modes go on analytically before t = 0 and past the last sample, which makes both ends exact. Modes that
/// are too damped or too high for that are summed directly.
///
/// ```
/// use unripple_linalg::mat;
/// use unripple_core::Pole;
/// use unripple_dsp::ModalSynth;
///
/// let poles = [Pole::new(2000.0, 10.0), Pole::new(9000.0, 30.0)];
/// let synth = ModalSynth::new(&poles, 48e3, 100, 1e-6);
/// let mut response = [0.0; 100];
/// synth.respond(mat![[3.0, 2.0]].as_ref(), &mut response)?;
/// let t = 7.0 / 48e3;
/// assert!((response[7] - 3.0 * poles[0].velocity(t) - 2.0 * poles[1].velocity(t)).abs() < 5e-6);
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Debug)]
pub struct ModalSynth {
    samples: usize,
    modes: usize,
    double: Tables<f64>,
    single: Tables<f32>,
}

/// Everything the products need, at one precision.
#[derive(Debug)]
struct Tables<T> {
    /// Modes summed at the reduced rate, in order.
    slow: Vec<usize>,
    /// Their velocities, reduced samples x modes.
    reduced: Mat<T>,
    /// Interpolation weights, taps x phases.
    weights: Mat<T>,
    /// The same for a strip of output: (strip + taps - 1) x (strip · phases).
    strip: Mat<T>,
    /// Modes summed at the full rate.
    fast: Vec<usize>,
    /// Their velocities, samples x modes.
    full: Mat<T>,
}

impl ModalSynth {
    /// A plan for `samples` samples at `rate` per second. A response differs from the direct sum by at most `accuracy`
    /// (raised to 1e-14) times the sum of the magnitudes of its weights, growing with e^{-σt} only.
    pub fn new(poles: &[Pole], rate: f64, samples: usize, accuracy: f64) -> Self {
        let accuracy = if accuracy >= 1e-14 { accuracy } else { 1e-14 };
        let (kernel, slow) = plan(poles, rate, samples, accuracy);
        let fast: Vec<usize> = (0..poles.len()).filter(|m| slow.binary_search(m).is_err()).collect();
        let (step, taps, lead) = (kernel.step, kernel.taps(), kernel.lead() as f64);
        let blocks = samples.div_ceil(step);
        let reduced = Mat::from_fn(blocks + taps - 1, slow.len(), |i, m| {
            poles[slow[m]].velocity((i as f64 - lead) * step as f64 / rate)
        });
        let strip = Mat::from_fn(STRIP + taps - 1, STRIP * step, |i, out| {
            let (block, phase) = (out / step, out % step);
            if (block..block + taps).contains(&i) { kernel.weights[(i - block, phase)] } else { 0.0 }
        });
        let full = Mat::from_fn(samples, fast.len(), |i, m| poles[fast[m]].velocity(i as f64 / rate));
        let double = Tables { slow, reduced, weights: kernel.weights, strip, fast, full };
        Self { samples, modes: poles.len(), single: double.narrowed(), double }
    }

    /// Number of samples in each response.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Full-rate samples from one sample that is summed to the next; 1 where all modes are summed directly.
    pub fn step(&self) -> usize {
        self.double.weights.ncols()
    }

    /// Multiplications and additions for each row.
    pub fn operations(&self) -> usize {
        let tables = &self.double;
        let interpolation = if tables.slow.is_empty() { 0 } else { self.samples * tables.weights.nrows() };
        2 * (tables.reduced.nrows() * tables.slow.len() + interpolation + self.samples * tables.fast.len())
    }

    /// Responses for `weights` (rows x modes), into `out` (rows x samples, row by row). More than 128 rows run in parallel.
    ///
    /// # Errors
    /// [`DspError::Size`] if columns or lengths do not match.
    pub fn respond(&self, weights: MatRef<'_, f64>, out: &mut [f64]) -> Result<(), DspError> {
        self.check(weights.nrows(), weights.ncols(), out.len())?;
        self.double.respond(weights, out, self.samples);
        Ok(())
    }

    /// The same in single precision throughout, for libraries; rounding adds about 1e-6 of the sum of magnitudes.
    ///
    /// # Errors
    /// [`DspError::Size`] if columns or lengths do not match.
    pub fn respond_f32(&self, weights: MatRef<'_, f32>, out: &mut [f32]) -> Result<(), DspError> {
        self.check(weights.nrows(), weights.ncols(), out.len())?;
        self.single.respond(weights, out, self.samples);
        Ok(())
    }

    /// Refuses weights that are not rows x modes, or an output that is not rows x samples.
    fn check(&self, rows: usize, columns: usize, length: usize) -> Result<(), DspError> {
        if columns != self.modes {
            return Err(DspError::Size {
                what: "weights of a response",
                expected: self.modes,
                found: columns,
            });
        }
        if length != rows * self.samples {
            return Err(DspError::Size {
                what: "samples of all responses",
                expected: rows * self.samples,
                found: length,
            });
        }
        Ok(())
    }
}

impl Tables<f64> {
    /// The same tables rounded to single precision.
    fn narrowed(&self) -> Tables<f32> {
        let narrow = |m: &Mat<f64>| Mat::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)] as f32);
        Tables {
            slow: self.slow.clone(),
            reduced: narrow(&self.reduced),
            weights: narrow(&self.weights),
            strip: narrow(&self.strip),
            fast: self.fast.clone(),
            full: narrow(&self.full),
        }
    }
}

impl<T: Sample> Tables<T> {
    /// Responses of all rows, those beyond [`ROWS`] shared among threads.
    fn respond(&self, weights: MatRef<'_, T>, out: &mut [T], samples: usize) {
        if samples == 0 || out.is_empty() {
            return;
        }
        let work = |(chunk, out): (usize, &mut [T])| {
            let rows = out.len() / samples;
            self.respond_rows(weights.subrows(chunk * ROWS, rows), out, samples);
        };
        if weights.nrows() > ROWS {
            out.par_chunks_mut(ROWS * samples).enumerate().for_each(work);
        } else {
            work((0, out));
        }
    }

    /// A few rows, on one thread.
    fn respond_rows(&self, weights: MatRef<'_, T>, out: &mut [T], samples: usize) {
        let rows = weights.nrows();
        let mut accum = Accum::Replace;
        if !self.slow.is_empty() {
            let columns = self.reduced.nrows();
            let mut x = vec![T::zero_impl(); rows * columns];
            product(&mut x, Accum::Replace, weights, &self.slow, self.reduced.as_ref());
            if rows < MANY {
                self.along_time(&x, out, samples)
            } else {
                self.across_rows(&x, out, samples)
            }
            accum = Accum::Add;
        }
        if !self.fast.is_empty() {
            product(out, accum, weights, &self.fast, self.full.as_ref());
        } else if self.slow.is_empty() {
            out.fill(T::zero_impl());
        }
    }

    /// Interpolates row by row.
    fn along_time(&self, x: &[T], out: &mut [T], samples: usize) {
        let step = self.weights.ncols();
        let phases: Vec<T> = self.weights.col_iter().flat_map(|phase| phase.iter().copied()).collect();
        Arch::new().dispatch(Rows { x, weights: &phases, step, out, samples });
    }

    /// Interpolates all rows a strip of time at a time.
    fn across_rows(&self, x: &[T], out: &mut [T], samples: usize) {
        let (taps, step) = self.weights.shape();
        let columns = self.reduced.nrows();
        let rows = x.len() / columns;
        let x = MatRef::from_row_major_slice(x, rows, columns);
        let mut out = MatMut::from_row_major_slice_mut(out, rows, samples);
        for first in (0..samples).step_by(STRIP * step) {
            let width = (samples - first).min(STRIP * step);
            let block = first / step;
            let height = width.div_ceil(step) + taps - 1;
            let strip = self.strip.submatrix(0, 0, height, width);
            let out = out.as_mut().subcols_mut(first, width);
            multiply(out, Accum::Replace, x.subcols(block, height), strip, T::one_impl(), Par::Seq);
        }
    }
}

/// out (rows x n, row by row) from the weights of some modes (rows x all modes) and their velocities (n x modes).
fn product<T: Sample>(
    out: &mut [T],
    accum: Accum,
    weights: MatRef<'_, T>,
    modes: &[usize],
    velocities: MatRef<'_, T>,
) {
    let out = MatMut::from_row_major_slice_mut(out, weights.nrows(), velocities.nrows());
    if modes.len() == weights.ncols() {
        multiply(out, accum, weights, velocities.transpose(), T::one_impl(), Par::Seq);
    } else {
        let some = Mat::from_fn(weights.nrows(), modes.len(), |r, m| weights[(r, modes[m])]);
        multiply(out, accum, some.as_ref(), velocities.transpose(), T::one_impl(), Par::Seq);
    }
}

/// The kernel of least work, and the modes it is accurate for, ascending.
fn plan(poles: &[Pole], rate: f64, samples: usize, accuracy: f64) -> (Kernel, Vec<usize>) {
    let mut best = (Kernel::new(1, 1, 0.0), Vec::new());
    let mut least = samples * poles.len();
    let top = poles.iter().filter(|p| p.omega < PI * rate).map(|p| p.omega).fold(0.0, f64::max);
    for step in 2..=MOST {
        let fill = top * step as f64 / (PI * rate);
        let (half, beta) = Kernel::size(fill.min(0.98), accuracy);
        for half in half..half + 3 {
            let sums = (samples.div_ceil(step) + 2 * half - 1) * poles.len();
            // Interpolation runs at about half the speed of the large product.
            let cost = sums + 2 * 2 * half * samples;
            // Nearer to half the reduced rate, the transition takes more taps than it saves sums.
            if fill >= 0.98 || cost >= least {
                break;
            }
            let kernel = Kernel::new(step, half, beta);
            let slow: Vec<usize> =
                (0..poles.len()).filter(|m| kernel.error(poles[*m], rate) <= accuracy).collect();
            let cost = cost + (poles.len() - slow.len()) * samples;
            if cost < least {
                least = cost;
                best = (kernel, slow);
            }
        }
    }
    best
}
