//! The wiring test by recordings made elsewhere: which actuators and sensors are dead, swapped or reversed.

use super::TapeCalibration;
use super::rig::TapeRig;
use crate::TaskError;
use crate::calibrate::middle;
use std::collections::BTreeSet;
use unripple::core::{Layout, PROBE, Point};
use unripple::dsp::median;
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, Listen, Session};
use unripple_devices::{DevicesError, Expected, WiringOptions, WiringReport, check_responses, reciprocal};

/// Signal-to-noise ratio, in dB, below which a channel counts as silent.
const DEAF: f64 = 6.0;

/// Amplitude relative to the loudest actuator below which an actuator counts as dead; below [`QUIET`], one
/// also counts as dead if it does not exceed the noise.
const DEAD: f64 = 0.01;
const QUIET: f64 = 0.3;

/// Share of the inputs that must agree with the model for the model to be used. Two thirds: with fewer it
/// is the model that is wrong, not so many wires.
const BELIEVED: f64 = 0.67;

/// Middle frequencies of the bursts by which faults are found, as shares of the band. A wrong wire shows at
/// all of them; where only the surface differs from its model, the apparent faults differ from one to the
/// next.
const BURSTS: [f64; 3] = [0.2, 0.4, 0.6];

/// Number of points that are evaluated where there are no sensors. Near a node of one mode at one point,
/// another point still shows it.
const LOOKED_AT: usize = 3;

/// Result of the wiring test by recordings: dead actuators and sensors, and faults of the wiring.
#[derive(Clone, Debug, Default)]
pub struct WiringResult {
    /// Indices of actuators whose drive no input records.
    pub dead: Vec<usize>,
    /// Indices of actuators whose sensor records nothing.
    pub deaf: Vec<usize>,
    /// Faults of the wiring, each as a sentence.
    pub faults: Vec<String>,
    /// Notes that do not count as faults.
    pub notes: Vec<String>,
}

/// Why the wiring could not be tested.
pub enum Failed {
    /// The recording of the actuators cannot be used, for the reason in the text.
    Recording(String),
    /// An error that is not due to a recording.
    Other(TaskError),
}

impl From<CalibrateError> for Failed {
    fn from(error: CalibrateError) -> Self {
        match error {
            CalibrateError::Recording { .. } | CalibrateError::Dsp(_) => Self::Recording(error.to_string()),
            error => Self::Other(error.into()),
        }
    }
}

impl From<DevicesError> for Failed {
    fn from(error: DevicesError) -> Self {
        Self::Other(error.into())
    }
}

/// Tests the wiring by the recording of the actuators, and that of the first point that has one.
pub fn test_wiring(
    calibration: &TapeCalibration<'_>,
    session: &Session,
    rig: &mut TapeRig,
) -> Result<WiringResult, Failed> {
    let mut result =
        WiringResult { dead: calibration.campaign.settings.without.clone(), ..WiringResult::default() };
    let rows = heard(calibration, session, rig)?;
    if rows.is_empty() {
        return Ok(result);
    }
    result.silent(calibration, &rows);
    if calibration.takes.wires.sensors.is_empty() || !result.faults.is_empty() {
        return Ok(result);
    }
    let reciprocal = result.reciprocal(calibration, session, rig, &rows)?;
    if calibration.campaign.settings.model {
        result.model(calibration, session, rig, &rows)?;
    }
    if result.faults.is_empty() {
        result.faults = reciprocal;
    }
    Ok(result)
}

