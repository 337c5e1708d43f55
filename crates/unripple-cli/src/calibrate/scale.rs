//! What full scale is at inputs and outputs, and so whether levels are known.

use crate::args::{CalibrateOptions, DeviceName};
use crate::error::CliError;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use unripple::core::{PROBE, Surface};
use unripple_calibrate::measure::REFERENCE;

/// Factors from what a device or a file holds to what it means.
#[derive(Clone, Debug)]
pub struct Scales {
    all: Option<f64>,
    named: BTreeMap<String, f64>,
    output: Option<f64>,
    /// Whether the device says its scale itself.
    own: bool,
}

impl Scales {
    /// As the options say.
    pub fn of(options: &CalibrateOptions, surface: &Surface) -> Result<Self, CliError> {
        let own = options.device.device == DeviceName::Virtual;
        let output = options.device.output_scale;
        if own && (output.is_some() || !options.input_scale.is_empty()) {
            let text = "--input-scale, --output-scale: expected a device of sound or recordings, found the virtual surface, which \
                        is in SI units";
            return Err(CliError::Input(text.into()));
        }
        if let Some(scale) = output.filter(|scale| !(scale.is_finite() && *scale > 0.0)) {
            return Err(CliError::Input(format!(
                "--output-scale: expected a number above 0, in A, V or N, found {scale}"
            )));
        }
        let mut scales = Self { all: None, named: BTreeMap::new(), output, own };
        for text in &options.input_scale {
            scales.add(text, surface)?;
        }
        Ok(scales)
    }

    fn add(&mut self, text: &str, surface: &Surface) -> Result<(), CliError> {
        let refuse = |expected: &str, found: &str| {
            Err(CliError::Input(format!("--input-scale {text}: expected {expected}, found {found}")))
        };
        let (name, number) = text.split_once('=').map_or((None, text), |(name, number)| (Some(name), number));
        let scale = match number.trim().parse::<f64>() {
            Ok(scale) if scale.is_finite() && scale != 0.0 => scale,
            _ => return refuse("a number other than 0, as in probe=0.5", number),
        };
        let Some(name) = name else {
            self.all = Some(scale);
            return Ok(());
        };
        let known = surface.actuators.iter().any(|actuator| actuator.name == name);
        if !known && name != PROBE && name != REFERENCE {
            return refuse("the name of an actuator, or `probe`", &format!("`{name}`"));
        }
        self.named.insert(name.into(), scale);
        Ok(())
    }

    /// What an input's samples are to be multiplied by.
    pub fn input(&self, name: &str) -> f64 {
        self.named.get(name).copied().or(self.all).unwrap_or(1.0)
    }

    /// Drive, in the actuators' unit, of a sample at full scale.
    pub fn full_scale(&self, surface: &Surface) -> f64 {
        self.output.unwrap_or(surface.emission.limit)
    }

    /// Whether an input's size is known; a sign alone (±1 by name) says it too.
    fn knows(&self, name: &str) -> bool {
        self.own || self.all.is_some() || self.named.contains_key(name)
    }

    /// Why lengths and velocities are not known, if they are not.
    pub fn unknown(&self) -> Option<String> {
        let mut lacking = Vec::new();
        if !self.knows(PROBE) {
            lacking.push("--input-scale probe=SCALE, m/s at the probe's full scale");
        }
        if !self.own && self.output.is_none() {
            lacking.push("--output-scale, drive at full scale");
        }
        (!lacking.is_empty()).then(|| {
            format!("level unknown: no µm and no m/s, until `calibrate` is told {}", lacking.join(", and "))
        })
    }

    /// Whether the device itself is in SI units, so that it has no full scale.
    pub fn is_absolute(&self) -> bool {
        self.own
    }

    /// Whether sensors are known to be in the probe's own scale.
    pub fn sensors_too(&self, surface: &Surface) -> bool {
        surface.actuators.iter().all(|actuator| self.knows(&actuator.name)) && self.knows(PROBE)
    }

    /// For the library's log.
    pub fn told(&self) -> Value {
        json!({
            "input_all": self.all,
            "input": self.named,
            "output": self.output,
            "unknown": self.unknown(),
        })
    }
}
