//! A player and a desk that are run by turns, and drives to play on them.

#![allow(dead_code)]

use std::sync::Arc;
use unripple_player::{At, Command, Desk, Hold, Options, Player, PreparedDrive, Report, Voice, player};

/// A player and its desk in one thread, with all reports and holds so far.
pub struct Rig {
    pub options: Options,
    pub player: Player,
    pub desk: Desk,
    /// All reports so far.
    pub reports: Vec<Report>,
    /// Holds of all that was begun, by name.
    pub holds: Vec<(Voice, Hold)>,
}

impl Rig {
    pub fn new(options: Options) -> Self {
        let (player, desk) = player(&options).unwrap();
        Self { options, player, desk, reports: Vec::new(), holds: Vec::new() }
    }

    pub fn send(&mut self, command: Command) {
        assert!(self.offer(command));
    }

    /// Sends a command; whether there was room.
    pub fn offer(&mut self, command: Command) -> bool {
        let begins = matches!(command, Command::Start { .. } | Command::Wave { .. });
        match command.voice().filter(|_| begins) {
            Some(voice) => self.desk.hold(command).map(|hold| self.holds.push((voice, hold))).is_ok(),
            None => self.desk.send(command).is_ok(),
        }
    }

    /// Ends all that was begun under a name.
    pub fn stop(&mut self, voice: Voice, at: At, fade: Option<u32>) {
        let held = self.holds.iter().filter(|(held, hold)| *held == voice && !hold.is_stopped());
        held.for_each(|(_, hold)| hold.stop(at, fade));
    }

    pub fn start(&mut self, voice: u64, drive: &Arc<PreparedDrive>, sample: u64) {
        self.send(start(voice, drive, sample));
    }

    /// Plays one block, planar.
    pub fn block(&mut self) -> Vec<f32> {
        let mut out = vec![f32::NAN; self.options.outputs * self.options.block];
        self.player.process(&mut out);
        self.reports.extend(std::iter::from_fn(|| self.desk.report()));
        out
    }

    /// Plays some blocks; the samples of each output.
    pub fn play(&mut self, blocks: usize) -> Vec<Vec<f32>> {
        let mut channels = vec![Vec::new(); self.options.outputs];
        for _ in 0..blocks {
            let out = self.block();
            let parts = out.chunks_exact(self.options.block);
            channels.iter_mut().zip(parts).for_each(|(channel, part)| channel.extend_from_slice(part));
        }
        channels
    }
}

/// A drive played once, at full gain.
pub fn start(voice: u64, drive: &Arc<PreparedDrive>, sample: u64) -> Command {
    let (voice, drive) = (Voice(voice), drive.clone());
    Command::Start { voice, drive, at: At::Sample(sample), gain: 1.0, period: None }
}

/// Numbers between -1 and 1 that look random.
pub fn noise(seed: u64, count: usize) -> Vec<f32> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1u64 << 23) as f32 - 1.0
    };
    (0..count).map(|_| next()).collect()
}

/// A drive of noise with this peak.
pub fn rough(seed: u64, outputs: usize, samples: usize, peak: f32) -> Arc<PreparedDrive> {
    let data: Vec<f32> = noise(seed, outputs * samples).iter().map(|x| x * peak).collect();
    Arc::new(PreparedDrive::new(outputs, data).unwrap())
}

/// A drive that rises from nothing and falls back to it, of a few oscillations.
pub fn smooth(seed: u64, outputs: usize, samples: usize, peak: f32) -> Arc<PreparedDrive> {
    let turns = noise(seed, outputs * 2);
    let channel = |output: usize| {
        let (speed, phase) = (0.05 + 0.2 * turns[2 * output].abs(), 6.0 * turns[2 * output + 1]);
        (0..samples).map(move |i| {
            let along = (i as f32 + 1.0) / (samples as f32 + 1.0);
            peak * (std::f32::consts::PI * along).sin().powi(2) * (speed * i as f32 + phase).sin()
        })
    };
    Arc::new(PreparedDrive::new(outputs, (0..outputs).flat_map(channel).collect()).unwrap())
}
