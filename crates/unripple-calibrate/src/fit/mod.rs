//! Fit of a surface's model to measured responses and taps.

mod basis;
mod blend;
mod coil;
mod fitted;
mod following;
mod forward;
mod gathered;
mod information;
mod layout;
mod limited;
mod loaded;
mod measured;
mod quadrature;
mod reached;
mod readings;
mod residual;
mod run;
mod sensing;
mod sheet;
mod solve;
mod spectra;
mod start;
mod strays;
mod system;

pub(crate) use coil::lag;
pub(crate) use spectra::Spectra;

pub use fitted::{Estimate, Fitted, FittedLoad, Verdict};
pub use information::{Information, InformationOptions, Parameter, information};
pub use measured::{Measured, Pairs, Tap};
pub use run::{FitOptions, fit};
pub use sensing::Sensing;
