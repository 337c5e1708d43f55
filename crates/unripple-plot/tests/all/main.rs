//! Tests of unripple-plot that share one program: a file a kind of truth. What needs a process of its own is beside it.

mod layout;
mod movie;
mod oracle;
mod pdf;
mod property;
#[path = "../../../unripple-core/tests/shared/python.rs"]
mod python;
mod refusal;
#[path = "../../../unripple-core/tests/shared/skip.rs"]
mod skip;
