//! A real-time player: mixes drives and waveforms into blocks of samples, within the limits of each actuator.
//!
//! Drives and responses come ready-made to the player, and its blocks go to whatever calls it: it computes no focus, knows
//! no surface and opens no device.
//!
//! # In reading order
//!
//! [`player`] makes two ends. The [`Player`] runs on the audio thread and computes blocks; the [`Desk`] runs on any
//! other thread, sends [`Command`]s, receives [`Report`]s, and frees the memory of what is no longer played. They are
//! connected by lock-free ring buffers.
//!
//! - **Start.** A command for [`At::Now`] that was sent before a block begins acts at that block's first sample; one
//!   for a sample acts exactly at that sample. The same commands for the same samples give the same bits, however early
//!   they were sent. Of commands for the same sample the first sent acts first.
//! - **End.** A drive or a waveform played once ends by itself. A *comb* (a drive started again and again with a fixed
//!   period), a *loop* (one pass repeated without a gap) or a looped waveform is sent with [`Desk::hold`] and plays
//!   until its [`Hold`] is stopped or dropped: the player reads all holds at each block, so that stopping needs no room
//!   in a queue and cannot fail. The hold also tells when the player has ended or refused it. Commands that have not
//!   yet begun can be taken back ([`Desk::withdraw`]). [`Desk::end`], or dropping the desk, ends everything with a
//!   fade.
//! - **Drives** ([`PreparedDrive`]) are played once, as a comb, or as a loop. Voices add. Each copy is scaled as a whole
//!   when it starts, so that together with everything started before it no limit of any actuator can be exceeded,
//!   whatever is stopped or faded later. Where no limit is reached, the samples of a single voice are emitted bit for
//!   bit.
//! - **Waveforms** enter a [`Convolver`] and leave through all actuators. They get what drives leave of the limits: one
//!   gain for all of them, which changes smoothly and is computed a block ahead.
//! - **Work** in a block is bounded by [`Options`]: commands, copies, and the samples of drives that are compared with
//!   the limits in one block. Starts beyond the bound begin with a later block, and are reported late.
//!
//! ```
//! use std::sync::Arc;
//! use unripple_core::Drive;
//! use unripple_player::{At, Command, Options, PreparedDrive, Report, Voice, player};
//!
//! let (mut player, mut desk) = player(&Options { outputs: 1, ..Options::default() })?;
//! let drive = Drive::new(48e3, vec!["a1".into()], vec![vec![0.5, 1.0, -0.5]])?;
//! let drive = Arc::new(PreparedDrive::from_drive(&drive)?);
//! for voice in [Voice(1), Voice(2)] {
//!     let (drive, at) = (drive.clone(), At::Sample(10));
//!     assert!(desk.send(Command::Start { voice, drive, at, gain: 0.75, period: None }).is_ok());
//! }
//! let mut block = [0.0; 64];
//! player.process(&mut block);
//! // Together they would reach 1.5: the second is scaled down as a whole, and nothing is clipped.
//! assert!((block[11] - 1.0).abs() < 1e-5 && (block[10] - 0.5).abs() < 1e-5);
//! let mut reports = std::iter::from_fn(|| desk.report());
//! assert!(reports.any(|report| matches!(report, Report::Limited { voice: Voice(2), .. })));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod clicks;
mod command;
mod convolver;
mod copies;
mod desk;
mod error;
mod events;
mod hold;
mod kernels;
mod leases;
mod ledger;
mod meters;
mod options;
mod origin;
mod outlet;
mod player;
mod power;
mod prepared;
mod schedule;
mod shelf;
mod standing;
mod waves;

pub use clicks::Clicks;
pub use command::{At, Command, Report, Voice, Which, Why};
pub use convolver::{Convolver, FilterPlan, PreparedFilters};
pub use desk::Desk;
pub use error::PlayerError;
pub use hold::Hold;
pub use meters::{Count, Meters};
pub use options::{Limit, Options, Running, WaveOptions};
pub use player::{Player, player};
pub use prepared::PreparedDrive;
