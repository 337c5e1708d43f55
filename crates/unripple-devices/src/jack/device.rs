//! A JACK server as a device.

use super::crossing::{Crossing, Shore};
use super::library::Client;
use super::options::JackOptions;
use super::watch::{Pace, Watch};
use super::wires::{OWN, wires};
use crate::DevicesError;
use std::sync::atomic::Ordering;
use std::thread::ThreadId;
use std::time::Duration;
use unripple_core::clock::Instant;
use unripple_core::{CHECK_INTERVAL, Device, DeviceError, Layout, Server, State, Status, Work, require};

/// Smallest number of frames for which the ring buffers have room, in case the server's period grows: four
/// periods of JACK's largest, 8192 frames.
const ROOM: usize = 32768;

/// Longest wait for a block before checking again: a server that is gone wakes nobody.
const NAP: Duration = Duration::from_millis(100);

/// A JACK server as a device. Its block size is the one requested, or the server's period at the time of
/// opening.
///
/// [`Work`] that is passed to [`Device::install_work`] is called in the server's own cycle, whatever the period is
/// at the moment. Otherwise blocks are exchanged by [`Device::exchange`] through a ring buffer in which
/// `lead` of them wait, or more if the period is longer than they are. The period need not be a multiple of
/// the block, nor the block a multiple of the period. If the period grows meanwhile, more blocks wait from
/// then on, and each of these counts as a lost block.
///
/// In real time the server's thread neither waits nor allocates: if drive is late, it plays silence, records
/// nothing, and counts the missed block. Missed blocks, those of a pause between exchanges included, are in
/// [`Status::lost`] as soon as the first block after them is recorded. Before a measurement let some blocks
/// of silence pass, and compare `lost` after them with `lost` at its end. A server that freewheels waits for
/// drive instead, two seconds at most.
///
/// ```no_run
/// use unripple_core::Device;
/// use unripple_devices::{Jack, JackOptions, Links};
///
/// let names = vec!["a1".to_owned(), "a2".to_owned()];
/// let options = JackOptions { outputs: names.clone(), inputs: names, ..Default::default() };
/// let mut device = Jack::open(&options)?;
/// let block = device.layout().block;
/// device.exchange(&vec![0.0; 2 * block], &mut vec![0.0; 2 * block])?;
/// # Ok::<(), unripple_devices::DevicesError>(())
/// ```
pub struct Jack {
    client: Client,
    shore: Shore,
    layout: Layout,
    lead: u64,
    patience: Duration,
    /// Blocks driven, blocks whose answer is still to come, and those of them that were not there in time and are to be discarded.
    driven: u64,
    under_way: u64,
    owed: u64,
    xruns: u64,
    /// The thread that was last registered as waiting for blocks, and whether the server has work to call.
    waiter: Option<ThreadId>,
    has_work: bool,
    watch: Watch,
    frames: Vec<f32>,
    status: Status,
}

impl std::fmt::Debug for Jack {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Jack")
            .field("layout", &self.layout)
            .field("status", &self.status)
            .finish_non_exhaustive()
    }
}

impl Jack {
    /// Joins a JACK server as a client, and connects the client's ports.
    ///
    /// # Errors
    /// [`DevicesError::Jack`] if there is no library or server, or it refuses a port or a connection; [`DevicesError::Channels`] for
    /// fewer ports than channels; [`DevicesError::Range`] for options out of range.
    pub fn open(options: &JackOptions) -> Result<Self, DevicesError> {
        let lead = options.lead as f64;
        require("blocks of lead", (1.0..=1000.0).contains(&lead), "1 to 1000", lead)?;
        let legal = (1e-3..=3600.0).contains(&options.patience);
        require("patience with a server in s", legal, "0.001 to 3600", options.patience)?;
        let scale = options.full_scale;
        require("full scale of the drive", scale > 0.0, "a positive number", scale)?;
        let mut client = Client::open(&options.client, options.server.as_deref())?;
        let wires = wires(&client, options)?;
        options.outputs.iter().try_for_each(|name| client.add(&format!("out_{name}"), false))?;
        options.inputs.iter().try_for_each(|name| client.add(&format!("in_{name}"), true))?;
        let (block, rate) = (options.block.unwrap_or_else(|| client.period()), client.rate());
        require("samples of a block", (1..=65_536).contains(&block), "1 to 65536", block as f64)?;
        let (outputs, inputs) = (options.outputs.len(), options.inputs.len());
        let room = ((options.lead + 2) * block).max(ROOM);
        let (crossing, shore) = Crossing::new(outputs, inputs, room, client.events.clone());
        client.start(Box::new(crossing))?;
        let own = client.name();
        for (from, to) in wires {
            client.connect(&from.replacen(OWN, &own, 1), &to.replacen(OWN, &own, 1))?;
        }
        let layout = Layout {
            device: "jack".into(),
            rate,
            block,
            outputs: options.outputs.clone(),
            inputs: options.inputs.clone(),
            full_scale: scale,
        };
        let (lead, patience) = (options.lead as u64, Duration::from_secs_f64(options.patience));
        client.events.settle(patience);
        if options.freewheel {
            client.freewheel()?;
            client.events.settle(patience);
        }
        let frames = Vec::with_capacity(block * (outputs.max(inputs) + 1));
        let server = Server { period: client.period(), priority: client.priority(), ..Server::default() };
        let status = Status { server: Some(server), ..Status::default() };
        let mut jack = Self {
            client,
            shore,
            layout,
            lead,
            patience,
            driven: 0,
            under_way: 0,
            owed: 0,
            xruns: 0,
            waiter: None,
            has_work: false,
            watch: Watch::new(0),
            frames,
            status,
        };
        jack.lead = jack.needed();
        jack.ask();
        Ok(jack)
    }

