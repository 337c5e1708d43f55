//! A sound card as a device.

use super::crossing::{Events, crossing};
use super::ferry::{Ferry, Manners};
use super::found::name;
use super::side::Side;
use super::streams::{self, Running};
use crate::DevicesError;
use crate::error::same;
use cpal::traits::StreamTrait;
use std::sync::Arc;
use std::time::Duration;
use unripple_core::{Device, DeviceError, Layout, Status, require};

/// Smallest number of frames for which the ring buffers have room, since the card may process many at once:
/// more than a second at usual rates.
const ROOM: usize = 65_536;

/// Smallest lead of the drive, in periods of the card. Two are in the card's buffer, and two more pass until
/// samples recorded with them arrive; with fewer, a card whose periods are longer than blocks would be late
/// each time.
const PERIODS: usize = 4;

/// Options for opening a sound card.
#[derive(Clone, Debug, PartialEq)]
pub struct CardOptions {
    /// Identifier of the device that plays, from [`found`](super::found); the system's default device if
    /// `None`.
    pub playback: Option<String>,
    /// Identifier of the device that records; that of the device that plays if `None`. Both must belong to
    /// one card, since two cards have different clocks.
    pub capture: Option<String>,
    /// Names of the outputs (actuators), which are assigned to the card's first output channels in order.
    pub outputs: Vec<String>,
    /// Names of the inputs (sensors, probe), which are assigned to the card's first input channels in order.
    pub inputs: Vec<String>,
    /// Samples per second.
    pub rate: f64,
    /// Samples per block.
    pub block: usize,
    /// Drive, in the actuators' unit, to which a sample of 1 (full scale) corresponds.
    pub full_scale: f64,
    /// Number of blocks of drive that are buffered ahead of the card; more are buffered if these are shorter
    /// than four periods of the card. The program may be late by the time that they last, and all latencies
    /// are longer by it.
    pub lead: usize,
    /// Time, in s, after which the card counts as stalled if playback or recording has made no progress.
    pub patience: f64,
    /// Whether a card counts as lost after an underrun or overrun, or if playback and recording do not stay
    /// in step: its latency has changed then, which matters for measurements. If false, playing continues,
    /// and the side that is behind continues where the other is.
    pub strict: bool,
}

impl Default for CardOptions {
    fn default() -> Self {
        Self {
            playback: None,
            capture: None,
            outputs: Vec::new(),
            inputs: Vec::new(),
            rate: 48e3,
            block: 256,
            full_scale: 1.0,
            lead: 4,
            patience: 3.0,
            strict: true,
        }
    }
}

/// A sound card as a device, which plays and records at the same time.
///
/// The card's threads neither wait nor allocate: if drive is late, silence is played, and samples that the
/// program does not read are dropped. Missed blocks, those of a pause between exchanges included, are in
/// [`Status::lost`] as soon as the first block after them is recorded, and the latency after them is the
/// same as before. Both sides have to run on one clock: if their counts differ by more than their buffers
/// explain, a strict card is lost, and the error says so. Before a measurement let some blocks of silence
/// pass, and compare `lost` after them with `lost` at its end.
///
/// ```no_run
/// use unripple_core::Device;
/// use unripple_devices::cards::{Card, CardOptions};
///
/// let names = vec!["a1".to_owned(), "a2".to_owned()];
/// let options = CardOptions { outputs: names.clone(), inputs: names, ..Default::default() };
/// let mut device = Card::open(&options)?;
/// let block = device.layout().block;
/// device.exchange(&vec![0.0; 2 * block], &mut vec![0.0; 2 * block])?;
/// # Ok::<(), unripple_devices::DevicesError>(())
/// ```
pub struct Card {
    ferry: Ferry,
}

impl std::fmt::Debug for Card {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let (layout, status) = (self.ferry.layout(), self.ferry.status());
        f.debug_struct("Card").field("layout", layout).field("status", &status).finish_non_exhaustive()
    }
}

/// Number of blocks by which the drive is ahead: the number requested, or that needed by a card with some
/// period (frames) if it is larger and the ring buffers have room.
pub(super) fn blocks_ahead(asked: usize, block: usize, period: usize, room: usize) -> usize {
    let needed = (PERIODS * period).div_ceil(block);
    needed.min((room / block).saturating_sub(2)).max(asked)
}

impl Card {
    /// Opens a card, which plays silence until blocks are exchanged.
    ///
    /// # Errors
    /// [`DevicesError::Card`] if there is none by that name, or it refuses the rate or the format of
    /// samples; [`DevicesError::Channels`] if it has fewer channels than requested; [`DevicesError::Range`]
    /// and [`DevicesError::Size`] for options out of range.
    pub fn open(options: &CardOptions) -> Result<Self, DevicesError> {
        let (block, lead) = (options.block as f64, options.lead as f64);
        require("samples of a block", (1.0..=65_536.0).contains(&block), "1 to 65536", block)?;
        require("blocks of lead", (1.0..=1000.0).contains(&lead), "1 to 1000", lead)?;
        let legal = (1e-3..=3600.0).contains(&options.patience);
        require("patience with a card in s", legal, "0.001 to 3600", options.patience)?;
        let (scale, rate) = (options.full_scale, options.rate);
        require("full scale of the drive", scale > 0.0, "a positive number", scale)?;
        let whole = rate.fract() == 0.0 && (1.0..=1e6).contains(&rate);
        require("samples per second of a card", whole, "a whole number, 1 to 1000000", rate)?;
        same("outputs of a card", options.outputs.len().min(1), 1)?;

        let events = Arc::new(Events::default());
        let room = ((options.lead + 2) * options.block).max(ROOM);
        let (outputs, inputs) = (options.outputs.len(), options.inputs.len());
        let (player, recorder, shore) = crossing(outputs, inputs, room, &events);
        let playback = streams::find(options.playback.as_deref(), Side::Playback)?;
        let play = streams::config(&playback, Side::Playback, outputs, rate as u32, options.block)?;
        let name = name(&playback);
        let mut opened = Vec::new();
        if inputs > 0 {
            let named = options.capture.as_deref().or(options.playback.as_deref());
            let capture = streams::find(named, Side::Capture)?;
            let hear = streams::config(&capture, Side::Capture, inputs, rate as u32, options.block)?;
            opened.push(streams::capture(&capture, hear, recorder, &events)?);
        }
        opened.push(streams::playback(&playback, play, player, &events)?);
        for stream in &opened {
            stream.play().map_err(|error| streams::refused(&name, &error))?;
        }
        let running = Running { streams: opened, events: events.clone() };
        let lead = blocks_ahead(options.lead, options.block, running.period(), room) as u64;
        let layout = Layout {
            device: name,
            rate,
            block: options.block,
            outputs: options.outputs.clone(),
            inputs: options.inputs.clone(),
            full_scale: scale,
        };
        let patience = Duration::from_secs_f64(options.patience);
        let manners = Manners { lead, patience, strict: options.strict };
        Ok(Self { ferry: Ferry::new(layout, (shore, events), Box::new(running), manners) })
    }
}

impl Device for Card {
    fn layout(&self) -> &Layout {
        self.ferry.layout()
    }

    fn status(&self) -> Status {
        self.ferry.status()
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        self.ferry.exchange(drive, heard)
    }
}
