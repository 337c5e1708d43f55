//! `waveform`: waveforms at targets, silence at others.

mod ask;
mod report;
mod run;
mod sound;

pub use ask::{Ask, SoundAsk, WaveformAsk};
pub use report::Report;
pub use run::{make, run};
