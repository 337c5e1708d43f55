//! Runs the player in blocks of the player's length, and gives the device as many samples as each of its
//! cycles requests.

use crate::{Percentiles, Timeline};
use assert_no_alloc::assert_no_alloc;
use rtrb::Producer;
use std::sync::Arc;
use std::thread::Thread;
use unripple_core::clock::Instant;
use unripple_core::{Cycle, Work};
use unripple_player::{Meters, Player};

/// Fraction of a cycle's duration above which the processor time of the player is too high to be safe.
const HEAVY: f32 = 0.7;

/// A player whose blocks are cut to what a device asks for. What is left of a block waits for the next cycle, so a command waits
/// for a block's length at most before it is played, and not at all where the cycle is a multiple of the block.
pub(crate) struct Beats {
    player: Player,
    meters: Arc<Meters>,
    timeline: Arc<Timeline>,
    rate: f64,
    /// Drive, in the actuators' unit, of a sample of 1 of the device.
    scale: f32,
    block: usize,
    /// The last block of the player, and how many samples at its end have not been given to the device yet.
    ready: Vec<f32>,
    left: usize,
    work: Percentiles,
    heavy: u64,
    /// Thread that is woken when the sample of [`Timeline::wake_at`] has been computed.
    bell: Option<Thread>,
    overheard: Option<Overheard>,
}

/// Blocks of drive and inputs, for the follower of tension.
pub(crate) struct Overheard {
    blocks: Producer<f32>,
    /// One block, channel after channel: drive in the actuators' unit, then inputs.
    planes: Vec<f32>,
    channels: [usize; 2],
    block: usize,
    at: usize,
}

impl Overheard {
    /// A queue for blocks of `block` samples of `channels` outputs and inputs. A block that finds no room is lost to
    /// the follower only.
    pub fn new(blocks: Producer<f32>, channels: [usize; 2], block: usize) -> Self {
        let planes = vec![0.0; channels.iter().sum::<usize>() * block];
        Self { blocks, planes, channels, block, at: 0 }
    }

    /// Queues a block of drive and inputs, channel after channel.
    pub fn put(&mut self, drive: &[f32], heard: &[f32]) {
        if self.blocks.slots() >= drive.len() + heard.len() {
            drive.iter().chain(heard).for_each(|x| self.blocks.push(*x).unwrap_or(()));
        }
    }

    fn take(&mut self, cycle: &mut dyn Cycle, scale: f32) {
        let ([outputs, inputs], block) = (self.channels, self.block);
        let mut from = 0;
        while from < cycle.frames() {
            let count = (block - self.at).min(cycle.frames() - from);
            for channel in 0..outputs + inputs {
                let to = &mut self.planes[channel * block + self.at..][..count];
                let (samples, factor) = match channel < outputs {
                    true => (&*cycle.drive(channel), scale),
                    false => (cycle.heard(channel - outputs), 1.0),
                };
                to.iter_mut().zip(samples.iter().skip(from)).for_each(|(to, x)| *to = factor * x);
            }
            (self.at, from) = (self.at + count, from + count);
            if self.at == block {
                self.at = 0;
                if self.blocks.slots() >= self.planes.len() {
                    self.planes.iter().for_each(|x| self.blocks.push(*x).unwrap_or(()));
                }
            }
        }
    }
}

impl Beats {
    /// A player with blocks of `block` samples, for a device of `rate` samples per second in which a sample of 1 is a
    /// drive of `scale`.
    pub fn new(
        player: Player,
        (block, outputs): (usize, usize),
        (rate, scale): (f64, f32),
        timeline: Arc<Timeline>,
    ) -> Self {
        let meters = player.meters().clone();
        Self {
            player,
            meters,
            timeline,
            rate,
            scale,
            block,
            ready: vec![0.0; block * outputs],
            left: 0,
            work: Percentiles::default(),
            heavy: 0,
            bell: None,
            overheard: None,
        }
    }

    /// Sets the thread to be woken and the queue to the follower of tension.
    pub fn tell(&mut self, bell: Option<Thread>, overheard: Option<Overheard>) {
        (self.bell, self.overheard) = (bell, overheard);
    }

    /// Removes and returns the queue to the follower of tension.
    pub fn take_overheard(&mut self) -> Option<Overheard> {
        self.overheard.take()
    }

    /// Index, on the player's clock, of the first sample that has not been passed to the device yet.
    pub fn position(&self) -> u64 {
        self.player.clock() - self.left as u64
    }

    /// Computes the next `frames` samples of every output, in the actuators' unit. `put` gets the index of an output,
    /// the index of the first sample, and the samples.
    pub fn fill(&mut self, frames: usize, mut put: impl FnMut(usize, usize, &[f32])) {
        let before = thread_time();
        let mut at = 0;
        while at < frames {
            if self.left == 0 {
                assert_no_alloc(|| self.player.process(&mut self.ready));
                self.left = self.block;
            }
            let (count, from) = (self.left.min(frames - at), self.block - self.left);
            for (output, plane) in self.ready.chunks_exact(self.block).enumerate() {
                put(output, at, &plane[from..from + count]);
            }
            (self.left, at) = (self.left - count, at + count);
        }
        let taken = thread_time() - before;
        self.work.add(taken);
        let load = (taken * self.rate / frames.max(1) as f64) as f32;
        self.meters.set_load(load);
        self.heavy += u64::from(load > HEAVY);
    }

