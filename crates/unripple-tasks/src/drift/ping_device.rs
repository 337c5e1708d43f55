//! Plays pings without a break, and records the sensors' responses to them.

use super::Ask;
use super::known::Known;
use crate::calibrate::{People, middle, open_under};
use crate::{DeviceAsk, Progress, TaskError, go_on};
use unripple::core::Layout;
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{MeasureOptions, Rig, SILENCE, Session, Wires};
use unripple_calibrate::signals::shift;

/// Silence before the pings in which the noise of the sensors is recorded, in s.
const QUIET: f64 = 0.2;

/// Number of extra samples on either side of a stretch that is shifted by part of a sample, so that end
/// effects stay outside it.
const MARGIN: usize = 64;

/// Duration for which the tension of a virtual surface is tabulated, in s.
const LONGEST: f64 = 3600.0;

/// An open device that plays pings and records the sensors' signals.
pub(super) struct PingDevice {
    rig: Box<dyn Rig>,
    layout: Layout,
    wires: Wires,
    /// Factor by which each sensor's signal is multiplied.
    scales: Vec<f64>,
    /// Latency from the drive to the recorded signals, in samples; 0 if it is unknown.
    pub latency: f64,
    /// Recorded signals that were not yet returned, a row for each sensor; they begin [`MARGIN`] samples
    /// before the next period.
    lines: Vec<Vec<f64>>,
    /// Number of samples sent since the pings began, and of blocks lost before.
    sent: usize,
    lost: u64,
}

impl PingDevice {
    /// Opens the device, and measures its latency.
    ///
    /// # Errors
    /// Those of the device and of [`Session::find_latency`]; [`TaskError::Input`] of a device without an input for each actuator's sensor.
    pub fn open(ask: &Ask, known: &Known, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        let surface = &known.surface;
        let output_scale = ask.device.output_scale.or(known.output_scale());
        let device = DeviceAsk { output_scale, ..ask.device.clone() };
        // No probe is listened to, so nobody need move one.
        let mut rig = open_under(
            &device,
            surface,
            People { hands: Box::new(|_| Ok(())), probe: false, hammer: false },
            course(ask),
        )?
        .rig;
        let layout = rig.device().layout().clone();
        let wires = Wires::by_name(&known.modal.ports, &layout, &[])?;
        if wires.sensors.is_empty() {
            return Err(TaskError::Input(format!(
                "device `{}`: expected an input for each actuator's sensor, to find the tension from, found {} ({})",
                layout.device,
                layout.inputs.len(),
                layout.inputs.join(", ")
            )));
        }
        progress.stage("latency");
        let options =
            MeasureOptions { without: known.dead.clone(), ..MeasureOptions::for_model(&known.modal) };
        let session = Session::new(surface, &layout, wires.clone(), &options)?;
        go_on(progress)?;
        let found = session.find_latency(rig.as_mut(), 0, middle(surface), &known.modal)?;
        go_on(progress)?;
        rig.ready(0, middle(surface), 1)?;
        let scales = (0..wires.sensors.len()).map(|actuator| known.scale(actuator)).collect();
        let latency = found.map_or(0.0, |[late, _]| late);
        let lines = vec![Vec::new(); wires.sensors.len()];
        Ok(Self { rig, layout, wires, scales, latency, lines, sent: 0, lost: 0 })
    }

    /// Number of samples in `seconds` seconds.
    pub fn samples(&self, seconds: f64) -> usize {
        (seconds * self.layout.rate).round() as usize
    }

    /// Rounds a drive (actuators x samples) to the float32 samples, relative to full scale, that the device
    /// sends.
    pub fn as_sent(&self, drive: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let full = self.layout.full_scale;
        drive.iter().map(|line| line.iter().map(|x| f64::from((x / full) as f32) * full).collect()).collect()
    }

