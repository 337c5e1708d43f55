//! Modelled responses between actuators as they are measured: limited to the band, from time 0.

use super::basis::Basis;
use super::layout::{Layout, Values};
use super::loaded::LoadedModes;
use super::system::System;
use crate::CalibrateError;
use crate::signals::{Band, shift};
use std::f64::consts::TAU;
use unripple_dsp::{FourierPlanner, ModalSynth};
use unripple_linalg::{Mat, c64};

/// Error of the modal synthesis, relative to the sum of the weights' magnitudes: far below the noise, at least -60 dB, that
/// [`Measured`](super::Measured) assumes.
const ACCURACY: f64 = 1e-6;

/// Number of samples before time 0 in which the early ringing of the band's edges is computed. Still earlier
/// it has decayed, so that more samples change nothing.
const BEFORE: usize = 64;

/// A model's responses between actuators, in the order of [`Pairs`](super::Pairs), from time 0 on.
#[derive(Clone, Debug)]
pub(crate) struct Limited {
    /// The model's responses, not limited to a band, `[pair][sample]`.
    pub whole: Vec<Vec<f64>>,
    /// The responses `whole` as they would be measured, `[pair][sample]`: limited to a band by a zero-phase
    /// filter, delayed by `late`, and cut off before time 0.
    pub cut: Vec<Vec<f64>>,
    /// Latency of the responses `cut`, in s.
    pub late: f64,
    /// An impulse and its odd derivatives ([`DERIVATIVES`]), limited, delayed and cut off like `cut`,
    /// `[derivative][sample]`: combinations of these are all that a band-limited measurement contains of
    /// modes far above the band.
    pub far: Vec<Vec<f64>>,
}

/// Orders of the derivatives of an impulse that represent modes far above the band: 0 for an impulse within one sample, 1 for the
/// modes' compliance, 3 for their inertia, 5 for the next term.
pub(crate) const DERIVATIVES: [i32; 4] = [0, 1, 3, 5];

impl Limited {
    /// Responses for `values` by the first `count` nominal modes, as many samples as measured; `top` is the top of the surface's band
    /// in Hz.
    ///
    /// A band-pass filter rings before and after an impulse, for about the inverse of the width of its edges. The ringing before time
    /// 0 is cut off in measured responses, so that their spectra differ from those of the model.
    pub(super) fn new(
        basis: &Basis,
        layout: &Layout,
        values: &Values,
        (count, top): (usize, f64),
        (band, rate, samples): (Band, f64, usize),
    ) -> Result<Self, CalibrateError> {
        let system = System::new(basis, layout, values, &[], (count, top))?;
        // All modes of the basis; the coordinates that stand for modes left out are too fast to be sampled.
        let highest = system.sheet.squares.last().copied().unwrap_or(0.0).max(0.0).sqrt() / TAU;
        let modes = LoadedModes::new(basis, &system, values, [0.0, highest.max(band.high[1])])?;
        let actuators = layout.actuators;
        let weights = Mat::from_fn(actuators * actuators, modes.poles.len(), |n, m| {
            let (driven, heard) = (n / actuators, n % actuators);
            values.gain(driven, heard) * modes.weights[(driven, m)] * modes.weights[(heard, m)]
        });
        let mut all = vec![0.0; weights.nrows() * samples];
        ModalSynth::new(&modes.poles, rate, samples, ACCURACY).respond(weights.as_ref(), &mut all)?;
        let circuits = |(n, response): (usize, &[f64])| {
            let coils = [n / actuators, n % actuators].map(|a| basis.coil(a));
            coils.into_iter().flatten().fold(response.to_vec(), |signal, coil| coil.filtered(&signal, rate))
        };
        let whole: Vec<Vec<f64>> = all.chunks(samples).enumerate().map(circuits).collect();
        let cut = whole.iter().map(|response| through(band, response, rate, values.late));
        let cut = cut.collect::<Result<_, CalibrateError>>()?;
        let far = DERIVATIVES.map(|order| derivative(order, band, rate, samples));
        let far = far.iter().map(|h| shift(h, values.late * rate).split_off(BEFORE)).collect();
        Ok(Self { whole, cut, late: values.late, far })
    }
}

/// A response as it would be measured: limited to `band` by a zero-phase filter, delayed by `late` seconds,
/// and cut off before time 0.
pub(super) fn through(
    band: Band,
    response: &[f64],
    rate: f64,
    late: f64,
) -> Result<Vec<f64>, CalibrateError> {
    let mut signal = vec![0.0; BEFORE];
    signal.extend(response);
    band.limit(&mut signal, rate)?;
    Ok(shift(&signal, late * rate).split_off(BEFORE))
}

/// The derivative of order `order` of an impulse at sample `BEFORE`, limited to a band, with frequencies relative to the top of the
/// band.
fn derivative(order: i32, band: Band, rate: f64, samples: usize) -> Vec<f64> {
    let size = (2 * (samples + BEFORE)).next_power_of_two();
    let plan = FourierPlanner::new().inverse(size);
    let mut lines = plan.make_input_vec();
    for (k, line) in lines.iter_mut().enumerate() {
        let hz = k as f64 * rate / size as f64;
        let turned = c64::new(0.0, -TAU * hz * BEFORE as f64 / rate).exp();
        *line = c64::new(0.0, hz / band.high[1]).powi(order) * turned * band.weight(hz);
    }
    let last = lines.len() - 1;
    (lines[0].im, lines[last].im) = (0.0, 0.0);
    let mut signal = plan.make_output_vec();
    // Sizes are the plan's own, and lines 0 and last are real.
    if plan.process(&mut lines, &mut signal).is_err() {
        return vec![0.0; samples + BEFORE];
    }
    signal.truncate(samples + BEFORE);
    signal
}
