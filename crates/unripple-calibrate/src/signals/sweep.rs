//! The exponential sine sweep (Farina 2000), optionally synchronized (Novak et al. 2015).

use super::{Band, Stimulus, positive};
use std::f64::consts::{PI, TAU};
use unripple_core::OutOfRange;
use unripple_dsp::DspError;

/// An exponential sine sweep: its frequency rises by equal factors in equal times, so that the m-th harmonic
/// of the sweep is the sweep itself, earlier by a time that depends on m alone ([`Sweep::lead`]).
///
/// Source: A. Farina, AES Convention 108, paper 5093 (2000); the synchronized form: A. Novak, P. Lotton, L. Simon,
/// "Synchronized swept-sine", J. Audio Eng. Soc. 63 (2015), eq. 47-49.
///
/// ```
/// use unripple_calibrate::signals::Sweep;
///
/// let sweep = Sweep { seconds: 0.5, ..Sweep::default() };
/// let stimulus = sweep.stimulus()?;
/// assert!((stimulus.samples().len() as f64 / 48e3 - sweep.sounding() - sweep.silence).abs() < 1e-4);
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// Samples per second.
    pub rate: f64,
    /// First frequency of the sweep, in Hz.
    pub from: f64,
    /// Last frequency of the sweep, in Hz, below half the rate.
    pub to: f64,
    /// Duration of the sweep, in s. A synchronized sweep has the nearest possible duration: see
    /// [`Sweep::sounding`].
    pub seconds: f64,
    /// Amplitude of the sweep, in the unit of the drive.
    pub amplitude: f64,
    /// Duration of the fade-in, in s.
    pub fade_in: f64,
    /// Duration of the fade-out, in s.
    pub fade_out: f64,
    /// Duration of the silence after the sweep, in s.
    pub silence: f64,
    /// Whether the phase is chosen so that harmonics equal the sweep itself, phase included (Novak);
    /// otherwise it begins with 0 (Farina).
    pub synchronized: bool,
}

impl Default for Sweep {
    /// 30 to 3600 Hz in 1 s at 48 kHz, synchronized, amplitude 1, fades of 30 and 2 ms, no silence.
    fn default() -> Self {
        Self {
            rate: 48e3,
            from: 30.0,
            to: 3600.0,
            seconds: 1.0,
            amplitude: 1.0,
            fade_in: 0.03,
            fade_out: 0.002,
            silence: 0.0,
            synchronized: true,
        }
    }
}

impl Sweep {
    /// Time, in s, in which the frequency rises by a factor e: L of Novak's eq. 47 and 49.
    pub fn growth(&self) -> f64 {
        let growth = self.seconds / (self.to / self.from).ln();
        if self.synchronized { (self.from * growth).round().max(1.0) / self.from } else { growth }
    }

    /// Duration of the sweep without silence, in s. A synchronized one rounds its [growth](Sweep::growth) to whole
    /// periods of its lowest frequency, and so differs a little from `seconds`.
    pub fn sounding(&self) -> f64 {
        self.growth() * (self.to / self.from).ln()
    }

    /// Time, in s, by which the response of the harmonic of `order` precedes the linear response; 0 for
    /// order 1, the linear response.
    pub fn lead(&self, order: usize) -> f64 {
        self.growth() * (order.max(1) as f64).ln()
    }

    /// The samples of the sweep, silence included, and its band, as a stimulus.
    ///
    /// # Errors
    /// [`DspError::Range`] if a field is out of its range, or the fades are longer than the sweep.
    pub fn stimulus(&self) -> Result<Stimulus, DspError> {
        self.check()?;
        let (growth, sounding) = (self.growth(), self.sounding());
        let start = if self.synchronized { 0.0 } else { 1.0 };
        let fade = |t: f64, length: f64| if t < length { (PI * t / length / 2.0).sin().powi(2) } else { 1.0 };
        let count = (sounding * self.rate).floor() as usize + 1;
        let mut samples: Vec<f64> = (0..count)
            .map(|i| {
                let t = i as f64 / self.rate;
                let phase = TAU * (self.from * growth * ((t / growth).exp() - start)).fract();
                self.amplitude * phase.sin() * fade(t, self.fade_in) * fade(sounding - t, self.fade_out)
            })
            .collect();
        samples.resize(count + (self.silence * self.rate).round() as usize, 0.0);
        Stimulus::new(samples, self.rate)?.in_band(Band::within(self.from, self.to))
    }

    fn check(&self) -> Result<(), DspError> {
        positive("samples per second", self.rate)?;
        positive("seconds of a sweep", self.seconds)?;
        positive("amplitude of a sweep", self.amplitude)?;
        let within = |what, found: f64, low: f64, high: f64| {
            if found > low && found < high {
                return Ok(());
            }
            Err(DspError::Range(OutOfRange::new(what, format!("between {low} and {high}"), found)))
        };
        within("begin of a sweep in Hz", self.from, 0.0, self.to)?;
        within("end of a sweep in Hz", self.to, self.from, self.rate / 2.0)?;
        let longest = MOST_SECONDS.min(MOST_SAMPLES / self.rate);
        within("seconds of a sweep", self.sounding(), 0.0, longest)?;
        for (what, found, most) in [
            ("seconds of a fade in", self.fade_in, self.sounding()),
            ("seconds of a fade out", self.fade_out, self.sounding() - self.fade_in),
            ("seconds of silence", self.silence, longest),
        ] {
            if !(found >= 0.0 && found <= most) {
                return Err(DspError::Range(OutOfRange::new(what, format!("from 0 to {most}"), found)));
            }
        }
        Ok(())
    }
}

/// Longest sweep and longest silence, in seconds: longer ones are probably mistakes of unit, and would need
/// gigabytes.
const MOST_SECONDS: f64 = 600.0;

/// Largest number of samples of a sweep and of a silence: half a GiB. Twice as many allow longer ones above 112 kHz.
const MOST_SAMPLES: f64 = (1 << 26) as f64;
