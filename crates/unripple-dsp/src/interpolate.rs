//! Polyphase interpolation of the modal sums from the reduced to the full sample rate, in SIMD lanes.

use pulp::NullaryFnOnce;
use unripple_linalg::Number;

/// Number of taps added at once, so that a sum is read and written once for four multiplications; the remaining taps of a
/// kernel are added one by one. With twice as many, sums are read half as often, but up to seven taps remain.
const TAPS: usize = 4;

/// A number that multiplies and adds in one instruction where the processor can.
pub(crate) trait Sample: Number {
    /// `sum + self · factor`.
    fn added(self, factor: Self, sum: Self) -> Self;
}

impl Sample for f32 {
    #[inline(always)]
    fn added(self, factor: Self, sum: Self) -> Self {
        self.mul_add(factor, sum)
    }
}

impl Sample for f64 {
    #[inline(always)]
    fn added(self, factor: Self, sum: Self) -> Self {
        self.mul_add(factor, sum)
    }
}

/// Interpolation of rows: out[n · step + p] = Σ_k weights[p][k] x[n + k] for each row.
pub(crate) struct Rows<'a, T> {
    /// The input, row by row: ⌈samples/step⌉ + taps - 1 reduced samples for each.
    pub(crate) x: &'a [T],
    /// The taps of each phase, phase by phase.
    pub(crate) weights: &'a [T],
    /// Number of phases.
    pub(crate) step: usize,
    /// The output, row by row: `samples` for each.
    pub(crate) out: &'a mut [T],
    /// Number of output samples of a row.
    pub(crate) samples: usize,
}

impl<T: Sample> NullaryFnOnce for Rows<'_, T> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let blocks = self.samples.div_ceil(self.step);
        let taps = self.weights.len() / self.step;
        let mut sums = vec![T::zero_impl(); blocks];
        let rows = self.x.chunks_exact(blocks + taps - 1).zip(self.out.chunks_exact_mut(self.samples));
        for (x, out) in rows {
            for (phase, weights) in self.weights.chunks_exact(taps).enumerate() {
                sums.fill(T::zero_impl());
                for (first, weights) in weights.chunks(TAPS).enumerate() {
                    add(&x[first * TAPS..], weights, &mut sums);
                }
                for (out, sum) in out[phase.min(self.samples)..].iter_mut().step_by(self.step).zip(&sums) {
                    *out = *sum;
                }
            }
        }
    }
}

/// Adds up to [`TAPS`] taps to all sums: sums[n] += Σ_k weights[k] x[n + k].
#[inline(always)]
fn add<T: Sample>(x: &[T], weights: &[T], sums: &mut [T]) {
    let n = sums.len();
    if let [a, b, c, d] = *weights {
        let shifted = x[..n].iter().zip(&x[1..=n]).zip(&x[2..n + 2]).zip(&x[3..n + 3]);
        for (sum, (((xa, xb), xc), xd)) in sums.iter_mut().zip(shifted) {
            *sum = xd.added(d, xc.added(c, xb.added(b, xa.added(a, *sum))));
        }
        return;
    }
    for (k, weight) in weights.iter().enumerate() {
        for (sum, x) in sums.iter_mut().zip(&x[k..k + n]) {
            *sum = x.added(*weight, *sum);
        }
    }
}
