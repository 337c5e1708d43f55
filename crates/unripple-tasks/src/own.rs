//! Own points of a library: points at the actuators, measured by the actuators' own sensors, and their
//! conversion to velocities.

use crate::TaskError;
use serde_json::{Value, json};
use unripple::core::{Port, SampledResponses, Surface};
use unripple::physics::{Sensor, sensors};
use unripple_calibrate::measure::MeasureOptions;
use unripple_store::{Library, LibraryPlan, PointState, Quality};

/// Key of the log entry of libraries whose points at the actuators hold sensor signals; without this entry
/// they hold velocities.
pub const KEY: &str = "own_points";

/// Distance in metres within which a library's last point near an actuator counts as lying at it. Places
/// are written in files to a nanometre, so that rounding stays below it.
const SAME: f64 = 1e-6;

/// Value of the log entry [`KEY`]: states that points at the surface's actuators hold sensor signals, and
/// the units of these.
pub fn told(surface: &Surface) -> Result<Value, TaskError> {
    let units: Vec<&str> = sensing(surface)?.iter().map(|sensor| sensor.unit).collect();
    Ok(json!({ "hold": "what sensors heard", "units": units }))
}

/// Ratio of noise to signal amplitude; `None` if it is not known.
pub fn noise(quality: &Quality) -> Option<f64> {
    let db = quality.signal_to_noise_db;
    db.is_finite().then(|| 10f64.powf(-db / 20.0))
}

/// Sensor model of each actuator of a surface.
pub fn sensing(surface: &Surface) -> Result<Vec<Sensor>, TaskError> {
    sensors(surface).map_err(TaskError::input)
}

/// Converts a sensor's responses to velocities (m/s) of the sheet under the sensor; `heard` holds one
/// response after the other, `plan.samples` samples each. `None` for a patch, which senses the sheet's
/// bending, and for an exciter, which hardly senses motion below its resonance.
pub fn velocities(sensor: &Sensor, heard: &[f32], plan: &LibraryPlan, surface: &Surface) -> Option<Vec<f32>> {
    let rows = heard.chunks_exact(plan.samples);
    let rows: Vec<Vec<f64>> = rows.map(|row| row.iter().map(|h| f64::from(*h)).collect()).collect();
    // Responses reach as far as the sweeps do.
    let [_, top] = MeasureOptions::default().swept(surface);
    let rows = sensor.velocities(&rows, plan.conditions.rate, top)?;
    Some(rows.into_iter().flatten().map(|v| v as f32).collect())
}

/// Converts the responses of a library to velocities at all points. A point at an actuator is left out if
/// its sensor is a patch or an exciter; all of them are left out if the sensors' scale differs from the
/// probe's, since metrics over all points would mix quantities.
pub fn as_velocities(
    library: &Library,
    surface: &Surface,
    responses: SampledResponses,
) -> Result<SampledResponses, TaskError> {
    let said = |key: &str, what: &str| library.logged(key).and_then(|said| said.get(what)).is_some();
    let apart = library.logged("sensors").and_then(|said| said.get("left_out")).and_then(Value::as_bool);
    if apart != Some(true) && !said(KEY, "hold") {
        return Ok(responses);
    }
    // They are the library's last points; another may be at the same place.
    let first = library.points().len().saturating_sub(responses.ports.len());
    let measured = |actuator: usize| library.state(first + actuator) == Some(PointState::Measured);
    let place = |(actuator, port): (usize, &Port)| {
        let last = responses.points.iter().rposition(|point| point.distance(port.at) < SAME);
        last.filter(|_| measured(actuator))
    };
    let own: Vec<Option<usize>> = responses.ports.iter().enumerate().map(place).collect();
    let sensors = sensing(surface)?;
    let samples = responses.samples();
    let (mut points, mut data) = (Vec::new(), Vec::new());
    for (point, at) in responses.points.iter().enumerate() {
        let rows = (0..responses.ports.len()).flat_map(|actuator| responses.response(actuator, point));
        let rows: Vec<f32> = rows.copied().collect();
        let kept = match own.iter().position(|own| *own == Some(point)) {
            Some(_) if apart == Some(true) => None,
            Some(actuator) => velocities(&sensors[actuator], &rows, library.plan(), surface),
            None => Some(rows),
        };
        if let Some(kept) = kept {
            points.push(*at);
            data.extend(kept);
        }
    }
    // Libraries of own points alone have no others to mix with.
    if points.is_empty() {
        return Ok(responses);
    }
    let SampledResponses { ports, conditions, .. } = responses;
    SampledResponses::new(ports, points, conditions, samples, data).map_err(TaskError::work)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_a_share_of_the_signal() {
        let at = |signal_to_noise_db| noise(&Quality { signal_to_noise_db, ..Quality::UNKNOWN });
        assert!(at(20.0).is_some_and(|share| (share - 0.1).abs() < 1e-15));
        assert!(at(-20.0).is_some_and(|share| (share - 10.0).abs() < 1e-12));
        // Of nothing there is no share.
        assert_eq!((at(f64::NAN), at(f64::NEG_INFINITY)), (None, None));
    }
}
