//! `place`: finds where actuators should be, or which of a library's to keep, and how many of them there should be.

mod ask;
mod budget;
mod by_method;
mod choice;
mod cost;
mod drives;
mod figure;
mod importance;
mod measured;
mod numbers;
mod outcome;
mod placed;
mod refused;
mod report;
mod run;
mod second;
mod setting;
mod sought;
mod text;

pub use ask::{Ask, ByAsk, ImportantAsk, ObjectiveAsk};
pub use by_method::ByMethod;
pub use placed::{Best, Build, Layout, More, Number, Placed, Random, Restarts};
pub use report::Report;
pub use run::run;
pub use second::{Compared, Second};
