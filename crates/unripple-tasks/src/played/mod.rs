//! Waveforms and strokes: what is played, evaluated, and written.

mod judged;
mod made;
mod write;

pub(crate) use judged::{Common, Played, judge};
pub use made::Made;
pub use write::figures;
pub(crate) use write::keep;
