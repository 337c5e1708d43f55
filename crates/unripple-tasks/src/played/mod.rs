//! Waveforms and strokes: what is played, evaluated, and written.

mod judged;
mod write;

pub(crate) use judged::{Common, Played, judge};
