//! A measurement signal of known spectrum.

use super::transform::Transform;
use super::{Band, positive};
use unripple_core::OutOfRange;
use unripple_dsp::DspError;

/// A signal that is played, or a force that was recorded: samples whose spectrum is known.
///
/// ```
/// use unripple_calibrate::signals::Stimulus;
///
/// let tap = Stimulus::new(vec![0.0, 0.4, 1.0, 0.4, 0.0], 48e3)?;
/// let [low, high] = tap.usable_band(15.0); // 1 + 0.8 cos ω falls to 0.32 at 19.8 kHz
/// assert!(low == 0.0 && (high - 19.8e3).abs() < 100.0);
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Stimulus {
    pub(super) samples: Vec<f64>,
    pub(super) rate: f64,
    pub(super) band: Band,
    pub(super) periodic: bool,
}

impl Stimulus {
    /// A stimulus of finite length, in the unit of the drive. Its band contains all frequencies;
    /// [`Stimulus::in_band`] restricts it.
    ///
    /// # Errors
    /// [`DspError::Range`] if `rate` is not positive, or a sample is not finite; [`DspError::Size`] without samples.
    pub fn new(samples: Vec<f64>, rate: f64) -> Result<Self, DspError> {
        positive("samples per second", rate)?;
        if samples.is_empty() {
            return Err(DspError::Size { what: "samples of a stimulus", expected: 1, found: 0 });
        }
        if let Some(found) = samples.iter().copied().find(|x| !x.is_finite()) {
            return Err(DspError::Range(OutOfRange::new("sample of a stimulus", "finite", found)));
        }
        Ok(Self { samples, rate, band: Band::ALL, periodic: false })
    }

    /// This stimulus as one period of a periodic signal, so that the recording is periodic too once the
    /// surface is in the steady state.
    pub fn repeated(self) -> Self {
        Self { periodic: true, ..self }
    }

    /// This stimulus with `band` as the band in which it has enough power for measuring.
    ///
    /// # Errors
    /// [`DspError::Range`] if the band's edges do not ascend.
    pub fn in_band(self, band: Band) -> Result<Self, DspError> {
        band.check()?;
        Ok(Self { band, ..self })
    }

    /// Samples of the stimulus; if it is periodic, those of one period.
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }

    /// Samples per second.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// The band in which the stimulus has enough power for measuring.
    pub fn band(&self) -> Band {
        self.band
    }

    /// Whether the stimulus is periodic, with its samples as one period.
    pub fn is_periodic(&self) -> bool {
        self.periodic
    }

    /// Energy of the stimulus: the sum of squares of the samples divided by the rate, in the drive's unit
    /// squared times seconds.
    pub fn energy(&self) -> f64 {
        self.samples.iter().map(|x| x * x).sum::<f64>() / self.rate
    }

    /// Lowest and highest frequency (Hz) of the range around the spectrum's maximum in which the spectrum is
    /// nowhere more than `db` decibels below it: for a tap, the band in which it has power.
    pub fn usable_band(&self, db: f64) -> [f64; 2] {
        let plan = Transform::smooth(self.samples.len().max(1024));
        let mut work = plan.work();
        plan.forward(&self.samples, &mut work);
        let powers: Vec<f64> = work.lines.iter().map(|x| x.norm_sqr()).collect();
        let (top, most) = powers
            .iter()
            .copied()
            .enumerate()
            .fold((0, 0.0), |best, (line, power)| if power > best.1 { (line, power) } else { best });
        let floor = most * 10f64.powf(-db / 10.0);
        let low = (0..=top).rev().take_while(|&line| powers[line] >= floor).last().unwrap_or(top);
        let high = (top..powers.len()).take_while(|&line| powers[line] >= floor).last().unwrap_or(top);
        [plan.hz(low, self.rate), plan.hz(high, self.rate)]
    }
}
