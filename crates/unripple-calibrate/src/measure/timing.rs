//! Clock error and lost samples of one take, from the delays of its sweeps.

/// A sweep of a take: its start in the played signal, its delay in the recording, and the standard error of
/// the delay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sweep {
    /// Number of the sweep, from 0.
    pub number: usize,
    /// First sample of the sweep in the played signal.
    pub start: f64,
    /// Delay of the recorded sweep relative to its expected time, in samples.
    pub late: f64,
    /// Standard error of `late`, in samples.
    pub error: f64,
}

/// Model of the delays of a take's sweeps: `late + slope · start`, and from some sweep on `lost` samples
/// less.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Timing {
    /// Delay of a sweep that begins at sample 0, in samples.
    pub late: f64,
    /// Growth of the delay per sample of the played signal: the relative error of the recording's clock, positive if it is fast.
    pub slope: f64,
    /// Standard error of `slope`.
    pub slope_error: f64,
    /// Whether there were enough sweeps to find an error of the clock; without it `slope` is 0.
    pub clock: bool,
    /// Number of samples lost (negative: repeated), and the numbers of the last sweep before the loss and of
    /// the first after it.
    pub lost: Option<(i64, [usize; 2])>,
    /// Rms residual of the delays, in samples, over the sweeps that are used.
    pub rest: f64,
}

/// Deviation of delays, in samples, that is accepted without an error of the clock: the surface differs a
/// little from take to take.
const SLACK: f64 = 0.25;

/// Smallest step of the delays, in samples, that counts as lost samples: a smaller one counts as an error of
/// the clock.
const LEAST_LOST: f64 = 1.5;

/// Largest number of sweeps that are playing while samples are lost: their delay is neither that before nor
/// that after the loss.
const SOUNDING: usize = 2;

impl Timing {
    /// The simplest timing that explains the sweeps: one clock, then one clock and a place where samples were lost. Two sweeps determine
    /// a common delay, but no error of a clock. `None` if nothing explains them, or there are fewer than two.
    pub fn of(sweeps: &[Sweep]) -> Option<Self> {
        if sweeps.len() < LINE {
            let level = Self::level(sweeps)?;
            return (level.rest <= tolerance(sweeps)).then_some(level);
        }
        let even = Self::line(sweeps)?;
        if even.rest <= tolerance(sweeps) {
            return Some(even);
        }
        let mut best: Option<(usize, Self)> = None;
        for first in 1..sweeps.len() {
            for hit in 0..=SOUNDING.min(sweeps.len().saturating_sub(first + 1)) {
                let Some(stepped) = Self::stepped(sweeps, first, hit) else { continue };
                let better = |(left, before): &(usize, Self)| {
                    hit < *left || hit == *left && stepped.rest < before.rest
                };
                if stepped.rest <= tolerance(sweeps) && best.as_ref().is_none_or(better) {
                    best = Some((hit, stepped));
                }
            }
        }
        best.map(|(_, timing)| timing)
    }

    /// The best-fitting timing for sweeps that no timing explains within the tolerance: a line, or one delay
    /// for two sweeps. Its standard error follows from the residual.
    pub fn nearest(sweeps: &[Sweep]) -> Option<Self> {
        let near = if sweeps.len() < LINE { Self::level(sweeps) } else { Self::line(sweeps) }?;
        let slope_error = near.slope_error * (near.rest / error(sweeps).max(FLOOR)).max(1.0);
        Some(Self { slope_error, ..near })
    }

    /// One delay for all sweeps, of which there must be two or more.
    fn level(sweeps: &[Sweep]) -> Option<Self> {
        let fit = Fit::of(sweeps, 1, |_| [1.0, 0.0, 0.0]).filter(|_| sweeps.len() > 1)?;
        Some(Self { late: fit.x[0], rest: fit.rest, ..Self::default() })
    }

