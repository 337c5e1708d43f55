//! Plays the drive through a device, level after level, and records the probe at each place.

use super::Ask;
use super::report::peak;
use super::setting::Setting;
use crate::calibrate::Hands;
use crate::calibrate::{People, open_with};
use crate::{DeviceKind, Progress, TaskError, go_on};
use unripple::core::{Layout, Point, Surface};
use unripple::physics::stepper::InjectedFaults;
use unripple_calibrate::measure::{Rig, Wires, record};
use unripple_calibrate::signals::clipped;

/// Levels at which the drive is played at the target, and (`QUIET` and full) elsewhere, as shares of its own: each four times
/// the one before, 12 dB, so that a fault is noticed before it is loud, and two levels tell whether an amplifier saturates.
const LEVELS: [f64; 3] = [1.0 / 16.0, QUIET, 1.0];

/// Level of the quieter recording at each place.
pub(super) const QUIET: f64 = 0.25;

/// Silence that is recorded for the noise, in s.
const SILENT: f64 = 0.2;

/// Latency of a real device that is allowed for, in s: that of wireless sound.
const LATE: f64 = 0.3;

/// Multiple of the predicted velocity above which a level is the last: then the drive, or a scale, is not what was thought.
const TOO_FAST: f64 = 3.0;

/// Number of samples at the largest magnitude up to which a recording does not count as clipped: a slow crest has some.
const FLAT: usize = 20;

/// What a probe recorded, in m/s, or in the unit of the device's samples where the scale is not known.
pub(super) struct Recorded {
    /// Name of the device.
    pub device: String,
    /// Recordings at full level, places x samples.
    pub full: Vec<Vec<f64>>,
    /// Recordings at the level [`QUIET`].
    pub quiet: Vec<Vec<f64>>,
    /// Silence at the target.
    pub noise: Vec<f64>,
    /// Whether the recordings are in m/s and the drive in its unit.
    pub scaled: bool,
    /// How a virtual surface differs from its file, in words.
    pub truth: Option<String>,
}

/// An open device.
struct Bench<'a> {
    rig: Box<dyn Rig>,
    layout: Layout,
    wires: Wires,
    probe: usize,
    /// Factor from samples to m/s.
    scale: f64,
    setting: &'a Setting,
    samples: usize,
    truth: Option<String>,
}

/// Opens the device, plays, and records.
///
/// # Errors
/// Those of the device; [`TaskError::Input`] of a device without a probe or with too few outputs; [`TaskError::Work`] where a recording is
/// clipped, or much faster than predicted; [`TaskError::Cancelled`].
pub(super) fn play(
    ask: &Ask,
    setting: &Setting,
    hands: Hands,
    progress: &mut dyn Progress,
) -> Result<Recorded, TaskError> {
    progress.stage("device");
    let mut bench = Bench::open(ask, setting, hands)?;
    go_on(progress)?;
    progress.stage("playing");
    let target = setting.places[0];
    bench.rig.ready(0, target, 0)?;
    let silence = (SILENT * bench.layout.rate) as usize;
    let noise = bench.listen(&vec![Vec::new(); bench.wires.drives.len()], silence)?;
    let (mut full, mut quiet) = (Vec::new(), Vec::new());
    for (number, place) in setting.places.iter().enumerate() {
        for (attempt, level) in LEVELS.iter().enumerate() {
            // The lowest level tells whether the others are safe, which the target has told.
            if number > 0 && *level < QUIET {
                continue;
            }
            go_on(progress)?;
            let heard = bench.sent(ask, number, *place, attempt as u64 + 1, *level)?;
            match *level {
                QUIET => quiet.push(heard),
                1.0 => full.push(heard),
                _ => {}
            }
        }
        progress.done((number + 1) as f64 / setting.places.len() as f64);
    }
    let scaled = setting.scaled && bench.is_scaled(ask);
    Ok(Recorded { device: bench.layout.device, full, quiet, noise, scaled, truth: bench.truth })
}

