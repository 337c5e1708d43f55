//! Measured responses to which a model is fitted, and their noise.

use crate::CalibrateError;
use crate::signals::Band;
use unripple_core::{Point, Surface, require};
use unripple_dsp::median;

/// Smallest noise assumed, relative to the rms of the responses: the accuracy of the models of a band's edges and of a device's
/// latency.
const FLOOR: f64 = 1e-3;

/// Measured data to which a model is fitted: responses between a surface's actuators, taps recorded by the
/// actuators, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Samples per second.
    pub rate: f64,
    /// Responses from actuator to actuator; `None` if only taps were measured.
    pub pairs: Option<Pairs>,
    /// Taps at known places.
    pub taps: Vec<Tap>,
}

/// Response of each actuator, used as a sensor, to each driven actuator: sensor signal per unit impulse of drive, sample 0
/// just after the impulse.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairs {
    /// Response of actuator `i` to actuator `j` at `j · N + i`, all of one length; an empty one was not measured.
    pub responses: Vec<Vec<f64>>,
    /// Root mean square of the noise on each sample, taken as white up to half the rate, in the responses' unit.
    pub noise: f64,
    /// Band to which the responses were limited by a zero-phase filter, before everything earlier than time
    /// 0 was cut off, as [`Session`](crate::measure::Session) measures them; `None` if they are not limited.
    pub limited: Option<Band>,
}

/// A tap at a known place, recorded by every actuator as a sensor. The force's shape and strength are unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct Tap {
    /// Place of the tap on the surface, in m.
    pub at: Point,
    /// The sensor signal of each actuator, all of one length, with the tap somewhere near the beginning.
    pub heard: Vec<Vec<f64>>,
    /// Root mean square of the noise on each sample, taken as white up to half the rate, in the signals' unit.
    pub noise: f64,
}

impl Measured {
    /// Indices of those of `count` actuators that were not measured, neither as drive nor as sensor.
    pub(super) fn silent(&self, count: usize) -> Vec<usize> {
        let says = |signal: &Vec<f64>| signal.iter().any(|x| *x != 0.0);
        let pairs = || self.pairs.iter().flat_map(|pairs| pairs.responses.iter().enumerate());
        let paired = |a: usize| pairs().any(|(n, h)| (n / count == a || n % count == a) && says(h));
        let tapped = |a: usize| self.taps.iter().any(|tap| tap.heard.get(a).is_some_and(says));
        (0..count).filter(|a| !paired(*a) && !tapped(*a)).collect()
    }

    /// Measured data that consist of responses between actuators only, in the order of [`Pairs::responses`];
    /// `rate` in Hz, `noise` as in [`Pairs::noise`].
    pub fn pairs(rate: f64, responses: Vec<Vec<f64>>, noise: f64) -> Self {
        Self { rate, pairs: Some(Pairs { responses, noise, limited: None }), taps: Vec::new() }
    }

    /// Responses between actuators, in the order of [`Pairs::responses`], with the noise estimated from
    /// reciprocity: `h_ij` and `h_ji` differ by gains and noise alone. The noise is the median over all
    /// pairs, at least -60 dB relative to the responses, expressed as white noise up to half the rate with
    /// the density found within `band` (Hz), where the signals are.
    ///
    /// # Errors
    /// [`CalibrateError::Count`] without two actuators measured in both directions, [`CalibrateError::Range`] for an empty band.
    ///
    /// ```
    /// use unripple_calibrate::Measured;
    ///
    /// let mut random = unripple_core::Random::seeded(1);
    /// let mut heard = || (0..4800).map(|i| (f64::from(i) * 0.2).sin() + 0.01 * random.normal()).collect();
    /// let all = vec![heard(), heard(), heard(), heard()];
    /// let measured = Measured::reciprocal(48e3, all, [0.0, 24e3])?;
    /// let found = measured.pairs.expect("they are there").noise;
    /// assert!((found / 0.01 - 1.0).abs() < 0.05);
    /// # Ok::<(), unripple_calibrate::CalibrateError>(())
    /// ```
    pub fn reciprocal(rate: f64, responses: Vec<Vec<f64>>, band: [f64; 2]) -> Result<Self, CalibrateError> {
        let width = band[1].min(rate / 2.0) - band[0].max(0.0);
        require("top of the measured band in Hz", width > 0.0, "above its bottom", band[1])?;
        let count = responses.len().isqrt();
        let reverse = |n: usize| responses.get(n % count.max(1) * count + n / count.max(1));
        let off = |(n, there): (usize, &Vec<f64>)| {
            let back =
                reverse(n).filter(|back| n / count < n % count && !there.is_empty() && !back.is_empty())?;
            let sum =
                |f: &dyn Fn(f64, f64) -> f64| there.iter().zip(back).map(|(x, y)| f(*x, *y)).sum::<f64>();
            let (own, other, both) = (sum(&|x, _| x * x), sum(&|_, y| y * y), sum(&|x, y| x * y));
            let gain = both / own.max(f64::MIN_POSITIVE);
            let left = (other - gain * both).max(FLOOR * FLOOR * other) / (1.0 + gain * gain);
            let samples = there.len().min(back.len()) as f64;
            Some((left / samples * rate / (2.0 * width)).sqrt())
        };
        let noise = median(responses.iter().enumerate().filter_map(off)).ok_or(CalibrateError::Count {
            what: "actuators with responses between them both ways",
            expected: "at least 2".into(),
            found: 0,
        })?;
        Ok(Self::pairs(rate, responses, noise.max(f64::MIN_POSITIVE)))
    }

