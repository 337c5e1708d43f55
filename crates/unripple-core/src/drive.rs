//! The drive: the input signals of the actuators, one channel of samples per actuator.

use crate::CoreError;
use crate::OutOfRange;

/// A drive: the input signals of all actuators, actuators x samples, each channel in its actuator's own unit (N, A or V).
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    rate: f64,
    names: Vec<String>,
    channels: Vec<Vec<f64>>,
}

impl Drive {
    /// A drive from named channels of equal length (actuators x samples, each in its actuator's unit) at
    /// `rate` samples per second.
    ///
    /// # Errors
    /// [`CoreError::Size`] if the number of names is not that of channels or if channels differ in length,
    /// [`CoreError::NotFinite`] at the first sample that is not finite, [`CoreError::Range`] if the rate is not positive.
    pub fn new(rate: f64, names: Vec<String>, channels: Vec<Vec<f64>>) -> Result<Self, CoreError> {
        if !(rate.is_finite() && rate > 0.0) {
            return Err(CoreError::Range(OutOfRange::new("sample rate", "a positive number", rate)));
        }
        if names.len() != channels.len() {
            return Err(CoreError::Size {
                what: "channel names",
                expected: channels.len(),
                found: names.len(),
            });
        }
        let samples = channels.first().map_or(0, Vec::len);
        for (channel, name) in channels.iter().zip(&names) {
            if channel.len() != samples {
                return Err(CoreError::Size {
                    what: "samples in a channel",
                    expected: samples,
                    found: channel.len(),
                });
            }
            if let Some(sample) = channel.iter().position(|x| !x.is_finite()) {
                return Err(CoreError::NotFinite {
                    what: "drive",
                    channel: name.clone(),
                    sample,
                    found: channel[sample],
                });
            }
        }
        Ok(Self { rate, names, channels })
    }

    /// Sample rate, in samples per second.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Names of the actuators, in channel order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The channels in actuator order: actuators x samples, in each actuator's own unit (N, A or V).
    pub fn channels(&self) -> &[Vec<f64>] {
        &self.channels
    }

    /// Number of samples in each channel.
    pub fn samples(&self) -> usize {
        self.channels.first().map_or(0, Vec::len)
    }

    /// Length of the drive in seconds.
    pub fn duration(&self) -> f64 {
        self.samples() as f64 / self.rate
    }

    /// Largest magnitude over all channels and samples, in the drive's unit.
    pub fn peak(&self) -> f64 {
        self.channels.iter().flatten().fold(0.0, |m, x| f64::max(m, x.abs()))
    }

    /// Root mean square over all channels and samples, in the drive's unit.
    pub fn rms(&self) -> f64 {
        let count = (self.samples() * self.channels.len()).max(1) as f64;
        (self.channels.iter().flatten().map(|x| x * x).sum::<f64>() / count).sqrt()
    }

    /// Energy of the drive, Σ∫d²dt over all channels, in the drive's unit squared times seconds.
    pub fn energy(&self) -> f64 {
        self.channels.iter().flatten().map(|x| x * x).sum::<f64>() / self.rate
    }

    /// The same drive with every sample times `factor`, a dimensionless number.
    pub fn scaled(mut self, factor: f64) -> Self {
        self.channels.iter_mut().flatten().for_each(|x| *x *= factor);
        self
    }

    /// The same drive with every sample rounded to float32, as a sound device or a WAV file takes it.
    pub fn as_emitted(mut self) -> Self {
        self.channels.iter_mut().flatten().for_each(|x| *x = f64::from(*x as f32));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_does_not_fit() {
        let names = |n: usize| (0..n).map(|i| format!("a{i}")).collect::<Vec<_>>();
        assert!(Drive::new(0.0, names(1), vec![vec![0.0]]).is_err());
        assert!(Drive::new(1.0, names(2), vec![vec![0.0]]).is_err());
        assert!(Drive::new(1.0, names(2), vec![vec![0.0], vec![]]).is_err());
        let bad = Drive::new(1.0, names(1), vec![vec![0.0, f64::NAN]]).unwrap_err();
        assert!(bad.to_string().contains("sample 1 of channel `a0`"), "{bad}");
    }

    #[test]
    fn energy_of_a_square_pulse() {
        let drive = Drive::new(10.0, vec!["a".into()], vec![vec![2.0; 5]]).unwrap();
        assert_eq!((drive.energy(), drive.rms(), drive.peak()), (2.0, 2.0, 2.0));
    }
}
