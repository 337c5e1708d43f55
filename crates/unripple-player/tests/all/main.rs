//! Tests of unripple-player that share one program: a file a kind of truth. What needs a process of its own is beside it.

mod clicks;
#[path = "../common/mod.rs"]
mod common;
mod convolver;
mod ending;
mod exact;
mod holds;
mod limits;
