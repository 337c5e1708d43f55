//! Responses of a fitted model at points, corrected by what was measured nearby.

use super::Fitted;
use super::limited::through;
use crate::CalibrateError;
use rayon::prelude::*;
use unripple_core::{Point, SampledResponses, require};
use unripple_physics::sample;

/// Reach of a measured point's correction, in shortest wavelengths: half the distance between an antinode of a standing wave
/// and its next node.
const REACH: f64 = 0.125;

impl Fitted {
    /// The model's responses at `points` as they would be measured, with the circuits of coils, `samples` samples of each.
    ///
    /// If the model was fitted to responses limited to a band ([`Pairs::limited`](crate::Pairs::limited)), these are limited
    /// to the same band, which extends beyond that of the surface.
    ///
    /// # Errors
    /// [`CalibrateError::Core`] for more samples than can be held.
    pub fn sampled(&self, points: &[Point], samples: usize) -> Result<SampledResponses, CalibrateError> {
        let reached = self.reached();
        let all = sample(self.sampleable(), points, samples);
        let (count, rate) = (all.ports.len(), all.conditions.rate);
        let coiled = (0..count).any(|actuator| self.coil(actuator).is_some());
        if reached.is_none() && !coiled {
            return Ok(all);
        }
        let one = |n: usize| {
            let (actuator, p) = (n % count, n / count);
            let signal: Vec<f64> = all.response(actuator, p).iter().map(|h| f64::from(*h)).collect();
            let signal =
                self.coil(actuator).map_or_else(|| signal.clone(), |coil| coil.filtered(&signal, rate));
            let signal = match reached {
                Some(reached) => through(reached.band, &signal, rate, 0.0)?,
                None => signal,
            };
            Ok(signal.into_iter().map(|h| h as f32).collect())
        };
        let rows = (0..points.len() * count).into_par_iter().map(one);
        let rows = rows.collect::<Result<Vec<Vec<f32>>, CalibrateError>>()?;
        let SampledResponses { ports, points, conditions, .. } = all;
        Ok(SampledResponses::new(ports, points, conditions, samples, rows.concat())?)
    }

    /// Responses at `points`: those of the model, corrected by responses measured nearby.
    ///
    /// The difference between measurement and model at a measured point x is added at y with the weight e^{-|x-y|²/2ℓ²}, ℓ an
    /// eighth of the shortest wavelength, divided by the sum of weights where that is above 1. At a measured point with no
    /// others near, this gives the measurement itself; far from all measured points, the model.
    ///
    /// # Errors
    /// [`CalibrateError::Count`] if the measured responses have another number of actuators; [`CalibrateError::Range`] for
    /// another sample rate.
    pub fn blend(
        &self,
        measured: &SampledResponses,
        points: &[Point],
    ) -> Result<SampledResponses, CalibrateError> {
        let model = self.modal();
        let (found, expected) = (measured.ports.len(), model.ports.len());
        if found != expected {
            let expected = expected.to_string();
            return Err(CalibrateError::Count { what: "actuators of measured responses", expected, found });
        }
        let (rate, own) = (measured.conditions.rate, model.conditions.rate);
        require("sample rate of measured responses in Hz", rate == own, "the model's", rate)?;
        let samples = measured.samples();
        let (known, wanted) = (self.sampled(&measured.points, samples)?, self.sampled(points, samples)?);
        let reach = REACH * model.conditions.lambda_min;
        let mut data = Vec::with_capacity(points.len() * expected * samples);
        for (p, point) in points.iter().enumerate() {
            let weights: Vec<f64> = (measured.points.iter())
                .map(|x| (-0.5 * (x.distance(*point) / reach).powi(2)).exp())
                .collect();
            let whole = weights.iter().sum::<f64>().max(1.0);
            for actuator in 0..expected {
                let mut row: Vec<f64> = wanted.response(actuator, p).iter().map(|v| f64::from(*v)).collect();
                for (x, weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 1e-4) {
                    let pairs = measured.response(actuator, x).iter().zip(known.response(actuator, x));
                    row.iter_mut()
                        .zip(pairs)
                        .for_each(|(r, (m, k))| *r += weight / whole * f64::from(*m - *k));
                }
                data.extend(row.into_iter().map(|v| v as f32));
            }
        }
        let (ports, conditions) = (measured.ports.clone(), model.conditions.clone());
        Ok(SampledResponses::new(ports, points.to_vec(), conditions, samples, data)?)
    }
}