    /// Records that the `frames` samples from `first` on begin to leave the device at the time `leaves`, and
    /// wakes the thread that waits for them, if there is one.
    pub fn mark(&mut self, first: u64, leaves: Instant, frames: usize) {
        let next = self.player.clock();
        self.timeline.mark(first, leaves, frames, next);
        if self.timeline.rings(next)
            && let Some(bell) = &self.bell
        {
            bell.unpark();
        }
    }

    /// Processor time, in s, that the player took in each cycle.
    pub fn work(&self) -> &Percentiles {
        &self.work
    }

    /// Number of cycles in which the player's processor time exceeded 70 % of the cycle's duration.
    pub fn heavy(&self) -> u64 {
        self.heavy
    }
}

impl Work for Beats {
    fn cycle(&mut self, cycle: &mut dyn Cycle) {
        let (first, frames, scale) = (self.position(), cycle.frames(), self.scale);
        self.fill(frames, |output, at, samples| {
            let to = cycle.drive(output).iter_mut().skip(at);
            to.zip(samples).for_each(|(to, x)| *to = x / scale);
        });
        if let Some(overheard) = &mut self.overheard {
            overheard.take(cycle, scale);
        }
        self.mark(first, cycle.began(), frames);
    }
}

/// Processor time of this thread, in s: what other threads take of the processor meanwhile is not the player's load.
#[cfg(unix)]
fn thread_time() -> f64 {
    use rustix::time::{ClockId, clock_gettime};
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// Time since the first call, in s, on systems without that clock: there, what interrupts this thread counts as well.
#[cfg(not(unix))]
fn thread_time() -> f64 {
    use std::sync::OnceLock;
    static FIRST: OnceLock<Instant> = OnceLock::new();
    FIRST.get_or_init(Instant::now).elapsed().as_secs_f64()
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_player::{At, Command, Desk, Options, PreparedDrive, Voice, player};

    const BLOCK: usize = 64;

    /// A cycle of one output.
    struct Buffers(Vec<f32>, Instant);

    impl Cycle for Buffers {
        fn frames(&self) -> usize {
            self.0.len()
        }
        fn began(&self) -> Instant {
            self.1
        }
        fn drive(&mut self, _: usize) -> &mut [f32] {
            &mut self.0
        }
        fn heard(&self, _: usize) -> &[f32] {
            &[]
        }
    }

    fn beats() -> (Beats, Desk, Arc<Timeline>) {
        let options = Options { outputs: 1, block: BLOCK, ..Options::default() };
        let (player, desk) = player(&options).unwrap();
        let timeline = Arc::new(Timeline::new(48e3));
        (Beats::new(player, (BLOCK, 1), (48e3, 1.0), timeline.clone()), desk, timeline)
    }

    fn cycle(beats: &mut Beats, frames: usize) -> Vec<f32> {
        let mut cycle = Buffers(vec![0.0; frames], Instant::now());
        beats.cycle(&mut cycle);
        cycle.0
    }

    fn start(desk: &mut Desk, samples: Vec<f32>, at: At) {
        let drive = Arc::new(PreparedDrive::new(1, samples).unwrap());
        let start = Command::Start { voice: Voice(1), drive, at, gain: 1.0, period: None };
        assert!(desk.send(start).is_ok());
    }

    #[test]
    fn any_cycles_get_the_same_samples() {
        let drive: Vec<f32> = (1..=3000).map(|i| i as f32 / 3001.0).collect();
        let cycles = [256, 1024, 441, 1, 63, 64, 65, 8, 2048, 256];
        let (mut beats, mut desk, _) = beats();
        start(&mut desk, drive.clone(), At::Sample(100));
        let played: Vec<f32> = cycles.iter().flat_map(|frames| cycle(&mut beats, *frames)).collect();
        assert_eq!(played[..100], [0.0; 100]);
        assert_eq!(played[100..3100], drive);
        assert!(played[3100..].iter().all(|x| *x == 0.0));
        assert_eq!(beats.position(), played.len() as u64);
    }

    #[test]
    fn a_command_waits_for_less_than_a_block_and_not_at_all_in_whole_ones() {
        for (period, most) in [(64, 0), (256, 0), (1024, 0), (2048, 0), (441, BLOCK - 1), (1000, BLOCK - 1)] {
            let (mut beats, mut desk, _) = beats();
            for _ in 0..50 {
                cycle(&mut beats, period);
                start(&mut desk, vec![0.5], At::Now);
                let heard = cycle(&mut beats, period);
                let first = heard.iter().position(|x| *x != 0.0).unwrap();
                assert!(first <= most, "{period}: sample {first} of the next cycle");
            }
        }
    }

    #[test]
    fn samples_are_timed_by_when_they_leave() {
        let (mut beats, _, timeline) = beats();
        let start = Instant::now();
        let mut given = 0;
        for frames in [256usize, 441, 64, 1000] {
            let began = start + std::time::Duration::from_secs_f64(given as f64 / 48e3);
            beats.cycle(&mut Buffers(vec![0.0; frames], began));
            for sample in [0.0, frames as f64 - 1.0] {
                let at = began + std::time::Duration::from_secs_f64(sample / 48e3);
                let found = timeline.at(at) * 48e3;
                assert!((found - given as f64 - sample).abs() < 0.01, "{found}: {given} and {sample}");
            }
            given += frames;
        }
    }
}
