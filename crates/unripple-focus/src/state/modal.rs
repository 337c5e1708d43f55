//! Modal states at the focal instant as a linear function of the drive.

use super::room::fits;
use crate::FocusError;
use unripple_core::{ModalResponses, Point, Pole};
use unripple_dsp::ModalSynth;
use unripple_linalg::{Accum, Mat, Par, multiply, product};

/// Number of cells per shortest wavelength along each side, in which velocity is minimised. With twice this
/// value, there are four times as many cells, and the mean over them stays the same.
const CELLS: f64 = 6.0;

/// Quantity that a coordinate of a mode's state at the focal instant stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Keeps {
    /// The velocity of the mode.
    Velocity,
    /// The displacement of the mode times its angular frequency, which is to be minimised too.
    Displacement,
}

/// Linear model of modes under a drive: its state is made of their velocities at the focal instant.
#[derive(Debug)]
pub(crate) struct ModalPlant<'r> {
    responses: &'r ModalResponses,
    /// Velocity of each mode at the focal instant after an impulse at each sample, over the rate: samples x modes.
    table: Mat<f64>,
    /// Synthesises drives of one window faster than products with `table`.
    synth: Option<ModalSynth>,
}

impl<'r> ModalPlant<'r> {
    /// Modes excited by drives that are played once and last one window of `length` samples; the last sample is the focal instant. The
    /// natural frequencies of the modes are multiplied by `stretch`.
    ///
    /// # Errors
    /// [`FocusError::Count`] for too many samples of too many modes.
    pub fn single(
        responses: &'r ModalResponses,
        length: usize,
        stretch: f64,
        keeps: Keeps,
        accuracy: f64,
    ) -> Result<Self, FocusError> {
        fits("samples of the window times modes", length, responses.poles.len())?;
        let rate = responses.conditions.rate;
        let poles = stretched(&responses.poles, stretch);
        let table = match keeps {
            Keeps::Velocity => ringing(responses, length, stretch),
            Keeps::Displacement => Mat::from_fn(length, poles.len(), |j, m| {
                poles[m].omega * poles[m].displacement((length - 1 - j) as f64 / rate) / rate
            }),
        };
        let synth = (keeps == Keeps::Velocity).then(|| ModalSynth::new(&poles, rate, length, accuracy));
        Ok(Self { responses, table, synth })
    }

    /// Modes in the steady state under periodic drives with a period of `length` samples; the last sample of a period is the focal instant.
    /// The natural frequencies of the modes are multiplied by `stretch`.
    ///
    /// # Errors
    /// [`FocusError::Count`] if a mode never becomes steady, and for too many samples of too many modes.
    pub fn periodic(responses: &'r ModalResponses, length: usize, stretch: f64) -> Result<Self, FocusError> {
        Ok(Self { responses, table: steady(responses, length, stretch)?, synth: None })
    }

    /// Number of modes.
    pub fn modes(&self) -> usize {
        self.table.ncols()
    }

    /// Gram matrix `G Gᵀ'` of the maps G from drives to the states of two plants, modes x modes: `(BᵀB') ∘
    /// (VᵀV')` with B the input weights of the plants and V their modes' velocities at the focal instant
    /// after an impulse at each sample.
    pub fn gram(&self, other: &Self) -> Mat<f64> {
        let inputs = product(self.responses.input.transpose(), other.responses.input.as_ref());
        let tables = product(self.table.transpose(), other.table.as_ref());
        Mat::from_fn(self.modes(), other.modes(), |i, j| inputs[(i, j)] * tables[(i, j)])
    }

    /// Adds the drive `Gᵀ z` to the channels, each a row of samples; G is the map from drives to the modes'
    /// velocities.
    pub fn emit(&self, z: &[f64], channels: &mut [f64]) -> Result<(), FocusError> {
        let input = &self.responses.input;
        let (length, rate) = (self.table.nrows(), self.responses.conditions.rate);
        let weights = Mat::from_fn(input.nrows(), input.ncols(), |a, m| input[(a, m)] * z[m]);
        if let Some(synth) = &self.synth {
            let mut rows = vec![0.0; channels.len()];
            synth.respond(weights.as_ref(), &mut rows)?;
            for (channel, row) in channels.chunks_exact_mut(length).zip(rows.chunks_exact(length)) {
                channel.iter_mut().zip(row.iter().rev()).for_each(|(d, h)| *d += h / rate);
            }
            return Ok(());
        }
        let mut made = Mat::<f64>::zeros(length, input.nrows());
        multiply(made.as_mut(), Accum::Replace, self.table.as_ref(), weights.transpose(), 1.0, Par::Seq);
        for (a, channel) in channels.chunks_exact_mut(length).enumerate() {
            channel.iter_mut().zip(made.col_as_slice(a)).for_each(|(d, made)| *d += made);
        }
        Ok(())
    }