    /// A straight line through all sweeps: a delay and an error of the clock.
    fn line(sweeps: &[Sweep]) -> Option<Self> {
        let fit = Fit::of(sweeps, 2, |sweep| [1.0, sweep.start, 0.0])?;
        let ([late, slope, _], slope_error) = (fit.x, fit.errors[1]);
        Some(Self { late, slope, slope_error, clock: true, lost: None, rest: fit.rest })
    }

    /// A line with a step after `first` sweeps, the next `hit` of them left out.
    fn stepped(sweeps: &[Sweep], first: usize, hit: usize) -> Option<Self> {
        let kept: Vec<Sweep> = [&sweeps[..first], sweeps.get(first + hit..)?].concat();
        let after = sweeps.get(first + hit)?;
        let step = |sweep: &Sweep| if sweep.start >= after.start { -1.0 } else { 0.0 };
        // With few sweeps a slope and a step would explain anything: then the clock is assumed to be exact.
        let timing = if kept.len() < FEW {
            let fit = Fit::of(&kept, 2, |sweep| [1.0, step(sweep), 0.0])?;
            (Self { late: fit.x[0], rest: fit.rest, ..Self::default() }, fit.x[1])
        } else {
            let fit = Fit::of(&kept, 3, |sweep| [1.0, step(sweep), sweep.start])?;
            let [late, lost, slope] = fit.x;
            let slope_error = fit.errors[2];
            (Self { late, slope, slope_error, clock: true, lost: None, rest: fit.rest }, lost)
        };
        let (timing, lost) = timing;
        if kept.len() < 3 || lost.abs() < LEAST_LOST || (lost - lost.round()).abs() > SLACK {
            return None;
        }
        let numbers = [sweeps.get(first - 1)?.number, after.number];
        Some(Self { lost: Some((lost.round() as i64, numbers)), ..timing })
    }
}

/// Number of sweeps below which an error of the clock cannot be separated from a step.
const FEW: usize = 5;

/// Fewest sweeps to which a line is fitted: it goes through any two.
const LINE: usize = 3;

/// Largest residual of an explanation of the delays, in samples.
fn tolerance(sweeps: &[Sweep]) -> f64 {
    SLACK + 3.0 * error(sweeps)
}

/// Root mean square of the sweeps' errors.
fn error(sweeps: &[Sweep]) -> f64 {
    (sweeps.iter().map(|sweep| sweep.error * sweep.error).sum::<f64>() / sweeps.len() as f64).sqrt()
}

/// Weighted least squares of up to three unknowns.
struct Fit {
    x: [f64; 3],
    errors: [f64; 3],
    rest: f64,
}

impl Fit {
    /// `columns` are the unknowns' coefficients, of which the first `count` matter.
    fn of(sweeps: &[Sweep], count: usize, columns: impl Fn(&Sweep) -> [f64; 3]) -> Option<Self> {
        if sweeps.len() < count {
            return None;
        }
        let largest = (0..3).map(|c| sweeps.iter().map(|s| columns(s)[c].abs()).fold(0.0, f64::max));
        let scale: Vec<f64> = largest.map(|x| if x > 0.0 { x } else { 1.0 }).collect();
        let (mut normal, mut right) = ([[0.0; 3]; 3], [0.0; 3]);
        (count..3).for_each(|i| normal[i][i] = 1.0);
        for sweep in sweeps {
            let row = columns(sweep);
            let weight = 1.0 / (sweep.error.powi(2) + FLOOR * FLOOR);
            for i in 0..count {
                right[i] += weight * sweep.late * row[i] / scale[i];
                (0..count).for_each(|j| normal[i][j] += weight * row[i] * row[j] / (scale[i] * scale[j]));
            }
        }
        let inverse = inverted(normal)?;
        let value = |i: usize| (0..3).map(|j| inverse[i][j] * right[j]).sum::<f64>() / scale[i];
        let x = [value(0), value(1), value(2)];
        let left = |s: &Sweep| s.late - columns(s).iter().zip(x).take(count).map(|(a, x)| a * x).sum::<f64>();
        let rest = (sweeps.iter().map(|s| left(s).powi(2)).sum::<f64>() / sweeps.len() as f64).sqrt();
        let error = |i: usize| inverse[i][i].max(0.0).sqrt() / scale[i];
        Some(Self { x, errors: [error(0), error(1), error(2)], rest })
    }
}

