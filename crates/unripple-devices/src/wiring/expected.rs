//! Responses from each output to each input, predicted by a model.

use crate::DevicesError;
use crate::error::same;
use unripple_core::{ModalResponses, Point, Surface, require};
use unripple_physics::{Sensor, sensed, sensors};

/// The impulse responses from each output to each input that a model predicts.
///
/// ```
/// use unripple_devices::Expected;
///
/// let expected = Expected::new(vec![vec![vec![1.0, 0.5], vec![0.0, 0.2]]])?;
/// assert_eq!((expected.outputs(), expected.inputs(), expected.samples()), (1, 2, 2));
/// assert_eq!(expected.response(0, 1), [0.0, 0.2]);
/// # Ok::<(), unripple_devices::DevicesError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    outputs: usize,
    inputs: usize,
    samples: usize,
    data: Vec<f64>,
}

impl Expected {
    /// Expected responses from the values `[output][input][sample]`, each per unit impulse of drive in the
    /// actuator's unit.
    ///
    /// # Errors
    /// [`DevicesError::Size`] unless all rows are equally long, [`DevicesError::Range`] for a value that is not finite.
    pub fn new(responses: Vec<Vec<Vec<f64>>>) -> Result<Self, DevicesError> {
        let outputs = responses.len();
        let inputs = responses.first().map_or(0, Vec::len);
        let samples = responses.first().and_then(|row| row.first()).map_or(0, Vec::len);
        for row in &responses {
            same("inputs in a row of expected responses", row.len(), inputs)?;
            for response in row {
                same("samples of an expected response", response.len(), samples)?;
                for h in response {
                    require("sample of an expected response", true, "a finite number", *h)?;
                }
            }
        }
        Ok(Self { outputs, inputs, samples, data: responses.concat().concat() })
    }

    /// Expected responses of a surface's actuators as sensors, in the unit of each [`Sensor`], and of the
    /// velocity (m/s) at a probe, if there is one, as the last input, for `duration` seconds.
    ///
    /// # Errors
    /// [`DevicesError::Physics`] for actuators that are not valid, [`DevicesError::Size`] if the responses have another number of
    /// them.
    pub fn of(
        surface: &Surface,
        responses: &ModalResponses,
        probe: Option<Point>,
        duration: f64,
    ) -> Result<Self, DevicesError> {
        let sensors = sensors(surface)?;
        same("actuators of the wiring's model", responses.ports.len(), sensors.len())?;
        let weights = sensed(&sensors, responses);
        let heard = (0..sensors.len()).map(|a| weights.row(a).iter().copied().collect()).collect();
        Ok(Self::heard(responses, heard, &sensors, probe, duration))
    }

    /// Expected responses as of [`Expected::of`], for actuators whose sensors have the mode weights of their
    /// drives, such as ideal forces; `duration` is in s.
    pub fn of_modes(responses: &ModalResponses, probe: Option<Point>, duration: f64) -> Self {
        let input = &responses.input;
        let heard = (0..input.nrows()).map(|a| input.row(a).iter().copied().collect()).collect();
        Self::heard(responses, heard, &[], probe, duration)
    }

    /// Responses from the weight of each oscillation at each input, `felt`. The first inputs have the circuits of `sensors`; the
    /// others are velocities.
    fn heard(
        responses: &ModalResponses,
        mut felt: Vec<Vec<f64>>,
        sensors: &[Sensor],
        probe: Option<Point>,
        duration: f64,
    ) -> Self {
        let ModalResponses { ports, poles, input, shapes, conditions, .. } = responses;
        let samples = (duration.clamp(0.0, 60.0) * conditions.rate).ceil() as usize;
        let outputs = ports.len();
        if let Some(at) = probe {
            let mut row = vec![0.0; poles.len()];
            shapes.at(at, &mut row);
            felt.push(row);
        }
        let inputs = felt.len();
        let mut data = vec![0.0; outputs * inputs * samples];
        for (m, pole) in poles.iter().enumerate() {
            let ring: Vec<f64> = (0..samples).map(|i| pole.velocity(i as f64 / conditions.rate)).collect();
            for (pair, response) in data.chunks_exact_mut(samples.max(1)).enumerate() {
                let weight = input[(pair / inputs, m)] * felt[pair % inputs][m];
                response.iter_mut().zip(&ring).for_each(|(h, v)| *h += weight * v);
            }
        }
        for (pair, response) in data.chunks_exact_mut(samples.max(1)).enumerate() {
            if let Some(sensor) = sensors.get(pair % inputs) {
                response.copy_from_slice(&sensor.signal(response, conditions.rate));
            }
        }
        Self { outputs, inputs, samples, data }
    }

    /// Number of outputs, one for each actuator.
    pub fn outputs(&self) -> usize {
        self.outputs
    }

    /// Number of inputs: sensors, then a probe if there is one.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// Number of samples in each response.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Impulse response from an output to an input, one value per sample in the input's unit per unit of
    /// drive and second; empty for an index beyond the last output.
    pub fn response(&self, output: usize, input: usize) -> &[f64] {
        let start = (output * self.inputs + input) * self.samples;
        self.data.get(start..start + self.samples).unwrap_or(&[])
    }
}