    /// These data with the noise of the responses between actuators replaced by a measured one, rms on each
    /// sample, but at least -60 dB relative to the rms of the responses.
    #[must_use]
    pub fn with_noise(mut self, noise: f64) -> Self {
        if let Some(pairs) = &mut self.pairs {
            let all = pairs.responses.iter().flatten();
            let (sum, count) = all.fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
            pairs.noise = noise.max(FLOOR * (sum / f64::max(count, 1.0)).sqrt()).max(f64::MIN_POSITIVE);
        }
        self
    }

    /// These data with the responses between actuators marked as limited to a band; see [`Pairs::limited`].
    pub fn limited_to(mut self, band: Band) -> Self {
        if let Some(pairs) = &mut self.pairs {
            pairs.limited = Some(band);
        }
        self
    }

    /// Measured data that consist of taps only, recorded at `rate` samples per second.
    pub fn taps(rate: f64, taps: Vec<Tap>) -> Self {
        Self { rate, pairs: None, taps }
    }

    /// Number of samples of the shortest signal.
    pub(crate) fn samples(&self) -> usize {
        let pairs = self.pairs.iter().flat_map(|p| &p.responses).map(Vec::len).filter(|n| *n > 0);
        pairs.chain(self.taps.iter().flat_map(|tap| &tap.heard).map(Vec::len)).min().unwrap_or(0)
    }

    pub(crate) fn check(&self, surface: &Surface) -> Result<(), CalibrateError> {
        let actuators = surface.actuators.len();
        let count = |what, expected: usize, found| match expected == found {
            true => Ok(()),
            false => Err(CalibrateError::Count { what, expected: expected.to_string(), found }),
        };
        if actuators < 2 {
            return Err(CalibrateError::Count {
                what: "actuators of the surface",
                expected: "at least 2".into(),
                found: actuators,
            });
        }
        positive("sample rate in Hz", self.rate)?;
        if let Some(pairs) = &self.pairs {
            count("responses from actuator to actuator", actuators * actuators, pairs.responses.len())?;
            positive("noise of the responses", pairs.noise)?;
        }
        for tap in &self.taps {
            count("signals of a tap", actuators, tap.heard.len())?;
            positive("noise of a tap", tap.noise)?;
            let inside = surface.outline.contains(tap.at);
            require("x of a tap in m", inside, "a place inside the outline", tap.at.x)?;
        }
        let samples = self.samples();
        if samples < 2 {
            return Err(CalibrateError::Count {
                what: "samples of the shortest signal",
                expected: "at least 2".into(),
                found: samples,
            });
        }
        let all = self.pairs.iter().flat_map(|p| &p.responses).chain(self.taps.iter().flat_map(|t| &t.heard));
        for value in all.flatten() {
            require("sample of a signal", value.is_finite(), "a finite number", *value)?;
        }
        Ok(())
    }
}

fn positive(what: &'static str, found: f64) -> Result<(), CalibrateError> {
    Ok(require(what, found > 0.0 && found.is_finite(), "a positive number", found)?)
}
