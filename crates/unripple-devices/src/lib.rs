//! Virtual surfaces, sound servers and files as one kind of device.
//!
//! A device exchanges blocks of drive samples for blocks of recorded samples, through the trait
//! [`Device`](unripple_core::Device) of `unripple-core`. Drives are computed by other crates, and
//! `unripple-calibrate` computes responses from recordings.
//!
//! # In reading order
//!
//! [`Virtual`] is a simulated surface as a device; its [`Handle`] moves a probe, taps, and puts fingers
//! down, and a [`Perturbation`] makes the surface differ from its model. A [`Feeler`] computes what the
//! fingers feel. [`Tape`] stores a drive and returns recordings as its inputs; [`Jack`] is a sound server;
//! with the feature `cards`, `cards::Card` is a sound card. [`check_wiring`] finds channels that are silent,
//! swapped or reversed, [`check_responses`] and [`reciprocal`] find them in recordings; [`list`] lists the
//! devices that are available.
//!
//! ```
//! use unripple_core::Device;
//! use unripple_devices::{DevicesError, Virtual, VirtualOptions};
//! use unripple_physics::design::papers_surface;
//!
//! let mut film = papers_surface();
//! film.emission.band = [0.0, 1000.0];
//! let mut device = Virtual::new(&film, &VirtualOptions { block: 256, ..VirtualOptions::default() })?;
//! assert_eq!((device.layout().outputs.len(), device.layout().inputs.len()), (8, 9)); // The last input is a probe.
//!
//! // An impulse to one actuator, as the sensor of another records it.
//! let handle = device.handle();
//! let mut record = |from: usize, to: usize| {
//!     handle.rest(1);
//!     let (mut drive, mut heard) = (vec![0.0; 8 * 256], vec![0.0; 9 * 256]);
//!     drive[from * 256] = 1.0;
//!     device.exchange(&drive, &mut heard)?;
//!     Ok::<_, DevicesError>(heard[to * 256..][..256].to_vec())
//! };
//! let (there, back) = (record(0, 1)?, record(1, 0)?);
//! // Reciprocity: both directions give the same signal.
//! let largest = there.iter().fold(0.0, |most: f32, v| most.max(v.abs()));
//! assert!(largest > 0.0);
//! assert!(there.iter().zip(&back).all(|(v, w)| (v - w).abs() < 1e-5 * largest));
//! # Ok::<(), DevicesError>(())
//! ```

mod bandwidth;
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
