//! Samples passed between the server's thread and the program, through ring buffers without locks.

use super::events::Events;
use super::library::{Cycle, Process};
use rtrb::{Consumer, Producer, RingBuffer};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::Thread;
use std::time::{Duration, Instant};
use unripple_core::Work;

/// How long a freewheeling server waits for drive before it goes on without. Much longer, and a program that ended
/// without closing would hold the server; much shorter, and a busy machine loses blocks.
const FREEWHEEL_PATIENCE: Duration = Duration::from_secs(2);

/// Pieces of work, and threads to be woken, that may be on their way between the program and the server's thread; one
/// of each is usual.
const HANDED: usize = 8;

/// The end of the rings in the server's thread.
///
/// Either the thread does work that it was given, or samples cross frame by frame: a frame of drive is one sample of every output
/// and one 0; a recorded frame is one sample of every input and, in the first frame of a cycle, the number of cycles missed
/// before it. A cycle either takes and gives all its frames, or none: so drive and the inputs that answer it stay in
/// step whatever is missed.
pub(super) struct Crossing {
    outputs: usize,
    inputs: usize,
    drive: Consumer<f32>,
    heard: Producer<f32>,
    events: Arc<Events>,
    closing: Arc<AtomicBool>,
    /// Whether nobody drives: not yet, or not any more.
    idle: bool,
    started: bool,
    missed: u32,
    work: Option<Box<dyn Work>>,
    hired: Consumer<Box<dyn Work>>,
    fired: Producer<Box<dyn Work>>,
    dismissing: Arc<AtomicBool>,
    /// Who waits for blocks, and those who did before.
    waiter: Option<Thread>,
    waiters: Consumer<Thread>,
    gone: Producer<Thread>,
    /// The server's count of samples at which the next cycle begins, if none is left out.
    due: Option<u32>,
}

/// The end of the rings in the program.
pub(super) struct Shore {
    pub(super) drive: Producer<f32>,
    pub(super) heard: Consumer<f32>,
    pub(super) closing: Arc<AtomicBool>,
    pub(super) hired: Producer<Box<dyn Work>>,
    pub(super) fired: Consumer<Box<dyn Work>>,
    pub(super) dismissing: Arc<AtomicBool>,
    pub(super) waiters: Producer<Thread>,
    pub(super) gone: Consumer<Thread>,
}

impl Crossing {
    /// Both ends of two rings of `frames` frames.
    pub(super) fn new(outputs: usize, inputs: usize, frames: usize, events: Arc<Events>) -> (Self, Shore) {
        let (push, take) = RingBuffer::new(frames * (outputs + 1));
        let (give, pop) = RingBuffer::new(frames * (inputs + 1));
        let (hire, hired) = RingBuffer::new(HANDED);
        let (fire, fired) = RingBuffer::new(HANDED);
        let (wait, waiters) = RingBuffer::new(HANDED);
        let (leave, left) = RingBuffer::new(HANDED);
        let closing = Arc::new(AtomicBool::new(false));
        let dismissing = Arc::new(AtomicBool::new(false));
        let shore = Shore {
            drive: push,
            heard: pop,
            closing: closing.clone(),
            hired: hire,
            fired,
            dismissing: dismissing.clone(),
            waiters: wait,
            gone: left,
        };
        let crossing = Self {
            outputs,
            inputs,
            drive: take,
            heard: give,
            events,
            closing,
            idle: true,
            started: false,
            missed: 0,
            work: None,
            hired,
            fired: fire,
            dismissing,
            waiter: None,
            waiters,
            gone: leave,
            due: None,
        };
        (crossing, shore)
    }

    fn ready(&self, frames: usize) -> bool {
        self.drive.slots() >= frames * (self.outputs + 1) && self.heard.slots() >= frames * (self.inputs + 1)
    }

    /// Whether a cycle of `frames` frames can pass; while the server freewheels, drive is waited for.
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

    /// Counts what the server left out since the last cycle.
    fn count(&mut self, cycle: &Cycle) {
        let Some((frame, _)) = cycle.time() else { return };
        let skipped = self.due.map_or(0, |due| frame.wrapping_sub(due));
        // Half of all counts and more are a server that has begun to count anew.
        if skipped < u32::MAX / 2 && !self.events.freewheeling.load(Ordering::Acquire) {
            self.events.skipped.fetch_add(u64::from(skipped), Ordering::Relaxed);
        }
        self.due = Some(frame.wrapping_add(cycle.frames() as u32));
    }

    /// Takes over threads and work from the program, and hands back those that it asks for.
    fn hand_over(&mut self) {
        while let Ok(waiter) = self.waiters.pop() {
            if let Some(before) = self.waiter.replace(waiter) {
                // The program empties this ring before it fills the other, so there is room.
                let _ = self.gone.push(before);
            }
        }
        if let Ok(work) = self.hired.pop() {
            self.work = Some(work);
        }
        if self.dismissing.load(Ordering::Acquire) {
            self.dismiss();
        }
    }

    /// One cycle of work, or of samples that cross.
    fn serve(&mut self, cycle: &mut Cycle) {
        if let Some(work) = &mut self.work {
            return work.cycle(cycle);
        }
        if self.wait(cycle.frames()) && self.pass(cycle).is_some() {
            (self.started, self.missed) = (true, 0);
        } else {
            self.missed = self.missed.saturating_add(u32::from(self.started));
            (0..self.outputs).for_each(|output| cycle.output(output).fill(0.0));
        }
        if let Some(waiter) = &self.waiter {
            waiter.unpark();
        }
    }

    fn dismiss(&mut self) {
        if let Some(work) = self.work.take() {
            // One piece of work is out at a time, so there is room.
            let _ = self.fired.push(work);
        }
    }
}

impl Process for Crossing {
    fn cycle(&mut self, cycle: &mut Cycle) {
        self.events.period.store(cycle.frames(), Ordering::Release);
        let next = cycle.next();
        self.count(cycle);
        self.hand_over();
        self.serve(cycle);
        if next.is_some_and(|next| cycle.now() > next) && !self.events.freewheeling.load(Ordering::Acquire) {
            self.events.own_late.fetch_add(1, Ordering::Relaxed);
        }
    }
}

impl unripple_core::Cycle for Cycle<'_> {
    fn frames(&self) -> usize {
        self.frames()
    }

    fn began(&self) -> Instant {
        self.time().map_or_else(Instant::now, |(_, began)| began)
    }

    fn drive(&mut self, output: usize) -> &mut [f32] {
        self.output(output)
    }

    fn heard(&self, input: usize) -> &[f32] {
        self.input(input)
    }
}

/// A closed client makes no more calls: work that it was given is handed back.
impl Drop for Crossing {
    fn drop(&mut self) {
        while let Ok(work) = self.hired.pop() {
            self.work = Some(work);
        }
        self.dismiss();
    }
}
