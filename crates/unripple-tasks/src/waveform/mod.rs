//! `waveform`: computes a drive by which targets follow waveforms while other places are still.

mod ask;
mod report;
mod run;
mod sound;

pub use crate::played::{Made, figures};
pub(crate) use ask::LEVEL_M;
pub use ask::{Ask, SoundAsk, WaveformAsk};
pub use report::Report;
pub use run::{check, make, make_on, run, run_on};
