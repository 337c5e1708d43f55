//! Options of the task `export`.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Formats that libraries are exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Format {
    /// A folder: a WAV file of float32 for each point, a channel for each actuator, and library.json.
    Wav,
    /// One file: AES69, convention GeneralFIR-E, points as measurements and actuators as emitters.
    Sofa,
}

impl Format {
    /// Its name in asks and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wav => "wav",
            Self::Sofa => "sofa",
        }
    }
}

/// Which library is to be written, in which format, and where.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A library of responses.
    pub library: PathBuf,
    /// A folder for WAV, or a file for SOFA. An earlier export is replaced.
    pub output: PathBuf,
    /// What to write; by default SOFA to a name that ends in .sofa, WAV to one without an ending.
    pub format: Option<Format>,
    /// SOFA: whom to ask about it, with an address.
    pub author: Option<String>,
    /// SOFA: where it was measured or computed.
    pub organization: Option<String>,
    /// SOFA: under what terms it may be used.
    pub license: Option<String>,
}
