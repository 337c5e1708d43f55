//! Contrast of time reversal (velocity at the focus over the rms elsewhere) against its window in closed
//! form, from modal responses.

use super::places::{grid, targets};
use std::ops::Range;
use unripple_core::{Encoded, Mixture, ModalResponses, Onset, Point, Pole};
use unripple_linalg::{Accum, Mat, MatRef, Par, c64, multiply};

/// The terms of a surface's modal responses, arranged to compute the contrast of time reversal for many windows.
///
/// Responses h_a(x) = Re Σ_p β_ap φ_p(x) e^{s_p t}, recorded at A for T and played backwards, give at the focal instant the velocity
/// Σ_p φ_p(x) Σ_q L_pq φ_q(A), with L_pq = ½ Re Σ_a [β_ap β_aq J(s_p + s_q) + β_ap β*_aq J(s_p + s*_q)] and J(s) = ∫_0^T e^{st} dt.
pub struct Modal {
    terms: Vec<Term>,
    /// The shape of each mode, an index of those below; several modes may share one.
    columns: Vec<usize>,
    parts: Vec<Part>,
    /// Indices of the parts of each complex frequency in turn, a range each.
    rates: Vec<(c64, Range<usize>)>,
    /// Σ_a β_ap β_aq and Σ_a β_ap β*_aq for each pair of parts q ≤ p, row by row.
    gains: Vec<[c64; 2]>,
    /// Shapes at the targets, shapes x targets.
    targets: Mat<f64>,
    /// Shapes at the grid's points, points x shapes.
    points: Mat<f64>,
    /// Indices of the grid points inside the focal disc of each target.
    within: Vec<Vec<usize>>,
}

/// All that the responses have in common of one complex frequency and one shape: Re β_a φ(x) e^{st}.
#[derive(Debug)]
struct Part {
    /// Index of the shape.
    column: usize,
    /// β for each actuator.
    inputs: Vec<c64>,
}

/// Share of the targets whose contrast lies below the interval of contrasts that is reported, and share
/// above it. With twice this value, one target in five lies outside the interval.
const TAIL: f64 = 0.05;

/// Number of amplitude decay times after which nothing rings that counts: contrast then stays the same to nine digits. With twice this value,
/// more windows are computed that give the same contrast.
const SILENT: f64 = 12.0;

/// An exponential Re a e^{st}, a part of the velocity of a mode after an impulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// Index of the mode.
    pub mode: usize,
    /// Complex amplitude a.
    pub amplitude: c64,
    /// Complex frequency s, in 1/s.
    pub rate: c64,
}

impl Encoded for Term {
    fn encode(&self, to: &mut Vec<u8>) {
        let (amplitude, rate) = (self.amplitude, self.rate);
        (self.mode, [amplitude.re, amplitude.im, rate.re, rate.im]).encode(to);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let (mode, [re, im, growth, omega]) = Encoded::decode(from)?;
        Some(Self { mode, amplitude: c64::new(re, im), rate: c64::new(growth, omega) })
    }
}

