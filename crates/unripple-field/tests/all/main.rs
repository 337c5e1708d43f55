//! Tests of unripple-field that share one program: a file a kind of truth. What needs a process of its own is beside it.

mod combined;
#[path = "../common/mod.rs"]
mod common;
mod elsewhere;
mod errors;
mod felt;
mod oracle;
mod property;
mod small;
mod sound;
