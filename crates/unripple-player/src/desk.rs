//! The control side of a player: sends commands, receives reports.

use crate::hold::{Held, Hold};
use crate::shelf::Garbage;
use crate::standing::Standing;
use crate::{Command, Count, FilterPlan, Meters, PlayerError, PreparedDrive, PreparedFilters, Report};
use rtrb::{Consumer, Producer};
use std::sync::Arc;

/// The control end of a [`Player`](crate::Player), for use off the audio thread: sends commands, receives reports, and
/// frees the memory of what is no longer played.
pub struct Desk {
    /// Commands on their way to the player.
    pub(crate) commands: Producer<Sent>,
    /// Commands sent so far.
    pub(crate) sent: u64,
    /// Reports on their way from the player.
    pub(crate) reports: Consumer<Report>,
    /// Memory that is to be freed on this thread.
    pub(crate) garbage: Consumer<Garbage>,
    /// Rings of samples, one per input.
    pub(crate) feeds: Vec<Producer<f32>>,
    /// The plan with which responses are prepared; `None` without waveforms.
    pub(crate) plan: Option<FilterPlan>,
    /// Counters and meters of the player.
    pub(crate) meters: Arc<Meters>,
    /// Requests that concern the player as a whole.
    pub(crate) standing: Arc<Standing>,
    /// Number of outputs.
    pub(crate) outputs: usize,
    /// Delay from an input to the outputs, in samples.
    pub(crate) wave_delay: usize,
}

/// A command on its way, with its number.
pub(crate) struct Sent {
    /// Number of the command: how many were sent so far, this one included.
    pub(crate) id: u64,
    /// The command itself.
    pub(crate) command: Command,
    /// The hold that keeps it playing, if it does not end by itself.
    pub(crate) held: Option<Arc<Held>>,
}

impl std::fmt::Debug for Desk {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Desk").field("outputs", &self.outputs).field("meters", &self.meters).finish()
    }
}

impl Desk {
    /// Sends a command. If it is sent before a block begins, that block takes it into account.
    ///
    /// # Errors
    /// The command itself if the ring to the player is full, or if it begins a comb, a loop or a looped waveform, which
    /// need [`Desk::hold`].
    pub fn send(&mut self, command: Command) -> Result<(), Box<Command>> {
        if command.goes_on() {
            return Err(Box::new(command));
        }
        self.push(command, None)
    }

    /// Sends a command that begins a drive or waveform, which plays until the returned hold is stopped or
    /// dropped, or until it ends by itself.
    ///
    /// # Errors
    /// The command itself if the ring to the player is full.
    pub fn hold(&mut self, command: Command) -> Result<Hold, Box<Command>> {
        let held = Arc::new(Held::new());
        self.push(command, Some(held.clone())).map(|()| Hold(held))
    }

    /// Sends a command with its number; returns it if there is no room.
    fn push(&mut self, command: Command, held: Option<Arc<Held>>) -> Result<(), Box<Command>> {
        self.collect();
        let sent = Sent { id: self.sent + 1, command, held };
        match self.commands.push(sent) {
            Ok(()) => self.sent += 1,
            Err(rtrb::PushError::Full(sent)) => {
                self.meters.add(Count::CommandsLost);
                return Err(Box::new(sent.command));
            }
        }
        Ok(())
    }

    /// Number of commands for which the ring to the player has room now. The player empties it at each block.
    pub fn room(&self) -> usize {
        self.commands.slots()
    }

    /// Cancels all commands sent so far that play a drive or waveform once and have not begun. After a time
    /// in which the player stood still, this prevents drives that are out of date from being played.
    pub fn withdraw(&mut self) {
        self.standing.withdraw(self.sent);
    }

    /// Ends the player: everything fades out over `fade` samples (at least a block), and from then on the
    /// output is silent. Commands that wait do not begin, and later ones are not accepted. A player whose
    /// desk is dropped ends in the same way.
    pub fn end(&mut self, fade: u32) {
        self.standing.end(fade);
    }

    /// Whether the player has faded out after [`Desk::end`]. It stays false if no more blocks are computed.
    pub fn is_over(&self) -> bool {
        self.standing.is_over()
    }

    /// The next report of the player; `None` if there is none.
    pub fn report(&mut self) -> Option<Report> {
        self.collect();
        self.reports.pop().ok()
    }

    /// Frees the memory of what is no longer played. Sending commands and reading reports do so, too.
    pub fn collect(&mut self) {
        while self.garbage.pop().is_ok() {}
    }

    /// Puts samples (at the player's sample rate) into the ring buffer of an input, by its index, and
    /// returns how many of them found room. An input whose ring buffer runs empty is silent.
    pub fn feed(&mut self, input: usize, samples: &[f32]) -> usize {
        let Some(ring) = self.feeds.get_mut(input) else { return 0 };
        samples.iter().take_while(|&&x| ring.push(x).is_ok()).count()
    }

    /// Prepares the responses of an input, on this thread: one per output, of at most
    /// [`WaveOptions::taps`](crate::WaveOptions::taps) samples.
    ///
    /// # Errors
    /// [`PlayerError::Size`] for another number of responses, longer ones, or a player without waveforms;
    /// [`PlayerError::Sample`] at the first sample that is not finite or too large.
    pub fn filters(&self, responses: &[Vec<f32>]) -> Result<Arc<PreparedFilters>, PlayerError> {
        let none = PlayerError::Size { what: "inputs for waveforms", expected: 1, found: 0 };
        Ok(Arc::new(self.plan.as_ref().ok_or(none)?.prepare(responses)?))
    }

    /// The plan that partitions and transforms responses for the convolution of waveforms, for use on other
    /// threads; `None` if the player has no inputs for waveforms.
    pub fn plan(&self) -> Option<&FilterPlan> {
        self.plan.as_ref()
    }

    /// Delay in samples from an input to the outputs, in addition to that of the impulse responses.
    pub fn wave_delay(&self) -> usize {
        self.wave_delay
    }

    /// Whether a drive has the same number of outputs as the player.
    pub fn fits(&self, drive: &PreparedDrive) -> bool {
        drive.outputs() == self.outputs
    }

    /// Index of the first sample of the next block, on the player's clock.
    pub fn clock(&self) -> u64 {
        self.meters.clock()
    }

    /// Counters and meters of the player, which can be shared with any thread.
    pub fn meters(&self) -> &Arc<Meters> {
        &self.meters
    }
}
