//! Tests of unripple-calibrate that share one program: a file a kind of truth. What needs a process of its own is beside it.

// Folders of shared code bring what they need themselves, since examples load them too.
#![allow(clippy::duplicate_mod)]

#[path = "../between_bench/mod.rs"]
mod between_bench;
mod between_oracle;
mod between_property;
#[path = "../drift_bench/mod.rs"]
mod drift_bench;
mod drift_oracle;
mod drift_property;
mod drift_truth;
mod fit_beginnings;
mod fit_information;
mod fit_oracle;
mod fit_reach;
#[path = "../fit_truth/mod.rs"]
mod fit_truth;
mod fit_truths;
mod frequencies;
mod hammer;
#[path = "../heard_bench/mod.rs"]
mod heard_bench;
mod kinds;
#[path = "../kinds_bench/mod.rs"]
mod kinds_bench;
mod latency;
mod measured;
#[path = "../measured_bench/mod.rs"]
mod measured_bench;
mod recorded;
#[path = "../recorded_bench/mod.rs"]
mod recorded_bench;
mod ringing;
#[path = "../signals_bench/mod.rs"]
mod signals_bench;
mod signals_delay;
mod signals_quality;
mod signals_schedule;
mod signals_stimulus;
mod taps;
mod verify;
mod wavelength;
