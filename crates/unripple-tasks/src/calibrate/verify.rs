//! Check of the measured points against a model that is fitted to what the sensors recorded.

use super::campaign::by_taps;
use super::filler::{CHECK, LibraryFiller};
use crate::TaskError;
use crate::late::comes;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use unripple::core::{ModalResponses, Point, SampledResponses, Surface};
use unripple::dsp::median;
use unripple_calibrate::Measured;
use unripple_calibrate::measure::MeasureOptions;
use unripple_calibrate::signals::{Band, shift};
use unripple_calibrate::verify::{self, Checked, Doubted, Verified, VerifyOptions};
use unripple_store::{Doubt, Library, PointState, Take};

/// Name of the check that finds responses which are copies of another point's; it needs no model.
const COPIES: &str = "copies";

/// Key of the library's log entry for the probe's delay relative to the sensors.
const PROBE: &str = "probe";

/// Largest delay that is not worth a correction of the library, in samples. Two hundredths of a sample turn
/// 3 kHz by half a degree.
const NONE: f64 = 0.02;

/// Checks each probed point against a model fitted to the sensors' recordings, records doubts, and corrects
/// responses for the probe's delay and for gains that differ from those of the other points.
pub fn check(
    filler: &mut LibraryFiller,
    surface: &Surface,
    model: &ModalResponses,
    settings: &MeasureOptions,
) -> Result<(), TaskError> {
    let measured = (0..filler.probed).filter(|p| filler.library.state(*p) == Some(PointState::Measured));
    let points: Vec<usize> = measured.collect();
    if points.is_empty() {
        let earlier = earlier(filler);
        filler.library.set_doubts(COPIES, Vec::new())?;
        return Ok(filler.library.set_doubts(CHECK, earlier)?);
    }
    let probed = probed(&filler.library, &points, model)?;
    let each = points.iter().enumerate();
    let taken: Vec<Taken> = each.map(|(n, p)| Taken::of(&filler.library, *p, (&probed, n))).collect();
    let options = VerifyOptions {
        model: settings.model,
        probe_delay: settings.probe_delay,
        removed: taken.iter().map(|taken| taken.delay).collect(),
        dead: filler.without.clone(),
        probe: !by_taps(&filler.library),
        numbers: points.iter().map(|p| p + 1).collect(),
        ..VerifyOptions::default()
    };
    let heard = heard(filler, surface, settings)?;
    let found = verify::check(surface, &heard, &probed, &options)?;
    correct(&mut filler.library, &points, &taken, &probed, &found)?;
    doubt(filler, &points, &found)?;
    say(filler, &points, &found, settings.model)
}

/// The probed responses of some points.
fn probed(
    library: &Library,
    points: &[usize],
    model: &ModalResponses,
) -> Result<SampledResponses, TaskError> {
    let places: Vec<Point> = points.iter().map(|p| library.points()[*p]).collect();
    let mut data = Vec::new();
    for point in points {
        data.extend(library.get(*point)?);
    }
    let (ports, conditions) = (model.ports.clone(), model.conditions.clone());
    SampledResponses::new(ports, places, conditions, library.plan().samples, data).map_err(TaskError::work)
}

