//! A real-time player: drives and waveforms into blocks of samples, within limits.
//!
//! [`player`] makes two ends. The [`Player`] lives on the audio thread and turns commands into blocks; the [`Desk`] lives anywhere
//! else, sends the commands, hears reports, and frees what is no longer played. Between them are rings without locks.
//!
//! - **When.** A command for [`At::Now`] that was sent before a block begins acts at that block's first sample; one for a sample acts exactly
//!   there. The same commands for the same samples give the same bits, however early they were sent. Of commands for the same
//!   sample the first sent acts first.
//! - **Until when.** What is over by itself, a drive or a waveform played once, is sent and forgotten. What goes on, a comb, a loop or a looped
//!   waveform, is sent for a [`Hold`] and sounds as long as that is kept: the player looks at all holds with each block, so that ending
//!   needs no room and cannot fail. The hold also says when the player is done with it or has refused it. What was sent may be taken back
//!   ([`Desk::withdraw`]). All ends with a fade, by [`Desk::end`] or when the desk is dropped.
//! - **Drives** ([`Prepared`]) are played once, as a comb, or as a loop. Voices add. Each copy is scaled, as a whole, as it starts, so that
//!   no limit of any actuator can be passed by it and all that was started before, whatever is stopped or faded later.
//!   With no limit in the way, the samples of a single voice are emitted bit for bit.
//! - **Waveforms** enter a [`Convolver`] and leave through all actuators. They get what drives leave of the limits, by one gain that runs
//!   smoothly and knows a block ahead.
//! - **Work** in a block is bounded by [`Options`]: commands, copies, and the samples of drives that are judged in one block. Starts
//!   beyond the last begin with the next block instead, as far as that has time, and are reported late.

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
pub use prepared::Prepared;
