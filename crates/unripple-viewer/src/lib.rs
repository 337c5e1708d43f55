//! A surface seen and touched in a browser.
//!
//! [`View::open`] makes a surface ready and listens; [`Viewer::serve`] serves pages until told to stop. All pages share one surface, one
//! clock and one design: what one does, all see.
//!
//! # In reading order
//!
//! A page speaks `wire`. `door` takes connections in, `lobby` has too many of them leave; `server` lets a page in if `guard` does,
//! `link` talks with it, `studio` passes on what it asks for: to the `rig`, which is the surface at work; to the `workshop`, where
//! surfaces are changed; to the `bench`, where figures are computed; to `jobs`, which take a while. What comes of it stands on the
//! `board`, from which each page takes what it has not seen, as fast as it can.

mod assets;
mod bench;
mod board;
mod door;
mod draft;
mod edition;
mod error;
mod guard;
mod jobs;
mod link;
mod lobby;
mod lock;
mod rig;
mod server;
mod spectrum;
mod studio;
mod told;
mod view;
mod wire;
mod workshop;

pub use bench::Responder;
pub use draft::Draft;
pub use error::ViewError;
pub(crate) use link::Caller;
pub use rig::{Follow, Opener};
pub use view::{View, Viewer};
pub use wire::{Command, Edit, Job, Measure, Phase, Probe, Refused, Settings, Transport};

/// Lets some time pass, for whoever waits within [`Viewer::serve`].
pub async fn pause(time: std::time::Duration) {
    tokio::time::sleep(time).await;
}
