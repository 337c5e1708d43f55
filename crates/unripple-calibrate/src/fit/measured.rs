use crate::CalibrateError;
use crate::error::require;
use unripple_core::{Point, Surface};

/// What was measured on a surface: responses between its actuators, taps heard by them, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Samples per second.
    pub rate: f64,
    /// Responses from actuator to actuator.
    pub pairs: Option<Pairs>,
    /// Taps at known places.
    pub taps: Vec<Tap>,
}

/// Responses of every actuator, sensing, to every actuator, driven: sensor signal per unit impulse of drive, sample 0 just
/// after the impulse.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairs {
    /// Response of actuator `i` to actuator `j` at `j · N + i`, all of one length; an empty one was not measured.
    pub responses: Vec<Vec<f64>>,
    /// Root mean square of the noise on each sample, taken as white up to half the rate, in the responses' unit.
    pub noise: f64,
}

/// A tap at a known place, heard by every actuator. The force's shape and strength are unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct Tap {
    /// Where.
    pub at: Point,
    /// The sensor signal of each actuator, all of one length, the tap somewhere near the beginning.
    pub heard: Vec<Vec<f64>>,
    /// Root mean square of the noise on each sample, taken as white up to half the rate, in the signals' unit.
    pub noise: f64,
}

impl Measured {
    /// Responses from actuator to actuator alone.
    pub fn pairs(rate: f64, responses: Vec<Vec<f64>>, noise: f64) -> Self {
        Self { rate, pairs: Some(Pairs { responses, noise }), taps: Vec::new() }
    }

    /// Taps alone.
    pub fn taps(rate: f64, taps: Vec<Tap>) -> Self {
        Self { rate, pairs: None, taps }
    }

    /// Samples of the shortest signal.
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

fn positive(what: &str, found: f64) -> Result<(), CalibrateError> {
    require(what, found > 0.0 && found.is_finite(), "a positive number", found)
}
