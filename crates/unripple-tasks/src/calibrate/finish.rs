//! The record of a measurement in its library: its settings before it begins, and doubts once all points
//! are measured.

use super::campaign::{Campaign, by_taps};
use super::filler::LibraryFiller;
use super::verify;
use crate::{Record, TaskError, own, wavelength};
use serde_json::{Value, json};
use unripple::core::clock;
use unripple_devices::reciprocal;
use unripple_store::{Doubt, Library, PointState, date};

/// Largest relative difference between the two directions of the responses between actuators, after fitting
/// gains, beyond what noise explains: a change of tension by 0.3 %, or clocks that differ by 12 millionths,
/// make as much.
const RECIPROCITY: f64 = 0.15;

/// Largest difference between the latencies of actuators, in s: a third of a period at 3 kHz.
const LATENCY: f64 = 1e-4;

/// Ratio of the mean levels of sensors and probe beyond which their scales count as different.
const APART: f64 = 2.0;

/// Largest number of runs in the log; older ones are dropped.
const RUNS: usize = 100;

/// Name of the check that finds a measurement which was stopped.
const UNFINISHED: &str = "unfinished";

/// Name of the check that finds points at actuators missing or bad.
const OWN: &str = "own";

/// Key of the log entry for requested options that change the measured responses, other than scales.
pub const ASKED: &str = "asked";

/// Key, within the log entry [`ASKED`], of the probe's delay in s that was set by the request and removed
/// from recordings.
pub const PROBE_DELAY: &str = "probe_delay_s";

/// Records the settings of a measurement in the library before any point is measured, and a doubt that it
/// is unfinished: both remain if the run is stopped.
pub fn begin(campaign: &Campaign<'_>, library: &mut Library) -> Result<(), TaskError> {
    let names: Vec<&str> = campaign.surface.actuators.iter().map(|a| a.name.as_str()).collect();
    let dead: Vec<&str> = campaign.settings.without.iter().map(|actuator| names[*actuator]).collect();
    Record::of(campaign.ask)?.log(library)?;
    library.log("dead", if dead.is_empty() { Value::Null } else { json!(dead) })?;
    library.log("scale", campaign.scale_told())?;
    library.log(ASKED, json!({ PROBE_DELAY: campaign.settings.probe_delay }))?;
    let listens = library.points().len() > campaign.places.probed;
    library.log(own::KEY, if listens { own::told(campaign.surface)? } else { Value::Null })?;
    if library.in_state(PointState::Missing).is_empty() {
        return Ok(());
    }
    let stopped = Doubt::of(
        UNFINISHED,
        "the measurement was not finished: expected a check of everything measured at its end, found none; run calibrate again",
    );
    Ok(library.set_doubts(UNFINISHED, vec![stopped])?)
}

/// Checks all that was measured, and records doubts in the library. `latency` is in samples, followed by
/// its spread over actuators in samples.
pub fn finish(
    campaign: &Campaign<'_>,
    filler: &mut LibraryFiller,
    latency: Option<[f64; 2]>,
) -> Result<(), TaskError> {
    reciprocity(campaign, filler)?;
    spread(campaign, filler, latency)?;
    sensors(campaign, filler)?;
    lacking(campaign, filler)?;
    useless(filler)?;
    verify::check(filler, campaign.surface, campaign.model, &campaign.settings)?;
    let measured = |point: &usize| filler.library.state(*point) == Some(PointState::Measured);
    let probed: Vec<usize> = (0..filler.probed).filter(measured).collect();
    wavelength::log(&mut filler.library, &probed, campaign.surface)?;
    recorded(filler)?;
    Ok(filler.library.set_doubts(UNFINISHED, Vec::new())?)
}

/// Adds a run to the library's log: its settings, the number of points that it measured, and how many
/// seconds it took.
pub fn log_run(
    campaign: &Campaign<'_>,
    library: &mut Library,
    measured: usize,
    seconds: f64,
) -> Result<(), TaskError> {
    let now = clock::unix_seconds();
    let settings = &campaign.settings;
    let run = json!({
        "ended": date(now),
        "software": format!("unripple {}", env!("CARGO_PKG_VERSION")),
        "device": format!("{:?}", campaign.ask.device.device).to_lowercase(),
        "measured": measured,
        "seconds": seconds,
        "sweep_s": settings.sweep,
        "swept_hz": settings.swept(campaign.surface),
        "level": settings.level,
        "repeats": settings.repeats,
    });
    let mut runs = library.logged("runs").and_then(Value::as_array).cloned().unwrap_or_default();
    runs.push(run);
    let first = runs.len().saturating_sub(RUNS);
    Ok(library.log("runs", Value::Array(runs.split_off(first)))?)
}

