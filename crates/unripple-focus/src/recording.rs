//! Velocity impulse responses of a target to all actuators, which time reversal plays backwards.

use crate::magnitude::energy;
use crate::modal::ModalRecorder;
use crate::{FocusError, LossCorrection, Options};
use unripple_core::{Point, Responses, SampledResponses};

/// Velocity impulse responses of a target to every actuator over the window, as input to time reversal.
#[derive(Clone, Debug)]
pub(crate) struct Recording {
    /// Samples 0 … n of the response to every actuator, `[actuator][sample]`.
    pub samples: Vec<f64>,
    /// The points at which these responses were computed or stored.
    pub points: Vec<Point>,
}

/// Reads responses over one window, from modes or from samples.
#[derive(Debug)]
pub(crate) enum Recorder<'r> {
    /// From modes, by synthesis.
    Modal(Box<ModalRecorder<'r>>),
    /// From samples, as they are stored.
    Sampled(SampledRecorder<'r>),
}

impl<'r> Recorder<'r> {
    /// Prepares to read responses over windows of `length` samples.
    pub fn plan(responses: &'r Responses, length: usize, options: &Options) -> Result<Self, FocusError> {
        match responses {
            Responses::Modal(modal) => Ok(Self::Modal(Box::new(ModalRecorder::plan(modal, length, options)))),
            Responses::Sampled(sampled) => {
                if options.loss == LossCorrection::PerMode {
                    return Err(FocusError::NeedsModes(
                        "loss correction per mode (uniform correction needs none)",
                    ));
                }
                Ok(Self::Sampled(SampledRecorder::new(sampled, length)?))
            }
        }
    }

    /// The sum of the responses at all points (m), actuators x samples. It is scaled so that, played
    /// backwards, it gives the points the mean velocity that separate foci, one made for each point, would
    /// give.
    pub fn record(&self, target: usize, points: &[Point]) -> Result<Recording, FocusError> {
        let (mut samples, energies, points) = match self {
            Self::Modal(modal) => {
                let (sum, energies) = modal.record(points)?;
                (sum, energies, points.to_vec())
            }
            Self::Sampled(sampled) => sampled.record(target, points)?,
        };
        let together = energy(&samples);
        let at = points.first().copied().unwrap_or_default();
        if !(together.is_finite() && together > 0.0) {
            return Err(FocusError::Still { target, at });
        }
        if points.len() > 1 {
            samples.iter_mut().for_each(|h| *h *= energies / together);
        }
        Ok(Recording { samples, points })
    }
}

/// Reads responses that were sampled at fixed points.
#[derive(Debug)]
pub(crate) struct SampledRecorder<'r> {
    responses: &'r SampledResponses,
    length: usize,
}

impl<'r> SampledRecorder<'r> {
    /// Prepares to read the first `length` samples of the stored responses.
    ///
    /// # Errors
    /// [`FocusError::Count`] if responses are shorter.
    pub fn new(responses: &'r SampledResponses, length: usize) -> Result<Self, FocusError> {
        if length > responses.samples() {
            let expected = format!("at most {}, the length of the responses", responses.samples());
            return Err(FocusError::Count { what: "samples of the window", expected, found: length });
        }
        Ok(Self { responses, length })
    }

    /// The sum of the responses at all points, the sum of their energies, and the stored points used for
    /// them.
    fn record(&self, target: usize, points: &[Point]) -> Result<(Vec<f64>, f64, Vec<Point>), FocusError> {
        let actuators = self.responses.ports.len();
        let mut sum = vec![0.0; actuators * self.length];
        let mut energies = 0.0;
        let mut used = Vec::with_capacity(points.len());
        for &at in points {
            let stored = locate(self.responses, target, at)?;
            used.push(self.responses.points[stored]);
            for (actuator, row) in sum.chunks_exact_mut(self.length).enumerate() {
                let response = &self.responses.response(actuator, stored)[..self.length];
                for (to, &h) in row.iter_mut().zip(response) {
                    *to += f64::from(h);
                    energies += f64::from(h) * f64::from(h);
                }
            }
        }
        Ok((sum, energies, used))
    }
}

/// Index of the stored point used for a place (m): the nearest, at most λ_min/4 away, where a focus still
/// has most of its height.
pub(crate) fn locate(responses: &SampledResponses, target: usize, at: Point) -> Result<usize, FocusError> {
    let reach = responses.conditions.lambda_min / 4.0;
    let stored = responses.nearest(at).ok_or(FocusError::Count {
        what: "points with responses",
        expected: "at least 1".to_owned(),
        found: 0,
    })?;
    let nearest = responses.points[stored];
    let distance = nearest.distance(at);
    if distance <= reach || distance == 0.0 {
        Ok(stored)
    } else {
        Err(FocusError::Unknown { target, at, nearest, distance, reach })
    }
}