impl<'a> Bench<'a> {
    fn open(ask: &Ask, setting: &'a Setting, hands: Hands) -> Result<Self, TaskError> {
        let surface = &setting.surface;
        let people = People { hands, probe: true, hammer: false };
        let max_hz = matches!(setting.responses, unripple::core::Responses::Modal(_)).then_some(setting.hz);
        let opened = open_with(&ask.device, surface, people, faults(ask, surface, setting)?, max_hz)?;
        let mut rig = opened.rig;
        let layout = rig.device().layout().clone();
        let wires = Wires::by_name(setting.responses.ports(), &layout, &ask.wires)?;
        let probe = wires.probe.ok_or_else(|| {
            TaskError::Input(format!(
                "device `{}`: expected an input for the probe, found {} ({})",
                layout.device,
                layout.inputs.len(),
                layout.inputs.join(", ")
            ))
        })?;
        if setting.drive.peak() > layout.full_scale * (1.0 + 1e-6) {
            return Err(TaskError::ask(
                "level",
                format!("a drive within {}, the device's full scale", layout.full_scale),
                format!("one of {}", setting.drive.peak()),
            ));
        }
        let late = if ask.device.device == DeviceKind::Virtual { 0.0 } else { LATE };
        let samples = setting.samples + (late * layout.rate) as usize;
        let scale = ask.probe_scale.unwrap_or(1.0);
        Ok(Self { rig, layout, wires, probe, scale, setting, samples, truth: opened.truth })
    }

    /// Whether drive and recordings are in their units.
    fn is_scaled(&self, ask: &Ask) -> bool {
        let own = ask.device.device == DeviceKind::Virtual;
        own || (ask.probe_scale.is_some() && ask.device.output_scale.is_some())
    }

    /// Brings the probe to a place, plays the drive at a level, and returns the recording.
    fn sent(
        &mut self,
        ask: &Ask,
        number: usize,
        place: Point,
        attempt: u64,
        level: f64,
    ) -> Result<Vec<f64>, TaskError> {
        self.rig.ready(number, place, attempt)?;
        let drive = self.setting.drive.clone().scaled(level);
        let heard = self.listen(drive.channels(), self.samples)?;
        let own = ask.device.device == DeviceKind::Virtual;
        let samples: Vec<f64> = heard.iter().map(|v| v / self.scale).collect();
        let flat = if own { 0 } else { clipped(&samples, 1.0) };
        if flat > FLAT {
            return Err(TaskError::Work(format!(
                "the probe's recording at {place} is clipped at level {level} ({flat} samples): turn its gain down"
            )));
        }
        let (found, expected) = (peak(&heard), level * peak(&self.setting.predicted[number]));
        if self.setting.scaled && self.is_scaled(ask) && number == 0 && found > TOO_FAST * expected {
            return Err(TaskError::Work(format!(
                "stopped at level {level:.3}: expected at most {expected:.3e} m/s at the target, found {found:.3e} m/s; look at the \
                 amplifiers' gain, `output_scale` and `probe_scale`"
            )));
        }
        Ok(heard)
    }

    /// Plays a drive, actuators x samples, and returns what the probe records, in m/s.
    fn listen(&mut self, drive: &[Vec<f64>], samples: usize) -> Result<Vec<f64>, TaskError> {
        let heard = record(self.rig.device(), &self.wires.drives, drive, &[self.probe], samples)?;
        let line = heard.into_iter().next().unwrap_or_default();
        Ok(line.into_iter().take(samples).map(|x| x * self.scale).collect())
    }
}

/// Faults of the virtual surface that a request names.
fn faults(ask: &Ask, surface: &Surface, setting: &Setting) -> Result<InjectedFaults, TaskError> {
    let given = [
        ("changed", ask.changed != 0.0),
        ("swapped", !ask.swapped.is_empty()),
        ("clipped", ask.clipped.is_some()),
    ];
    if ask.device.device != DeviceKind::Virtual
        && let Some((field, _)) = given.into_iter().find(|(_, given)| *given)
    {
        return Err(TaskError::ask(field, "the virtual device, whose faults can be chosen", "another"));
    }
    if !(ask.changed.is_finite() && ask.changed.abs() < 1.0) {
        return Err(TaskError::ask("changed", "a share of less than 1, up or down", ask.changed));
    }
    if let Some(share) = ask.clipped.filter(|share| !(share.is_finite() && *share > 0.0)) {
        return Err(TaskError::ask("clipped", "a share above 0", share));
    }
    let named = |name: &String| {
        let found = surface.actuators.iter().position(|actuator| actuator.name == *name);
        found.ok_or_else(|| {
            TaskError::ask("swapped", "names of actuators of the surface", format!("`{name}`"))
        })
    };
    let swapped = ask.swapped.iter().map(|(a, b)| Ok((named(a)?, named(b)?)));
    Ok(InjectedFaults {
        tension: if ask.changed == 0.0 { Vec::new() } else { vec![(0.0, 1.0 + ask.changed)] },
        swapped: swapped.collect::<Result<_, TaskError>>()?,
        clip: ask.clipped.map(|share| share * setting.drive.peak()),
        ..InjectedFaults::default()
    })
}
