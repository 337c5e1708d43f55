//! A surface seen and touched in a browser.
//!
//! [`View::open`] makes a surface ready and listens; [`Viewer::serve`] serves pages until told to stop. All pages share one surface, one
//! clock and one design: what one does, all see.
//!
//! # In reading order
//!
//! A page speaks `wire`. `door` takes connections in, `lobby` has too many of them leave; `server` lets a page in if `guard` does,
//! `link` talks with it. `host` runs the `session`, a state machine: what pages say and the time go in, what they are shown comes out.
//! It has the `simulation`, which is the surface at work, and the `editor`, where surfaces are changed; what takes longer than a picture may
//! wait is done beside it by `compute`. What comes of it leaves by the `outbox` for the `notices`, from which each page takes what it has
//! not seen, as fast as it can. `jobs` are tasks that take a while: a calibration, what the doctor says.

mod assets;
mod compute;
mod door;
mod draft;
mod edition;
mod editor;
mod error;
mod guard;
mod host;
mod jobs;
mod link;
mod lobby;
mod lock;
mod messages;
mod notices;
mod outbox;
mod server;
mod session;
mod simulation;
mod spectrum;
pub mod task;
mod view;
mod wire;

pub use compute::Responder;
pub use draft::Draft;
pub use error::ViewError;
pub use simulation::Follow;
pub use unripple_tasks::play::Opener;
pub use view::{View, Viewer};
pub use wire::{Command, Edit, Job, Measure, Phase, Probe, Refused, Settings, Transport};

/// Lets some time pass, for whoever waits within [`Viewer::serve`]. The time is that of the machine's own clock.
pub async fn pause(time: std::time::Duration) {
    tokio::time::sleep(time).await;
}
