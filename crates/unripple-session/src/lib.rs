//! A surface that is shown and touched, as a state machine.
//!
//! A [`Session`] takes the commands of pages and the time that passes. It gives messages, pictures, and work that takes longer than a
//! picture may wait. It uses no network, and no thread but those of tasks: whoever runs it, a server or a page by itself, provides them. The
//! results are those of the command line.
//!
//! # In reading order
//!
//! A [`Spec`] says what is played; an [`Instrument`] is built from it, and a [`Session`] plays that. A [`Command`] is what a page sends, a
//! [`Draft`] the surface that pages edit. An [`Errand`] is work to be done beside the session: an instrument to be built, or a [`Task`] of
//! the [`ComputeWorker`]; its results, [`Done`], go back to the session. What pages are to be sent is an [`Out`].
//!
//! Inside, `wire` is the protocol of pages. The session consists of the `simulation`, which plays the surface, and the `editor`, which
//! changes it; `compute` does what takes long, unless a `stop` gives it up. Results leave through the `outbox`.
//!
//! ```
//! use unripple::physics::design::papers_surface;
//! use unripple_session::{Command, Instrument, Out, Session, Settled, Spec};
//! use unripple_tasks::Silent;
//!
//! let mut surface = papers_surface();
//! surface.emission.band = [0.0, 300.0];
//! let instrument = Instrument::build(Spec::simulated(surface), &mut Silent)?;
//! let told = Settled { source: "film".into(), device: "virtual".into(), address: None };
//! let mut session = Session::new(instrument, told);
//! session.come();
//! session.hear(1, Command::read(r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#)?);
//! session.advance(1.0 / 30.0, 1, &mut || true);
//! assert!(session.take().iter().any(|out| matches!(out, Out::Frame(..))));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod compute;
mod draft;
mod edition;
mod editor;
mod error;
mod lock;
mod messages;
mod outbox;
mod session;
mod simulation;
mod spectrum;
mod stop;
mod wire;

pub use compute::{ComputeWorker, Found, Responder, Task};
pub use draft::Draft;
pub use error::ViewError;
pub use lock::lock;
pub use messages::Settled;
pub use outbox::{Held, Measured, Out, Picture, refusal, stopped, toml};
pub use session::{Done, Errand, Session};
pub use simulation::{Follow, Instrument, PULSES, RealDevice, Spec};
pub use stop::{Stop, Watch};
pub use wire::{Command, Edit, Job, LONGEST, Measure, Phase, Probe, Refused, Settings, Transport};
