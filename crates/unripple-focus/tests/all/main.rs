//! Tests of unripple-focus that share one program: a file a kind of truth. What needs a process of its own is beside it.

#[path = "../common/mod.rs"]
mod common;
mod optimum;
mod oracle;
mod property;
mod waveform_oracle;
