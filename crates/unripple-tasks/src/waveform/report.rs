//! Report of the task `waveform`: the report on a drive and its field that `focus` uses too.

pub use unripple::act::Report;
