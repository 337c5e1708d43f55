//! A drive in the form in which the audio thread plays it.

use crate::PlayerError;
use crate::error::{count, playable, same};
use unripple_core::Drive;

/// A drive in the form in which the audio thread plays it: planar float32 samples, all of them finite.
///
/// ```
/// use unripple_player::PreparedDrive;
///
/// let drive = PreparedDrive::new(2, vec![0.0, 0.5, 0.0, 0.0, -0.5, 0.0])?;
/// assert_eq!((drive.outputs(), drive.samples()), (2, 3));
/// assert_eq!(drive.channel(1), [0.0, -0.5, 0.0]);
/// # Ok::<(), unripple_player::PlayerError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PreparedDrive {
    outputs: usize,
    samples: usize,
    data: Vec<f32>,
    every: Option<usize>,
}

impl PreparedDrive {
    /// A drive from planar samples, output after output, in the actuators' unit.
    ///
    /// # Errors
    /// [`PlayerError::Range`] without outputs or samples, [`PlayerError::Size`] if the samples do not divide evenly
    /// among the outputs, [`PlayerError::Sample`] at the first sample that is not finite or too large.
    pub fn new(outputs: usize, data: Vec<f32>) -> Result<Self, PlayerError> {
        count("outputs of a drive", outputs, 1, usize::MAX)?;
        let samples = data.len() / outputs;
        count("samples of a drive", samples, 1, usize::MAX)?;
        same("samples of all outputs of a drive", data.len(), outputs * samples)?;
        playable("drive", &data, samples)?;
        Ok(Self { outputs, samples, data, every: None })
    }

    /// A drive from a [`Drive`], with its samples rounded to float32 as devices emit them.
    ///
    /// # Errors
    /// As [`PreparedDrive::new`].
    pub fn from_drive(drive: &Drive) -> Result<Self, PlayerError> {
        let data = drive.channels().iter().flatten().map(|&x| x as f32).collect();
        Self::new(drive.channels().len(), data)
    }

    /// A loop: `data` is one pass (planar, as for [`PreparedDrive::new`]), repeated without a gap. At its start it fades in
    /// over `fade` samples, taken from the end of the pass; passes then overlap by as many samples, so that a loop may
    /// change its drive or gain from one pass to the next. The overlapping parts add up to the pass exactly.
    ///
    /// # Errors
    /// As [`PreparedDrive::new`], and [`PlayerError::Range`] for a fade of no sample or one longer than the pass.
    pub fn looped(outputs: usize, data: Vec<f32>, fade: usize) -> Result<Self, PlayerError> {
        let pass = Self::new(outputs, data)?;
        let length = pass.samples;
        count("samples of a loop's fade", fade, 1, length)?;
        let mut data = Vec::with_capacity(outputs * (length + fade));
        for channel in (0..outputs).map(|output| pass.channel(output)) {
            let rising = |i: usize| (i + 1) as f32 / (fade + 1) as f32;
            let parts = |i: usize| split(channel[length - fade + i], rising(i));
            data.extend((0..fade).map(|i| parts(i).0));
            data.extend_from_slice(&channel[..length - fade]);
            data.extend((0..fade).map(|i| parts(i).1));
        }
        Ok(Self { outputs, samples: length + fade, data, every: Some(length) })
    }

    /// Number of channels, one per output.
    pub fn outputs(&self) -> usize {
        self.outputs
    }

    /// Number of samples in each channel; for a loop, those of one pass and one fade.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// For a loop, the number of samples from one pass to the next; otherwise `None`.
    pub fn every(&self) -> Option<usize> {
        self.every
    }

    /// Largest sum of the positive parts, or of the negative parts, of overlapping copies of an output's channel that
    /// start every `period` samples, in the output's unit. A comb (a drive that is started again every `period` samples) with a gain of
    /// at most the output's peak limit divided by this sum is not scaled down by that limit, as long as nothing else sounds. Starts are
    /// rounded to a sample, so this
    /// is the larger of the values for floor(`period`) and floor(`period`) + 1 samples; for a `period` below 1 or not a
    /// number it is the drive's own peak.
    pub fn comb_peak(&self, output: usize, period: f64) -> f32 {
        let channel = self.channel(output);
        let short = if period >= 1.0 { period.floor() as usize } else { channel.len().max(1) };
        let folded = |every: usize, sign: f32| {
            let sum =
                |first: usize| channel.iter().skip(first).step_by(every).map(|x| (sign * x).max(0.0)).sum();
            (0..every.min(channel.len())).map(sum).fold(0.0, f32::max)
        };
        [short, short + 1]
            .into_iter()
            .flat_map(|every| [folded(every, 1.0), folded(every, -1.0)])
            .fold(0.0, f32::max)
    }

    /// The samples of an output, by its index; empty if there is no such output.
    pub fn channel(&self, output: usize) -> &[f32] {
        self.data.get(output * self.samples..(output + 1) * self.samples).unwrap_or(&[])
    }
}

/// Two parts of a sample, in the ratio of `share` and the rest, whose float32 sum is the sample: the larger part is
/// rounded, the smaller is their difference, which is exact (Sterbenz's lemma).
fn split(x: f32, share: f32) -> (f32, f32) {
    if share >= 0.5 {
        let first = x * share;
        (first, x - first)
    } else {
        let second = x * (1.0 - share);
        (x - second, second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_cannot_be_played() {
        assert!(PreparedDrive::new(0, vec![]).is_err());
        assert!(PreparedDrive::new(2, vec![]).is_err());
        assert!(PreparedDrive::new(2, vec![0.0; 5]).is_err());
        let error = PreparedDrive::new(2, vec![0.0, 0.0, 0.0, f32::NAN]).unwrap_err();
        assert!(error.to_string().contains("sample 1 of channel 1"), "{error}");
        assert!(PreparedDrive::looped(1, vec![0.0; 4], 5).is_err());
    }

    #[test]
    fn copies_of_a_comb_add_to_its_peak() {
        let drive = PreparedDrive::new(1, vec![0.5, -1.0, 0.25, 0.5, -0.5, 0.0]).unwrap();
        assert_eq!(drive.comb_peak(0, 3.0), 1.5);
        assert_eq!(drive.comb_peak(0, 100.0), 1.0);
        assert_eq!(drive.comb_peak(0, f64::NAN), 1.0);
        assert_eq!(drive.comb_peak(1, 3.0), 0.0);
    }

    #[test]
    fn passes_of_a_loop_add_to_it_exactly() {
        let pass: Vec<f32> = (0..97).map(|i| (i as f32 * 0.71).sin() + 1e-3).collect();
        for fade in [1, 2, 31, 97] {
            let drive = PreparedDrive::looped(1, pass.clone(), fade).unwrap();
            let mut sum = vec![0.0f32; fade + 4 * 97];
            for start in (0..4).map(|k| k * 97) {
                sum[start..].iter_mut().zip(drive.channel(0)).for_each(|(a, b)| *a += b);
            }
            let body = &sum[fade..3 * 97];
            assert!(body.iter().enumerate().all(|(i, &x)| x == pass[i % 97]), "fade {fade}");
        }
    }
}
