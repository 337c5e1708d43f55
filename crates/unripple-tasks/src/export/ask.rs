//! Options of the task `export`.

use crate::TaskError;
use crate::record::{Request, Visit};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Formats that libraries are exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Format {
    /// A folder: a WAV file of float32 for each point, a channel for each actuator, and library.json.
    Wav,
    /// One SOFA file (AES69, convention GeneralFIR-E), with points as measurements and actuators as
    /// emitters.
    Sofa,
}

impl Format {
    /// Name of the format in requests and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wav => "wav",
            Self::Sofa => "sofa",
        }
    }
}

/// Which library to export, in which format, and where.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A library of responses.
    pub library: PathBuf,
    /// Path of the export: a folder for WAV, or a file for SOFA. An earlier export is replaced.
    pub output: PathBuf,
    /// Format; by default SOFA if the output's name ends in .sofa, WAV if it has no ending.
    pub format: Option<Format>,
    /// SOFA: author to contact, with an address.
    pub author: Option<String>,
    /// SOFA: organization where the responses were measured or computed.
    pub organization: Option<String>,
    /// SOFA: licence of the data.
    pub license: Option<String>,
}

impl Request for Ask {
    const COMMAND: &'static str = "export";

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        visit(&mut self.library)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output.unwrap_or_default();
    }
}
