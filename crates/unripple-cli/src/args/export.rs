//! Options of `unripple export`.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Formats that libraries are exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormatName {
    /// A folder: a WAV file of float32 for each point, a channel for each actuator, and library.json.
    Wav,
    /// One file: AES69, convention GeneralFIR-E, points as measurements and actuators as emitters.
    Sofa,
}

impl FormatName {
    /// What it stands for.
    pub fn format(self) -> unripple_tasks::export::Format {
        use unripple_tasks::export::Format;
        match self {
            Self::Wav => Format::Wav,
            Self::Sofa => Format::Sofa,
        }
    }
}

/// Options of `export`.
#[derive(Debug, Args)]
pub struct ExportOptions {
    /// A library of responses.
    pub library: String,
    /// A folder for WAV, or a file for SOFA. An earlier export is replaced.
    #[arg(short, long, value_name = "DIR|FILE")]
    pub output: PathBuf,
    /// What to write; by default SOFA to a name that ends in .sofa, WAV to one without an ending.
    #[arg(long, value_enum)]
    pub format: Option<FormatName>,
    /// SOFA: whom to ask about it, with an address.
    #[arg(long, value_name = "TEXT")]
    pub author: Option<String>,
    /// SOFA: where it was measured or computed.
    #[arg(long, value_name = "TEXT")]
    pub organization: Option<String>,
    /// SOFA: under what terms it may be used.
    #[arg(long, value_name = "TEXT")]
    pub license: Option<String>,
}
