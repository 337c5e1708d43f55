//! Least-squares drives for waveforms: conjugate gradients on the dual (regularised crosstalk cancellation).

use super::PlayOptions;
use super::plan::Plan;
use super::transfer::Transfer;
use unripple_dsp::Complex;

type Lines = Vec<Complex<f64>>;

/// The channels of the drive of least cost, actuators x samples, by conjugate gradients on the dual problem.
pub(crate) fn solve(transfer: &Transfer, asked: &Lines, plan: &Plan, options: &PlayOptions) -> Vec<Vec<f64>> {
    let system = System { transfer, plan, ridge: options.energy_weight };
    let endless = Endless::new(transfer, options.energy_weight);
    let whiten = |(i, w): (usize, &Complex<f64>)| w * transfer.weights[i / transfer.rows];
    let mut residual: Lines = asked.iter().enumerate().map(whiten).collect();
    let enough = options.tolerance * system.dot(&residual, &residual).sqrt();
    let mut solution = vec![Complex::default(); residual.len()];
    let mut direction = endless.apply(transfer, &residual);
    let mut descent = system.dot(&residual, &direction);
    for _ in 0..options.passes {
        let image = system.apply(&direction);
        let curvature = system.dot(&direction, &image);
        if !(curvature > 0.0 && descent > 0.0) {
            break;
        }
        let length = descent / curvature;
        add(&mut solution, length, &direction);
        add(&mut residual, -length, &image);
        if system.dot(&residual, &residual).sqrt() <= enough {
            break;
        }
        let next = endless.apply(transfer, &residual);
        let before = std::mem::replace(&mut descent, system.dot(&residual, &next));
        let kept = descent / before;
        direction.iter_mut().zip(&next).for_each(|(d, n)| *d = n + *d * kept);
    }
    (0..transfer.ports).map(|port| system.channel(&solution, port)).collect()
}

fn add(to: &mut Lines, factor: f64, what: &Lines) {
    to.iter_mut().zip(what).for_each(|(to, x)| *to += x * factor);
}

/// The dual system H p Hᴴ + ridge over the lines of the band, values as `[line][row]`.
struct System<'a> {
    transfer: &'a Transfer,
    plan: &'a Plan,
    ridge: f64,
}

impl System<'_> {
    /// The inner product of signals with these spectra.
    fn dot(&self, a: &Lines, b: &Lines) -> f64 {
        let rows = self.transfer.rows;
        let part = |(i, (a, b)): (usize, (&Complex<f64>, &Complex<f64>))| {
            self.plan.multiplicity(i / rows) * (a.re * b.re + a.im * b.im)
        };
        a.iter().zip(b).enumerate().map(part).sum()
    }

    /// One channel of the drive p Hᴴ y.
    fn channel(&self, dual: &Lines, port: usize) -> Vec<f64> {
        let Transfer { rows, ports, values, .. } = self.transfer;
        let mut spectrum = vec![Complex::default(); self.plan.convolver.size() / 2 + 1];
        let lines = values.chunks_exact(rows * ports).zip(dual.chunks_exact(*rows));
        for (to, (h, y)) in spectrum[self.plan.lines.clone()].iter_mut().zip(lines) {
            *to = y.iter().enumerate().map(|(row, y)| h[row * ports + port].conj() * y).sum();
        }
        let mut signal = self.plan.convolver.signal(spectrum);
        signal.truncate(self.plan.taper.len());
        signal.iter_mut().zip(&self.plan.taper).for_each(|(d, p)| *d *= p);
        signal
    }

    /// The dual system's matrix times a dual vector: the motion at all points under the drive of that
    /// vector, plus the ridge times it.
    fn apply(&self, dual: &Lines) -> Lines {
        let Transfer { rows, ports, values, .. } = self.transfer;
        let mut image: Lines = dual.iter().map(|y| y * self.ridge).collect();
        for port in 0..*ports {
            let sent = self.plan.convolver.spectrum(self.channel(dual, port));
            let lines = values.chunks_exact(rows * ports).zip(image.chunks_exact_mut(*rows));
            for (d, (h, to)) in sent[self.plan.lines.clone()].iter().zip(lines) {
                to.iter_mut().enumerate().for_each(|(row, to)| *to += h[row * ports + port] * d);
            }
        }
        image
    }
}

/// Preconditioner: the solution for a drive of unlimited duration, (H Hᴴ + ridge)⁻¹ per line, through the
/// smaller of H Hᴴ and Hᴴ H.
struct Endless {
    size: usize,
    ridge: f64,
    /// `[line][size][size]`.
    inverses: Lines,
}

impl Endless {
    /// Inverts the smaller matrix at every line.
    fn new(transfer: &Transfer, ridge: f64) -> Self {
        let Transfer { rows, ports, values, .. } = transfer;
        let size = *rows.min(ports);
        let mut inverses = vec![Complex::default(); values.len() / (rows * ports) * size * size];
        for (h, gram) in values.chunks_exact(rows * ports).zip(inverses.chunks_exact_mut(size * size)) {
            for i in 0..size {
                for j in 0..size {
                    gram[i * size + j] = if rows <= ports {
                        (0..*ports).map(|p| h[i * ports + p] * h[j * ports + p].conj()).sum()
                    } else {
                        (0..*rows).map(|r| h[r * ports + i].conj() * h[r * ports + j]).sum()
                    };
                }
                gram[i * size + i] += ridge;
            }
            invert(gram, size);
        }
        Self { size, ridge, inverses }
    }

