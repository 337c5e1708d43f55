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
    /// One universal file of text: nodes, units and frequency responses (datasets 2411, 164 and 58).
    Uff,
    /// One universal file with the modes of the surface that the library describes, at its points and actuators (dataset 55).
    UffModes,
    /// One MATLAB file of version 5 with the responses, places and names as arrays.
    Mat,
}

impl Format {
    /// Name of the format in requests and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wav => "wav",
            Self::Sofa => "sofa",
            Self::Uff => "uff",
            Self::UffModes => "uff-modes",
            Self::Mat => "mat",
        }
    }

    /// Name of the format in messages.
    pub(super) fn told(self) -> &'static str {
        match self {
            Self::Wav => "WAV",
            Self::Sofa => "SOFA",
            Self::Uff | Self::UffModes => "UFF",
            Self::Mat => "MATLAB",
        }
    }
}

/// Which library to export, in which format, and where.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A library of responses.
    pub library: PathBuf,
    /// Path of the export: a folder for WAV, or a file. An earlier export is replaced if it is WAV or SOFA; other files must not exist yet.
    pub output: PathBuf,
    /// Format; by default the one that the ending of the output's name implies (.sofa, .uff, .unv, .mat), or WAV if it has none.
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