    /// Reads the latencies from the server.
    fn ask(&mut self) {
        if let Some(server) = &mut self.status.server
            && !self.client.closed()
        {
            [server.capture, server.playback] = self.client.latencies();
        }
    }

    /// Number of blocks that must be under way so that every cycle finds its drive: the number requested, or
    /// that of two cycles if it is larger. While one more is waited for, less than a block of answers is
    /// still here, so that all of these are ahead of the server: one cycle reads its drive, and the program
    /// has until the next to send more.
    fn needed(&self) -> u64 {
        let (block, period) = (self.layout.block, self.client.events.period.load(Ordering::Acquire));
        if period <= block { self.lead } else { self.lead.max((2 * period).div_ceil(block) as u64) }
    }

    /// Registers the calling thread as the one to wake when a block has passed.
    fn wait_here(&mut self) {
        let here = std::thread::current();
        if self.waiter != Some(here.id()) {
            while self.shore.gone.pop().is_ok() {}
            self.waiter = self.shore.waiters.push(here.clone()).is_ok().then(|| here.id());
        }
    }

    /// Number of cycles that came late since the last check; 0 if the server runs without a clock.
    fn late(&mut self) -> u64 {
        let xruns = self.client.events.xruns.load(Ordering::Relaxed);
        let late = xruns - std::mem::replace(&mut self.xruns, xruns);
        if self.client.events.freewheeling.load(Ordering::Acquire) { 0 } else { late }
    }

    fn push(&mut self, drive: &[f32]) -> Result<(), DeviceError> {
        let (block, width) = (self.layout.block, self.layout.outputs.len() + 1);
        self.frames.clear();
        self.frames.resize(block * width, 0.0);
        for (output, plane) in drive.chunks_exact(block).enumerate() {
            let slots = self.frames.iter_mut().skip(output).step_by(width);
            slots.zip(plane).for_each(|(to, x)| *to = *x);
        }
        let Ok(mut chunk) = self.shore.drive.write_chunk(block * width) else {
            return Err(self.stall("the server takes no drive".into()));
        };
        let (first, second) = chunk.as_mut_slices();
        let (a, b) = self.frames.split_at(first.len());
        first.copy_from_slice(a);
        second.copy_from_slice(b);
        chunk.commit_all();
        Ok(())
    }

    /// Waits for one recorded block and reads it; `false` if none can come before more drive is sent.
    fn pop(&mut self, heard: &mut [f32]) -> Result<bool, DeviceError> {
        let (block, inputs) = (self.layout.block, self.layout.inputs.len());
        let wanted = block * (inputs + 1);
        let start = Instant::now();
        let cycles = self.client.events.cycles.load(Ordering::Acquire);
        self.wait_here();
        while self.shore.heard.slots() < wanted {
            if self.client.events.gone.load(Ordering::Acquire) {
                let why = "the server shut down".to_owned();
                self.status.state = State::Lost(why.clone());
                return Err(DeviceError::Lost { device: self.layout.device.clone(), why });
            }
            if self.under_way < self.needed() {
                return Ok(false);
            }
            let left = self.patience.saturating_sub(start.elapsed());
            if left.is_zero() {
                let passed = self.client.events.cycles.load(Ordering::Acquire) - cycles;
                let time = self.patience.as_secs_f64();
                let why = match passed {
                    0 => format!("no cycle for {time} s"),
                    _ => format!("{passed} cycles in {time} s, none of them ours"),
                };
                return Err(self.stall(why));
            }
            std::thread::park_timeout(left.min(NAP));
        }
        let Ok(chunk) = self.shore.heard.read_chunk(wanted) else { return Ok(false) };
        let (first, second) = chunk.as_slices();
        for (input, plane) in heard.chunks_exact_mut(block).enumerate() {
            let samples = first.iter().chain(second).skip(input).step_by(inputs + 1);
            plane.iter_mut().zip(samples).for_each(|(to, x)| *to = *x);
        }
        let missed: f32 = first.iter().chain(second).skip(inputs).step_by(inputs + 1).sum();
        chunk.commit_all();
        self.status.lost += missed as u64;
        self.under_way -= 1;
        Ok(true)
    }

