//! Detection of clicks in emitted samples, for tests.

use crate::PreparedDrive;

/// Detector of clicks: counts steps in the emitted samples that no drive contains by itself.
///
/// Each drive that starts is announced. From one sample to the next an output may change by at most the sum, over all
/// drives that sound, of the drive's largest step (those from and to zero at its ends included) and its peak over the
/// length of a block, the most that a fade changes it by.
///
/// ```
/// use unripple_player::{Clicks, PreparedDrive};
///
/// let mut clicks = Clicks::new(1, 4);
/// clicks.expect(&PreparedDrive::new(1, vec![0.5, 1.0])?, 1.0, 1);
/// assert_eq!(clicks.hear(0, &[0.0, 0.5, 1.0, 0.0]), 0);
/// assert_eq!(clicks.hear(4, &[0.0, 0.0, 0.5, 0.5]), 1);
/// # Ok::<(), unripple_player::PlayerError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Clicks {
    block: usize,
    last: Vec<f32>,
    expected: Vec<Expected>,
}

#[derive(Clone, Debug)]
struct Expected {
    start: u64,
    end: u64,
    steps: Vec<f32>,
}

impl Clicks {
    /// A detector for `outputs` outputs, in blocks of `block` samples.
    pub fn new(outputs: usize, block: usize) -> Self {
        Self { block, last: vec![0.0; outputs], expected: Vec::new() }
    }

    /// Announces a drive that starts at sample `start` of the player's clock, multiplied by `gain`, so that
    /// its steps are not counted as clicks.
    pub fn expect(&mut self, drive: &PreparedDrive, gain: f32, start: u64) {
        let steps = (0..drive.outputs()).map(|output| {
            let channel = drive.channel(output);
            let ends =
                channel.first().into_iter().chain(channel.last()).fold(0.0, |m, x| f32::max(m, x.abs()));
            let inside = channel.windows(2).fold(ends, |m, pair| m.max((pair[1] - pair[0]).abs()));
            let peak = channel.iter().fold(0.0, |m, x| f32::max(m, x.abs()));
            gain.abs() * (inside + peak / self.block as f32)
        });
        let steps = steps.collect();
        self.expected.push(Expected { start, end: start + drive.samples() as u64, steps });
    }

    /// Takes in an emitted planar block (outputs x samples) that begins at sample `clock`; returns the number of steps
    /// that are larger than the announced drives allow.
    pub fn hear(&mut self, clock: u64, emitted: &[f32]) -> usize {
        self.expected.retain(|held| held.end >= clock);
        let mut clicks = 0;
        for (output, (last, channel)) in
            self.last.iter_mut().zip(emitted.chunks_exact(self.block)).enumerate()
        {
            for (sample, &x) in (clock..).zip(channel) {
                let on = self.expected.iter().filter(|held| held.start <= sample && sample <= held.end);
                let allowed: f32 = on.filter_map(|held| held.steps.get(output)).sum();
                clicks += usize::from((x - *last).abs() > allowed * (1.0 + 1e-4) + 1e-9);
                *last = x;
            }
        }
        clicks
    }
}