/// Responses from actuator to actuator, `[sensor][drive][sample]`.
type Pairs = Vec<Vec<Vec<f64>>>;

/// Actuators that are not left out and whose sensors were measured, and the responses at their sensors.
fn own(campaign: &Campaign<'_>, filler: &LibraryFiller) -> Result<(Vec<usize>, Pairs), TaskError> {
    let library = &filler.library;
    let count = campaign.surface.actuators.len();
    let measured = |actuator: &usize| library.state(filler.probed + actuator) == Some(PointState::Measured);
    let alive: Vec<usize> = (0..count).filter(|a| !filler.without.contains(a)).filter(measured).collect();
    let mut heard = Vec::with_capacity(alive.len());
    for sensor in &alive {
        let values = library.get(filler.probed + sensor)?;
        let all: Vec<Vec<f64>> = values
            .chunks_exact(library.plan().samples)
            .map(|response| response.iter().map(|h| f64::from(*h)).collect())
            .collect();
        heard.push(alive.iter().map(|drive| all[*drive].clone()).collect());
    }
    Ok((alive, heard))
}

/// Records a doubt about a library if the responses between its actuators are not reciprocal.
fn reciprocity(campaign: &Campaign<'_>, filler: &mut LibraryFiller) -> Result<(), TaskError> {
    const CHECK: &str = "reciprocity";
    let (alive, heard) = own(campaign, filler)?;
    if alive.len() < 2 {
        filler.library.log(CHECK, Value::Null)?;
        return Ok(filler.library.set_doubts(CHECK, Vec::new())?);
    }
    let names: Vec<String> =
        alive.iter().map(|actuator| campaign.surface.actuators[*actuator].name.clone()).collect();
    let found = reciprocal(&names, &heard, &[]);
    let noise = noise(filler, &alive)?;
    let beyond = (found.error.powi(2) - noise.powi(2)).max(0.0).sqrt();
    let mut doubts = Vec::new();
    if beyond > RECIPROCITY {
        doubts.push(Doubt::of(
            CHECK,
            format!(
                "the responses between actuators differ by {:.0} % between the two directions, expected at most {:.0} %: the \
                 surface or its tension changed meanwhile, samples were lost, clocks run apart, or a sensor receives something \
                 else; measure it again",
                100.0 * beyond,
                100.0 * RECIPROCITY
            ),
        ));
    }
    doubts.extend(found.faults.iter().map(|fault| Doubt::of(CHECK, fault)));
    filler.library.log(CHECK, json!({ "error": found.error, "noise": noise, "most": RECIPROCITY }))?;
    Ok(filler.library.set_doubts(CHECK, doubts)?)
}

/// The part of the reciprocity error that noise alone would cause.
fn noise(filler: &LibraryFiller, alive: &[usize]) -> Result<f64, TaskError> {
    let (mut sum, mut count) = (0.0, 0.0);
    for sensor in alive {
        let qualities = filler.library.quality(filler.probed + sensor)?;
        let others = alive.iter().filter(|drive| *drive != sensor);
        for noise in others.filter_map(|drive| own::noise(&qualities[*drive])) {
            sum += noise.powi(2);
            count += 1.0;
        }
    }
    Ok(if count > 0.0 { (2.0_f64 * sum / count).sqrt() } else { 0.0 })
}

/// Records a doubt about a library if the latencies of its actuators differ too much.
fn spread(
    campaign: &Campaign<'_>,
    filler: &mut LibraryFiller,
    latency: Option<[f64; 2]>,
) -> Result<(), TaskError> {
    const CHECK: &str = "latency";
    let Some([late, spread]) = latency else { return Ok(()) };
    let most = LATENCY * campaign.surface.emission.rate;
    filler.library.log(CHECK, json!({ "samples": late, "spread_samples": spread, "most_samples": most }))?;
    // Without a model it is not checked: what was said of points that are there stays.
    if !campaign.settings.model && !filler.is_new() {
        return Ok(());
    }
    let found = (campaign.settings.model && spread > most).then(|| {
        Doubt::of(
            CHECK,
            format!(
                "actuators disagree on the latency by {spread:.1} samples, expected at most {most:.1}: samples were lost, or \
                 the surface is far from its file; measure it again, or correct the file"
            ),
        )
    });
    Ok(filler.library.set_doubts(CHECK, found.into_iter().collect())?)
}

