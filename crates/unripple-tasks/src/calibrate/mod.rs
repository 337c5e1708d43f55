//! `calibrate`: measures responses through a device, point by point, and stores them in a library.

mod ask;
pub(crate) mod before;
mod campaign;
mod devices;
mod figure;
mod filler;
mod finish;
mod hammer;
mod hands;
mod levels;
mod live;
mod outcome;
mod points;
mod report;
mod rigs;
mod run;
mod scale;
mod tape;
mod taps;
mod verify;
mod wires;
mod without_force;

pub use ask::{Ask, By, InputScales};
pub(crate) use campaign::by_taps;
pub(crate) use devices::{open, open_under, open_with};
pub use hands::{Hands, nobody};
pub use levels::Levels;
pub use outcome::Report;
pub(crate) use points::middle;
pub use report::Report as LibraryReport;
pub(crate) use rigs::People;
pub use run::{run, run_with};
