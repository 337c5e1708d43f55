//! Virtual surfaces, sound servers and files as one kind of device.
//!
//! [`Virtual`] is a simulated surface as a [`Device`](unripple_core::Device); a [`Perturbation`] makes it differ from
//! its model. [`Tape`] keeps a drive and plays recordings to its inputs; [`Jack`] is a sound server; with the feature
//! `cards`, `cards::Card` is a sound card. [`check_wiring`] finds channels that are silent, swapped or reversed,
//! [`check_responses`] and [`reciprocal`] find them in recordings; [`list`] lists the devices that are available.

#[cfg(feature = "cards")]
pub mod cards;
mod delay;
mod error;
mod interface;
pub mod jack;
mod list;
mod perturbation;
mod tap;
mod tape;
mod virtual_surface;
mod wiring;

pub use error::DevicesError;
pub use interface::Interface;
pub use jack::{Bridge, Jack, JackOptions, Links};
pub use list::{Found, Server, Stream, list};
pub use perturbation::{Perturbation, Truth};
pub use tap::Tap;
pub use tape::Tape;
pub use virtual_surface::{Feeler, Feeling, Handle, Virtual, VirtualOptions};
pub use wiring::{
    Expected, Lead, Reciprocal, WiringOptions, WiringReport, check_responses, check_wiring, reciprocal,
};
