//! A test instrument that hears clicks: steps that no drive has by itself.

use crate::Prepared;

/// Hears steps of what was emitted that no drive has by itself.
///
/// Each drive that starts is announced; from one sample to the next, an output may move by no more than the sum of the
/// largest steps of all that sounds (that from and to silence among them), and of each fade's share, its peak over a block.
///
/// ```
/// use unripple_player::{Clicks, Prepared};
///
/// let mut clicks = Clicks::new(1, 4);
/// clicks.expect(&Prepared::new(1, vec![0.5, 1.0])?, 1.0, 1);
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
    /// A listener for so many outputs, in blocks of so many samples.
    pub fn new(outputs: usize, block: usize) -> Self {
        Self { block, last: vec![0.0; outputs], expected: Vec::new() }
    }

    /// Announces a drive that starts at a sample of the clock with this gain.
    pub fn expect(&mut self, drive: &Prepared, gain: f32, start: u64) {
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

    /// Hears a planar block (outputs x samples) that begins at sample `clock`; returns the number of steps
    /// that are larger than what is announced allows.
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