/// Smallest error of a delay, in samples. Otherwise one very clean sweep would outweigh all others.
const FLOOR: f64 = 1e-3;

/// Inverse of a matrix by Cramer's rule; `None` if it is singular.
fn inverted(m: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let minor = |i: usize, j: usize| {
        let [a, b] = [(i + 1) % 3, (i + 2) % 3];
        let [c, d] = [(j + 1) % 3, (j + 2) % 3];
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let whole: f64 = (0..3).map(|j| m[0][j] * minor(0, j)).sum();
    let size: f64 = (0..3).map(|i| m[i][i].abs().max(1e-300)).product();
    let value = |i: usize, j: usize| minor(j, i) / whole;
    (whole.abs() > 1e-12 * size).then(|| [0, 1, 2].map(|i| [0, 1, 2].map(|j| value(i, j))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweeps(count: usize, late: impl Fn(usize, f64) -> f64) -> Vec<Sweep> {
        let one = |number: usize| {
            let start = 17_000.0 * number as f64;
            Sweep { number, start, late: late(number, start), error: 0.01 }
        };
        (0..count).map(one).collect()
    }

    #[test]
    fn a_clock_is_a_slope() {
        let found = Timing::of(&sweeps(8, |_, start| 3.2 + 43e-6 * start)).unwrap();
        assert!(
            (found.slope - 43e-6).abs() < 1e-10 && (found.late - 3.2).abs() < 1e-6 && found.lost.is_none()
        );
        assert!(found.slope_error < 1e-6);
    }

    #[test]
    fn lost_samples_are_a_step_whatever_the_sweeps_that_they_hit() {
        let found = Timing::of(&sweeps(8, |n, start| match n {
            0..3 => 20e-6 * start,
            3 | 4 => 77.0 - 30.0 * n as f64,
            _ => 20e-6 * start - 480.0,
        }))
        .unwrap();
        assert_eq!(found.lost, Some((480, [2, 5])));
        assert!((found.slope - 20e-6).abs() < 1e-9, "{found:?}");
        let few = Timing::of(&sweeps(4, |n, _| if n < 2 { 1.0 } else { 65.0 })).unwrap();
        assert_eq!(few.lost, Some((-64, [1, 2])));
    }

    #[test]
    fn two_sweeps_tell_no_clock() {
        let same = Timing::of(&sweeps(2, |_, _| 3.2)).unwrap();
        assert!((same.late - 3.2).abs() < 1e-9 && same.slope == 0.0 && !same.clock, "{same:?}");
        // Lost samples, or a clock: nobody knows.
        assert_eq!(Timing::of(&sweeps(2, |n, _| 3.0 * n as f64)), None);
        assert!(Timing::of(&sweeps(3, |_, start| 43e-6 * start)).unwrap().clock);
    }

    #[test]
    fn what_nothing_explains_is_not_explained() {
        let found = Timing::of(&sweeps(8, |n, _| ((n * 37) % 11) as f64 * 9.0));
        assert_eq!(found, None);
        let scattered = sweeps(8, |n, start| 43e-6 * start + if n % 2 == 0 { 0.4 } else { -0.4 });
        assert_eq!(Timing::of(&scattered), None);
        let near = Timing::nearest(&scattered).unwrap();
        assert!((near.rest - 0.4).abs() < 0.05, "{near:?}");
        assert!((near.slope - 43e-6).abs() < near.slope_error && near.slope_error > 1e-6, "{near:?}");
        assert_eq!(Timing::of(&sweeps(1, |_, _| 0.0)), None);
    }
}
