//! Modal synthesis: impulse responses from poles and weights.

use crate::DspError;
use crate::interpolate::{Rows, Sample};
use crate::kernel::Kernel;
use pulp::Arch;
use rayon::prelude::*;
use std::f64::consts::PI;
use unripple_core::Pole;
use unripple_linalg::{Accum, Mat, MatMut, MatRef, Par, multiply};

/// Number of rows that one thread works on at once, so that they share what is read of the modal velocities. With twice this value, there
/// are half as many tasks for the threads, and each holds twice the samples.
const ROWS: usize = 128;

/// Least number of rows for which interpolation is done for all rows together, as a matrix product, rather than row by row:
/// with fewer, the product is inefficient. Doubled, 24 to 47 rows are done row by row; the results stay the same but for
/// rounding.
const MANY: usize = 24;

/// Number of reduced samples in a strip of time for the interpolation of all rows together: the strip is multiplied by a
/// band matrix that has `taps` nonzeros in a column of `taps + 5`. With twice this value, there are fewer products with a greater share of
/// multiplications by zero.
const STRIP: usize = 6;

/// Largest ratio of full to reduced sample rate that is tried. With twice this value, plans take twice as long and gain
/// only where all modes lie below a 64th of half the sample rate.
const MOST: usize = 64;

/// A plan that turns modal weights W into sampled velocity responses h = W · g, where g is the velocity of each mode after a
/// unit impulse ([`Pole::velocity`]).
///
/// Modal frequencies are usually far below the sample rate, so the product is evaluated at a reduced rate and then
/// interpolated. The decaying oscillations are continued analytically before t = 0 and past the last sample, so that both
/// ends are as accurate as the middle. Modes too strongly damped or too high in frequency for the reduced rate are summed at
/// the full rate.
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

/// The tables of a plan, in double or single precision.
#[derive(Debug)]
struct Tables<T> {
    /// Indices of the modes summed at the reduced rate, ascending.
    slow: Vec<usize>,
    /// Velocities of the `slow` modes, reduced samples x modes.
    reduced: Mat<T>,
    /// Interpolation weights, taps x phases.
    weights: Mat<T>,
    /// The interpolation weights as a band matrix for a strip of output: (strip + taps - 1) x (strip · phases).
    strip: Mat<T>,
    /// Indices of the modes summed at the full rate, ascending.
    fast: Vec<usize>,
    /// Velocities of the `fast` modes, samples x modes.
    full: Mat<T>,
}

impl ModalSynth {
    /// A plan for responses of `samples` samples at `rate` samples per second. The error of each mode's part of a response is at
    /// most `accuracy` (dimensionless, at least 1e-14) times the magnitude of its weight times its envelope e^{-σt}.
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

    /// Ratio of the full to the reduced sample rate; 1 if all modes are summed at the full rate.
    pub fn step(&self) -> usize {
        self.double.weights.ncols()
    }

    /// Number of multiplications and additions needed for each response (each row of weights).
    pub fn operations(&self) -> usize {
        let tables = &self.double;
        let interpolation = if tables.slow.is_empty() { 0 } else { self.samples * tables.weights.nrows() };
        2 * (tables.reduced.nrows() * tables.slow.len() + interpolation + self.samples * tables.fast.len())
    }

    /// Computes responses for `weights` (rows x modes) into `out` (rows x samples, row by row). More than 128 rows are shared
    /// among threads.
    ///
    /// # Errors
    /// [`DspError::Size`] if `weights` does not have a column for each mode, or if `out` has another length.
    pub fn respond(&self, weights: MatRef<'_, f64>, out: &mut [f64]) -> Result<(), DspError> {
        self.check(weights.nrows(), weights.ncols(), out.len())?;
        self.double.respond(weights, out, self.samples);
        Ok(())
    }

    /// Computes responses as [`ModalSynth::respond`] does, `weights` (rows x modes) to `out` (rows x samples), in single precision
    /// throughout, for large tables of sampled responses. Rounding adds an error of about 1e-6 times the sum of the magnitudes of
    /// the weights.
    ///
    /// # Errors
    /// [`DspError::Size`] if `weights` does not have a column for each mode, or if `out` has another length.
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
    /// Responses of all rows; more than [`ROWS`] are shared among threads.
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

    /// Responses of at most [`ROWS`] rows, on one thread.
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

    /// Interpolates all rows together, one strip of time after another.
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

/// The product of the weights of some modes (columns `modes` of rows x all modes) and their velocities (n x those modes), into
/// `out` (rows x n, row by row).
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

/// The interpolation kernel with the fewest operations, and the indices, ascending, of the modes for which
/// it is accurate.
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
            // Modes nearer to half the reduced rate need more taps than the lower rate saves.
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