    /// Measures the rms noise of all sensors' signals while nothing is driven, in the sensors' unit.
    ///
    /// # Errors
    /// Those of the device; [`TaskError::Cancelled`].
    pub fn noise(&mut self, progress: &dyn Progress) -> Result<f64, TaskError> {
        let silent = vec![Vec::new(); self.wires.drives.len()];
        for _ in 0..SILENCE {
            self.exchange(&silent, 1)?;
        }
        self.lines.iter_mut().for_each(Vec::clear);
        while self.heard() < self.samples(QUIET) {
            go_on(progress)?;
            self.exchange(&silent, 1)?;
        }
        let squares = self.lines.iter().flatten().map(|x| x * x).sum::<f64>();
        let count = self.lines.iter().map(Vec::len).sum::<usize>();
        // What is heard at the first sample that is sent comes late: so much of what is heard before the pings is kept, or made up.
        let late = self.latency.floor() as i64 - MARGIN as i64;
        self.lines.iter_mut().for_each(|line| *line = vec![0.0; usize::try_from(-late).unwrap_or(0)]);
        (self.sent, self.lost) = (0, self.rig.device().status().lost);
        Ok((squares / count.max(1) as f64).sqrt())
    }

    /// Plays a repeated drive for one more period of `period` samples, and returns the signals that respond
    /// to it, one for each actuator's sensor.
    ///
    /// # Errors
    /// Those of the device; [`CalibrateError::Gap`] if it lost blocks; [`TaskError::Cancelled`].
    pub fn listen(
        &mut self,
        drive: &[Vec<f64>],
        period: usize,
        progress: &dyn Progress,
    ) -> Result<Vec<Vec<f64>>, TaskError> {
        // Latency beyond the margin is waited for once, with the first period.
        let ahead = usize::try_from(self.latency.floor() as i64 - MARGIN as i64).unwrap_or(0);
        let first = if self.sent == 0 { ahead } else { 0 };
        while self.heard() < first + period + 2 * MARGIN {
            go_on(progress)?;
            self.exchange(drive, period)?;
        }
        let lost = self.rig.device().status().lost - self.lost;
        if lost > 0 {
            return Err(CalibrateError::Gap { device: self.layout.device.clone(), lost }.into());
        }
        let part = self.latency - self.latency.floor();
        let one = |line: &mut Vec<f64>| {
            line.drain(..first);
            let around = shift(&line[..period + 2 * MARGIN], -part);
            line.drain(..period);
            around[MARGIN..MARGIN + period].to_vec()
        };
        Ok(self.lines.iter_mut().map(one).collect())
    }

    /// Number of samples that all recorded signals have.
    fn heard(&self) -> usize {
        self.lines.iter().map(Vec::len).min().unwrap_or(0)
    }

    /// Exchanges one block with the device: sends a drive that is repeated every `period` samples, and
    /// appends the recorded signals.
    fn exchange(&mut self, drive: &[Vec<f64>], period: usize) -> Result<(), TaskError> {
        let Layout { block, full_scale, .. } = self.layout;
        let mut sent = vec![0.0_f32; self.layout.outputs.len() * block];
        let mut heard = vec![0.0_f32; self.layout.inputs.len() * block];
        for (signal, output) in drive.iter().zip(&self.wires.drives) {
            for (i, sample) in sent[output * block..][..block].iter_mut().enumerate() {
                *sample = signal.get((self.sent + i) % period).map_or(0.0, |x| (x / full_scale) as f32);
            }
        }
        self.rig.device().exchange(&sent, &mut heard).map_err(CalibrateError::from)?;
        self.sent += block;
        for ((line, input), scale) in self.lines.iter_mut().zip(&self.wires.sensors).zip(&self.scales) {
            line.extend(heard[input * block..][..block].iter().map(|x| f64::from(*x) * scale));
        }
        Ok(())
    }
}

/// Table of time (s) and of the requested tension of a virtual surface relative to its nominal tension.
fn course(ask: &Ask) -> Vec<(f64, f64)> {
    let at = |seconds: f64| 1.0 + ask.changed + ask.changing_per_min * seconds / 60.0;
    match (ask.changed, ask.changing_per_min) {
        (0.0, 0.0) => Vec::new(),
        _ => vec![(0.0, at(0.0)), (LONGEST, at(LONGEST).max(0.0))],
    }
}
