//! `sensors`: finds the places of sensors, or of taps, that tell a fit most about a surface.

mod ask;
mod cost;
mod figure;
mod planned;
mod report;
mod run;
mod setting;
mod text;

pub use ask::{Ask, SensingAsk};
pub use planned::{Certificate, Number, Pair, Unknown};
pub use report::Report;
pub use run::run;
