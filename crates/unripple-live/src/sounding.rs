use unripple_core::Point;
use unripple_effects::{Level, Wave};
use unripple_player::{At, Command, Desk};

/// What goes on sounding under a voice until it is stopped.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Sounding {
    /// A repeated focus, and the samples from each to the next.
    Comb { place: Point, level: Level, period: f64 },
    /// A waveform through an input, under a name of its own for the player.
    Wave { input: usize, id: u64, place: Point, wave: Wave, level: Level },
}

impl Sounding {
    /// The same elsewhere.
    pub fn moved(mut self, to: Point) -> Self {
        let (Self::Comb { place, .. } | Self::Wave { place, .. }) = &mut self;
        *place = to;
        self
    }

    /// The same, as strong as this.
    pub fn at_level(mut self, to: Level) -> Self {
        let (Self::Comb { level, .. } | Self::Wave { level, .. }) = &mut self;
        *level = to;
        self
    }
}

/// The player's inputs for waveforms, and who has them.
///
/// An input that was used still points at a place; before the next voice has it, it is pointed nowhere, so that what rises from
/// silence does rise from silence.
#[derive(Clone, Debug)]
pub(crate) struct Inputs {
    slots: Vec<Slot>,
    outputs: usize,
    block: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Slot {
    Free,
    Taken(u64),
    /// Silent from a sample on; whether it is pointed nowhere by then.
    Fading {
        until: u64,
        cleared: bool,
    },
}

impl Inputs {
    pub fn new(count: usize, outputs: usize, block: usize) -> Self {
        Self { slots: vec![Slot::Free; count], outputs, block }
    }

    /// An input for a voice, if one is free.
    pub fn take(&mut self, voice: u64) -> Option<usize> {
        let input = self.slots.iter().position(|slot| *slot == Slot::Free)?;
        self.slots[input] = Slot::Taken(voice);
        Some(input)
    }

    /// Gives an input back that is silent from a sample on.
    pub fn give(&mut self, input: usize, silent: u64, desk: &mut Desk) {
        if let Some(slot) = self.slots.get_mut(input) {
            *slot = Slot::Fading { until: silent, cleared: false };
        }
        self.free(0, desk);
    }

    /// Frees what has become silent by now.
    pub fn free(&mut self, now: u64, desk: &mut Desk) {
        let block = self.block as u64;
        for (input, slot) in self.slots.iter_mut().enumerate() {
            *slot = match *slot {
                Slot::Fading { until, cleared: false } if now >= until + block => {
                    let silence = vec![vec![0.0f32]; self.outputs];
                    let Ok(filters) = desk.filters(&silence) else { continue };
                    let fade = block as u32;
                    let sent = desk.send(Command::SetFilters { input, filters, at: At::Now, fade });
                    Slot::Fading { until: now + 2 * block, cleared: sent.is_ok() }
                }
                Slot::Fading { until, cleared: true } if now >= until => Slot::Free,
                other => other,
            };
        }
    }
}
