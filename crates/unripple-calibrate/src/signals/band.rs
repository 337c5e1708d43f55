//! A frequency band with raised-cosine edges.

use super::transform::Transform;
use std::f64::consts::FRAC_PI_2;
use unripple_core::OutOfRange;
use unripple_dsp::DspError;

/// A band of frequencies with soft edges: weight 0 below `low[0]` and above `high[1]`, 1 between `low[1]`
/// and `high[0]`, and squared sines in the edges. All in Hz.
///
/// The softer an edge, the shorter it rings: about the inverse of its width in Hz, before and after an impulse, since
/// a band is applied as a zero-phase filter.
///
/// ```
/// use unripple_calibrate::signals::Band;
///
/// let band = Band::within(30.0, 3600.0);
/// assert_eq!([band.weight(30.0), band.weight(1000.0), band.weight(3600.0)], [0.0, 1.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Start and end of the lower edge, in Hz.
    pub low: [f64; 2],
    /// Start and end of the upper edge, in Hz.
    pub high: [f64; 2],
}

impl Band {
    /// The band of all frequencies.
    pub const ALL: Self = Self { low: [0.0; 2], high: [f64::INFINITY; 2] };

    /// The band from `low` to `high` (Hz), edges included: the lower edge is a bit more than half an octave
    /// wide, the upper one a quarter of an octave.
    pub fn within(low: f64, high: f64) -> Self {
        Self { low: [low, 1.5 * low], high: [high / 1.2, high] }
    }

    /// Factor of the band on amplitudes at a frequency (Hz), from 0 to 1.
    pub fn weight(&self, hz: f64) -> f64 {
        let rise = |[from, to]: [f64; 2]| (FRAC_PI_2 * (hz - from) / (to - from)).sin().powi(2);
        if hz < self.low[0] || hz > self.high[1] {
            0.0
        } else if hz < self.low[1] {
            rise(self.low)
        } else if hz <= self.high[0] {
            1.0
        } else {
            1.0 - rise(self.high)
        }
    }

    /// Limits a signal, zero beyond both its ends, to the band by a zero-phase filter. `rate` is in samples per
    /// second.
    ///
    /// # Errors
    /// [`DspError::Range`] if the edges do not ascend or `rate` is not positive.
    pub fn limit(&self, signal: &mut [f64], rate: f64) -> Result<(), DspError> {
        self.check()?;
        super::positive("samples per second", rate)?;
        if signal.is_empty() {
            return Ok(());
        }
        let plan = Transform::smooth(2 * signal.len());
        let mut work = plan.work();
        plan.forward(signal, &mut work);
        let scale = 1.0 / plan.size() as f64;
        for (line, value) in work.lines.iter_mut().enumerate() {
            *value *= scale * self.weight(plan.hz(line, rate));
        }
        plan.inverse(&mut work);
        signal.iter_mut().zip(&work.signal).for_each(|(to, from)| *to = *from);
        Ok(())
    }

    /// Checks that the edges ascend.
    ///
    /// # Errors
    /// [`DspError::Range`] if the edges do not ascend.
    pub(crate) fn check(&self) -> Result<(), DspError> {
        let edges = [0.0, self.low[0], self.low[1], self.high[0], self.high[1]];
        match edges.windows(2).find(|pair| pair[0].is_nan() || pair[1].is_nan() || pair[1] < pair[0]) {
            None => Ok(()),
            Some(pair) => Err(DspError::Range(OutOfRange::new(
                "edge of a band in Hz",
                format!("at least the edge before it, {}", pair[0]),
                pair[1],
            ))),
        }
    }
}
