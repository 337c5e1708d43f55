//! Text forms of what requests contain: targets and waveforms, as people type them.

mod targets;
mod waveforms;
