//! Tests of unripple-plot that share one program: a file a kind of truth. What needs a process of its own is beside it.

mod movie;
mod oracle;
mod property;
mod refusal;
