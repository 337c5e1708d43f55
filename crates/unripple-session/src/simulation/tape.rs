//! The drive of the last second.

/// The latest drive: all samples of every actuator, as ratios to the drive limit.
#[derive(Clone, Debug)]
pub struct Tape {
    outputs: usize,
    most: usize,
    /// Samples ever kept.
    count: u64,
    samples: Vec<f32>,
}

impl Tape {
    /// Storage for the newest `most` samples of each of `outputs` actuators, at first zero.
    pub fn new(outputs: usize, most: usize) -> Self {
        Self { outputs, most: most.max(1), count: 0, samples: vec![0.0; outputs * most.max(1)] }
    }

    /// Stores a block of drive, `[output][sample]` one after the other, divided by `limit`.
    pub fn keep(&mut self, planes: &[f32], limit: f32) {
        if self.outputs == 0 {
            return;
        }
        let block = planes.len() / self.outputs;
        for i in 0..block {
            let slot = ((self.count + i as u64) % self.most as u64) as usize * self.outputs;
            for output in 0..self.outputs {
                self.samples[slot + output] = planes[output * block + i] / limit;
            }
        }
        self.count += block as u64;
    }

    /// Drive of all outputs at a sample, as ratios to the limit; `None` if that sample is not stored.
    pub fn at(&self, sample: u64) -> Option<&[f32]> {
        if sample >= self.count || self.count - sample > self.most as u64 {
            return None;
        }
        let slot = (sample % self.most as u64) as usize * self.outputs;
        Some(&self.samples[slot..slot + self.outputs])
    }

    /// Largest magnitude and rms of every output over the newest `samples` samples, as ratios to the limit.
    pub fn newest(&self, samples: usize) -> (Vec<f32>, Vec<f32>) {
        let (mut peaks, mut squares) = (vec![0.0f32; self.outputs], vec![0.0f32; self.outputs]);
        let first = self.count.saturating_sub(samples.min(self.most) as u64);
        for sample in first..self.count {
            let Some(now) = self.at(sample) else { continue };
            for ((peak, square), x) in peaks.iter_mut().zip(&mut squares).zip(now) {
                *peak = peak.max(x.abs());
                *square += x * x;
            }
        }
        let taken = (self.count - first).max(1) as f32;
        (peaks, squares.iter().map(|square| (square / taken).sqrt()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_samples_are_known() {
        let mut tape = Tape::new(2, 100);
        for block in 0..40 {
            let planes: Vec<f32> = (0..2)
                .flat_map(|output| (0..7).map(move |i| (output * 1000 + block * 7 + i) as f32))
                .collect();
            tape.keep(&planes, 2.0);
        }
        assert_eq!(tape.at(279), Some(&[139.5, 639.5][..]));
        assert_eq!(tape.at(180), Some(&[90.0, 590.0][..]));
        assert_eq!((tape.at(179), tape.at(280)), (None, None));
        assert_eq!(tape.newest(3).0, [139.5, 639.5]);
    }
}
