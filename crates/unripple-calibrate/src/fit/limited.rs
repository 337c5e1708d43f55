use super::basis::Basis;
use super::layout::{Layout, Values};
use super::loaded::LoadedModes;
use super::system::System;
use crate::CalibrateError;
use faer::Mat;
use unripple_dsp::{Band, ModalSynth, shift};

/// Error of the synthesis, over the sum of magnitudes.
const ACCURACY: f64 = 1e-6;

/// Samples before time 0 that what comes early is drawn from.
const BEFORE: usize = 64;

/// What a model says of responses between actuators, in the order of [`Pairs`](super::Pairs), from time 0 on.
#[derive(Clone, Debug)]
pub(super) struct Limited {
    /// As they are.
    pub whole: Vec<Vec<f64>>,
    /// As they are measured: limited to a band without phase, late, and without what then precedes time 0.
    pub cut: Vec<Vec<f64>>,
    /// Seconds by which they are late.
    pub late: f64,
}

impl Limited {
    /// The responses of some values by the first `count` nominal modes, as many samples as measured.
    ///
    /// A band with soft edges rings for the inverse of their width, forth and back. What rings back is cut off when responses are
    /// kept from time 0 on, and what is left has other spectra than the model's.
    pub fn new(
        basis: &Basis,
        layout: &Layout,
        values: &Values,
        (count, top): (usize, f64),
        (band, rate, samples): (Band, f64, usize),
    ) -> Result<Self, CalibrateError> {
        let system = System::new(basis, layout, values, &[], (count, top))?;
        let modes = LoadedModes::new(basis, &system, values, [0.0, band.high[1]])?;
        let actuators = layout.actuators;
        let weights = Mat::from_fn(actuators * actuators, modes.poles.len(), |n, m| {
            let (driven, heard) = (n / actuators, n % actuators);
            let gain = (values.drive[driven] + values.sense[heard]).exp();
            gain * modes.weights[(driven, m)] * modes.weights[(heard, m)]
        });
        let mut all = vec![0.0; weights.nrows() * samples];
        ModalSynth::new(&modes.poles, rate, samples, ACCURACY).respond(weights.as_ref(), &mut all)?;
        let whole: Vec<Vec<f64>> = all.chunks(samples).map(<[f64]>::to_vec).collect();
        let cut = |response: &Vec<f64>| {
            let mut signal = vec![0.0; BEFORE];
            signal.extend(response);
            band.limit(&mut signal, rate)?;
            Ok(shift(&signal, values.late * rate).split_off(BEFORE))
        };
        let cut = whole.iter().map(cut).collect::<Result<_, CalibrateError>>()?;
        Ok(Self { whole, cut, late: values.late })
    }
}
