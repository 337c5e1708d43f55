//! Samples in space and time at which the felt background is bounded.

use super::background::Actuation;
use super::control::Control;
use unripple_linalg::{Accum, Mat, MatRef, Par, multiply, solve_lower};

/// Of neighbouring maxima of one sign, only the largest is taken at once. Neighbouring means within this
/// many periods of the highest frequency felt, and this many points of the coarse lattice. With twice these
/// values, there are fewer bounds at once and more rounds.
const APART: [f64; 2] = [0.85, 1.5];

/// Largest number of maxima that are taken at once: each is a row of the dual problem. With twice this
/// value, rounds are fewer and problems larger.
const AT_ONCE: usize = 24;

/// A point in space and time at which the felt displacement is bounded: a control point, a time, and the
/// sign of the displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    /// Index of the control point.
    pub point: usize,
    /// Index of the time in the list `times` of [`Watch`].
    pub time: usize,
    /// Sign of the felt displacement there, 1 or -1.
    pub sign: f64,
}

/// Felt displacement at the control points at times around the focal instant, as a linear function of the
/// drive.
#[derive(Clone, Debug)]
pub(crate) struct Watch {
    /// Times of evaluation, in samples from the focal instant.
    pub times: Vec<i64>,
    /// Time, in samples, within which only the largest of neighbouring maxima is taken.
    apart: f64,
    splines: usize,
    /// Input weights, actuators x modes.
    input: Mat<f64>,
    /// Threshold-weighted displacement for each spline as the modal force, `[mode][spline][time]`.
    motion: Vec<f32>,
    /// Threshold-weighted displacement of every mode per whitened coefficient, `[time][mode][coefficient]`.
    rows: Vec<f32>,
}

impl Watch {
    /// Times of evaluation, in samples from the focal instant: closely spaced near it, twice as far apart
    /// farther out. `rate` is in samples per second, `top` the highest frequency felt (Hz).
    pub fn times(rate: f64, top: f64) -> Vec<i64> {
        let step = (rate / (3.0 * top)).round().max(1.0) as i64;
        let (near, far) = (12, 42);
        let each = (-far..=far).filter(|i: &i64| i.abs() <= near || i % 2 == 0);
        each.map(|i| i * step).collect()
    }

    /// Computes the weighted displacement of each mode per spline and per whitened coefficient, at the times around sample `focal`;
    /// `factor` is the lower triangular factor that whitens coefficients, `top` in Hz.
    pub fn new(actuation: &Actuation<'_>, factor: MatRef<'_, f64>, focal: usize, top: f64) -> Self {
        let modes = actuation.modes.len();
        let times = Self::times(actuation.lines.rate, top);
        let clock: Vec<i64> = times.iter().map(|t| focal as i64 + t).collect();
        let phases = actuation.phases(&clock);
        let splines = actuation.splines.len();
        let motions: Vec<Mat<f64>> = (0..modes).map(|m| actuation.motion(m, &phases)).collect();
        let mut rows = Vec::with_capacity(times.len() * modes * factor.nrows());
        for t in 0..times.len() {
            let mut read = Mat::from_fn(factor.nrows(), modes, |i, m| {
                actuation.input[(i / splines, m)] * motions[m][(t, i % splines)]
            });
            solve_lower(factor, read.as_mut());
            (0..modes).for_each(|m| rows.extend(read.col_as_slice(m).iter().map(|x| *x as f32)));
        }
        let single = |m: &Mat<f64>| -> Vec<f32> {
            (0..splines).flat_map(|k| m.col_as_slice(k).iter().map(|x| *x as f32)).collect()
        };
        let motion = motions.iter().flat_map(single).collect();
        let apart = APART[0] * actuation.lines.rate / top;
        Self { times, apart, splines, input: actuation.input.clone(), motion, rows }
    }

    /// Displacement at chosen points, weighted by the threshold of touch and in its units, for the drive with these spline
    /// coefficients, `[actuator][spline]`: times x points. `shapes` are the mode shapes at the points, modes x points.
    pub fn field(&self, coefficients: &[f64], shapes: &Mat<f32>) -> Mat<f32> {
        let times = self.times.len();
        let mut motion = Mat::<f32>::zeros(times, self.input.ncols());
        for m in 0..self.input.ncols() {
            let column = motion.col_as_slice_mut(m);
            let read = self.motion[m * self.splines * times..].chunks_exact(times);
            for (k, spline) in read.take(self.splines).enumerate() {
                let force = (0..self.input.nrows())
                    .map(|a| self.input[(a, m)] * coefficients[a * self.splines + k])
                    .sum::<f64>();
                let force = force as f32;
                column.iter_mut().zip(spline).for_each(|(u, s)| *u += force * s);
            }
        }
        let mut field = Mat::zeros(times, shapes.ncols());
        multiply(field.as_mut(), Accum::Replace, motion.as_ref(), shapes.as_ref(), 1.0, Par::Seq);
        field
    }

    /// Felt displacement at a sample per whitened coefficient, multiplied by the sample's sign.
    pub fn row(&self, control: &Control, sample: Sample) -> Vec<f64> {
        let shapes = control.shapes.col_as_slice(sample.point);
        let count = self.rows.len() / (self.times.len() * self.input.ncols());
        let read = self.rows[sample.time * self.input.ncols() * count..].chunks_exact(count);
        let mut row = vec![0.0_f32; count];
        for (weight, mode) in shapes.iter().zip(read) {
            row.iter_mut().zip(mode).for_each(|(x, w)| *x += weight * w);
        }
        row.iter().map(|x| sample.sign * f64::from(*x)).collect()
    }

    /// The largest magnitude of a field (times x points, in units of the threshold), and the samples where
    /// the field has a maximum in time, from the largest down: only those above `least` of that magnitude,
    /// and none that is among the samples `known`. The columns of the field are those of the points `chosen`.
    pub fn peaks(
        &self,
        field: &Mat<f32>,
        control: &Control,
        chosen: &[usize],
        known: &[Sample],
        least: impl Fn(f64) -> f64,
    ) -> (f64, Vec<Sample>) {
        let columns = || (0..chosen.len()).map(|p| field.col_as_slice(p));
        let largest = f64::from(columns().flatten().fold(0.0_f32, |m, x| m.max(x.abs())));
        let least = least(largest) as f32;
        let mut maxima = Vec::new();
        for (column, point) in columns().zip(chosen) {
            for (time, value) in column.iter().enumerate().filter(|(_, x)| x.abs() > least) {
                let at = |i: usize| column.get(i).map_or(0.0, |x| x.abs());
                if value.abs() >= at(time.wrapping_sub(1)) && value.abs() > at(time + 1) {
                    let sign = if *value < 0.0 { -1.0 } else { 1.0 };
                    maxima.push((value.abs(), Sample { point: *point, time, sign }));
                }
            }
        }
        maxima.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut taken: Vec<Sample> = Vec::new();
        for (_, sample) in maxima {
            if !known.contains(&sample) && !taken.iter().any(|other| self.near(control, sample, *other)) {
                taken.push(sample);
                if taken.len() == AT_ONCE {
                    break;
                }
            }
        }
        (largest, taken)
    }

    fn near(&self, control: &Control, a: Sample, b: Sample) -> bool {
        let distance = control.points[a.point].distance(control.points[b.point]);
        let time = (self.times[a.time] - self.times[b.time]).abs() as f64;
        a.sign == b.sign && time < self.apart && distance < APART[1] * control.coarse_pitch()
    }
}
