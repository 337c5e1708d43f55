//! Samples passed between the server's thread and the program, through ring buffers without locks.

use super::events::Events;
use super::library::{Cycle, Process};
use rtrb::{Consumer, Producer, RingBuffer};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::Thread;
use std::time::Duration;
use unripple_core::Work;
use unripple_core::clock::Instant;

/// How long a freewheeling server waits for drive before it continues without. If much longer, a program
/// that ended without closing would block the server; if much shorter, a busy machine would lose blocks.
const FREEWHEEL_PATIENCE: Duration = Duration::from_secs(2);

/// Largest number of work objects, and of threads to be woken, in transit between the program and the
/// server's thread; one of each is usual.
const HANDED: usize = 8;

/// The end of the ring buffers in the server's thread.
///
/// Either the thread runs a [`Work`] object, or samples are passed frame by frame: a frame of drive is one
/// sample of every output and one 0; a recorded frame is one sample of every input and, in the first frame
/// of a cycle, the number of cycles missed before it. A cycle passes either all its frames or none, so that
/// drive and the inputs that answer it stay in step even if cycles are missed.
pub(super) struct Crossing {
    outputs: usize,
    inputs: usize,
    drive: Consumer<f32>,
    heard: Producer<f32>,
    events: Arc<Events>,
    closing: Arc<AtomicBool>,
    /// Whether no drive is sent: not yet, or no longer.
    idle: bool,
    started: bool,
    missed: u32,
    work: Option<Box<dyn Work>>,
    hired: Consumer<Box<dyn Work>>,
    fired: Producer<Box<dyn Work>>,
    removing: Arc<AtomicBool>,
    /// The thread that waits for blocks, and those that waited before.
    waiter: Option<Thread>,
    waiters: Consumer<Thread>,
    gone: Producer<Thread>,
    /// The server's sample count at which the next cycle begins, if none is left out.
    due: Option<u32>,
}

/// The end of the ring buffers in the program.
pub(super) struct Shore {
    pub(super) drive: Producer<f32>,
    pub(super) heard: Consumer<f32>,
    pub(super) closing: Arc<AtomicBool>,
    pub(super) hired: Producer<Box<dyn Work>>,
    pub(super) fired: Consumer<Box<dyn Work>>,
    pub(super) removing: Arc<AtomicBool>,
    pub(super) waiters: Producer<Thread>,
    pub(super) gone: Consumer<Thread>,
}

impl Crossing {
    /// Both ends of the ring buffers, with room for `frames` frames each way.
    pub(super) fn new(outputs: usize, inputs: usize, frames: usize, events: Arc<Events>) -> (Self, Shore) {
        let (push, take) = RingBuffer::new(frames * (outputs + 1));
        let (give, pop) = RingBuffer::new(frames * (inputs + 1));
        let (hire, hired) = RingBuffer::new(HANDED);
        let (fire, fired) = RingBuffer::new(HANDED);
        let (wait, waiters) = RingBuffer::new(HANDED);
        let (leave, left) = RingBuffer::new(HANDED);
        let closing = Arc::new(AtomicBool::new(false));
        let removing = Arc::new(AtomicBool::new(false));
        let shore = Shore {
            drive: push,
            heard: pop,
            closing: closing.clone(),
            hired: hire,
            fired,
            removing: removing.clone(),
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
            removing,
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

    /// Passes one cycle's frames; `None` if the ring buffers do not have them or no room for them.
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

    /// Counts the samples that the server left out since the last cycle.
    fn count(&mut self, cycle: &Cycle) {
        let Some((frame, _)) = cycle.time() else { return };
        let skipped = self.due.map_or(0, |due| frame.wrapping_sub(due));
        // Half of all counts and more are a server that has begun to count anew.
        if skipped < u32::MAX / 2 && !self.events.freewheeling.load(Ordering::Acquire) {
            self.events.skipped.fetch_add(u64::from(skipped), Ordering::Relaxed);
        }
        self.due = Some(frame.wrapping_add(cycle.frames() as u32));
    }

    /// Receives threads and work from the program, and hands back those that it requests.
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
        if self.removing.load(Ordering::Acquire) {
            self.remove_work();
        }
    }

    /// Processes one cycle: runs the work, or passes samples.
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

    fn remove_work(&mut self) {
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

/// A closed client is not called any more: its work is handed back.
impl Drop for Crossing {
    fn drop(&mut self) {
        while let Ok(work) = self.hired.pop() {
            self.work = Some(work);
        }
        self.remove_work();
    }
}
