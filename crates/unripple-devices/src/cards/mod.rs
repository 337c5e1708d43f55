//! Sound cards as devices, through the system's own interface (ALSA, WASAPI, CoreAudio). Only with the feature `cards`, which
//! on Debian needs `libasound2-dev` and `pkg-config` to build.

mod bell;
#[cfg(test)]
mod clocked;
mod counts;
mod crossing;
mod device;
mod ferry;
mod found;
mod side;
#[cfg(test)]
mod stand_in;
mod streams;
#[cfg(test)]
mod tests;

pub use device::{Card, CardOptions};
pub use found::{CardFound, Offer, found};
