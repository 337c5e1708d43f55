//! Reciprocity error of responses between actuators that are also sensors.

use super::average::correlation;
use super::same;
use unripple_dsp::DspError;

/// Deviation from reciprocity, h_ab = h_ba, of responses between actuators that are also sensors.
///
/// ```
/// use unripple_calibrate::signals::Reciprocity;
///
/// // Two actuators, two samples each: h_00, h_01, h_10, h_11.
/// let responses = [5.0, 0.0, 1.0, 0.5, 1.1, 0.5, 4.0, 0.0];
/// let reciprocity = Reciprocity::of(&responses, 2)?;
/// assert!((reciprocity.error - 0.1 / (0.5_f64 * (1.25 + 1.46)).sqrt()).abs() < 1e-12);
/// assert_eq!(reciprocity.worst.map(|pair| pair.pair), Some([0, 1]));
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Reciprocity {
    /// Rms of h_ab − h_ba over all pairs, relative to the rms of both responses; 0 if all are silent.
    pub error: f64,
    /// The pair with the largest error; `None` for fewer than two actuators.
    pub worst: Option<Pair>,
    /// All pairs of two actuators a < b, with their errors.
    pub pairs: Vec<Pair>,
}

/// Reciprocity error between two actuators a and b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Indices of the two actuators, the lower first.
    pub pair: [usize; 2],
    /// Rms of h_ab − h_ba, relative to the rms of both responses.
    pub error: f64,
    /// Correlation of h_ab and h_ba: near 1 with a large error if the gain of one sensor is wrong, near −1 if one is
    /// reversed.
    pub correlation: f64,
}

impl Reciprocity {
    /// Reciprocity of responses in the order `[drive][sensor][sample]`, `actuators` of each; those of an actuator at
    /// itself are not used.
    ///
    /// # Errors
    /// [`DspError::Size`] if the length of `responses` is not a multiple of `actuators` squared.
    pub fn of(responses: &[f64], actuators: usize) -> Result<Self, DspError> {
        let count = actuators * actuators;
        let samples = responses.len().checked_div(count).unwrap_or(0);
        same("samples of responses between actuators", samples * count, responses.len())?;
        let response = |a: usize, b: usize| {
            let start = (a * actuators + b) * samples;
            &responses[start..start + samples]
        };
        let (mut apart, mut both) = (0.0, 0.0);
        let mut pairs = Vec::new();
        for a in 0..actuators {
            for b in a + 1..actuators {
                let (forth, back) = (response(a, b), response(b, a));
                let difference: f64 = forth.iter().zip(back).map(|(x, y)| (x - y).powi(2)).sum();
                let mean = forth.iter().chain(back).map(|x| x * x).sum::<f64>() / 2.0;
                pairs.push(Pair {
                    pair: [a, b],
                    error: relative(difference, mean),
                    correlation: correlation(forth, back),
                });
                apart += difference;
                both += mean;
            }
        }
        let worst = pairs.iter().copied().max_by(|a, b| a.error.total_cmp(&b.error));
        Ok(Self { error: relative(apart, both), worst, pairs })
    }
}

fn relative(difference: f64, whole: f64) -> f64 {
    if whole > 0.0 { (difference / whole).sqrt() } else { 0.0 }
}
