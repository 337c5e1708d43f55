//! What was measured, held against a model that is fitted to what the sensors heard.

use super::shelf::Shelf;
use crate::error::CliError;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use unripple::core::{ModalResponses, Point, SampledResponses, Surface};
use unripple::dsp::{Band, shift};
use unripple_calibrate::Measured;
use unripple_calibrate::measure::MeasureOptions;
use unripple_calibrate::verify::{self, Checked, Verified, VerifyOptions};
use unripple_store::{Doubt, Library, PointState, Take};

/// The check that finds responses which no model of the surface makes.
const CHECK: &str = "model";

/// What is kept of the probe's own delay.
const PROBE: &str = "probe";

/// Delays that are not worth another copy of the library, in samples.
const NONE: f64 = 0.02;

/// Says of each probed point whether a model makes what was heard there; takes the probe's own delay, and gains that are not those of
/// the other points, out of them.
pub fn check(
    shelf: &mut Shelf,
    surface: &Surface,
    model: &ModalResponses,
    settings: &MeasureOptions,
) -> Result<(), CliError> {
    let measured = (0..shelf.probed).filter(|p| shelf.library.state(*p) == Some(PointState::Measured));
    let points: Vec<usize> = measured.collect();
    if points.is_empty() {
        return Ok(shelf.library.set_doubts(CHECK, Vec::new())?);
    }
    let probed = probed(&shelf.library, &points, model)?;
    let removed: Vec<f64> = points.iter().map(|p| removed(&shelf.library, *p)).collect();
    let options = VerifyOptions {
        model: settings.model,
        probe_delay: settings.probe_delay,
        removed: removed.clone(),
        dead: shelf.without.clone(),
        probe: shelf.library.plan().provenance.get("by").is_none_or(|by| by != "tap"),
        numbers: points.iter().map(|p| p + 1).collect(),
        ..VerifyOptions::default()
    };
    let heard = heard(shelf, surface, settings)?;
    let found = verify::check(surface, &heard, &probed, &options)?;
    correct(&mut shelf.library, &points, &removed, &probed, &found)?;
    say(&mut shelf.library, &points, &found)
}

/// The probed responses of some points.
fn probed(library: &Library, points: &[usize], model: &ModalResponses) -> Result<SampledResponses, CliError> {
    let places: Vec<Point> = points.iter().map(|p| library.points()[*p]).collect();
    let mut data = Vec::new();
    for point in points {
        data.extend(library.get(*point)?);
    }
    let (ports, conditions) = (model.ports.clone(), model.conditions.clone());
    SampledResponses::new(ports, places, conditions, library.plan().samples, data).map_err(CliError::work)
}

/// What actuators hear of each other, as far as it was measured.
fn heard(shelf: &Shelf, surface: &Surface, settings: &MeasureOptions) -> Result<Measured, CliError> {
    let (library, count) = (&shelf.library, surface.actuators.len());
    let mut responses = vec![Vec::new(); count * count];
    let mut power = [0.0, 0.0];
    for sensor in 0..count {
        let point = shelf.probed + sensor;
        if library.state(point) != Some(PointState::Measured) {
            continue;
        }
        for (driven, response) in library.get(point)?.chunks_exact(library.plan().samples).enumerate() {
            responses[driven * count + sensor] = response.iter().map(|h| f64::from(*h)).collect::<Vec<_>>();
            power[0] += response.iter().map(|h| f64::from(*h).powi(2)).sum::<f64>();
            power[1] += response.len() as f64;
        }
    }
    let [from, to] = settings.swept(surface);
    let noise = 1e-3 * (power[0] / power[1].max(1.0)).sqrt();
    let measured = Measured::pairs(surface.emission.rate, responses, noise.max(f64::MIN_POSITIVE));
    Ok(measured.limited_to(Band::within(from, to)))
}

/// Seconds that were taken out of a point before, as its log has it: what is measured again has none.
fn removed(library: &Library, point: usize) -> f64 {
    let kept = library.logged_point(point).and_then(|log| log[CHECK]["delay_s"].as_f64());
    kept.unwrap_or(0.0)
}

/// Takes delays, and gains that are not those of the others, out of the library's responses, and keeps what was done in each point's
/// log.
fn correct(
    library: &mut Library,
    points: &[usize],
    removed: &[f64],
    probed: &SampledResponses,
    found: &Verified,
) -> Result<(), CliError> {
    let (rate, ports) = (probed.conditions.rate, probed.ports.len());
    for (n, (point, verdict)) in points.iter().zip(&found.points).enumerate() {
        let factor = verdict.correction.filter(|_| verdict.doubt.is_none()).unwrap_or(1.0);
        let delay = found.probe_delay.unwrap_or(removed[n]);
        let late = (delay - removed[n]) * rate;
        if late.abs() <= NONE && factor == 1.0 {
            continue;
        }
        let mut samples: Vec<f32> = Vec::with_capacity(ports * probed.samples());
        for actuator in 0..ports {
            let response: Vec<f64> = probed.response(actuator, n).iter().map(|h| f64::from(*h)).collect();
            samples.extend(shift(&response, -late).iter().map(|h| (factor * h) as f32));
        }
        // Gain and delay leave both as they are.
        let quality = library.quality(*point)?;
        let bands = library.band_quality(*point)?.unwrap_or_default();
        // In the log first: whoever is killed in between finds a point that is doubted, not one that is shifted twice.
        let before = library.logged_point(*point).and_then(|log| log[CHECK]["times"].as_f64()).unwrap_or(1.0);
        let log = json!({ CHECK: { "delay_s": delay, "times": before * factor } });
        library.log_points(BTreeMap::from([(*point, log)]))?;
        let state = PointState::Measured;
        let take = Take { point: *point, samples: &samples, quality: &quality, bands: &bands, state };
        library.put_all(&[take])?;
    }
    let said = found.probe_delay.map_or(Value::Null, |delay| {
        json!({
            "delay_s": delay,
            "said": format!(
                "the probe comes {:.3} ms later than the sensors: taken out (--probe-delay-ms says what it is)",
                1e3 * delay
            ),
        })
    });
    Ok(library.log(PROBE, said)?)
}

/// Keeps what was found in the library.
fn say(library: &mut Library, points: &[usize], found: &Verified) -> Result<(), CliError> {
    let doubts = found
        .doubts
        .iter()
        .map(|doubt| Doubt::of(CHECK, &doubt.what).at(doubt.points.iter().map(|p| points[*p]).collect()));
    library.set_doubts(CHECK, doubts.collect())?;
    let log = match &found.model {
        Checked::Not { why } => json!({
            "checked": false,
            "said": format!("not checked against a model ({why}): a recording of another place is not told from a good one"),
        }),
        Checked::Against { band, unexplained } => {
            let mut log = json!({ "checked": true, "band_hz": band, "unexplained": unexplained });
            let each: Vec<Value> = points
                .iter()
                .zip(&found.points)
                .map(|(p, point)| {
                    json!({
                        "point": p,
                        "unexplained": point.unexplained,
                        "gain": point.gain,
                        "late_s": point.late,
                        "fits_m": point.fits.map(|(at, _)| [at.x, at.y]),
                        "multiplied_by": point.correction,
                    })
                })
                .collect();
            log["points"] = Value::Array(each);
            if !found.notes.is_empty() {
                log["said"] = Value::String(found.notes.join("; "));
            }
            log
        }
    };
    Ok(library.log(CHECK, log)?)
}
