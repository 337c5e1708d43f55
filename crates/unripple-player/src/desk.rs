//! The control side of a player: sends commands, hears reports.

use crate::hold::{Held, Hold};
use crate::shelf::Garbage;
use crate::standing::Standing;
use crate::{Command, Count, FilterPlan, Meters, PlayerError, Prepared, PreparedFilters, Report};
use rtrb::{Consumer, Producer};
use std::sync::Arc;

/// The end of a [`Player`](crate::Player) that lives off the audio thread: sends commands, hears reports, and frees what is no
/// longer played.
pub struct Desk {
    /// Commands on their way to the player.
    pub(crate) commands: Producer<Sent>,
    /// Commands sent so far.
    pub(crate) sent: u64,
    /// Reports on their way from it.
    pub(crate) reports: Consumer<Report>,
    /// What is to be freed here.
    pub(crate) garbage: Consumer<Garbage>,
    /// Rings of samples, one per input.
    pub(crate) feeds: Vec<Producer<f32>>,
    /// How responses are made ready; none without waveforms.
    pub(crate) plan: Option<FilterPlan>,
    /// What is counted.
    pub(crate) meters: Arc<Meters>,
    /// What is wanted of the player at any time.
    pub(crate) standing: Arc<Standing>,
    /// Number of outputs.
    pub(crate) outputs: usize,
    /// Samples from an input to the outputs.
    pub(crate) wave_delay: usize,
}

/// A command on its way, with its number.
pub(crate) struct Sent {
    /// Its number: how many were sent up to it.
    pub(crate) id: u64,
    /// What is asked for.
    pub(crate) command: Command,
    /// What keeps it going, if it goes on.
    pub(crate) held: Option<Arc<Held>>,
}

impl std::fmt::Debug for Desk {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Desk").field("outputs", &self.outputs).field("meters", &self.meters).finish()
    }
}

impl Desk {
    /// Sends a command. One that is sent before a block begins is known to that block.
    ///
    /// # Errors
    /// The command itself if as many are under way as may, or if it begins what goes on until it is ended: that is for [`Desk::hold`].
    pub fn send(&mut self, command: Command) -> Result<(), Box<Command>> {
        if command.goes_on() {
            return Err(Box::new(command));
        }
        self.push(command, None)
    }

    /// Sends what begins something, which sounds as long as the hold is kept or until it is over by itself.
    ///
    /// # Errors
    /// The command itself if as many are under way as may.
    pub fn hold(&mut self, command: Command) -> Result<Hold, Box<Command>> {
        let held = Arc::new(Held::new());
        self.push(command, Some(held.clone())).map(|()| Hold(held))
    }

    /// Sends a command with its number; gives it back if there is no room.
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

    /// How many commands find room now. The player takes all of them with each block.
    pub fn room(&self) -> usize {
        self.commands.slots()
    }

    /// Takes back what was sent so far, has not begun, and would be over by itself: for a player that stood still, so that nothing begins
    /// when nobody wants it any more.
    pub fn withdraw(&mut self) {
        self.standing.withdraw(self.sent);
    }

    /// Lets the player fade out all that sounds over so many samples, at least a block, and be silent from then on: what waits is
    /// not begun, what is sent later is not taken. A player whose desk is dropped does the same by itself.
    pub fn end(&mut self, fade: u32) {
        self.standing.end(fade);
    }

    /// Whether the player has faded out after [`Desk::end`]. A player that is not asked for blocks never says so.
    pub fn is_over(&self) -> bool {
        self.standing.is_over()
    }

    /// The next report, if there is one.
    pub fn report(&mut self) -> Option<Report> {
        self.collect();
        self.reports.pop().ok()
    }

    /// Frees what is no longer played. Sending and hearing do, too.
    pub fn collect(&mut self) {
        while self.garbage.pop().is_ok() {}
    }

    /// Puts samples, at the full rate, into an input's ring; says how many there was room for. A ring that runs empty
    /// is silent.
    pub fn feed(&mut self, input: usize, samples: &[f32]) -> usize {
        let Some(ring) = self.feeds.get_mut(input) else { return 0 };
        samples.iter().take_while(|&&x| ring.push(x).is_ok()).count()
    }

    /// Makes an input's responses ready, on this thread: one of up to as many taps as the player was made for, per output.
    ///
    /// # Errors
    /// [`PlayerError::Size`] for another number of responses, longer ones, or a player without waveforms;
    /// [`PlayerError::Sample`] at the first that cannot be played.
    pub fn filters(&self, responses: &[Vec<f32>]) -> Result<Arc<PreparedFilters>, PlayerError> {
        let none = PlayerError::Size { what: "inputs for waveforms", expected: 1, found: 0 };
        Ok(Arc::new(self.plan.as_ref().ok_or(none)?.prepare(responses)?))
    }

    /// How responses are made ready, for use on other threads; none without waveforms.
    pub fn plan(&self) -> Option<&FilterPlan> {
        self.plan.as_ref()
    }

    /// Number of samples from an input to the outputs, besides the responses' own.
    pub fn wave_delay(&self) -> usize {
        self.wave_delay
    }

    /// Whether a drive has as many outputs as the player.
    pub fn fits(&self, drive: &Prepared) -> bool {
        drive.outputs() == self.outputs
    }

    /// First sample of the next block.
    pub fn clock(&self) -> u64 {
        self.meters.clock()
    }

    /// What is counted; may be shared with any thread.
    pub fn meters(&self) -> &Arc<Meters> {
        &self.meters
    }
}
