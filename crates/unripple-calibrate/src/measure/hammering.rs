//! A session of blows at places with a hammer whose force is recorded, while the actuators' sensors listen.

use super::{BlowFault, Channel, MeasureOptions, Rig, Struck, Wires, hammered, record, struck};
use crate::CalibrateError;
use crate::signals::Band;
use unripple_core::{FORCE, Layout, Point, Surface};

/// Largest number of blows that are asked for in place of one that is refused: who hits double five times needs another hammer.
const AGAIN: u64 = 4;

/// A plan for measuring by blows of a hammer with a force sensor, with all actuators as sensors: responses follow by reciprocity, without
/// a probe and without a model.
#[derive(Clone, Debug)]
pub struct HammerSession {
    options: MeasureOptions,
    /// Inputs of the sensors, then that of the force.
    inputs: Vec<usize>,
    /// Factor on each sensor's signal.
    scales: Vec<f64>,
    /// Force in N that a sample of 1 stands for.
    newtons: f64,
    band: Band,
    rate: f64,
    window: usize,
    heard: usize,
}

impl HammerSession {
    /// A plan for a surface whose sensors and force have these wires; `newtons` is the force that a sample of 1 stands for.
    ///
    /// # Errors
    /// [`CalibrateError::Recording`] without sensors, without an input for the force, or for a device of another rate;
    /// [`CalibrateError::Range`] for options out of range.
    pub fn new(
        surface: &Surface,
        layout: &Layout,
        wires: &Wires,
        newtons: f64,
        options: &MeasureOptions,
    ) -> Result<Self, CalibrateError> {
        let sweep = options.sweep(surface, layout)?;
        let lacks = |expected: &str| CalibrateError::Recording {
            what: format!("inputs of `{}`", layout.device),
            expected: expected.into(),
            found: layout.inputs.join(", "),
        };
        if wires.sensors.len() != surface.actuators.len() {
            return Err(lacks("a sensor for each actuator, under its name"));
        }
        let force =
            wires.force.ok_or_else(|| lacks(&format!("one that is called `{FORCE}`, the hammer's")))?;
        let window = options.apart(sweep.rate);
        // A blow may come late in the recording, which is twice as long as what follows the blow.
        let samples = 2 * window;
        Ok(Self {
            options: options.clone(),
            inputs: wires.sensors.iter().copied().chain([force]).collect(),
            scales: vec![1.0; surface.actuators.len()],
            newtons,
            band: Band::within(sweep.from, sweep.to),
            rate: sweep.rate,
            window,
            heard: samples.div_ceil(layout.block) * layout.block,
        })
    }

    /// This plan with a factor on the signal of each sensor, negative for a sensor of reversed sign.
    #[must_use]
    pub fn by_scales(self, scales: Vec<f64>) -> Self {
        Self { scales, ..self }
    }

    /// Blows in a recording of the sensors and, last, the force, `[input][sample]` in the device's units.
    ///
    /// # Errors
    /// Those of [`struck`].
    pub fn blows(&self, heard: &[Vec<f64>]) -> Result<Vec<Result<Struck, BlowFault>>, CalibrateError> {
        let Some((force, sensors)) = heard.split_last() else {
            let what = "inputs that recorded a blow";
            return Err(CalibrateError::Count { what, expected: "at least 2".into(), found: 0 });
        };
        let times = |signal: &[f64], by: f64| signal.iter().map(|x| x * by).collect::<Vec<_>>();
        let sensors: Vec<Vec<f64>> =
            sensors.iter().zip(&self.scales).map(|(signal, by)| times(signal, *by)).collect();
        struck(&times(force, self.newtons), &sensors, &self.options.without, (self.rate, self.window))
    }

    /// The responses at a place, from its blows.
    ///
    /// # Errors
    /// Those of [`hammered`].
    pub fn responses(&self, blows: &[Struck], refused: Vec<BlowFault>) -> Result<Channel, CalibrateError> {
        hammered(blows, refused, self.options.samples(self.rate), (self.rate, self.band))
    }

    /// Records blows at a place, one for each repeat, and computes the responses from them. A blow that is refused is asked for again,
    /// with the reason. `at` is in m, `attempt` counts the recordings at this place from 0.
    ///
    /// # Errors
    /// Those of the rig, of [`record`] and of [`hammered`].
    pub fn measure(
        &self,
        rig: &mut dyn Rig,
        number: usize,
        at: Point,
        attempt: u64,
    ) -> Result<Channel, CalibrateError> {
        let wanted = self.options.repeats;
        let most = wanted as u64 * (1 + AGAIN);
        let (mut good, mut refused) = (Vec::with_capacity(wanted), Vec::new());
        for blow in 0..most {
            if good.len() == wanted {
                break;
            }
            let attempt = attempt * most + blow;
            rig.ready(number, at, attempt)?;
            rig.tap(number, at, attempt)?;
            let heard = record(rig.device(), &[], &[], &self.inputs, self.heard)?;
            let found = match self.blows(&heard) {
                // Nobody struck.
                Err(CalibrateError::Recording { found, .. }) => {
                    rig.refused(number, &found);
                    continue;
                }
                other => other?,
            };
            for one in found {
                match one {
                    Ok(struck) => good.push(struck),
                    Err(fault) => {
                        rig.refused(number, &fault.to_string());
                        refused.push(fault);
                    }
                }
            }
        }
        self.responses(&good, refused)
    }

    /// The reason why a channel is bad, in words: its first response with too little signal; `None` if it is good.
    pub fn fault(&self, channel: &Channel) -> Option<String> {
        self.options.fault(channel, "sensor")
    }
}