/// Responses from all actuators to all sensors; without sensors, those to the probe at some points.
fn heard(
    calibration: &TapeCalibration<'_>,
    session: &Session,
    rig: &mut TapeRig,
) -> Result<Vec<Channel>, Failed> {
    let (last, centre) = (calibration.campaign.places.points.len(), middle(calibration.campaign.surface));
    if !calibration.takes.wires.sensors.is_empty() {
        return Ok(session.measure(rig, last, centre, 0, Listen::Sensors)?);
    }
    let mut rows = Vec::new();
    for number in calibration.good.iter().copied() {
        if rows.len() >= LOOKED_AT {
            break;
        }
        match session.measure(rig, number, calibration.campaign.places.points[number], 0, Listen::Probe) {
            Ok(heard) => rows.extend(heard),
            // A point's recording that is no good is reported when it is measured.
            Err(CalibrateError::Recording { .. } | CalibrateError::Dsp(_)) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(rows)
}

impl WiringResult {
    /// Reports actuators that drive nothing, and those whose sensor records nothing.
    fn silent(&mut self, calibration: &TapeCalibration<'_>, rows: &[Channel]) {
        let actuators = &calibration.campaign.surface.actuators;
        let sensing = rows.len() == actuators.len() && !calibration.takes.wires.sensors.is_empty();
        // A sensor that records any actuator is not dead, however many actuators are.
        let noisy = |channel: &Channel| {
            let best = channel.quality.iter().map(|quality| quality.snr_db);
            best.filter(|db| !db.is_nan()).fold(f64::NEG_INFINITY, f64::max) < DEAF
        };
        let deaf: Vec<usize> = (0..rows.len()).filter(|row| sensing && noisy(&rows[*row])).collect();
        // Where no sensor records anything it is not the wires, and reported elsewhere.
        if deaf.len() == rows.len() {
            return;
        }
        let hearing: Vec<Hearing<'_>> = (0..rows.len())
            .filter(|row| !deaf.contains(row))
            .map(|row| Hearing { itself: sensing.then_some(row), channel: &rows[row] })
            .collect();
        let quiet: Vec<usize> = (0..actuators.len()).filter(|drive| is_dead(&hearing, *drive)).collect();
        self.deaf = deaf;
        let name = |actuator: &usize| actuators[*actuator].name.as_str();
        if 2 * quiet.len() > actuators.len() {
            let names: Vec<&str> = quiet.iter().map(name).collect();
            let text =
                format!("no sensor receives {}: were all channels of play.wav played?", names.join(", "));
            self.faults.push(text);
            return;
        }
        for actuator in quiet.iter().filter(|actuator| !self.dead.contains(actuator)) {
            let (name, output) = (name(actuator), calibration.takes.wires.drives[*actuator] + 1);
            let too = if self.deaf.contains(actuator) { ", and its own sensor receives nothing" } else { "" };
            self.notes.push(format!(
                "actuator `{name}` is dead: no sensor receives its sweep (output {output}){too}; check its amplifier, its cable and the \
                 actuator. The others go on without it"
            ));
        }
        let alone: Vec<usize> =
            self.deaf.iter().copied().filter(|actuator| !quiet.contains(actuator)).collect();
        for actuator in alone {
            let input = calibration.takes.reader.named(calibration.takes.wires.sensors[actuator]);
            self.notes.push(format!(
                "the sensor of `{}` receives nothing, {input}: check its cable and gain. The point at this actuator is left out",
                actuators[actuator].name
            ));
        }
        let all: BTreeSet<usize> = self.dead.iter().copied().chain(quiet).collect();
        self.dead = all.into_iter().collect();
    }

    /// Actuators whose drive and sensor both work.
    fn alive(&self, count: usize) -> Vec<usize> {
        (0..count).filter(|a| !self.dead.contains(a) && !self.deaf.contains(a)).collect()
    }

    /// Faults of the wiring that contradict reciprocity.
    fn reciprocal(
        &self,
        calibration: &TapeCalibration<'_>,
        session: &Session,
        rig: &mut TapeRig,
        rows: &[Channel],
    ) -> Result<Vec<String>, Failed> {
        let alive = self.alive(rows.len());
        let names: Vec<String> =
            alive.iter().map(|a| calibration.campaign.surface.actuators[*a].name.clone()).collect();
        let of = |channel: &Channel, scale: f64| -> Vec<Vec<f64>> {
            let scaled = |drive: &usize| channel.responses[*drive].iter().map(|h| h * scale).collect();
            alive.iter().map(scaled).collect()
        };
        let heard: Vec<Vec<Vec<f64>>> = alive
            .iter()
            .zip(&names)
            .map(|(a, name)| of(&rows[*a], calibration.campaign.scales.input(name)))
            .collect();
        let mut spare = Vec::new();
        if calibration.takes.wires.probe.is_some() {
            let (last, centre) =
                (calibration.campaign.places.points.len(), middle(calibration.campaign.surface));
            let probe = session.measure(rig, last, centre, 0, Listen::Probe)?;
            spare.extend(probe.iter().map(|channel| (PROBE.to_owned(), of(channel, 1.0))));
        }
        Ok(reciprocal(&names, &heard, &spare).faults)
    }

    /// Adds faults of the wiring that contradict the model, if the model agrees with the surface well
    /// enough.
    fn model(
        &mut self,
        calibration: &TapeCalibration<'_>,
        session: &Session,
        rig: &mut TapeRig,
        rows: &[Channel],
    ) -> Result<(), Failed> {
        let model = calibration.campaign.model;
        let alive = self.alive(rows.len());
        let outputs: Vec<String> = alive.iter().map(|a| model.ports[*a].name.clone()).collect();
        let Held { names, channels, at } = Held::of(calibration, session, rig, rows, &alive);
        let options = WiringOptions::for_band(model.conditions.band);
        let all = Expected::of(calibration.campaign.surface, model, at, options.listen)?;
        let inputs: Vec<usize> = alive.iter().copied().chain(at.map(|_| model.ports.len())).collect();
        let response = |o: &usize, i: &usize| all.response(*o, *i).to_vec();
        let row = |o: &usize| inputs.iter().map(|i| response(o, i)).collect();
        let expected = Expected::new(alive.iter().map(row).collect())?;
        let scaled = |(channel, name): (&Channel, &String), drive: usize| {
            let scale = calibration.campaign.scales.input(name);
            channel.responses[drive].iter().map(|h| h * scale).collect::<Vec<f64>>()
        };
        let of = |drive: &usize| channels.iter().zip(&names).map(|pair| scaled(pair, *drive)).collect();
        let heard: Vec<Vec<Vec<f64>>> = alive.iter().map(of).collect();
        let layout = Layout { outputs, inputs: names, ..calibration.takes.layout().clone() };
        let [low, high] = model.conditions.band;
        let found = BURSTS.map(|share| {
            let frequency = low + share * (high - low);
            check_responses(&heard, &layout, &expected, &WiringOptions { frequency, ..options })
        });
        let found = found.into_iter().collect::<Result<Vec<WiringReport>, _>>()?;
        let believed = |report: &WiringReport| {
            let like = report.inputs.iter().filter(|lead| !lead.unlike && !lead.silent).count();
            like as f64 >= BELIEVED * report.inputs.len() as f64
        };
        if !found.iter().all(believed) {
            self.notes.push("wires: not compared with the model, which is too far from the surface".into());
            return Ok(());
        }
        let leads = found.iter().flat_map(|report| report.outputs.iter().chain(&report.inputs));
        let unlike: BTreeSet<String> =
            leads.filter(|lead| lead.unlike).map(|lead| lead.name.clone()).collect();
        if !unlike.is_empty() {
            let names = unlike.iter().cloned().collect::<Vec<_>>().join(", ");
            self.notes.push(format!("wires: {names} differ too much from the model to be checked by it"));
        }
        let sure = |fault: &String| !unlike.iter().any(|name| fault.contains(&format!("`{name}`")));
        let everywhere = |fault: &String| found.iter().all(|report| report.faults().contains(fault));
        for fault in found[0].faults().into_iter().filter(sure).filter(everywhere) {
            if fault == format!("input `{PROBE}` is reversed") {
                // Its sign is that of all responses: a focus only moves the other way.
                self.notes
                    .push(format!("{fault} relative to the sensors: `input_scales` {PROBE}=-1 inverts it"));
            } else {
                self.faults.push(fault);
            }
        }
        Ok(())
    }
}

/// Channels that are compared with the model, with their names, and the place of the probe if the last of
/// them is the probe.
struct Held {
    names: Vec<String>,
    channels: Vec<Channel>,
    at: Option<Point>,
}

impl Held {
    /// The sensors of the actuators `alive`; if there is a probe, all from the recording of one point, so
    /// that a swap of probe and sensor shows.
    fn of(
        calibration: &TapeCalibration<'_>,
        session: &Session,
        rig: &mut TapeRig,
        rows: &[Channel],
        alive: &[usize],
    ) -> Self {
        let mut names: Vec<String> =
            alive.iter().map(|a| calibration.campaign.model.ports[*a].name.clone()).collect();
        let of = |all: &[Channel]| alive.iter().map(|a| all[*a].clone()).collect::<Vec<_>>();
        let point = calibration.good.first().copied().filter(|_| calibration.takes.wires.probe.is_some());
        let both = point.map(|number| {
            let at = calibration.campaign.places.points[number];
            let sensors = session.measure(rig, number, at, 0, Listen::Sensors)?;
            Ok::<_, CalibrateError>((at, sensors, session.measure(rig, number, at, 0, Listen::Probe)?))
        });
        match both {
            Some(Ok((at, sensors, probe))) => {
                names.push(PROBE.into());
                Self { names, channels: [of(&sensors), probe].concat(), at: Some(at) }
            }
            // A point's recording that is no good is reported when it is measured.
            Some(Err(_)) | None => Self { names, channels: of(rows), at: None },
        }
    }
}

/// A recorded channel, and the actuator that its sensor belongs to, whose signal is louder in it than those
/// of others.
struct Hearing<'a> {
    itself: Option<usize>,
    channel: &'a Channel,
}

/// Whether an actuator is dead: in the sensors, its responses are far weaker than the strongest of other
/// actuators, or weak and within the noise.
fn is_dead(hearing: &[Hearing<'_>], drive: usize) -> bool {
    let others = hearing.iter().filter(|one| one.itself != Some(drive));
    let share = |one: &Hearing<'_>| {
        let power = |actuator: usize| one.channel.responses[actuator].iter().map(|h| h * h).sum::<f64>();
        let all = (0..one.channel.responses.len()).filter(|actuator| one.itself != Some(*actuator));
        let most = all.map(power).fold(0.0, f64::max);
        (most > 0.0).then(|| (power(drive) / most).sqrt())
    };
    let noise = median(others.clone().map(|one| one.channel.quality[drive].snr_db));
    let noise = noise.is_none_or(|db| db.is_nan() || db < DEAF);
    median(others.filter_map(share)).is_some_and(|share| share < DEAD || (noise && share < QUIET))
}