impl Modal {
    /// Prepares the exponentials, gains, targets and points of modal responses.
    ///
    /// # Errors
    /// In words, why no contrast can be computed from these responses.
    pub fn of(responses: &ModalResponses) -> Result<Self, &'static str> {
        let ModalResponses { ports, poles, input, shapes, conditions, .. } = responses;
        let actuators: Vec<Point> = ports.iter().map(|port| port.at).collect();
        let points = grid(&conditions.outline, conditions.lambda_min);
        let mut targets = targets(&conditions.outline, &actuators, conditions.lambda_min);
        let reach = conditions.focal_radius();
        let inside = |target: &Point| -> Vec<usize> {
            (0..points.len()).filter(|i| points[*i].distance(*target) <= reach).collect()
        };
        if ports.is_empty() || poles.is_empty() {
            return Err("there is nothing that drives it, or no mode in the band");
        }
        if targets.is_empty() {
            return Err("no place is half a wavelength away from all actuators and the rim");
        }
        targets.retain(|target| inside(target).len() < points.len());
        if targets.is_empty() {
            return Err("focal discs leave nothing of the surface outside them");
        }
        let terms: Vec<Term> =
            poles.iter().enumerate().flat_map(|(mode, pole)| exponentials(mode, *pole)).collect();
        let (columns, at_targets, at_points) = match shapes.mixture() {
            Some(Mixture { base, mixing, columns }) => {
                let at = |points: &[Point]| product(base.at_all(points).as_ref(), mixing);
                (columns.to_vec(), at(&targets), at(&points))
            }
            None => ((0..poles.len()).collect(), shapes.at_all(&targets), shapes.at_all(&points)),
        };
        let (parts, rates) = parts(&terms, &columns, input.as_ref());
        let pairs = parts.iter().enumerate().flat_map(|(i, p)| parts[..=i].iter().map(move |q| (p, q)));
        let gain = |(p, q): (&Part, &Part)| {
            let both = p.inputs.iter().zip(&q.inputs);
            both.fold([c64::new(0.0, 0.0); 2], |[one, other], (p, q)| [one + p * q, other + p * q.conj()])
        };
        Ok(Self {
            gains: pairs.map(gain).collect(),
            terms,
            columns,
            parts,
            rates,
            targets: at_targets.transpose().to_owned(),
            within: targets.iter().map(inside).collect(),
            points: at_points,
        })
    }

    /// Window (s) beyond which contrast no longer changes: [`SILENT`] times the longest decay time of all modes. Infinite if a mode has no
    /// damping.
    pub fn settled(&self) -> f64 {
        settled(&self.terms)
    }

    /// The velocities of all modes as exponentials, in order of the modes.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// Mean square of each mode shape, in 1/kg: first over the targets, then over the grid.
    pub fn mean_squares(&self) -> [Vec<f64>; 2] {
        let targets: Vec<f64> =
            self.targets.row_iter().map(|row| squares(row.iter()) / row.ncols() as f64).collect();
        let points: Vec<f64> =
            self.points.col_iter().map(|column| squares(column.iter()) / column.nrows() as f64).collect();
        [targets, points].map(|means| self.columns.iter().map(|column| means[*column]).collect())
    }

    /// Contrast at the focal instant for a window in seconds: its mean, from the mean of 1/C² over the
    /// targets, and its 5 % and 95 % quantiles over the targets.
    pub fn contrast(&self, window: f64) -> (f64, [f64; 2]) {
        let states = self.states(window);
        let field = product(self.points.as_ref(), states.as_ref());
        let square = |target: usize| {
            let column = field.col(target);
            let all: f64 = column.iter().map(|v| v * v).sum();
            let disc: f64 = self.within[target].iter().map(|i| column[*i] * column[*i]).sum();
            let outside = (field.nrows() - self.within[target].len()) as f64;
            let peak: f64 =
                self.targets.col(target).iter().zip(states.col(target).iter()).map(|(a, b)| a * b).sum();
            (all - disc) / outside / (peak * peak)
        };
        let mut squares: Vec<f64> = (0..self.targets.ncols()).map(square).collect();
        let mean = (squares.iter().sum::<f64>() / squares.len() as f64).powf(-0.5);
        squares.sort_by(f64::total_cmp);
        let share = |of: f64| squares[(of * (squares.len() - 1) as f64).round() as usize].powf(-0.5);
        (mean, [share(1.0 - TAIL), share(TAIL)])
    }

    /// Amplitude of each shape at the focal instant of each target, shapes x targets.
    fn states(&self, window: f64) -> Mat<f64> {
        let count = self.parts.len();
        let mut left = Mat::zeros(count, count);
        // One exponential for each frequency: those of pairs are products of them.
        let ends: Vec<c64> = self.rates.iter().map(|(rate, _)| (rate * window).exp()).collect();
        for (i, (a, rows)) in self.rates.iter().enumerate() {
            for (j, (b, columns)) in self.rates[..=i].iter().enumerate() {
                let one = gathered(a + b, ends[i] * ends[j], window);
                let other = gathered(a + b.conj(), ends[i] * ends[j].conj(), window);
                for p in rows.clone() {
                    let gains = &self.gains[p * (p + 1) / 2..];
                    for q in columns.start..columns.end.min(p + 1) {
                        let [both, conjugate] = gains[q];
                        let value = 0.5
                            * (both.re * one.re - both.im * one.im + conjugate.re * other.re
                                - conjugate.im * other.im);
                        left[(p, q)] = value;
                        left[(q, p)] = value;
                    }
                }
            }
        }
        let at = |p: usize, target: usize| self.targets[(self.parts[p].column, target)];
        let targets = Mat::from_fn(count, self.targets.ncols(), at);
        let by_parts = product(left.as_ref(), targets.as_ref());
        let mut states = Mat::zeros(self.targets.nrows(), self.targets.ncols());
        for (p, part) in self.parts.iter().enumerate() {
            (0..states.ncols()).for_each(|target| states[(part.column, target)] += by_parts[(p, target)]);
        }
        states
    }
}