    /// The next block that is not discarded; silence while more drive has to be sent first.
    fn hear(&mut self, heard: &mut [f32]) -> Result<(), DeviceError> {
        if self.under_way <= self.lead {
            heard.fill(0.0);
            return Ok(());
        }
        match self.pop(heard) {
            Ok(true) => Ok(()),
            Ok(false) => {
                // The period has grown: all later blocks come later by one.
                self.lead += 1;
                self.status.lost += 1;
                heard.fill(0.0);
                Ok(())
            }
            Err(error) => {
                self.owed += 1;
                Err(error)
            }
        }
    }

    fn stall(&mut self, why: String) -> DeviceError {
        self.status.state = State::Stalled(why.clone());
        DeviceError::Stalled { device: self.layout.device.clone(), why }
    }
}

impl Device for Jack {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn status(&self) -> Status {
        let mut status = self.status.clone();
        let events = &self.client.events;
        if events.gone.load(Ordering::Acquire) {
            status.state = State::Lost("the server shut down".into());
        }
        if let Some(server) = &mut status.server {
            let period = events.period.load(Ordering::Acquire);
            server.period = if period > 0 { period } else { server.period };
            server.late = events.xruns.load(Ordering::Relaxed);
            server.skipped = events.skipped.load(Ordering::Relaxed);
            server.own_late = events.own_late.load(Ordering::Relaxed);
        }
        status.waiting = if self.has_work { 0 } else { self.lead * self.layout.block as u64 };
        status
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        self.layout.fits(drive.len(), heard.len())?;
        // Answers that came too late once are discarded, so that latency does not change.
        while self.owed > 0 && self.pop(heard)? {
            self.owed -= 1;
        }
        self.push(drive)?;
        (self.driven, self.under_way) = (self.driven + 1, self.under_way + 1);
        self.hear(heard)?;
        let late = self.late();
        // Cycles that were late before the first block do not count as lost.
        self.status.lost += if self.driven > 1 { late } else { 0 };
        self.status.blocks += 1;
        self.status.state = State::Running;
        Ok(())
    }

    fn install_work(&mut self, work: Box<dyn Work>) -> Result<(), Box<dyn Work>> {
        self.shore.removing.store(false, Ordering::Release);
        self.shore.hired.push(work).map_err(|rtrb::PushError::Full(work)| work)?;
        self.has_work = true;
        self.late();
        self.watch = Watch::new(self.client.events.cycles.load(Ordering::Acquire));
        Ok(())
    }

    fn remove_work(&mut self) -> Option<Box<dyn Work>> {
        if !std::mem::take(&mut self.has_work) {
            return None;
        }
        self.shore.removing.store(true, Ordering::Release);
        // A server that was seen to stand still before is not waited for again.
        let last = self.watch.last(self.client.events.cycles.load(Ordering::Acquire));
        while self.shore.fired.is_empty() && last.elapsed() < self.patience {
            if self.client.events.gone.load(Ordering::Acquire) {
                break;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        if self.shore.fired.is_empty() {
            // A server that calls no more does not give back either; closing does, unless the server stands still.
            self.client.close();
            self.client.events.gone.store(true, Ordering::Release);
        }
        self.shore.fired.pop().ok()
    }

    fn check(&mut self) -> Result<Duration, DeviceError> {
        if self.client.events.gone.load(Ordering::Acquire) {
            let (device, why) = (self.layout.device.clone(), "the server shut down".to_owned());
            return Err(DeviceError::Lost { device, why });
        }
        let cycles = self.client.events.cycles.load(Ordering::Acquire);
        self.status.lost += self.late();
        match self.watch.look(cycles, self.patience, || self.client.frame()) {
            Pace::Passed(more) => {
                self.status.blocks += more;
                self.status.state = State::Running;
            }
            Pace::Waiting => {}
            Pace::Stands(since) => {
                self.status.state = State::Stalled(format!("no cycle for {:.0} s", since.as_secs_f64()));
            }
            Pace::LeftOut(since) => {
                let (device, time) = (self.layout.device.clone(), since.as_secs_f64());
                let why = format!("the server goes on, but has not called for {time:.0} s");
                self.status.state = State::Lost(why.clone());
                return Err(DeviceError::Lost { device, why });
            }
        }
        self.ask();
        Ok(CHECK_INTERVAL)
    }
}

impl Drop for Jack {
    fn drop(&mut self) {
        self.shore.closing.store(true, Ordering::Release);
    }
}
