//! Options of the task `import`.

use crate::record::{Request, Visit};
use crate::{Place, SurfaceAsk, TaskError};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What responses are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Ratios of the spectra of response and reference.
    FrequencyResponses,
    /// Responses to an impulse of one unit of the reference times one second.
    ImpulseResponses,
    /// Coefficients with which the samples of the reference are convolved: impulse responses divided by the sample rate.
    Filters,
}

impl Kind {
    /// Name of the kind in requests and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::FrequencyResponses => "frequency-responses",
            Self::ImpulseResponses => "impulse-responses",
            Self::Filters => "filters",
        }
    }
}

/// What was measured at the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// Velocity normal to the sheet.
    Velocity,
    /// Displacement normal to the sheet.
    Displacement,
    /// Acceleration normal to the sheet.
    Acceleration,
}

impl Quantity {
    /// Name of the quantity in requests and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Velocity => "velocity",
            Self::Displacement => "displacement",
            Self::Acceleration => "acceleration",
        }
    }
}

/// Unit of the reference, to which the measured quantity is related.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Per {
    /// A force in newtons.
    Newton,
    /// A voltage in volts.
    Volt,
    /// A current in amperes.
    Ampere,
}

impl Per {
    /// Symbol of the unit, as drives have it.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Newton => "N",
            Self::Volt => "V",
            Self::Ampere => "A",
        }
    }
}

/// Which files to import, what they hold as far as they do not say so themselves, and where the library is written.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface: the sheet that was measured, with its actuators.
    pub surface: SurfaceAsk,
    /// Files with responses or modes (.uff, .unv, .csv, .npz, .mat), and folders of WAV files.
    pub files: Vec<PathBuf>,
    /// Table (CSV) of the actuators and places of WAV files or columns, or of the places of nodes.
    pub table: Option<PathBuf>,
    /// How names of WAV files or of columns say actuator and place, as in `{actuator}_{x_mm}_{y_mm}.wav`.
    pub pattern: Option<String>,
    /// What the responses are.
    pub kind: Option<Kind>,
    /// What was measured at the points; the unit says so as well.
    pub quantity: Option<Quantity>,
    /// Unit of what was measured, such as `mm/s`, `g` or `0.5 m/s`.
    pub unit: Option<String>,
    /// Unit of the reference.
    pub per: Option<Per>,
    /// Drive of the actuators, in their own unit, for one unit of the reference: 2 if a volt makes 2 N.
    pub drive_per_reference: Option<f64>,
    /// Unit of the places, such as `mm`; goes before that of the file.
    pub length_unit: Option<String>,
    /// What is added to the places of the files, in m.
    pub offset_m: Place,
    /// Pairs of the name of an actuator and its name or node in the files, where these differ and places do not tell.
    pub actuator_names: Vec<(String, String)>,
    /// Names of actuators that were not measured: their responses are zero, and the library says so.
    pub without: Vec<String>,
    /// Lowest and highest frequency that are kept, in Hz; by default those of the files.
    pub band_hz: Option<[f64; 2]>,
    /// Length of the responses in s, at most 60; by default that of the files, or until modes have decayed by 60 dB.
    pub length_s: Option<f64>,
    /// Folder of the library to write.
    pub output: PathBuf,
}

impl Request for Ask {
    const COMMAND: &'static str = "import";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        self.files.iter_mut().chain(&mut self.table).try_for_each(visit)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output.unwrap_or_default();
    }
}