/// Removes the doubt that a record of the library could not be read, once all measured points were measured
/// after it: in this run, or as the new record says.
fn recorded(filler: &mut LibraryFiller) -> Result<(), TaskError> {
    let library = &filler.library;
    let own = library.logged("own").is_some();
    let since = |point: &usize| {
        let said = library.logged_point(*point).is_some_and(|log| log.get("made").is_some());
        filler.made.contains(point) || said || (own && *point >= filler.probed)
    };
    let there = |point: &usize| library.state(*point) != Some(PointState::Missing);
    if !(0..library.points().len()).filter(there).all(|point| since(&point)) {
        return Ok(());
    }
    Ok(filler.library.set_doubts("record", Vec::new())?)
}

/// Records a doubt about a library without the responses at a sensor, unless the sensor is dead.
fn lacking(campaign: &Campaign<'_>, filler: &mut LibraryFiller) -> Result<(), TaskError> {
    let lacks = |actuator: &usize| {
        let state = filler.library.state(filler.probed + actuator);
        let known = filler.without.contains(actuator) || filler.deaf.contains(actuator);
        matches!(state, Some(PointState::Missing | PointState::Bad)) && !known
    };
    let actuators = &campaign.surface.actuators;
    let names: Vec<&str> =
        (0..actuators.len()).filter(lacks).map(|actuator| actuators[actuator].name.as_str()).collect();
    let found = (!names.is_empty()).then(|| {
        Doubt::of(
            OWN,
            format!(
                "the points at {} are missing or bad, expected those at all actuators with sensors: the responses between actuators are \
                 the basis of all other checks; measure them again",
                names.join(", ")
            ),
        )
    });
    Ok(filler.library.set_doubts(OWN, found.into_iter().collect())?)
}

/// Records a doubt about a library if none of its probed points is good.
fn useless(filler: &mut LibraryFiller) -> Result<(), TaskError> {
    const CHECK: &str = "probed";
    let count = |state: PointState| {
        (0..filler.probed).filter(|point| filler.library.state(*point) == Some(state)).count()
    };
    let (bad, good) = (count(PointState::Bad), count(PointState::Measured));
    let found = (bad > 0 && good == 0).then(|| {
        let (by, look) = if by_taps(&filler.library) { ("taps or blows", "the sensors") } else { ("the probe", "the probe and the levels") };
        let all = if bad == 1 { "is" } else { "are all" };
        Doubt::of(
            CHECK,
            format!(
                "{} measured by {by} {all} bad, expected some that are good: read the remark on each, check {look}, and measure them \
                 again",
                points(bad)
            ),
        )
    });
    Ok(filler.library.set_doubts(CHECK, found.into_iter().collect())?)
}

/// A number of points in words.
pub(super) fn points(count: usize) -> String {
    format!("{count} point{}", if count == 1 { "" } else { "s" })
}

/// Records that the points at actuators are not used in metrics, if the sensors are of another scale than
/// the probe.
fn sensors(campaign: &Campaign<'_>, filler: &mut LibraryFiller) -> Result<(), TaskError> {
    let (sensing, plan) = (own::sensing(campaign.surface)?, filler.library.plan());
    let power = |points: std::ops::Range<usize>, own: bool| -> Result<Option<f64>, TaskError> {
        let (mut sum, mut count) = (0.0, 0.0);
        for point in points.filter(|point| filler.library.state(*point) == Some(PointState::Measured)) {
            let values = filler.library.get(point)?;
            let values = match own.then(|| &sensing[point - filler.probed]) {
                Some(sensor) => own::velocities(sensor, &values, plan, campaign.surface),
                None => Some(values),
            };
            for (actuator, response) in
                values.iter().flat_map(|rows| rows.chunks_exact(plan.samples)).enumerate()
            {
                // An actuator's response at itself is louder anyway.
                let itself = own && point - filler.probed == actuator;
                if !itself && !filler.without.contains(&actuator) {
                    sum += response.iter().map(|h| f64::from(*h).powi(2)).sum::<f64>();
                    count += 1.0;
                }
            }
        }
        Ok((count > 0.0 && sum > 0.0).then(|| sum / count))
    };
    let all = filler.library.points().len();
    let apart = match (power(0..filler.probed, false)?, power(filler.probed..all, true)?) {
        (Some(probe), Some(sensors)) if !campaign.scales.sensors_too(campaign.surface) => {
            Some((sensors / probe).sqrt())
        }
        _ => None,
    };
    let said = match apart {
        Some(apart) if !(1.0 / APART..=APART).contains(&apart) => json!({
            "over_probe": apart,
            "left_out": true,
            "said": format!(
                "sensors are {apart:.3} times as loud as the {}, so they must be in another unit: the points at the actuators are not \
                 used in any metric (`input_scales` gives their scale)",
                if by_taps(&filler.library) { "responses to taps" } else { "probe" }
            ),
        }),
        Some(apart) => json!({ "over_probe": apart, "left_out": false }),
        None => Value::Null,
    };
    Ok(filler.library.log("sensors", said)?)
}
