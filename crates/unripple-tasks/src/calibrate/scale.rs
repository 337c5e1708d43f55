//! Scales of inputs and outputs: values at full scale, and whether absolute levels are known.

use super::ask::{Ask, By, InputScales};
use crate::{DeviceKind, TaskError};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use unripple::core::{FORCE, PROBE, Surface};
use unripple_calibrate::measure::REFERENCE;

/// Factors from the samples of a device or file to physical units.
#[derive(Clone, Debug)]
pub struct Scales {
    all: Option<f64>,
    named: BTreeMap<String, f64>,
    output: Option<f64>,
    /// How points are measured.
    by: By,
    /// Whether the device itself is in SI units, as the virtual surface is.
    own: bool,
}

impl Scales {
    /// The scales of outputs and inputs from the request, after a check.
    pub fn of(ask: &Ask, surface: &Surface) -> Result<Self, TaskError> {
        let own = ask.device.device == DeviceKind::Virtual;
        let output = ask.device.output_scale;
        if own && (output.is_some() || ask.input_scales != InputScales::default()) {
            let text = "`input_scales`, `output_scale`: expected a device of sound or recordings, found the virtual surface, which \
                        is in SI units";
            return Err(TaskError::Input(text.into()));
        }
        if let Some(scale) = output.filter(|scale| !(scale.is_finite() && *scale > 0.0)) {
            return Err(TaskError::Input(format!(
                "`output_scale`: expected a number above 0, in A, V or N, found {scale}"
            )));
        }
        let InputScales { all, named } = ask.input_scales.clone();
        for (name, scale) in
            named.iter().map(|(name, scale)| (name.as_str(), *scale)).chain(all.map(|all| ("", all)))
        {
            known(name, scale, surface)?;
        }
        let scales = Self { all, named, output, by: ask.by, own };
        scales.of_hammer(surface)?;
        Ok(scales)
    }

    /// Returns an error for a hammer whose force, or a sensor, has no scale: responses per newton would be guessed.
    fn of_hammer(&self, surface: &Surface) -> Result<(), TaskError> {
        if self.own || self.by != By::Hammer {
            return Ok(());
        }
        let sensor = surface.actuators.iter().find(|actuator| !self.knows(&actuator.name));
        let (expected, name) = match (self.named.contains_key(FORCE), sensor) {
            (false, _) => ("the force that full scale stands for in N, as in force=100", FORCE),
            (true, Some(sensor)) => (
                "what full scale stands for at every sensor, in its unit (m/s, V or A), as in a1=0.5, or one number for all",
                sensor.name.as_str(),
            ),
            (true, None) => return Ok(()),
        };
        Err(TaskError::ask("input_scales", expected, format!("none for `{name}`")))
    }

    /// Factor that converts an input's samples to its unit; 1 if unknown.
    pub fn input(&self, name: &str) -> f64 {
        self.named.get(name).copied().or(self.all).unwrap_or(1.0)
    }

    /// Drive that a sample at full scale stands for, in the actuators' unit.
    pub fn full_scale(&self, surface: &Surface) -> f64 {
        self.output.unwrap_or(surface.emission.limit)
    }

    /// Whether the scale of an input is known; a mere sign (±1 by name) counts as known.
    fn knows(&self, name: &str) -> bool {
        self.own || self.all.is_some() || self.named.contains_key(name)
    }

    /// Reason why absolute displacements and velocities are unknown; `None` if they are known.
    pub fn unknown(&self) -> Option<String> {
        // By reciprocity, a response in the sensor's unit per newton is one in m/s per unit of drive: both scales are asked for.
        if self.by == By::Hammer {
            return None;
        }
        let mut lacking = Vec::new();
        if !self.knows(PROBE) {
            lacking.push("`input_scales` probe=SCALE, m/s at the probe's full scale");
        }
        if !self.own && self.output.is_none() {
            lacking.push("`output_scale`, drive at full scale");
        }
        (!lacking.is_empty()).then(|| {
            format!("level unknown: no µm and no m/s, unless `calibrate` is given {}", lacking.join(", and "))
        })
    }

    /// Whether the device itself is in SI units, so that it has no full scale.
    pub fn is_absolute(&self) -> bool {
        self.own
    }

    /// Whether the scales of all sensors and of the probe are known; with a hammer, of all sensors and outputs.
    pub fn sensors_too(&self, surface: &Surface) -> bool {
        let other = match self.by {
            By::Hammer => self.own || self.output.is_some(),
            By::Probe | By::Tap => self.knows(PROBE),
        };
        surface.actuators.iter().all(|actuator| self.knows(&actuator.name)) && other
    }

    /// The scales as an entry of the library's log.
    pub fn told(&self) -> Value {
        json!({
            "input_all": self.all,
            "input": self.named,
            "output": self.output,
            "unknown": self.unknown(),
        })
    }
}

/// Returns an error for a scale of 0, or of an input that does not exist.
fn known(name: &str, scale: f64, surface: &Surface) -> Result<(), TaskError> {
    if !(scale.is_finite() && scale != 0.0) {
        return Err(TaskError::ask("input_scales", "a number other than 0, as in probe=0.5", scale));
    }
    let actuator = surface.actuators.iter().any(|actuator| actuator.name == name);
    if !actuator && !["", PROBE, REFERENCE, FORCE].contains(&name) {
        return Err(TaskError::ask(
            "input_scales",
            "the name of an actuator, `probe` or `force`",
            format!("`{name}`"),
        ));
    }
    Ok(())
}
