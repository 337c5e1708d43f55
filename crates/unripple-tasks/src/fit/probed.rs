//! The probed points of a library, checked against the model fitted to its actuators.

use super::measurements::Measurements;
use crate::TaskError;
use crate::late::comes;
use unripple::core::{SampledResponses, Surface};
use unripple_calibrate::Fitted;
use unripple_calibrate::signals::shift;
use unripple_calibrate::verify::{Checked, Verified, VerifyOptions, check_by};

/// Probed points of a library, by which a fitted model is corrected.
pub struct Probed {
    /// Responses at the points that agree with the model, corrected to a common gain and for the probe's
    /// delay.
    pub good: SampledResponses,
    /// Reasons why the other points are left out.
    pub left_out: Vec<String>,
    /// Doubts about the whole recording rather than single points; no point is left out because of them.
    pub doubts: Vec<String>,
    /// Notes on the check that are no reason for doubt.
    pub notes: Vec<String>,
    /// Gain of the probe relative to the sensors (ratio).
    pub gain: f64,
}

impl Probed {
    /// Checks the probed points of a library against a fitted model.
    pub fn of(fitted: &Fitted, surface: &Surface, measurements: &Measurements) -> Result<Self, TaskError> {
        let options = VerifyOptions {
            numbers: measurements.numbers.clone(),
            dead: measurements.dead.clone(),
            probe: measurements.probe,
            ..VerifyOptions::default()
        };
        if measurements.probed.points.is_empty() {
            let good = measurements.probed.clone();
            let (left_out, doubts, notes) = (Vec::new(), Vec::new(), Vec::new());
            return Ok(Self { good, left_out, doubts, notes, gain: 1.0 });
        }
        let found = check_by(fitted, surface, &measurements.measured, &measurements.probed, &options)?;
        let doubted = |p: &usize| found.doubts.iter().any(|doubt| doubt.points.contains(p));
        let kept: Vec<usize> = (0..measurements.probed.points.len()).filter(|p| !doubted(p)).collect();
        let good = measurements.probed.select(&kept).map_err(TaskError::work)?;
        let factors: Vec<f64> = kept
            .iter()
            .map(|p| found.points.get(*p).and_then(|point| point.correction).unwrap_or(1.0))
            .collect();
        let late = found.probe_delay.unwrap_or(0.0) * good.conditions.rate;
        let notes = notes(&found);
        let (of_all, of_points): (Vec<_>, Vec<_>) =
            found.doubts.into_iter().partition(|doubt| doubt.points.is_empty());
        Ok(Self {
            good: corrected(&good, &factors, late)?,
            left_out: of_points.into_iter().map(|doubt| doubt.what).collect(),
            doubts: of_all.into_iter().map(|doubt| doubt.what).collect(),
            notes,
            gain: found.gain.filter(|gain| gain.is_finite() && *gain != 0.0).unwrap_or(1.0),
        })
    }
}

/// Notes on the check, or on why nothing could be checked.
fn notes(found: &Verified) -> Vec<String> {
    let mut notes = found.notes.clone();
    if let Checked::Not { why } = &found.model {
        notes.push(format!("probed points are taken as they are, not checked against the model: {why}"));
    }
    if let Some(delay) = found.probe_delay {
        notes.push(comes(delay));
    }
    notes
}

/// The responses of each point multiplied by its factor, and shifted to be earlier by `late` samples.
fn corrected(
    responses: &SampledResponses,
    factors: &[f64],
    late: f64,
) -> Result<SampledResponses, TaskError> {
    let ports = responses.ports.len();
    let mut data = Vec::with_capacity(factors.len() * ports * responses.samples());
    for (point, factor) in factors.iter().enumerate() {
        for port in 0..ports {
            let row: Vec<f64> = responses.response(port, point).iter().map(|h| f64::from(*h)).collect();
            let row = if late == 0.0 { row } else { shift(&row, -late) };
            data.extend(row.into_iter().map(|h| (factor * h) as f32));
        }
    }
    let SampledResponses { ports, points, conditions, .. } = responses.clone();
    SampledResponses::new(ports, points, conditions, responses.samples(), data).map_err(TaskError::work)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_probe_that_comes_first_is_not_said_to_come_later() {
        let found = Verified {
            model: Checked::Against { band: [100.0, 1000.0], unexplained: 0.01 },
            points: Vec::new(),
            probe_delay: Some(-0.5e-3),
            gain: None,
            notes: Vec::new(),
            copies: Vec::new(),
            doubts: Vec::new(),
        };
        assert_eq!(
            notes(&found),
            ["the probe's signals arrive 0.500 ms earlier than those of the sensors: corrected"]
        );
    }
}
