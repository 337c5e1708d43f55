//! Responses under another tension: every mode moved along the dispersion relation.

use std::f64::consts::TAU;
use unripple_core::{CoreError, ModalResponses, Pole, SampledResponses};
use unripple_dsp::FourierPlanner;
use unripple_physics::Medium;

/// Length of the Fourier transform relative to that of the response, so that the response's end does not
/// wrap into its beginning.
const PADDED: usize = 4;

/// An oscillation under tension `ratio` times as large, with `share` the share of bending in its elastic
/// energy: `ω² = ω0² (1 + (ratio - 1)(1 - share))`, its decay rate unchanged.
pub(super) fn tuned(pole: &Pole, share: f64, ratio: f64) -> Pole {
    Pole { omega: pole.omega * (1.0 + (ratio - 1.0) * (1.0 - share)).max(0.0).sqrt(), ..*pole }
}

/// Transforms responses to another tension: every frequency moves along the dispersion relation. This is not a mere stretch
/// of the frequency axis, since bending stiffness does not change.
///
/// Waves of wavenumber k have `ω² = k² (R + D k²)/ρ`, with tension R, bending stiffness D and mass per area ρ. Mode shapes,
/// and so wavenumbers, are taken as unchanged; tension R becomes `ratio · R`, and each frequency moves by the share of
/// tension in its elastic energy. This is exact to first order in the change of the shapes.
///
/// ```
/// use unripple_calibrate::Warp;
/// use unripple_physics::Medium;
///
/// let film = Medium { areal_density: 0.175, tension: 200.0, bending_stiffness: 7.15e-4, air_sides: 0.0 };
/// let warp = Warp::new(&film);
/// let (low, high) = (std::f64::consts::TAU * 160.0, std::f64::consts::TAU * 3000.0);
/// assert!((warp.omega(low, 1.01) / low - 1.005).abs() < 1e-4);
/// assert!((warp.omega(high, 1.01) / high - 1.003).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warp {
    medium: Medium,
}

impl Warp {
    /// A transform of responses for waves in `medium`, whose tension is the nominal one.
    pub fn new(medium: &Medium) -> Self {
        Self { medium: *medium }
    }

    /// Share of bending in the elastic energy of a wave of angular frequency `omega` (rad/s) at nominal
    /// tension.
    pub fn bending_share(&self, omega: f64) -> f64 {
        self.medium.bending_share(self.medium.wavenumber(omega))
    }

    /// The angular frequency (rad/s) to which `omega` (rad/s) changes when the tension is `ratio` times as
    /// large.
    pub fn omega(&self, omega: f64, ratio: f64) -> f64 {
        tuned(&Pole::new(omega, 0.0), self.bending_share(omega), ratio).omega
    }

    /// Modal responses under tension `ratio` times as large: their poles change, and nothing else.
    pub fn modal(&self, responses: &ModalResponses, ratio: f64) -> ModalResponses {
        let shares: Vec<f64> = responses.poles.iter().map(|pole| self.bending_share(pole.omega)).collect();
        warped(responses, &shares, ratio)
    }

    /// A sampled response under tension `ratio` times as large, of the same length; `rate` is in Hz. Each frequency component
    /// is moved: `h'(t) = 1/π Re ∫ H(ω) e^{jω't} dω`. This multiplies decay rates by the slope of ω'(ω), which is compensated
    /// for a decay rate `sigma` (1/s). Samples within a few periods of the end are inaccurate, since the response is cut
    /// there.
    pub fn signal(&self, signal: &[f64], rate: f64, ratio: f64, sigma: f64) -> Vec<f64> {
        let samples = signal.len();
        if samples == 0 || ratio == 1.0 {
            return signal.to_vec();
        }
        let size = (PADDED * samples).next_multiple_of(2);
        let plan = FourierPlanner::new().forward(size);
        let (mut input, mut spectrum) = (plan.make_input_vec(), plan.make_output_vec());
        input[..samples].copy_from_slice(signal);
        if plan.process(&mut input, &mut spectrum).is_err() {
            return signal.to_vec();
        }
        let top = spectrum.iter().map(|x| x.norm()).fold(0.0, f64::max);
        let mut out = vec![0.0; samples];
        for (k, value) in spectrum.iter().enumerate().skip(1).filter(|(_, x)| x.norm() > 1e-7 * top) {
            let omega = TAU * k as f64 * rate / size as f64;
            let turn = unripple_dsp::Complex::from_polar(1.0, self.omega(omega, ratio) / rate);
            let slope = self.omega(omega * 1.001, ratio) - self.omega(omega * 0.999, ratio);
            let decay = ((slope / (0.002 * omega) - 1.0) * sigma / rate).exp();
            let mut phasor = value * (2.0 / size as f64);
            let turn = turn * decay;
            for sample in &mut out {
                *sample += phasor.re;
                phasor *= turn;
            }
        }
        out
    }

    /// All sampled responses under tension `ratio` times as large; `sigma` is the decay rate (1/s) for which
    /// [`Warp::signal`] compensates.
    ///
    /// # Errors
    /// Those of [`SampledResponses::new`].
    pub fn sampled(
        &self,
        responses: &SampledResponses,
        ratio: f64,
        sigma: f64,
    ) -> Result<SampledResponses, CoreError> {
        use rayon::prelude::*;
        let (ports, rate) = (responses.ports.len(), responses.conditions.rate);
        let one = |n: usize| -> Vec<f32> {
            let signal: Vec<f64> =
                responses.response(n % ports, n / ports).iter().map(|v| f64::from(*v)).collect();
            self.signal(&signal, rate, ratio, sigma).iter().map(|v| *v as f32).collect()
        };
        let data: Vec<f32> = (0..ports * responses.points.len()).into_par_iter().flat_map_iter(one).collect();
        SampledResponses::new(
            responses.ports.clone(),
            responses.points.clone(),
            responses.conditions.clone(),
            responses.samples(),
            data,
        )
    }
}

/// Modal responses under tension `ratio` times as large, from the share of bending in each mode's elastic
/// energy.
pub(super) fn warped(responses: &ModalResponses, shares: &[f64], ratio: f64) -> ModalResponses {
    let poles = responses.poles.iter().zip(shares).map(|(pole, share)| tuned(pole, *share, ratio)).collect();
    ModalResponses { poles, ..responses.clone() }
}
