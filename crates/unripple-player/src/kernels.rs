//! Loops over samples of one actuator, vectorised by the compiler (SIMD).

use pulp::NullaryFnOnce;

/// Samples worked on at once: the float32 numbers of a 512-bit register. With twice this value, results of sums differ by
/// rounding.
const LANES: usize = 16;

/// Work for [`pulp::Arch::dispatch`]: a closure that changes what it captures, itself `#[inline(always)]`, is compiled for what the
/// machine has only when it is called as `FnMut`, not through the compiler's shim for `FnOnce`.
pub(crate) struct Wide<F>(pub(crate) F);

impl<R, F: FnMut() -> R> NullaryFnOnce for Wide<F> {
    type Output = R;

    #[inline(always)]
    fn call(mut self) -> R {
        (self.0)()
    }
}

type Lanes = [f32; LANES];

/// Largest of the two bounds (samples in the actuator's unit) once `gain` times the drive has come on top.
#[inline(always)]
pub(crate) fn highest(positive: &[f32], negative: &[f32], drive: &[f32], gain: f32) -> f32 {
    fold3(
        positive,
        negative,
        drive,
        0.0,
        |worst, p, n, d| {
            let x = gain * d;
            larger(worst, larger(p + above(x), n + above(-x)))
        },
        larger,
    )
}

/// Largest factor, at least 0, with which a drive of this sign fits under the limit at every sample; infinite for a silent drive.
#[inline(always)]
pub(crate) fn room(positive: &[f32], negative: &[f32], drive: &[f32], sign: f32, limit: f32) -> f32 {
    fold3(
        positive,
        negative,
        drive,
        f32::INFINITY,
        |least, p, n, d| {
            let x = sign * d;
            let held = if x > 0.0 { p } else { n };
            let free = above(limit - held) / x.abs();
            smaller(least, if x == 0.0 { f32::INFINITY } else { free })
        },
        smaller,
    )
}

/// Puts `gain` times a drive (samples in the actuator's unit) on top of the bounds.
#[inline(always)]
pub(crate) fn enter(positive: &mut [f32], negative: &mut [f32], drive: &[f32], gain: f32) {
    for ((p, n), &d) in positive.iter_mut().zip(negative).zip(drive) {
        let x = gain * d;
        *p += above(x);
        *n += above(-x);
    }
}

/// Energy of the larger of the two bounds, sample by sample: a sum of squares.
#[inline(always)]
pub(crate) fn bound_energy(positive: &[f32], negative: &[f32]) -> f64 {
    f64::from(fold2(
        positive,
        negative,
        0.0,
        |sum, p, n| {
            let x = larger(p, n);
            sum + x * x
        },
        |a, b| a + b,
    ))
}

/// Energy of a signal, and the sum of the products of its magnitudes with those of what has been started already.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Energies {
    /// Sum of its own squares.
    pub(crate) own: f64,
    /// Sum of its products with what is there.
    pub(crate) cross: f64,
}

/// Energy of a drive (a sum of squares over samples), and the sum of its magnitudes times the larger of the
/// two bounds.
#[inline(always)]
pub(crate) fn energies(positive: &[f32], negative: &[f32], drive: &[f32]) -> Energies {
    let own = energy(drive);
    let add = |a: f32, b: f32| a + b;
    let cross = fold3(positive, negative, drive, 0.0, |sum, p, n, d| sum + larger(p, n) * d.abs(), add);
    Energies { own, cross: f64::from(cross) }
}

/// Energy of samples: the sum of their squares.
#[inline(always)]
pub(crate) fn energy(samples: &[f32]) -> f64 {
    f64::from(fold2(samples, samples, 0.0, |sum, x, _| sum + x * x, |a, b| a + b))
}

/// Energy of samples, each weighted.
#[inline(always)]
pub(crate) fn weighted_energy(samples: &[f32], weights: &[f32]) -> f64 {
    f64::from(fold2(samples, weights, 0.0, |sum, x, w| sum + w * (x * x), |a, b| a + b))
}

/// Largest magnitude of some samples, in their own unit.
#[inline(always)]
pub(crate) fn peak(samples: &[f32]) -> f32 {
    fold2(samples, samples, 0.0, |worst, x, _| larger(worst, x.abs()), larger)
}

/// Adds `gain` times some samples to others, sample by sample.
#[inline(always)]
pub(crate) fn add(to: &mut [f32], from: &[f32], gain: f32) {
    to.iter_mut().zip(from).for_each(|(to, &from)| *to += gain * from);
}

/// The number, or 0 if it is negative.
#[inline(always)]
pub(crate) fn above(x: f32) -> f32 {
    larger(x, 0.0)
}

/// The larger of two numbers, the first where that cannot be told.
#[inline(always)]
pub(crate) fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// The smaller of two numbers, the first where that cannot be told.
#[inline(always)]
pub(crate) fn smaller(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

/// A fold over two slices in lanes, joined at the end, as far as the shorter goes.
#[inline(always)]
fn fold2(
    a: &[f32],
    b: &[f32],
    start: f32,
    step: impl Fn(f32, f32, f32) -> f32,
    join: impl Fn(f32, f32) -> f32 + Copy,
) -> f32 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut lanes: Lanes = [start; LANES];
    for (a, b) in a.iter().zip(b) {
        for l in 0..LANES {
            lanes[l] = step(lanes[l], a[l], b[l]);
        }
    }
    let rest = a_rest.iter().zip(b_rest).fold(start, |acc, (&a, &b)| step(acc, a, b));
    join(rest, joined(lanes, join))
}

/// The same over three slices.
#[inline(always)]
fn fold3(
    a: &[f32],
    b: &[f32],
    c: &[f32],
    start: f32,
    step: impl Fn(f32, f32, f32, f32) -> f32,
    join: impl Fn(f32, f32) -> f32 + Copy,
) -> f32 {
    let (a_wide, a_rest) = a.as_chunks::<LANES>();
    let (b_wide, b_rest) = b.as_chunks::<LANES>();
    let (c_wide, c_rest) = c.as_chunks::<LANES>();
    let mut lanes: Lanes = [start; LANES];
    for ((a, b), c) in a_wide.iter().zip(b_wide).zip(c_wide) {
        for l in 0..LANES {
            lanes[l] = step(lanes[l], a[l], b[l], c[l]);
        }
    }
    let rest = a_rest.iter().zip(b_rest).zip(c_rest);
    let rest = rest.fold(start, |acc, ((&a, &b), &c)| step(acc, a, b, c));
    join(rest, joined(lanes, join))
}

/// All lanes joined, half by half.
#[inline(always)]
fn joined(mut lanes: Lanes, join: impl Fn(f32, f32) -> f32) -> f32 {
    for half in [8, 4, 2, 1] {
        for l in 0..half {
            lanes[l] = join(lanes[l], lanes[l + half]);
        }
    }
    lanes[0]
}
