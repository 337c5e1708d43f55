//! Options of the task `waveform`.

use crate::record::{Request, Visit};
use crate::{Place, SurfaceAsk, TaskError};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Waveform that a target is to follow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum SoundAsk {
    /// A tone of one frequency.
    Sine {
        /// Frequency of the tone, in Hz.
        hz: f64,
        /// Duration of the tone, in s.
        length_s: f64,
    },
    /// A number of cycles of a tone, under a raised-cosine window.
    Burst {
        /// Frequency of the tone, in Hz.
        hz: f64,
        /// Number of cycles of the tone.
        cycles: f64,
    },
    /// A single pulse in the shape of a raised cosine.
    Click {
        /// Duration of the pulse, in s.
        length_s: f64,
    },
    /// The first channel of a recording.
    Wav {
        /// Path of the WAV file.
        file: PathBuf,
    },
    /// Samples that the request itself contains.
    Samples {
        /// Sample values; only their ratios matter, since the level sets the peak.
        values: Vec<f64>,
        /// Sample rate of `values`, in Hz.
        rate_hz: f64,
    },
}

/// A target and the waveform that it is to follow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WaveformAsk {
    /// Place of the target, in m.
    pub at_m: Place,
    /// The waveform that the target is to follow.
    pub sound: SoundAsk,
    /// Peak displacement of the waveform, in m.
    #[serde(default = "micrometre")]
    pub level_m: f64,
}

/// Peak displacement of a waveform if none is given, in m: well above the threshold of touch at 250 Hz (0.1 µm), and far below a film's
/// thickness.
pub(crate) const LEVEL_M: f64 = 1e-6;

/// [`LEVEL_M`], for serde.
fn micrometre() -> f64 {
    LEVEL_M
}

/// Targets with their waveforms, places of silence, and the surface that the drive is evaluated on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
    /// Targets with the waveforms that they follow.
    pub waveforms: Vec<WaveformAsk>,
    /// Places that are to stay still while the targets follow their waveforms, in m.
    pub silent_m: Vec<Place>,
    /// Time by which the drive may begin before a waveform and end after it, in s.
    pub window_s: Option<f64>,
    /// Evaluate the drive on this surface instead of the one that it was computed for.
    pub on: Option<SurfaceAsk>,
    /// Evaluate the drive with modes up to this frequency, in Hz; by default up to three times the top of the band, at
    /// most 0.45 of the sample rate.
    pub judge_hz: Option<f64>,
    /// Folder for drive.wav, report.json, report.md and figures. An existing folder is replaced only if it
    /// holds nothing but the unchanged files of an earlier run.
    pub output: Option<PathBuf>,
    /// Write no figures.
    pub no_figures: bool,
    /// Width of all figures in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default each figure
    /// has its own width.
    pub columns: Option<usize>,
}

impl Request for Ask {
    const COMMAND: &'static str = "waveform";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        std::iter::once(&mut self.surface).chain(&mut self.on).collect()
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        self.waveforms.iter_mut().try_for_each(|waveform| match &mut waveform.sound {
            SoundAsk::Wav { file } => visit(file),
            _ => Ok(()),
        })
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