    /// Weights that give the velocity at points from the modes' velocities, modes x points.
    pub fn readout(&self, points: &[Point]) -> Mat<f64> {
        let &[point] = points else { return self.responses.shapes.at_all(points).transpose().to_owned() };
        let mut row = vec![0.0; self.responses.shapes.modes()];
        self.responses.shapes.at(point, &mut row);
        Mat::from_fn(row.len(), 1, |m, _| row[m])
    }

    /// Weights that give the velocity at cells all over the surface from the modes' velocities, modes x
    /// cells, and the cells' centres (m).
    pub fn cells(&self) -> (Mat<f64>, Vec<Point>) {
        let points = lattice(self.responses);
        (self.readout(&points), points)
    }

    /// Velocity of each mode at the focal instant after an impulse at each sample of each channel: samples x modes.
    pub fn map(&self) -> Mat<f64> {
        let (length, input) = (self.table.nrows(), &self.responses.input);
        Mat::from_fn(length * input.nrows(), self.modes(), |row, m| {
            input[(row / length, m)] * self.table[(row % length, m)]
        })
    }
}

/// Centres of the cells all over a surface in which velocity is minimised, in metres.
pub(super) fn lattice(responses: &ModalResponses) -> Vec<Point> {
    let conditions = &responses.conditions;
    let (width, height) = conditions.outline.extent();
    let count = |side: f64| (CELLS * side / conditions.lambda_min).ceil().max(1.0) as usize;
    let (columns, rows) = (count(width), count(height));
    let centre = |cell: usize| {
        let at = |i: usize, count: usize, side: f64| (i as f64 + 0.5) / count as f64 * side;
        Point::new(at(cell % columns, columns, width), at(cell / columns, rows, height))
    };
    (0..columns * rows).map(centre).filter(|p| conditions.outline.contains(*p)).collect()
}

/// Velocity of each mode at the end of one window after an impulse at each sample, over the rate: samples x modes.
pub(super) fn ringing(responses: &ModalResponses, length: usize, stretch: f64) -> Mat<f64> {
    let (poles, rate) = (stretched(&responses.poles, stretch), responses.conditions.rate);
    Mat::from_fn(length, poles.len(), |j, m| poles[m].velocity((length - 1 - j) as f64 / rate) / rate)
}

/// Velocity of each mode at the end of a period, after an impulse at each sample that is repeated with the period
/// without end, over the rate: samples x modes.
///
/// The state after the kicks of all periods is that after `(1 - A)⁻¹` times one kick, A the free motion over a period.
///
/// # Errors
/// [`FocusError::Count`] if a mode never becomes steady, and for too many samples of too many modes.
pub(super) fn steady(
    responses: &ModalResponses,
    length: usize,
    stretch: f64,
) -> Result<Mat<f64>, FocusError> {
    fits("samples of the period times modes", length, responses.poles.len())?;
    let (poles, rate) = (stretched(&responses.poles, stretch), responses.conditions.rate);
    let mut table = Mat::zeros(length, poles.len());
    for (m, pole) in poles.iter().enumerate() {
        let [[a, b], [c, d]] = pole.step(length as f64 / rate);
        let determinant = (1.0 - a) * (1.0 - d) - b * c;
        // 1 - A is singular for a mode that keeps its energy for ever.
        if determinant.is_nan() || determinant.abs() <= 1e-12 {
            let expected = "one, since a mode without losses never reaches a steady state".to_owned();
            return Err(FocusError::Count { what: "duration of a repeated drive", expected, found: 0 });
        }
        let [u, v] = pole.kick();
        let steady = [((1.0 - d) * u + b * v) / determinant, (c * u + (1.0 - a) * v) / determinant];
        for (j, to) in table.col_as_slice_mut(m).iter_mut().enumerate() {
            let [_, [c, d]] = pole.step((length - 1 - j) as f64 / rate);
            *to = (c * steady[0] + d * steady[1]) / rate;
        }
    }
    Ok(table)
}

fn stretched(poles: &[Pole], stretch: f64) -> Vec<Pole> {
    poles.iter().map(|pole| Pole { omega: pole.omega * stretch, ..*pole }).collect()
}