/// The parts of responses, and the range of parts of each complex frequency. The modes of one frequency follow each other.
fn parts(terms: &[Term], columns: &[usize], input: MatRef<'_, f64>) -> (Vec<Part>, Vec<(c64, Range<usize>)>) {
    let mut order: Vec<&Term> = terms.iter().collect();
    let key = |term: &&Term| (term.rate.im.to_bits(), term.rate.re.to_bits(), columns[term.mode]);
    order.sort_by_key(key);
    let (mut parts, mut rates): (Vec<Part>, Vec<(c64, Range<usize>)>) = (Vec::new(), Vec::new());
    for same in order.chunk_by(|a, b| key(a) == key(b)) {
        let inputs =
            input.row_iter().map(|row| same.iter().map(|term| term.amplitude * row[term.mode]).sum());
        let (rate, place) = (same[0].rate, parts.len());
        parts.push(Part { column: columns[same[0].mode], inputs: inputs.collect() });
        match rates.last_mut() {
            Some((last, range)) if *last == rate => range.end = place + 1,
            _ => rates.push((rate, place..place + 1)),
        }
    }
    (parts, rates)
}

/// The longest of [`SILENT`] decay times (s) of terms that have an amplitude.
fn settled(terms: &[Term]) -> f64 {
    let sounding = terms.iter().filter(|term| term.amplitude.norm_sqr() > 0.0);
    sounding.map(|term| SILENT / term.rate.re.abs()).fold(0.0, f64::max)
}

/// Sum of squares.
fn squares<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    values.map(|v| v * v).sum()
}

/// The integral ∫_0^T Re a e^{st} Re b e^{rt} dt of two terms, in s, for a window T in s; the caller passes
/// e^{sT} and e^{rT}.
pub fn integral([a, b]: [&Term; 2], [end, other]: [c64; 2], window: f64) -> f64 {
    let sum = a.amplitude * b.amplitude * gathered(a.rate + b.rate, end * other, window)
        + a.amplitude * b.amplitude.conj() * gathered(a.rate + b.rate.conj(), end * other.conj(), window);
    0.5 * sum.re
}

/// The integral ∫_0^T e^{st} dt; the caller passes e^{sT}.
fn gathered(rate: c64, end: c64, window: f64) -> c64 {
    let x = rate * window;
    if x.norm() < 1e-5 {
        return (x * 0.5 + 1.0) * window;
    }
    (end - 1.0) / rate
}

