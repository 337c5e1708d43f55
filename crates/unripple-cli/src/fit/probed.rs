//! The probed points of a library, held against the model fitted to its actuators.

use super::heard::Heard;
use crate::error::CliError;
use unripple::core::{SampledResponses, Surface};
use unripple_calibrate::Fitted;
use unripple_calibrate::verify::{VerifyOptions, check_by};

/// Probed points that a model may be corrected by.
pub struct Probed {
    /// Those that do not contradict it, their gains made one.
    pub good: SampledResponses,
    /// Why others are left out.
    pub left_out: Vec<String>,
    /// What is worth a word of those that are not.
    pub notes: Vec<String>,
    /// Gain of the probe over the sensors.
    pub gain: f64,
}

impl Probed {
    pub fn of(fitted: &Fitted, surface: &Surface, heard: &Heard) -> Result<Self, CliError> {
        let options = VerifyOptions {
            numbers: heard.numbers.clone(),
            dead: heard.dead.clone(),
            probe: heard.probe,
            ..VerifyOptions::default()
        };
        if heard.probed.points.is_empty() {
            let good = heard.probed.clone();
            return Ok(Self { good, left_out: Vec::new(), notes: Vec::new(), gain: 1.0 });
        }
        let found = check_by(fitted, surface, &heard.measured, &heard.probed, &options)?;
        let doubted = |p: &usize| found.doubts.iter().any(|doubt| doubt.points.contains(p));
        let kept: Vec<usize> = (0..heard.probed.points.len()).filter(|p| !doubted(p)).collect();
        let good = heard.probed.select(&kept).map_err(CliError::work)?;
        let factors: Vec<f64> = kept
            .iter()
            .map(|p| found.points.get(*p).and_then(|point| point.correction).unwrap_or(1.0))
            .collect();
        Ok(Self {
            good: multiplied(&good, &factors)?,
            left_out: found.doubts.into_iter().map(|doubt| doubt.what).collect(),
            notes: found.notes,
            gain: found.gain.filter(|gain| gain.is_finite() && *gain != 0.0).unwrap_or(1.0),
        })
    }
}

/// Responses of each point times its factor.
fn multiplied(responses: &SampledResponses, factors: &[f64]) -> Result<SampledResponses, CliError> {
    let ports = responses.ports.len();
    let mut data = Vec::with_capacity(factors.len() * ports * responses.samples());
    for (point, factor) in factors.iter().enumerate() {
        for port in 0..ports {
            data.extend(responses.response(port, point).iter().map(|h| h * *factor as f32));
        }
    }
    let SampledResponses { ports, points, conditions, .. } = responses.clone();
    SampledResponses::new(ports, points, conditions, responses.samples(), data).map_err(CliError::work)
}
