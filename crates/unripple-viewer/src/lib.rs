//! A surface seen and touched in a browser.
//!
//! All pages share one surface, one clock and one design: a change by one page is seen on all. The page computes no results; those it
//! shows are computed by the crates below, as on the command line.
//!
//! # In reading order
//!
//! A [`View`] says what is shown and who may connect. [`View::open`] builds the surface and listens; [`Viewer::serve`] serves pages until
//! told to stop. A [`Command`] is what a page sends, a [`Draft`] the surface that pages edit, and [`task`] is all of this as a task.
//!
//! Inside, `door` accepts connections, `lobby` limits their number; `server` answers requests that `guard` allows, `framing` says which
//! other pages may show this one, and `link` serves a page's WebSocket. `host` runs the [`Session`](unripple_session::Session), a state
//! machine that takes the pages' commands and the time that passes, and gives messages and pictures. These go to the `notices`, from which
//! each page takes those that it has not seen, as fast as it can. `jobs` are long tasks, such as a calibration or the doctor.
//!
//! ```
//! use std::time::Duration;
//! use unripple::{focus::Method, physics::design::papers_surface};
//! use unripple_viewer::{View, pause};
//!
//! let mut surface = papers_surface();
//! surface.emission.band = [0.0, 700.0];
//! let view = View {
//!     surface, source: "film".into(), method: Method::TimeReversal,
//!     // Simulated, with computed responses.
//!     stored: None, without_scale: None, respond: None, device: None, device_name: "virtual".into(), follow: None,
//!     // Any free port, for this machine only.
//!     address: ([127, 0, 0, 1], 0).into(), token: None, framed_by: Vec::new(), folder: std::env::temp_dir(), quiet: true,
//! };
//! let viewer = view.open()?;
//! assert!(viewer.url().starts_with("http://127.0.0.1:") && viewer.elsewhere().is_none());
//! viewer.serve(pause(Duration::from_millis(20)))?;
//! # Ok::<(), unripple_viewer::ViewError>(())
//! ```

mod assets;
mod door;
mod framing;
mod guard;
mod host;
mod jobs;
mod link;
mod lobby;
mod notices;
mod server;
pub mod task;
mod view;
mod viewer;

pub use framing::Origin;
pub use unripple_session::{
    Command, Draft, Edit, Follow, Job, Measure, Phase, Probe, Refused, Responder, Settings, Transport,
    ViewError,
};
pub use unripple_tasks::play::Opener;
pub use view::View;
pub use viewer::Viewer;

/// Waits for a duration, by the machine's clock: a future that can be passed to [`Viewer::serve`].
pub async fn pause(time: std::time::Duration) {
    tokio::time::sleep(time).await;
}