/// The velocity of a mode, [`Pole::velocity`], as a sum of exponentials.
fn exponentials(mode: usize, pole: Pole) -> Vec<Term> {
    let Pole { omega, sigma, onset } = pole;
    let term = |amplitude: c64, rate: c64| Term { mode, amplitude, rate };
    let square = (omega - sigma) * (omega + sigma);
    if square > 0.0 {
        let swing = square.sqrt();
        let amplitude = match onset {
            Onset::Velocity => c64::new(1.0, sigma / swing),
            Onset::Displacement => c64::new(0.0, omega / swing),
        };
        return vec![term(amplitude, c64::new(-sigma, swing))];
    }
    // Overdamped: two real exponentials. At critical damping they coincide; slightly beside it, the sum is the same to five digits.
    let split = (-square).sqrt().max(1e-5 * sigma);
    if split == 0.0 {
        return vec![term(c64::new(f64::from(u8::from(onset == Onset::Velocity)), 0.0), c64::new(0.0, 0.0))];
    }
    let [slow, fast] = match onset {
        Onset::Velocity => [0.5 - 0.5 * sigma / split, 0.5 + 0.5 * sigma / split],
        Onset::Displacement => [-0.5 * omega / split, 0.5 * omega / split],
    };
    vec![
        term(c64::new(slow, 0.0), c64::new(split - sigma, 0.0)),
        term(c64::new(fast, 0.0), c64::new(-split - sigma, 0.0)),
    ]
}

/// The matrix product on one thread, with sums in a fixed order, so that a surface always gets exactly the
/// same window.
fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut sum = Mat::zeros(a.nrows(), b.ncols());
    multiply(sum.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_add_up_to_the_velocity() {
        for (omega, sigma) in [(900.0, 30.0), (300.0, 400.0), (50.0, 50.0), (0.0, 0.0), (0.0, 20.0)] {
            for pole in [Pole::new(omega, sigma), Pole::moved(omega, sigma)] {
                for t in [0.0, 1e-3, 7e-3, 0.05] {
                    let sum: f64 =
                        exponentials(0, pole).iter().map(|x| (x.amplitude * (x.rate * t).exp()).re).sum();
                    assert!(
                        (sum - pole.velocity(t)).abs() < 1e-4,
                        "{pole:?} {t}: {sum} {}",
                        pole.velocity(t)
                    );
                }
            }
        }
    }

    #[test]
    fn what_rings_for_ever_never_settles() {
        let of = |omega: f64, sigma: f64| settled(&exponentials(0, Pole::new(omega, sigma)));
        assert_eq!([of(900.0, 0.0), of(0.0, 0.0)], [f64::INFINITY; 2]);
        assert!((of(900.0, 30.0) - SILENT / 30.0).abs() < 1e-12);
        // A rigid motion that damping stops, and the slower of two decays.
        assert!((of(0.0, 20.0) - SILENT / 40.0).abs() < 1e-12);
        assert!((of(300.0, 400.0) - SILENT / (400.0 - 70000f64.sqrt())).abs() < 1e-12);
    }

    #[test]
    fn integrals_are_those_of_fine_sums() {
        let (a, b) = (exponentials(0, Pole::new(900.0, 30.0)), exponentials(1, Pole::new(300.0, 400.0)));
        let (window, steps) = (0.02, 20_000);
        for (one, other) in [(&a, &a), (&a, &b), (&b, &b)] {
            let found: f64 = one
                .iter()
                .flat_map(|x| {
                    other.iter().map(move |y| {
                        let ends = [x, y].map(|term| (term.rate * window).exp());
                        integral([x, y], ends, window)
                    })
                })
                .sum();
            let value = |terms: &[Term], t: f64| {
                terms.iter().map(|x| (x.amplitude * (x.rate * t).exp()).re).sum::<f64>()
            };
            let dt = window / f64::from(steps);
            let at = |i: i32| (f64::from(i) + 0.5) * dt;
            let sum: f64 = (0..steps).map(|i| value(one, at(i)) * value(other, at(i)) * dt).sum();
            assert!((found / sum - 1.0).abs() < 1e-5, "{found} {sum}");
        }
    }
}
