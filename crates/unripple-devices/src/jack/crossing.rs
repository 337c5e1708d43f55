use super::events::Events;
use super::library::{Cycle, Process};
use rtrb::{Consumer, Producer, RingBuffer};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// How long a freewheeling server waits for drive before it goes on without.
const FREEWHEEL_PATIENCE: Duration = Duration::from_secs(2);

/// The side of the rings that the server's thread has.
///
/// Samples cross frame by frame: a frame of drive is one sample of every output and one 0; a frame of what is heard is one
/// sample of every input and, in the first frame of a cycle, the number of cycles missed before it. A cycle either takes and
/// gives all its frames, or none: so drive and what is heard of it stay in step whatever is missed.
pub(super) struct Crossing {
    outputs: usize,
    inputs: usize,
    drive: Consumer<f32>,
    heard: Producer<f32>,
    events: Arc<Events>,
    closing: Arc<AtomicBool>,
    /// Nobody drives: not yet, or not any more.
    idle: bool,
    started: bool,
    missed: u32,
}

/// The side of the rings that the program has.
pub(super) struct Shore {
    pub(super) drive: Producer<f32>,
    pub(super) heard: Consumer<f32>,
    pub(super) closing: Arc<AtomicBool>,
}

impl Crossing {
    /// Both sides of two rings of so many frames.
    pub(super) fn new(outputs: usize, inputs: usize, frames: usize, events: Arc<Events>) -> (Self, Shore) {
        let (push, take) = RingBuffer::new(frames * (outputs + 1));
        let (give, pop) = RingBuffer::new(frames * (inputs + 1));
        let closing = Arc::new(AtomicBool::new(false));
        let shore = Shore { drive: push, heard: pop, closing: closing.clone() };
        let (idle, started) = (true, false);
        (Self { outputs, inputs, drive: take, heard: give, events, closing, idle, started, missed: 0 }, shore)
    }

    fn ready(&self, frames: usize) -> bool {
        self.drive.slots() >= frames * (self.outputs + 1) && self.heard.slots() >= frames * (self.inputs + 1)
    }

    /// Whether a cycle of so many frames can pass; without a clock, drive is waited for.
    fn wait(&mut self, frames: usize) -> bool {
        if self.ready(frames) {
            self.idle = false;
            return true;
        }
        let waits = |events: &Events, closing: &AtomicBool| {
            events.freewheeling.load(Ordering::Acquire) && !closing.load(Ordering::Acquire)
        };
        if self.idle || !waits(&self.events, &self.closing) {
            return false;
        }
        let start = Instant::now();
        while waits(&self.events, &self.closing) && start.elapsed() < FREEWHEEL_PATIENCE {
            if self.ready(frames) {
                return true;
            }
            std::thread::sleep(Duration::from_micros(20));
        }
        self.idle = true;
        false
    }

    /// Moves one cycle's frames; `None` if the rings do not hold them after all.
    fn pass(&mut self, cycle: &mut Cycle) -> Option<()> {
        let (frames, sent, given) = (cycle.frames(), self.outputs + 1, self.inputs + 1);
        let drive = self.drive.read_chunk(frames * sent).ok()?;
        let mut heard = self.heard.write_chunk(frames * given).ok()?;
        let (first, second) = drive.as_slices();
        for output in 0..self.outputs {
            let samples = first.iter().chain(second).skip(output).step_by(sent);
            cycle.output(output).iter_mut().zip(samples).for_each(|(to, x)| *to = *x);
        }
        let (first, second) = heard.as_mut_slices();
        for input in 0..self.inputs {
            let slots = first.iter_mut().chain(second.iter_mut()).skip(input).step_by(given);
            slots.zip(cycle.input(input)).for_each(|(to, x)| *to = *x);
        }
        if let Some(slot) = first.iter_mut().chain(second.iter_mut()).nth(self.inputs) {
            *slot = self.missed as f32;
        }
        drive.commit_all();
        heard.commit_all();
        Some(())
    }
}

impl Process for Crossing {
    fn cycle(&mut self, cycle: &mut Cycle) {
        if self.wait(cycle.frames()) && self.pass(cycle).is_some() {
            (self.started, self.missed) = (true, 0);
            return;
        }
        self.missed = self.missed.saturating_add(u32::from(self.started));
        (0..self.outputs).for_each(|output| cycle.output(output).fill(0.0));
    }
}