    /// The preconditioner applied to a dual vector.
    fn apply(&self, transfer: &Transfer, lines: &Lines) -> Lines {
        let Transfer { rows, ports, values, .. } = transfer;
        let mut out = Vec::with_capacity(lines.len());
        let all = lines.chunks_exact(*rows).zip(self.inverses.chunks_exact(self.size * self.size));
        for ((y, inverse), h) in all.zip(values.chunks_exact(rows * ports)) {
            if rows <= ports {
                out.extend((0..*rows).map(|i| product(&inverse[i * rows..(i + 1) * rows], y)));
                continue;
            }
            // Woodbury: (H Hᴴ + r)⁻¹ = (1 − H (Hᴴ H + r)⁻¹ Hᴴ) / r.
            let back: Lines =
                (0..*ports).map(|p| (0..*rows).map(|r| h[r * ports + p].conj() * y[r]).sum()).collect();
            let sent: Lines =
                (0..*ports).map(|p| product(&inverse[p * ports..(p + 1) * ports], &back)).collect();
            let rest = |r: usize| (y[r] - product(&h[r * ports..(r + 1) * ports], &sent)) / self.ridge;
            out.extend((0..*rows).map(rest));
        }
        out
    }
}

fn product(row: &[Complex<f64>], column: &[Complex<f64>]) -> Complex<f64> {
    row.iter().zip(column).map(|(a, b)| a * b).sum()
}

/// Inverts a Hermitian positive definite matrix in place, by Gauss-Jordan elimination; pivots stay positive.
fn invert(a: &mut [Complex<f64>], size: usize) {
    for k in 0..size {
        let pivot = 1.0 / a[k * size + k].re;
        a[k * size + k] = Complex::new(1.0, 0.0);
        (0..size).for_each(|j| a[k * size + j] *= pivot);
        for i in (0..size).filter(|i| *i != k) {
            let factor = std::mem::take(&mut a[i * size + k]);
            (0..size).for_each(|j| {
                let change = factor * a[k * size + j];
                a[i * size + j] -= change;
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;
    use unripple_dsp::Convolver;
    use unripple_linalg::{Lu, Mat, product};

    /// A system of arbitrary transfer functions.
    fn system(rows: usize, ports: usize) -> (Transfer, Plan, Lines) {
        let lines = 3..20;
        let mut phase = 0.0_f64;
        let mut next = || {
            phase += 1.7;
            Complex::new((phase * phase).sin(), (0.3 + 2.0 * phase * phase).cos())
        };
        let values = (0..lines.len() * rows * ports).map(|_| next()).collect();
        let asked = (0..lines.len() * rows).map(|_| next()).collect();
        let transfer = Transfer { rows, ports, values, weights: vec![1.0; lines.len()], places: Vec::new() };
        let taper: Vec<f64> = (0..40).map(|i| ((f64::from(i) + 0.5) / 10.0).min(1.0)).collect();
        let fade = vec![1.0; lines.len()];
        let plan = Plan { rate: 1.0, starts: vec![0], taper, lines, fade, convolver: Convolver::new(64) };
        (transfer, plan, asked)
    }

    /// The drive that minimises Σ_t e² + ridge Σ_t d²/p, with e = H d − w in time, from its normal equations in full.
    fn dense(transfer: &Transfer, plan: &Plan, asked: &Lines, ridge: f64) -> Mat<f64> {
        let (size, support) = (plan.convolver.size(), plan.taper.len());
        let equations = plan.lines.len() * transfer.rows;
        // Each line counts twice, once for its negative frequency.
        let weight = (2.0 / size as f64).sqrt();
        let part = |i: usize, x: Complex<f64>| weight * if i.is_multiple_of(2) { x.re } else { x.im };
        let matrix = Mat::from_fn(2 * equations, transfer.ports * support, |i, j| {
            let (line, port, t) = (i / 2 / transfer.rows, j / support, j % support);
            let turn = Complex::from_polar(1.0, -TAU * ((plan.lines.start + line) * t) as f64 / size as f64);
            part(i, transfer.values[i / 2 * transfer.ports + port] * turn)
        });
        let right = Mat::from_fn(2 * equations, 1, |i, _| part(i, asked[i / 2]));
        let mut normal = product(matrix.transpose(), matrix.as_ref());
        (0..normal.nrows()).for_each(|j| normal[(j, j)] += ridge / plan.taper[j % support]);
        let mut found = product(matrix.transpose(), right.as_ref());
        Lu::new(normal.as_ref()).solve(found.as_mut());
        found
    }

    #[test]
    fn finds_the_optimum_of_the_dense_problem() {
        for (rows, ports, ridge) in [(1, 3, 1e-3), (2, 3, 1e-2), (3, 3, 1e-2), (4, 2, 1e-2)] {
            let (transfer, plan, asked) = system(rows, ports);
            let options =
                PlayOptions { energy_weight: ridge, tolerance: 1e-9, passes: 400, ..PlayOptions::default() };
            let found = solve(&transfer, &asked, &plan, &options);
            let exact = dense(&transfer, &plan, &asked, ridge);
            let size = exact.norm_max();
            for (i, d) in found.iter().flatten().enumerate() {
                assert!((d - exact[(i, 0)]).abs() < 1e-6 * size, "{rows} {ports} {i}: {d} {}", exact[(i, 0)]);
            }
        }
    }
}