/// Responses between actuators, as far as they were measured.
fn heard(
    filler: &LibraryFiller,
    surface: &Surface,
    settings: &MeasureOptions,
) -> Result<Measured, TaskError> {
    let (library, count) = (&filler.library, surface.actuators.len());
    let mut responses = vec![Vec::new(); count * count];
    let mut power = [0.0, 0.0];
    for sensor in 0..count {
        let point = filler.probed + sensor;
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

/// Correction of a point's responses: the delay that was removed, and the factor that was applied.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Taken {
    /// Delay that was removed, in s.
    delay: f64,
    /// Factor by which the samples were multiplied.
    times: f64,
}

impl Taken {
    const NOTHING: Self = Self { delay: 0.0, times: 1.0 };

    /// The correction in the log of a point, which is the `n`th of `probed`. The log is written before the
    /// responses: where these are still those from before the correction, the run was stopped in between,
    /// and the earlier correction holds.
    fn of(library: &Library, point: usize, (probed, n): (&SampledResponses, usize)) -> Self {
        let Some(log) = library.logged_point(point).and_then(|log| log.get(CHECK)) else {
            return Self::NOTHING;
        };
        let stopped = log["of"].as_str().is_some_and(|of| of == checksum(probed, n));
        let log = if stopped { &log["before"] } else { log };
        let number = |key: &str, usual: f64| log[key].as_f64().unwrap_or(usual);
        Self { delay: number("delay_s", 0.0), times: number("times", 1.0) }
    }

    /// The entry for a point's log: this correction, the earlier one, and a checksum of the responses (the
    /// `n`th of `probed`) before it.
    fn told(self, before: Self, (probed, n): (&SampledResponses, usize)) -> Value {
        json!({
            "delay_s": self.delay,
            "times": self.times,
            "of": checksum(probed, n),
            "before": { "delay_s": before.delay, "times": before.times },
        })
    }
}

/// A checksum of the responses of one point: FNV-1a over the bits of their samples, 64 bits.
fn checksum(probed: &SampledResponses, n: usize) -> String {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    let samples = (0..probed.ports.len()).flat_map(|actuator| probed.response(actuator, n));
    let add = |hash: u64, x: &f32| (hash ^ u64::from(x.to_bits())).wrapping_mul(PRIME).rotate_left(23);
    format!("{:016x}", samples.fold(OFFSET, add))
}

/// Removes delays, and differences of gain from the other points, from the library's responses, and records
/// the correction in each point's log.
fn correct(
    library: &mut Library,
    points: &[usize],
    taken: &[Taken],
    probed: &SampledResponses,
    found: &Verified,
) -> Result<(), TaskError> {
    let rate = probed.conditions.rate;
    let all = found.probe_delay.or_else(|| before(taken));
    // The log first, of all of them: from it and the responses that are there a later run sees whether they were
    // corrected.
    let (mut logs, mut steps) = (BTreeMap::new(), Vec::new());
    for (n, point) in points.iter().enumerate() {
        let sound = found.points.get(n).filter(|verdict| verdict.doubt.is_none());
        let factor = sound.and_then(|verdict| verdict.correction).unwrap_or(1.0);
        let delay = all.unwrap_or(0.0);
        let late = (delay - taken[n].delay) * rate;
        if late.abs() <= NONE && factor == 1.0 {
            continue;
        }
        let now = Taken { delay, times: taken[n].times * factor };
        logs.insert(*point, json!({ CHECK: now.told(taken[n], (probed, n)) }));
        steps.push((n, late, factor));
    }
    if !logs.is_empty() {
        library.log_points(logs)?;
    }
    for (n, late, factor) in steps {
        let mut samples: Vec<f32> = Vec::with_capacity(probed.ports.len() * probed.samples());
        for actuator in 0..probed.ports.len() {
            let response: Vec<f64> = probed.response(actuator, n).iter().map(|h| f64::from(*h)).collect();
            samples.extend(shift(&response, -late).iter().map(|h| (factor * h) as f32));
        }
        // Gain and delay leave both as they are.
        let quality = library.quality(points[n])?;
        let bands = library.band_quality(points[n])?.unwrap_or_default();
        let state = PointState::Measured;
        let take = Take { point: points[n], samples: &samples, quality: &quality, bands: &bands, state };
        library.put_all(&[take])?;
    }
    let said = |delay| format!("{} (`probe_delay_s` sets it)", comes(delay));
    let said = all.map_or(Value::Null, |delay| json!({ "delay_s": delay, "said": said(delay) }));
    Ok(library.log(PROBE, said)?)
}

/// The delay that was removed earlier, in s, if any was: unless another is found, it holds for all points.
fn before(taken: &[Taken]) -> Option<f64> {
    median(taken.iter().map(|taken| taken.delay).filter(|delay| *delay != 0.0))
}

/// Records the doubts. If no model was compared, doubts from an earlier comparison stay for points that
/// were not measured again.
fn doubt(filler: &mut LibraryFiller, points: &[usize], found: &Verified) -> Result<(), TaskError> {
    let of = |check: &str, doubt: &Doubted| {
        Doubt::of(check, &doubt.what).at(doubt.points.iter().map(|p| points[*p]).collect())
    };
    let copied: Vec<Doubt> = found.copies.iter().map(|doubt| of(COPIES, doubt)).collect();
    let others = found.doubts.iter().filter(|doubt| !found.copies.contains(doubt));
    let mut doubts: Vec<Doubt> = others.map(|doubt| of(CHECK, doubt)).collect();
    if matches!(found.model, Checked::Not { .. }) {
        let said: Vec<String> = copied.iter().chain(&doubts).map(|doubt| doubt.what.clone()).collect();
        doubts.extend(earlier(filler).into_iter().filter(|doubt| !said.contains(&doubt.what)));
    }
    filler.library.set_doubts(COPIES, copied)?;
    Ok(filler.library.set_doubts(CHECK, doubts)?)
}

/// Doubts of an earlier check against a model that still hold: those about points that were not measured in this run, and those about the
/// whole library unless the responses between actuators were measured anew.
fn earlier(filler: &LibraryFiller) -> Vec<Doubt> {
    let own = filler.probed..filler.library.points().len();
    let anew = !own.is_empty() && own.clone().all(|point| filler.made.contains(&point));
    let left = |doubt: &Doubt| {
        let others = doubt.points.iter().copied().filter(|point| !filler.made.contains(point));
        let others: Vec<usize> = others.collect();
        let stays = if doubt.points.is_empty() { !anew } else { !others.is_empty() };
        stays.then(|| doubt.clone().at(others))
    };
    filler.library.doubts().iter().filter(|doubt| doubt.check == CHECK).filter_map(left).collect()
}

/// Records the result of the check in the library's log.
fn say(filler: &mut LibraryFiller, points: &[usize], found: &Verified, asked: bool) -> Result<(), TaskError> {
    let library = &mut filler.library;
    let log = match &found.model {
        Checked::Not { why } => {
            // Points that a model was found for, and that are as they were, need no word.
            let held = library.logged(CHECK).is_some_and(|log| log["checked"] == true);
            if held && points.iter().all(|point| !filler.made.contains(point)) {
                return Ok(());
            }
            let why = if asked { why.as_str() } else { "`no_model`" };
            json!({
                "checked": false,
                "said": format!(
                    "not checked against a model ({why}): a recording of another place would not be recognised"
                ),
            })
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_delay_of_before_is_that_of_all_points() {
        let of = |delay| Taken { delay, ..Taken::NOTHING };
        assert_eq!(before(&[Taken::NOTHING, of(1e-3), of(1e-3), Taken::NOTHING]), Some(1e-3));
        assert_eq!(before(&[Taken::NOTHING; 3]), None);
    }
}
